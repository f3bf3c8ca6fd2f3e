"""Makes the shards of a manifest on a Ray cluster, a task for each, and gathers them.

    pip install ray
    python examples/ray/sweep.py examples/scale/four-bars.toml shards --shards 64

starts a worker for each processor of this machine; --address auto uses the cluster it belongs to, whose machines share the folders of the
manifest and of the shards. A task whose worker dies is run by another, and what is complete is kept.
"""

import argparse
import os
import pathlib
import subprocess

import ray

PROGRAM = os.environ.get("COUPLER_ATLAS", "coupler-atlas")


class WrongInput(Exception):
    """The program ended with exit code 2: another attempt is useless."""


@ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[subprocess.CalledProcessError])
def make_shard(index, shards, manifest, output, best):
    """Runs the program for one shard, on one thread."""
    command = [PROGRAM, "sweep", manifest, "--shard", f"{index}/{shards}", "--output", output]
    code = subprocess.run([*command, "--no-points", "--jobs", "1", "--quiet", *best]).returncode
    if code == 2:
        raise WrongInput(f"shard {index}: see the messages of the workers")
    if code != 0:
        raise subprocess.CalledProcessError(code, command)
    return index


def main():
    parser = argparse.ArgumentParser(description="Makes and gathers the shards of a manifest on a Ray cluster.")
    parser.add_argument("manifest", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--shards", type=int, default=64)
    parser.add_argument("--address", help="that of a cluster, or auto [default: a cluster on this machine]")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="the workers on this machine")
    parser.add_argument("--top", default="1000")
    parser.add_argument("--by", default="-straight_length", help="what is least for the best, as in --by=-straight_length")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    manifest, output = str(arguments.manifest.resolve()), str(arguments.output.resolve())
    best = ["--top", arguments.top, "--by", arguments.by]

    if arguments.address:
        ray.init(address=arguments.address)
    else:
        ray.init(num_cpus=arguments.workers, include_dashboard=False)
    tasks = [make_shard.remote(index, arguments.shards, manifest, output, best) for index in range(arguments.shards)]
    done = 0
    while tasks:
        finished, tasks = ray.wait(tasks)
        done += 1
        print(f"shard {ray.get(finished[0])}: {done} of {arguments.shards}", flush=True)
    ray.shutdown()

    with open(f"{output}/best.csv.new", "wb") as table:
        subprocess.run([PROGRAM, "gather", output, *best, "--toml", f"{output}/best.toml"], check=True, stdout=table)
    os.replace(f"{output}/best.csv.new", f"{output}/best.csv")


if __name__ == "__main__":
    main()
