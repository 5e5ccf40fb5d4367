"""Scenes from arrays, against what can be computed by hand, and what is refused."""

import threading

import numpy as np
import pytest
import trigon3d
from exact_rays import nearest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
ALL = (
    "color", "radiance", "depth", "object_ids", "face_ids", "material_ids", "triangle_ids", "barycentrics",
    "positions", "normals", "geometric_normals", "uvs", "albedo",
)  # fmt: skip


@pytest.fixture
def square():
    scene = trigon3d.Scene()
    scene.add_mesh(SQUARE, [[0, 1, 2], [0, 2, 3]], uvs=SQUARE[:, :2] * [0.5, -0.5] + 0.5)
    return scene


@pytest.fixture
def camera():
    return trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0), vertical_fov=40)


def test_every_output_has_its_shape_type_and_background(square, camera):
    frame = square.render(40, 30, camera, outputs=ALL)
    shapes = {name: getattr(frame, name).shape for name in ALL}
    assert shapes["color"] == shapes["radiance"] == (30, 40, 4)
    assert all(shapes[name] == (30, 40) for name in ALL if name.endswith("_ids") or name == "depth")
    assert shapes["uvs"] == (30, 40, 2)
    for name in ("barycentrics", "positions", "normals", "geometric_normals", "albedo"):
        assert shapes[name] == (30, 40, 3)
        assert getattr(frame, name).dtype == np.float32
        assert (getattr(frame, name)[0, 0] == 0).all()
    assert frame.color.dtype == np.uint8
    assert frame.depth[0, 0] == np.inf and frame.depth[15, 20] == pytest.approx(5, abs=1e-6)
    for name in ("object_ids", "face_ids", "material_ids", "triangle_ids"):
        assert getattr(frame, name).dtype == np.int32
        assert getattr(frame, name)[0, 0] == -1 and getattr(frame, name)[15, 20] >= 0
    assert np.allclose(frame.normals[15, 20], [0, 0, 1], atol=1e-6)
    covered = frame.face_ids >= 0
    assert np.allclose(frame.barycentrics[covered].sum(axis=1), 1, atol=1e-5)
    # Texture coordinates were made from positions.
    assert np.allclose(frame.uvs[covered], frame.positions[covered][:, :2] * [0.5, -0.5] + 0.5, atol=1e-5)


def test_outputs_that_were_not_asked_for_are_none(square, camera):
    frame = square.render(8, 8, camera, outputs="depth")
    assert frame.color is None and frame.object_ids is None and frame.depth.shape == (8, 8)


def test_every_pixel_is_where_rays_in_double_precision_say(camera):
    """Ids and depths of random triangles against rays in float64."""
    random = np.random.default_rng(7)
    vertices = random.uniform(-1.5, 1.5, (60, 3)).astype(np.float32)
    faces = np.arange(60).reshape(20, 3)
    scene = trigon3d.Scene()
    scene.add_mesh(vertices, faces)
    width, height = 96, 64
    frame = scene.render(width, height, camera, outputs=("depth", "face_ids"), samples=1)
    K, pose = camera.K(width, height, convention="opengl"), camera.pose()
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    local = np.stack([(x - K[0, 2]) / K[0, 0], -(y - K[1, 2]) / K[1, 1], -np.ones_like(x)], axis=-1)
    rays = local @ pose[:3, :3].T
    ids, best, margin = nearest(vertices[faces], pose[:3, 3], rays)
    # Corners are snapped to 1/256 of a pixel; a pixel is 0.06 m here and triangles are as large as metres.
    decided = margin > 0.01
    assert decided.mean() > 0.8
    assert (frame.face_ids == ids)[decided].all()
    covered = decided & (ids >= 0)
    assert np.allclose(frame.depth[covered], best[covered], atol=2e-2)


def test_poses_and_vertices_are_changed_between_frames(square, camera):
    before = square.render(40, 30, camera, outputs=("depth",)).depth
    pose = np.eye(4)
    pose[2, 3] = 1
    square.set_pose(0, pose)
    moved = square.render(40, 30, camera, outputs=("depth",)).depth
    assert moved[15, 20] == pytest.approx(before[15, 20] - 1, abs=1e-6)
    square.set_pose(0, np.eye(4))
    square.set_vertices(0, SQUARE + [0, 0, 2])
    assert square.render(40, 30, camera, outputs=("depth",)).depth[15, 20] == pytest.approx(3, abs=1e-6)
    square.set_visible(0, False)
    assert square.render(40, 30, camera, outputs=("object_ids",)).object_ids.max() == -1
    square.remove(0)
    assert square.nodes == []


def test_colors_are_srgb_and_alike_as_bytes_and_numbers(camera):
    colors = np.array([[200, 100, 50]] * 4, dtype=np.uint8)
    frames = []
    for given in (colors, colors / 255.0, np.c_[colors, [255] * 4].astype(np.uint8)):
        scene = trigon3d.Scene()
        scene.add_mesh(SQUARE, [[0, 1, 2, 3]], colors=given, material=trigon3d.Material((1, 1, 1), unlit=True))
        frames.append(scene.render(16, 16, camera).color)
    assert (np.abs(frames[0][8, 8, :3].astype(int) - [200, 100, 50]) <= 1).all()
    assert all((np.abs(frame.astype(int) - frames[0]) <= 1).all() for frame in frames)


def test_textures_lie_as_in_gltf(camera):
    texture = np.zeros((8, 8, 3), dtype=np.uint8)
    texture[:4, :4] = [255, 0, 0]
    uvs = [[0, 1], [1, 1], [1, 0], [0, 0]]
    scene = trigon3d.Scene()
    material = trigon3d.Material((1, 1, 1), unlit=True, texture=texture)
    scene.add_mesh(SQUARE, [[0, 1, 2, 3]], uvs=uvs, material=material)
    color = scene.render(64, 64, camera).color
    assert color[24, 24, 0] == 255 and color[40, 24, 0] == color[24, 40, 0] == 0, "the first texel is the upper left one"


def test_points_and_polygons(camera):
    scene = trigon3d.Scene()
    scene.add_points([[0, 0, 0], [0.5, 0, 0]], colors=[[255, 0, 0], [0, 255, 0]])
    scene.add_mesh(
        [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [0, 1.5, -1], [-1, 1, -1]], [[0, 1, 2, 3, 4], [0, 2, 4]]
    )
    frame = scene.render(64, 48, camera, outputs=("color", "object_ids", "face_ids"), point_size=5)
    assert set(np.unique(frame.object_ids)) == {-1, 0, 1}
    assert frame.object_ids[24, 32] == 0


def test_faces_are_smooth_across_shallow_edges_alone(camera):
    """A roof whose halves meet at 20 degrees."""
    slope = np.tan(np.radians(10))
    vertices = [[-1, -1, -slope], [0, -1, 0], [0, 1, 0], [-1, 1, -slope], [1, -1, -slope], [1, 1, -slope]]
    counts = {}
    for angle in (None, 10, 30):
        scene = trigon3d.Scene()
        scene.add_mesh(vertices, [[0, 1, 2, 3], [1, 4, 5, 2]], smooth_angle=angle)
        frame = scene.render(64, 64, camera, outputs=("normals", "object_ids"))
        normals = frame.normals[frame.object_ids >= 0]
        counts[angle] = len(np.unique(normals.round(4), axis=0))
    assert counts[None] == counts[10] == 2 < counts[30]


def test_faults_are_named(square):
    assert [finding for finding in square.check() if finding["severity"] != "note"] == []
    inside_out = trigon3d.Scene()
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    inside_out.add_mesh(corners, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], name="tetrahedron")
    [finding] = [finding for finding in inside_out.check() if finding["severity"] == "error"]
    assert finding["fault"] == "inside-out" and "tetrahedron" in finding["location"] and finding["remedy"]


def test_lights(square, camera):
    studio = square.render(16, 16, camera).color[8, 8, :3].mean()
    square.add_light("directional", direction=(0, 0, 1), intensity=0.0)
    square.add_light("ambient", intensity=0.2)
    dark = square.render(16, 16, camera, lighting="scene").color[8, 8, :3].mean()
    square.add_light("point", position=(0, 0, 3), intensity=20)
    assert dark < square.render(16, 16, camera, lighting="scene").color[8, 8, :3].mean()
    assert dark < studio


@pytest.mark.parametrize(
    ("vertices", "faces", "word"),
    [
        (SQUARE[:, :2], [[0, 1, 2]], "(n, 3)"),
        (SQUARE.ravel(), [[0, 1, 2]], "two dimensions"),
        (np.array([["a", "b", "c"]]), [[0, 1, 2]], "not numbers"),
        (SQUARE * np.nan, [[0, 1, 2]], "not finite"),
        (SQUARE.astype(np.float64) * 1e300, [[0, 1, 2]], "not finite"),
        (SQUARE, [[0, 1, 4]], "names vertex 4"),
        (SQUARE, [[0, 1, -1]], "names vertex -1"),
        (SQUARE, np.array([[0, 1, 2**63]], dtype=np.uint64), "names vertex"),
        (SQUARE, np.array([[0.0, 1.0, 2.0]]), "not whole numbers"),
        (SQUARE, np.array([[0, 1]]), "3 corners or more"),
        (SQUARE, [[0, 1]], "3"),
        (SQUARE, np.zeros((0, 2), dtype=int), "3 corners"),
        (SQUARE.astype(complex), [[0, 1, 2]], "not numbers"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_arrays_that_are_no_mesh_are_refused(vertices, faces, word):
    scene = trigon3d.Scene()
    with pytest.raises(ValueError, match="(?s).*" + word.replace("(", r"\(").replace(")", r"\)")):
        scene.add_mesh(vertices, faces)
    assert scene.nodes == [], "nothing was added"


def test_any_layout_and_type_of_memory_is_the_same_mesh(camera):
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    wide = np.zeros((4, 6))
    wide[:, ::2] = SQUARE
    expected = None
    for vertices in (SQUARE, SQUARE.astype(">f8"), np.asfortranarray(SQUARE), wide[:, ::2], SQUARE.tolist()):
        for indices in (faces, faces.astype(np.uint8), faces.astype(">i2"), faces[::-1][::-1], faces.tolist()):
            scene = trigon3d.Scene()
            scene.add_mesh(vertices, indices)
            color = scene.render(16, 12, camera).color
            expected = color if expected is None else expected
            assert (color == expected).all()


@pytest.mark.parametrize(
    ("named", "error"),
    [
        ({"outputs": ("deep",)}, ValueError),
        ({"quality": "best"}, ValueError),
        ({"simd": "mmx"}, ValueError),
        ({"time_budget": -1.0}, ValueError),
        ({"background": "red"}, ValueError),
        ({"background": (1.0, 2.0, 0.0)}, ValueError),
        ({"lighting": "dark"}, ValueError),
        ({"samples": 99}, trigon3d.RenderError),
        ({"sample": 1}, TypeError),
    ],
)
def test_arguments_that_make_no_sense_are_refused(square, camera, named, error):
    with pytest.raises(error):
        square.render(8, 8, camera, **named)


def test_sizes_out_of_range_are_refused(square):
    for size in ((0, 8), (8, 0), (1 << 20, 8)):
        with pytest.raises(ValueError):
            square.render(*size)
    with pytest.raises(OverflowError):
        square.render(-1, 8)


def test_empty_scenes_and_meshes_draw_the_background():
    scene = trigon3d.Scene()
    assert scene.bounds is None
    assert scene.render(8, 6, background=(0, 0, 0)).color[..., :3].max() == 0
    scene.add_mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    assert scene.render(8, 6, outputs=("object_ids",)).object_ids.max() == -1


def test_threads_of_python_draw_the_same_scene_at_once(square, camera):
    expected = square.render(64, 48, camera).color
    shown = [None] * 8

    def draw(index):
        shown[index] = square.render(64, 48, camera, threads=1).color

    threads = [threading.Thread(target=draw, args=(index,)) for index in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((color == expected).all() for color in shown)


def test_many_scenes_leave_no_memory_behind(camera):
    import resource

    def peak(count):
        for _ in range(count):
            scene = trigon3d.Scene()
            scene.add_mesh(SQUARE, [[0, 1, 2], [0, 2, 3]])
            scene.render(16, 16, camera, samples=1, threads=1)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    first = peak(300)
    # In KiB: a kibibyte a scene at most, where a scene and its renderer take hundreds.
    assert peak(1000) < first + 1000
