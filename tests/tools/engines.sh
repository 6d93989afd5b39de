#!/usr/bin/env bash
# engines.sh ENGINE PROGRAM: what `rheonet sweep --ENGINE` prints runs on the real engine, here on this host alone. A sweep in 1, 7 and
# 64 shards gives the same bytes as without shards, although tasks are killed, or the processes of the engine, and the sweep is resumed. It exits
# with 77 (skipped) where the engine is missing, or cannot be started.
set -euo pipefail
engine=$1 program=$2
folder=$(mktemp -d)
daemons=()  # Processes.
node=       # The process of the daemon that starts tasks.
finish() {
  [ ${#daemons[@]} -eq 0 ] || kill "${daemons[@]}" $node 2>/dev/null || true
  wait
  rm -rf "$folder"
}
trap finish EXIT
skip() { echo "skipped: $1"; exit 77; }
fail() { echo "$1"; exit 1; }
cd "$folder"
unset RHEONET

cat >scene.toml <<'TOML'
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/m" }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = 1
record = ["k1.force"]
TOML
sweep=(sweep scene.toml --vary 'k1.stiffness=normal(100 N/m, 5 %)' 'm1.mass=lognormal(1 kg, 0.1)' --correlate k1.stiffness,m1.mass=0.5 --random 1000
  --measure 'max(k1.force)' 'time of crossing(k1.force, 0 N)')
"$program" "${sweep[@]}" -q -o whole.csv

# The program, but those shards that the file `victims` names are killed when they are begun for the first time. If there is a file `engine`, the
# processes that it names are killed too, and the parent of the shard that has $parent in its command line: the process that the engine starts tasks with.
parent=slurmstepd
[ "$engine" = slurm ] || parent=bin/parallel
cat >program <<SH
#!/bin/bash
shard=\$(sed -n 's,.*--shard \([0-9]*\)/.*,\1,p' <<<"\$*")
if [ -n "\$shard" ] && grep -qxe all -e "\$shard" "$folder/victims" && mkdir "$folder/killed-\$shard" 2>/dev/null; then
  timeout -s KILL 0.03 "$program" "\$@"
  if [ -e "$folder/engine" ]; then
    pid=\$PPID
    until [ "\$pid" -le 1 ] || grep -q $parent "/proc/\$pid/cmdline"; do pid=\$(sed 's,.*) ,,' "/proc/\$pid/stat" | cut -d ' ' -f 2); done
    [ "\$pid" -gt 1 ] && kill -KILL \$(cat "$folder/engine") "\$pid" && touch "$folder/engine-killed"
  fi
  kill -KILL \$\$
fi
exec "$program" "\$@"
SH
chmod +x program
export RHEONET=$folder/program

# The script for so many shards: the sweep is far too short for more than one.
script() {
  "$program" "${sweep[@]}" -o out.csv "--$engine" >script.sh 2>message
  grep -q 'in 1 shard of about' message || fail "a short sweep is divided: $(cat message)"
  sed -i "s,--array=1-1\$,--array=1-$1,; s,\(--shard [^/]*\)/1 ,\1/$1 ,; s,::: 1\$,::: {1..$1},; s,out.shard-1.csv,out.shard-{1..$1}.csv," script.sh
}

check_shards() {
  [ "$(ls -d killed-* | wc -l)" -eq "$2" ] || fail "of $1 shards $(ls -d killed-* | wc -l) were killed, not $2"
  cmp whole.csv out.csv
  [ "$(ls out.shard-*.csv | wc -l)" -eq "$1" ] || fail "expected $1 shards"
  rm -rf out* killed-*
}

if [ "$engine" = parallel ]; then
  command -v parallel >/dev/null || skip "GNU parallel is missing (Debian: parallel)"
  export HOME=$folder
  echo all >victims
  for shards in 1 7 64; do
    script "$shards"
    bash script.sh -j 2 2>log || { cat log; exit 1; }
    check_shards "$shards" "$shards"
  done
  # When an engine is killed, its other tasks live on for a while. They write to the files that the next engine resumes.
  touch engine
  for victim in 1:1 7:3 64:40; do
    echo "${victim#*:}" >victims
    script "${victim%:*}"
    bash script.sh -j 2 >log 2>&1 && fail "a killed engine is not reported"
    [ -e engine-killed ] || fail "the engine was not killed: $(cat log)"
    bash script.sh -j 2 2>log || { cat log; exit 1; }
    check_shards "${victim%:*}" 1
    rm engine-killed
  done
  exit 0
fi

for tool in munged slurmctld slurmd sbatch; do command -v "$tool" >/dev/null || skip "$tool is missing (Debian: slurm-wlm, munge)"; done
[ "$(id -u)" -eq 0 ] || skip "only root starts Slurm's daemons"
chmod 755 "$folder"
mkdir state spool
head -c 128 /dev/urandom >key
chmod 600 key
cat >slurm.conf <<CONF
ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
AuthInfo=socket=$folder/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort=26817
SlurmdPort=26818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
NodeName=localhost NodeAddr=127.0.0.1 CPUs=16 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
munged --force --foreground --key-file=key --socket="$folder/munge.socket" --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" \
  --seed-file="$folder/munge.seed" >munged.out 2>&1 &
daemons+=($!)
for _ in $(seq 50); do [ -S munge.socket ] && break; sleep 0.1; done
slurmctld -D -c >slurmctld.log 2>&1 &
daemons+=($!)
# Starts the daemon of the node. Returns 1 if it does not answer.
start_node() {
  slurmd -D -N localhost >>slurmd.log 2>&1 &
  node=$!
  for _ in $(seq 100); do
    if grep -qE 'idle|mixed|allocated|completing' <<<"$(sinfo -h -o %T 2>/dev/null)"; then return 0; fi
    sleep 0.2
  done
  return 1
}
start_node || { tail -n 5 munged.out slurmctld.log slurmd.log; skip "Slurm does not start here"; }

# Submits the script and waits until no task of it is left. (sbatch --wait asks only every few seconds.)
submit() {
  job=$(sbatch --parsable "$@" script.sh)
  local left
  until left=$(squeue -h -j "$job" 2>>log) && [ -z "$left" ]; do sleep 0.1; done
}
merge() { bash script.sh merge 2>log || { cat log out*.log; exit 1; }; }

echo all >victims
for shards in 1 7; do
  script "$shards"
  submit
  grep -q JobState=FAILED <<<"$(scontrol show job "$job")" || fail "a killed task is not reported"
  submit
  merge
  check_shards "$shards" "$shards"
done
script 64
echo 3 >victims
submit
submit --array=3
merge
check_shards 64 1

# The host goes down: its daemon, the process that looks after a task, and the task. With 64 tasks, the other 63 run first: the
# controller would wait a minute for each that the daemon loses.
for victim in 1:1 7:4 64:40; do
  shards=${victim%:*} tasks=()
  echo "${victim#*:}" >victims
  script "$shards"
  if [ "$shards" -eq 64 ]; then
    tasks=(--array=40)
    submit --array=1-39,41-64
  fi
  echo "$node" >engine
  job=$(sbatch --parsable "${tasks[@]}" script.sh)
  for _ in $(seq 200); do [ -e engine-killed ] && break; sleep 0.1; done
  [ -e engine-killed ] || fail "the engine was not killed"
  rm engine engine-killed
  start_node || fail "the daemon of the node does not start again"
  scancel "$job"
  submit "${tasks[@]}"
  merge
  check_shards "$shards" 1
done
