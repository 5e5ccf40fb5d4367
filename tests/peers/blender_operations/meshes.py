"""The meshes that both programs get: generated with fixed seeds, or read from OBJ files; and what is measured of one.

A mesh is positions (n × 3, f32 values as f64), polygons (lists of vertex numbers) and loose edges (pairs). Vertices and
polygons keep their order in both programs, so that a selection by number is the same in both.
"""
import dataclasses
import math

import numpy


@dataclasses.dataclass
class Mesh:
    name: str
    positions: numpy.ndarray
    faces: list
    loose: list = dataclasses.field(default_factory=list)

    def __post_init__(self):
        self.positions = numpy.asarray(self.positions, dtype=numpy.float32).astype(numpy.float64).reshape(-1, 3)

    def in_order_of_use(self):
        """With the vertices in the order in which faces use them, as a reader of OBJ may number them, and no others."""
        used = dict.fromkeys(vertex for face in [*self.faces, *self.loose] for vertex in face)
        numbers = {vertex: number for number, vertex in enumerate(used)}
        faces = [[numbers[vertex] for vertex in face] for face in self.faces]
        loose = [(numbers[a], numbers[b]) for a, b in self.loose]
        return Mesh(self.name, self.positions[list(used)], faces, loose)

    def edges(self):
        """Pairs of vertices, the smaller first: in the order in which the faces use them, then the loose ones. trigon
        numbers edges in this order."""
        found = {}
        for face in self.faces:
            for pair in sides(face):
                found.setdefault(pair)
        for pair in self.loose:
            found.setdefault((min(pair), max(pair)))
        return list(found)

    def faces_of_edges(self):
        users = {}
        for number, face in enumerate(self.faces):
            for pair in sides(face):
                users.setdefault(pair, []).append(number)
        return users

    def borders(self):
        """The loops of edges with one face, each as a list of edges, where no two loops share a vertex."""
        open_edges = [pair for pair, users in self.faces_of_edges().items() if len(users) == 1]
        at = {}
        for pair in open_edges:
            for end in pair:
                at.setdefault(end, []).append(pair)
        loops, left = [], dict.fromkeys(open_edges)
        while left:
            loop, waiting = [], [next(iter(left))]
            while waiting:
                pair = waiting.pop()
                if pair in left:
                    del left[pair]
                    loop.append(pair)
                    waiting += [other for end in pair for other in at[end]]
            if all(len(at[end]) == 2 for pair in loop for end in pair):
                loops.append(loop)
        return loops

    def is_closed(self):
        return bool(self.faces) and all(len(users) == 2 for users in self.faces_of_edges().values())


def sides(face):
    return [(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1])]


@dataclasses.dataclass
class Measure:
    """Counts, the sum of the lengths of the faces' area vectors, and the volume below their fans around the mean of
    their corners: neither depends on how a polygon is cut into triangles."""

    vertices: int
    edges: int
    faces: int
    area: float
    volume: float
    # What area and volume may differ by if each coordinate is off by one unit.
    length: float
    extent: float

    def counts(self):
        return self.vertices, self.edges, self.faces


def measure(mesh):
    area = volume = length = 0.0
    for face in mesh.faces:
        corners = mesh.positions[face]
        middle = corners.mean(axis=0)
        following = numpy.roll(corners, -1, axis=0)
        vector = numpy.cross(corners - middle, following - middle).sum(axis=0) / 2
        area += math.sqrt(vector @ vector)
        volume += middle @ vector / 3
        length += numpy.sqrt(((following - corners) ** 2).sum(axis=1)).sum()
    extent = abs(mesh.positions).max() if len(mesh.positions) else 0.0
    return Measure(len(mesh.positions), len(mesh.edges()), len(mesh.faces), area, volume, length, extent)


def read_obj(path, name):
    """Nothing shared with the reader of trigon."""
    positions, faces, loose = [], [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            numbers = [int(word.split("/")[0]) - 1 for word in words[1:]] if words[0] in "flp" else []
            if words[0] == "v":
                positions.append([float(word) for word in words[1:4]])
            elif words[0] == "f":
                faces.append(numbers)
            elif words[0] == "l":
                loose += zip(numbers, numbers[1:])
    return Mesh(name, numpy.array(positions), faces, loose)


def write_obj(mesh, path):
    with open(path, "w", encoding="ascii") as file:
        for position in mesh.positions:
            file.write("v " + " ".join(repr(float(numpy.float32(value))) for value in position) + "\n")
        for face in mesh.faces:
            file.write("f " + " ".join(str(vertex + 1) for vertex in face) + "\n")
        for pair in mesh.loose:
            file.write("l " + " ".join(str(vertex + 1) for vertex in pair) + "\n")


def welded(mesh):
    """Vertices in the same position are one; faces without three of them, and all but one of faces with the same
    vertices, go: a file with texture coordinates has one vertex for each of them. What is not used goes, too."""
    numbers, known = {}, set()
    faces = []
    for face in mesh.faces:
        keys = [tuple(mesh.positions[vertex] + 0.0) for vertex in face]
        keys = [key for key, before in zip(keys, keys[-1:] + keys[:-1]) if key != before]
        if len(set(keys)) != len(keys) or len(keys) < 3 or frozenset(keys) in known:
            continue
        known.add(frozenset(keys))
        faces.append([numbers.setdefault(key, len(numbers)) for key in keys])
    return Mesh(mesh.name, numpy.array(list(numbers)), faces)


# Generated meshes ---------------------------------------------------------------------------------------------------


def grid(columns, rows, height=lambda x, y: 0.0):
    points = [
        (2 * x / columns - 1, height(2 * x / columns - 1, 2 * y / rows - 1), 1 - 2 * y / rows)
        for y in range(rows + 1)
        for x in range(columns + 1)
    ]
    at = lambda x, y: y * (columns + 1) + x
    faces = [
        [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)] for y in range(rows) for x in range(columns)
    ]
    return points, faces


def lathe(profile, segments, closes=False):
    """A profile of (radius, height) turned about Y. Radius 0 is one vertex; `closes` joins the last to the first."""
    points, rows = [], []
    for radius, height in profile:
        row = []
        for step in range(segments):
            if radius == 0 and row:
                row.append(row[0])
                continue
            turn = 2 * math.pi * step / segments
            row.append(len(points))
            points.append((radius * math.cos(turn), height, -radius * math.sin(turn)))
        rows.append(row)
    faces = []
    for lower, upper in zip(rows, rows[1:] + (rows[:1] if closes else [])):
        for step in range(segments):
            after = (step + 1) % segments
            face = list(dict.fromkeys([lower[step], lower[after], upper[after], upper[step]]))
            if len(face) > 2:
                faces.append(face)
    return points, faces


def prism(outline, height):
    """An outline in the XZ plane, counter-clockwise seen from above, as a solid with two polygons."""
    count = len(outline)
    points = [(x, 0.0, -z) for x, z in outline] + [(x, height, -z) for x, z in outline]
    walls = [[i, (i + 1) % count, count + (i + 1) % count, count + i] for i in range(count)]
    return points, [list(range(count))[::-1], list(range(count, 2 * count)), *walls]


def polygon(count, radius=lambda step: 1.0):
    turns = [(step, 2 * math.pi * step / count) for step in range(count)]
    return [(radius(step) * math.cos(turn), radius(step) * math.sin(turn)) for step, turn in turns]


def box(pieces, inflate):
    """A cube with its sides cut into squares; `inflate` moves its vertices towards a sphere."""
    numbers, faces = {}, []
    for axis in range(3):
        for side in (0, pieces):
            for u in range(pieces):
                for v in range(pieces):
                    corners = [(u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)]
                    keys = []
                    for a, b in corners if side else corners[::-1]:
                        key = [0, 0, 0]
                        key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3] = side, a, b
                        keys.append(tuple(key))
                    faces.append([numbers.setdefault(key, len(numbers)) for key in keys])
    points = numpy.array(list(numbers)) * (2 / pieces) - 1
    round_points = points / numpy.linalg.norm(points, axis=1, keepdims=True)
    return points * (1 - inflate) + round_points * inflate, faces


def dual(points, faces):
    """A vertex for each face and a polygon for each vertex of a closed mesh."""
    points = numpy.asarray(points)
    following = {}
    for number, face in enumerate(faces):
        for before, vertex, after in zip(face[-1:] + face[:-1], face, face[1:] + face[:1]):
            following.setdefault(vertex, {})[after] = (before, number)
    polygons = []
    for vertex in sorted(following):
        ring, start = [], next(iter(following[vertex]))
        at = start
        while True:
            at, number = following[vertex][at]
            ring.append(number)
            if at == start:
                break
        polygons.append(ring)
    return [points[face].mean(axis=0) for face in faces], polygons


def without(points, faces, chosen):
    """Without some faces, and vertices that none uses any more."""
    left = [face for number, face in enumerate(faces) if number not in chosen]
    used = sorted({vertex for face in left for vertex in face})
    numbers = {vertex: number for number, vertex in enumerate(used)}
    points = [points[vertex] for vertex in used]
    return points, [[numbers[vertex] for vertex in face] for face in left]


def triangles(points, faces):
    return points, [[face[0], a, b] for face in faces for a, b in zip(face[1:], face[2:])]


def twice(points, faces):
    points = numpy.asarray(points)
    moved = points * 0.75 + (2.5, 0.125, 0.25)
    return numpy.concatenate([points, moved]), faces + [[v + len(points) for v in face] for face in faces]


def moebius(pieces):
    points = []
    for step in range(pieces):
        turn = 2 * math.pi * step / pieces
        for side in (-0.3, 0.3):
            radius = 1 + side * math.cos(turn / 2)
            points.append((radius * math.cos(turn), side * math.sin(turn / 2), radius * math.sin(turn)))
    faces = [[2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2] for i in range(pieces - 1)]
    return points, faces + [[2 * pieces - 2, 2 * pieces - 1, 0, 1]]


def three_sheets(pieces):
    """Three strips of quads that meet at one row of edges."""
    points = [(0.0, 0.0, float(step)) for step in range(pieces + 1)]
    faces = []
    for turn in (0.2, 2.2, 4.4):
        first = len(points)
        points += [(math.cos(turn), math.sin(turn), float(step)) for step in range(pieces + 1)]
        faces += [[i, i + 1, first + i + 1, first + i] for i in range(pieces)]
    return points, faces


def sphere_profile(rings):
    bends = [math.pi * (ring / rings - 0.5) for ring in range(rings + 1)]
    return [(0.0 if ring in (0, rings) else math.cos(b), math.sin(b)) for ring, b in enumerate(bends)]


def circle_profile(pieces):
    turns = [2 * math.pi * piece / pieces for piece in range(pieces)]
    return [(1 + 0.35 * math.cos(turn), 0.35 * math.sin(turn)) for turn in turns]


def notched(n):
    """An outline with a reflex corner in every notch."""
    top = [(x + shift, 1.0 - depth) for x in range(n, 0, -1) for shift, depth in ((0.0, 0.0), (-0.5, 0.4))]
    return [(0.0, 0.0), (float(n), 0.0), *top, (0.0, 1.0)]


# Each family: a name, and the mesh number 0 to 9 of it.
FAMILIES = {
    "cube": lambda n, _: box(n % 5 + 1, 0.0),
    "round cube": lambda n, _: box(n % 5 + 2, 0.1 * (n + 1)),
    "grid": lambda n, _: grid(n + 1, 10 - n),
    "wavy grid": lambda n, _: grid(3 + n, 4, lambda x, y: 0.3 * math.sin(3 * x + n) * math.cos(2 * y)),
    "sphere": lambda n, _: lathe(sphere_profile(3 + n % 4), 5 + n),
    "torus": lambda n, _: lathe(circle_profile(4 + n % 4), 5 + n, closes=True),
    "cone": lambda n, _: lathe([(0.0, 0.0), (1.0, 0.0), (0.5 + 0.02 * n, 0.7), (0.0, 1.5)], 4 + n),
    "open cylinder": lambda n, _: lathe([(1.0, y / 3) for y in range(2 + n % 3)], 4 + 2 * (n % 5)),
    "prism": lambda n, _: prism(polygon(3 + n), 0.5 + 0.1 * n),
    "star prism": lambda n, _: prism(polygon(2 * (n + 3), lambda i: 1.0 if i % 2 else 0.5), 0.8),
    "notched prism": lambda n, _: prism(notched(n % 5 + 1), 1.0 + 0.1 * n),
    "polygons": lambda n, _: dual(*triangles(*lathe(sphere_profile(4 + n % 3), 5 + n))),
    "open polygons": lambda n, _: without(*dual(*triangles(*box(2 + n % 3, 0.7))), set(range(n, n + 3))),
    "torus of triangles": lambda n, _: triangles(*lathe(circle_profile(3 + n % 4), 6 + n, closes=True)),
    "cube with holes": lambda n, r: without(*box(3 + n % 3, 0.2), {n, n + 11, n + 30}),
    "grid with a hole": lambda n, _: without(*grid(5 + n % 3, 5), {12, 13, 17 + n % 3}),
    "two parts": lambda n, _: twice(*box(1 + n % 3, 0.05 * n)),
    "strip with one side": lambda n, _: moebius(5 + n),
    "three sheets": lambda n, _: three_sheets(1 + n),
    "rough sphere": lambda n, _: lathe(sphere_profile(4 + n % 3), 6 + n),
}
# How far vertices are moved at random, for each family: 0 for exact shapes.
ROUGH = {"rough sphere": 0.12, "wavy grid": 0.05, "two parts": 0.03, "polygons": 0.04, "open cylinder": 0.05}


def generated(count):
    """So many meshes, at most 200, family by family in turns."""
    numbered = [(family, n) for n in range(10) for family in FAMILIES]
    return [make(family, n) for family, n in numbered[:count]]


def make(family, n):
    random = numpy.random.default_rng([len(family), n])
    points, faces = FAMILIES[family](n, random)
    points = numpy.array(points, dtype=numpy.float64)
    # In half of a family no two lengths are alike by accident, so that ties decide nothing.
    rough = ROUGH.get(family, 0.02 if n % 2 else 0.0)
    if rough:
        points += random.uniform(-rough, rough, points.shape)
    return Mesh(f"{family} {n}", points, [list(face) for face in faces]).in_order_of_use()
