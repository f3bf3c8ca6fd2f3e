"""The program, as ``python -m coupler_atlas``."""

from ._command import main

raise SystemExit(main())
