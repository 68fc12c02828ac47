#!/usr/bin/env bash
# A study as a Slurm job array on a shared file system.
#
#   array=$(sbatch --parsable --array=1-64 examples/campaign/slurm.sh SUITE DIR)
#   sbatch --dependency=afterok:$array --wrap 'vpl study SUITE --out DIR'
#
# A task that was preempted or ran out of time goes on where it stopped: submit its
# index again.
#SBATCH --cpus-per-task=2
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
exec "${VPL:-vpl}" study "$1" --out "$2" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads "${SLURM_CPUS_PER_TASK:-1}"
