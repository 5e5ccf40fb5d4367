"""A scene of pyrender's as one of trigon's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _trigon3d as trigon
from .._colors import encoded
from ._materials import Look

if TYPE_CHECKING:
    from ._scene import Node

Placed = list[tuple["Node", np.ndarray]]


class Translation:
    """A scene of trigon, and which of its nodes belong to which of pyrender's."""

    def __init__(self, placed: Placed, look: Look):
        self.scene = trigon.Scene()
        self.owners: dict[int, Node] = {}
        self.poses: dict[Node, np.ndarray] = {}
        self.lights: list[int] = []
        self.own: dict[int, np.ndarray] = {}
        self.source = _meshes(placed)
        for node, _ in placed:
            for primitive in node.mesh.primitives if node.mesh is not None else ():
                for index, own in primitive._add_to(self.scene, str(node.name), look):
                    self.owners[index], self.own[index] = node, own
        self.light_state: Any = None

    def holds(self, placed: Placed) -> bool:
        """Whether it was made of these nodes and meshes."""
        return self.source == _meshes(placed)

    def follow(self, placed: Placed, ambient_light: np.ndarray) -> None:
        """Moves what has moved, and makes the lights anew if they have changed."""
        poses = dict(placed)
        for index, node in self.owners.items():
            if node not in self.poses or not np.array_equal(self.poses[node], poses[node]):
                self.scene.set_pose(index, poses[node] @ self.own[index])
        self.poses = poses
        lights = [(node.light, pose) for node, pose in placed if node.light is not None]
        state = [(light._state(), pose.tolist()) for light, pose in lights], ambient_light.tolist()
        if state == self.light_state:
            return
        for index in self.lights:
            self.scene.remove(index)
        self.lights = [light._add_to(self.scene, pose) for light, pose in lights]
        strength = float(ambient_light.max(initial=0))
        # Without any light it would be lit by a studio, where pyrender shows black.
        color = ambient_light / strength if strength > 0 else np.ones(3)
        self.lights.append(self.scene.add_light("ambient", color=encoded(color), intensity=strength))
        self.light_state = state

    def show(self, nodes: Any) -> None:
        """Shows the meshes of these nodes alone; all visible ones with ``None``."""
        for index, node in self.owners.items():
            self.scene.set_visible(index, node.mesh.is_visible and (nodes is None or node in nodes))


def _meshes(placed: Placed) -> list[tuple]:
    """Which meshes the nodes have, with materials as they are now."""
    return [(id(node), id(node.mesh), *_primitives(node.mesh)) for node, _ in placed if node.mesh is not None]


def _primitives(mesh: Any) -> list[tuple]:
    return [(id(each), id(each.positions), id(each.color_0), _values(each.material)) for each in mesh.primitives]


def _values(material: Any) -> tuple:
    def simple(value: Any) -> Any:
        if isinstance(value, np.ndarray) and value.size <= 4:
            return tuple(value.ravel())
        return value if isinstance(value, (str, float, int, bool, type(None))) else id(value)

    return tuple((key, simple(value)) for key, value in sorted(vars(material).items()))
