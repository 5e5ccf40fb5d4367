"""What a differentiable renderer calls fragments, and shading by them: `python fragments.py FOLDER`.

`pix_to_face`, `zbuf` and `bary_coords` as in PyTorch3D, from which any attribute of vertices is interpolated. The
arrays share their memory with torch by `torch.from_dlpack`; here NumPy does the rest.
"""

import sys
from pathlib import Path

import numpy as np
import trigon3d

folder = Path(sys.argv[1])
random = np.random.default_rng(2)
vertices = random.uniform(-1, 1, (40, 3)).astype(np.float32)
faces = random.permuted(np.tile(np.arange(40), (30, 1)), axis=1)[:, :3]
attributes = random.uniform(0, 1, (40, 3)).astype(np.float32)

scene = trigon3d.Scene()
scene.add_mesh(vertices, faces)
camera = scene.overview(1.0)
# One sample in the middle of each pixel, as PyTorch3D has it.
frame = scene.render(256, 256, camera, outputs=("triangle_ids", "barycentrics", "depth"), samples=1)
pix_to_face, bary_coords = frame.triangle_ids, frame.barycentrics
zbuf = np.where(np.isinf(frame.depth), -1, frame.depth)

seen = pix_to_face >= 0
image = np.zeros((256, 256, 3), np.float32)
image[seen] = np.einsum("pc,pcd->pd", bary_coords[seen], attributes[faces[pix_to_face[seen]]])

# The same by colours of vertices, which the renderer interpolates itself.
check = trigon3d.Scene()
check.add_mesh(vertices, faces, colors=attributes, material=trigon3d.Material((1, 1, 1), unlit=True))
albedo = check.render(256, 256, camera, outputs="albedo", samples=1).albedo
linear = np.where(attributes <= 0.04045, attributes / 12.92, ((attributes + 0.055) / 1.055) ** 2.4)
again = np.einsum("pc,pcd->pd", bary_coords[seen], linear[faces[pix_to_face[seen]]])
print(f"{seen.sum()} fragments from {zbuf[seen].min():.2f} to {zbuf[seen].max():.2f}; colours agree to {np.abs(again - albedo[seen]).max():.1e}")

np.savez(folder / "fragments.npz", pix_to_face=pix_to_face, zbuf=zbuf, bary_coords=bary_coords, image=image)
