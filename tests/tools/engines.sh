#!/usr/bin/env bash
# engines.sh ENGINE PROGRAM: what `rheonet sweep --ENGINE` prints runs on the real engine, here on this host alone. A sweep in 7 and
# in 64 shards, one of which is killed, gives the same bytes as without shards. It exits with 77 (skipped) where the engine is
# missing, or cannot be started.
set -euo pipefail
engine=$1 program=$2
folder=$(mktemp -d)
daemons=()
finish() {
  [ ${#daemons[@]} -eq 0 ] || kill "${daemons[@]}" 2>/dev/null || true
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

# The program, but shard 3 is killed when it is begun for the first time.
cat >program <<SH
#!/bin/bash
case "\$*" in
  *"--shard 3/"*) if mkdir "$folder/killed" 2>/dev/null; then timeout -s KILL 0.05 "$program" "\$@"; kill -KILL \$\$; fi ;;
esac
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
  [ -d killed ] || fail "no shard was killed"
  cmp whole.csv out.csv
  [ "$(ls out.shard-*.csv | wc -l)" -eq "$1" ] || fail "expected $1 shards"
  rm -rf out* killed
}

if [ "$engine" = parallel ]; then
  command -v parallel >/dev/null || skip "GNU parallel is missing (Debian: parallel)"
  export HOME=$folder
  for shards in 7 64; do
    script "$shards"
    bash script.sh -j 2 2>log || { cat log; exit 1; }
    check_shards "$shards"
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
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
munged --force --foreground --key-file=key --socket="$folder/munge.socket" --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" \
  --seed-file="$folder/munge.seed" >munged.out 2>&1 &
daemons+=($!)
for _ in $(seq 50); do [ -S munge.socket ] && break; sleep 0.1; done
slurmctld -D -c >slurmctld.log 2>&1 &
daemons+=($!)
slurmd -D -N localhost >slurmd.log 2>&1 &
daemons+=($!)
idle=no
for _ in $(seq 100); do
  if grep -q idle <<<"$(sinfo -h -o %T 2>/dev/null)"; then idle=yes; break; fi
  sleep 0.2
done
[ "$idle" = yes ] || { tail -n 5 munged.out slurmctld.log slurmd.log; skip "Slurm does not start here"; }

for shards in 7 64; do
  script "$shards"
  sbatch --wait script.sh >log 2>&1 && fail "a killed task is not reported"
  sbatch --wait --array=3 script.sh >>log 2>&1 || { cat log out*.log; exit 1; }
  bash script.sh merge 2>>log || { cat log out*.log; exit 1; }
  check_shards "$shards"
done
