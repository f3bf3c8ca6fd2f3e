#!/bin/bash
# A task of the array makes the shard of its number. submit.sh sets MANIFEST, OUTPUT and SHARDS; adapt the resources and the options
# of the program here.
#SBATCH --job-name=sweep
#SBATCH --array=0-63
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -uo pipefail

"${COUPLER_ATLAS:-coupler-atlas}" sweep "$MANIFEST" --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" --output "$OUTPUT" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --no-points --top "${TOP:-1000}" --by "${BY:--straight_length}"
code=$?

# Slurm itself starts tasks again whose node has failed. So does this a program that was killed, or whose disk was full: what is
# complete is kept. Exit code 2 is an error in the manifest, which would come again.
if [ "$code" -ne 0 ] && [ "$code" -ne 2 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    sleep 60
fi
exit "$code"
