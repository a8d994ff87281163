#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#SBATCH --job-name=meshrepair
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
#SBATCH --open-mode=append
# A share of a folder as one task of a Slurm job array: see slurm_submit.sh, which starts it.
#
# Usage: sbatch --array=1-N slurm_array.sh SCRIPTS [OPTIONS OF repair_folder.py] IN_DIR OUT_DIR [-- OPTIONS OF meshrepair]
#
# SCRIPTS is the folder of repair_folder.py. That some meshes cannot be repaired is no failure of the task: the summary names
# them. What may pass, the end of a node, its time, or a disk that is full for a while, puts the task back into the queue, three
# times at most; it goes on where it stopped.
set -uo pipefail

scripts=$1
shift
most_restarts=3
options=(--quiet --shard "$SLURM_ARRAY_TASK_ID/${SLURM_ARRAY_TASK_MAX:-$SLURM_ARRAY_TASK_COUNT}" --jobs "${SLURM_CPUS_PER_TASK:-1}")
# What Slurm allows the task in megabytes, less a tenth for the script itself, is for each of its workers the same part.
memory=${SLURM_MEM_PER_NODE:-$((${SLURM_MEM_PER_CPU:-0} * ${SLURM_CPUS_PER_TASK:-1}))}
if [ "$memory" -gt 0 ]; then options+=(--max-memory "$((memory * 9 / 10 / ${SLURM_CPUS_PER_TASK:-1}))M"); fi

# Slurm's signal comes to this shell alone.
"$scripts/repair_folder.py" "${options[@]}" "$@" &
child=$!
trap 'kill -TERM "$child"' TERM
wait "$child"
code=$?
while kill -0 "$child" 2>/dev/null; do
  wait "$child"
  code=$?
done
case $code in
  0 | 1) exit 0 ;;
  2) exit 2 ;;
esac
if [ "${SLURM_RESTART_COUNT:-0}" -lt "$most_restarts" ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60  # which ends this task
fi
exit "$code"
