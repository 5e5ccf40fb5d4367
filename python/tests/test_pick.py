"""Picked and explained pixels, against images and what can be computed by hand."""

import numpy as np
import pytest
import trigon3d

SIZE = (64, 48)


@pytest.fixture
def scene():
    """A square of two triangles at z = 0, a smaller one of one polygon behind it to the right, and a point."""
    scene = trigon3d.Scene()
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    scene.add_mesh(square, [[0, 1, 2], [0, 2, 3]], name="front", uvs=square[:, :2] * 0.5 + 0.5)
    scene.add_mesh(square * 0.6 + [1.2, 0, -1], [[0, 1, 2, 3]], name="back")
    scene.add_points([[-1.4, 0, 0]], name="point")
    return scene


@pytest.fixture
def camera():
    return trigon3d.Camera.look_at((0.3, 0.2, 5), (0, 0, 0), vertical_fov=40)


def test_a_pick_is_what_the_frame_has_in_that_pixel(scene, camera):
    outputs = ("depth", "object_ids", "face_ids", "triangle_ids", "material_ids", "barycentrics", "positions", "normals")
    for samples in (1, 3):
        frame = scene.render(*SIZE, camera, outputs=outputs, samples=samples, point_size=5)
        kinds = set()
        for y in range(0, SIZE[1], 3):
            for x in range(0, SIZE[0], 3):
                hit = scene.pick(x, y, *SIZE, camera, samples=samples, point_size=5)
                node = frame.object_ids[y, x]
                kinds.add(int(node))
                if node < 0:
                    assert hit is None
                    continue
                assert hit["node"] == node and hit["name"] == ("front", "back", "point")[node]
                assert hit["depth"] == frame.depth[y, x]
                if hit["name"] == "point":
                    assert hit["face"] is hit["triangle"] is hit["barycentrics"] is hit["normal"] is hit["edge"] is None
                    continue
                assert hit["face"] == frame.face_ids[y, x] and hit["triangle"] == frame.triangle_ids[y, x]
                assert hit["material"] == frame.material_ids[y, x]
                assert np.allclose(hit["barycentrics"], frame.barycentrics[y, x])
                assert np.allclose(hit["position"], frame.positions[y, x], atol=1e-5)
                assert np.allclose(hit["normal"], frame.normals[y, x])
        assert kinds == {-1, 0, 1, 2}


def test_a_position_is_seen_where_it_was_picked(scene, camera):
    """The ray through the middle of the pixel, by the camera's matrices alone."""
    K, pose = camera.K(*SIZE, convention="opengl"), camera.pose()
    for x, y in ((30, 20), (25, 30), (40, 24)):
        hit = scene.pick(x, y, *SIZE, camera)
        local = [(x + 0.5 - K[0, 2]) / K[0, 0], -(y + 0.5 - K[1, 2]) / K[1, 1], -1]
        expected = pose[:3, 3] + pose[:3, :3] @ local * hit["depth"]
        assert np.allclose(hit["position"], expected, atol=1e-4)
        assert hit["distance"] == pytest.approx(np.linalg.norm(expected - pose[:3, 3]), abs=1e-4)
        if hit["name"] == "front":
            assert np.allclose(hit["uv"], np.array(hit["position"][:2]) * 0.5 + 0.5, atol=1e-5)


def test_the_nearest_vertex_and_edge_of_a_face(scene, camera):
    x, y = camera.project([[0.9, 0.8, 0]], *SIZE)[0].astype(int)
    hit = scene.pick(x, y, *SIZE, camera)
    assert hit["vertex"] == 2 and set(hit["edge"]) == {1, 2}


def test_boxes_hold_what_lies_in_them(scene, camera):
    everything = (0, 0, *SIZE, *SIZE, camera)
    assert scene.pick_box(*everything) == [0, 1, 2]
    faces = scene.pick_box(*everything, elements="faces")
    assert {node: rows.tolist() for node, rows in faces.items()} == {0: [0, 1], 1: [0]}
    # Two corners of the square behind are hidden by the one in front.
    seen = scene.pick_box(*everything, elements="vertices")
    assert {node: rows.tolist() for node, rows in seen.items()} == {0: [0, 1, 2, 3], 1: [1, 2], 2: [0]}
    through = scene.pick_box(*everything, elements="vertices", through=True)
    assert {node: rows.tolist() for node, rows in through.items()} == {0: [0, 1, 2, 3], 1: [0, 1, 2, 3], 2: [0]}
    edges = scene.pick_box(*everything, elements="edges", through=True)
    assert sorted(sorted(pair) for pair in edges[0].tolist()) == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    # A box about the projection of one corner alone.
    x, y = camera.project([[-1, 1, 0]], *SIZE)[0]
    near = scene.pick_box(x - 2, y - 2, x + 2, y + 2, *SIZE, camera, elements="vertices")
    assert {node: rows.tolist() for node, rows in near.items()} == {0: [3]}
    assert scene.pick_box(0, 0, 1, 1, *SIZE, camera) == []
    assert scene.pick_box(np.nan, 0, 64, 48, *SIZE, camera) == []


def test_an_explained_pixel_says_what_is_in_front_of_what(scene, camera):
    x, y = camera.project([[0.8, 0, 0]], *SIZE)[0].astype(int)
    pixel = scene.explain_pixel(x, y, *SIZE, camera, samples=1, lighting="scene")
    [sample] = pixel["samples"]
    verdicts = {fragment["name"]: fragment["verdict"] for fragment in sample["fragments"] if fragment["covered"]}
    assert verdicts == {"front": "visible", "back": "hidden"}
    front, back = (fragment for fragment in sample["fragments"] if fragment["covered"])
    assert front["visible"] and not back["visible"] and front["depth"] > back["depth"] and back["margin"] < 0
    # Edge functions add up to twice the triangle's area, in units of 1/256 pixel squared.
    corners = np.array(front["vertices"])
    area = abs(np.linalg.det([corners[1] - corners[0], corners[2] - corners[0]])) * 256**2
    assert sum(edge["value"] for edge in front["edges"]) == pytest.approx(area)
    assert pixel["pixel"] == (x, y) and "visible" in pixel["text"]
    frame = scene.render(*SIZE, camera, outputs=("radiance", "face_ids"), samples=1, lighting="scene")
    assert np.allclose(pixel["color"], frame.radiance[y, x], atol=1e-6) and front["face"] == frame.face_ids[y, x]
    assert len(scene.explain_pixel(x, y, *SIZE, camera, samples=3)["samples"]) == 9


@pytest.mark.parametrize("method", ["pick", "explain_pixel"])
def test_pixels_outside_and_arguments_that_do_not_belong_are_refused(scene, camera, method):
    ask = getattr(scene, method)
    for x, y in ((64, 0), (0, 48), (-1, 0), (0, -1), (2**40, 0)):
        with pytest.raises(IndexError, match="outside"):
            ask(x, y, *SIZE, camera)
    for named in ({"outputs": ("depth",)}, {"time_budget": 1.0}, {"colour": 1}):
        with pytest.raises(TypeError):
            ask(0, 0, *SIZE, camera, **named)
    with pytest.raises(ValueError, match="elements"):
        scene.pick_box(0, 0, 1, 1, *SIZE, camera, elements="corners")
    with pytest.raises(TypeError, match="samples"):
        scene.pick_box(0, 0, 1, 1, *SIZE, camera, samples=2)


def test_empty_scenes_are_picked_and_explained():
    scene = trigon3d.Scene()
    assert scene.pick(0, 0, 8, 8) is None and scene.pick_box(0, 0, 8, 8, 8, 8) == []
    assert scene.explain_pixel(0, 0, 8, 8)["samples"][0]["fragments"] == []
