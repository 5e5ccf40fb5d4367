"""Hostile input: each is an error of Python that says what is wrong, or works; none ends the process or takes memory."""

import collections.abc
import copy
import json
import pickle
import resource
import threading

import numpy as np
import pytest
import trigon3d
from trigon3d import pyrender

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
FACES = np.array([[0, 1, 2], [0, 2, 3]])
HUGE = 10**12


@pytest.fixture
def scene():
    scene = trigon3d.Scene()
    scene.add_mesh(SQUARE, FACES)
    return scene


@pytest.fixture
def camera():
    return trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0), vertical_fov=40)


class Array:
    """Answers `numpy.asarray` with anything."""

    def __init__(self, answer):
        self.answer = answer

    def __array__(self, *_arguments, **_named):
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    def __len__(self):
        return 2**62


class Long(collections.abc.Sequence):
    """Says that it is longer than any memory, and holds three items."""

    def __init__(self, items):
        self.held = list(items)

    def __len__(self):
        return 2**62

    def __getitem__(self, index):
        return self.held[index]


class LongList(list):
    """As `Long`, but a list."""

    def __len__(self):
        return 2**62


class Liar(np.ndarray):
    """Says another shape and type of itself."""

    shape = property(lambda self: (10**6, 3))
    dtype = property(lambda self: np.dtype(np.int64))


WRONG_ARRAYS = {
    "text": "abc",
    "none": None,
    "number": 7,
    "dict": {"a": 1},
    "set": {1, 2},
    "generator": (row for row in SQUARE),
    "objects": np.array([[object()] * 3], dtype=object),
    "texts": np.array([["a", "b", "c"]]),
    "dates": np.zeros((2, 3), "datetime64[s]"),
    "complex numbers": np.zeros((2, 3), complex),
    "structures": np.zeros((2, 3), [("x", "f4")]),
    "bytes": np.zeros((2, 3), "S4"),
    "no axes": np.float32(1),
    "one axis": np.zeros(3),
    "three axes": np.zeros((2, 3, 1)),
    "64 axes": np.zeros((1,) * 32),
    "two columns": np.zeros((4, 2)),
    "no columns": np.zeros((4, 0)),
    "ragged": [[0, 0, 0], [1, 1]],
    "nan": np.full((4, 3), np.nan),
    "infinity": np.full((4, 3), -np.inf),
    "too large for 32 bits": np.full((4, 3), 1e300),
    "many rows of a few bytes": np.broadcast_to(np.zeros(3), (HUGE, 3)),
    "many columns of a few bytes": np.broadcast_to(np.zeros((3, 1)), (3, HUGE)),
    "more than fits in an index": np.broadcast_to(np.uint8(0), (2**31, 2**31)),
    "a failing __array__": Array(RuntimeError("no")),
    "an __array__ of something else": Array("abc"),
    "an __array__ of objects": Array(np.array([[None] * 3])),
    "a long sequence": Long([1, 2, 3]),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("kind", WRONG_ARRAYS)
def test_wrong_arrays_are_refused_everywhere(scene, camera, kind):
    value = WRONG_ARRAYS[kind]
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    calls = {
        "vertices": lambda: scene.add_mesh(value, FACES),
        "normals": lambda: scene.add_mesh(SQUARE, FACES, normals=value),
        "uvs": lambda: scene.add_mesh(SQUARE, FACES, uvs=SQUARE if kind == "two columns" else value),
        "colors": lambda: scene.add_mesh(SQUARE, FACES, colors=value),
        "points": lambda: scene.add_points(value),
        "set_vertices": lambda: scene.set_vertices(0, value),
        "pose": lambda: scene.set_pose(0, value),
        "camera": lambda: trigon3d.Camera.perspective(40, pose=value),
    }
    if kind not in ("nan", "infinity", "too large for 32 bits"):
        calls["project"] = lambda: camera.project(value, 8, 8)
        calls["texture"] = lambda: trigon3d.Material(texture=value if kind != "two columns" else value[0])
    for name, call in calls.items():
        if value is None and name in ("normals", "uvs", "colors", "camera", "texture"):
            continue
        if name == "texture" and kind in ("text", "no columns"):
            continue
        # "no" is what the array itself raised.
        with pytest.raises((ValueError, TypeError, MemoryError, RuntimeError)) as raised:
            call()
        assert str(raised.value), name
    assert len(scene.nodes) == 1
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000, "KiB"


WRONG_FACES = {
    "negative": [[0, 1, -1]],
    "out of range": [[0, 1, 4]],
    "far out of range": [[0, 1, 2**80]],
    "negative in an array": np.array([[0, 1, -(2**63)]]),
    "unsigned": np.array([[0, 1, 2**64 - 1]], dtype=np.uint64),
    "numbers with a point": [[0.0, 1.0, 2.0]],
    "truth": np.ones((2, 3), bool),
    "texts": ["abc"],
    "nested": [[[0, 1, 2]]],
    "two corners": [[0, 1]],
    "no corners": [[]],
    "none": None,
    "number": 3,
    "a corner twice is no face": [[0, 1], [2]],
    "many rows of a few bytes": np.broadcast_to(np.arange(3), (HUGE, 3)),
    "a long sequence of many": Long([2**63]),
}


@pytest.mark.parametrize("kind", WRONG_FACES)
def test_wrong_faces_are_refused(scene, kind):
    with pytest.raises((ValueError, TypeError, OverflowError, MemoryError)):
        scene.add_mesh(SQUARE, WRONG_FACES[kind])
    assert len(scene.nodes) == 1


def test_what_an_object_says_of_its_length_is_not_believed(scene, camera):
    expected = scene.render(16, 12, camera).color
    for faces in (LongList(FACES.tolist()), [LongList(face) for face in FACES.tolist()]):
        other = trigon3d.Scene()
        other.add_mesh(SQUARE, faces)
        assert (other.render(16, 12, camera).color == expected).all()
    assert trigon3d.Material(LongList([1, 0, 0])) and trigon3d.Material(Long([1, 0, 0]))
    scene.add_light(color=Long([1, 1, 1]))
    frame = scene.render(8, 8, camera, outputs=Long(["depth"]), background=Long([0, 0, 0]))
    assert frame.depth is not None and frame.color is None
    with pytest.raises(ValueError, match="5 numbers"):
        trigon3d.Material(Long([1] * 100))


def test_what_an_array_says_of_itself_is_not_believed(scene):
    for liar in (SQUARE.view(Liar), SQUARE[::-1][::-1].view(Liar)):
        node = scene.add_mesh(liar, FACES)
        assert scene.pick_box(0, 0, 8, 8, 8, 8, elements="vertices", through=True)[node].max() == 3
    with pytest.raises(ValueError, match="not whole numbers"):
        scene.add_mesh(SQUARE, FACES.astype(float).view(Liar))


def unaligned(array):
    memory = np.zeros(array.nbytes + 1, np.uint8)[1:]
    memory[:] = np.frombuffer(np.ascontiguousarray(array).tobytes(), np.uint8)
    return memory.view(array.dtype).reshape(array.shape)


def strided(array):
    wide = np.zeros((2 * array.shape[0], 3 * array.shape[1]), array.dtype)
    wide[::2, ::3] = array
    return wide[::2, ::3]


@pytest.mark.parametrize("layout", [unaligned, strided, np.asfortranarray, lambda a: a[::-1][::-1], lambda a: a[:, ::-1][:, ::-1]])
@pytest.mark.parametrize("order", ["<", ">"])
def test_any_layout_of_memory_works(scene, camera, layout, order):
    expected = scene.render(16, 12, camera).color
    for vertices, faces in ((SQUARE.astype(order + "f4"), FACES.astype(order + "i4")), (SQUARE.astype(order + "f8"), FACES)):
        other = trigon3d.Scene()
        node = other.add_mesh(layout(vertices), layout(faces), pose=layout(np.eye(4)))
        other.set_vertices(node, layout(vertices))
        assert (other.render(16, 12, camera).color == expected).all()
    # Rows that are all the same place in memory.
    assert scene.add_points(np.broadcast_to(np.float32([1, 2, 3]), (1000, 3))) == 1


@pytest.mark.parametrize(
    "call",
    [
        lambda scene: scene.surround(HUGE),
        lambda scene: scene.surround(-1),
        lambda scene: scene.surround(3, aspect=np.nan),
        lambda scene: scene.overview(np.inf),
        lambda scene: scene.overview(0.0),
        lambda scene: scene.overview(-1.0),
        lambda scene: scene.set_pose(HUGE, np.eye(4)),
        lambda scene: scene.set_visible(-1, True),
        lambda scene: scene.remove(17),
        lambda scene: scene.set_vertices(0, SQUARE[:3]),
        lambda scene: scene.add_light("directional", direction=(0, 0, 0)),
        lambda scene: scene.add_light("sun"),
        lambda scene: scene.add_light(intensity=np.nan),
        lambda scene: scene.add_light("point", position=(np.inf, 0, 0)),
        lambda scene: scene.add_light("spot", angle=91.0),
        lambda scene: scene.add_mesh(SQUARE, FACES, colors=SQUARE[:3]),
        lambda scene: scene.add_mesh(SQUARE, FACES, material={"color": 1}),
        lambda scene: scene.add_mesh(SQUARE, FACES, smooth_angle=np.nan),
        lambda scene: scene.add_mesh(SQUARE, FACES, name="\ud800"),
        lambda scene: scene.render(HUGE, 8),
        lambda scene: scene.render(8, 8, "camera"),
        lambda scene: scene.render(8, 8, threads=HUGE),
        lambda scene: scene.render(8, 8, threads=-1),
        lambda scene: scene.render(8, 8, samples=0),
        lambda scene: scene.render(8, 8, samples=2**31),
        lambda scene: scene.render(8, 8, point_size=np.nan),
        lambda scene: scene.render(8, 8, point_size=-1.0),
        lambda scene: scene.render(8, 8, line_width=np.inf),
        lambda scene: scene.render(8, 8, time_budget=np.nan),
        lambda scene: scene.render(8, 8, time_budget=1e300),
        lambda scene: scene.render(8, 8, outputs=7),
        lambda scene: scene.render(8, 8, outputs=[7]),
        lambda scene: scene.render(8, 8, background=(np.nan, 0, 0)),
        lambda scene: scene.pick_box("a", 0, 1, 1, 8, 8),
        lambda scene: trigon3d.Camera.perspective(np.nan),
        lambda scene: trigon3d.Camera.perspective(180.0),
        lambda scene: trigon3d.Camera.perspective(40, near=2.0, far=1.0),
        lambda scene: trigon3d.Camera.perspective(40, near=np.nan),
        lambda scene: trigon3d.Camera.orthographic(-1.0),
        lambda scene: trigon3d.Camera.from_intrinsics(np.full((3, 3), np.nan), 8, 8),
        lambda scene: trigon3d.Camera.from_intrinsics(np.eye(3), 0, 8),
        lambda scene: trigon3d.load("\0"),
        lambda scene: trigon3d.load(7),
        lambda scene: trigon3d.set_threads(-1),
    ],
)
def test_arguments_out_of_range_are_refused(scene, call):
    errors = (ValueError, TypeError, OverflowError, IndexError, UnicodeError, trigon3d.TrigonError)
    with pytest.raises(errors) as raised:
        call(scene)
    assert str(raised.value)
    assert len(scene.nodes) == 1 and scene.render(8, 8).color.shape == (8, 8, 4), "the scene is as it was"


@pytest.mark.parametrize("make", [trigon3d.Scene, lambda: trigon3d.Camera.perspective(40), trigon3d.Material])
def test_objects_are_copied_or_say_that_they_cannot_be(make):
    for work in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="pickle"):
            work(make())


def test_frames_outlive_everything(camera):
    def drawn():
        scene = trigon3d.Scene()
        scene.add_mesh(SQUARE, FACES)
        return scene.render(64, 48, camera, outputs=("color", "depth")), scene.render(64, 48, camera, outputs="depth").depth

    frame, depth = drawn()
    assert (frame.depth == depth).mean() > 0.95 and copy.deepcopy(depth) is not depth
    array = frame.color
    del frame
    array[:] = 0
    assert array.max() == 0, "it belongs to the caller"


def run(disturbances, works, times=100):
    """Does each work so many times in a thread, while others disturb it; returns what was raised."""
    raised, done = [], threading.Event()

    def attempt(work):
        try:
            work()
        except Exception as error:  # noqa: BLE001
            raised.append(error)

    def repeat(work):
        for _ in range(times):
            attempt(work)

    def disturb(work):
        while not done.is_set():
            attempt(work)

    disturbing = [threading.Thread(target=disturb, args=(work,)) for work in disturbances]
    working = [threading.Thread(target=repeat, args=(work,)) for work in works]
    for thread in [*disturbing, *working]:
        thread.start()
    for thread in working:
        thread.join()
    done.set()
    for thread in disturbing:
        thread.join()
    return raised


def test_arrays_may_change_while_they_are_read(camera):
    vertices, faces = np.tile(SQUARE, (500, 1)), np.tile(FACES, (500, 1))
    scene = trigon3d.Scene()
    node = scene.add_mesh(vertices, faces)

    def spoil():
        vertices[:] = np.nan
        faces[:] = 10**9
        vertices[:] = 1
        faces[:] = 0
        faces[:, 1], faces[:, 2] = 1, 2

    def resize():
        vertices.shape = (6000, 1)
        vertices.shape = (2000, 3)

    works = [lambda: trigon3d.Scene().add_mesh(vertices, faces), lambda: scene.set_vertices(node, vertices)]
    raised = run([spoil, resize], works)
    assert all(isinstance(error, (ValueError, RuntimeError)) for error in raised), {repr(error) for error in raised}
    assert scene.render(8, 8, camera).color.shape == (8, 8, 4)


def test_arrays_may_change_while_they_are_filled(scene):
    cameras = scene.surround(20)
    out = {"depth": np.zeros((20, 24, 32), np.float32), "color": np.zeros((20, 24, 32, 4), np.uint8)}
    depth = out["depth"]

    def spoil():
        depth[:] = np.nan

    def resize():
        depth.shape = (20, 32, 24)
        depth.shape = (20, 24, 32)

    def shrink():
        out["color"].resize((1, 24, 32, 4), refcheck=False)
        out["color"].resize((20, 24, 32, 4), refcheck=False)

    def lock():
        depth.flags.writeable = False
        depth.flags.writeable = True

    raised = run([spoil, resize, shrink, lock], [lambda: scene.render_many(cameras, out=out)])
    assert all(isinstance(error, (ValueError, RuntimeError)) for error in raised), {repr(error) for error in raised}


def test_scenes_may_change_while_they_are_drawn(scene, camera):
    def move():
        scene.set_pose(0, np.eye(4))

    def add():
        scene.remove(scene.add_mesh(SQUARE, FACES))

    def many():
        return list(scene.render_many(scene.surround(3), 16, 16))

    draw = [lambda: scene.render(32, 24, camera), lambda: scene.pick(3, 3, 32, 24), lambda: scene.nodes, many]
    raised = run([move, add], [*draw, *draw])
    assert all(isinstance(error, (RuntimeError, IndexError)) for error in raised), {repr(error) for error in raised}
    assert scene.render(8, 8, camera).color.shape == (8, 8, 4)


def test_cameras_that_come_back_to_the_scene_work(scene):
    """A generator that changes and draws the scene that is being drawn."""

    def cameras():
        for camera in scene.surround(3):
            scene.set_pose(0, np.eye(4))
            scene.render(8, 8, camera)
            yield camera

    assert len(list(scene.render_many(cameras(), 8, 8))) == 3
    scene.render_many(cameras(), out={"depth": np.zeros((3, 8, 8), np.float32)})

    def failing():
        yield scene.overview()
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        list(scene.render_many(failing(), 8, 8))

    def itself():
        yield next(frames)

    frames = scene.render_many(itself(), 8, 8)
    with pytest.raises((RuntimeError, ValueError)):
        next(frames)


def test_deep_trees_of_nodes_are_drawn(tmp_path):
    count = 20_000
    nodes = [{"children": [index + 1], "translation": [0.001, 0, 0]} for index in range(count - 1)] + [{"mesh": 0}]
    triangle = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
    (tmp_path / "t.bin").write_bytes(triangle)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "buffers": [{"uri": "t.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    }  # fmt: skip
    (tmp_path / "deep.gltf").write_text(json.dumps(document))
    scene = trigon3d.load(tmp_path / "deep.gltf")
    assert scene.bounds[0][0] == pytest.approx(0.001 * (count - 1), rel=1e-6)
    assert scene.render(16, 16, outputs="object_ids").object_ids.max() >= 0


def test_deep_trees_and_rings_of_pyrender_nodes():
    triangle = pyrender.Mesh([pyrender.Primitive([[-1, -1, 0], [1, -1, 0], [0, 1, 0]])])
    top = node = pyrender.Node()
    for _ in range(5000):
        child = pyrender.Node()
        node.children.append(child)
        node = child
    node.mesh = triangle
    scene = pyrender.Scene()
    scene.add_node(top)
    scene.add(pyrender.OrthographicCamera(2, 2), pose=np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1.0]]))
    depth = pyrender.OffscreenRenderer(16, 16).render(scene, pyrender.RenderFlags.DEPTH_ONLY)
    assert depth.max() == pytest.approx(3, abs=1e-5)
    node.children.append(top)
    with pytest.raises(ValueError, match="below itself"):
        pyrender.OffscreenRenderer(16, 16).render(scene, pyrender.RenderFlags.DEPTH_ONLY)
