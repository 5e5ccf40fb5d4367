"""Images of scenes, and the window that is not there."""

from __future__ import annotations

import threading
import warnings
from typing import Any

import numpy as np

from .. import _trigon3d as trigon
from ._constants import RenderFlags
from ._materials import Look


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
        is_seg, depth_only = bool(flags & RenderFlags.SEG), bool(flags & RenderFlags.DEPTH_ONLY)
        translation = scene.translation(Look(bool(flags & RenderFlags.SKIP_CULL_FACES), bool(flags & RenderFlags.FLAT)))
        translation.show((seg_node_map or {}).keys() if is_seg else None)
        named = {"lighting": "scene", "exposure": 0.0, "point_size": float(self.point_size)}
        named["shadows"] = bool(flags & RenderFlags.SHADOWS_ALL)
        if depth_only or is_seg:
            frame = translation.scene.render(width, height, camera, outputs=("depth", "object_ids"), samples=1, **named)
        else:
            background = scene.bg_color
            named["background"] = background[:3].tolist() if background[3] == 1 else "transparent"
            frame = translation.scene.render(width, height, camera, outputs=("color", "depth"), **named)
        depth = np.where(np.isinf(frame.depth), np.float32(0), frame.depth)
        if depth_only:
            return depth
        if is_seg:
            return _segmented(frame.object_ids, translation.owners, seg_node_map or {}), depth
        color = _over(frame.color, scene.bg_color)
        return (color if flags & RenderFlags.RGBA else np.ascontiguousarray(color[..., :3])), depth

    def delete(self):
        """Nothing has to be given back."""


def _segmented(ids: np.ndarray, owners: dict[int, Any], colors: dict[Any, Any]) -> np.ndarray:
    # The last row is that of the background, whose id is -1.
    table = np.zeros((max(owners, default=0) + 2, 3), dtype=np.uint8)
    for index, node in owners.items():
        table[index] = np.broadcast_to(np.asarray(colors.get(node, 0)).astype(np.uint8), 3)
    table[-1] = 0
    return table[ids]


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
    """pyrender's window, which is not here: it warns, and is as one that was closed at once.

    Scripts that show a window and then draw images run to their end.
    """

    is_active = False

    def __init__(self, scene, viewport_size=None, render_flags=None, viewer_flags=None, **named):
        self.scene = scene
        self.viewport_size = (640, 480) if viewport_size is None else viewport_size
        self.render_flags, self.viewer_flags = dict(render_flags or {}), dict(viewer_flags or {})
        self.render_lock = threading.RLock()
        message = "pyrender.Viewer: this module has no window, so nothing is shown; OffscreenRenderer draws images"
        warnings.warn(message, trigon.TrigonWarning, stacklevel=2)

    def close(self):
        """It is closed."""

    def close_external(self):
        """It is closed."""

    def save_gif(self, filename=None):
        """Without a window nothing was recorded."""
        raise NotImplementedError("there is no window, so nothing was recorded; draw frames with OffscreenRenderer")
