"""Meshes and scenes of trimesh."""

import io

import numpy as np
import trigon3d
import trimesh
from PIL import Image


def pose(x):
    matrix = np.eye(4)
    matrix[0, 3] = x
    return matrix


def test_a_scene_has_the_graphs_nodes_at_their_poses():
    source = trimesh.Scene()
    box = trimesh.creation.box((1, 1, 1))
    source.add_geometry(box, node_name="left", transform=pose(-2))
    source.add_geometry(box, node_name="right", transform=pose(2))
    scene = trigon3d.from_trimesh(source)
    assert [node["name"] for node in scene.nodes] == ["left", "right"]
    assert scene.bounds == [(-2.5, -0.5, -0.5), (2.5, 0.5, 0.5)]


def test_face_and_vertex_colours_are_shown():
    camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
    for kind in ("face", "vertex"):
        box = trimesh.creation.box((1, 1, 1))
        count = len(box.faces) if kind == "face" else len(box.vertices)
        setattr(box.visual, f"{kind}_colors", np.tile([0, 200, 0, 255], (count, 1)).astype(np.uint8))
        red, green, blue, _ = trigon3d.from_trimesh(box).render(32, 32, camera).color[16, 16]
        assert green > 100 and red < 60 and blue < 60, kind


def test_textures_are_the_right_way_up():
    image = Image.new("RGB", (8, 8), (0, 0, 255))
    image.paste((255, 0, 0), (0, 0, 8, 4))
    square = trimesh.Trimesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    uv = [[0, 0], [1, 0], [1, 1], [0, 1]]
    square.visual = trimesh.visual.TextureVisuals(uv, image=image)
    camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0), vertical_fov=30)
    color = trigon3d.from_trimesh(square).render(64, 64, camera, outputs="albedo").albedo
    assert color[20, 32, 0] > 0.1 > color[20, 32, 2] and color[44, 32, 2] > 0.1 > color[44, 32, 0]


def test_points_and_images():
    cloud = trimesh.PointCloud([[0, 0, 0], [1, 0, 0]], colors=[[255, 0, 0, 255]] * 2)
    assert trigon3d.from_trimesh(cloud).bounds == [(0, 0, 0), (1, 0, 0)]
    source = trimesh.Scene(trimesh.creation.icosphere())
    with Image.open(io.BytesIO(trigon3d.save_image(source, (80, 60)))) as image:
        assert image.size == (80, 60)
        assert len(np.unique(np.asarray(image).reshape(-1, 4), axis=0)) > 50


def test_materials_are_those_of_the_same_scene_as_a_file(tmp_path):
    """A square with all textures and factors, written as GLB by trimesh and read by trigon."""
    random = np.random.default_rng(4)

    def image(low=0, high=255):
        return Image.fromarray(random.integers(low, high + 1, (8, 8, 3)).astype(np.uint8))

    square = trimesh.Trimesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    uv = square.vertices[:, :2] * 0.5 + 0.5
    material = trimesh.visual.material.PBRMaterial(
        baseColorFactor=[0.9, 0.5, 0.3, 1.0], baseColorTexture=image(), metallicFactor=0.6, roughnessFactor=0.8,
        metallicRoughnessTexture=image(), normalTexture=image(100, 255), occlusionTexture=image(), emissiveTexture=image(),
        emissiveFactor=[0.1, 0.2, 0.3], doubleSided=True,
    )  # fmt: skip
    square.visual = trimesh.visual.TextureVisuals(uv, material=material)
    source = trimesh.Scene(square)
    source.export(tmp_path / "square.glb")
    camera = trigon3d.Camera.look_at((0, 0.5, 4), (0, 0, 0), vertical_fov=35)
    outputs = ("color", "albedo", "normals", "face_ids")
    direct = trigon3d.from_trimesh(source).render(96, 96, camera, outputs=outputs)
    read = trigon3d.load(tmp_path / "square.glb").render(96, 96, camera, outputs=outputs)
    assert (direct.face_ids == read.face_ids).all()
    assert np.abs(direct.albedo - read.albedo).max() < 5e-3
    assert np.abs(direct.normals - read.normals).max() < 1e-4
    assert np.abs(direct.color.astype(int) - read.color).max() <= 2
    assert len(np.unique(direct.normals.reshape(-1, 3).round(2), axis=0)) > 20, "the textures are seen"
