#!/usr/bin/env python3
"""Meshes reduced by trigon, Blender and meshoptimizer, one after the other: times, and distances from the original surface.

    python tests/peers/blender_reduction.py [MODELS…] [--triangles 1000000] [--share 0.1] [--rounds 2]

needs Python 3.11 with bpy, numpy, pymeshlab and meshoptimizer, and
`cargo build --release -p trigon-modelling --example reduce_models`. Without MODELS a wavy torus of --triangles triangles is
reduced; MODELS are files of triangles that pymeshlab reads. Only the operation is timed. Blender's is the Collapse of
its decimate modifier. Distances are from samples on the reduced surface to the original one, in parts of the diagonal of its box.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import bpy
import meshoptimizer
import numpy
import pymeshlab

EXAMPLE = "target/release/examples/reduce_models"
SAMPLES = 200_000


def torus(triangles):
    """With waves on it, so that it is nowhere flat: 5 m across."""
    rings = max(8, round((triangles / 4) ** 0.5))
    u, v = numpy.meshgrid(numpy.arange(2 * rings), numpy.arange(rings), indexing="ij")
    a, b = u * (numpy.pi / rings), v * (2 * numpy.pi / rings)
    r = 0.6 + 0.05 * numpy.sin(9 * a) * numpy.cos(7 * b)
    points = numpy.stack([(1.9 + r * numpy.cos(b)) * numpy.cos(a), r * numpy.sin(b), (1.9 + r * numpy.cos(b)) * numpy.sin(a)], -1)
    index = lambda i, j: (i % (2 * rings)) * rings + j % rings
    quads = numpy.stack([index(u, v), index(u, v + 1), index(u + 1, v + 1), index(u + 1, v)], -1).reshape(-1, 4)
    faces = numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return points.reshape(-1, 3).astype(numpy.float32), faces.astype(numpy.uint32)


def load(path):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix().astype(numpy.float32), mesh.face_matrix().astype(numpy.uint32)


def write(path, points, faces):
    with open(path, "w") as file:
        file.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points.tolist())
        file.writelines("f %d %d %d\n" % tuple(f) for f in (faces + 1).tolist())


class Trigon:
    def __init__(self, folder):
        self.folder = folder
        self.program = subprocess.Popen([EXAMPLE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def reduce(self, points, faces, count):
        before, after = self.folder / "before.obj", self.folder / "after.obj"
        write(before, points, faces)
        self.program.stdin.write(f"{before} {count} {after}\n")
        self.program.stdin.flush()
        seconds = json.loads(self.program.stdout.readline())["seconds"]
        return seconds, load(after)


def in_blender(points, faces, count):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    thing = bpy.data.objects.new("thing", mesh)
    bpy.context.scene.collection.objects.link(thing)
    modifier = thing.modifiers.new("reduce", "DECIMATE")
    modifier.ratio = count / len(faces)
    start = time.perf_counter()
    reduced = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    seconds = time.perf_counter() - start
    reduced.calc_loop_triangles()
    found = numpy.empty(3 * len(reduced.vertices), numpy.float32)
    reduced.vertices.foreach_get("co", found)
    corners = numpy.empty(3 * len(reduced.loop_triangles), numpy.int32)
    reduced.loop_triangles.foreach_get("vertices", corners)
    return seconds, (found.reshape(-1, 3), corners.reshape(-1, 3).astype(numpy.uint32))


def by_meshoptimizer(points, faces, count):
    result = numpy.zeros(faces.size, numpy.uint32)
    start = time.perf_counter()
    size = meshoptimizer.simplify(result, faces.reshape(-1), points, target_index_count=3 * count, target_error=1.0)
    seconds = time.perf_counter() - start
    return seconds, (points, result[:size].reshape(-1, 3))


def distances(original, reduced):
    """The mean and the largest, in parts of the diagonal."""
    meshes = pymeshlab.MeshSet()
    for points, faces in (original, reduced):
        meshes.add_mesh(pymeshlab.Mesh(points.astype(float), faces.astype(numpy.int32)))
    found = meshes.get_hausdorff_distance(sampledmesh=1, targetmesh=0, samplenum=SAMPLES, samplevert=False, sampleface=True)
    diagonal = found["diag_mesh_0"]
    return found["mean"] / diagonal, found["max"] / diagonal


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("models", nargs="*")
    parser.add_argument("--triangles", type=int, default=1_000_000)
    parser.add_argument("--share", type=float, default=0.1)
    parser.add_argument("--rounds", type=int, default=2)
    arguments = parser.parse_args()
    models = [(pathlib.Path(path).name, load(path)) for path in arguments.models]
    models = models or [("torus", torus(arguments.triangles))]
    with tempfile.TemporaryDirectory() as folder:
        trigon = Trigon(pathlib.Path(folder))
        ways = {"trigon": trigon.reduce, "Blender": in_blender, "meshoptimizer": by_meshoptimizer}
        for name, (points, faces) in models:
            count = round(arguments.share * len(faces))
            times = {way: [] for way in ways}
            for _ in range(arguments.rounds):
                results = {}
                for way, reduce in ways.items():
                    seconds, results[way] = reduce(points, faces, count)
                    times[way].append(seconds)
            for way, reduced in results.items():
                mean, largest = distances((points, faces), reduced)
                spent = " ".join(f"{seconds:.3f}" for seconds in times[way])
                print(f"{name} {len(faces)} -> {len(reduced[1])}: {way}: {spent} s, mean {mean:.3e}, largest {largest:.3e}", flush=True)


if __name__ == "__main__":
    main()
