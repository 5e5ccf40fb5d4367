"""Primitives, and the meshes that they make."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from .. import _trigon3d as trigon
from .._colors import encoded
from ._constants import GLTF
from ._materials import Look, MetallicRoughnessMaterial, color_rows, of_trimesh, usual


class _Measured:
    """What has bounds, has a centre and a size."""

    @property
    def centroid(self):
        """The middle of the bounds."""
        return np.mean(self.bounds, axis=0)

    @property
    def extents(self):
        """The lengths of the bounds along the axes."""
        return np.diff(self.bounds, axis=0).reshape(-1)

    @property
    def scale(self):
        """The length of their diagonal."""
        return np.linalg.norm(self.extents)


def _rows(name: str, columns: tuple[int, ...], what: str) -> property:
    """An attribute with a row for each vertex, or `None`."""

    def get(self):
        return self.__dict__[name]

    def put(self, value):
        rows, count = None if value is None else np.asarray(value, dtype=np.float64), len(self.positions)
        if rows is not None and (rows.ndim != 2 or len(rows) != count or rows.shape[1] not in columns):
            raise ValueError(f"{name} has the shape {rows.shape}, but needs ({count}, {columns[0]})")
        self.__dict__[name] = rows

    return property(get, put, doc=what)


class Primitive(_Measured):
    """Triangles (``mode`` 4) or points (0) with one material."""

    def __init__(
        self,
        positions,
        normals=None,
        tangents=None,
        texcoord_0=None,
        texcoord_1=None,
        color_0=None,
        joints_0=None,
        weights_0=None,
        indices=None,
        material=None,
        mode=None,
        targets=None,
        poses=None,
    ):
        self.mode = GLTF.TRIANGLES if mode is None else mode
        if self.mode not in range(7):
            raise ValueError(f"mode {mode}: there are 0 to 6")
        if self.mode not in (GLTF.POINTS, GLTF.TRIANGLES):
            raise NotImplementedError(f"mode {mode}: there are points (0) and triangles (4)")
        self.positions = np.asarray(positions, dtype=np.float32)
        self.normals = normals
        self.tangents = tangents
        self.texcoord_0 = texcoord_0
        self.texcoord_1 = texcoord_1
        self.color_0 = None if color_0 is None else color_rows(color_0, len(self.positions))
        self.indices = indices
        self.material = material
        self.targets = targets
        self.poses = poses

    normals = _rows("normals", (3,), "A direction for each vertex.")
    tangents = _rows("tangents", (4,), "A tangent for each vertex; trigon makes its own.")
    texcoord_0 = _rows("texcoord_0", (2, 3), "Texture coordinates; v counts from the lower edge.")
    texcoord_1 = _rows("texcoord_1", (2, 3), "More of them, which no texture uses.")

    @property
    def material(self):
        """How it looks; a white metal with `None`."""
        return self._material

    @material.setter
    def material(self, value):
        if value is not None and not isinstance(value, MetallicRoughnessMaterial):
            raise TypeError(f"a material is a MetallicRoughnessMaterial, not {type(value).__name__}")
        self._material = value if value is not None else MetallicRoughnessMaterial()

    @property
    def poses(self):
        """Poses of instances, (n, 4, 4)."""
        return self._poses

    @poses.setter
    def poses(self, value):
        poses = None if value is None else np.asarray(value, dtype=np.float64)
        poses = poses[np.newaxis] if poses is not None and poses.ndim == 2 else poses
        if poses is not None and poses.shape[1:] != (4, 4):
            raise ValueError(f"poses have the shape {poses.shape}, but need (n, 4, 4)")
        self._poses = poses

    @property
    def bounds(self):
        """The lowest and the highest corner, of all instances."""
        box = np.array([self.positions.min(axis=0), self.positions.max(axis=0)])
        if self.poses is None:
            return box
        choices = np.indices((2, 2, 2)).reshape(3, 8)
        corners = np.vstack([box[choices, np.arange(3)[:, np.newaxis]], np.ones(8)])
        moved = (self.poses @ corners)[:, :3]
        return np.array([moved.min(axis=(0, 2)), moved.max(axis=(0, 2))])

    @property
    def is_transparent(self):
        """Whether anything is seen through it."""
        has_clear_colors = self.color_0 is not None and self.color_0[:, 3].min(initial=1) < 1
        return bool(self.material.is_transparent or has_clear_colors)

    def _add_to(self, scene: trigon.Scene, name: str, look: Look) -> list[tuple[int, np.ndarray]]:
        """The nodes that are added, and where each is within the primitive's own."""
        poses = [np.eye(4)] if self.poses is None else self.poses
        colors = self.color_0
        if self.mode == GLTF.POINTS and look.ambient is not None:
            colors = color_rows([1.0, 1.0, 1.0], len(self.positions)) if colors is None else colors
            colors = colors * [*look.ambient, 1]
        if colors is not None and not look.is_flat:
            # Vertex colours are linear light there.
            colors = np.column_stack([encoded(colors[:, :3]), colors[:, 3]])
        if self.mode == GLTF.POINTS:
            return [(scene.add_points(self.positions, colors=colors, name=name), pose) for pose in poses]
        faces = np.arange(len(self.positions)) if self.indices is None else np.asarray(self.indices)
        named = {"normals": self.normals, "colors": colors}
        if self.texcoord_0 is not None:
            # Here v counts from the upper edge.
            named["uvs"] = self.texcoord_0[:, :2] * [1, -1] + [0, 1]
        named = {key: value for key, value in named.items() if value is not None}
        material = self.material._translated(look, self.is_transparent)
        faces = faces.reshape(-1, 3)
        return [(scene.add_mesh(self.positions, faces, material=material, name=name, **named), pose) for pose in poses]


class Mesh(_Measured):
    """What a node shows: one primitive or several."""

    def __init__(self, primitives, name=None, weights=None, is_visible=True):
        self.primitives = list(primitives)
        self.name = None if name is None else str(name)
        self.weights = weights
        self.is_visible = is_visible

    @property
    def bounds(self):
        """The lowest and the highest corner."""
        each = [primitive.bounds for primitive in self.primitives]
        if not each:
            return np.array([[np.inf] * 3, [-np.inf] * 3])
        return np.array([np.min([box[0] for box in each], axis=0), np.max([box[1] for box in each], axis=0)])

    @property
    def is_transparent(self):
        """Whether anything is seen through it."""
        return any(primitive.is_transparent for primitive in self.primitives)

    @staticmethod
    def from_points(points, colors=None, normals=None, is_visible=True, poses=None):
        """A cloud of points."""
        return Mesh([Primitive(points, normals=normals, color_0=colors, mode=0, poses=poses)], is_visible=is_visible)

    @staticmethod
    def from_trimesh(mesh, material=None, is_visible=True, poses=None, wireframe=False, smooth=True):
        """A mesh of trimesh, or a list of them. Without a material, theirs."""
        if wireframe:
            raise NotImplementedError("wireframe: trigon draws wires in its viewer and in Rust")
        is_list = isinstance(mesh, (list, tuple, set, np.ndarray))
        if not is_list and not hasattr(mesh, "faces"):
            raise TypeError(f"a mesh of trimesh or a list of them, not {type(mesh).__name__}")
        meshes = mesh if is_list else [mesh]
        return Mesh([_of_trimesh(each, material, poses, smooth) for each in meshes], is_visible=is_visible)


def _of_trimesh(source: Any, material: Any, poses: Any, smooth: bool) -> Primitive:
    faces = np.asarray(source.faces)
    # Without smooth normals each face has corners of its own.
    corners = (lambda values: np.asarray(values)) if smooth else (lambda values: np.asarray(values)[faces.ravel()])
    normals = source.vertex_normals if smooth else np.repeat(source.face_normals, 3, axis=0)
    colors = uvs = None
    visual = source.visual
    kind = visual.kind if getattr(visual, "defined", False) else None
    if kind == "face" and smooth and material is None:
        raise ValueError("face colours need smooth=False")
    if kind == "texture" and visual.uv is not None and len(visual.uv):
        uvs = corners(visual.uv)
    if material is not None:
        material = copy.copy(material)
    elif kind == "texture":
        material = of_trimesh(visual.material)
    else:
        if kind == "vertex":
            colors = corners(visual.vertex_colors)
        elif kind == "face":
            colors = np.repeat(np.asarray(visual.face_colors), 3, axis=0)
        material = usual(0.3 if colors is None else 1.0)
    return Primitive(
        corners(source.vertices),
        normals=normals,
        texcoord_0=uvs,
        color_0=colors,
        indices=faces if smooth else None,
        material=material,
        poses=poses,
    )
