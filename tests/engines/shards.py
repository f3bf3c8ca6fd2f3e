"""Reads folders of shards with PyArrow, DuckDB and Polars, and compares them with the tables of `render`.

python shards.py ATLAS SWEPT: the folder of a rendered atlas, and one with a folder of shards of it for each number of them.
"""

import csv
import pathlib
import sys

import duckdb
import polars
import pyarrow
import pyarrow.parquet

atlas, swept = map(pathlib.Path, sys.argv[1:])


def rendered(path):
    """The columns of a CSV file."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return {name: [row[k] for row in rows] for k, name in enumerate(header)}


def same(text, value):
    """Whether a field of CSV and a value are the same, bit by bit."""
    if text == "" or value is None:
        return text == "" and value is None
    return value == text if isinstance(value, str) else float(text) == value


counts = sorted((int(path.name) for path in swept.iterdir()), key=int)
families = sorted(path.parent.name for path in atlas.glob("*/cells.csv"))
assert len(counts) >= 4 and len(families) > 20
for family in families:
    for table in ["cells", "points"]:
        expected = rendered(atlas / family / f"{table}.csv")
        whole = None
        for count in counts:
            files = sorted((swept / str(count) / family).glob(f"{table}-*.parquet"))
            assert len(files) == count, (family, table, count)
            parts = [pyarrow.parquet.read_table(file) for file in files]
            union = pyarrow.concat_tables(parts).replace_schema_metadata(None)
            if whole is None:
                assert union.column_names == list(expected), (family, table)
                for name, texts in expected.items():
                    values = union.column(name).to_pylist()
                    assert len(values) == len(texts) and all(map(same, texts, values)), (family, table, name)
                whole = union
            assert union.equals(whole), (family, table, count)
            # Every file says what it is.
            metadata = pyarrow.parquet.read_metadata(files[0]).metadata
            assert metadata[b"coupler_atlas.family"].decode() == family
            assert len(metadata[b"coupler_atlas.manifest_sha256"]) == 64 and b"coupler_atlas.joints" in metadata

        # A folder as one table.
        pattern = str(swept / str(counts[-1]) / family / f"{table}-*.parquet")
        types = {"int64": "BIGINT", "int32": "INTEGER", "double": "DOUBLE", "string": "VARCHAR"}
        with_duckdb = duckdb.sql(f"SELECT * FROM '{pattern}'")
        assert [str(kind) for kind in with_duckdb.types] == [types[str(kind)] for kind in whole.schema.types], family
        found = with_duckdb.to_arrow_table()
        assert found.cast(whole.schema).equals(whole), (family, table, "DuckDB")
        with_polars = polars.read_parquet(pattern)
        assert with_polars.to_arrow().cast(whole.schema).equals(whole), (family, table, "Polars")

# All families as one table, with what the documentation asks.
everything = str(swept / str(counts[-1]) / "*" / "cells-*.parquet")
rows = duckdb.sql(f"SELECT count(*) FROM read_parquet('{everything}', union_by_name = true)").fetchall()[0][0]
assert rows == sum(len(rendered(atlas / family / "cells.csv")["cell"]) for family in families)
query = "SELECT family, count(*), max(straight_length) FROM read_parquet('{}') WHERE family = 'evans' GROUP BY family"
evans = str(swept / str(counts[-1]) / "evans" / "cells-*.parquet")
((family, count, longest),) = duckdb.sql(query.format(evans)).fetchall()
lengths = rendered(atlas / "evans" / "cells.csv")["straight_length"]
assert (family, count, longest) == ("evans", len(lengths), max(float(text) for text in lengths if text))
lazily = polars.scan_parquet(evans).filter(polars.col("straight_length") == longest).select("cell").collect()
assert lazily["cell"].to_list() == [k + 1 for k, text in enumerate(lengths) if text and float(text) == longest]
print(f"shards: PyArrow, DuckDB and Polars read those of {len(families)} families, in {counts} shards, as what was rendered")
