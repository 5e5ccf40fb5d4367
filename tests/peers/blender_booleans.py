#!/usr/bin/env python3
"""Booleans of pairs of real models, turned at random, in trigon and in Blender's exact solver, one after the other.

    python tests/peers/blender_booleans.py MODELS… [--pairs 200] [--seed 1] [--json FILE]

needs Python 3.11 with bpy, numpy and trimesh, and `cargo build --release -p trigon-modelling --example boolean_pairs`.
MODELS are files or folders of OBJ, OFF, PLY, STL and GLB files. Of each connected part that is closed, winds outwards and
has at most --triangles triangles, scaled into a cube of 2 m, one is made a model. trigon computes union, difference and
intersection of each pair, Blender one of them by turns. The report says how many results are closed, how far volumes are
off, and the times of the operation itself: reading files is not counted.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import bpy  # before bmesh, which it brings
import bmesh
import mathutils
import numpy
import trimesh

OPERATIONS = ["UNION", "DIFFERENCE", "INTERSECT"]
SUFFIXES = {".obj", ".off", ".ply", ".stl", ".glb"}
EXAMPLE = "target/release/examples/boolean_pairs"


def models(paths, least, most):
    """Closed parts of files: names and meshes."""
    files = []
    for path in map(pathlib.Path, paths):
        files += sorted(p for p in path.rglob("*") if p.suffix.lower() in SUFFIXES) if path.is_dir() else [path]
    found, known = [], set()
    for file in files:
        try:
            loaded = trimesh.load(file, force="mesh", process=True)
            loaded.merge_vertices(merge_tex=True, merge_norm=True)
            parts = loaded.split(only_watertight=True) if len(loaded.faces) <= 10 * most else []
        except Exception:  # whatever a broken file makes of a reader
            continue
        for number, part in enumerate(parts):
            size = part.extents.max() if len(part.faces) else 0
            if not (least <= len(part.faces) <= most and size > 0 and part.is_winding_consistent):
                continue
            part.vertices = (part.vertices - part.bounds.mean(axis=0)) * (2 / size)
            key = (len(part.vertices), len(part.faces), round(float(part.volume), 4))
            if part.volume > 1e-3 and key not in known:
                known.add(key)
                found.append((f"{file.stem}.{number}", part))
    return found


def write_obj(path, mesh):
    lines = ["v %.9g %.9g %.9g" % tuple(v) for v in mesh.vertices.astype(numpy.float32)]
    lines += ["f %d %d %d" % tuple(f + 1) for f in mesh.faces]
    path.write_text("\n".join(lines) + "\n")


def blender_mesh(name, mesh):
    made = bpy.data.meshes.new(name)
    made.from_pydata(mesh.vertices.astype(numpy.float32).tolist(), [], mesh.faces.tolist())
    return bpy.data.objects.new(name, made)


def in_blender(a, b, matrix, operation):
    """Seconds, volume, faces, and whether the result is closed."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    moved = b.copy()
    moved.apply_transform(matrix)
    one, other = blender_mesh("a", a), blender_mesh("b", moved)
    for made in (one, other):
        bpy.context.scene.collection.objects.link(made)
    modifier = one.modifiers.new("boolean", "BOOLEAN")
    modifier.operation, modifier.solver, modifier.object = operation, "EXACT", other
    start = time.perf_counter()
    graph = bpy.context.evaluated_depsgraph_get()
    result = one.evaluated_get(graph).to_mesh()
    seconds = time.perf_counter() - start
    work = bmesh.new()
    work.from_mesh(result)
    closed = all(edge.is_manifold and edge.is_contiguous for edge in work.edges)
    volume, faces = work.calc_volume(signed=True), len(work.faces)
    work.free()
    return {"seconds": seconds, "volume": volume, "faces": faces, "closed": closed}


def random_map(random):
    turn = trimesh.transformations.random_rotation_matrix(random.random(3))
    turn[:3, 3] = random.uniform(-0.6, 0.6, 3)
    return turn


def copies():
    """Maps under which much of a model lies on itself, nearly so, or beside itself."""
    turn = trimesh.transformations.rotation_matrix
    move = trimesh.transformations.translation_matrix
    quarters = [turn(numpy.pi / 2, [0, 0, 1]), turn(numpy.pi, [0, 1, 0])]
    small = [turn(angle, [1, 2, 3]) for angle in (1e-7, 1e-5, 1e-3)]
    return quarters + small + [move([0.5, 0, 0]), move([2, 0, 0]), move([1e-6, 1e-6, 0])]


def pairs_of(arguments, crossed):
    """Numbers of two models, and the map of the second one."""
    if arguments.copies:
        models = [i for i, crosses in enumerate(crossed) if not crosses]
        return [(i, i, matrix) for matrix in copies() for i in models]
    random = numpy.random.default_rng(arguments.seed)
    pick = lambda: random.integers(len(crossed), size=2)
    return [(*pick(), random_map(random)) for _ in range(arguments.pairs)]


def run(arguments):
    all_models = models(arguments.models, arguments.least, arguments.triangles)
    print(f"{len(all_models)} models, {sum(len(m.faces) for _, m in all_models)} triangles", file=sys.stderr)
    program = subprocess.Popen([EXAMPLE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    crossed = [crosses_itself(mesh) for _, mesh in all_models]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for number, (_, mesh) in enumerate(all_models):
            write_obj(folder / f"{number}.obj", mesh)
        for pair, (i, j, matrix) in enumerate(pairs_of(arguments, crossed)):
            columns = " ".join(repr(float(x)) for x in matrix[:3, :].T.flatten())
            program.stdin.write(f"{folder}/{i}.obj {folder}/{j}.obj {columns}\n")
            program.stdin.flush()
            ours = json.loads(program.stdout.readline())
            operation = OPERATIONS[pair % 3]
            has_peer = arguments.blender and not arguments.copies
            theirs = in_blender(all_models[i][1], all_models[j][1], matrix, operation) if has_peer else None
            names = [all_models[i][0], all_models[j][0]]
            sizes = [len(all_models[i][1].faces), len(all_models[j][1].faces)]
            row = {"names": names, "triangles": sizes, "crosses": crossed[i] or crossed[j]}
            rows.append(row | {"operation": operation, "trigon": ours, "blender": theirs})
            print(pair, *names, *sizes, file=sys.stderr)
    program.stdin.close()
    return rows


def crosses_itself(mesh):
    """Whether two triangles without a common vertex touch."""
    tree = mathutils.bvhtree.BVHTree.FromPolygons(mesh.vertices.tolist(), mesh.faces.tolist())
    faces = [set(face) for face in mesh.faces.tolist()]
    return any(not faces[i] & faces[j] for i, j in tree.overlap(tree))


def errors(row):
    """How far volumes are off, relative to the sum of both operands'. What an operand that crosses itself encloses is
    only known from the results."""
    ours = row["trigon"]
    a, b = ours["volumes"]
    union, difference, common, reverse = (ours[name]["volume"] for name in [*OPERATIONS, "REVERSE"])
    off = [union - difference - common - reverse]
    if not row["crosses"]:
        off += [union + common - a - b, difference + common - a, reverse + common - b]
    return max(map(abs, off)) / (a + b)


def report(rows):
    names = [*OPERATIONS, "REVERSE"]
    done = [row for row in rows if all("volume" in row["trigon"][name] for name in names)]
    results = [row["trigon"][name] for row in done for name in names]
    print(f"pairs of which one crosses itself: {sum(row['crosses'] for row in rows)}")
    print(f"pairs: {len(rows)}, refused: {len(rows) - len(done)}")
    for row in rows:
        for name in names:
            if "refusal" in row["trigon"][name]:
                print("  ", *row["names"], name, row["trigon"][name]["refusal"])
    print(f"results: {len(results)}, closed: {sum(result['closed'] for result in results)}")
    worst = max(done, key=lambda row: errors(row))
    print(f"largest volume error: {errors(worst):.2e} ({' '.join(worst['names'])})")
    print(f"pairs above 1e-6: {sum(errors(row) > 1e-6 for row in done)}")
    pairs = [(row["trigon"][row["operation"]], row["blender"]) for row in done if row["blender"]]
    if not pairs:
        return
    print(f"Blender: {len(pairs)} results, closed: {sum(theirs['closed'] for _, theirs in pairs)}")
    for label, times in (("trigon", [o["seconds"] for o, _ in pairs]), ("Blender", [t["seconds"] for _, t in pairs])):
        tenths = statistics.quantiles(times, n=10)
        print(f"{label}: median {statistics.median(times) * 1e3:.1f} ms, 90 %: {tenths[8] * 1e3:.1f} ms, sum {sum(times):.1f} s")
    ratios = [ours["seconds"] / theirs["seconds"] for ours, theirs in pairs]
    print(f"median of ratios: {statistics.median(ratios):.3f}, largest: {max(ratios):.2f}")
    scale = [sum(row["trigon"]["volumes"]) for row in done if row["blender"]]
    apart = [abs(o["volume"] - t["volume"]) / s > 1e-4 for (o, t), s in zip(pairs, scale)]
    print(f"volumes more than 1e-4 apart: {sum(apart)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+")
    parser.add_argument("--pairs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--triangles", type=int, default=20_000)
    parser.add_argument("--least", type=int, default=20)
    parser.add_argument("--copies", action="store_true", help="each model that does not cross itself with its own copies")
    parser.add_argument("--no-blender", dest="blender", action="store_false")
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    rows = run(arguments)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1))
    report(rows)


if __name__ == "__main__":
    main()
