"""What rays meet, triangle by triangle in float64: Möller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997."""

from typing import NamedTuple

import numpy as np


class Nearest(NamedTuple):
    """For each ray."""

    face: np.ndarray
    """Its number; -1 if the ray meets nothing."""
    distance: np.ndarray
    """In lengths of the direction; inf if it meets nothing."""
    margin: np.ndarray
    """How far the answer is from another one: in weights from an edge, in distances from the next face."""


def nearest(triangles, origin, directions):
    """The nearest of triangles (n, 3, 3) to rays (..., 3) from one origin."""
    shape = directions.shape[:-1]
    face, distance, margin = np.full(shape, -1), np.full(shape, np.inf), np.full(shape, np.inf)
    for number, (a, b, c) in enumerate(np.asarray(triangles, dtype=np.float64)):
        p = np.cross(directions, c - a)
        determinant = p @ (b - a)
        u = (p @ (origin - a)) / determinant
        q = np.cross(origin - a, b - a)
        v = (directions @ q) / determinant
        t = ((c - a) @ q) / determinant
        inside = np.minimum(np.minimum(u, v), 1 - u - v)
        margin = np.minimum(margin, np.abs(inside))
        hit = (inside >= 0) & (t > 0)
        margin = np.where(hit & np.isfinite(distance), np.minimum(margin, np.abs(t - distance)), margin)
        nearer = hit & (t < distance)
        distance, face = np.where(nearer, t, distance), np.where(nearer, number, face)
    return Nearest(face, distance, margin)
