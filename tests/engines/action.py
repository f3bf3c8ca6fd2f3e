"""Prints the scripts of a composite action one after another, for .ci/workflows: action.py action.yml"""

import sys

from ruamel.yaml import YAML

action = YAML(typ="safe").load(open(sys.argv[1]))
assert action["runs"]["using"] == "composite"
for step in action["runs"]["steps"]:
    if "uses" in step:
        continue
    # Inputs reach a script as variables only, so that no input is run.
    assert step["shell"] == "bash" and "${{" not in step["run"], step["name"]
    print(step["run"])
