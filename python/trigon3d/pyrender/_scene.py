"""Nodes and scenes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._materials import Look, color_vector
from ._meshes import Mesh, _Measured
from ._translation import Translation
from ._views import Camera, DirectionalLight, Light, PointLight, SpotLight


def _held(kind: type, name: str, what: str) -> property:
    """An attribute that is `None` or of one class."""

    def get(self):
        return self.__dict__[name]

    def put(self, value):
        if value is not None and not isinstance(value, kind):
            raise TypeError(f"{name} is a {kind.__name__}, not {type(value).__name__}")
        self.__dict__[name] = value

    return property(get, put, doc=what)


class Node:
    """A place in a scene, with a mesh, a camera or a light, and other nodes below it.

    ``matrix``, or ``translation``, ``rotation`` (a quaternion x, y, z, w) and ``scale``.
    """

    def __init__(
        self,
        name=None,
        camera=None,
        children=None,
        skin=None,
        matrix=None,
        mesh=None,
        rotation=None,
        scale=None,
        translation=None,
        weights=None,
        light=None,
    ):
        self.name, self.skin, self.weights = None if name is None else str(name), skin, weights
        self.camera, self.mesh, self.light = camera, mesh, light
        self.children = [] if children is None else list(children)
        self.matrix = np.eye(4) if matrix is None else matrix
        if matrix is None:
            self.translation = np.zeros(3) if translation is None else translation
            self.rotation = [0, 0, 0, 1] if rotation is None else rotation
            self.scale = np.ones(3) if scale is None else scale

    camera = _held(Camera, "camera", "The camera of the node.")
    mesh = _held(Mesh, "mesh", "The mesh of the node.")
    light = _held(Light, "light", "The light of the node.")

    @property
    def matrix(self):
        """From the node to its parent."""
        return self._matrix

    @matrix.setter
    def matrix(self, value):
        matrix = np.array(value, dtype=np.float64)
        if matrix.shape != (4, 4) or not np.array_equal(matrix[3], [0, 0, 0, 1]):
            raise ValueError("a matrix has 4 rows of 4 numbers, and its last row is 0 0 0 1")
        self._matrix = matrix

    @property
    def translation(self):
        """Where its origin is."""
        return self._matrix[:3, 3].copy()

    @translation.setter
    def translation(self, value):
        self._matrix[:3, 3] = value

    @property
    def scale(self):
        """Factors along its axes."""
        return np.linalg.norm(self._matrix[:3, :3], axis=0)

    @scale.setter
    def scale(self, value):
        self._matrix[:3, :3] = self._turn() * np.broadcast_to(np.asarray(value, dtype=np.float64), 3)

    @property
    def rotation(self):
        """The quaternion x, y, z, w."""
        return _quaternion(self._turn())

    @rotation.setter
    def rotation(self, value):
        rotation = np.asarray(value, dtype=np.float64)
        if rotation.shape != (4,) or abs(np.linalg.norm(rotation) - 1) > 1e-3:
            raise ValueError("a rotation is a quaternion x, y, z, w of length 1")
        self._matrix[:3, :3] = _turned(rotation) * self.scale

    def _turn(self) -> np.ndarray:
        scale = self.scale
        return self._matrix[:3, :3] / np.where(scale == 0, 1, scale)


def _turned(quaternion: np.ndarray) -> np.ndarray:
    """The matrix of a quaternion."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _quaternion(turn: np.ndarray) -> np.ndarray:
    """The quaternion of a rotation, by Bar-Itzhack, "New Method for Extracting the Quaternion from a Rotation Matrix", 2000."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn
    matrix = np.array(
        [
            [xx - yy - zz, yx + xy, zx + xz, zy - yz],
            [yx + xy, yy - xx - zz, zy + yz, xz - zx],
            [zx + xz, zy + yz, zz - xx - yy, yx - xy],
            [zy - yz, xz - zx, yx - xy, xx + yy + zz],
        ]
    )
    _, vectors = np.linalg.eigh(matrix / 3)
    quaternion = vectors[:, -1]
    return quaternion if quaternion[3] >= 0 else -quaternion


def below(top: Node, pose: np.ndarray):
    """A node and all below it, each after its parent, with their poses in the world."""
    # Without recursion, so that trees may be of any depth.
    path: list[int] = []
    waiting, above = [(top, pose, 0)], set()
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


# Of one scene at a time: with and without back faces, lit and flat.
MOST_TRANSLATIONS = 4


class Scene(_Measured):
    """A tree of nodes."""

    def __init__(self, nodes=None, bg_color=None, ambient_light=None, name=None):
        self.bg_color = bg_color
        self.ambient_light = ambient_light
        self.name = name
        self._main_camera_node = None
        self._roots: list[Node] = []
        self._translations: dict[tuple, Translation] = {}
        nodes = list(nodes or [])
        children = {id(child) for node in nodes for child in node.children}
        roots = [node for node in nodes if id(node) not in children]
        if nodes and not roots:
            raise ValueError("every node is below another one: the nodes are a ring")
        for node in roots:
            self.add_node(node)

    @property
    def bg_color(self):
        """The background's red, green, blue and alpha."""
        return self._bg_color

    @bg_color.setter
    def bg_color(self, value):
        self._bg_color = np.ones(4) if value is None else color_vector(value, 4)

    @property
    def ambient_light(self):
        """Light from everywhere, three linear numbers."""
        return self._ambient_light

    @ambient_light.setter
    def ambient_light(self, value):
        self._ambient_light = np.zeros(3) if value is None else color_vector(value, 3)

    def add(self, obj, name=None, pose=None, parent_node=None, parent_name=None):
        """Adds a mesh, a camera or a light in a node of its own, which is returned."""
        kinds = (("mesh", Mesh), ("light", Light), ("camera", Camera))
        held = {key: obj for key, kind in kinds if isinstance(obj, kind)}
        if not held:
            raise TypeError(f"a scene holds meshes, cameras and lights, not {type(obj).__name__}")
        if parent_node is None and parent_name is not None:
            found = list(self.get_nodes(name=parent_name))
            if len(found) != 1:
                raise ValueError(f"{len(found)} nodes have the name {parent_name!r}")
            parent_node = found[0]
        node = Node(name=name, matrix=pose, **held)
        self.add_node(node, parent_node)
        return node

    def add_node(self, node, parent_node=None):
        """Adds a node, below another one or at the top."""
        present = self.nodes
        if parent_node is not None and parent_node not in present:
            raise ValueError("the parent is not in the scene")
        added = [each for each, _ in below(node, np.eye(4))]
        if len(set(added)) < len(added) or any(each in present for each in added):
            raise ValueError("a node has one parent: it is in the scene, or below two nodes")
        (self._roots if parent_node is None else parent_node.children).append(node)
        if self.main_camera_node is None:
            self._main_camera_node = next((each for each in added if each.camera is not None), None)

    def remove_node(self, node):
        """Removes a node and all below it."""
        for nodes in (self._roots, *(each.children for each in self.nodes)):
            if node in nodes:
                nodes.remove(node)
                break
        if self._main_camera_node not in self.nodes:
            self._main_camera_node = next(iter(self.camera_nodes), None)

    def clear(self):
        """Removes everything."""
        self._roots.clear()
        self._main_camera_node = None

    @property
    def main_camera_node(self):
        """The node of the camera that is drawn with: the first, until another is chosen."""
        return self._main_camera_node

    @main_camera_node.setter
    def main_camera_node(self, value):
        if value not in self.nodes or value.camera is None:
            raise ValueError("the main camera is a node of the scene with a camera")
        self._main_camera_node = value

    def set_pose(self, node, pose=None):
        """Moves a node."""
        if node not in self.nodes:
            raise ValueError("the node is not in the scene")
        node.matrix = np.eye(4) if pose is None else pose

    def get_pose(self, node):
        """Where a node is in the world."""
        for each, pose in self.placed():
            if each is node:
                return pose
        raise ValueError("the node is not in the scene")

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

    def placed(self):
        """All nodes with their poses in the world."""
        for root in self._roots:
            yield from below(root, np.eye(4))

    def _with(self, name: str, kind: type = object):
        nodes = (node for node, _ in self.placed() if isinstance(getattr(node, name), kind))
        return dict.fromkeys(node for node in nodes if getattr(node, name) is not None).keys()

    def _things(self, name: str, kind: type = object):
        return dict.fromkeys(getattr(node, name) for node in self._with(name, kind)).keys()

    # Sets in the order of the tree, so that what is numbered by them is the same in every run.
    nodes = property(lambda self: dict.fromkeys(node for node, _ in self.placed()).keys(), doc="All nodes.")
    mesh_nodes = property(lambda self: self._with("mesh"), doc="The nodes with a mesh.")
    camera_nodes = property(lambda self: self._with("camera"), doc="The nodes with a camera.")
    light_nodes = property(lambda self: self._with("light"), doc="The nodes with a light.")
    point_light_nodes = property(lambda self: self._with("light", PointLight), doc="Those with a point light.")
    spot_light_nodes = property(lambda self: self._with("light", SpotLight), doc="Those with a spot light.")
    directional_light_nodes = property(lambda self: self._with("light", DirectionalLight), doc="Those with such a light.")
    meshes = property(lambda self: self._things("mesh"), doc="What the nodes show.")
    cameras = property(lambda self: self._things("camera"), doc="Their cameras.")
    lights = property(lambda self: self._things("light"), doc="Their lights.")
    point_lights = property(lambda self: self._things("light", PointLight), doc="Those from a point.")
    spot_lights = property(lambda self: self._things("light", SpotLight), doc="Those in a cone.")
    directional_lights = property(lambda self: self._things("light", DirectionalLight), doc="Those of parallel light.")

    @property
    def bounds(self):
        """The lowest and the highest corner of everything."""
        bounds = self.translation(Look(is_double_sided=True, is_flat=False)).scene.bounds
        return np.zeros((2, 3)) if bounds is None else np.array(bounds)

    def translation(self, look: Look) -> Translation:
        """The scene as trigon has it, at the nodes' present poses."""
        placed = list(self.placed())
        if not look.is_flat and all(node.light is None for node, _ in placed):
            look = Look(look.is_double_sided, look.is_flat, self.ambient_light)
        held = self._translations.get(look.key())
        if held is None or not held.holds(placed):
            held = Translation(placed, look)
            # The latest last.
            self._translations.pop(look.key(), None)
            self._translations[look.key()] = held
            if len(self._translations) > MOST_TRANSLATIONS:
                del self._translations[next(iter(self._translations))]
        held.follow(placed, self.ambient_light)
        return held

    @staticmethod
    def from_trimesh_scene(trimesh_scene: Any, bg_color=None, ambient_light=None):
        """A scene of trimesh, with its geometry and poses."""
        scene = Scene(bg_color=bg_color, ambient_light=ambient_light)
        meshes = {name: Mesh.from_trimesh(mesh, smooth=_is_smooth(mesh)) for name, mesh in trimesh_scene.geometry.items()}
        for name in trimesh_scene.graph.nodes_geometry:
            pose, geometry = trimesh_scene.graph[name]
            scene.add(meshes[geometry], pose=pose)
        return scene


def _is_smooth(mesh: Any) -> bool:
    return getattr(mesh.visual, "kind", None) != "face"
