#!/bin/bash
# Other renderers' images of the workloads, and their times beside trigon's.
#
# usage: tests/peers/rivals.sh images FOLDER   draw W2 to W6 with every peer, as RENDERER-WORKLOAD.png
#        tests/peers/rivals.sh times [ROUNDS]  time everything in turn, and print crates/study/rivals/times.csv
#
# The programs are in tests/peers/rivals, where ./setup.sh has to be run once. To publish: images, then `cargo run --release
# -p trigon-study --example rivals -- FOLDER > crates/study/rivals/errors.csv`, then on a machine that does nothing else
# times > crates/study/rivals/times.csv, then trigon-study.
set -e
[ $# -ge 1 ] || { sed -n '2,9s/^# \?//p' "$0"; exit 2; }
cd "$(dirname "$0")/../.."
. tests/peers/rivals/env.sh
build
workloads="W2 W3 W4 W5 W6"

# The peers with their settings of threads for one and for two cores.
one_core="llvmpipe-debian:1 llvmpipe-new:1 lavapipe-new:1 swiftshader:1 euc:1 retrofire:1"
two_cores="llvmpipe-debian:2+1 llvmpipe-new:2+1 lavapipe-new:2+1 swiftshader:2"
supersampled="llvmpipe-new-2x2 llvmpipe-new-4x4"

images() {
    mkdir -p "$1"
    export PEERS_PNG=$(cd "$1" && pwd) PEERS_REPS=1
    for each in $one_core; do one "${each%%:*}" "${each#*:}" $workloads >&2; done
    for each in $supersampled; do one $each 1 W2 W3 W4 W5 >&2; done
}

# trigon's lines have the same form as the peers': renderer,workload,threads,work,ms,ms,...
own() {
    local program=target/release/examples/workloads pin=""
    [ "$1" = 1 ] && pin="taskset -c 0"
    local options="--threads $1 --repetitions $PEERS_REPS --samples $PEERS_SAMPLES"
    for preset in draft standard high reference; do
        $pin $program $options --preset $preset W2 W3 W4 W5 >&2
    done
    $pin $program $options W6 >&2
    # Where the best level is another one, that of most machines, too.
    if grep -qm1 avx512f /proc/cpuinfo; then
        $pin $program $options --simd avx2 --preset draft W2 W3 W4 W5 >&2
        $pin $program $options --simd avx2 W6 >&2
    fi
}

# Each frame warms up within its process; rounds take turns, so that a slow minute of the machine falls on all.
times() {
    cargo build --release -p trigon-study --example workloads
    export PEERS_SAMPLES=$(mktemp) PEERS_REPS=5
    for _ in $(seq "$1"); do
        for each in $one_core $two_cores; do (one "${each%%:*}" "${each#*:}" $workloads) >&2; done
        for each in $supersampled; do (one $each 1 W2 W3 W4 W5; one $each 2+1 W2 W3 W4 W5) >&2; done
        own 1
        own 2
    done
    echo "# $(date -u +%F), commit $(git rev-parse --short=8 HEAD), $(grep -m1 'model name' /proc/cpuinfo | sed 's/.*: //'), $1 rounds of 5 frames"
    echo "renderer,workload,threads,low,median,high"
    python3 - "$PEERS_SAMPLES" <<'PYTHON'
import sys

pooled = {}
for line in open(sys.argv[1]):
    renderer, workload, threads, _, *times = line.strip().split(",")
    threads = 2 if threads in ("2", "2+1") else 1
    pooled.setdefault((renderer, workload, threads), []).extend(map(float, times))
for (renderer, workload, threads), times in sorted(pooled.items()):
    times.sort()
    low, median, high = (times[(len(times) - 1) * quarter // 4] for quarter in (1, 2, 3))
    print(f"{renderer},{workload},{threads},{low:.4f},{median:.4f},{high:.4f}")
PYTHON
    rm "$PEERS_SAMPLES"
}

case $1 in
    images) images "${2:-target/rivals}";;
    times) times "${2:-5}";;
    *) echo "there is no $1" >&2; exit 2;;
esac
