"""Sweeps, compared with the tables that the program writes."""

import gc
import os
import pickle
import subprocess
import sys
import threading
import time

import duckdb
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import coupler_atlas as ca

# More cells than are solved in ten minutes.
MANY = """
[atlas]
title = "Many"
[[family]]
id = "many"
linkage = "four-bar"
limit = 10_000_000
sampling = { samples = 360 }
let = { crank = 1 }
grid = { frame = { from = 2, to = 5, count = 7 }, coupler = { from = 2, to = 5, count = 50 }, rocker = { from = 2, to = 5, count = 50 }, along = { from = 0, to = 2, count = 16 }, across = [0, 1, 2, 3] }
"""


def command(*arguments: object) -> str:
    program = os.path.join(os.path.dirname(sys.executable), "coupler-atlas")
    done = subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True)
    return done.stdout


@pytest.mark.parametrize("shard", [(0, 1), (1, 3)])
@pytest.mark.parametrize("table", ["cells", "points"])
@pytest.mark.parametrize("family", ["four-bars", "watt"])
def test_the_stream_is_the_parquet_table_of_the_program(manifest, tmp_path, family, table, shard) -> None:
    path = manifest()
    command("sweep", path, "--shard", f"{shard[0]}/{shard[1]}", "-o", tmp_path / "swept", "--quiet")
    expected = pq.read_table(tmp_path / "swept" / family / f"{table}-{shard[0]:05}-of-{shard[1]:05}.parquet")
    sweep = ca.sweep(path, family=family, shard=shard, points=table == "points")
    found = pa.table(sweep)
    assert found.schema.remove_metadata().equals(expected.schema.remove_metadata())
    for name in expected.column_names:
        assert found.schema.field(name).nullable == expected.schema.field(name).nullable
        assert found[name].combine_chunks().equals(expected[name].combine_chunks()), name
    assert found.num_rows == expected.num_rows > 0


def test_readers_of_arrow_agree(manifest) -> None:
    sweep = ca.sweep(manifest(), family="four-bars")
    table = pa.table(sweep)
    frame = pl.DataFrame(sweep)
    assert frame.shape == table.shape and frame["length"].to_list() == table["length"].to_pylist()
    assert frame.filter(pl.col("class") != "crank-rocker").is_empty()
    pandas = pd.DataFrame.from_arrow(sweep) if hasattr(pd.DataFrame, "from_arrow") else table.to_pandas()
    assert pandas["cell"].tolist() == table["cell"].to_pylist()
    counted = duckdb.sql("select count(*), sum(length) from sweep").fetchall()
    assert counted[0][0] == table.num_rows
    assert counted[0][1] == pytest.approx(sum(table["length"].to_pylist()))
    # A schema without rows.
    assert pa.schema(sweep).names == sweep.columns
    assert table.schema.field("mu_min_deg").metadata == {b"unit": b"deg"} and sweep.units["mu_min_deg"] == "deg"


def test_batches_are_solved_as_they_are_asked_for(manifest) -> None:
    sweep = ca.sweep(manifest(MANY), cells=(1, 400_000), measures=[])
    assert sweep.cell_count == 400_000 and len(sweep.columns) < 20
    begin = time.monotonic()
    batches = sweep.batches()
    first, second = next(batches), next(batches)
    assert time.monotonic() - begin < 30
    assert first["cell"][0] == 1 and second["cell"][0] == first["cell"][-1] + 1
    assert first["cell"].dtype == np.int64 and first["trace"].dtype in (np.int32, np.float64)
    assert len(first.to_dict()) == len(first.columns) and len(first) == len(first["frame"])
    assert pa.record_batch(first).num_rows == len(first)
    assert pl.DataFrame(first).shape == (len(first), len(first.columns))
    with pytest.raises(KeyError, match="there is no column `x`"):
        first["x"]
    del batches, first, second
    gc.collect()


def test_parts_are_the_whole(manifest) -> None:
    path = manifest()
    whole = pa.table(ca.sweep(path, family="four-bars"))
    shards = [pa.table(ca.sweep(path, family="four-bars", shard=(k, 7))) for k in range(7)]
    assert pa.concat_tables(shards).equals(whole)
    some = pa.table(ca.sweep(path, family="watt", cells=(3, 5)))
    assert set(some["cell"].to_pylist()) == {3, 4, 5}
    # A sweep is read as often as is wanted, by several threads at once, too.
    sweep = ca.sweep(path, family="four-bars")
    found: list[pa.Table] = []
    threads = [threading.Thread(target=lambda: found.append(pa.table(sweep))) for _ in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert len(found) == 3 and all(table.equals(whole) for table in found)


def test_missing_values_are_null(manifest) -> None:
    watt = pa.table(ca.sweep(manifest(), family="watt"))
    status = watt["status"].to_pylist()
    assert {"ok", "none"} <= set(status)
    for row in watt.to_pylist():
        assert (row["circuit"] is None) == (row["length"] is None) == (row["status"] == "none")


def test_progress_is_reported(manifest) -> None:
    calls: list[tuple[int, int, str]] = []
    pa.table(ca.sweep(manifest(), family="four-bars", progress=lambda *call: calls.append(call)))
    assert calls and all(name == "four-bars" and 0 <= done <= total == 400 for done, total, name in calls)
    assert [done for done, _, _ in calls] == sorted(done for done, _, _ in calls)

    def fail(done: int, total: int, name: str) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        list(ca.sweep(manifest(MANY), shard=(0, 20), progress=fail).batches())
    with pytest.raises(TypeError, match="progress='yes'"):
        list(ca.sweep(manifest(), family="watt", progress="yes"))  # type: ignore[arg-type]


@pytest.mark.parametrize(("read", "code"), [("list(sweep.batches())", 3), ("pa.table(sweep)", 1), ("pl.DataFrame(sweep)", 1)])
def test_ctrl_c_ends_a_sweep(manifest, interrupted, read, code) -> None:
    program = (
        # pyarrow imports pandas when it is first asked for a table.
        "import coupler_atlas as ca, pandas, pyarrow as pa, polars as pl, sys\n"
        f"sweep = ca.sweep({str(manifest(MANY))!r}, shard=(0, 20))\n"
        "print('begun', flush=True)\n"
        f"try:\n    {read}\n"
        "except KeyboardInterrupt:\n    print('interrupted', file=sys.stderr)\n    sys.exit(3)\n"
    )
    returncode, errors, elapsed = interrupted(program, 0.5)
    assert elapsed < 2, errors
    # Readers of Arrow data raise an exception of their own.
    assert returncode == code and "interrupted" in errors, errors


def test_only_what_the_table_has_is_computed(manifest) -> None:
    # The points of four thousand curves take less than all their measures by far: this would take a minute.
    sweep = ca.sweep(manifest(MANY), cells=(1, 4000), points=True)
    assert sum(len(batch) for batch in sweep.batches()) > 1_000_000
    assert {"x", "y"} < set(sweep.columns) and "length" not in sweep.columns


def test_the_types_of_columns_do_not_depend_on_gaps(manifest) -> None:
    path = manifest(
        'atlas.title = "Gaps"\n[[family]]\nid = "e"\nlinkage = "four-bar"\n'
        "cases = [{ frame = 4, crank = 1, coupler = 3, rocker = 3.5 }, { frame = 9, crank = 1, coupler = 3, rocker = 3.5 }]"
    )
    whole = next(ca.sweep(path).batches())
    first = next(ca.sweep(path, cells=(1, 1)).batches())
    assert np.isnan(whole["circuit"]).sum() == 1 and first["circuit"].dtype == whole["circuit"].dtype == np.float64


def test_sweeps_are_pickled_with_their_manifest(manifest) -> None:
    path = manifest()
    sweep = ca.sweep(path, family="watt", shard=(1, 3), measures=["length"])
    again = pickle.loads(pickle.dumps(sweep))
    path.unlink()
    assert pa.table(again).equals(pa.table(sweep)) and again.columns == sweep.columns


def test_a_fork_without_threads_is_an_error(manifest) -> None:
    program = (
        "import coupler_atlas as ca, multiprocessing\n"
        f"path = {str(manifest())!r}\n"
        "def rows(shard):\n    return sum(len(batch) for batch in ca.sweep(path, family='watt', shard=(shard, 2)).batches())\n"
        "print(rows(0) + rows(1))\n"
        "context = multiprocessing.get_context('fork')\n"
        "try:\n    print(context.Pool(2).map(rows, range(2)))\n"
        "except ca.Error as error:\n    print('Error:', error)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert "Error: this process was forked" in done.stdout and "spawn" in done.stdout, done


def test_other_threads_run_meanwhile(manifest) -> None:
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.monotonic()
    next(ca.sweep(manifest(MANY), shard=(0, 20), measures=["length", "area"]).batches())
    elapsed = time.monotonic() - begin
    stop.set()
    thread.join()
    # It would not have run at all while the interpreter was locked.
    assert counted > 20 * elapsed


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "small.toml has several families, each with columns of its own: name one, as in family=\"four-bars\", of four-bars, watt"),
        ({"family": "wat"}, "there is no family `wat`: did you mean `watt`"),
        ({"family": "watt", "shard": (3, 3)}, "shard=(3, 3): shards are numbered from 0: give (0, 3) to (2, 3)"),
        ({"family": "watt", "shard": (0, 0)}, "shard=(0, 0): the number of shards"),
        ({"family": "watt", "cells": (0, 3)}, "cells=(0, 3): give the numbers of the first and the last cell, counted from 1"),
        ({"family": "watt", "cells": (3, 13)}, "`watt` has no cell 13: its cells are numbered from 1 to 12"),
        ({"family": "watt", "cells": (1, 2), "shard": (0, 1)}, "two ways to choose cells"),
        ({"family": "watt", "shard": (-1, 2)}, "shard=(-1, 2): shards are numbered from 0: give (0, 2) to (1, 2)"),
        ({"family": "watt", "measures": ["lenght"]}, "unknown measure `lenght`: did you mean `length`"),
    ],
)
def test_arguments_are_checked(manifest, arguments, message) -> None:
    with pytest.raises(ValueError) as caught:
        ca.sweep(manifest(), **arguments)
    assert message in str(caught.value)
