#!/usr/bin/env bash
# Makes smooth models of about 63,000 and 1,000,000 triangles from a model of polygons, in each format, for f3d_pairs.sh.
#
#   tests/peers/f3d_models.sh FOLDER MODEL
#
# Suzanne of Blender has 500 faces: 62,976 and 1,007,616 triangles.
set -euo pipefail
folder=${1:?where the models go}
model=${2:?a model of polygons}
cd "$(dirname "$0")/../.."
editor=${CARGO_TARGET_DIR:-target}/release/trigon-editor
[ -x "$editor" ] || cargo build --release -p trigon-editor
mkdir -p "$folder"

for levels in 3 5; do
    script=$folder/smooth$levels.json
    cat > "$script" <<EOF
{ "version": 1, "commands": [
{ "op": "select_all" }, { "op": "edit_objects" }, { "op": "set_element_kind", "kind": "face" }, { "op": "select_all" },
{ "op": "catmull_clark", "levels": $levels }, { "op": "select_all" }, { "op": "shade", "smooth": true },
{ "op": "leave_edit_mode" } ] }
EOF
    for ending in ply stl off obj glb; do
        # A GLB of the editor holds the polygons, too, unless it is exported with an up axis.
        "$editor" --quiet --run "$script" --triangulate --accept-losses --up +Y \
            --output "$folder/smooth$levels.$ending" "$model"
    done
done
