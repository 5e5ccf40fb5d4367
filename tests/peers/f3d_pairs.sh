#!/usr/bin/env bash
# Draws models with trigon and with F3D in turns, both with one sample for each pixel, and writes for each model the
# middle, the shortest and the longest time and the peak memory of both, and their images side by side.
#
#   tests/peers/f3d_pairs.sh FOLDER [REPETITIONS] MODELS...
#
# Needs the release viewer, and Debian's f3d, xvfb, time, jq and imagemagick. Times mean something on a quiet machine only.
set -euo pipefail
folder=${1:?where the images go}
repetitions=${2:-5}
shift 2
cd "$(dirname "$0")/../.."
viewer=${CARGO_TARGET_DIR:-target}/release/trigon-viewer
[ -x "$viewer" ] || cargo build --release -p trigon-viewer
mkdir -p "$folder"

if [ -z "${DISPLAY:-}" ]; then
    display=$(mktemp)
    Xvfb -displayfd 5 -screen 0 1920x1080x24 5> "$display" > /dev/null 2>&1 &
    xvfb=$!
    trap 'kill "$xvfb"; rm -f "$display"' EXIT
    for _ in $(seq 50); do [ -s "$display" ] && break; sleep 0.1; done
    DISPLAY=:$(cat "$display")
    export DISPLAY
fi

size=--resolution=1000,600
# The same camera for both: from the right, above and before, 2.5 diagonals away.
camera() {
    "$viewer" --no-config --no-render --json "$1" | jq -r '
        (.size | map(. * .) | add | sqrt * 2.5 / 1.5) as $away | .center as [$x, $y, $z]
        | "--camera-position=\($x + $away),\($y + $away / 2),\($z + $away)",
          "--camera-focal-point=\($x),\($y),\($z)", "--camera-view-up=0,1,0", "--camera-view-angle=30"'
}
# Seconds and megabytes of one run, added to a file.
run() {
    local into=$1
    shift
    /usr/bin/time -a -o "$into" -f '%e %M' "$@" > /dev/null 2> "$into.said" || echo "$*: $(tail -n 1 "$into.said")" >&2
}
# The middle, the shortest and the longest time, and the peak of all runs.
summary() {
    grep -E '^[0-9.]+ [0-9]+$' "$1" | sort -n | awk '{ s[NR] = $1 } $2 > k { k = $2 }
        END { printf "%s,%s,%s,%d", s[int((NR + 1) / 2)], s[1], s[NR], k / 1024 }'
}

echo "model,trigon_s,trigon_least,trigon_most,trigon_MB,f3d_s,f3d_least,f3d_most,f3d_MB"
for model in "$@"; do
    name=$(basename "$(dirname "$model")")-$(basename "$model" | tr . -)
    ours=$folder/$name.trigon theirs=$folder/$name.f3d
    rm -f "$ours".* "$theirs".*
    mapfile -t view < <(camera "$model")
    # The first run of each warms the file cache.
    for turn in $(seq 0 "$repetitions"); do
        run "$ours.times" "$viewer" --no-config "$size" "${view[@]}" --anti-aliasing=none \
            --background-color=0.2,0.2,0.2 --output="$ours.png" "$model"
        # F3D smooths nothing unless it is asked to.
        run "$theirs.times" f3d --dry-run "$size" "${view[@]}" --bg-color=0.2,0.2,0.2 --output="$theirs.png" "$model"
        [ "$turn" -gt 0 ] || rm -f "$ours.times" "$theirs.times"
    done
    echo "$name,$(summary "$ours.times"),$(summary "$theirs.times")"
    if [ -f "$ours.png" ] && [ -f "$theirs.png" ]; then
        convert "$ours.png" "$theirs.png" +append "$folder/$name.pair.png"
    fi
done
