"""Every script of `python/examples` that takes only a folder runs, and what it writes is what it says."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

# Beside the tests in the repository, and where `.ci/python` copies them.
FOLDERS = [pathlib.Path(__file__).parent / "examples", pathlib.Path(__file__).parent.parent / "examples"]
EXAMPLES = next(folder for folder in FOLDERS if folder.is_dir())
NAMES = ["model_to_picture", "calibrated_camera", "masks_dataset", "point_cloud", "from_trimesh", "turntable", "fragments"]


@pytest.fixture
def run(tmp_path):
    def run(name):
        command = [sys.executable, "-W", "error", EXAMPLES / f"{name}.py", tmp_path]
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def picture(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"))


def test_ten_lines_from_a_model_to_a_picture(run, tmp_path):
    # A box from the upper right in front shows three of its six faces.
    assert len(json.loads(run("model_to_picture").split("seen: ")[1])) == 3
    depth = np.load(tmp_path / "depth.npy")
    assert picture(tmp_path / "picture.png").shape == (480, 640, 4) and 0.05 < np.isfinite(depth).mean() < 0.95


def test_a_calibrated_camera_measures_what_is_there(run, tmp_path):
    words = run("calibrated_camera").split()
    assert float(words[words.index("m,") - 1]) < 1e-3 and float(words[-2]) < 1e-3
    points = np.loadtxt(tmp_path / "points.xyz")
    expected = 0.1 * np.sin(5 * points[:, 0]) * np.cos(4 * points[:, 1])
    assert np.abs(points[:, 2] - expected).max() < 5e-3, "they lie on the wavy square"


def test_masks_boxes_and_areas_agree(run, tmp_path):
    run("masks_dataset")
    data = json.loads((tmp_path / "annotations.json").read_text())
    assert len(data["images"]) == 6 and len(data["categories"]) == 8 and len(data["annotations"]) > 20
    covered = {image["id"]: np.zeros((240, 320), int) for image in data["images"]}
    for each in data["annotations"]:
        counts = each["segmentation"]["counts"]
        inside = np.repeat(np.arange(len(counts)) % 2, counts)
        mask = inside.reshape(320, 240).T
        left, top, width, height = each["bbox"]
        assert mask.sum() == each["area"] == mask[top : top + height, left : left + width].sum()
        assert mask[top].any() and mask[:, left].any() and mask[top + height - 1].any() and mask[:, left + width - 1].any()
        covered[each["image_id"]] += mask
    for image in data["images"]:
        assert covered[image["id"]].max() == 1, "a pixel belongs to one object"
        alpha = picture(tmp_path / image["file_name"])[..., 3]
        assert (alpha[covered[image["id"]] == 1] > 0).all(), "what is masked is drawn"


def test_a_cloud_is_where_its_points_are(run, tmp_path):
    text = run("point_cloud")
    assert 0.95 < float(text.split("middle: ")[1].split()[0]) < 1.01 and "node 0" in text
    assert len(np.unique(picture(tmp_path / "points.png").reshape(-1, 4), axis=0)) > 500


def test_a_scene_of_trimesh_is_drawn(run, tmp_path):
    lines = run("from_trimesh").splitlines()
    assert [line.split()[0] for line in lines] == ["ball", "box"] and all(int(line.split()[2]) > 5000 for line in lines)
    assert picture(tmp_path / "trimesh.png").shape == (480, 640, 4)


def test_a_turntable_has_different_pictures(run, tmp_path):
    run("turntable")
    with Image.open(tmp_path / "turntable.gif") as image:
        assert image.n_frames == 24 and image.size == (240, 240)
        first = np.asarray(image.convert("RGB")).astype(int)
        image.seek(12)
        assert np.abs(np.asarray(image.convert("RGB")).astype(int) - first).max() > 30


def test_fragments_interpolate_what_the_renderer_does(run, tmp_path):
    text = run("fragments")
    assert float(text.split()[-1]) < 1e-4
    with np.load(tmp_path / "fragments.npz") as data:
        seen = data["pix_to_face"] >= 0
        assert (data["zbuf"][~seen] == -1).all() and np.allclose(data["bary_coords"][seen].sum(-1), 1, atol=1e-5)
        assert data["image"][seen].min() >= 0 and data["image"].max() <= 1


def test_all_of_these_are_tested():
    """Others, such as those that need a cluster, have tests of their own."""
    source = pathlib.Path(__file__).read_text()
    assert all((EXAMPLES / f"{name}.py").is_file() and f'run("{name}")' in source for name in NAMES)
