"""Coupler curves of planar linkages.

>>> import coupler_atlas as ca
>>> bar = ca.FourBar(frame=4, crank=1, coupler=3, rocker=3.5, along=1.5, across=1)
>>> bar.curve().shape
(360, 2)

Lengths are in the unit in which they are given, angles in degrees, rates per radian of the input. Circuits, traces and cells are numbered
from 1, as in tables and names of files; sequences are indexed from 0, as everywhere in Python.
"""

from collections.abc import Mapping as _Mapping
from collections.abc import Sequence as _Sequence

from ._core import (
    Animation,
    Answer,
    Atlas,
    Batch,
    Circuit,
    Curve,
    Design,
    Designs,
    Error,
    Explorer,
    Family,
    Found,
    FoundFunction,
    FoundPoses,
    FourBar,
    FunctionAnswer,
    Inspection,
    Linkage,
    LinkageError,
    ManifestError,
    ManifestWarning,
    OutputError,
    Page,
    PoseAnswer,
    Rendering,
    Report,
    Results,
    Sextic,
    Sweep,
    __version__,
    check,
    design,
    find,
    find_function,
    find_poses,
    inspect,
    linkage,
    linkages,
    parse,
    read,
    render,
    sweep,
)

__all__ = [
    "Animation",
    "Answer",
    "Atlas",
    "Batch",
    "Circuit",
    "Curve",
    "Design",
    "Designs",
    "Error",
    "Explorer",
    "Family",
    "Found",
    "FoundFunction",
    "FoundPoses",
    "FourBar",
    "FunctionAnswer",
    "Inspection",
    "Linkage",
    "LinkageError",
    "ManifestError",
    "ManifestWarning",
    "OutputError",
    "Page",
    "PoseAnswer",
    "Rendering",
    "Report",
    "Results",
    "Sextic",
    "Sweep",
    "__version__",
    "check",
    "design",
    "find",
    "find_function",
    "find_poses",
    "inspect",
    "linkage",
    "linkages",
    "parse",
    "read",
    "render",
    "sweep",
]

_Mapping.register(Atlas)
_Mapping.register(Inspection)
_Sequence.register(Family)
_Sequence.register(Results)
