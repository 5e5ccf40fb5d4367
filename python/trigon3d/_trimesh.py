"""Scenes of trimesh. Nothing here imports trimesh: what is given is asked for what it has."""

from typing import Any

import numpy as np

from ._colors import encoded
from ._trigon3d import Camera, Material, Scene


def from_trimesh(source: Any) -> Scene:
    """A scene of a ``trimesh.Trimesh``, ``PointCloud`` or ``Scene``: geometry, poses, names, colours and textures.

    Nodes have the names of the graph's nodes. Faces are smooth across edges at which they meet at less than 30 degrees.
    """
    scene = Scene()
    if not hasattr(source, "geometry"):
        _add(scene, source, np.eye(4), "mesh")
        return scene
    for node in source.graph.nodes_geometry:
        pose, name = source.graph[node]
        _add(scene, source.geometry[name], pose, str(node))
    return scene


def save_image(source: Any, resolution: tuple[int, int] = (640, 480), **named: Any) -> bytes:
    """The bytes of a PNG, as ``trimesh.Scene.save_image`` returns them, by the scene's own camera.

    Named arguments are those of ``Scene.render``.
    """
    width, height = resolution
    camera = None
    if hasattr(source, "camera_transform"):
        fov = float(source.camera.fov[1])
        camera = Camera.perspective(fov, pose=source.camera_transform)
    frame = from_trimesh(source).render(width, height, camera, **named)
    return frame.to_png()


def _add(scene: Scene, geometry: Any, pose: Any, name: str) -> None:
    faces = getattr(geometry, "faces", None)
    if faces is None:
        colors = getattr(geometry, "colors", None)
        has_colors = colors is not None and len(colors) == len(geometry.vertices)
        scene.add_points(geometry.vertices, colors=np.asarray(colors) if has_colors else None, pose=pose, name=name)
        return
    scene.add_mesh(
        geometry.vertices, np.asarray(faces), smooth_angle=30.0, pose=pose, name=name, **mesh_arguments(geometry)
    )


def mesh_arguments(geometry: Any) -> dict[str, Any]:
    """Colours, texture coordinates and material of a mesh, as `Scene.add_mesh` takes them."""
    visual: Any = getattr(geometry, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        return {"colors": np.asarray(visual.vertex_colors)}
    if kind == "face":
        # A colour for each corner.
        return {"colors": np.repeat(np.asarray(visual.face_colors), 3, axis=0)}
    if kind == "texture" and visual.uv is not None:
        # trimesh counts v from the lower edge.
        uvs = np.asarray(visual.uv)[:, :2] * [1, -1] + [0, 1]
        return {"uvs": uvs, "material": _material(visual.material)}
    return {}


def _material(material: Any) -> Material:
    """A material of trimesh: PBR, or of an OBJ."""
    is_pbr = hasattr(material, "baseColorFactor")
    color = _numbers(material.baseColorFactor if is_pbr else getattr(material, "diffuse", None))
    texture = _image(material.baseColorTexture if is_pbr else getattr(material, "image", None))
    if not is_pbr:
        return Material(color, texture=texture)
    # Factors of PBR are linear light.
    color[:3] = encoded(color[:3])
    emission = material.emissiveFactor
    mode: Any = (material.alphaMode or "OPAQUE").lower()
    # What glTF says where a factor is missing.
    metallic, roughness = (1.0 if each is None else each for each in (material.metallicFactor, material.roughnessFactor))
    return Material(
        color,
        metallic=metallic,
        roughness=roughness,
        emission=np.zeros(3) if emission is None else encoded(np.clip(_numbers(emission)[:3], 0, 1)),
        double_sided=bool(material.doubleSided),
        alpha_mode=mode,
        alpha_cutoff=0.5 if material.alphaCutoff is None else material.alphaCutoff,
        texture=texture,
        metallic_roughness_texture=_image(material.metallicRoughnessTexture),
        normal_texture=_image(material.normalTexture),
        occlusion_texture=_image(material.occlusionTexture),
        emissive_texture=_image(material.emissiveTexture),
    )


def _numbers(color: Any) -> np.ndarray:
    """A colour from 0 to 1; bytes are divided by 255."""
    if color is None:
        return np.ones(4)
    numbers = np.array(color, dtype=np.float64)
    return np.clip(numbers / 255 if np.asarray(color).dtype.kind in "iu" else numbers, 0, 1)


def _image(image: Any) -> np.ndarray | None:
    return None if image is None else np.asarray(image.convert("RGBA"))
