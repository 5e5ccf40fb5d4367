"""Draws pyrender's own example and some single meshes by pyrender or by trigon, and compares the pictures.

    pyrender_pictures.py draw MODULE EXAMPLES FILE.npz
    pyrender_pictures.py compare THEIRS.npz OURS.npz

MODULE is `pyrender` or `trigon3d.pyrender`; EXAMPLES the folder with `example.py` and `models`. The script of the example
runs up to its first window, with only its import changed.
"""

import importlib
import math
import os
import sys

import numpy as np

SIZE = (160, 120)


def at(x=0.0, y=0.0, z=0.0):
    """A pose without rotation."""
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def example(module, folder, pictures):
    """The scene of `example.py`, in all ways of drawing."""
    with open(os.path.join(folder, "example.py")) as file:
        source = file.read().split("# Using the viewer with a default camera")[0]
    source = source.replace("import pyglet\npyglet.options['shadow_window'] = False\n", "")
    names = {}
    before = os.getcwd()
    os.chdir(folder)
    np.random.seed(3)
    exec(source.replace("from pyrender import", f"from {module.__name__} import"), names)  # noqa: S102
    os.chdir(before)
    scene, flags = names["scene"], module.RenderFlags
    scene.add(names["cam"], pose=names["cam_pose"])
    renderer = module.OffscreenRenderer(640, 480)
    nodes = [names[f"{name}_node"] for name in ("fuze", "boxv", "boxf", "drill", "bottle", "wood")]
    pictures["example"] = renderer.render(scene)
    pictures["example, segmentation"] = renderer.render(scene, flags.SEG, {node: 20 * i + 20 for i, node in enumerate(nodes)})
    pictures["example, depth"] = (None, renderer.render(scene, flags.DEPTH_ONLY))
    pictures["example, flat"] = renderer.render(scene, flags.FLAT)
    renderer.delete()


def single_meshes(module, pictures):
    """One mesh and one light at a time."""
    import trimesh

    def draw(name, mesh, light, camera=None, flags=0, **named):
        scene = module.Scene(**named)
        scene.add(mesh, pose=trimesh.transformations.rotation_matrix(0.5, [1, 1, 0]))
        scene.add(camera or module.PerspectiveCamera(math.pi / 4), pose=at(0, 0, 3))
        if light is not None:
            scene.add(light, pose=at(0, 0, 3))
        renderer = module.OffscreenRenderer(*SIZE, point_size=5.0)
        pictures[name] = renderer.render(scene, flags)
        renderer.delete()

    ball, box = trimesh.creation.icosphere(subdivisions=4, radius=0.8), trimesh.creation.box((1, 1, 1))
    lamp = module.DirectionalLight(intensity=3.0)
    mesh = module.Mesh.from_trimesh
    draw("box", mesh(box, smooth=False), lamp)
    for metallic in (0.0, 1.0):
        for roughness in (0.1, 0.5, 1.0):
            factors = {"metallicFactor": metallic, "roughnessFactor": roughness, "baseColorFactor": [0.8, 0.4, 0.2, 1]}
            material = module.MetallicRoughnessMaterial(**factors)
            name = f"metal {metallic:.0f}, roughness {roughness}"
            draw(name, mesh(ball, material=material), lamp)
            draw(f"{name}, ambient", mesh(ball, material=material), None, ambient_light=[0.5, 0.5, 0.5])
    draw("spot", mesh(ball), module.SpotLight(intensity=40.0, innerConeAngle=0.1, outerConeAngle=0.3))
    draw("point light", mesh(ball), module.PointLight(intensity=20.0))
    random = np.random.default_rng(5)
    painted = box.copy()
    painted.visual.vertex_colors = random.uniform(size=box.vertices.shape)
    draw("vertex colours", mesh(painted, smooth=False), lamp)
    painted = box.copy()
    painted.visual.face_colors = random.uniform(size=box.faces.shape)
    draw("face colours", mesh(painted, smooth=False), lamp)
    points = trimesh.creation.icosphere(subdivisions=2, radius=0.8).vertices
    draw("points", module.Mesh.from_points(points, colors=random.uniform(size=points.shape)), lamp)
    draw("aspect", mesh(box, smooth=False), lamp, module.PerspectiveCamera(math.pi / 4, aspectRatio=2.0))
    draw("parallel", mesh(box, smooth=False), lamp, module.OrthographicCamera(2.0, 1.0))
    draw("intrinsics", mesh(box, smooth=False), lamp, module.IntrinsicsCamera(150, 140, 70, 65))
    draw("clip planes", mesh(box, smooth=False), lamp, module.PerspectiveCamera(math.pi / 4, znear=2.5, zfar=3.0))


def inner(mask):
    """Pixels whose neighbours two steps around are all in the mask."""
    for _ in range(2):
        padded = np.pad(mask, 1)
        mask = mask & padded[2:, 1:-1] & padded[:-2, 1:-1] & padded[1:-1, 2:] & padded[1:-1, :-2]
    return mask


def compare(theirs, ours):
    """A line for each picture."""
    for name in [key[:-6] for key in theirs if key.endswith(" depth")]:
        a, b = theirs[f"{name} depth"], ours[f"{name} depth"]
        both = (a > 0) & (b > 0)
        line = f"{name:32} covered by one {((a > 0) != (b > 0)).sum():4}, depth {np.abs(a - b)[both].max():.1e}"
        if f"{name} color" in theirs:
            difference = ours[f"{name} color"].astype(int) - theirs[f"{name} color"]
            part = difference[inner(both)] if inner(both).any() else difference[both]
            line += f", colour {np.abs(part).mean():6.2f} (signed {part.mean():+6.2f}, at most {np.abs(part).max()})"
        print(line)


def main():
    """Draws or compares."""
    if sys.argv[1] == "compare":
        compare(*(np.load(path) for path in sys.argv[2:4]))
        return
    module, pictures = importlib.import_module(sys.argv[2]), {}
    example(module, sys.argv[3], pictures)
    single_meshes(module, pictures)
    arrays = {}
    for name, (color, depth) in pictures.items():
        arrays[f"{name} depth"] = depth
        if color is not None:
            arrays[f"{name} color"] = color[..., :3]
    np.savez(sys.argv[4], **arrays)


if __name__ == "__main__":
    main()
