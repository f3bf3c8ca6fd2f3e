"""Validates the manifests of examples/kubernetes against the schema of Kubernetes, and runs what their pods run.

python kubernetes.py PROGRAM MANIFEST SHARDS TOP BY OUTPUT: the shards and the best of them are written to OUTPUT. There is no cluster: a pod
is a process with the command line of its container, in which the paths of volumes are those of folders here. Pods are killed and
replaced as the job says.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import kubernetes_validate
import yaml

program, manifest, shards, top, by, output = sys.argv[1:]
shards, output = int(shards), pathlib.Path(output)
folder = pathlib.Path("examples/kubernetes")

documents = {}
for path in sorted(folder.glob("*.yaml")):
    for document in yaml.safe_load_all(path.read_text()):
        for version in ["1.31", kubernetes_validate.latest_version()]:
            kubernetes_validate.validate(document, version, strict=True)
        documents[document["kind"], document["metadata"]["name"]] = document
assert sorted(documents) == [("Job", "gather"), ("Job", "sweep"), ("PersistentVolumeClaim", "shards")]


def refused(document, change):
    """Whether the schema refuses a changed document, so that a misspelt key would be found."""
    changed = yaml.safe_load(yaml.safe_dump(document))
    change(changed)
    try:
        kubernetes_validate.validate(changed, "1.31", strict=True)
    except Exception:
        return True
    return False


assert refused(documents["Job", "sweep"], lambda job: job["spec"].update(completion=3))
assert refused(documents["Job", "sweep"], lambda job: job["spec"].update(completions="many"))

volumes = {"/atlas": output / "volumes" / "atlas", "/shards": output / "volumes" / "shards"}
for volume in volumes.values():
    volume.mkdir(parents=True)
shutil.copy(manifest, volumes["/atlas"] / "atlas.toml")


def container(name):
    """The container of a job, checked against the volumes of its pod and the image that the container file makes."""
    spec = documents["Job", name]["spec"]["template"]["spec"]
    (container,) = spec["containers"]
    named = {volume["name"] for volume in spec["volumes"]}
    assert {mount["name"] for mount in container["volumeMounts"]} == named
    assert {mount["mountPath"] for mount in container["volumeMounts"]} <= set(volumes)
    assert 'ENTRYPOINT ["coupler-atlas"]' in (folder / "Containerfile").read_text() and "command" not in container
    claims = [volume["persistentVolumeClaim"]["claimName"] for volume in spec["volumes"] if "persistentVolumeClaim" in volume]
    assert all(("PersistentVolumeClaim", claim) in documents for claim in claims)
    return container


def command(container, index=None):
    """The command line of a pod, for as many shards and best curves as the test has."""
    variables = {}
    for variable in container.get("env", []):
        assert variable["valueFrom"]["fieldRef"]["fieldPath"] == "metadata.annotations['batch.kubernetes.io/job-completion-index']"
        variables[variable["name"]] = str(index)
    line = [program]
    for argument in container["args"]:
        assert isinstance(argument, str), argument
        argument = re.sub(r"\$\((\w+)\)", lambda match: variables[match[1]], argument)
        argument = re.sub(r"^(/atlas|/shards)(?=/|$)", lambda match: str(volumes[match[1]]), argument)
        line.append(argument)
    completions = documents["Job", "sweep"]["spec"]["completions"]
    replaced = {f"{index}/{completions}": f"{index}/{shards}", "1000": top, "-straight_length": by}
    return [replaced.get(argument, argument) for argument in line]


job = documents["Job", "sweep"]["spec"]
assert job["completionMode"] == "Indexed"
pod = container("sweep")
(rule,) = job["podFailurePolicy"]["rules"]
assert rule["onExitCodes"]["containerName"] == pod["name"]
(rule_of_gather,) = documents["Job", "gather"]["spec"]["podFailurePolicy"]["rules"]
assert rule_of_gather["onExitCodes"] == {**rule["onExitCodes"], "containerName": container("gather")["name"]}
assert f"$(INDEX)/{job['completions']}" in pod["args"]
kills = 0
for index in range(shards):
    for attempt in range(job["backoffLimitPerIndex"] + 1):
        process = subprocess.Popen(command(pod, index))
        try:
            # The first pods of every second index are killed midway.
            code = process.wait(timeout=0.1 if attempt == 0 and index % 2 == 0 else None)
        except subprocess.TimeoutExpired:
            process.kill()
            code = process.wait()
            kills += 1
        assert code not in rule["onExitCodes"]["values"], code
        if code == 0:
            break
    else:
        sys.exit(f"the shard {index} failed")
assert kills > 0, "no pod was killed"
# A pod on a node that is lost may run once more.
subprocess.run(command(pod, 3), check=True)

log = subprocess.run(command(container("gather")), check=True, stdout=subprocess.PIPE).stdout
(output / "best.csv").write_bytes(log)
shutil.copy(volumes["/shards"] / "best.toml", output / "best.toml")
for family in sorted((volumes["/shards"] / "all").iterdir()):
    shutil.move(family, output / family.name)
shutil.rmtree(output / "volumes")
