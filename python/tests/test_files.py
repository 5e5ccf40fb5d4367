"""Files, cameras and the command line."""

import subprocess
import sys

import numpy as np
import pytest
import trigon3d

CORNER = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 4 3 2\nf 1 2 6 5\nf 1 5 7 4\n"


@pytest.fixture
def corner(tmp_path):
    path = tmp_path / "corner.obj"
    path.write_text(CORNER)
    return path


def test_a_file_is_a_scene(corner):
    scene = trigon3d.load(corner)
    assert scene.bounds == [(0, 0, 0), (1, 1, 1)]
    assert [node["name"] for node in scene.nodes] == ["corner"]
    frame = scene.render(40, 30, outputs=("face_ids",))
    assert set(np.unique(frame.face_ids)) == {-1, 0, 1, 2}


def test_files_that_are_missing_or_broken_are_errors_that_name_them(tmp_path):
    with pytest.raises(trigon3d.LoadError, match="gone.glb"):
        trigon3d.load(tmp_path / "gone.glb")
    broken = tmp_path / "broken.glb"
    broken.write_bytes(b"glTF nothing")
    with pytest.raises(trigon3d.LoadError, match="broken.glb"):
        trigon3d.load(broken)


def test_what_is_wrong_in_a_file_is_a_warning(tmp_path):
    path = tmp_path / "odd.obj"
    path.write_text(CORNER + "f 1 2\n")
    with pytest.warns(trigon3d.TrigonWarning, match="odd.obj, line 11"):
        scene = trigon3d.load(path)
    assert scene.bounds is not None


def test_files_are_added_to_a_scene_at_a_pose(corner):
    scene = trigon3d.Scene()
    pose = np.eye(4)
    pose[0, 3] = 10
    [node] = scene.add_file(corner, pose=pose)
    assert scene.bounds == [(10, 0, 0), (11, 1, 1)]
    assert np.array_equal(scene.nodes[node]["pose"], pose)


def test_frames_are_saved(corner, tmp_path):
    from PIL import Image

    frame = trigon3d.load(corner).render(40, 30)
    frame.save(tmp_path / "o.png")
    assert frame.to_png() == (tmp_path / "o.png").read_bytes()
    with Image.open(tmp_path / "o.png") as image:
        assert (np.asarray(image) == frame.color).all()
    with pytest.raises(trigon3d.TrigonError):
        frame.save(tmp_path / "missing" / "o.png")


def test_the_command_line_draws_what_the_module_draws(corner, tmp_path):
    from PIL import Image

    output = tmp_path / "o.png"
    command = [sys.executable, "-m", "trigon3d", str(corner), "--output", str(output), "--resolution", "40x30"]
    subprocess.run(command, check=True)
    with Image.open(output) as image:
        assert (np.asarray(image) == trigon3d.load(corner).render(40, 30).color).all()
    failed = subprocess.run([*command[:3], "gone.obj", *command[4:]], capture_output=True, text=True)
    assert failed.returncode == 1 and "gone.obj" in failed.stderr


def random_rotation(random):
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return rotation * np.sign(np.linalg.det(rotation))


def test_intrinsics_and_extrinsics_go_there_and_back():
    """OpenCV's formula: u = fx X / Z + cx, with the world to camera matrix [R | t]."""
    random = np.random.default_rng(3)
    for _ in range(200):
        extrinsics = np.eye(4)
        extrinsics[:3, :3] = random_rotation(random)
        extrinsics[:3, 3] = random.uniform(-10, 10, 3)
        K = np.diag([*random.uniform(200, 900, 2), 1])
        K[:2, 2] = random.uniform(0, 640, 2)
        local = random.uniform([-3, -3, 1], [3, 3, 9], (5, 3))
        points = (local - extrinsics[:3, 3]) @ extrinsics[:3, :3]
        expected = (local / local[:, 2:]) @ K.T
        pose = np.linalg.inv(extrinsics)
        pose[3] = [0, 0, 0, 1]
        camera = trigon3d.Camera.from_intrinsics(K, 640, 480, pose, convention="opencv")
        assert np.allclose(camera.project(points, 640, 480, convention="opencv"), expected[:, :2], atol=1e-3)
        assert np.allclose(camera.K(640, 480), K) and np.allclose(camera.extrinsics(), extrinsics)
        # The same camera in the other convention: its axes turned, the pixels' centres at halves.
        flipped = pose @ np.diag([1.0, -1, -1, 1])
        halves = K.copy()
        halves[:2, 2] += 0.5
        other = trigon3d.Camera.from_intrinsics(halves, 640, 480, flipped, convention="opengl")
        assert np.allclose(other.pose("opencv"), pose)
        assert np.allclose(other.project(points, 640, 480), expected[:, :2] + 0.5, atol=1e-3)


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda: trigon3d.Camera.perspective(0), "field of view"),
        (lambda: trigon3d.Camera.perspective(40, pose=np.eye(3)), "shape"),
        (lambda: trigon3d.Camera.perspective(40, pose=2 * np.eye(4)), "last row"),
        (lambda: trigon3d.Camera.perspective(40, pose=np.diag([2.0, 1, 1, 1])), "rotation"),
        (lambda: trigon3d.Camera.perspective(40, pose=np.diag([-1.0, 1, 1, 1])), "mirror"),
        (lambda: trigon3d.Camera.perspective(40, convention="blender"), "opencv"),
        (lambda: trigon3d.Camera.perspective(40, far=2.0), "near"),
        (lambda: trigon3d.Camera.from_intrinsics([[5, 1, 2], [0, 5, 2], [0, 0, 1]], 9, 9), "skew"),
        (lambda: trigon3d.Camera.from_intrinsics(np.diag([-5.0, 5, 1]), 9, 9), "fx"),
        (lambda: trigon3d.Camera.look_at((0, 0, 0), (0, 0, 0)), "same point"),
        (lambda: trigon3d.Camera.look_at((np.nan, 0, 0), (0, 0, 1)), "finite"),
    ],
)
def test_cameras_that_make_no_sense_are_refused(make, word):
    with pytest.raises(ValueError, match=word):
        make()


def test_camera_files_are_read(tmp_path):
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 60 40 80 80 30 20\n")
    (tmp_path / "images.txt").write_text("1 0 1 0 0 -0.5 0.5 6 1 first.jpg\n\n")
    [(name, camera, size)] = trigon3d.load_cameras(tmp_path)
    assert (name, size) == ("first.jpg", (60, 40))
    assert np.allclose(camera.K(60, 40, convention="opengl"), [[80, 0, 30], [0, 80, 20], [0, 0, 1]])
    with pytest.raises(trigon3d.LoadError, match="gone.json"):
        trigon3d.load_cameras(tmp_path / "gone.json")
