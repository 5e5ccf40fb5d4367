"""Cameras and lights."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _trigon3d as trigon
from .._colors import encoded
from ._materials import color_vector


class Camera:
    """What all cameras have: the distances of the clip planes."""

    def __init__(self, znear=0.05, zfar=100.0, name=None):
        if not znear > 0 or (zfar is not None and not zfar > znear):
            raise ValueError(f"znear {znear} and zfar {zfar}: 0 < znear < zfar")
        self.znear, self.zfar, self.name = znear, zfar, name

    def get_projection_matrix(self, width=None, height=None):
        """The matrix of 4 × 4 that takes the camera's space to OpenGL's clip space, for an image of this size."""
        matrix = np.zeros((4, 4))
        matrix[:2], matrix[3] = self._rows(width, height)
        near, far, is_flat = self.znear, self.zfar, matrix[3, 3] == 1
        if is_flat:
            matrix[2, 2:] = 2 / (near - far), (far + near) / (near - far)
        elif far is None:
            matrix[2, 2:] = -1, -2 * near
        else:
            matrix[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
        return matrix

    def _planes(self) -> dict[str, float | None]:
        return {"near": self.znear, "far": self.zfar}


class PerspectiveCamera(Camera):
    """``yfov`` is the vertical field of view in radians."""

    def __init__(self, yfov, znear=0.05, zfar=None, aspectRatio=None, name=None):
        super().__init__(znear, zfar, name)
        if not yfov > 0:
            raise ValueError(f"yfov {yfov}: it is more than 0")
        self.yfov, self.aspectRatio = float(yfov), aspectRatio

    def _rows(self, width, height):
        if self.aspectRatio is None and (width is None or height is None):
            raise ValueError("without an aspectRatio it needs the image's width and height")
        slope = math.tan(self.yfov / 2)
        aspect = width / height if self.aspectRatio is None else self.aspectRatio
        return [[1 / (aspect * slope), 0, 0, 0], [0, 1 / slope, 0, 0]], [0, 0, -1, 0]

    def _translated(self, pose, width, height):
        if self.aspectRatio is None:
            return trigon.Camera.perspective(math.degrees(self.yfov), pose=pose, **self._planes())
        # The picture is stretched to the image.
        slope = math.tan(self.yfov / 2)
        fx, fy = width / (2 * self.aspectRatio * slope), height / (2 * slope)
        matrix = [[fx, 0, width / 2], [0, fy, height / 2], [0, 0, 1]]
        return trigon.Camera.from_intrinsics(matrix, width, height, pose, convention="opengl", **self._planes())


class OrthographicCamera(Camera):
    """``ymag`` is half the height of the view; its width follows from the image, as in pyrender."""

    def __init__(self, xmag, ymag, znear=0.05, zfar=100.0, name=None):
        super().__init__(znear, zfar, name)
        if not (xmag > 0 and ymag > 0):
            raise ValueError(f"xmag {xmag} and ymag {ymag}: they are more than 0")
        self.xmag, self.ymag = float(xmag), float(ymag)

    def _rows(self, width, height):
        xmag = self.xmag if width is None or height is None else width / height * self.ymag
        return [[1 / xmag, 0, 0, 0], [0, 1 / self.ymag, 0, 0]], [0, 0, 0, 1]

    def _translated(self, pose, width, height):
        return trigon.Camera.orthographic(2 * self.ymag, pose=pose, **self._planes())


class IntrinsicsCamera(Camera):
    """A calibrated camera, in pixels of the image that is drawn."""

    def __init__(self, fx, fy, cx, cy, znear=0.05, zfar=100.0, name=None):
        super().__init__(znear, zfar, name)
        self.fx, self.fy, self.cx, self.cy = float(fx), float(fy), float(cx), float(cy)

    def _rows(self, width, height):
        across, up = 1 - 2 * self.cx / width, 2 * self.cy / height - 1
        return [[2 * self.fx / width, 0, across, 0], [0, 2 * self.fy / height, up, 0]], [0, 0, -1, 0]

    def _translated(self, pose, width, height):
        matrix = [[self.fx, 0, self.cx], [0, self.fy, self.cy], [0, 0, 1]]
        return trigon.Camera.from_intrinsics(matrix, width, height, pose, convention="opengl", **self._planes())


class Light:
    """What all lights have."""

    _kind: Any = ""

    def __init__(self, color=None, intensity=None, name=None):
        self.color = color
        self.intensity = 1.0 if intensity is None else float(intensity)
        self.name = name

    @property
    def color(self):
        """Three linear numbers."""
        return self._color

    @color.setter
    def color(self, value):
        self._color = np.ones(3) if value is None else color_vector(value, 3)

    def _add_to(self, scene: trigon.Scene, pose: np.ndarray) -> int:
        # Light of 1 from the front makes white of a white surface here, and 1/pi of it there.
        strength: dict[str, Any] = {"color": encoded(self.color), "intensity": self.intensity / math.pi}
        place = {"position": pose[:3, 3].tolist(), "direction": (-pose[:3, 2]).tolist()}
        return scene.add_light(self._kind, **strength, **place, **self._named())

    def _named(self) -> dict[str, Any]:
        return {}

    def _state(self) -> tuple:
        return id(self), *self.color.tolist(), self.intensity, *self._named().values()


class DirectionalLight(Light):
    """Parallel light along −Z of its node."""

    _kind = "directional"


class PointLight(Light):
    """Light from a point. As in pyrender, its range changes nothing."""

    _kind = "point"

    def __init__(self, color=None, intensity=None, range=None, name=None):
        super().__init__(color, intensity, name)
        self.range = range


class SpotLight(Light):
    """Light from a point in a cone about −Z of its node; angles are half angles in radians."""

    _kind = "spot"

    def __init__(
        self, color=None, intensity=None, range=None, innerConeAngle=0.0, outerConeAngle=math.pi / 4, name=None
    ):
        super().__init__(color, intensity, name)
        if not 0 <= innerConeAngle <= outerConeAngle <= math.pi / 2 + 1e-9:
            raise ValueError("0 <= innerConeAngle <= outerConeAngle <= pi / 2")
        self.range, self.innerConeAngle, self.outerConeAngle = range, float(innerConeAngle), float(outerConeAngle)

    def _named(self):
        angle = min(math.degrees(self.outerConeAngle), 90.0)
        return {"angle": angle, "inner_angle": min(math.degrees(self.innerConeAngle), angle)}
