#!/bin/bash
# Makes the shards of a manifest as an array of jobs, and gathers them in a job that depends on it:
#
#     examples/slurm/submit.sh examples/scale/four-bars.toml shards 64
#
# The folders of the manifest and of the shards are on a disk that all nodes share. Submitted again, only what is missing is
# made.
set -euo pipefail
manifest=$(realpath "$1")
mkdir -p "$2"
output=$(realpath "$2")
shards=${3:-64}
here=$(dirname "$(realpath "$0")")

environment="ALL,MANIFEST=$manifest,OUTPUT=$output,SHARDS=$shards"
array=$(sbatch --parsable --export="$environment" --array="0-$((shards - 1))" --output="$output/sweep-%a.log" "$here/sweep.sh")
gather=$(sbatch --parsable --export="$environment" --dependency="afterok:$array" --kill-on-invalid-dep=yes \
    --output="$output/gather.log" "$here/gather.sh")
echo "array $array, then $gather"
