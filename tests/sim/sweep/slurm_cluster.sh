#!/bin/bash
# Starts a private Slurm cluster (two nodes of one core on this machine), runs a command and stops the cluster:
#   slurm_cluster.sh FOLDER COMMAND...      exit status 77 if a program or root is missing, 1 if the cluster does not start,
#                                           both with a line that states the reason; otherwise that of the command
# The daemons are children of this script and keep their files in FOLDER. The system's Slurm is not touched.
set -u
folder=$(realpath -m "$1"); shift
for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || { echo "no $program here (Debian: slurm-wlm, munge)"; exit 77; }
done
((EUID == 0)) || { echo "Slurm's daemons want root"; exit 77; }

daemons=()
take_down() {
  local i
  for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do kill "${daemons[i]}" 2>/dev/null; wait "${daemons[i]}" 2>/dev/null; done
}
trap take_down EXIT
trap 'exit 130' INT TERM

mkdir -p "$folder"/{munge,state,log,run,spool/n1,spool/n2}
chmod 755 "$folder" "$folder/munge" # munge wants its socket reachable
(umask 077; head -c 128 /dev/urandom >"$folder/munge/key")
echo 'CgroupPlugin=cgroup/v1' >"$folder/cgroup.conf" # not used, but a slurmd without it asks for cgroups
# The first of three consecutive ports that can be bound. Below 32768, no outgoing connection takes them later.
port=$(python3 - $((20000 + $$ % 10000)) <<'PYTHON'
import socket
import sys

for first in range(int(sys.argv[1]), 32000, 3):
    try:
        for port in range(first, first + 3):
            with socket.socket() as listener:
                listener.bind(("", port))
    except OSError:
        continue
    print(first)
    break
PYTHON
)
[ -n "$port" ] || { echo "no three free ports from $((20000 + $$ % 10000)) to 32000"; exit 1; }
cat >"$folder/slurm.conf" <<CONF
ClusterName=hedgehop
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthInfo=socket=$folder/munge/socket,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd.%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,bf_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
MailProg=/bin/true
ReturnToService=2
KillWait=2
NodeName=n[1-2] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$folder/slurm.conf"

munged -F --socket="$folder/munge/socket" --key-file="$folder/munge/key" --pid-file="$folder/munge/pid" \
  --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" >/dev/null 2>&1 & daemons+=($!)
for ((i = 0; i < 600; i++)); do [ -S "$folder/munge/socket" ] && break; sleep 0.05; done
[ -S "$folder/munge/socket" ] || { echo "munged does not start: $(tail -n 1 "$folder/munge/log" 2>&1)"; exit 1; }
slurmctld -D >/dev/null 2>&1 & daemons+=($!)
for node in n1 n2; do slurmd -D -N $node >/dev/null 2>&1 & daemons+=($!); done
idle() { sinfo -h -N -t idle -o %N 2>/dev/null | sort -u | wc -l; }
for ((i = 0; i < 1200; i++)); do [ "$(idle)" = 2 ] && break; sleep 0.1; done
if [ "$(idle)" != 2 ]; then
  echo "Slurm's nodes do not become idle: $(tail -qn 1 "$folder"/log/*.log | tr '\n' ' ')"
  exit 1
fi
"$@"
