"""Ten lines from a file to colours, depth and ids: `python model_to_picture.py FOLDER [MODEL]`."""

import sys
from pathlib import Path

import numpy as np
import trigon3d

folder = Path(sys.argv[1])
model = sys.argv[2] if len(sys.argv) > 2 else folder / "box.obj"
if len(sys.argv) <= 2:
    corners = [f"v {x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    model.write_text("\n".join([*corners, "f 1 2 4 3", "f 5 7 8 6", "f 1 5 6 2", "f 3 4 8 7", "f 1 3 7 5", "f 2 6 8 4"]))

scene = trigon3d.load(model)
frame = scene.render(640, 480, outputs=("color", "depth", "object_ids", "face_ids"))
frame.save(folder / "picture.png")
np.save(folder / "depth.npy", frame.depth)

seen = frame.object_ids >= 0
print(f"{seen.mean():.0%} of the picture, from {frame.depth[seen].min():.2f} to {frame.depth[seen].max():.2f}")
print("nodes:", sorted({scene.nodes[index]["name"] for index in np.unique(frame.object_ids[seen])}))
print("faces that are seen:", np.unique(frame.face_ids[seen]).tolist())
