"""Checks the Python package that is installed in this environment, for .ci/python and the workflow of releases: wheel.py"""

import importlib.metadata
import subprocess
import sys

import coupler_atlas

bar = coupler_atlas.FourBar(frame=4, crank=1, coupler=3, rocker=3.5, along=1.5, across=1)
assert bar.curve().shape == (360, 2)

package = importlib.metadata.distribution("coupler-atlas")
program = subprocess.run([sys.executable, "-m", "coupler_atlas", "--version"], capture_output=True, text=True, check=True)
assert program.stdout.split() == ["coupler-atlas", package.version], program.stdout
licences = {file.name for file in package.files if file.parent.name == "licenses"}
assert licences == {"LICENSE-APACHE", "LICENSE-DEJAVU", "LICENSE-MIT", "THIRD-PARTY-LICENSES"}, licences
print(f"wheel: {package.version} works, with {len(licences)} files of licences")
