"""A small data set with masks and boxes as COCO has them: `python masks_dataset.py FOLDER`.

Views all around a scene, colours as PNG, and `annotations.json` with a box and a run-length mask of each object.
"""

import json
import sys
from pathlib import Path

import numpy as np
import trigon3d

folder = Path(sys.argv[1])
random = np.random.default_rng(0)
cube = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float32) - 0.5
sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]

scene = trigon3d.Scene()
for index in range(8):
    pose = np.eye(4)
    pose[:3, :3] *= random.uniform(0.3, 0.8)
    pose[:3, 3] = random.uniform(-1.2, 1.2, 3)
    scene.add_mesh(cube, sides, material=trigon3d.Material(random.uniform(0.2, 1, 3)), pose=pose, name=f"box {index}")


def run_lengths(mask: np.ndarray) -> list[int]:
    """COCO's counts: pixels outside and inside by turns, column by column from the upper left one."""
    flat = np.concatenate([[0], mask.T.ravel(), [0]]).astype(np.int8)
    edges = np.flatnonzero(np.diff(flat))
    return np.diff(np.concatenate([[0], edges, [mask.size]])).tolist()


images, annotations = [], []
cameras = scene.surround(6, seed=1, aspect=4 / 3)
frames = scene.render_many(cameras, 320, 240, outputs=("color", "depth", "object_ids"), background="transparent")
for number, (camera, frame) in enumerate(zip(cameras, frames, strict=True)):
    name = f"{number:03}.png"
    frame.save(folder / name)
    K, pose = camera.K(320, 240).tolist(), camera.extrinsics().tolist()
    images.append({"id": number, "file_name": name, "width": 320, "height": 240, "K": K, "extrinsics": pose})
    for node in np.unique(frame.object_ids[frame.object_ids >= 0]):
        mask = frame.object_ids == node
        rows, columns = np.nonzero(mask)
        left, top = int(columns.min()), int(rows.min())
        box = [left, top, int(columns.max()) - left + 1, int(rows.max()) - top + 1]
        facts = {"id": len(annotations), "image_id": number, "category_id": int(node), "bbox": box, "iscrowd": 1}
        facts["area"], facts["mean_depth"] = int(mask.sum()), float(frame.depth[mask].mean())
        annotations.append({**facts, "segmentation": {"size": [240, 320], "counts": run_lengths(mask)}})

categories = [{"id": node["id"], "name": node["name"]} for node in scene.nodes]
data = {"images": images, "annotations": annotations, "categories": categories}
(folder / "annotations.json").write_text(json.dumps(data))
print(f"{len(images)} images with {len(annotations)} masks of {len(categories)} objects")
