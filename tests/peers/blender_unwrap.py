#!/usr/bin/env python3
"""Unwraps of real models along the same seams in trigon and in Blender, one after the other, and packing of the result.

    python tests/peers/blender_unwrap.py MODELS… [--charts 12] [--rounds 3] [--json FILE]

needs Python 3.11 with bpy, numpy, trimesh and xatlas, and `cargo build --release -p trigon-modelling --example unwrap_models`.
MODELS are files that trimesh reads, each merged to one mesh of triangles in a cube of 2 m. Charts grow from faces that are
far from one another, and are divided until each is a disc; their borders are the seams. Both unwrap with minimum stretch,
and Blender conformally and by angles, too. Only the operation itself is timed. The measures are computed here from texture
coordinates alone: triangles turned over, islands that overlap themselves, L2 stretch (P. Sander and others, 2001), the mean
difference of angles, and which part of the bounding square is covered. Blender packs trigon's islands again with the same
margin, as concave shapes, and so does xatlas, in an image of about 1024 pixels, of which not the square counts but the
rectangle. xatlas cannot be given seams. It gets each chart as a mesh of its own, with all of its costs off; the charts that
it leaves whole are compared.
"""

import argparse
import heapq
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import bpy
import numpy
import trimesh
import xatlas

EXAMPLE = "target/release/examples/unwrap_models"
METHODS = ["MINIMUM_STRETCH", "CONFORMAL", "ANGLE_BASED"]


def load(path, most):
    """Vertices in a cube of 2 m, as 32-bit numbers, and triangles with an area, without copies."""
    mesh = trimesh.load(path, force="mesh", process=True, skip_materials=True)
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    if not 0 < len(mesh.faces) <= most:
        return None
    points = numpy.asarray(mesh.vertices, float)
    points = (points - (points.min(0) + points.max(0)) / 2) * (2 / numpy.ptp(points, axis=0).max())
    points = points.astype(numpy.float32)
    faces = numpy.asarray(mesh.faces, int)
    _, first = numpy.unique(numpy.sort(faces, axis=1), axis=0, return_index=True)
    faces = faces[numpy.sort(first)]
    corners = points[faces].astype(float)
    areas = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    faces = faces[areas > 1e-10]
    used, faces = numpy.unique(faces, return_inverse=True)
    return points[used], faces.reshape(-1, 3)


class Partition:
    """Faces of a mesh in charts that are discs."""

    def __init__(self, points, faces, count):
        self.faces = faces
        corners = points[faces].astype(float)
        self.centers = corners.mean(1)
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.normals = normals / numpy.linalg.norm(normals, axis=1, keepdims=True)
        self.neighbors = self.adjacent()
        self.chart = numpy.full(len(faces), -1)
        self.charts = 0
        for part in self.components():
            self.grow(part, max(1, round(count * len(part) / len(faces))))
        waiting = list(range(self.charts))
        while waiting:
            part = numpy.flatnonzero(self.chart == waiting.pop())
            if len(part) > 1 and not self.is_disc(part):
                before = self.charts
                self.grow(part, 2)
                waiting += range(before, self.charts)

    def adjacent(self):
        """By face: faces that share an edge in which exactly two meet, with opposite directions."""
        sides = {}
        for face, (a, b, c) in enumerate(self.faces.tolist()):
            for side in ((a, b), (b, c), (c, a)):
                sides.setdefault((min(side), max(side)), []).append((face, side))
        neighbors = [[] for _ in self.faces]
        for there in sides.values():
            if len(there) == 2 and there[0][1] != there[1][1]:
                (one, _), (other, _) = there
                bend = 1 - float(self.normals[one] @ self.normals[other])
                cost = float(numpy.linalg.norm(self.centers[one] - self.centers[other])) + 0.1 * bend
                neighbors[one].append((other, cost))
                neighbors[other].append((one, cost))
        return neighbors

    def components(self):
        seen, parts = numpy.zeros(len(self.faces), bool), []
        for start in range(len(self.faces)):
            if not seen[start]:
                seen[start] = True
                part = [start]
                for face in part:
                    for other, _ in self.neighbors[face]:
                        if not seen[other]:
                            seen[other] = True
                            part.append(other)
                parts.append(part)
        return parts

    def grow(self, part, count):
        """Divides a part among seeds: the first is the face farthest from an end, each next one farthest from all."""
        inside = set(int(face) for face in part)
        distance = dict.fromkeys(inside, float("inf"))

        def relax(seed, label):
            heap = [(0.0, seed)]
            distance[seed] = 0.0
            while heap:
                here, face = heapq.heappop(heap)
                if here > distance[face]:
                    continue
                self.chart[face] = label
                for other, cost in self.neighbors[face]:
                    if other in inside and here + cost < distance[other]:
                        distance[other] = here + cost
                        heapq.heappush(heap, (here + cost, other))

        def farthest():
            reached = {face: d for face, d in distance.items()}
            return max(reached, key=lambda face: (reached[face], -face))

        relax(int(part[0]), -1)
        seed = farthest()
        distance = dict.fromkeys(inside, float("inf"))
        for _ in range(min(count, len(inside))):
            relax(seed, self.charts)
            self.charts += 1
            seed = farthest()

    def is_disc(self, part):
        """Connected, with one border that visits no vertex twice."""
        inside = set(part.tolist())
        reached, stack = {int(part[0])}, [int(part[0])]
        while stack:
            for other, _ in self.neighbors[stack.pop()]:
                if other in inside and other not in reached:
                    reached.add(other)
                    stack.append(other)
        if len(reached) < len(inside):
            return False
        sides = border(self.faces[part])
        edges = (3 * len(part) + len(sides)) // 2
        _, starts = numpy.unique(sides[:, 0], return_counts=True)
        return len(sides) > 0 and starts.max() == 1 and len(numpy.unique(self.faces[part])) - edges + len(part) == 1

    def seams(self):
        """Pairs of vertices between charts, and between faces that are no neighbours."""
        found = set()
        for chart in range(self.charts):
            part = self.faces[self.chart == chart]
            if len(part):
                found.update(map(tuple, numpy.sort(border(part), axis=1).tolist()))
        return sorted(found)


def border(faces):
    """Directed sides without an opposite one."""
    sides = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    size = int(faces.max()) + 1
    keys, opposite = sides[:, 0] * size + sides[:, 1], sides[:, 1] * size + sides[:, 0]
    return sides[~numpy.isin(keys, opposite)]


def write_obj(path, points, faces, seams):
    lines = ["v %.9g %.9g %.9g" % tuple(point) for point in points]
    lines += ["f %d %d %d" % tuple(face + 1) for face in faces]
    lines += ["l %d %d" % (a + 1, b + 1) for a, b in seams]
    path.write_text("\n".join(lines) + "\n")


def prepare_blender(points, faces, seams):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.data.meshes.new("model")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    mesh.uv_layers.new(name="uv")
    wanted = set(seams)
    keys = [tuple(sorted(edge.vertices)) for edge in mesh.edges]
    mesh.edges.foreach_set("use_seam", [key in wanted for key in keys])
    model = bpy.data.objects.new("model", mesh)
    bpy.context.scene.collection.objects.link(model)
    bpy.context.view_layer.objects.active = model
    model.select_set(True)
    return mesh


def in_blender(mesh, operator):
    """Seconds of an operator in edit mode, and the texture coordinates after it."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    start = time.perf_counter()
    operator()
    seconds = time.perf_counter() - start
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = numpy.empty(2 * len(mesh.loops), numpy.float32)
    mesh.uv_layers[0].data.foreach_get("uv", uv)
    return seconds, uv.reshape(-1, 3, 2).astype(float)


def blender_packs(mesh, uv, margin):
    """Seconds of packing given islands as concave shapes, and the result."""
    mesh.uv_layers[0].data.foreach_set("uv", uv.astype(numpy.float32).ravel())
    pack = lambda: bpy.ops.uv.pack_islands(
        rotate=True, rotate_method="ANY", shape_method="CONCAVE", margin_method="FRACTION", margin=margin
    )
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    return in_blender(mesh, pack)


def signed_areas(uv):
    a, b, c = uv[:, 0], uv[:, 1], uv[:, 2]
    return ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])) / 2


def angles(corners):
    """The three angles of each triangle."""
    found = []
    for corner in range(3):
        one = corners[:, (corner + 1) % 3] - corners[:, corner]
        other = corners[:, (corner + 2) % 3] - corners[:, corner]
        lengths = numpy.linalg.norm(one, axis=1) * numpy.linalg.norm(other, axis=1)
        cosine = (one * other).sum(1) / numpy.where(lengths > 0, lengths, 1)
        found.append(numpy.arccos(numpy.clip(cosine, -1, 1)))
    return numpy.stack(found, axis=1)


def crosses(a, b, c, d, by):
    """Whether segments ab and cd cross by more than a distance."""

    def sides(p, q, r):
        along = q - p
        length = numpy.maximum(numpy.linalg.norm(along, axis=1), 1e-30)
        return (along[:, 0] * (r - p)[:, 1] - along[:, 1] * (r - p)[:, 0]) / length

    apart = lambda one, other: ((one > by) & (other < -by)) | ((one < -by) & (other > by))
    return apart(sides(a, b, c), sides(a, b, d)) & apart(sides(c, d, a), sides(c, d, b))


def border_crossings(ends, by):
    """How many pairs of segments cross each other: (n, 2, 2) numbers."""
    ends = ends[numpy.argsort(ends[:, :, 0].min(1))]
    low, high = ends.min(1), ends.max(1)
    last = numpy.searchsorted(low[:, 0], high[:, 0], side="right")
    count = 0
    for i in range(len(ends)):
        j = numpy.arange(i + 1, last[i])
        j = j[(low[j, 1] <= high[i, 1]) & (high[j, 1] >= low[i, 1])]
        if len(j):
            one = numpy.broadcast_to(ends[i], (len(j), 2, 2))
            count += int(crosses(one[:, 0], one[:, 1], ends[j, 0], ends[j, 1], by).sum())
    return count


def measure(points, faces, chart, uv):
    """What a layout is worth. A disc overlaps nowhere if no triangle is turned over and its border does not cross itself."""
    surface = points[faces].astype(float)
    areas = numpy.linalg.norm(numpy.cross(surface[:, 1] - surface[:, 0], surface[:, 2] - surface[:, 0]), axis=1) / 2
    flat = signed_areas(uv)
    wrong, overlapping = numpy.zeros(len(faces), bool), 0
    for label in numpy.unique(chart):
        part = numpy.flatnonzero(chart == label)
        sign = 1 if flat[part].sum() > 0 else -1
        flat[part] *= sign
        wrong[part] = flat[part] <= 0
        laid = dict(zip(faces[part].ravel().tolist(), uv[part].reshape(-1, 2)))
        ends = numpy.array([[laid[a], laid[b]] for a, b in border(faces[part]).tolist()])
        size = numpy.ptp(ends.reshape(-1, 2), axis=0).max()
        overlapping += bool(wrong[part].any() or border_crossings(ends, 1e-6 * size))
    right = ~wrong
    (s1, t1), (s2, t2), (s3, t3) = (uv[right, k].T for k in range(3))
    q1, q2, q3 = (surface[right, k] for k in range(3))
    double = 2 * flat[right][:, None]
    along_s = (q1 * (t2 - t3)[:, None] + q2 * (t3 - t1)[:, None] + q3 * (t1 - t2)[:, None]) / double
    along_t = (q1 * (s3 - s2)[:, None] + q2 * (s1 - s3)[:, None] + q3 * (s2 - s1)[:, None]) / double
    squared = ((along_s**2).sum(1) + (along_t**2).sum(1)) / 2
    weights = areas[right]
    stretch = numpy.sqrt((weights * squared).sum() / weights.sum() * flat[right].sum() / weights.sum())
    angle = (areas[:, None] * numpy.abs(angles(uv) - angles(surface))).sum() / (3 * areas.sum())
    extent = numpy.ptp(uv.reshape(-1, 2), axis=0).max()
    density = flat[right].sum() / extent**2
    return {
        "turned_over": int(wrong.sum()),
        "overlapping": int(overlapping),
        "stretch": float(stretch),
        "angle": float(angle),
        "density": float(density),
    }


def xatlas_packs(faces, chart, uv, margin):
    """Seconds of packing given islands, and which part of the rectangle around them is covered."""
    keys = numpy.repeat(chart, 3).astype(numpy.int64) * (int(faces.max()) + 1) + faces.ravel()
    _, first, corners = numpy.unique(keys, return_index=True, return_inverse=True)
    atlas = xatlas.Atlas()
    materials = chart.astype(numpy.uint32).reshape(-1, 1)
    points = uv.reshape(-1, 2)[first].astype(numpy.float32)
    atlas.add_uv_mesh(points, corners.reshape(-1, 3).astype(numpy.uint32), materials)
    options = xatlas.PackOptions()
    options.padding = round(margin * 1024)
    options.texels_per_unit = 1024 * (0.6 / numpy.abs(signed_areas(uv)).sum()) ** 0.5
    start = time.perf_counter()
    atlas.generate(xatlas.ChartOptions(), options)
    seconds = time.perf_counter() - start
    _, corners, points = atlas[0]
    return seconds, float(numpy.abs(signed_areas(points[corners].reshape(-1, 3, 2).astype(float))).sum())


def xatlas_unwraps(points, faces, chart):
    """The charts that it leaves whole, and texture coordinates of all; those of the others are 0."""
    options = xatlas.ChartOptions()
    options.max_cost = 1e30
    for weight in ["normal_deviation", "roundness", "straightness", "normal_seam", "texture_seam"]:
        setattr(options, weight + "_weight", 0)
    uv, whole = numpy.zeros((len(faces), 3, 2)), []
    for label in numpy.unique(chart):
        part = numpy.flatnonzero(chart == label)
        used, corners = numpy.unique(faces[part], return_inverse=True)
        atlas = xatlas.Atlas()
        atlas.add_mesh(points[used], corners.reshape(-1, 3).astype(numpy.uint32))
        atlas.generate(options, xatlas.PackOptions())
        if atlas.get_mesh_chart_count(0) == 1:
            whole.append(label)
            _, corners, laid = atlas[0]
            size = numpy.array([atlas.width, atlas.height])
            laid = laid[corners].reshape(-1, 3, 2) * size
            surface = points[faces[part]].astype(float)
            sides = numpy.cross(surface[:, 1] - surface[:, 0], surface[:, 2] - surface[:, 0])
            uv[part] = laid * (numpy.linalg.norm(sides, axis=1).sum() / 2 / numpy.abs(signed_areas(laid)).sum()) ** 0.5
    return whole, uv


def compare(program, folder, path, arguments):
    loaded = load(path, arguments.triangles)
    if loaded is None:
        print("left out:", path, file=sys.stderr)
        return None
    points, faces = loaded
    partition = Partition(points, faces, arguments.charts)
    seams = partition.seams()
    write_obj(folder / "model.obj", points, faces, seams)
    rated = lambda uv: measure(points, faces, partition.chart, uv)
    row = {"name": path.stem, "triangles": len(faces), "charts": len(numpy.unique(partition.chart))}
    times = {name: [] for name in ["trigon", *METHODS]}
    for _ in range(arguments.rounds):
        program.stdin.write(f"{folder}/model.obj {folder}/uv.txt {arguments.steps} {arguments.margin}\n")
        program.stdin.flush()
        ours = json.loads(program.stdout.readline())
        if "refusal" in ours:
            print(path.stem, ours["refusal"], file=sys.stderr)
            return None
        times["trigon"].append(ours["seconds"])
        for method in METHODS[: 1 if arguments.only_stretch else 3]:
            mesh = prepare_blender(points, faces, seams)
            seconds, uv = in_blender(mesh, lambda: bpy.ops.uv.unwrap(method=method))
            times[method].append(seconds)
            row[method] = uv
    for method in METHODS:
        if method in row:
            row[method] = rated(row[method]) | {"seconds": min(times[method])}
    uv = numpy.loadtxt(folder / "uv.txt").reshape(-1, 3, 2)
    row["trigon"] = ours | rated(uv) | {"seconds": min(times["trigon"])}
    if not arguments.no_packing:
        seconds, packed = blender_packs(prepare_blender(points, faces, seams), uv, arguments.margin)
        row["packed"] = {"seconds": seconds, "density": rated(packed)["density"]}
    return row | beside_xatlas(points, faces, partition.chart, uv, arguments.margin)


def beside_xatlas(points, faces, chart, uv, margin):
    seconds, density = xatlas_packs(faces, chart, uv, margin)
    whole, theirs = xatlas_unwraps(points, faces, chart)
    found = {"xatlas_packed": {"seconds": seconds, "density": density}, "xatlas_charts": len(whole)}
    among = numpy.isin(chart, whole)
    if whole:
        for name, layout in [("trigon", uv), ("xatlas", theirs)]:
            rated = measure(points, faces[among], chart[among], layout[among])
            found[name + "_in_xatlas_charts"] = {key: rated[key] for key in ["stretch", "angle", "overlapping"]}
    return found


def line(row):
    ours, theirs = row["trigon"], row["MINIMUM_STRETCH"]
    packed = row.get("packed", {"density": 0, "seconds": 0})
    return (
        f"{row['name'][:16]:16} {row['triangles']:6} {row['charts']:3} | {ours['turned_over']:2} {ours['overlapping']:2}"
        f" {ours['not_conformal']:2} | {theirs['turned_over']:3} {theirs['overlapping']:2}"
        f" | {ours['stretch']:.4f} {theirs['stretch']:.4f} {ours['stretch'] / theirs['stretch']:.3f}"
        f" | {ours['angle']:.4f} {theirs['angle']:.4f} {ours['angle'] / max(theirs['angle'], 1e-9):.3f}"
        f" | {ours['seconds']:.3f} {theirs['seconds']:.3f} {ours['seconds'] / theirs['seconds']:.2f}"
        f" | {ours['density']:.3f} {theirs['density']:.3f} {packed['density']:.3f}"
        f" {row['xatlas_packed']['density']:.3f}"
        f" {ours['pack_seconds']:.3f} {packed['seconds']:.3f} {row['xatlas_packed']['seconds']:.3f}"
    )


def report(rows):
    print("model triangles charts | trigon: turned over, overlapping, not conformal | Blender: turned over, overlapping")
    print("| L2 stretch: trigon, Blender, ratio | angles | seconds | density: trigon, Blender's unwrap, packed by Blender, by xatlas; s")
    for row in rows:
        print(line(row))
    for name in ["stretch", "angle", "seconds"]:
        ratios = [row["trigon"][name] / max(row["MINIMUM_STRETCH"][name], 1e-9) for row in rows]
        print(f"{name}: median of ratios {statistics.median(ratios):.3f}, largest {max(ratios):.3f}")
    for packed in ["packed", "xatlas_packed"]:
        # Above 1 islands lie on one another.
        packings = [row for row in rows if packed in row and row[packed]["density"] < 1]
        ratios = [row["trigon"]["density"] / row[packed]["density"] for row in packings]
        if ratios:
            print(f"density, {packed}: median of ratios {statistics.median(ratios):.3f}, least {min(ratios):.3f}")
    both = [[row[name + "_in_xatlas_charts"] for name in ["trigon", "xatlas"]] for row in rows if row["xatlas_charts"]]
    print(f"charts that xatlas leaves whole: {sum(row['xatlas_charts'] for row in rows)}, in {len(both)} models; of these")
    print(f"{sum(theirs['overlapping'] for _, theirs in both)} overlap themselves")
    for name in ["stretch", "angle"]:
        ratios = [ours[name] / max(theirs[name], 1e-9) for ours, theirs in both]
        if ratios:
            print(f"{name} in them: median of ratios {statistics.median(ratios):.3f}, largest {max(ratios):.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--charts", type=int, default=12, help="at least so many charts of a model, if it has faces for them")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--triangles", type=int, default=100_000)
    parser.add_argument("--steps", type=int, default=20, help="of trigon at most; Blender does its default")
    parser.add_argument("--margin", type=float, default=0.005)
    parser.add_argument("--only-stretch", action="store_true", help="none of Blender's other methods")
    parser.add_argument("--no-packing", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    program = subprocess.Popen([EXAMPLE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        for path in arguments.models:
            row = compare(program, pathlib.Path(folder), path, arguments)
            if row:
                rows.append(row)
                print(line(row), file=sys.stderr)
    program.stdin.close()
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1))
    report(rows)


if __name__ == "__main__":
    main()
