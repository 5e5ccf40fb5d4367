"""What is selected of a mesh before an operation: always the same for the same mesh. A selection is a list of vertex
numbers, of edges as pairs of vertices, or of face numbers; None if a mesh has nothing of the kind."""
import zlib

import numpy


def drawn(mesh, name, items, share):
    """About a share of some items, at least one."""
    random = numpy.random.default_rng(zlib.crc32(f"{mesh.name} {name}".encode()))
    chosen = [item for item, number in zip(items, random.random(len(items))) if number < share]
    return chosen or items[:1]


def all_vertices(mesh):
    return list(range(len(mesh.positions)))


def some_vertices(mesh):
    return drawn(mesh, "vertices", all_vertices(mesh), 0.2)


def one_vertex(mesh):
    return [len(mesh.positions) // 2]


def inner_vertex(mesh):
    """One with faces all around it."""
    outer = {end for pair, users in mesh.faces_of_edges().items() if len(users) != 2 for end in pair}
    inner = [vertex for vertex in all_vertices(mesh) if vertex not in outer]
    return [inner[len(inner) // 2]] if inner else None


def apart_vertices(mesh):
    """Vertices of which no two share a face."""
    around = {}
    for face in mesh.faces:
        for vertex in face:
            around.setdefault(vertex, set()).update(face)
    chosen, taken = [], set()
    for vertex in drawn(mesh, "apart", sorted(around), 0.6):
        if vertex not in taken and not taken & around[vertex]:
            chosen.append(vertex)
            taken |= around[vertex]
    return chosen


def across_face(mesh):
    """Two vertices of a polygon that no edge joins."""
    edges = set(mesh.edges())
    for face in mesh.faces[len(mesh.faces) // 3 :]:
        if len(face) > 3 and (min(face[0], face[2]), max(face[0], face[2])) not in edges:
            return [face[0], face[2]]
    return None


def across_two_faces(mesh):
    """The far corners of two quads or triangles that share an edge and nothing else."""
    for (a, b), users in mesh.faces_of_edges().items():
        if len(users) == 2:
            first, second = (set(mesh.faces[user]) for user in users)
            far = sorted(first - second), sorted(second - first)
            if first & second == {a, b} and all(far) and len(first) + len(second) < 9:
                return [far[0][0], far[1][-1]]
    return None


def edge_ends(mesh):
    edges = mesh.edges()
    return list(edges[len(edges) // 2])


def all_edges(mesh):
    return mesh.edges()


def some_edges(mesh):
    return drawn(mesh, "edges", mesh.edges(), 0.15)


def inner_edges(mesh):
    """Edges between two faces that wind alike, and that end at no other edges."""
    return [
        pair for pair, users in mesh.faces_of_edges().items() if len(users) == 2 and not set(pair) & outer_ends(mesh)
    ]


def outer_ends(mesh):
    return {end for pair, users in mesh.faces_of_edges().items() if len(users) != 2 for end in pair}


def one_edge(mesh):
    inner = inner_edges(mesh)
    return [inner[len(inner) // 2]] if inner else None


def apart_edges(mesh):
    """Inner edges of which no two share a face or a vertex."""
    faces = mesh.faces_of_edges()
    chosen, taken = [], set()
    for pair in drawn(mesh, "apart", inner_edges(mesh), 0.5):
        near = {vertex for user in faces[pair] for vertex in mesh.faces[user]}
        if not near & taken:
            chosen.append(pair)
            taken |= near
    return chosen or None


def edges_of_face(mesh):
    inner = set(inner_edges(mesh))
    for face in mesh.faces[len(mesh.faces) // 2 :]:
        outline = [(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1])]
        if inner.issuperset(outline):
            return outline
    return None


def quad_edge(mesh):
    """An edge between two quads."""
    for pair, users in list(mesh.faces_of_edges().items())[3:]:
        if len(users) == 2 and all(len(mesh.faces[user]) == 4 for user in users):
            return [pair]
    return None


def one_border(mesh):
    borders = mesh.borders()
    return borders[0] if borders else None


def two_borders(mesh):
    borders = mesh.borders()
    return borders[0] + borders[1] if len(borders) > 1 else None


def even_border(mesh):
    return next((loop for loop in mesh.borders() if len(loop) % 2 == 0), None)


def all_faces(mesh):
    return list(range(len(mesh.faces))) or None


def some_faces(mesh):
    return drawn(mesh, "faces", all_faces(mesh), 0.25)


def one_face(mesh):
    return [len(mesh.faces) // 2]


def patch(mesh):
    """A face and its neighbours."""
    start, users = len(mesh.faces) // 2, mesh.faces_of_edges()
    outline = zip(mesh.faces[start], mesh.faces[start][1:] + mesh.faces[start][:1])
    return sorted({user for a, b in outline for user in users[(min(a, b), max(a, b))]})


def outline_of_patch(mesh):
    """The edges between a patch and other faces: one loop that does not touch itself or the border of the mesh."""
    inside, users = set(patch(mesh)), mesh.faces_of_edges()
    outline = [pair for pair, faces in users.items() if len(faces) == 2 and len(inside & set(faces)) == 1]
    ends = [end for pair in outline for end in pair]
    is_loop = ends and all(ends.count(end) == 2 for end in ends) and not set(ends) & outer_ends(mesh)
    return outline if is_loop else None


def two_far_faces(mesh):
    """Two faces with as many corners and no common vertex."""
    first = mesh.faces[0]
    for number in range(len(mesh.faces) - 1, 0, -1):
        if len(mesh.faces[number]) == len(first) and not set(mesh.faces[number]) & set(first):
            return [0, number]
    return None


def nothing(mesh):
    return []
