#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Repairs a folder on a Slurm cluster: a job array over shares of its files, and a job that sums up.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/cluster/slurm_submit.sh [OPTIONS] IN_DIR OUT_DIR [-- OPTIONS OF meshrepair]

  --shards N       tasks of the array (default: 100)
  --at-once N      tasks at a time (default: all)
  --sbatch WORDS   more options of sbatch, as "--time=8:00:00 --mem=16G --cpus-per-task=4"
  --folder WORDS   more options of repair_folder.py, as "--timeout 300 --format obj"
  --html           also make the gallery
  -h, --help       print this text

IN_DIR and OUT_DIR are on a disk that all nodes share, and so are these scripts. Prints the numbers of both jobs. The same
command again, later, does what is left.

Example:
  scripts/cluster/slurm_submit.sh --shards 200 --html --sbatch "--time=4:00:00 --mem=8G --cpus-per-task=2" scans repaired -- --strict
TEXT
}

fail() {
  echo "slurm_submit.sh: $1" >&2
  exit 2
}

shards=100 at_once= more=() folder=() given=()
while [ $# -gt 0 ]; do
  case "$1" in
    --shards | --at-once | --sbatch | --folder) [ $# -gt 1 ] || fail "$1: needs a value" ;;&
    --shards) shards=$2; shift 2 ;;
    --at-once) at_once=%$2; shift 2 ;;
    --sbatch) read -ra more <<<"$2"; shift 2 ;;
    --folder) read -ra folder <<<"$2"; shift 2 ;;
    --html) given+=(--html); shift ;;
    -h | --help) usage; exit 0 ;;
    -*) fail "$1 is unknown" ;;
    *) break ;;
  esac
done
if [ $# -lt 2 ]; then
  usage >&2
  exit 2
fi
scripts=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
in_dir=$(realpath "$1") out_dir=$(realpath --canonicalize-missing "$2")
shift 2
mkdir --parents "$out_dir"
logs=$out_dir/.repair_folder/logs
mkdir --parents "$logs"
words=("${folder[@]}" "${given[@]}" "$in_dir" "$out_dir" "$@")

array=$(sbatch --parsable "${more[@]}" --array="1-$shards$at_once" --output="$logs/%a.log" \
  "$scripts/cluster/slurm_array.sh" "$scripts" "${words[@]}")
merge=$(sbatch --parsable --job-name=meshrepair-merge --dependency="afterany:$array" --output="$logs/merge.log" <<JOB
#!/usr/bin/env bash
$(printf '%q ' "$scripts/repair_folder.py" --merge "${words[@]}")
JOB
)
echo "array $array, merge $merge; logs in $logs"
