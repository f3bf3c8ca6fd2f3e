"""The command ``coupler-atlas``."""

import signal
import sys

from ._core import run_command


def main() -> int:
    """Run the program with the arguments of the command line, and return the exit code."""
    # The program handles Ctrl-C itself, or is ended by it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run_command(["coupler-atlas", *sys.argv[1:]])
