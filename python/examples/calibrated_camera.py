"""A calibrated camera, and points that are measured in its image: `python calibrated_camera.py FOLDER`.

The depth of every pixel becomes a point of the world, by K and the pose alone, and is projected back.
"""

import sys
from pathlib import Path

import numpy as np
import trigon3d

folder = Path(sys.argv[1])
width, height = 320, 240

# A wavy square of 40 × 40 faces.
x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
vertices = np.stack([x, y, 0.1 * np.sin(5 * x) * np.cos(4 * y)], axis=-1).reshape(-1, 3)
first = (np.arange(40)[:, None] * 41 + np.arange(40)).reshape(-1, 1)
scene = trigon3d.Scene()
scene.add_mesh(vertices, first + [0, 1, 42, 41], smooth_angle=60.0)

# As OpenCV has it: K, and the matrix from the world to the camera. Y is down and Z forward.
K = np.array([[310.0, 0, 158.5], [0, 305.0, 121.0], [0, 0, 1]])
extrinsics = np.array([[1, 0, 0, 0.1], [0, -0.8, -0.6, 0.05], [0, 0.6, -0.8, 2.5], [0, 0, 0, 1]])
camera = trigon3d.Camera.from_intrinsics(K, width, height, np.linalg.inv(extrinsics), convention="opencv")
frame = scene.render(width, height, camera, outputs=("color", "depth", "positions", "face_ids"))
frame.save(folder / "calibrated.png")

rows, columns = np.nonzero(frame.face_ids >= 0)
pixels = np.stack([columns, rows, np.ones_like(rows)])
local = np.linalg.inv(K) @ pixels * frame.depth[rows, columns]
world = (np.linalg.inv(extrinsics) @ np.vstack([local, np.ones(len(rows))]))[:3].T
error = np.abs(world - frame.positions[rows, columns]).max()
back = camera.project(world, width, height, convention="opencv")
print(f"{len(rows)} pixels: positions agree to {error:.1e} m, projections to {np.abs(back - pixels[:2].T).max():.1e} pixels")
np.savetxt(folder / "points.xyz", world, fmt="%.5f")
