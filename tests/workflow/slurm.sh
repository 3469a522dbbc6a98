#!/usr/bin/env bash
# The workflow on a cluster: a Slurm of one node for as long as this runs, all of it in a temporary folder.
#
#     tests/workflow/slurm.sh RELAMP [SCANS]
#
# SCANS copies of the sample, 6 by default, of four jobs each. One is broken. Of two others a job is killed while relamp is at
# work: relamp alone, and all that the job consists of. Everything else has to be done in the end, these two at their second
# attempt with twice the memory, and nothing half-written may lie about. Needs Debian's slurm-wlm, munge and snakemake; root or not.
set -euo pipefail

root=$(readlink -f "$(dirname "$0")/../..")
relamp=$(readlink -f "${1:?"say which relamp: tests/workflow/slurm.sh build/release/apps/cli/relamp"}")
count=${2:-6}
for program in munged slurmctld slurmd sbatch snakemake; do
    command -v "$program" >/dev/null || { echo "$program is missing: apt-get install slurm-wlm munge snakemake"; exit 1; }
done

work=$(mktemp -d "${TMPDIR:-/tmp}/relamp-slurm.XXXXXX")
daemons=()
end() {
    if [[ -n ${snakemake-} ]] && kill "$snakemake" 2>/dev/null; then wait "$snakemake" || true; fi
    scancel --quiet --me 2>/dev/null || true
    for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
        if kill "${daemons[i]}" 2>/dev/null; then wait "${daemons[i]}" || true; fi
    done
    if [[ -n ${KEEP-} ]]; then echo "kept: $work"; else rm -rf "$work"; fi
}
trap end EXIT
fail() {
    echo "FAILED: $*" >&2
    tail -n 30 "$work/shelf/log" 2>/dev/null >&2
    exit 1
}

# Keys, sockets and ports of its own, so that a Slurm of this machine is not disturbed. No accounting: where sacct fails, Snakemake
# asks scontrol, which must not have forgotten the job by then (MinJobAge).
export USER=${USER:-$(id -un)} SLURM_CONF=$work/slurm.conf
mkdir -m 755 "$work"/{state,spool,shelf}
mkdir -m 700 "$work/secret"
mkdir -m 711 "$work/munge"
chmod 711 "$work"
(umask 077 && head -c 1024 /dev/urandom >"$work/secret/key")
ports=$(/usr/bin/python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for s in sockets: s.bind(("", 0))
print(*(s.getsockname()[1] for s in sockets))')
cat >"$SLURM_CONF" <<END
ClusterName=shelf
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=${ports% *}
SlurmdPort=${ports#* }
SlurmUser=$USER
SlurmdUser=$USER
AuthInfo=socket=$work/munge/socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=1,batch_sched_delay=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MinJobAge=7200
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(awk '/MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
munged --foreground --force --key-file="$work/secret/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge.log" --seed-file="$work/secret/seed" &>"$work/munged.out" &
daemons+=($!)
slurmctld -D -L "$work/slurmctld.log" &>"$work/slurmctld.out" &
daemons+=($!)
slurmd -D -L "$work/slurmd.log" &>"$work/slurmd.out" &
daemons+=($!)
for ((second = 0; second < 60; ++second)); do
    [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]] && break
    sleep 1
done
((second < 60)) || { tail -n 5 "$work"/*.log "$work"/*.out >&2; fail "Slurm did not come up"; }

cd "$work/shelf"
mkdir scans
for ((i = 1; i < count; ++i)); do cp "$root/samples/bedroom/scan.glb" "scans/room_$i.glb"; done
head -c 100000 scans/room_1.glb >scans/broken.glb
run_workflow() {
    snakemake -s "$root/workflow/Snakefile" --profile "$root/workflow/profiles/slurm" --max-status-checks-per-second 1 \
        --latency-wait 10 --config relamp="$relamp" threads=1 delight_options="--quality draft" \
        verify_options="--samples 8 --places 2000"
}
began=$SECONDS
run_workflow &>log &
snakemake=$!

# The processes of a Slurm job, of this Slurm alone; Slurm's own keeper of the job is left out, for it lives on, too, where the
# kernel ends what takes too much memory.
processes_of() {
    local folder
    for folder in /proc/[0-9]*; do
        { tr '\0' '\n' <"$folder/environ" | grep -cxF -e "SLURM_JOB_ID=$1" -e "SLURM_CONF=$SLURM_CONF"; } 2>/dev/null |
            grep -qx 2 || continue
        [[ $(cat "$folder/comm" 2>/dev/null) == slurmstepd ]] || echo "${folder#/proc/}"
    done
}
# Waits until relamp takes the light out of a room other than $1, and gives the process, its Slurm job and the room.
at_work() {
    local pid room
    while kill -0 "$snakemake" 2>/dev/null; do
        for pid in $(pgrep -f "^$relamp delight scans/room_"); do
            room=$(tr '\0' '\n' <"/proc/$pid/cmdline" | sed -n 's|^scans/\(.*\)[.]glb$|\1|p') || continue
            [[ $(readlink "/proc/$pid/cwd") == "$PWD" && $room != "$1" ]] || continue
            echo "$pid $(tr '\0' '\n' <"/proc/$pid/environ" | sed -n 's/^SLURM_JOB_ID=//p') $room"
            return
        done 2>/dev/null
        sleep 0.05
    done
    return 1
}
found=$(at_work none) || fail "snakemake ended before relamp began"
read -r process job first <<<"$found"
kill -KILL "$process"
echo "$first: relamp was killed in Slurm's job $job"
found=$(at_work "$first") || fail "snakemake ended before relamp began with another room than $first"
read -r process job second <<<"$found"
mapfile -t processes < <(processes_of "$job")
kill -KILL "${processes[@]}"
echo "$second: ${#processes[@]} processes were killed in Slurm's job $job"
wait "$snakemake" || fail "snakemake ended with an error"
took=$((SECONDS - began))

for ((i = 1; i < count; ++i)); do
    for step in info delight verify relight; do
        grep -q '"outcome": "done"' "results/room_$i/$step.json" || fail "room_$i: $step is not done"
    done
    for picture in as_scanned evening daylight; do
        [[ -s results/room_$i/relit/$picture.png ]] || fail "room_$i: no picture $picture"
    done
    # The same input gives the same bytes, in whatever attempt.
    cmp -s "results/room_$i/room/albedo.exr" "results/room_$((count - 1))/room/albedo.exr" || fail "room_$i: another albedo"
done
grep -q 'is cut off' results/report.html || fail "the report does not say what is wrong with the broken scan"
[[ ! -e results/broken/room ]] || fail "the broken scan left a room"
left=$(find results -name '.*')
[[ -z $left ]] || fail "half-written: $left"
states=$(scontrol --oneliner show job | grep -o 'JobState=[A-Z]*' | sort | uniq -c | xargs)
[[ $states == "$((4 * count)) JobState=COMPLETED 2 JobState=FAILED" ]] || fail "$states"
asked=$(scontrol --oneliner show job | grep 'JobName=snakejob_delight' | grep -o 'MinMemoryNode=[^ ]*' | sort | uniq -c | xargs)
run_workflow &>again
grep -q 'Nothing to be done' again || fail "a second run did something"
echo "$states; memory that the delights asked for: $asked; $took s"
