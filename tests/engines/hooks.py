"""Tries the hooks for pre-commit in a repository of its own, for .ci/workflows: hooks.py PRE-COMMIT HOOKS FOLDER

The program in the path takes the place of the one that pre-commit would build.
"""

import pathlib
import subprocess
import sys

from ruamel.yaml import YAML

pre_commit, hooks, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])


def run(*command, fails=False):
    """Runs a command in the repository, and returns what it prints."""
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert (done.returncode != 0) == fails, f"{command}: {done.stdout}"
    return done.stdout


def family(name):
    return f'[[family]]\nid = "{name}"\nlinkage = "evans"\nsampling = {{ samples = 9 }}\ncases = [{{ p = 2, a = 2 }}]\n'


def configure(arguments=None):
    """Writes the configuration, with other arguments for the hook that checks."""
    own = [dict(hook, language="system") for hook in YAML(typ="safe").load(hooks)]
    for hook in own:
        if hook["id"] == "coupler-atlas-check" and arguments:
            hook["args"] = arguments
    with open(folder / ".pre-commit-config.yaml", "w") as file:
        YAML().dump({"repos": [{"repo": "local", "hooks": own}]}, file)


def commit(fails=None):
    """Tries to commit what has been added; `fails` is the hook that must prevent it."""
    out = run(pre_commit, "run", fails=fails is not None)
    failed = [line for line in out.splitlines() if line.endswith("Failed")]
    assert len(failed) == (fails is not None) and (fails is None or failed[0].startswith(fails)), out
    if fails is None:
        run("git", "-c", "user.name=N", "-c", "user.email=n@example.org", "commit", "--quiet", "--message", "M")


folder.mkdir()
run("git", "init", "--quiet")
configure()
head = '[atlas]\ntitle = "T"\noutput = "output"\nformats = ["svg"]\n'
(folder / "atlas.toml").write_text(head + family("e"))
run("coupler-atlas", "render", "--quiet")
run("git", "add", ".")
commit()
# A family is added, and its files are not.
(folder / "atlas.toml").write_text(head + family("e") + family("f"))
run("coupler-atlas", "render", "--quiet")
run("git", "add", "--update")
commit(fails="the recorded atlas is in the commit")
run("git", "add", "output")
commit()
# Pages are removed, and nothing else is changed.
run("git", "rm", "--quiet", "-r", "output/f")
commit(fails="no curve has moved")
run("git", "reset", "--quiet", "--hard")
# The atlas is elsewhere.
run("git", "mv", "output", "the atlas")
commit(fails="no curve has moved")
configure(["--against", "the atlas"])
run("git", "add", ".")
commit()
(folder / "atlas.toml").write_text("[atlas")
run("git", "add", ".")
out = run(pre_commit, "run", "coupler-atlas-validate", fails=True)
assert "atlas.toml" in out, out
print("workflows: the hooks find what has changed, was removed or was not added")
