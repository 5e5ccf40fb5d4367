#!/usr/bin/env python3
"""Models through other programs and back: trimesh, and Blender without a window.

usage: round_trips.py EDITOR [--blender PROGRAM] [--keep FOLDER]

EDITOR is the program trigon-editor. Each model is written by it in each format, read by the other
program, written by that in the same format, read by trigon-editor and written as PLY. Both ends, and what the
other program itself counted, have to have the same geometry: as many faces, of the same sizes, with the
same positions to f32, or to the decimals that the other program writes, and as many distinct positions. Exit code 0 if they have, 1 if any differs. Needs numpy and trimesh; Blender only
for --blender.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy
import trimesh

HERE = pathlib.Path(__file__).resolve().parent
FORMATS = ("glb", "ply", "stl", "obj", "off")

# Triangles, quads and larger polygons, curved and flat, moved and edited, one and several objects.
CUBE = {"shape": "cube", "edge": 1.0}
MODELS = {
    "cube": [{"op": "add_object", "object": CUBE}],
    "dodecahedron": [{"op": "add_object", "object": {"shape": "dodecahedron", "edge": 0.7}}],
    "torus": [
        {
            "op": "add_object",
            "object": {"shape": "torus", "major_radius": 1.0, "minor_radius": 0.3, "major_segments": 17, "minor_segments": 9},
        },
    ],
    "teapot": [{"op": "add_object", "object": {"shape": "teapot", "subdivisions": 5}}],
    "smooth cube": [
        {"op": "add_object", "object": CUBE},
        {"op": "edit_objects"},
        {"op": "catmull_clark"},
        {"op": "catmull_clark"},
        {"op": "leave_edit_mode"},
    ],
    "two objects": [
        {"op": "add_object", "object": CUBE},
        {"op": "add_object", "object": {"shape": "cone", "radius": 0.5, "height": 1.5, "segments": 12}, "position": [3.1, 0.2, -1.7]},
    ],
}


def edit(editor, script, source, target, *options):
    command = [editor, "--quiet", "--run", script]
    command += [source] if source else []
    command += ["--output", target, *options]
    subprocess.run([str(word) for word in command], check=True)


def read_ply(path):
    """Positions and faces of a PLY as trigon writes it as text: nothing shared with its reader."""
    with open(path, encoding="ascii") as file:
        counts, name = {}, None
        for line in file:
            words = line.split()
            if words[0] == "element":
                name = words[1]
                counts[name] = int(words[2])
            if words[0] == "end_header":
                break
        vertices = [next(file).split()[:3] for _ in range(counts["vertex"])]
        faces = [next(file).split() for _ in range(counts.get("face", 0))]
    positions = numpy.array(vertices, dtype=numpy.float64).astype(numpy.float32) + numpy.float32(0)
    return [positions[[int(word) for word in row[1 : 1 + int(row[0])]]] for row in faces]


def canonical(face):
    """A face as the cycle of its positions, from the least: which corner is first means nothing."""
    corners = [tuple(corner.tolist()) for corner in face]
    least = min(range(len(corners)), key=lambda index: corners[index:] + corners[:index])
    return tuple(corners[least:] + corners[:least])


# What a program rounds to: decimals that are too few for an f32, or 0 where it rounds the place of an object to f32
# before it adds those of vertices.
STEPS = {("blender", "obj"): 1e-6, ("trimesh", "obj"): 1e-8, ("trimesh", "off"): 1e-10, ("blender", "glb"): 0.0}


def differs(before, after, step):
    """None if two lists of faces are the same but for rounding, or what differs."""
    exact = [collections.Counter(canonical(face) for face in faces) for faces in (before, after)]
    if exact[0] == exact[1]:
        return None
    lost, new = exact[0] - exact[1], exact[1] - exact[0]
    what = f"{sum(lost.values())} faces lost, {sum(new.values())} new, such as {next(iter(new or lost))}"
    if step is None or len(before) != len(after):
        return what
    # The rounding of the program, and then two of f32.
    most = 0.5 * step + 2.0 * 2.0**-24 * max(abs(corner).max() for corner in before)
    # Objects may come in another order.
    middles = numpy.array([face.mean(axis=0) for face in after])
    for face in before:
        nearest = abs(middles - face.mean(axis=0)).max(axis=1).argmin()
        if not is_near(face, after[nearest], most):
            return what
        middles[nearest] = numpy.inf
    return None


def is_near(first, second, most):
    """Whether two faces are the same from some corner on, to a distance on each axis."""
    turns = range(len(second)) if len(first) == len(second) else ()
    return any(abs(first - numpy.roll(second, turn, axis=0)).max() <= most for turn in turns)


def differ_in_positions(before, after):
    """None if two lists of faces have as many distinct positions, or how many each has. What a program rounds it rounds
    everywhere alike: positions that were one stay one."""
    counts = [len(numpy.unique(numpy.concatenate(faces), axis=0)) for faces in (before, after)]
    return None if counts[0] == counts[1] else f"{counts[0]} positions became {counts[1]}"


def through_trimesh(source, target, kind):
    scene = trimesh.load(source, process=False, force="scene")
    counts = {"faces": sum(len(mesh.faces) for mesh in scene.geometry.values())}
    # Formats without objects take one mesh.
    model = scene if kind in ("glb", "obj") else trimesh.util.concatenate(scene.dump())
    model.export(target)
    return counts


def through_blender(program, source, target, kind):
    command = [program, "--background", "--factory-startup", "--python-exit-code", "1"]
    command += ["--python", HERE / "blender_round_trip.py", "--", source, target]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stdout[-1500:] + done.stderr[-1500:])
    line = next(line for line in done.stdout.splitlines() if line.startswith("counts "))
    return json.loads(line.removeprefix("counts "))


def check(editor, peer, through, model, kind, folder):
    """None if all is well, or what differs."""
    empty = folder / "empty.json"
    empty.write_text('{"version": 1, "commands": []}')
    script = folder / "model.json"
    script.write_text(json.dumps({"version": 1, "commands": MODELS[model]}))
    stem = f"{model.replace(' ', '_')}_{kind}_{peer}"
    first, second = folder / f"{stem}_1.{kind}", folder / f"{stem}_2.{kind}"
    # Programs that know triangles alone get triangles.
    triangles = ["--triangulate"] if peer == "trimesh" or kind in ("stl", "glb") else []
    # A GLB for other programs: the editor's own would keep polygons that they do not see.
    plain = ["--scale", "1", *triangles]
    edit(editor, script, None, first, *plain)
    edit(editor, script, None, folder / "before.ply", "--ascii", *triangles)
    counts = through(first, second, kind)
    edit(editor, empty, second, folder / "after.ply", "--ascii", *triangles)
    before, after = read_ply(folder / "before.ply"), read_ply(folder / "after.ply")
    if counts["faces"] != len(before):
        return f"{peer} read {counts['faces']} faces of {len(before)}"
    return differs(before, after, STEPS.get((peer, kind))) or differ_in_positions(before, after)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("editor", type=pathlib.Path)
    parser.add_argument("--blender")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    peers = {"trimesh": through_trimesh}
    if arguments.blender:
        peers["blender"] = lambda *paths: through_blender(arguments.blender, *paths)
    failures = done = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or pathlib.Path(temporary)
        os.makedirs(folder, exist_ok=True)
        for peer, through in peers.items():
            # Blender 3.4 reads and writes no OFF.
            for kind in (kind for kind in FORMATS if (peer, kind) != ("blender", "off")):
                for model in MODELS:
                    difference = check(arguments.editor, peer, through, model, kind, folder)
                    done += 1
                    failures += difference is not None
                    if difference:
                        print(f"{peer} {kind} {model}: {difference}", flush=True)
    print(f"{done - failures} of {done} round trips leave the geometry as it was")
    return 1 if failures or not done else 0


if __name__ == "__main__":
    sys.exit(main())
