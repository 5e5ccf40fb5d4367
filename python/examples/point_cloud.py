"""A cloud of points in its colours, and which points are seen: `python point_cloud.py FOLDER`."""

import sys
from pathlib import Path

import numpy as np
import trigon3d

folder = Path(sys.argv[1])
random = np.random.default_rng(0)
directions = random.normal(size=(20_000, 3))
points = directions / np.linalg.norm(directions, axis=1, keepdims=True) * random.uniform(0.97, 1, (20_000, 1))
colors = (points + 1) / 2

scene = trigon3d.Scene()
node = scene.add_points(points, colors=colors)
camera = scene.overview(4 / 3)
frame = scene.render(640, 480, camera, outputs=("color", "depth"), point_size=4, background=(0.1, 0.1, 0.12))
frame.save(folder / "points.png")

# What a pixel of the cloud is, and where: the depth as a measured image would have it.
K, pose = camera.K(640, 480, convention="opencv"), camera.pose("opencv")
rows, columns = np.nonzero(np.isfinite(frame.depth))
local = np.linalg.inv(K) @ [columns, rows, np.ones(len(rows))] * frame.depth[rows, columns]
measured = (pose[:3, :3] @ local).T + pose[:3, 3]
print(f"{len(measured)} pixels show the cloud; their distances from its middle: {np.linalg.norm(measured, axis=1).mean():.3f}")
middle = scene.pick(320, 240, 640, 480, camera, point_size=4)
print("in the middle:", "nothing" if middle is None else f"node {middle['node']} at {np.round(middle['position'], 3).tolist()}")
