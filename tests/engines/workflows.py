"""Checks the order of the jobs of workflows, for .ci/workflows: workflows.py release.yml OTHER…"""

import sys

from ruamel.yaml import YAML


def load(path):
    with open(path) as file:
        return YAML(typ="safe").load(file)


def needed(jobs, name):
    """A job and those that it waits for, directly or not."""
    names = jobs[name].get("needs", [])
    names = [names] if isinstance(names, str) else names
    return {name}.union(*(needed(jobs, other) for other in names))


def writes(job):
    return "write" in job.get("permissions", {}).values()


for path in sys.argv[1:]:
    workflow = load(path)
    # Called workflows have their own.
    hasty = [name for name, job in workflow["jobs"].items() if "uses" not in job and "timeout-minutes" not in job]
    assert not hasty, f"{path}: no timeout-minutes: {hasty}"
    assert "concurrency" in workflow and workflow["permissions"] == {"contents": "read"}, path

workflow = load(sys.argv[1])
jobs = workflow["jobs"]
assert workflow["concurrency"]["cancel-in-progress"] is False
private = {name for name, job in jobs.items() if not writes(job)}
assert any(job.get("uses") == "./.github/workflows/ci.yml" for job in jobs.values())
assert len(private) < len(jobs)
for name, job in jobs.items():
    if name in private:
        # Rehearsed, on a branch or a tag.
        assert "if" not in job, f"{name} is not part of a run that is started by hand"
        assert "github.ref_name" not in str(job), f"{name}: a branch may have any name"
    else:
        assert private <= needed(jobs, name), f"{name} does not wait for {private - needed(jobs, name)}"
        assert job["if"].startswith("github.event_name == 'push'"), f"{name} would run by hand"
        assert name == "draft" or "draft" in needed(jobs, name), f"{name} does not wait for the draft"
