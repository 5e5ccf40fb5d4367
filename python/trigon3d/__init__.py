"""Exact 3D rendering on the CPU: images, depth, ids and normals as NumPy arrays.

The same scene, camera and arguments give the same bytes on every machine, with any number of threads.

>>> import trigon3d
>>> scene = trigon3d.Scene()
>>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
>>> frame = scene.render(320, 240, outputs=("color", "depth", "object_ids"))
>>> frame.color.shape, frame.depth.dtype, frame.object_ids.dtype
((240, 320, 4), dtype('float32'), dtype('int32'))
"""

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
    "save_image",
    "set_threads",
]
__version__ = "0.1.0"
