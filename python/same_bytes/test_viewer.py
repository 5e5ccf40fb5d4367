"""The module draws the same bytes as the viewer: colours, depth and ids. `.ci/python` names the viewer."""

import hashlib
import json
import multiprocessing
import os
import subprocess

import numpy as np
import pytest
import trigon3d

OUTPUTS = {"depth": "depth", "object_ids": "object-ids", "face_ids": "face-ids", "normals": "normals", "uvs": "uvs"}
SIZE = (200, 150)


def model(folder):
    """A bumpy ball and a textured square, as OBJ with MTL."""
    angles = np.linspace(0, np.pi, 20), np.linspace(0, 2 * np.pi, 40)
    theta, phi = np.meshgrid(*angles, indexing="ij")
    radius = 1 + 0.1 * np.sin(7 * phi) * np.sin(5 * theta)
    ball = radius[..., None] * np.stack(
        [np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], axis=-1
    )
    lines = ["mtllib m.mtl", "o ball", *(f"v {x} {y} {z}" for x, y, z in ball.reshape(-1, 3)), "usemtl red"]
    lines += [
        f"f {i * 40 + j + 1} {i * 40 + j + 2} {i * 40 + j + 42} {i * 40 + j + 41}" for i in range(19) for j in range(39)
    ]
    lines += ["o floor", "v -2 -1.2 -2", "v 2 -1.2 -2", "v 2 -1.2 2", "v -2 -1.2 2", "vt 0 0", "vt 3 0", "vt 3 3", "vt 0 3"]
    lines += ["usemtl grey", "f 801/1 804/4 803/3 802/2"]
    (folder / "m.obj").write_text("\n".join(lines))
    (folder / "m.mtl").write_text("newmtl red\nKd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 50\nnewmtl grey\nKd 0.5 0.5 0.5\nd 0.6\n")
    return folder / "m.obj"


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """What the viewer draws, and the file of its camera."""
    folder = tmp_path_factory.mktemp("viewer")
    path = model(folder)
    command = [os.environ["TRIGON_VIEWER"], path, "--output", folder / "o.png", "--resolution", "200,150", "--json"]
    command += ["--outputs", ",".join(OUTPUTS.values()), "--camera-azimuth-angle=25"]
    facts = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    (folder / "camera.json").write_text(facts)
    assert json.loads(facts)["camera"]
    arrays = {name: np.load(folder / f"o.{file}.npy") for name, file in OUTPUTS.items()}
    from PIL import Image

    with Image.open(folder / "o.png") as image:
        arrays["color"] = np.asarray(image)
    return folder, arrays


def draw(folder, threads):
    [(_, camera, _)] = trigon3d.load_cameras(folder / "camera.json", *SIZE)
    scene = trigon3d.load(folder / "m.obj")
    return scene.render(*SIZE, camera, outputs=("color", *OUTPUTS), threads=threads)


@pytest.mark.parametrize("threads", [1, 2])
def test_frames_are_the_viewers_bytes(drawn, threads):
    folder, arrays = drawn
    frame = draw(folder, threads)
    for name, expected in arrays.items():
        found = getattr(frame, name)
        channels = expected.shape[-1] if expected.ndim == 3 else 1
        found = found[..., :channels] if found.ndim == 3 else found
        assert found.tobytes() == np.ascontiguousarray(expected).tobytes(), name


def digest(folder):
    frame = draw(folder, 1)
    return [hashlib.sha256(getattr(frame, name).tobytes()).hexdigest() for name in ("color", *OUTPUTS)]


def test_four_processes_at_once_draw_the_same_bytes(drawn):
    folder, _ = drawn
    with multiprocessing.get_context("spawn").Pool(4) as pool:
        digests = pool.map(digest, [folder] * 8)
    assert all(each == digests[0] for each in digests)
    assert digests[0] == digest(folder)
