#!/bin/bash
# Rays through four scenes with trigon, Embree and tinybvh in turns on one core: a table of millions of rays a second.
#
# usage: tests/peers/rays.sh TINYBVH FOLDER [ROUNDS] [NAME=PROGRAM ...]
#
# TINYBVH is a folder with tiny_bvh.h (github.com/jbikker/tinybvh). FOLDER is where scenes, rays and results go. EMBREE names
# a folder with include and lib of an Embree 3 or 4 if it is not installed (Debian: libembree-dev). Each PROGRAM is trigon's
# example `rays` built from another commit, to be compared in the same run. The processor's CORE (0) runs everything.
# SCENES and PEERS are all unless set. Raw lines are in FOLDER/lines.csv.
set -e
[ $# -ge 2 ] || { sed -n '2,9s/^# \?//p' "$0"; exit 2; }
cd "$(dirname "$0")/../.."
tinybvh=$1 folder=$2 rounds=${3:-5}
shift $(($# < 3 ? $# : 3))
scenes=${SCENES:-hall car foliage stadium}
peers=${PEERS:-embree embree-robust embree-high tinybvh tinybvh-high}
export RAYON_NUM_THREADS=1
mkdir -p "$folder"

cargo build --release -p trigon-study --example rays
trigon=target/release/examples/rays
paths=() version=3
if [ -n "$EMBREE" ]; then paths=(-I "$EMBREE/include" -L "$EMBREE/lib" "-Wl,-rpath,$EMBREE/lib"); fi
if [ -e "${EMBREE:-/usr}/include/embree4" ]; then version=4; fi
g++ -O3 -mavx2 -mfma -std=c++17 -w -I "$tinybvh" tests/peers/rays/rays.cpp "${paths[@]}" -lembree$version -o "$folder/peers"
$trigon --write "$folder"

# Rounds take turns, so that a slow minute of the machine falls on all.
for _ in $(seq "$rounds"); do
    for scene in $scenes; do
        taskset -c "${CORE:-0}" $trigon "$folder" "$scene"
        for other in "$@"; do
            taskset -c "${CORE:-0}" "${other#*=}" "$folder" "$scene" | sed "s/^trigon,/${other%%=*},/"
        done
        for peer in $peers; do taskset -c "${CORE:-0}" "$folder/peers" "$folder" 5 "$scene" "$peer"; done
    done
done > "$folder/lines.csv"

python3 - "$folder/lines.csv" <<'PYTHON'
import statistics
import sys

rates, differences, names = {}, {}, []
for line in open(sys.argv[1]):
    name, scene, row, rate, *counts = line.strip().split(",")
    if name not in names:
        names.append(name)
    rates.setdefault((scene, row), {}).setdefault(name, []).append(float(rate))
    if any(map(int, counts[1:])):
        differences[scene, row, name] = ", ".join(counts[1:])
compared = [name for name in names if name != "trigon" and not name.endswith(("-high", "-packets"))]
print("| scene, rays | " + " | ".join(names + [f"trigon / {name}" for name in compared]) + " |")
print("|" + "---|" * (1 + len(names) + len(compared)))
for (scene, row), measured in rates.items():
    def cell(name):
        return f"{statistics.median(measured[name]):.{0 if row == 'build' else 2}f}" if name in measured else ""

    # Each of one round, so that the machine's speed cancels.
    def ratio(name):
        return f"{statistics.median(a / b for a, b in zip(measured['trigon'], measured[name])):.2f}"

    unit = ", ms" if row == "build" else ""
    print(f"| {scene} {row}{unit} | " + " | ".join([cell(name) for name in names] + [ratio(name) for name in compared]) + " |")
print("\nOther hits than trigon's when it wrote the rays (trigon: all; peers: misses, extra hits, other distances):")
for (scene, row, name), counts in differences.items():
    print(f"{scene} {row} {name}: {counts}")
PYTHON
