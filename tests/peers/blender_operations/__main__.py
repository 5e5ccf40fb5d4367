#!/usr/bin/env python3
"""Every operation on meshes beside Blender's, on the same meshes with the same selections.

usage: python tests/peers/blender_operations EDITOR [--meshes N] [--models FOLDER --model-count M] [--only TEXT]

EDITOR is the program trigon-editor. Needs `bpy` (Blender 5.0.1 as a module) and numpy. For each operation it prints on how
many meshes both programs have as many vertices, edges and faces and, within rounding, the same area and volume, on how
many both refuse, and groups what differs; --details FILE writes each difference. docs/blender.md has the reasons.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import subprocess
import tempfile

import blender
import meshes
import operations

# Each program rounds positions to f32 and computes with f32 or f64: coordinates may differ by some units in the last
# position of the largest one. Blender computes in f32 throughout, with about a hundred roundings in a row.
UNITS = 128 * 2.0**-24


class Refused(Exception):
    pass


def run_trigon(editor, folder, mesh, operation, selected):
    """The mesh after trigon's commands. Raises Refused."""
    source, base = folder / "subject.obj", operation.name.replace(" ", "-").replace(",", "")
    if operation.kind == "edge":
        numbers = {pair: number for number, pair in enumerate(mesh.edges())}
        selected = [numbers[pair] for pair in selected]
    commands = [
        {"op": "edit_objects", "objects": ["subject"]},
        {"op": "set_element_kind", "kind": operation.kind},
        {"op": "select", "elements": selected},
        *operation.commands,
    ]
    script, target = folder / f"{base}.json", folder / f"{base}.obj"
    script.write_text(json.dumps(commands), encoding="ascii")
    words = [editor, "--quiet", "--run", script, source, "--output", target]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        if done.returncode != 1:
            raise RuntimeError(f"{mesh.name}, {operation.name}: exit code {done.returncode}: {done.stderr}")
        raise Refused(done.stderr.strip())
    after = meshes.read_obj(target, mesh.name)
    target.unlink()
    return after


def outcome(run):
    """A measure, or the message of a refusal."""
    try:
        return meshes.measure(run())
    except (Refused, blender.Refused) as error:
        return str(error)


def compare(before, ours, theirs):
    """What kind of result this is, and by how many times rounding area and volume differ."""
    refused = isinstance(ours, str), isinstance(theirs, str)
    if all(refused):
        return "both refuse", 0.0
    # An operator of Blender that finds nothing to do often just ends.
    if refused[0]:
        return ("both refuse" if is_same(before, theirs) else "trigon refuses"), 0.0
    if refused[1]:
        return ("both refuse" if is_same(before, ours) else "Blender refuses"), 0.0
    if ours.counts() != theirs.counts():
        return "counts differ", 0.0
    off = distance(ours, theirs)
    return ("equal" if off <= 1 else "shape differs"), off


def distance(ours, theirs):
    """Of areas and volumes, in units of what rounding explains: an area changes by at most the lengths of the edges, and
    a volume by at most the area, times what a coordinate is off by."""
    unit = UNITS * max(ours.extent, theirs.extent)
    bounds = (ours.area, theirs.area, unit * ours.length), (ours.volume, theirs.volume, unit * (ours.area + unit * ours.length))
    return max(abs(one - other) / max(bound, 1e-30) for one, other, bound in bounds)


def is_same(first, second):
    return first.counts() == second.counts() and distance(first, second) <= 1


def compare_mesh(editor, mesh, table):
    """A row for each operation: its name, the kind of result and both results."""
    before, rows = meshes.measure(mesh), []
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder = pathlib.Path(name)
        meshes.write_obj(mesh, folder / "subject.obj")
        chosen = [(operation, operation.select(mesh)) for operation in table]
        chosen = [pair for pair in chosen if pair[1] is not None]
        run = lambda pair: outcome(lambda: run_trigon(editor, folder, mesh, *pair))
        waiting = pool.map(run, chosen)
        for pair, ours in zip(chosen, waiting):
            calls = [call for call in (pair[0].blender, pair[0].other) if call]
            results = [outcome(lambda: blender.run(mesh, *pair, call)) for call in calls]
            compared = [(*compare(before, ours, theirs), ours, theirs) for theirs in results]
            best = next((row for row in compared if row[0] == "equal"), compared[0])
            rows.append((pair[0].name, mesh.name, *best))
    return rows


def models(editor, folder, count):
    """The first models of a folder, spread over it, that have 12 to 1500 faces when vertices in the same position are
    one: no two with the same numbers of elements."""
    found, known = [], set()
    with tempfile.TemporaryDirectory() as name:
        script, target = pathlib.Path(name) / "nothing.json", pathlib.Path(name) / "model.obj"
        script.write_text("[]", encoding="ascii")
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() not in (".glb", ".gltf", ".obj", ".ply", ".stl", ".off"):
                continue
            words = [editor, "--quiet", "--run", script, path, "--output", target]
            if subprocess.run([str(word) for word in words], capture_output=True, timeout=120).returncode == 0:
                mesh = meshes.welded(meshes.read_obj(target, str(path.relative_to(folder))))
                key = (len(mesh.positions), len(mesh.faces))
                if 12 <= len(mesh.faces) <= 1500 and key not in known:
                    known.add(key)
                    found.append(mesh)
    step = max(1, len(found) // count)
    return found[::step][:count]


def describe(result):
    if isinstance(result, str):
        return result.replace("\n", " ")
    return f"{result.vertices}/{result.edges}/{result.faces}, area {result.area:.7g}, volume {result.volume:.7g}"


KINDS = ("equal", "both refuse", "counts differ", "shape differs", "trigon refuses", "Blender refuses")


def report(rows, table):
    tally = collections.defaultdict(collections.Counter)
    for name, _, kind, *_ in rows:
        tally[name][kind] += 1
    print("| operation | " + " | ".join(KINDS) + " |\n|---" + "|---" * len(KINDS) + "|")
    for operation in table:
        counts = tally[operation.name]
        print(f"| {operation.name} | " + " | ".join(str(counts[kind] or "") for kind in KINDS) + " |")
    total = sum(tally.values(), collections.Counter())
    whole = sum(1 for counts in tally.values() if set(counts) <= {"equal", "both refuse"})
    print("\n" + ", ".join(f"{total[kind]} {kind}" for kind in KINDS))
    print(f"{len(tally)} operations, {whole} of them alike on every mesh; {sum(total.values())} comparisons")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("editor")
    parser.add_argument("--meshes", type=int, default=200, help="how many generated meshes, at most 200")
    parser.add_argument("--models", type=pathlib.Path, help="a folder of models")
    parser.add_argument("--model-count", type=int, default=30)
    parser.add_argument("--only", default="", help="only operations whose name contains this")
    parser.add_argument("--details", type=pathlib.Path)
    arguments = parser.parse_args()
    table = [operation for operation in operations.TABLE if arguments.only in operation.name]
    subjects = meshes.generated(arguments.meshes)
    if arguments.models:
        found = models(arguments.editor, arguments.models, arguments.model_count)
        print(f"{len(found)} models: " + ", ".join(mesh.name for mesh in found))
        subjects += found
    rows = []
    for mesh in subjects:
        rows += compare_mesh(arguments.editor, mesh, table)
    report(rows, table)
    if arguments.details:
        with open(arguments.details, "w", encoding="utf-8") as file:
            for name, mesh, kind, off, ours, theirs in rows:
                if kind not in ("equal", "both refuse"):
                    file.write(f"{name}\t{mesh}\t{kind}\t{off:.3g}\t{describe(ours)}\t{describe(theirs)}\n")


if __name__ == "__main__":
    main()
