"""A scene of trimesh, drawn without a window: `python from_trimesh.py FOLDER`. It needs trimesh."""

import sys
from pathlib import Path

import numpy as np
import trigon3d
import trimesh

folder = Path(sys.argv[1])
source = trimesh.Scene()
ball = trimesh.creation.icosphere(subdivisions=3, radius=0.6)
ball.visual.vertex_colors = np.c_[(ball.vertices + 0.6) / 1.2 * 255, np.full(len(ball.vertices), 255)].astype(np.uint8)
box = trimesh.creation.box((1, 1, 1))
box.visual.face_colors = np.repeat([[220, 90, 60, 255], [60, 120, 220, 255]], 6, axis=0)
source.add_geometry(ball, node_name="ball", transform=trimesh.transformations.translation_matrix([-0.8, 0, 0]))
source.add_geometry(box, node_name="box", transform=trimesh.transformations.translation_matrix([0.8, 0, 0]))

# As trimesh.Scene.save_image does.
(folder / "trimesh.png").write_bytes(trigon3d.save_image(source, (640, 480)))

# The same scene again and again, with whatever outputs are needed.
scene = trigon3d.from_trimesh(source)
frame = scene.render(640, 480, outputs=("normals", "object_ids"))
for node in scene.nodes:
    print(node["name"], "in", int((frame.object_ids == node["id"]).sum()), "pixels")
