#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Starts a small Slurm cluster on this machine: one controller and two nodes, all in a folder of their own.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/start_slurm.sh start FOLDER [NODES]
       scripts/start_slurm.sh stop FOLDER

  start   starts munged, slurmctld and NODES slurmd (default: 2) with their files in FOLDER, which is made, and waits until
          the nodes are idle. Then "export SLURM_CONF=FOLDER/slurm.conf" leads sbatch, squeue and the others there.
  stop    stops just these processes, by the numbers that they have written to FOLDER.

It is for tests, and to try job scripts before they go to a cluster. Needs Debian's slurmctld, slurmd, slurm-client and
munge, which scripts/setup.sh cluster installs, and root, as Slurm's daemons do.
TEXT
}

free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

write_configuration() {
  local node cpus memory
  cpus=$(nproc)
  memory=$(awk '/^MemTotal:/ { print int($2 / 1024 / 2) }' /proc/meminfo)
  cat >"$folder/slurm.conf" <<TEXT
ClusterName=meshes
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MaxArraySize=100001
MaxJobCount=100000
MpiDefault=none
ReturnToService=2
KillWait=5
SlurmdTimeout=30
TEXT
  for ((node = 1; node <= nodes; ++node)); do
    echo "NodeName=node$node NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$(free_port) CPUs=$cpus RealMemory=$memory" \
      >>"$folder/slurm.conf"
  done
  echo "PartitionName=all Nodes=node[1-$nodes] Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO" >>"$folder/slurm.conf"
}

start() {
  local node
  mkdir --parents --mode=755 "$folder" "$folder/state"
  head --bytes=1024 /dev/urandom >"$folder/munge.key"
  chmod 400 "$folder/munge.key"
  munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
  write_configuration
  slurmctld -f "$folder/slurm.conf"
  for ((node = 1; node <= nodes; ++node)); do
    mkdir --parents "$folder/spool-node$node"
    slurmd -f "$folder/slurm.conf" -N "node$node"
  done
  export SLURM_CONF=$folder/slurm.conf
  for _ in $(seq 300); do
    if [ "$(sinfo --noheader --Node --format=%t 2>/dev/null | grep --count '^idle')" = "$nodes" ]; then
      echo "started: export SLURM_CONF=$folder/slurm.conf"
      return
    fi
    sleep 0.1
  done
  echo "start_slurm.sh: the nodes do not come up; see $folder/*.log" >&2
  stop
  exit 1
}

# Their own numbers, and nobody else's.
stop() {
  local file process
  for file in "$folder"/slurmd-*.pid "$folder/slurmctld.pid" "$folder/munged.pid"; do
    [ -s "$file" ] || continue
    process=$(<"$file")
    kill "$process" 2>/dev/null || true
    for _ in $(seq 100); do
      kill -0 "$process" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL "$process" 2>/dev/null || true
    rm --force "$file"
  done
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  start | stop) [ $# -ge 2 ] || { usage >&2; exit 2; } ;;
  *) usage >&2; exit 2 ;;
esac
folder=$(realpath --canonicalize-missing "$2")
nodes=${3:-2}
"$1"
