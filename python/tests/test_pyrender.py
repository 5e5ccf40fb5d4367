"""pyrender's interface: shapes, types, backgrounds, flags and poses."""

import doctest

import numpy as np
import pytest
import trigon3d.pyrender
import trimesh
from trigon3d import pyrender
from trigon3d.pyrender import RenderFlags


def pose(x=0.0, y=0.0, z=0.0):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


@pytest.fixture
def scene():
    scene = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0], ambient_light=[0.1, 0.1, 0.1])
    box = pyrender.Mesh.from_trimesh(trimesh.creation.box((1, 1, 1)), smooth=False)
    scene.left = scene.add(box, pose=pose(-1), name="left")
    scene.right = scene.add(box, pose=pose(1), name="right")
    scene.camera = scene.add(pyrender.PerspectiveCamera(yfov=np.pi / 3), pose=pose(0, 0, 4))
    scene.add(pyrender.DirectionalLight(intensity=3.0), pose=pose(0, 0, 4))
    return scene


def test_the_example_of_its_documentation_runs():
    assert doctest.testmod(trigon3d.pyrender).failed == 0


def test_shapes_types_and_backgrounds_are_pyrenders(scene):
    renderer = pyrender.OffscreenRenderer(80, 60)
    color, depth = renderer.render(scene)
    assert color.shape == (60, 80, 3) and color.dtype == np.uint8
    assert depth.shape == (60, 80) and depth.dtype == np.float32
    assert depth[0, 0] == 0 and depth[depth > 0].min() == pytest.approx(3.5, abs=1e-5)
    color, _ = renderer.render(scene, flags=RenderFlags.RGBA)
    assert color.shape == (60, 80, 4) and color[0, 0, 3] == 0 and color[depth > 0][:, 3].min() > 0
    only = renderer.render(scene, flags=RenderFlags.DEPTH_ONLY)
    # Corners are snapped to a grid that is three times as fine beside colours: outlines may differ by a pixel.
    both = (only > 0) & (depth > 0)
    assert np.allclose(only[both], depth[both], atol=1e-2) and ((only > 0) != (depth > 0)).mean() < 0.01
    renderer.delete()


def test_a_background_has_its_colour_and_alpha(scene):
    renderer = pyrender.OffscreenRenderer(40, 30)
    for given, expected in (([1.0, 0.5, 0.0], [255, 128, 0, 255]), ([0.2, 0.4, 0.6, 0.5], [51, 102, 153, 128])):
        scene.bg_color = np.asarray([*given, 1.0][:4] if len(given) == 3 else given)
        color, _ = renderer.render(scene, flags=RenderFlags.RGBA)
        assert np.abs(color[0, 0].astype(int) - expected).max() <= 1


def test_segmentation_draws_the_nodes_of_the_map_alone(scene):
    renderer = pyrender.OffscreenRenderer(80, 60)
    colors, depth = renderer.render(scene, RenderFlags.SEG, {scene.left: 7, scene.right: (1, 2, 3)})
    assert {tuple(row) for row in colors.reshape(-1, 3)} == {(0, 0, 0), (7, 7, 7), (1, 2, 3)}
    assert (colors[:, :40] != [1, 2, 3]).any(axis=-1).all() and (depth[colors.any(axis=-1)] > 0).all()
    colors, _ = renderer.render(scene, RenderFlags.SEG, {scene.right: (1, 2, 3)})
    assert {tuple(row) for row in colors.reshape(-1, 3)} == {(0, 0, 0), (1, 2, 3)}
    both, _ = renderer.render(scene)
    assert both[:, :40].any(), "all are back in an ordinary image"


def test_moved_nodes_and_parents_are_followed(scene):
    renderer = pyrender.OffscreenRenderer(40, 30)
    before = renderer.render(scene, RenderFlags.DEPTH_ONLY)
    scene.set_pose(scene.right, pose(1, 0, 1))
    after = renderer.render(scene, RenderFlags.DEPTH_ONLY)
    assert after[15, 30] == pytest.approx(before[15, 30] - 1, abs=0.6) and after[15, 30] < before[15, 30]
    child = scene.add(pyrender.Mesh.from_trimesh(trimesh.creation.icosphere(radius=0.2)), parent_node=scene.left)
    assert np.array_equal(scene.get_pose(child), pose(-1))
    scene.set_pose(scene.left, pose(-1, 0, -1))
    assert np.array_equal(scene.get_pose(child), pose(-1, 0, -1))
    scene.set_pose(scene.camera, pose(0, 0, 6))
    behind = renderer.render(scene, RenderFlags.DEPTH_ONLY)
    assert behind[behind > 0].min() == pytest.approx(after[after > 0].min() + 2, abs=1e-4)
    scene.remove_node(scene.left)
    assert not scene.has_node(scene.left) and not scene.has_node(child)
    fresh = pyrender.Scene(bg_color=scene.bg_color, ambient_light=scene.ambient_light)
    for node in scene.nodes:
        fresh.add(node.mesh or node.light or node.camera, pose=scene.get_pose(node))
    assert (renderer.render(scene)[0] == renderer.render(fresh)[0]).all(), "as if it had been built so"


def test_back_faces_are_culled_unless_asked(scene):
    triangle = pyrender.Primitive([[-1, -1, 0], [0, 1, 0], [1, -1, 0]], material=pyrender.MetallicRoughnessMaterial())
    back = pyrender.Scene()
    back.add(pyrender.Mesh([triangle]))
    back.add(pyrender.OrthographicCamera(2, 2), pose=pose(0, 0, 3))
    renderer = pyrender.OffscreenRenderer(32, 32)
    assert renderer.render(back, RenderFlags.DEPTH_ONLY).max() == 0
    assert renderer.render(back, RenderFlags.DEPTH_ONLY | RenderFlags.SKIP_CULL_FACES).max() == pytest.approx(3, abs=1e-5)


def test_intrinsics_place_points_as_pyrenders_matrix_does():
    """The projection matrix of pyrender's IntrinsicsCamera, written out."""
    width, height, fx, fy, cx, cy = 160, 120, 150.0, 140.0, 70.0, 65.0
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh.from_points([[0.3, 0.2, -2.0]], colors=[[255, 255, 255]]))
    scene.add(pyrender.IntrinsicsCamera(fx, fy, cx, cy))
    depth = pyrender.OffscreenRenderer(width, height, point_size=3).render(scene, RenderFlags.DEPTH_ONLY)
    matrix = np.array([[2 * fx / width, 0, 1 - 2 * cx / width], [0, 2 * fy / height, 2 * cy / height - 1]])
    ndc = matrix @ [0.3, 0.2, -2.0] / 2.0
    expected = (ndc * [1, -1] + 1) / 2 * [width, height]
    rows, columns = np.nonzero(depth)
    assert np.abs([columns.mean() + 0.5, rows.mean() + 0.5] - expected).max() < 0.6


def test_instances_have_poses_of_their_own():
    ball = trimesh.creation.icosphere(radius=0.3)
    scene = pyrender.Scene()
    node = scene.add(pyrender.Mesh.from_trimesh(ball, poses=np.stack([pose(-1), pose(0), pose(1)])), pose=pose(0, 1))
    scene.add(pyrender.OrthographicCamera(2, 2), pose=pose(0, 0, 3))
    colors, _ = pyrender.OffscreenRenderer(64, 64).render(scene, RenderFlags.SEG, {node: 9})
    assert [colors[16, x, 0] for x in (16, 24, 32, 40, 48)] == [9, 0, 9, 0, 9]


def test_what_is_missing_says_so(scene):
    renderer = pyrender.OffscreenRenderer(8, 8)
    with pytest.raises(NotImplementedError):
        renderer.render(scene, RenderFlags.ALL_WIREFRAME)
    with pytest.warns(trigon3d.TrigonWarning, match="no window"):
        viewer = pyrender.Viewer(scene, use_raymond_lighting=True)
    assert not viewer.is_active, "scripts that wait for its end go on"
    with pytest.raises(NotImplementedError):
        viewer.save_gif()
    with pytest.raises(NotImplementedError):
        pyrender.Primitive([[0, 0, 0], [1, 1, 1]], mode=1)
    with pytest.raises(ValueError, match="camera"):
        renderer.render(pyrender.Scene())
    with pytest.raises(TypeError):
        scene.add("box")


def test_nodes_are_placed_by_translation_rotation_and_scale():
    """A quarter turn about x, as a matrix by hand."""
    half = np.sqrt(0.5)
    node = pyrender.Node(translation=[1, 2, 3], rotation=[half, 0, 0, half], scale=[2, 1, 0.5])
    expected = np.array([[2, 0, 0, 1], [0, 0, -0.5, 2], [0, 1, 0, 3], [0, 0, 0, 1]])
    assert np.allclose(node.matrix, expected)
    other = pyrender.Node(matrix=node.matrix)
    assert np.allclose(other.rotation, [half, 0, 0, half]) and np.allclose(other.scale, [2, 1, 0.5])
    other.translation = [0, 0, 0]
    other.scale = 1
    assert np.allclose(other.matrix[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]]) and other.matrix[0, 3] == 0
    for wrong in ({"matrix": np.eye(3)}, {"rotation": [1, 1, 1, 1]}):
        with pytest.raises(ValueError):
            pyrender.Node(**wrong)


def test_a_node_is_in_a_scene_once(scene):
    child = pyrender.Node()
    scene.left.children.append(child)
    for node, parent in ((child, None), (scene.left, None), (pyrender.Node(), child), (pyrender.Node(), pyrender.Node())):
        if parent is child:
            scene.add_node(node, parent)
            continue
        with pytest.raises(ValueError):
            scene.add_node(node, parent)
    assert len(scene.mesh_nodes) == 2 and len(scene.meshes) == 1 and len(scene.directional_lights) == 1
    with pytest.raises(ValueError):
        scene.main_camera_node = scene.left
    scene.remove_node(scene.camera)
    assert scene.main_camera_node is None
    scene.clear()
    assert not scene.nodes and (scene.bounds == 0).all()


def test_light_is_what_pyrenders_shader_computes():
    """Its formula for a rough dielectric seen and lit from the front, in linear light, and its cone of a spot."""
    square = pyrender.Primitive([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 0, 1.0]] * 4, indices=[[0, 1, 2], [0, 2, 3]])
    square.material = pyrender.MetallicRoughnessMaterial(baseColorFactor=[0.5, 0.5, 0.5, 1], metallicFactor=0.0)

    def value(light, at=None, **named):
        scene = pyrender.Scene(**named)
        scene.add(pyrender.Mesh([square]))
        scene.add(pyrender.PerspectiveCamera(0.01), pose=pose(0, 0, 5))
        if light is not None:
            scene.add(light, pose=pose(0, 0, 2) if at is None else at)
        color, _ = pyrender.OffscreenRenderer(16, 16).render(scene)
        encoded = color[8, 8].astype(float) / 255
        return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)

    diffuse, gloss = 0.96 * 0.96 * 0.5 / np.pi, 0.04 / np.pi / 4
    expected = diffuse + gloss
    assert np.allclose(value(pyrender.DirectionalLight(intensity=2.0)), 2 * expected, rtol=0.06)
    assert np.allclose(value(pyrender.PointLight(intensity=8.0)), 2 * expected, rtol=0.06)
    assert np.allclose(value(pyrender.PointLight(color=[1, 0.5, 0], intensity=8.0)), [2 * expected, expected, 0], rtol=0.06)
    # Without lamps it is the base colour times the ambient light, of metals and with another ambient light, too.
    square.material.metallicFactor = 1.0
    for ambient in ([0.2, 0.4, 0.0], [1.0, 1.0, 1.0]):
        assert np.allclose(value(None, ambient_light=ambient), 0.5 * np.array(ambient), rtol=0.03, atol=1e-4)
    assert (value(None) == 0).all()
    square.material.metallicFactor = 0.0
    # A light far brighter than a display is white: there is no light meter.
    assert (value(pyrender.DirectionalLight(intensity=500.0)) == 1).all()
    # Halfway between the cones' cosines, a quarter: pyrender squares the share.
    turn = np.arccos((np.cos(0.1) + np.cos(0.5)) / 2)
    aside = pose(2 * np.sin(turn), 0, 2 * np.cos(turn))
    full, part = (
        value(pyrender.SpotLight(intensity=20.0, innerConeAngle=inner, outerConeAngle=0.5), aside)[0] for inner in (0.499, 0.1)
    )
    assert part / full == pytest.approx(0.25, rel=0.1)


def test_ambient_light_may_change_between_images(scene):
    scene.remove_node(next(iter(scene.light_nodes)))
    renderer, seen = pyrender.OffscreenRenderer(40, 30), []
    for strength in (1.0, 0.2, 0.5, 0.1, 0.3, 0.7, 1.0):
        scene.ambient_light = np.full(3, strength)
        seen.append(int(renderer.render(scene)[0][15, 10, 0]))
    assert seen[0] == seen[-1] and sorted(seen[1:6]) == [seen[3], seen[1], seen[4], seen[2], seen[5]]


def test_flat_images_have_the_given_colours(scene):
    scene.left.mesh.primitives[0].material.baseColorFactor = [1.0, 0.5, 0.2]
    color, _ = pyrender.OffscreenRenderer(80, 60).render(scene, RenderFlags.FLAT)
    assert np.abs(color[30, 20].astype(int) - [255, 128, 51]).max() <= 1


def test_a_lens_with_an_aspect_of_its_own_is_stretched(scene):
    scene.camera.camera.aspectRatio = 2.0
    wide = pyrender.OffscreenRenderer(80, 80).render(scene, RenderFlags.DEPTH_ONLY)
    scene.camera.camera.aspectRatio = None
    plain = pyrender.OffscreenRenderer(160, 80).render(scene, RenderFlags.DEPTH_ONLY)
    assert abs((wide > 0).mean() - (plain > 0).mean()) < 0.01


def test_scenes_of_trimesh_and_textures():
    source = trimesh.Scene()
    source.add_geometry(trimesh.creation.box(), transform=pose(2))
    scene = pyrender.Scene.from_trimesh_scene(source, ambient_light=[1.0, 1.0, 1.0])
    assert np.allclose(scene.bounds, [[1.5, -0.5, -0.5], [2.5, 0.5, 0.5]])
    texture = np.zeros((8, 8, 3), np.uint8)
    texture[:4] = [0, 200, 0]
    material = pyrender.MetallicRoughnessMaterial(baseColorTexture=pyrender.Texture(source=texture, source_channels="RGB"))
    corners, indices = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    square = pyrender.Primitive(corners, texcoord_0=[[0, 0], [1, 0], [1, 1], [0, 1]], indices=indices, material=material)
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh([square]))
    scene.add(pyrender.OrthographicCamera(1, 1), pose=pose(0, 0, 2))
    color, _ = pyrender.OffscreenRenderer(32, 32).render(scene, RenderFlags.FLAT)
    assert (color[8, 16] == [0, 200, 0]).all() and (color[24, 16] == 0).all(), "v counts from the lower edge"


@pytest.mark.parametrize(
    "camera",
    [
        pyrender.PerspectiveCamera(0.9),
        pyrender.PerspectiveCamera(0.9, zfar=50.0, aspectRatio=2.0),
        pyrender.OrthographicCamera(3, 2),
        pyrender.IntrinsicsCamera(150, 140, 70, 65),
    ],
)
def test_projection_matrices_place_what_is_drawn(camera):
    """A small ball, and where its middle is by the matrix alone."""
    place = np.array([0.4, -0.3, -4.0])
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh.from_trimesh(trimesh.creation.icosphere(radius=0.1)), pose=pose(*place))
    scene.add(camera)
    depth = pyrender.OffscreenRenderer(160, 120).render(scene, RenderFlags.DEPTH_ONLY)
    clip = camera.get_projection_matrix(160, 120) @ [*place, 1]
    expected = (clip[:2] / clip[3] * [1, -1] + 1) / 2 * [160, 120]
    rows, columns = np.nonzero(depth)
    assert np.abs([columns.mean() + 0.5, rows.mean() + 0.5] - expected).max() < 0.6
    assert abs(clip[2] / clip[3]) < 1, "between the clip planes"
