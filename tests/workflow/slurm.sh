# Sourced by slurm_workflow.sh: a Slurm of one node, of the test's own, in namespaces of its own. So
# no port is anybody else's, nothing listens but on the loopback interface, and no process outlives
# the test, even one that is killed.

# contained COMMAND...: in these namespaces, as the process whose end is that of all others there;
# $folder, which may be the command's, goes when it ends or this shell is told to.
contained() {
  local namespaces=(unshare --pid --fork --kill-child --net --uts
    --propagation unchanged --mount-proc)
  if [ "$(id -u)" -ne 0 ] || ! "${namespaces[@]}" true; then
    echo "workflow: skipped: a Slurm of the test's own needs root, and namespaces"
    return 77
  fi
  folder=$(mktemp -d)
  trap end_contained EXIT
  trap 'exit 130' INT TERM HUP
  folder="$folder" setpriv --pdeathsig KILL "${namespaces[@]}" "$@" &
  supervised=$!
  local code=0
  wait "$supervised" || code=$?
  supervised=
  return "$code"
}

end_contained() {
  [ -z "$supervised" ] || kill -KILL "$supervised"
  wait_until 10 rm -rf "$folder" # the last of those killed may still be writing
}

# begin_network: the node's name and its only interface; of the tools for that python3 is always
# there. Slurm asks for its own address with AI_ADDRCONFIG, which passes 127.0.0.1 over.
begin_network() {
  python3 - <<'PYTHON'
import fcntl
import socket
import struct

SIOCSIFFLAGS, SIOCSIFADDR, IFF_UP = 0x8914, 0x8916, 1
address = struct.pack("H2x4s8x", socket.AF_INET, socket.inet_aton("127.0.0.2"))
socket.sethostname("node")
with socket.socket() as interface:
    fcntl.ioctl(interface, SIOCSIFFLAGS, struct.pack("16sH22x", b"lo", IFF_UP))
    fcntl.ioctl(interface, SIOCSIFADDR, struct.pack("16s16s8x", b"lo:1", address))
PYTHON
}

# write_slurm_conf FOLDER: three processors, whatever the machine has.
write_slurm_conf() {
  local folder=$1
  cat >"$folder/slurm.conf" <<CONF
ClusterName=oneac
SlurmctldHost=node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=1,sched_interval=1
KillWait=2
NodeName=node NodeAddr=127.0.0.1 CPUs=3 RealMemory=8000
PartitionName=all Nodes=ALL Default=YES
CONF
  # Newer ones want to be told that there are no control groups to use.
  [[ $(slurmd -V) == *" 22."* ]] || echo "CgroupPlugin=disabled" >"$folder/cgroup.conf"
  mkdir "$folder/state" "$folder/spool"
}

# wait_until SECONDS COMMAND...: false when it does not come true in time.
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.1
  done
}

node_is_idle() { [ "$(sinfo --noheader --format=%T 2>/dev/null)" = idle ]; }

# start_slurm FOLDER: its logs and state go there; exports SLURM_CONF.
start_slurm() {
  local folder=$1
  begin_network
  chmod 755 "$folder" # munge's socket is for all
  (umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
  unset "${!SLURM_@}" "${!SBATCH_@}" "${!SQUEUE_@}" "${!SINFO_@}" "${!SCANCEL_@}"
  export SLURM_CONF="$folder/slurm.conf" PATH="$PATH:/usr/sbin"
  write_slurm_conf "$folder"
  munged --foreground --key-file "$folder/munge.key" --socket "$folder/munge.socket" \
    --pid-file "$folder/munged.pid" --seed-file "$folder/munge.seed" >"$folder/munged.log" 2>&1 &
  wait_until 10 test -S "$folder/munge.socket" || return 1
  slurmctld -D -i >"$folder/slurmctld.log" 2>&1 &
  slurmd -D >"$folder/slurmd.log" 2>&1 &
  wait_until 30 node_is_idle
}
