"""The workload of `rivals.py`: meshes, cameras, and what rays in float64 say of them. It shares no code with any renderer."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

FACES = {"1k": 9, "5k": 20, "30k": 50, "200k": 129, "1M": 289}
FIELD_OF_VIEW, DISTANCE = 40.0, 3.4
# For renderers that need clip planes.
NEAR, FAR = 1.0, 10.0


@dataclass(frozen=True)
class Mesh:
    vertices: np.ndarray
    normals: np.ndarray
    faces: np.ndarray


def mesh(cells: int) -> Mesh:
    """A sphere with bumps: the six sides of a cube with `cells` × `cells` squares each, two triangles a square."""
    at = np.linspace(-1, 1, cells + 1)
    a, b = np.meshgrid(np.tan(at * np.pi / 4), np.tan(at * np.pi / 4))
    index = np.arange(a.size).reshape(a.shape)
    square = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    points, faces = [], []
    for axis in range(3):
        for sign in (1, -1):
            side = np.stack([np.full(a.size, float(sign)), sign * a.ravel(), b.ravel()], axis=-1)
            faces.append(square + len(points) * a.size)
            points.append(np.roll(side, axis, axis=1))
    points = np.concatenate(points)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    _, first, joined = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    points = points[first]
    x, y, z = points.T
    points *= (1 + 0.06 * np.sin(5 * x) * np.cos(4 * y) + 0.04 * np.sin(7 * z + x))[:, None]
    squares = joined.reshape(-1)[np.concatenate(faces)]
    triangles = np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    vertices = points.astype(np.float32)
    return Mesh(vertices, normals(vertices, triangles), triangles.astype(np.int32))


def normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Of vertices: those of their faces, by area."""
    a, b, c = vertices.astype(np.float64)[faces].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    total = np.stack([np.bincount(faces.ravel(), np.repeat(across[:, axis], 3), len(vertices)) for axis in range(3)], axis=1)
    return (total / np.linalg.norm(total, axis=1, keepdims=True)).astype(np.float32)


def write_obj(path: Path, mesh: Mesh) -> None:
    with path.open("w") as file:
        np.savetxt(file, mesh.vertices, "v %.9g %.9g %.9g")
        np.savetxt(file, mesh.normals, "vn %.6g %.6g %.6g")
        np.savetxt(file, np.repeat(mesh.faces + 1, 2, axis=1), "f %d//%d %d//%d %d//%d")


def write_ply(path: Path, mesh: Mesh) -> None:
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.vertices)}\n"
    header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    header += f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = np.empty(len(mesh.faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, mesh.faces
    path.write_bytes(header.encode() + np.hstack([mesh.vertices, mesh.normals]).astype("<f4").tobytes() + rows.tobytes())


def pose(turn: int) -> np.ndarray:
    """From the camera to the world, OpenGL's axes: another view of the mesh each turn, so that no renderer can keep an image."""
    angle, height = 2.399963 * turn, 0.5 * np.sin(1.7 * turn)
    back = np.array([np.cos(angle) * np.cos(height), np.sin(height), np.sin(angle) * np.cos(height)])
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    result = np.eye(4)
    result[:3, 0], result[:3, 1], result[:3, 2], result[:3, 3] = right, np.cross(back, right), back, DISTANCE * back
    return result


def focal(height: int) -> float:
    """In pixels; the axis goes through the middle of the image."""
    return height / 2 / np.tan(np.radians(FIELD_OF_VIEW) / 2)


@dataclass(frozen=True)
class Exact:
    """Pixels, and the face and the depth along the view axis that the ray through the middle of each hits: -1 and inf without."""

    pixels: np.ndarray
    faces: np.ndarray
    depth: np.ndarray


def exact(mesh: Mesh, width: int, height: int, pose: np.ndarray, count: int, seed: int = 0) -> Exact:
    """Rays in float64 against all triangles whose bounds in the image the pixel is in."""
    seen = (mesh.vertices.astype(np.float64) - pose[:3, 3]) @ pose[:3, :3] * [1, -1, -1]
    image = seen[:, :2] / seen[:, 2:] * focal(height) + [width / 2, height / 2]
    corners = image[mesh.faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    order = np.argsort(low[:, 0])
    starts, widest = low[order, 0], (high - low)[:, 0].max()
    # Around the mesh, so that most of the pixels show it.
    random = np.random.default_rng(seed)
    first, last = np.maximum(low.min(axis=0) - 2, 0), np.minimum(high.max(axis=0) + 2, [width, height])
    pixels = np.floor(random.uniform(first, last, (count, 2))).astype(int)
    hits = [_hit(seen, mesh.faces, order, low, high, starts, widest, pixel + 0.5, (width, height)) for pixel in pixels]
    return Exact(pixels, np.array([face for face, _ in hits]), np.array([depth for _, depth in hits]))


def _hit(seen, faces, order, low, high, starts, widest, point, size):
    near = order[np.searchsorted(starts, point[0] - widest) : np.searchsorted(starts, point[0], "right")]
    near = near[(low[near] <= point).all(axis=1) & (high[near] >= point).all(axis=1)]
    # The image's ray, with depth 1; Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
    ray = np.array([*(point - np.array(size) / 2) / focal(size[1]), 1.0])
    a, b, c = seen[faces[near]].transpose(1, 0, 2)
    across = np.cross(ray, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 1 / np.einsum("ij,ij->i", b - a, across)
        u = -np.einsum("ij,ij->i", a, across) * scale
        other = np.cross(-a, b - a)
        v = other @ ray * scale
        depth = np.einsum("ij,ij->i", c - a, other) * scale
    depth = np.where((u >= 0) & (v >= 0) & (u + v <= 1), depth, np.inf)
    if not len(depth) or np.isinf(depth).all():
        return -1, np.inf
    return int(near[np.argmin(depth)]), float(depth.min())
