"""What `docs/python.md` says of other renderers is what `benchmarks/rivals.json` has, and its rays are exact."""

import json
import re
import statistics
import sys
from pathlib import Path

import numpy as np
import pytest

PYTHON = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PYTHON / "benchmarks"))

import rivals_table  # noqa: E402
import views  # noqa: E402

RESULTS = json.loads((PYTHON / "benchmarks" / "rivals.json").read_text())
PAGE = (PYTHON.parent / "docs" / "python.md").read_text()


def test_the_page_has_the_table_of_the_measurements():
    section = re.search(r"<!-- rivals -->\n\n(.*?)\n\n<!-- end of rivals -->", PAGE, re.DOTALL)
    assert section, "docs/python.md has no section between the markers"
    assert section[1] == rivals_table.table(RESULTS), "put the output of `python rivals.py --table rivals.json` there"


@pytest.mark.parametrize("own", ["trigon3d, 1 sample", "trigon3d"])
def test_the_headline_follows_from_the_seconds(own):
    shares = []
    for cell in RESULTS["cells"]:
        seconds = {name: statistics.median(row["seconds"]) for name, row in cell["renderers"].items() if row.get("seconds")}
        others = [time for name, time in seconds.items() if not name.startswith("trigon3d")]
        shares.append(min(others) / seconds[own])
    line = next(line for line in rivals_table.headline(RESULTS).splitlines() if f" of {own}: " in line)
    assert f"{min(shares):.2g} to {max(shares):.2g} times those of the fastest of all" in line
    assert f"whatever it gives (at least 5 times in {sum(share >= 5 for share in shares)} of {len(shares)} cases)" in line


def test_rays_hit_what_the_formula_says():
    # A square of two triangles, 3 in front of the camera; a smaller one nearer, behind the diagonal.
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    vertices = np.vstack([np.c_[corners, np.zeros(4)], np.c_[corners * 0.25, np.ones(4)]]).astype(np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    pose = np.eye(4)
    pose[2, 3] = 3
    exact = views.exact(views.Mesh(vertices, vertices, faces), 200, 100, pose, 500)
    # In the middle of the pixel, in units of the depth.
    x, y = ((exact.pixels + 0.5 - [100, 50]) / views.focal(100) * [1, -1]).T
    near, far = np.maximum(abs(x), abs(y)) * 2 < 0.25, np.maximum(abs(x), abs(y)) * 3 < 1
    assert near.any() and (far & ~near).any() and (~far).any()
    clear = abs(x - y) > 1e-9
    assert np.allclose(exact.depth, np.where(near, 2, np.where(far, 3, np.inf)))
    expected = np.where(far, 2 * near + (y > x), -1)
    assert (exact.faces == expected)[clear].all()


def test_meshes_are_closed_and_face_outward():
    mesh = views.mesh(9)
    edges = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    # Each edge once in each direction.
    assert len(np.unique(edges, axis=0)) == len(edges)
    assert set(map(tuple, edges)) == set(map(tuple, edges[:, ::-1]))
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) > 0).all()
