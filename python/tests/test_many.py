"""Many views: the iterator, and arrays that are filled."""

import numpy as np
import pytest
import trigon3d

TYPES = {"color": (np.uint8, (4,)), "depth": (np.float32, ()), "object_ids": (np.int32, ()), "uvs": (np.float32, (2,))}
TYPES |= {"face_ids": (np.int32, ()), "normals": (np.float32, (3,)), "radiance": (np.float32, (4,))}


@pytest.fixture
def scene():
    scene = trigon3d.Scene()
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1]])
    scene.add_mesh(corners, [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    return scene


def arrays(frames, names=("color", "depth")):
    return {name: np.full((frames, 24, 32, *TYPES[name][1]), 77, TYPES[name][0]) for name in names}


def test_arrays_are_filled_with_the_frames_of_the_iterator_and_of_render(scene):
    cameras = scene.surround(5)
    out = scene.render_many(cameras, out=(given := arrays(5, TYPES)))
    assert out is given
    frames = list(scene.render_many(cameras, 32, 24, outputs=tuple(TYPES)))
    for index, (camera, frame) in enumerate(zip(cameras, frames, strict=True)):
        single = scene.render(32, 24, camera, outputs=tuple(TYPES))
        for name in TYPES:
            assert out[name][index].tobytes() == getattr(frame, name).tobytes() == getattr(single, name).tobytes(), name
    assert len({frame.depth.tobytes() for frame in frames}) == 5, "five different views"


def test_frames_are_drawn_when_they_are_asked_for(scene):
    asked = []

    def cameras():
        for camera in scene.surround(3):
            asked.append(camera)
            yield camera

    frames = scene.render_many(cameras(), 32, 24)
    assert asked == [] and iter(frames) is frames
    next(frames)
    assert len(asked) == 1
    scene.set_visible(0, False)
    assert next(frames).color.shape == (24, 32, 4), "a scene may be changed between two frames"
    assert len(list(frames)) == 1 and list(frames) == []


def test_tuples_of_camera_files_bring_their_sizes(scene):
    views = [("a", scene.overview(), (32, 24)), ("b", scene.overview(), (40, 20))]
    assert [(frame.width, frame.height) for frame in scene.render_many(views)] == [(32, 24), (40, 20)]
    assert [frame.width for frame in scene.render_many(views, 16, 8)] == [16, 16]
    out = scene.render_many(views, out=arrays(2))
    assert (out["color"][0] == scene.render(32, 24, scene.overview()).color).all()


def test_files_in_memory_are_filled(scene, tmp_path):
    file = np.lib.format.open_memmap(tmp_path / "depth.npy", "w+", np.float32, (4, 24, 32))
    scene.render_many(scene.surround(4), out={"depth": file})
    file.flush()
    expected = [frame.depth for frame in scene.render_many(scene.surround(4), 32, 24, outputs="depth")]
    assert (np.load(tmp_path / "depth.npy") == expected).all()


def read_only(array):
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    ("out", "word"),
    [
        ({}, "no arrays"),
        ({"deep": np.zeros((3, 24, 32), np.float32)}, "no output"),
        ({1: np.zeros((3, 24, 32), np.float32)}, "names of outputs"),
        ({"depth": [[[0.0]]]}, "no NumPy array"),
        ({"depth": np.zeros((24, 32), np.float32)}, "shape"),
        ({"depth": np.zeros((3, 24, 32, 1), np.float32)}, "shape"),
        ({"color": np.zeros((3, 24, 32, 3), np.uint8)}, "shape"),
        ({"color": np.zeros((3, 24, 32, 4), np.uint8), "depth": np.zeros((3, 24, 31), np.float32)}, "shape"),
        ({"color": np.zeros((3, 24, 32, 4), np.uint8), "depth": np.zeros((2, 24, 32), np.float32)}, "shape"),
        ({"depth": np.zeros((3, 24, 32), np.float64)}, "holds float64, but needs float32"),
        ({"depth": np.zeros((3, 24, 32), ">f4")}, "needs float32"),
        ({"object_ids": np.zeros((3, 24, 32), np.uint32)}, "needs int32"),
        ({"depth": np.zeros((3, 24, 64), np.float32)[:, :, ::2]}, "contiguous"),
        ({"depth": np.zeros((3, 24, 32), np.float32)[::-1]}, "contiguous"),
        ({"depth": np.asfortranarray(np.zeros((3, 24, 32), np.float32))}, "contiguous"),
        ({"depth": np.broadcast_to(np.float32(0), (3, 24, 32))}, "contiguous"),
        ({"depth": read_only(np.zeros((3, 24, 32), np.float32))}, "out"),
        ({"depth": np.zeros(3 * 24 * 32 * 4 + 1, np.uint8)[1:].view(np.float32).reshape(3, 24, 32)}, "out"),
        ({"depth": np.zeros((3, 0, 32), np.float32)}, "pixels on a side"),
        ({"depth": np.zeros((2, 24, 32), np.float32)}, "room for 2 frames, but there are more cameras"),
        ({"depth": np.zeros((4, 24, 32), np.float32)}, "room for 4 frames, but there are 3 cameras"),
    ],
)
def test_arrays_that_do_not_fit_are_refused_before_anything_is_drawn(scene, out, word):
    before = {name: np.array(array) for name, array in out.items()}
    with pytest.raises(ValueError, match=word):
        scene.render_many(scene.surround(3), out=out)
    assert all(np.array_equal(before[name], array) for name, array in out.items())


def test_arrays_that_share_memory_are_refused(scene):
    shared = np.zeros((3, 24, 32), np.float32)
    ids = shared.view(np.int32)
    with pytest.raises(ValueError, match="out"):
        scene.render_many(scene.surround(3), out={"depth": shared, "object_ids": ids})


def test_what_contradicts_the_arrays_is_refused(scene):
    with pytest.raises(ValueError, match="room for images of 32 × 24"):
        scene.render_many(scene.surround(3), 24, 32, out=arrays(3))
    with pytest.raises(ValueError, match="which outputs"):
        scene.render_many(scene.surround(3), out=arrays(3), outputs=("depth",))
    with pytest.raises(ValueError, match="together"):
        scene.render_many(scene.surround(3), 32)
    with pytest.raises(TypeError, match="cameras are"):
        scene.render_many([1, 2, 3], out=arrays(3))
    with pytest.raises(TypeError, match="no argument"):
        scene.render_many(scene.surround(3), 8, 8, sample=3)
    with pytest.raises(ValueError, match="no sizes"):
        next(scene.render_many(scene.surround(3)))


def test_endless_cameras_are_too_many(scene):
    def endless():
        while True:
            yield scene.overview()

    with pytest.raises(ValueError, match="more cameras"):
        scene.render_many(endless(), out=arrays(3))
    assert scene.render_many([], out=arrays(0))["depth"].shape == (0, 24, 32)


def test_arrays_are_shared_with_dlpack_without_a_copy(scene):
    frame = scene.render(32, 24, outputs=("color", "depth", "object_ids"))
    for array in (frame.color, frame.depth, frame.object_ids):
        shared = np.from_dlpack(array)
        assert np.shares_memory(shared, array) and (shared == array).all()
