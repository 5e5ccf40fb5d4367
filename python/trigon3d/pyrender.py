"""The interface of pyrender on trigon: change ``import pyrender`` to ``from trigon3d import pyrender``.

Scenes, nodes, meshes, cameras, lights and ``OffscreenRenderer`` have pyrender's names, arguments and results. Without
OpenGL, no display is needed and the bytes are the same on every machine. What differs:

- Images are anti-aliased with 9 samples a pixel, in linear light.
- Depth and segmentation are those of the middle of each pixel. Alone, they are drawn with one sample a pixel, and may
  differ from those beside colours by a pixel along outlines.
- Wires, normals as lines and the window (``Viewer``) are not there: ``NotImplementedError``.

>>> import numpy as np
>>> from trigon3d import pyrender
>>> scene = pyrender.Scene(bg_color=[0, 0, 0, 0])
>>> triangle = pyrender.Primitive(positions=[[-1, -1, 0], [1, -1, 0], [0, 1, 0]])
>>> node = scene.add(pyrender.Mesh([triangle]))
>>> pose = np.eye(4)
>>> pose[2, 3] = 5
>>> _ = scene.add(pyrender.PerspectiveCamera(yfov=0.7), pose=pose)
>>> _ = scene.add(pyrender.DirectionalLight(intensity=3.0), pose=pose)
>>> color, depth = pyrender.OffscreenRenderer(64, 48).render(scene)
>>> color.shape, float(depth[24, 32]), float(depth[0, 0])
((48, 64, 3), 5.0, 0.0)
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _trigon3d as trigon
from ._trimesh import mesh_arguments

__all__ = [
    "DirectionalLight",
    "IntrinsicsCamera",
    "Mesh",
    "MetallicRoughnessMaterial",
    "Node",
    "OffscreenRenderer",
    "OrthographicCamera",
    "PerspectiveCamera",
    "PointLight",
    "Primitive",
    "RenderFlags",
    "Scene",
    "SpotLight",
    "Viewer",
]


class RenderFlags:
    """How ``OffscreenRenderer.render`` draws, joined by ``|``."""

    NONE = 0
    DEPTH_ONLY = 1
    OFFSCREEN = 2
    FLIP_WIREFRAME = 4
    ALL_WIREFRAME = 8
    ALL_SOLID = 16
    SHADOWS_DIRECTIONAL = 32
    SHADOWS_POINT = 64
    SHADOWS_SPOT = 128
    SHADOWS_ALL = 32 | 64 | 128
    VERTEX_NORMALS = 256
    FACE_NORMALS = 512
    SKIP_CULL_FACES = 1024
    RGBA = 2048
    FLAT = 4096
    SEG = 8192


def _color(value: Any, usual: Any, length: int) -> np.ndarray:
    """A colour of 3 or 4 numbers from 0 to 1; bytes are divided by 255."""
    if value is None:
        return np.asarray(usual, dtype=np.float64)
    color = np.asarray(value)
    color = color / 255 if color.dtype.kind in "iu" and color.max(initial=0) > 1 else color.astype(np.float64)
    color = color.ravel()
    if len(color) == 3 and length == 4:
        color = np.append(color, 1.0)
    return np.clip(color[:length], 0, 1)


class MetallicRoughnessMaterial:
    """How a surface looks. ``baseColorFactor`` is linear light, as in glTF; a texture is an array of bytes or an image."""

    def __init__(
        self,
        name=None,
        baseColorFactor=None,
        metallicFactor=1.0,
        roughnessFactor=1.0,
        baseColorTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
    ):
        self.name = name
        self.baseColorFactor = _color(baseColorFactor, np.ones(4), 4)
        self.metallicFactor = metallicFactor
        self.roughnessFactor = roughnessFactor
        self.baseColorTexture = baseColorTexture
        self.emissiveFactor = _color(emissiveFactor, np.zeros(3), 3)
        self.alphaMode = alphaMode or "OPAQUE"
        self.alphaCutoff = 0.5 if alphaCutoff is None else alphaCutoff
        self.doubleSided = doubleSided
        self.smooth = smooth
        self.wireframe = wireframe

    def _translated(self, double_sided: bool) -> trigon.Material:
        texture = self.baseColorTexture
        texture = getattr(texture, "source", texture)
        if texture is not None and hasattr(texture, "convert"):
            texture = texture.convert("RGBA")
        srgb = _encoded(self.baseColorFactor[:3])
        return trigon.Material(
            [*srgb, float(self.baseColorFactor[3])],
            metallic=self.metallicFactor,
            roughness=self.roughnessFactor,
            emission=_encoded(self.emissiveFactor),
            double_sided=double_sided or self.doubleSided,
            alpha_mode=self.alphaMode.lower(),
            alpha_cutoff=self.alphaCutoff,
            texture=None if texture is None else np.asarray(texture, dtype=np.uint8),
        )


def _encoded(linear: Any) -> list[float]:
    """Linear light as sRGB."""
    linear = np.asarray(linear, dtype=np.float64)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055).tolist()


class Primitive:
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
        self.positions = np.asarray(positions, dtype=np.float32)
        self.normals = normals
        self.texcoord_0 = texcoord_0
        self.color_0 = color_0
        self.indices = indices
        self.material = material
        self.mode = 4 if mode is None else mode
        self.poses = poses
        if self.mode not in (0, 4):
            raise NotImplementedError(f"mode {mode}: there are points (0) and triangles (4)")

    @property
    def bounds(self):
        """The lowest and the highest corner."""
        return np.array([self.positions.min(axis=0), self.positions.max(axis=0)])

    def _add_to(self, scene: trigon.Scene, pose: np.ndarray, name: str, double_sided: bool) -> list[int]:
        poses = [np.eye(4)] if self.poses is None else np.asarray(self.poses).reshape(-1, 4, 4)
        colors = None if self.color_0 is None else np.asarray(self.color_0)
        if self.mode == 0:
            return [scene.add_points(self.positions, colors=colors, pose=pose @ each, name=name) for each in poses]
        faces = np.arange(len(self.positions)) if self.indices is None else np.asarray(self.indices)
        material = self.material or MetallicRoughnessMaterial(baseColorFactor=[1.0, 1.0, 1.0, 1.0], metallicFactor=0.2)
        translated = material if isinstance(material, trigon.Material) else material._translated(double_sided)
        named = {"normals": self.normals, "uvs": self.texcoord_0, "colors": colors}
        named = {key: np.asarray(value) for key, value in named.items() if value is not None}
        return [
            scene.add_mesh(
                self.positions, faces.reshape(-1, 3), material=translated, pose=pose @ each, name=name, **named
            )
            for each in poses
        ]


class Mesh:
    """What a node shows: one primitive or several."""

    def __init__(self, primitives, name=None, weights=None, is_visible=True):
        self.primitives = list(primitives)
        self.name = name
        self.is_visible = is_visible

    @property
    def bounds(self):
        """The lowest and the highest corner."""
        each = [primitive.bounds for primitive in self.primitives]
        return np.array([np.min([box[0] for box in each], axis=0), np.max([box[1] for box in each], axis=0)])

    @staticmethod
    def from_points(points, colors=None, normals=None, is_visible=True, poses=None):
        """A cloud of points."""
        return Mesh([Primitive(points, normals=normals, color_0=colors, mode=0, poses=poses)], is_visible=is_visible)

    @staticmethod
    def from_trimesh(mesh, material=None, is_visible=True, poses=None, wireframe=False, smooth=True):
        """A mesh of trimesh, or a list of them. Without a material, theirs."""
        if wireframe:
            raise NotImplementedError("wireframe: trigon draws wires in its viewer and in Rust")
        meshes = mesh if isinstance(mesh, (list, tuple, set)) else [mesh]
        primitives = [_Trimesh(each, material, poses, smooth) for each in meshes]
        return Mesh(primitives, is_visible=is_visible)


class _Trimesh(Primitive):
    """A mesh of trimesh with its colours and textures."""

    def __init__(self, source, material, poses, smooth):
        super().__init__(source.vertices, poses=poses, material=material)
        self.source = source
        self.smooth = smooth

    def _add_to(self, scene, pose, name, double_sided):
        poses = [np.eye(4)] if self.poses is None else np.asarray(self.poses).reshape(-1, 4, 4)
        arguments = mesh_arguments(self.source)
        has_face_colors = arguments.get("colors") is not None and self.source.visual.kind == "face"
        if self.smooth and not has_face_colors:
            arguments["normals"] = self.source.vertex_normals
        if self.material is not None:
            arguments["material"] = self.material._translated(double_sided)
        faces = np.asarray(self.source.faces)
        return [scene.add_mesh(self.positions, faces, pose=pose @ each, name=name, **arguments) for each in poses]


class _Camera:
    def __init__(self, znear=0.05, zfar=100.0, name=None):
        self.znear, self.zfar, self.name = znear, zfar, name


class PerspectiveCamera(_Camera):
    """``yfov`` is the vertical field of view in radians."""

    def __init__(self, yfov, znear=0.05, zfar=None, aspectRatio=None, name=None):
        super().__init__(znear, zfar, name)
        self.yfov, self.aspectRatio = yfov, aspectRatio

    def _translated(self, pose, width, height):
        return trigon.Camera.perspective(math.degrees(self.yfov), pose=pose, near=self.znear, far=self.zfar)


class OrthographicCamera(_Camera):
    """``xmag`` and ``ymag`` are half the width and height of the view."""

    def __init__(self, xmag, ymag, znear=0.05, zfar=100.0, name=None):
        super().__init__(znear, zfar, name)
        self.xmag, self.ymag = xmag, ymag

    def _translated(self, pose, width, height):
        return trigon.Camera.orthographic(2 * self.ymag, pose=pose, near=self.znear, far=self.zfar)


class IntrinsicsCamera(_Camera):
    """A calibrated camera, in pixels of the image that is drawn."""

    def __init__(self, fx, fy, cx, cy, znear=0.05, zfar=100.0, name=None):
        super().__init__(znear, zfar, name)
        self.fx, self.fy, self.cx, self.cy = fx, fy, cx, cy

    def _translated(self, pose, width, height):
        matrix = [[self.fx, 0, self.cx], [0, self.fy, self.cy], [0, 0, 1]]
        planes = {"near": self.znear, "far": self.zfar}
        return trigon.Camera.from_intrinsics(matrix, width, height, pose, convention="opengl", **planes)


class _Light:
    _kind = ""

    def __init__(self, color=None, intensity=None, name=None):
        self.color = _color(color, np.ones(3), 3)
        self.intensity = 1.0 if intensity is None else intensity
        self.name = name

    def _add_to(self, scene: trigon.Scene, pose: np.ndarray) -> int:
        # Light of 1 from the front makes white of a white surface here, and 1/pi of it there.
        strength = {"color": _encoded(self.color), "intensity": self.intensity / math.pi}
        place = {"position": pose[:3, 3].tolist(), "direction": (-pose[:3, 2]).tolist()}
        return scene.add_light(self._kind, **strength, **place, **self._named())

    def _named(self) -> dict[str, float]:
        return {}


class DirectionalLight(_Light):
    """Parallel light along −Z of its node."""

    _kind = "directional"


class PointLight(_Light):
    """Light from a point. It has no range."""

    _kind = "point"

    def __init__(self, color=None, intensity=None, range=None, name=None):
        super().__init__(color, intensity, name)
        self.range = range


class SpotLight(_Light):
    """Light from a point in a cone about −Z of its node; angles are half angles in radians."""

    _kind = "spot"

    def __init__(
        self, color=None, intensity=None, range=None, innerConeAngle=0.0, outerConeAngle=math.pi / 4, name=None
    ):
        super().__init__(color, intensity, name)
        self.range, self.innerConeAngle, self.outerConeAngle = range, innerConeAngle, outerConeAngle

    def _named(self):
        return {"angle": math.degrees(self.outerConeAngle)}


class Node:
    """A place in a scene, with a mesh, a camera or a light, and other nodes below it."""

    def __init__(self, name=None, camera=None, mesh=None, light=None, matrix=None, children=None):
        self.name, self.camera, self.mesh, self.light = name, camera, mesh, light
        self.matrix = np.eye(4) if matrix is None else np.array(matrix, dtype=np.float64)
        self.children = list(children or [])


class Scene:
    """A tree of nodes."""

    def __init__(self, nodes=None, bg_color=None, ambient_light=None, name=None):
        self.bg_color = _color(bg_color, np.ones(4), 4)
        self.ambient_light = _color(ambient_light, np.zeros(3), 3)
        self.name = name
        self.main_camera_node = None
        self._roots: list[Node] = []
        self._translations: dict[bool, _Translation] = {}
        for node in nodes or []:
            self.add_node(node)

    def add(self, obj, name=None, pose=None, parent_node=None, parent_name=None):
        """Adds a mesh, a camera or a light in a node of its own, which is returned."""
        node = Node(name=name, matrix=pose)
        if isinstance(obj, Mesh):
            node.mesh = obj
        elif isinstance(obj, _Light):
            node.light = obj
        elif isinstance(obj, _Camera):
            node.camera = obj
        else:
            raise TypeError(f"a scene holds meshes, cameras and lights, not {type(obj).__name__}")
        node.name = name or getattr(obj, "name", None)
        if parent_node is None and parent_name is not None:
            found = [each for each in self.nodes if each.name == parent_name]
            if len(found) != 1:
                raise ValueError(f"{len(found)} nodes have the name {parent_name!r}")
            parent_node = found[0]
        self.add_node(node, parent_node)
        return node

    def add_node(self, node, parent_node=None):
        """Adds a node, below another one or at the top."""
        (self._roots if parent_node is None else parent_node.children).append(node)
        cameras = [each for each, _ in _below(node, np.eye(4)) if each.camera is not None]
        if self.main_camera_node is None and cameras:
            self.main_camera_node = cameras[0]
        self._translations.clear()

    def remove_node(self, node):
        """Removes a node and all below it."""
        for nodes in (self._roots, *(each.children for each in self.nodes)):
            if node in nodes:
                nodes.remove(node)
                break
        if self.main_camera_node not in self.nodes:
            self.main_camera_node = next(iter(self.camera_nodes), None)
        self._translations.clear()

    def set_pose(self, node, pose=None):
        """Moves a node."""
        node.matrix = np.eye(4) if pose is None else np.array(pose, dtype=np.float64)

    def get_pose(self, node):
        """Where a node is in the world."""
        return next(pose for each, pose in self._placed() if each is node)

    def has_node(self, node):
        """Whether a node belongs to the scene."""
        return node in self.nodes

    def get_nodes(self, node=None, name=None, obj=None, obj_name=None):
        """The nodes that are this one, have this name, hold this object, or one of this name."""
        held = [(each, each.mesh or each.light or each.camera) for each in self.nodes]
        return {
            each
            for each, item in held
            if (node is None or each is node)
            and (name is None or each.name == name)
            and (obj is None or item is obj)
            and (obj_name is None or getattr(item, "name", None) == obj_name)
        }

    def _placed(self):
        for root in self._roots:
            yield from _below(root, np.eye(4))

    @property
    def nodes(self):
        """All nodes."""
        return [node for node, _ in self._placed()]

    @property
    def mesh_nodes(self):
        """Those with a mesh."""
        return [node for node in self.nodes if node.mesh is not None]

    @property
    def camera_nodes(self):
        """Those with a camera."""
        return [node for node in self.nodes if node.camera is not None]

    @property
    def light_nodes(self):
        """Those with a light."""
        return [node for node in self.nodes if node.light is not None]

    @property
    def meshes(self):
        """What the nodes show."""
        return {node.mesh for node in self.mesh_nodes}

    @property
    def bounds(self):
        """The lowest and the highest corner of everything."""
        bounds = self._translation(double_sided=True).scene.bounds
        return np.zeros((2, 3)) if bounds is None else np.array(bounds)

    def _translation(self, double_sided: bool) -> _Translation:
        """The scene as trigon has it, at the nodes' present poses."""
        if double_sided not in self._translations:
            self._translations[double_sided] = _Translation(self, double_sided)
        translation = self._translations[double_sided]
        translation.follow(self)
        return translation


def _below(top: Node, pose: np.ndarray):
    """A node and all below it, each after its parent, with their poses in the world."""
    # Without recursion, so that trees may be of any depth.
    waiting, path, above = [(top, pose, 0)], [], set()
    while waiting:
        node, pose, depth = waiting.pop()
        while len(path) > depth:
            above.discard(path.pop())
        if id(node) in above:
            raise ValueError(f"the node {node.name!r} is below itself: a child is one of its own parents")
        path.append(id(node))
        above.add(id(node))
        pose = pose @ node.matrix
        yield node, pose
        waiting += [(child, pose, depth + 1) for child in reversed(node.children)]


class _Translation:
    """A scene of trigon, and which of its nodes belong to which of ours."""

    def __init__(self, source: Scene, double_sided: bool):
        self.scene = trigon.Scene()
        self.owners: dict[int, Node] = {}
        self.poses: dict[Node, np.ndarray] = {}
        self.lights: list[int] = []
        self.held: list[tuple[int, Node, np.ndarray]] = []
        for node, _ in source._placed():
            if node.mesh is None:
                continue
            for primitive in node.mesh.primitives:
                # At the origin: where it is in the node is kept, and `follow` moves it.
                for index in primitive._add_to(self.scene, np.eye(4), str(node.name), double_sided):
                    self.owners[index] = node
                    self.held.append((index, node, self._own_pose(index)))
        self.light_state: Any = None

    def _own_pose(self, index: int) -> np.ndarray:
        return next(each["pose"] for each in self.scene.nodes if each["id"] == index)

    def follow(self, source: Scene) -> None:
        """Moves what has moved, and makes the lights anew if they have changed."""
        placed = dict(source._placed())
        moved = {node for node, pose in placed.items() if not np.array_equal(self.poses.get(node), pose)}
        for index, node, own in self.held:
            if node in moved:
                self.scene.set_pose(index, placed[node] @ own)
        self.poses = placed
        lights = [(node.light, pose) for node, pose in placed.items() if node.light is not None]
        state = [(id(light), light.color.tolist(), light.intensity, pose.tolist()) for light, pose in lights]
        state.append(source.ambient_light.tolist())
        if state != self.light_state:
            for index in self.lights:
                self.scene.remove(index)
            self.lights = [light._add_to(self.scene, pose) for light, pose in lights]
            ambient = float(source.ambient_light.max(initial=0))
            # Without any light it would be lit by a studio, where pyrender shows black.
            color = source.ambient_light / ambient if ambient > 0 else np.ones(3)
            self.lights.append(self.scene.add_light("ambient", color=_encoded(color), intensity=ambient))
            self.light_state = state

    def show(self, nodes: Any) -> None:
        """Shows the meshes of these nodes alone; all visible ones with ``None``."""
        for index, node in self.owners.items():
            self.scene.set_visible(index, node.mesh.is_visible and (nodes is None or node in nodes))


class OffscreenRenderer:
    """Draws scenes into arrays."""

    def __init__(self, viewport_width, viewport_height, point_size=1.0):
        self.viewport_width = viewport_width
        self.viewport_height = viewport_height
        self.point_size = point_size

    def render(self, scene, flags=RenderFlags.NONE, seg_node_map=None):
        """The colours, (h, w, 3) bytes or (h, w, 4) with ``RGBA``, and the depth (h, w), 0 where nothing is.

        With ``DEPTH_ONLY`` the depth alone. With ``SEG`` the colours are those of ``seg_node_map``, and nodes that are
        not in it are not drawn.
        """
        missing = RenderFlags.FLIP_WIREFRAME | RenderFlags.ALL_WIREFRAME
        missing |= RenderFlags.VERTEX_NORMALS | RenderFlags.FACE_NORMALS
        if flags & missing:
            raise NotImplementedError("wires and normals as lines are drawn by trigon's viewer and in Rust")
        if scene.main_camera_node is None:
            raise ValueError("the scene has no camera; add one")
        width, height = int(self.viewport_width), int(self.viewport_height)
        camera_node = scene.main_camera_node
        camera = camera_node.camera._translated(scene.get_pose(camera_node), width, height)
        translation = scene._translation(bool(flags & RenderFlags.SKIP_CULL_FACES))
        is_seg, depth_only = bool(flags & RenderFlags.SEG), bool(flags & RenderFlags.DEPTH_ONLY)
        translation.show((seg_node_map or {}).keys() if is_seg else None)
        background = scene.bg_color
        named = {"lighting": "scene", "point_size": float(self.point_size), "flat": bool(flags & RenderFlags.FLAT)}
        named["shadows"] = bool(flags & RenderFlags.SHADOWS_ALL)
        if depth_only or is_seg:
            frame = translation.scene.render(width, height, camera, outputs=("depth", "object_ids"), samples=1, **named)
        else:
            named["background"] = background[:3].tolist() if background[3] == 1 else "transparent"
            frame = translation.scene.render(width, height, camera, outputs=("color", "depth"), **named)
        depth = np.where(np.isinf(frame.depth), np.float32(0), frame.depth)
        if depth_only:
            return depth
        if is_seg:
            return self._segmented(frame.object_ids, translation, seg_node_map or {}), depth
        color = _over(frame.color, background)
        return (color if flags & RenderFlags.RGBA else np.ascontiguousarray(color[..., :3])), depth

    def _segmented(self, ids: np.ndarray, translation: _Translation, colors: dict[Node, Any]) -> np.ndarray:
        # The last row is that of the background, whose id is -1.
        table = np.zeros((max(translation.owners, default=0) + 2, 3), dtype=np.uint8)
        for index, node in translation.owners.items():
            table[index] = np.broadcast_to(np.asarray(colors.get(node, 0)).astype(np.uint8), 3)
        table[-1] = 0
        return table[ids]

    def delete(self):
        """Nothing has to be given back."""


def _over(color: np.ndarray, background: np.ndarray) -> np.ndarray:
    """An image with alpha over a background that has alpha, too."""
    if background[3] in (0, 1):
        if background[3] == 1 or not (color[..., 3] == 0).any():
            return color
        # pyrender shows the background's colour where its alpha is 0.
        empty = color[..., 3] == 0
        color = color.copy()
        color[empty, :3] = np.round(background[:3] * 255)
        return color
    alpha = color[..., 3:] / 255
    below = background[3] * (1 - alpha)
    total = alpha + below
    rgb = (color[..., :3] * alpha + background[:3] * 255 * below) / total
    return np.concatenate([rgb, total * 255], axis=-1).round().astype(np.uint8)


class Viewer:
    """pyrender's window, which is not here."""

    def __init__(self, *_arguments, **_named):
        raise NotImplementedError("there is no window in this module: write a GLB and open it with trigon-viewer")
