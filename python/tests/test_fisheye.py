"""Fisheye cameras against OpenCV's published formula, and rays in double precision."""

import json

import numpy as np
import pytest
import trigon3d
from exact_rays import nearest

WIDTH, HEIGHT = 96, 80
K = np.array([[30.0, 0, 46.5], [0, 28.0, 41.0], [0, 0, 1]])
DISTORTION = (0.02, -0.008, 0.002, -0.0003)


def published(points, distortion):
    """cv2.fisheye of OpenCV's documentation, with the angle by atan2, so that it may exceed 90 degrees."""
    x, y, z = np.asarray(points, dtype=np.float64).T
    across = np.hypot(x, y)
    theta = np.arctan2(across, z)
    k1, k2, k3, k4 = distortion
    theta_d = theta * (1 + k1 * theta**2 + k2 * theta**4 + k3 * theta**6 + k4 * theta**8)
    return np.stack([K[0, 0] * theta_d * x / across + K[0, 2], K[1, 1] * theta_d * y / across + K[1, 2]], axis=-1)


@pytest.mark.parametrize("distortion", [(0, 0, 0, 0), DISTORTION])
def test_points_are_projected_as_opencv_does(distortion):
    camera = trigon3d.Camera.fisheye(K, WIDTH, HEIGHT, distortion=distortion)
    random = np.random.default_rng(3)
    points = random.normal(size=(1000, 3)) * random.uniform(0.1, 100, (1000, 1))
    points[:, 2] = np.where(points[:, 2] < -0.5 * np.abs(points[:, 0]), -points[:, 2], points[:, 2])
    pixels = camera.project(points, WIDTH, HEIGHT, convention="opencv")
    assert np.abs(pixels - published(points, distortion)).max() < 1e-9


def rays():
    """The ray of each pixel: a table of angles, inverted by interpolation, and improved by Newton's method."""
    x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    side = np.stack([(x - K[0, 2]) / K[0, 0], (y - K[1, 2]) / K[1, 1]], axis=-1)
    radius = np.linalg.norm(side, axis=-1)
    powers = np.array([1, *DISTORTION])

    def d(theta):
        return sum(k * theta ** (2 * i + 1) for i, k in enumerate(powers))

    table = np.linspace(0, 2.2, 4000)
    theta = np.interp(radius, d(table), table)
    for _ in range(4):
        slope = sum((2 * i + 1) * k * theta ** (2 * i) for i, k in enumerate(powers))
        theta -= (d(theta) - radius) / slope
    across = side / np.maximum(radius, 1e-300)[..., None]
    return np.concatenate([np.sin(theta)[..., None] * across, np.cos(theta)[..., None]], axis=-1), theta


def test_every_pixel_is_where_rays_in_double_precision_say():
    random = np.random.default_rng(7)
    vertices = random.uniform(-1.5, 1.5, (60, 3)).astype(np.float32)
    scene = trigon3d.Scene()
    scene.add_mesh(vertices, np.arange(60).reshape(20, 3))
    fov = 210
    camera = trigon3d.Camera.fisheye(K, WIDTH, HEIGHT, distortion=DISTORTION, fov=fov)
    outputs = ("depth", "face_ids", "positions", "barycentrics")
    frame = scene.render(WIDTH, HEIGHT, camera, outputs=outputs, samples=1)
    directions, theta = rays()
    ids, best, margin = nearest(vertices.reshape(20, 3, 3), np.zeros(3), directions)
    margin = np.minimum(margin, np.abs(theta - np.radians(fov / 2)))
    beyond = theta > np.radians(fov / 2)
    best[beyond], ids[beyond] = np.inf, -1
    decided = margin > 1e-4
    assert decided.mean() > 0.98
    assert (frame.face_ids == ids)[decided].all()
    covered = decided & (ids >= 0)
    assert covered.mean() > 0.3 and (theta[covered] > np.pi / 2).any()
    assert np.allclose(frame.depth[covered], best[covered], rtol=1e-6)
    assert np.allclose(frame.positions[covered], directions[covered] * best[covered][:, None], atol=3e-6)
    assert np.allclose(frame.barycentrics[covered].sum(axis=1), 1, atol=1e-5)


def test_all_outputs_and_the_same_bytes_with_any_number_of_threads():
    scene = trigon3d.Scene()
    scene.add_mesh([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], [[0, 1, 2, 3]])
    camera = trigon3d.Camera.fisheye(K, WIDTH, HEIGHT, fov=180)
    names = ("color", "radiance", "depth", "object_ids", "normals", "geometric_normals", "uvs", "albedo", "material_ids", "triangle_ids")
    one, three = (scene.render(WIDTH, HEIGHT, camera, outputs=names, threads=threads) for threads in (1, 3))
    for name in names:
        assert (getattr(one, name) == getattr(three, name)).all(), name
    assert one.object_ids[41, 46] == 0 and one.object_ids[0, 0] == -1 and one.depth[0, 0] == np.inf
    # The triangles' front is on the other side; back faces are drawn, and their normals point to the eye.
    assert np.allclose(one.normals[41, 46], [0, 0, -1], atol=1e-6)
    # Twice as large is the same view.
    large = scene.render(2 * WIDTH, 2 * HEIGHT, camera, outputs=("object_ids",))
    assert abs((large.object_ids == 0).mean() - (one.object_ids == 0).mean()) < 0.01


def test_what_a_lens_cannot_do_is_said():
    scene = trigon3d.Scene()
    scene.add_mesh([[-1, -1, 1], [1, -1, 1], [0, 1, 1]], [[0, 1, 2]])
    camera = trigon3d.Camera.fisheye(K, WIDTH, HEIGHT)
    assert scene.plan(8, 8, camera)["edges"].startswith("off, because a fisheye lens")
    with pytest.raises(ValueError, match="time_budget"):
        scene.render(8, 8, camera, time_budget=1.0)
    with pytest.raises(ValueError, match="fisheye"):
        scene.pick(4, 4, 8, 8, camera)
    scene.add_points([[0, 0, 1]], name="dot")
    with pytest.warns(trigon3d.TrigonWarning, match="lines and points of `dot`"):
        scene.render(8, 8, camera)
    for wrong in ({"fov": 0}, {"fov": 361}, {"distortion": (np.nan, 0, 0, 0)}):
        with pytest.raises(ValueError):
            trigon3d.Camera.fisheye(K, WIDTH, HEIGHT, **wrong)
    with pytest.raises((ValueError, TypeError)):
        trigon3d.Camera.fisheye(K, WIDTH, HEIGHT, distortion=(0, 0))
    with pytest.raises(ValueError):
        trigon3d.Camera.fisheye(np.diag([0.0, 1, 1]), WIDTH, HEIGHT)


def test_camera_files_have_fisheye_lenses(tmp_path):
    lens = dict(zip(("k1", "k2", "k3", "k4"), DISTORTION))
    frame = {"transform_matrix": np.diag([1.0, -1, -1, 1]).tolist(), "file_path": "a.png"}
    center = {"cx": K[0, 2] + 0.5, "cy": K[1, 2] + 0.5, "fl_x": K[0, 0], "fl_y": K[1, 1], "w": WIDTH, "h": HEIGHT}
    file = tmp_path / "transforms.json"
    file.write_text(json.dumps({"camera_model": "OPENCV_FISHEYE", **lens, **center, "frames": [frame]}))
    [(name, camera, size)] = trigon3d.load_cameras(file)
    assert (name, size) == ("a.png", (WIDTH, HEIGHT))
    points = np.array([[0.3, 0.2, 1.0], [2.0, -1.0, 0.1]])
    pixels = camera.project(points, WIDTH, HEIGHT, convention="opencv")
    assert np.abs(pixels - published(points, DISTORTION)).max() < 1e-9
    assert np.allclose(camera.K(WIDTH, HEIGHT), K)
    moved = camera.with_pose(np.eye(4), convention="opencv")
    assert np.allclose(moved.project(points, WIDTH, HEIGHT, convention="opencv"), pixels)
