"""Opens the drawings of `export --parts` with ezdxf, audits them, measures their holes, and puts the parts of a four-bar together."""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import ezdxf
from ezdxf.math import Vec2, is_point_in_polygon_2d
from ezdxf.path import make_path

PROGRAM = sys.argv[1]

# Twelve linkages of the catalogue, and what the holes of some of their parts are apart, from their own dimensions: the parameters in the file.
LINKAGES = {
    "four-bar frame=4 crank=1 coupler=3 rocker=3.5 along=1.5 across=1": {
        "OA": [1],
        "ABM": [3, math.hypot(1.5, 1), math.hypot(1.5, 1)],
        "CB": [3.5],
    },
    "slider-crank": {"OA": [1], "ABM": [3, 1.5, 1.5]},
    "inverted-slider-crank": {"OA": [1], "frame": [2]},
    "jansen": {
        "OP": [15],
        "PX": [50],
        "PY": [61.9],
        "BY": [39.3],
        "BXW": [41.5, 40.1, 55.8],
        "WZ": [39.4],
        "Y-Z-Foot": [36.7, 49, 65.7],
    },
    "klann": {},
    "watt-six-bar": {"OA": [70], "AB": [100], "CBD": [90, 150], "DEM": [120], "QE": [160]},
    "geared-five-bar": {"AB": [7], "DB": [8], "gear P": [], "gear O": []},
    "scotch-yoke": {"OA": [1]},
    "peaucellier-lipkin": {"DP": [5], "OC": [15], "CQ": [6], "EQ": [6], "frame": [5]},
    "elliptic-trammel": {"ABM": [3, 1, 2]},
    "whitworth": {"OA": [2]},
    "rack-steering": {"NB": [300], "KB": [130]},
}


def export(folder, words, *options):
    command = [PROGRAM, "export", "--format", "dxf", "--parts", *options, "-o", str(folder), *words]
    subprocess.run(command, check=True, capture_output=True)


def read(file):
    document = ezdxf.readfile(file)
    auditor = document.audit()
    assert not auditor.errors, (file, [str(error.message) for error in auditor.errors])
    assert not auditor.fixes, (file, [str(fix.message) for fix in auditor.fixes])
    assert document.dxfversion == "AC1015", document.dxfversion
    return document


def holes(document):
    return [Vec2(circle.dxf.center) for circle in document.modelspace().query('CIRCLE[layer=="HOLES"]')]


def distances(points):
    """The distances of the first two holes, and of each further one from both."""
    pairs = [(j, k) for k in range(1, len(points)) for j in range(min(k, 2))]
    return [points[j].distance(points[k]) for j, k in pairs]


def check_part(file, name):
    document = read(file)
    outline = document.modelspace().query(f'*[layer=="{name}"]')
    assert len(outline) == 1, (file, len(outline))
    path = make_path(outline[0])
    assert path.is_closed, file
    size = (Vec2(document.header["$EXTMAX"]) - Vec2(document.header["$EXTMIN"])).magnitude
    border = Vec2.list(path.flattening(1e-5 * size))
    cuts = holes(document)
    for slot in document.modelspace().query('LWPOLYLINE[layer=="SLOTS"]'):
        assert slot.closed and sorted(bulge for *_, bulge in slot.get_points())[-2:] == [1, 1], file
        cuts += Vec2.list(make_path(slot).flattening(1e-5 * size))
    assert cuts, file
    for cut in cuts:
        assert is_point_in_polygon_2d(cut, border) == 1, (file, cut)
    return document


def check_linkages(folder):
    measured = 0
    for k, (words, parts) in enumerate(LINKAGES.items()):
        linkage, *parameters = words.split()
        export(folder / str(k), parameters, "--linkage", linkage)
        files = sorted((folder / str(k)).glob(f"{linkage}-1-*-assembly.dxf"))
        assert files, linkage
        stem = files[0].name.removesuffix("assembly.dxf")
        assembly = read(files[0])
        reserved = {"0", "DEFPOINTS", "HOLES", "SLOTS", "CENTRES", "TEXT", "CURVE"}
        names = [layer.dxf.name for layer in assembly.layers if layer.dxf.name.upper() not in reserved]
        assert set(parts) <= set(names), (linkage, names)
        for name in names:
            document = check_part(folder / str(k) / f"{stem}{name.replace(' ', '-')}.dxf", name)
            found = distances(holes(document))
            for expected, distance in zip(parts.get(name, []), found):
                assert abs(expected - distance) < 1e-9, (linkage, name, found)
                measured += 1
    return measured


def check_unit(folder):
    manifest = folder / "unit.toml"
    for unit, code in [("mm", 4), ("in", 1)]:
        manifest.write_text(
            f'[[family]]\nid = "mine"\nlinkage = "four-bar"\nunit = "{unit}"\n'
            "cases = [{ frame = 40, crank = 10, coupler = 30, rocker = 35, along = 15, across = 10 }]\n"
            '[atlas]\ntitle = "Mine"\n'
        )
        out = folder / unit
        subprocess.run(
            [PROGRAM, "export", manifest, "mine:1.1.1", "--format", "dxf", "--parts", "--hole", "3", "--width", "8", "-o", out],
            check=True,
            capture_output=True,
        )
        crank = read(out / "mine-1-1-1-OA.dxf")
        assert crank.header["$INSUNITS"] == code and crank.header["$MEASUREMENT"] == (unit == "mm")
        assert [circle.dxf.radius for circle in crank.modelspace().query("CIRCLE")] == [1.5, 1.5]
        low, high = Vec2(crank.header["$EXTMIN"]), Vec2(crank.header["$EXTMAX"])
        assert low.x <= -4 and high.x >= 14 and low.y <= -4 and high.y >= 4, (low, high)


def circles_meet(a, r, b, s, side):
    """The point at distances r from a and s from b, to the left (1) or right (-1) of a -> b."""
    d = a.distance(b)
    along = (r * r - s * s + d * d) / (2 * d)
    across = math.sqrt(r * r - along * along)
    unit = (b - a).normalize()
    return a + unit * along + unit.orthogonal() * (side * across)


def check_assembly(folder):
    """The parts of a four-bar, put together by what is measured of them, give the points of its curve."""
    words = "frame=4 crank=1 coupler=3 rocker=3.5 along=1.5 across=1".split()
    export(folder / "assembled", words, "--linkage", "four-bar")
    of = lambda name: holes(read(folder / "assembled" / f"four-bar-1-1-1-{name}.dxf"))
    (frame, crank, coupler, rocker) = (of(name) for name in ["frame", "OA", "ABM", "CB"])
    json_file = subprocess.run(
        [PROGRAM, "export", "--linkage", "four-bar", *words, "1.1", "--format", "json"], check=True, capture_output=True
    )
    curve = json.loads(json_file.stdout)
    columns = curve["columns"]
    worst = 0.0
    for point in curve["points"]:
        row = dict(zip(columns, point))
        angle = math.radians(row["input_deg"])
        a = frame[0] + Vec2(math.cos(angle), math.sin(angle)) * crank[1].x
        b = circles_meet(a, coupler[1].x, frame[1], rocker[1].x, 1)
        unit = (b - a).normalize()
        m = a + unit * coupler[2].x + unit.orthogonal() * coupler[2].y
        worst = max(worst, m.distance(Vec2(row["x"], row["y"])))
    assert worst < 1e-9, worst
    return len(curve["points"])


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    measured = check_linkages(folder)
    check_unit(folder)
    points = check_assembly(folder)
print(f"ezdxf {ezdxf.__version__}: {len(LINKAGES)} linkages, {measured} distances of holes, {points} points of a curve")
