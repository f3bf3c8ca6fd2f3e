"""Makes the shards of a manifest on a Dask cluster, a task for each, and gathers them.

    pip install "dask[distributed]"
    python examples/dask/sweep.py examples/scale/four-bars.toml shards --shards 64

starts a worker for each processor of this machine; --scheduler tcp://HOST:8786 uses a cluster, whose machines share the folders of the
manifest and of the shards. A task whose worker dies is run by another, and what is complete is kept.
"""

import argparse
import os
import pathlib
import subprocess

from dask.distributed import Client, LocalCluster, as_completed

PROGRAM = os.environ.get("COUPLER_ATLAS", "coupler-atlas")


def make_shard(index, shards, manifest, output, best):
    """Runs the program for one shard, on one thread. Returns the number of the shard and the exit code: 0, or 2 if the input was wrong,
    which would be wrong again; whatever else fails is tried again."""
    command = [PROGRAM, "sweep", manifest, "--shard", f"{index}/{shards}", "--output", output]
    code = subprocess.run([*command, "--no-points", "--jobs", "1", "--quiet", *best]).returncode
    if code not in (0, 2):
        raise subprocess.CalledProcessError(code, command)
    return index, code


def main():
    parser = argparse.ArgumentParser(description="Makes and gathers the shards of a manifest on a Dask cluster.")
    parser.add_argument("manifest", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--shards", type=int, default=64)
    parser.add_argument("--scheduler", help="the address of a scheduler [default: a cluster on this machine]")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="the workers on this machine")
    parser.add_argument("--top", default="1000")
    parser.add_argument("--by", default="-straight_length", help="what is least for the best, as in --by=-straight_length")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    manifest, output = str(arguments.manifest.resolve()), str(arguments.output.resolve())
    best = ["--top", arguments.top, "--by", arguments.by]

    cluster = None if arguments.scheduler else LocalCluster(n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None)
    with Client(arguments.scheduler or cluster) as client:
        tasks = client.map(
            make_shard, range(arguments.shards), shards=arguments.shards, manifest=manifest, output=output, best=best, retries=3, pure=False
        )
        for done, task in enumerate(as_completed(tasks), 1):
            index, code = task.result()
            if code != 0:
                raise SystemExit(f"shard {index}: the input was wrong, see the messages of the workers")
            print(f"shard {index}: {done} of {arguments.shards}", flush=True)
    if cluster:
        cluster.close()

    with open(f"{output}/best.csv.new", "wb") as table:
        subprocess.run([PROGRAM, "gather", output, *best, "--toml", f"{output}/best.toml"], check=True, stdout=table)
    os.replace(f"{output}/best.csv.new", f"{output}/best.csv")


if __name__ == "__main__":
    main()
