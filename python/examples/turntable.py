"""An animation: a model on a turntable whose surface moves, as a GIF: `python turntable.py FOLDER`. It needs Pillow."""

import sys
from pathlib import Path

import numpy as np
import trigon3d
from PIL import Image

folder = Path(sys.argv[1])
count, rings, sectors = 24, 24, 48
theta, phi = np.meshgrid(np.linspace(0.001, np.pi - 0.001, rings), np.linspace(0, 2 * np.pi, sectors + 1), indexing="ij")
direction = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], axis=-1)
first = (np.arange(rings - 1)[:, None] * (sectors + 1) + np.arange(sectors)).reshape(-1, 1)


def surface(time: float) -> np.ndarray:
    """The vertices at a time from 0 to 1."""
    waves = 1 + 0.08 * np.sin(2 * np.pi * time + 6 * theta) * np.sin(theta)
    return (direction * waves[..., None]).reshape(-1, 3)


scene = trigon3d.Scene()
material = trigon3d.Material((0.9, 0.5, 0.2), metallic=0.0, roughness=0.35)
node = scene.add_mesh(surface(0), first + [0, 1, sectors + 2, sectors + 1], smooth_angle=60.0, material=material)
camera = trigon3d.Camera.look_at((0, 1.2, 4), (0, 0, 0), vertical_fov=38)

pictures = []
for index in range(count):
    turn = 2 * np.pi * index / count
    pose = np.eye(4)
    pose[[0, 0, 2, 2], [0, 2, 0, 2]] = np.cos(turn), np.sin(turn), -np.sin(turn), np.cos(turn)
    scene.set_pose(node, pose)
    scene.set_vertices(node, surface(index / count))
    pictures.append(Image.fromarray(scene.render(240, 240, camera).color[..., :3]))
pictures[0].save(folder / "turntable.gif", save_all=True, append_images=pictures[1:], duration=60, loop=0)
print(f"{count} pictures in {folder / 'turntable.gif'}")
