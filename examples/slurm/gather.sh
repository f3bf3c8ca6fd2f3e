#!/bin/bash
# Starts when all tasks of the array have succeeded; the best linkages are in best.csv and best.toml.
#SBATCH --job-name=gather
#SBATCH --cpus-per-task=1
set -euo pipefail

"${COUPLER_ATLAS:-coupler-atlas}" gather "$OUTPUT" --top "${TOP:-1000}" --by "${BY:--straight_length}" --toml "$OUTPUT/best.toml" \
    > "$OUTPUT/best.csv.new"
mv "$OUTPUT/best.csv.new" "$OUTPUT/best.csv"
