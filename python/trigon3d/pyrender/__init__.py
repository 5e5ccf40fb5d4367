"""The interface of pyrender on trigon: change ``import pyrender`` to ``from trigon3d import pyrender``.

Scenes, nodes, meshes, materials, cameras, lights and ``OffscreenRenderer`` have pyrender's names, arguments and results.
Without OpenGL, no display is needed and the bytes are the same on every machine. What differs:

- Images are anti-aliased with 9 samples a pixel, in linear light. Colours are encoded by sRGB's curve, where pyrender
  raises them to 1/2.2: dark ones are a little darker here.
- Depth and segmentation are those of the middle of each pixel. Alone, they are drawn with one sample a pixel, and may
  differ from those beside colours by a pixel along outlines. Translucent surfaces have none.
- Points are round and not lit: they have their colours, where pyrender lights them as rough metal.
- Ambient light beside lamps follows glTF's reflection and is darker on rough metals; pyrender adds base colour times
  light, as is drawn here, too, if there are no lamps. Backs of faces are lit from their own side. Colours of translucent
  surfaces are mixed in linear light.
- ``SKIP_CULL_FACES`` and ``doubleSided`` also hold with ``DEPTH_ONLY`` and ``SEG``, where pyrender culls.
- Values are checked when cameras and lights are made. ``translation`` and ``scale`` of nodes are copies: assign them.
- There is no window: ``Viewer`` warns, and is as one that was closed at once. Wires and normals as lines raise
  ``NotImplementedError``.

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

from ._constants import GLTF, RenderFlags
from ._materials import Material, MetallicRoughnessMaterial, Sampler, Texture
from ._meshes import Mesh, Primitive
from ._offscreen import OffscreenRenderer, Viewer
from ._scene import Node, Scene
from ._views import (
    Camera,
    DirectionalLight,
    IntrinsicsCamera,
    Light,
    OrthographicCamera,
    PerspectiveCamera,
    PointLight,
    SpotLight,
)

__all__ = [
    "Camera",
    "DirectionalLight",
    "GLTF",
    "IntrinsicsCamera",
    "Light",
    "Material",
    "Mesh",
    "MetallicRoughnessMaterial",
    "Node",
    "OffscreenRenderer",
    "OrthographicCamera",
    "PerspectiveCamera",
    "PointLight",
    "Primitive",
    "RenderFlags",
    "Sampler",
    "Scene",
    "SpotLight",
    "Texture",
    "Viewer",
]
