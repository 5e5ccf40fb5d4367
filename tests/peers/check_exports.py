#!/usr/bin/env python3
"""What random scripts left, read by programs that share nothing with trigon: trimesh (GLB, OBJ, STL), MeshLab (PLY, OFF,
of which trimesh reads no mixed polygons), and readers of a few lines here.

usage: check_exports.py FOLDER

FOLDER is what the test any_commands wrote with TRIGON_EXPORTS=FOLDER: a folder for each script, with case.json and the
document in every format. Checked: every file that a script left is read; no index is out of range; no number is a NaN
or infinite; no face visits a vertex twice; no face has the vertices of another, unless the document had such faces
before; what was closed is closed if all commands promise it. Exit code 1 if anything is wrong. Needs numpy, trimesh and
pymeshlab.
"""
import argparse
import collections
import json
import pathlib
import sys

import numpy
import pymeshlab
import trimesh


# Larger files, as of a cube subdivided four times, take most of the time and show nothing else.
LARGE = 1_000_000


def polygons_of_obj(path):
    """For each object its vertices and polygons, which count through the whole file."""
    positions, faces, objects = [], [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "o":
            faces = []
            objects.append(faces)
        elif words[0] == "v":
            positions.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return positions, objects


def polygons_of_off(path):
    lines = [line.split("#")[0].split() for line in path.read_text(encoding="utf-8").splitlines()]
    lines = [words for words in lines if words]
    assert lines[0][0].endswith("OFF"), "it begins with OFF"
    vertices, faces = int(lines[1][0]), int(lines[1][1])
    positions = [[float(word) for word in words[:3]] for words in lines[2 : 2 + vertices]]
    rows = lines[2 + vertices : 2 + vertices + faces]
    assert len(rows) == faces, "as many faces as it says"
    # OFF has no edges but faces of two corners.
    faces = [[int(word) for word in row[1 : 1 + int(row[0])]] for row in rows]
    return positions, [[face for face in faces if len(face) > 2]]


def doubled(objects):
    sets = collections.Counter(frozenset(face) for faces in objects for face in faces)
    return sum(count - 1 for count in sets.values())


def open_edges(objects):
    users = collections.Counter(
        (min(a, b), max(a, b)) for faces in objects for face in faces for a, b in zip(face, face[1:] + face[:1])
    )
    return sum(1 for count in users.values() if count % 2)


def check_polygons(positions, objects, case, tally):
    """What is wrong with polygons that keep their indices."""
    faces = [face for of_object in objects for face in of_object]
    tally["polygons"] += len(faces)
    if positions and not numpy.isfinite(numpy.array(positions)).all():
        yield "a position is no number"
    if any(not 0 <= vertex < len(positions) for face in faces for vertex in face):
        yield "an index is out of range"
    if any(len(set(face)) != len(face) or len(face) < 3 for face in faces):
        yield "a face visits a vertex twice"
    if not case["doubled_faces"] and doubled(objects):
        yield f"{doubled(objects)} faces have the vertices of others"
    if case["closed"] and open_edges(objects):
        yield f"{open_edges(objects)} edges have an odd number of faces"


def check_triangles(path, tally):
    """Read by trimesh, which cuts polygons. Returns what is wrong, and the number of triangles."""
    loaded = trimesh.load(path, process=False, force="scene")
    count, wrong = 0, []
    for name, mesh in loaded.geometry.items():
        if not numpy.isfinite(mesh.vertices).all():
            wrong.append(f"{name}: a position is no number")
        if not isinstance(mesh, trimesh.Trimesh):
            continue
        count += len(mesh.faces)
        if len(mesh.faces) and not (0 <= mesh.faces.min() and mesh.faces.max() < len(mesh.vertices)):
            wrong.append(f"{name}: an index is out of range")
    matrices = [loaded.graph.get(node)[0] for node in loaded.graph.nodes_geometry]
    if not all(numpy.isfinite(matrix).all() for matrix in matrices):
        wrong.append("a matrix is no number")
    tally["triangles"] += count
    return wrong


def check_case(folder, tally):
    case = json.loads((folder / "case.json").read_text(encoding="utf-8"))
    tally["closed"] += case["closed"]
    for path in sorted(folder.iterdir()):
        ending = path.suffix
        if ending not in (".glb", ".obj", ".ply", ".stl", ".off"):
            continue
        if path.stat().st_size > LARGE:
            tally["too large"] += 1
            continue
        tally[ending] += 1
        if ending in (".obj", ".off"):
            read = polygons_of_obj if ending == ".obj" else polygons_of_off
            for wrong in check_polygons(*read(path), case, tally):
                yield f"{path.name}: {wrong}"
        try:
            # What is not edited is saved as it came; exports replace what is no number.
            if path.name == "saved.glb" and not case.get("finite", True):
                continue
            check = check_with_meshlab if ending in (".ply", ".off") else check_triangles
            wrong = list(check(path, tally))
        except Exception as error:  # Whatever another library says of a file is a finding.
            wrong = [f"{type(error).__name__}: {error}"]
        yield from (f"{path.name}: {what}" for what in wrong)


def check_with_meshlab(path, tally):
    """Read by MeshLab, which cuts polygons."""
    # MeshLab reads no lists with counts above 255.
    if b"property list uint uint" in path.read_bytes()[:1000]:
        tally["long lists"] += 1
        return
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
    tally["triangles"] += len(faces)
    if not numpy.isfinite(vertices).all():
        yield "a position is no number"
    if len(faces) and not (0 <= faces.min() and faces.max() < len(vertices)):
        yield "an index is out of range"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    tally, failures = collections.Counter(), 0
    for folder in sorted(arguments.folder.iterdir()):
        wrong = list(check_case(folder, tally))
        tally["scripts"] += 1
        failures += bool(wrong)
        for what in wrong:
            print(f"{folder.name}: {what}")
    print(", ".join(f"{tally[name]} {name}" for name in tally) + f"; {failures} scripts with something wrong")
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
