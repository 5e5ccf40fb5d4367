"""Exact 3D rendering on the CPU: images, depth, ids and normals as NumPy arrays.

The same scene, camera and arguments give the same bytes on every machine, with any number of threads.

>>> import trigon3d
>>> scene = trigon3d.Scene()
>>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
>>> frame = scene.render(320, 240, outputs=("color", "depth", "object_ids"))
>>> frame.color.shape, frame.depth.dtype, frame.object_ids.dtype
((240, 320, 4), dtype('float32'), dtype('int32'))
"""

from collections.abc import Iterable, Iterator
from typing import Any

from ._trigon3d import (
    Camera,
    Frame,
    LoadError,
    Material,
    RenderError,
    Scene,
    TrigonError,
    TrigonWarning,
    load,
    load_cameras,
    set_threads,
)
from ._trimesh import from_trimesh, save_image

__all__ = [
    "Camera",
    "Frame",
    "LoadError",
    "Material",
    "RenderError",
    "Scene",
    "TrigonError",
    "TrigonWarning",
    "from_trimesh",
    "load",
    "load_cameras",
    "render_many",
    "save_image",
    "set_threads",
]
__version__ = "0.1.0"


def render_many(
    scene: Scene, cameras: Iterable[Camera], width: int, height: int, **named: Any
) -> Iterator[Frame]:
    """Draws what each camera sees, one frame at a time, with the named arguments of ``Scene.render``.

    Threads and memory are kept from one frame to the next.

    >>> import trigon3d
    >>> scene = trigon3d.Scene()
    >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> frames = trigon3d.render_many(scene, scene.surround(3), 64, 64, outputs=("depth",))
    >>> [frame.depth.shape for frame in frames]
    [(64, 64), (64, 64), (64, 64)]
    """
    for camera in cameras:
        yield scene.render(width, height, camera, **named)
