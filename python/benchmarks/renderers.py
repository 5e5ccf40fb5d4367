"""One renderer, driven by `rivals.py` over pipes: a request in JSON on each line, an answer on each line.

Each class draws a mesh from a pose and returns what the renderer gives, in NumPy arrays or bytes; `result` converts that, outside the time that is
measured, to `color`, `depth` along the view axis (inf without), `faces` and `objects` (-1 without).
"""

import importlib.metadata
import json
import os
import resource
import sys
import time

import numpy as np


class Trigon:
    package = "trigon3d"

    def __init__(self, samples):
        import trigon3d

        self.trigon3d, self.samples = trigon3d, samples

    def load(self, mesh, view):
        self.view, self.scene = view, self.trigon3d.Scene()
        self.scene.add_mesh(mesh["vertices"], mesh["faces"], normals=mesh["normals"])
        # As many lights as the others have.
        self.scene.add_light("ambient", intensity=0.2)
        self.scene.add_light("directional", direction=(-1, -1, -1), intensity=0.8)
        self.camera = self.trigon3d.Camera.perspective(view["fov"])

    def draw(self, pose):
        outputs = ("color", "depth", "object_ids", "face_ids")
        size = self.view["width"], self.view["height"]
        return self.scene.render(*size, self.camera.with_pose(pose), outputs=outputs, samples=self.samples)

    def result(self, frame):
        return {"color": frame.color, "depth": frame.depth, "faces": frame.face_ids, "objects": frame.object_ids}


class Pyrender:
    package = "pyrender"

    def __init__(self):
        os.environ["PYOPENGL_PLATFORM"] = "osmesa"
        import pyrender

        self.pyrender = pyrender

    def load(self, mesh, view):
        p = self.pyrender
        self.scene = p.Scene(ambient_light=[0.2, 0.2, 0.2])
        primitive = p.Primitive(positions=mesh["vertices"], normals=mesh["normals"], indices=mesh["faces"])
        self.node = self.scene.add(p.Mesh([primitive]))
        camera = p.PerspectiveCamera(np.radians(view["fov"]), znear=view["near"], zfar=view["far"])
        self.camera = self.scene.add(camera)
        self.light = self.scene.add(p.DirectionalLight(intensity=3.0))
        self.renderer = p.OffscreenRenderer(view["width"], view["height"])

    def draw(self, pose):
        self.scene.set_pose(self.camera, pose)
        self.scene.set_pose(self.light, pose)
        color, depth = self.renderer.render(self.scene)
        ids, _ = self.renderer.render(self.scene, self.pyrender.RenderFlags.SEG, {self.node: (0, 0, 1)})
        return color, depth, ids

    def result(self, drawn):
        color, depth, ids = drawn
        return {"color": color, "depth": np.where(depth == 0, np.inf, depth), "objects": ids[..., 2].astype(int) - 1}


class Trimesh:
    """Its image is a PNG in memory; it has no depth and no ids."""

    package = "trimesh"

    def __init__(self):
        import trimesh

        self.trimesh = trimesh

    def load(self, mesh, view):
        t = self.trimesh
        geometry = t.Trimesh(mesh["vertices"], mesh["faces"], vertex_normals=mesh["normals"], process=False)
        self.size = view["width"], view["height"]
        across = 2 * np.degrees(np.arctan(np.tan(np.radians(view["fov"]) / 2) * view["width"] / view["height"]))
        self.scene = t.Scene(geometry, camera=t.scene.Camera(resolution=self.size, fov=(across, view["fov"])))

    def draw(self, pose):
        self.scene.camera_transform = pose
        return self.scene.save_image(resolution=self.size, visible=True)

    def result(self, drawn):
        from PIL import Image

        return {"color": np.asarray(Image.open(self.trimesh.util.wrap_as_stream(drawn)))}


class Open3D:
    """Off screen by Filament; where there is no GPU, on Mesa's software Vulkan. It has no ids."""

    package = "open3d"

    def __init__(self):
        import open3d

        self.open3d = open3d

    def load(self, mesh, view):
        o = self.open3d
        geometry = o.geometry.TriangleMesh(o.utility.Vector3dVector(mesh["vertices"]), o.utility.Vector3iVector(mesh["faces"]))
        geometry.vertex_normals = o.utility.Vector3dVector(mesh["normals"])
        self.size, self.K = (view["width"], view["height"]), intrinsics(view)
        self.renderer = o.visualization.rendering.OffscreenRenderer(*self.size)
        material = o.visualization.rendering.MaterialRecord()
        material.shader = "defaultLit"
        self.renderer.scene.add_geometry("mesh", geometry, material)

    def draw(self, pose):
        self.renderer.setup_camera(self.K, extrinsics(pose), *self.size)
        color = np.asarray(self.renderer.render_to_image())
        return color, np.asarray(self.renderer.render_to_depth_image(z_in_view_space=True))

    def result(self, drawn):
        return {"color": drawn[0], "depth": drawn[1]}


class Open3DRays:
    """Embree's rays: depth and ids, no colour."""

    package = "open3d"

    def __init__(self):
        import open3d

        self.open3d = open3d

    def load(self, mesh, view):
        self.scene = self.open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(mesh["vertices"], mesh["faces"].astype(np.uint32))
        self.size, self.K = (view["width"], view["height"]), intrinsics(view)

    def draw(self, pose):
        rays = self.scene.create_rays_pinhole(self.K, extrinsics(pose), *self.size)
        hits = self.scene.cast_rays(rays)
        return tuple(hits[name].numpy() for name in ("t_hit", "primitive_ids", "geometry_ids"))

    def result(self, drawn):
        depth, faces, objects = drawn
        none = np.isinf(depth)
        return {"depth": depth, "faces": np.where(none, -1, faces.astype(int)), "objects": np.where(none, -1, objects.astype(int))}


class Pytorch3D:
    package = "pytorch3d"

    def __init__(self):
        import pytorch3d.renderer
        import pytorch3d.structures
        import torch

        self.torch, self.p = torch, pytorch3d

    def load(self, mesh, view):
        r, torch = self.p.renderer, self.torch
        vertices, faces, normals = (torch.from_numpy(mesh[name])[None] for name in ("vertices", "faces", "normals"))
        textures = r.TexturesVertex(torch.full_like(vertices, 0.8))
        self.meshes = self.p.structures.Meshes(vertices, faces.long(), textures, verts_normals=normals)
        self.view = view
        settings = r.RasterizationSettings(image_size=(view["height"], view["width"]), blur_radius=0.0, faces_per_pixel=1)
        self.renderer = r.MeshRendererWithFragments(r.MeshRasterizer(raster_settings=settings), r.HardPhongShader())

    def draw(self, pose):
        torch, view = self.torch, self.view
        axes = pose[:3, :3] * [-1, 1, -1]
        camera = self.p.renderer.PerspectiveCameras(
            focal_length=view["focal"],
            principal_point=((view["width"] / 2, view["height"] / 2),),
            R=torch.tensor(axes[None], dtype=torch.float32),
            T=torch.tensor((-pose[:3, 3] @ axes)[None], dtype=torch.float32),
            in_ndc=False,
            image_size=((view["height"], view["width"]),),
        )
        light = self.p.renderer.PointLights(location=[pose[:3, 3].tolist()])
        with torch.no_grad():
            color, fragments = self.renderer(self.meshes, cameras=camera, lights=light)
        return color[0].numpy(), fragments.zbuf[0, ..., 0].numpy(), fragments.pix_to_face[0, ..., 0].numpy()

    def result(self, drawn):
        color, depth, faces = drawn
        return {"color": color, "depth": np.where(faces < 0, np.inf, depth), "faces": faces, "objects": np.minimum(faces, 0)}


class Pybullet:
    """TinyRenderer. Ids are of bodies. It reads an OBJ, because meshes given as arrays have at most 131072 vertices."""

    package = "pybullet"

    def __init__(self):
        import pybullet

        self.p = pybullet
        pybullet.connect(pybullet.DIRECT)

    def load(self, mesh, view):
        shape = self.p.createVisualShape(self.p.GEOM_MESH, fileName=mesh["obj"])
        self.p.createMultiBody(baseVisualShapeIndex=shape)
        self.view = view
        self.projection = self.p.computeProjectionMatrixFOV(view["fov"], view["width"] / view["height"], view["near"], view["far"])

    def draw(self, pose):
        view = np.linalg.inv(pose).T.ravel().tolist()
        size = self.view["width"], self.view["height"]
        _, _, color, depth, ids = self.p.getCameraImage(
            *size, view, self.projection, lightDirection=pose[:3, 2].tolist(), shadow=0, renderer=self.p.ER_TINY_RENDERER
        )
        return np.asarray(color), np.asarray(depth), np.asarray(ids)

    def result(self, drawn):
        size = self.view["height"], self.view["width"]
        color, depth, ids = (array.reshape(*size, -1) for array in drawn)
        near, far = self.view["near"], self.view["far"]
        depth = far * near / (far - (far - near) * depth[..., 0].astype(np.float64))
        return {"color": color, "depth": np.where(ids[..., 0] < 0, np.inf, depth), "objects": ids[..., 0]}


class Mitsuba:
    """Colours by the integrator `direct` with one light, depth and ids by `aov`; one sample in the middle of each pixel."""

    package = "mitsuba"

    def __init__(self, variant):
        import mitsuba

        self.mi = mitsuba
        mitsuba.set_variant(variant)

    def load(self, mesh, view):
        self.view = view
        inner = {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}
        integrator = {"type": "aov", "aovs": "d:depth,p:prim_index,s:shape_index", "inner": inner}
        light = {"type": "directional", "direction": [-1.0, -1.0, -1.0]}
        self.scene = self.mi.load_dict(
            {"type": "scene", "integrator": integrator, "light": light, "mesh": {"type": "ply", "filename": mesh["ply"]}}
        )

    def draw(self, pose):
        pose = pose.copy()
        pose[:3, :3] *= [-1, 1, -1]
        film = {"type": "hdrfilm", "width": self.view["width"], "height": self.view["height"], "rfilter": {"type": "box"}}
        sensor = {
            "type": "perspective",
            "fov": self.view["fov"],
            "fov_axis": "y",
            "near_clip": self.view["near"],
            "far_clip": self.view["far"],
            "to_world": self.mi.ScalarTransform4f(pose),
            "film": film,
            "sampler": {"type": "stratified", "sample_count": 1, "jitter": False},
        }
        return np.array(self.mi.render(self.scene, sensor=self.mi.load_dict(sensor), spp=1))

    def result(self, drawn):
        distance, faces, objects = drawn[..., -3], drawn[..., -2], drawn[..., -1]
        height, width = distance.shape
        # The distance along the ray from the near plane, as the depth along the axis.
        x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2)
        depth = self.view["near"] + distance.astype(np.float64) / np.sqrt(1 + (x**2 + y**2) / self.view["focal"] ** 2)
        none = distance == 0
        faces, objects = (np.where(none, -1, ids.astype(int)) for ids in (faces, objects))
        return {"color": drawn[..., :3], "depth": np.where(none, np.inf, depth), "faces": faces, "objects": objects}


def intrinsics(view):
    return np.array([[view["focal"], 0, view["width"] / 2], [0, view["focal"], view["height"] / 2], [0, 0, 1.0]])


def extrinsics(pose):
    """From the world to the camera, OpenCV's axes."""
    return np.diag([1.0, -1, -1, 1]) @ np.linalg.inv(pose)


RENDERERS = {
    "trigon3d": lambda: Trigon(None),
    "trigon3d, 1 sample": lambda: Trigon(1),
    "pyrender": Pyrender,
    "trimesh": Trimesh,
    "Open3D": Open3D,
    "Open3D rays": Open3DRays,
    "PyTorch3D": Pytorch3D,
    "PyBullet": Pybullet,
    "Mitsuba scalar": lambda: Mitsuba("scalar_rgb"),
    "Mitsuba LLVM": lambda: Mitsuba("llvm_ad_rgb"),
}


def main():
    # What a renderer prints goes elsewhere than the answers.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    state = {}
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer = {"load": load, "draw": draw, "keep": keep}[request["do"]](state, request)
        except Exception as error:
            answer = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=answers, flush=True)


def load(state, request):
    """From before the import of the renderer's module to the first image. NumPy and the mesh's arrays are there before."""
    with np.load(request["mesh"] + ".npz") as file:
        mesh = {**file, "obj": request["mesh"] + ".obj", "ply": request["mesh"] + ".ply"}
    pose = np.array(request["pose"])
    started = time.perf_counter()
    renderer = state["renderer"] = RENDERERS[sys.argv[1]]()
    renderer.load(mesh, request["view"])
    state["drawn"] = renderer.draw(pose)
    seconds = time.perf_counter() - started
    distributions = importlib.metadata.packages_distributions().get(renderer.package, [renderer.package])
    version = f"{distributions[0]} {importlib.metadata.version(distributions[0])}"
    return {"seconds": seconds, "version": version, "peak": peak()}


def draw(state, request):
    pose = np.array(request["pose"])
    before, started = processor(), time.perf_counter()
    state["drawn"] = state["renderer"].draw(pose)
    return {"seconds": time.perf_counter() - started, "processor": processor() - before, "peak": peak()}


def keep(state, request):
    result = state["renderer"].result(state["drawn"])
    np.savez(request["path"], **result)
    return {"outputs": list(result)}


def processor():
    """Seconds of all threads."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def peak():
    """The most memory so far, in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main()
