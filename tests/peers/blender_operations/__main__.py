#!/usr/bin/env python3
"""Every operation on meshes beside Blender's, on the same meshes with the same selections.

usage: python tests/peers/blender_operations EDITOR [--meshes N] [--first K] [--models FOLDER --model-count M] [--only TEXT] [--jobs N]

EDITOR is the program trigon-editor. Needs `bpy` (Blender 5.0.1 as a module) and numpy. For each operation it prints on how
many meshes both programs have as many vertices, edges and faces and, within rounding, the same area and volume, on how
many both refuse, and groups what differs; --details FILE writes each difference. docs/blender.md has the reasons.
"""
import argparse
import collections
import concurrent.futures
import multiprocessing
import pathlib
import subprocess
import sys
import tempfile

import meshes
from compare import compare_mesh, table_of

def models(editor, folder, count):
    """The first models of a folder, spread over it, that have 12 to 600 faces when vertices in the same position are
    one: no two with the same numbers of elements."""
    found, known = [], set()
    with tempfile.TemporaryDirectory() as name:
        script, target = pathlib.Path(name) / "nothing.json", pathlib.Path(name) / "model.obj"
        script.write_text("[]", encoding="ascii")
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() not in (".glb", ".gltf", ".obj", ".ply", ".stl", ".off"):
                continue
            words = [editor, "--quiet", "--run", script, path, "--output", target]
            done = subprocess.run([str(word) for word in words], capture_output=True, timeout=120)
            # A larger text has more than 600 faces.
            if done.returncode == 0 and target.stat().st_size < 200_000:
                mesh = meshes.welded(meshes.read_obj(target, str(path.relative_to(folder))))
                key = (len(mesh.positions), len(mesh.faces))
                if 12 <= len(mesh.faces) <= 600 and key not in known:
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
    parser.add_argument("--first", type=int, default=1, help="the first of the generated meshes that is compared")
    parser.add_argument("--models", type=pathlib.Path, help="a folder of models")
    parser.add_argument("--model-count", type=int, default=30)
    parser.add_argument("--jobs", type=int, default=2, help="how many processes")
    parser.add_argument("--only", default="", help="only operations whose name contains this")
    parser.add_argument("--details", type=pathlib.Path)
    arguments = parser.parse_args()
    table = table_of(arguments.only)
    subjects = meshes.generated(arguments.meshes)[arguments.first - 1 :]
    if arguments.models:
        found = models(arguments.editor, arguments.models, arguments.model_count)
        print(f"{len(found)} models: " + ", ".join(mesh.name for mesh in found), flush=True)
        subjects += found
    rows = []
    # Blender has one scene for each process.
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs, mp_context=multiprocessing.get_context("fork")) as pool:
        done = 0
        jobs = [pool.submit(compare_mesh, arguments.editor, mesh, arguments.only) for mesh in subjects]
        try:
            for done, job in enumerate(jobs, 1):
                rows += job.result()
                print(f"{done} of {len(subjects)} meshes", file=sys.stderr, flush=True)
        except (KeyboardInterrupt, concurrent.futures.process.BrokenProcessPool) as error:
            # What is there is reported: Blender itself may crash on a mesh.
            print(f"ended after {done} meshes: {error!r}", file=sys.stderr, flush=True)
            pool.shutdown(wait=False, cancel_futures=True)
    report(rows, table)
    if arguments.details:
        with open(arguments.details, "w", encoding="utf-8") as file:
            for name, mesh, kind, off, ours, theirs in rows:
                if kind not in ("equal", "both refuse"):
                    file.write(f"{name}\t{mesh}\t{kind}\t{off:.3g}\t{describe(ours)}\t{describe(theirs)}\n")


if __name__ == "__main__":
    main()
