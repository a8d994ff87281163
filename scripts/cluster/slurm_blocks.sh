#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Repairs one mesh block by block on a Slurm cluster: a job array over its blocks, and a job that joins them.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/cluster/slurm_blocks.sh [OPTIONS] DIR OUT [-- OPTIONS OF meshrepair]

  --at-once N      blocks at a time (default: all)
  --program FILE   where meshrepair-blocks is (default: as PATH says)
  --sbatch WORDS   more options of sbatch for blocks, as "--time=8:00:00 --mem=16G --cpus-per-task=4"
  --join WORDS     more options of sbatch for the last job, as "--mem=200G"
  -h, --help       print this text

DIR is the folder that meshrepair-blocks plan has made. It is on a disk that all nodes share, and so is the program. Prints the
numbers of both jobs. The same command again, later, does what is left.

Example:
  meshrepair-blocks plan city.stl city.blocks
  scripts/cluster/slurm_blocks.sh --sbatch "--time=1:00:00 --mem=8G --cpus-per-task=2" city.blocks repaired.ply
TEXT
}

fail() {
  echo "slurm_blocks.sh: $1" >&2
  exit 2
}

at_once= program=meshrepair-blocks more=() join=()
while [ $# -gt 0 ]; do
  case "$1" in
    --at-once | --program | --sbatch | --join) [ $# -gt 1 ] || fail "$1: needs a value" ;;&
    --at-once) at_once=%$2; shift 2 ;;
    --program) program=$2; shift 2 ;;
    --sbatch) read -ra more <<<"$2"; shift 2 ;;
    --join) read -ra join <<<"$2"; shift 2 ;;
    -h | --help) usage; exit 0 ;;
    -*) fail "$1 is unknown" ;;
    *) break ;;
  esac
done
if [ $# -lt 2 ]; then
  usage >&2
  exit 2
fi
dir=$(realpath "$1") out=$(realpath --canonicalize-missing "$2")
shift 2
[ "${1-}" = -- ] && shift
for word in "$@"; do
  case "$word" in
    --block | --block=* | --threads | --threads=* | --max-memory | --max-memory=*) fail "$word: as the task of Slurm says" ;;
  esac
done
found=$(command -v "$program") || fail "there is no $program: use --program"
program=$(realpath "$found")
[ -f "$dir/plan.json" ] || fail "$dir holds no plan: meshrepair-blocks plan makes it"
blocks=$(python3 -c 'import json, sys; print(len(json.load(open(sys.argv[1]))["blocks"]))' "$dir/plan.json")
logs=$dir/logs
mkdir --parents "$logs"

# Threads and memory are those of the task. 1 is the end of a whole run: the result lacks a guarantee, and join says so.
array=$(sbatch --parsable --job-name=meshrepair-block --requeue "${more[@]}" --array="1-$blocks$at_once" --output="$logs/%a.log" \
  <<JOB
#!/usr/bin/env bash
threads=\${SLURM_CPUS_PER_TASK:-1}
memory=\${SLURM_MEM_PER_NODE:-\$((\${SLURM_MEM_PER_CPU:-0} * threads))}
[ "\$memory" -gt 0 ] && most=\$((memory * 9 / 10))M || most=80%
$(printf '%q ' "$program" run -q "$dir" "$@") --block "\$SLURM_ARRAY_TASK_ID" --threads "\$threads" --max-memory "\$most" || [ \$? -eq 1 ]
JOB
)
last=$(sbatch --parsable --job-name=meshrepair-join "${join[@]}" --dependency="afterok:$array" --kill-on-invalid-dep=yes \
  --output="$logs/join.log" <<JOB
#!/usr/bin/env bash
$(printf '%q ' "$program" join -q "$dir" "$out")
JOB
)
echo "array $array, join $last; logs in $logs"
