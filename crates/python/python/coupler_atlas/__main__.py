"""The program, as ``python -m coupler_atlas``."""

from ._command import main

if __name__ == "__main__":
    raise SystemExit(main())
