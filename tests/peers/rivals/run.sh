#!/bin/bash
# run.sh PEER [workload...]: one peer with each of its thread settings. PEERS_REPS, PEERS_PNG, PEERS_STATS
# are heeded. Peers: llvmpipe-debian llvmpipe-new llvmpipe-keep lavapipe-new swiftshader euc retrofire
. "$(dirname "$0")/env.sh"
peer=$1; shift
build || exit 1
echo "peer,workload,threads,ms_median,ms_min,ms_max,unit_rate"
for c in $CONFIGS; do
    [ "${c%%:*}" = "$peer" ] && (one "$peer" "${c#*:}" "$@")
done
