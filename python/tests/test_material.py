"""Textures of materials from arrays and files, against what glTF says they mean."""

import numpy as np
import pytest
import trigon3d

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
UVS = [[0, 1], [1, 1], [1, 0], [0, 0]]


def drawn(material, *, light="directional", outputs=("color", "radiance", "normals"), **named):
    scene = trigon3d.Scene()
    scene.add_mesh(SQUARE, [[0, 1, 2, 3]], uvs=UVS, material=material)
    if light:
        scene.add_light(light, **named)
    camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0), vertical_fov=20)
    return scene.render(32, 32, camera, outputs=outputs, lighting="scene")


def halves(left, right):
    """An image whose left half has one colour and whose right half another."""
    image = np.zeros((8, 8, 3), np.uint8)
    image[:, :4], image[:, 4:] = left, right
    return image


def test_emission_is_multiplied_with_its_texture():
    texture = halves([255, 255, 255], [0, 0, 0])
    shown = drawn(trigon3d.Material((0, 0, 0), emission=(1, 0, 0), emissive_texture=texture), light="ambient").radiance
    assert np.allclose(shown[16, 8, :3], [1, 0, 0], atol=1e-5) and np.allclose(shown[16, 24, :3], 0, atol=1e-5)
    # Without a factor the texture is the light; its bytes are sRGB.
    grey = np.full((4, 4), 128, np.uint8)
    shown = drawn(trigon3d.Material((0, 0, 0), emissive_texture=grey), light="ambient").radiance
    assert np.allclose(shown[16, 16, :3], ((128 / 255 + 0.055) / 1.055) ** 2.4, atol=1e-4)


def test_occlusion_takes_ambient_light_alone_away():
    texture = halves([255, 0, 0], [51, 0, 0])
    white = {"color": (1, 1, 1), "metallic": 0.0, "roughness": 1.0}
    ambient = drawn(trigon3d.Material(**white, occlusion_texture=texture), light="ambient").radiance[16, :, 0]
    assert ambient[24] == pytest.approx(0.2 * ambient[8], rel=1e-3)
    half = drawn(trigon3d.Material(**white, occlusion_texture=texture, occlusion_strength=0.5), light="ambient")
    assert half.radiance[16, 24, 0] == pytest.approx(0.6 * ambient[8], rel=1e-3)
    direct = drawn(trigon3d.Material(**white, occlusion_texture=texture)).radiance[16, :, 0]
    assert direct[24] == pytest.approx(direct[8], rel=0.05)


def test_normals_are_turned_by_their_texture():
    """A direction of 45 degrees towards +u, and one towards the upper edge."""
    for color, expected in (([218, 128, 218], [1, 0, 1]), ([128, 218, 218], [0, 1, 1])):
        texture = np.full((4, 4, 3), color, np.uint8)
        normal = drawn(trigon3d.Material(normal_texture=texture)).normals[16, 16]
        assert np.allclose(normal, np.array(expected) / np.sqrt(2), atol=0.01), expected
    flat = drawn(trigon3d.Material(normal_texture=texture, normal_scale=0.0)).normals[16, 16]
    assert np.allclose(flat, [0, 0, 1], atol=1e-5)


def test_green_is_roughness_and_blue_is_metal():
    texture = halves([0, 77, 255], [0, 255, 0])
    both = drawn(trigon3d.Material((1.0, 0.5, 0.2), metallic_roughness_texture=texture)).radiance
    metal = drawn(trigon3d.Material((1.0, 0.5, 0.2), metallic=1.0, roughness=77 / 255)).radiance
    matt = drawn(trigon3d.Material((1.0, 0.5, 0.2), metallic=0.0, roughness=1.0)).radiance
    assert np.allclose(both[16, 8], metal[16, 8], rtol=1e-3) and np.allclose(both[16, 24], matt[16, 24], rtol=1e-3)
    assert not np.allclose(metal[16, 8], matt[16, 8], rtol=0.05)


def test_files_are_textures_too(tmp_path):
    from PIL import Image

    texture = halves([200, 100, 50], [50, 100, 200])
    Image.fromarray(texture).save(tmp_path / "t.png")
    shown = [
        drawn(trigon3d.Material((1, 1, 1), unlit=True, texture=given), light=None).color
        for given in (texture, tmp_path / "t.png", str(tmp_path / "t.png"), np.dstack([texture, np.full((8, 8), 255, np.uint8)]))
    ]
    assert (shown[0][16, 8, :3] == [200, 100, 50]).all()
    assert all((each == shown[0]).all() for each in shown)


def test_one_material_is_for_many_meshes_and_scenes():
    material = trigon3d.Material(texture=halves([255, 0, 0], [0, 0, 255]), unlit=True)
    assert (drawn(material, light=None).color == drawn(material, light=None).color).all()


@pytest.mark.parametrize(
    ("named", "error", "word"),
    [
        ({"texture": np.zeros((4, 4, 2), np.uint8)}, ValueError, "texture has the shape"),
        ({"normal_texture": np.zeros(4, np.uint8)}, ValueError, "normal_texture has the shape"),
        ({"normal_texture": np.zeros((4, 4, 3))}, ValueError, "normal_texture holds float64"),
        ({"occlusion_texture": np.zeros((0, 4), np.uint8)}, ValueError, "0"),
        ({"texture": np.broadcast_to(np.uint8(0), (10**6, 10**6))}, ValueError, "limit"),
        ({"texture": np.broadcast_to(np.uint8(0), (16384, 16384))}, ValueError, "more than"),
        ({"emissive_texture": "gone.png"}, trigon3d.LoadError, "gone.png"),
        ({"normal_scale": np.nan}, ValueError, "normal_scale"),
        ({"occlusion_strength": 2.0}, ValueError, "occlusion_strength"),
        ({"metallic": 2.0}, ValueError, "0 to 1"),
        ({"alpha_mode": "mask", "alpha_cutoff": np.inf}, ValueError, "alpha_cutoff"),
        ({"color": (1, 1)}, ValueError, "not 3 or 4"),
        ({"color": "red"}, TypeError, "text"),
    ],
)
def test_what_is_no_material_is_refused(named, error, word):
    with pytest.raises(error, match=word):
        trigon3d.Material(**named)
