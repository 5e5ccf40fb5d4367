"""trigon3d beside other renderers that a Python program can use without a GPU: times, memory, errors.

    python rivals.py --install VENVS             a virtual environment for each renderer, from PyPI; trigon3d by --wheel
    xvfb-run -a python rivals.py --venvs VENVS --output rivals.json [--quick]
    python rivals.py --table rivals.json --page ../../docs/python.md

Every renderer draws the same five meshes at two sizes, another view each turn, in a process of its own that stays alive; they take turns,
so that whatever else the machine does slows all of them. Needs only NumPy itself. pyrender needs OSMesa (libosmesa6), trimesh a
display (Xvfb), Open3D a Vulkan driver (mesa-vulkan-drivers) and libusb-1.0, Mitsuba's LLVM variant an LLVM (DRJIT_LIBLLVM_PATH).
"""

import argparse
import json
import os
import platform
import selectors
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import views
from renderers import RENDERERS
from rivals_table import table

SIZES = {"256²": (256, 256), "1080p": (1920, 1080)}
# A virtual environment for each package, and what is installed there. PyTorch3D has no wheel of its own for these versions of Python: this is one
# of its source by others, which needs this version of torch. pyrender pins an old PyOpenGL that lacks an OSMesa call, and does not
# know NumPy 2.
PACKAGES = {
    "trigon3d": [],
    "pyrender": ["pyrender", "numpy<2"],
    "trimesh": ["trimesh", "pyglet<2", "pillow", "scipy"],
    "Open3D": ["open3d"],
    "PyTorch3D": ["torch==2.12.0", "easypytorch3d==0.7.9.post1"],
    "PyBullet": ["pybullet", "numpy"],
    "Mitsuba": ["mitsuba", "numpy"],
}
AFTERWARDS = {"pyrender": ["PyOpenGL>=3.1.7"]}
PIXELS = 2000
MARKERS = "<!-- rivals -->", "<!-- end of rivals -->"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--install", type=Path, metavar="VENVS", help="makes the virtual environments")
    parser.add_argument("--wheel", help="trigon3d for --install", default="trigon3d")
    parser.add_argument("--venvs", type=Path, help="made by --install; without it all are looked for beside this interpreter")
    parser.add_argument("--output", type=Path, help="where the measurements go")
    parser.add_argument("--table", type=Path, metavar="JSON", help="prints the table of measurements")
    parser.add_argument("--page", type=Path, help="puts that table between the page's markers")
    parser.add_argument("--quick", action="store_true", help="two meshes, one size, few turns")
    parser.add_argument("--turns", type=int, default=9, help="images of each renderer for each mesh and size")
    parser.add_argument("--starts", type=int, default=5, help="fresh processes of each renderer")
    parser.add_argument("--limit", type=float, default=30, help="seconds for an image; four times as many for the first one")
    parser.add_argument("--budget", type=float, default=300, help="seconds of a renderer in all; then it is left out")
    parser.add_argument("--only", nargs="+", default=list(RENDERERS), choices=list(RENDERERS), metavar="RENDERER")
    args = parser.parse_args()
    if args.install:
        install(args.install, args.wheel)
    elif args.table:
        text = table(json.loads(args.table.read_text()))
        if args.page:
            before, rest = args.page.read_text().split(MARKERS[0])
            args.page.write_text(f"{before}{MARKERS[0]}\n\n{text}\n\n{MARKERS[1]}{rest.split(MARKERS[1])[1]}")
        print(text)
    elif args.output:
        print(table(measure(args)))
    else:
        parser.error("give --install, --output or --table")


def install(folder: Path, wheel: str) -> None:
    for name, packages in PACKAGES.items():
        venv = folder / name.lower()
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
        for wanted in (packages or [wheel], AFTERWARDS.get(name, [])):
            if wanted and subprocess.run([venv / "bin/pip", "install", "--quiet", *wanted]).returncode:
                print(f"{name} could not be installed; see above")


def measure(args) -> dict:
    meshes = {"1k": 9, "30k": 50} if args.quick else views.FACES
    sizes = {"256²": SIZES["256²"]} if args.quick else SIZES
    turns, starts = (3, 1) if args.quick else (args.turns, args.starts)
    results = {"machine": machine(), "versions": {}, "used": {}, "starts": {}, "cells": []}
    with tempfile.TemporaryDirectory() as folder:
        made = {name: make(Path(folder), name, cells) for name, cells in meshes.items()}
        for mesh, (path, arrays) in made.items():
            for size, (width, height) in sizes.items():
                job = {"mesh": str(path), "view": view(width, height)}
                cell = measure_cell(args, job, turns, results)
                add_errors(cell, arrays, width, height, folder)
                results["cells"].append({"mesh": mesh, "faces": len(arrays.faces), "size": size, "load": os.getloadavg()[0], "renderers": cell})
                save(args.output, results)
                print(mesh, size, {name: round(statistics.median(row["seconds"]), 4) for name, row in cell.items() if row.get("seconds")}, flush=True)
        job = {"mesh": str(made["30k"][0]), "view": view(256, 256)}
        results["starts"] = measure_starts(args, job, starts, results)
    results["machine"]["load afterwards"] = os.getloadavg()[0]
    del results["used"]
    save(args.output, results)
    return results


def save(path: Path, results: dict) -> None:
    path.write_text(json.dumps(results, indent=1, ensure_ascii=False) + "\n")


def make(folder: Path, name: str, cells: int):
    arrays = views.mesh(cells)
    path = folder / name
    np.savez(f"{path}.npz", vertices=arrays.vertices, normals=arrays.normals, faces=arrays.faces)
    views.write_obj(path.with_suffix(".obj"), arrays)
    views.write_ply(path.with_suffix(".ply"), arrays)
    return path, arrays


def view(width: int, height: int) -> dict:
    focal = views.focal(height)
    return {"width": width, "height": height, "fov": views.FIELD_OF_VIEW, "focal": focal, "near": views.NEAR, "far": views.FAR}


def measure_cell(args, job: dict, turns: int, results: dict) -> dict:
    """One mesh at one size: every renderer loads it and draws once, then they take turns."""
    cell, children = {}, {}
    for name in args.only:
        if results["used"].get(name, 0) > args.budget:
            cell[name] = {"error": f"left out, because it had used its {args.budget:.0f} s in the cases before"}
            continue
        try:
            child = Child(name, args.venvs)
        except FileNotFoundError as error:
            cell[name] = {"error": f"not installed: {error}"}
            continue
        answer = child.ask({"do": "load", "pose": views.pose(1000).tolist(), **job}, 4 * args.limit)
        cell[name] = {key: value for key, value in answer.items() if key == "error"}
        if "error" in answer:
            child.end()
        else:
            results["versions"][name] = answer["version"]
            cell[name] = {"first": answer["seconds"], "seconds": [], "processor": []}
            children[name] = child
        results["used"][name] = results["used"].get(name, 0) + child.used
    for turn in range(-1, turns):
        # Each turn begins with another renderer.
        order = list(children)
        for name in order[turn % len(order) :] + order[: turn % len(order)] if order else []:
            take_turn(args, cell[name], children, name, turn)
    for name, child in children.items():
        child.ask({"do": "draw", "pose": views.pose(0).tolist()}, args.limit)
        cell[name]["kept"] = child.file
        cell[name]["outputs"] = child.ask({"do": "keep", "path": child.file}, args.limit).get("outputs", [])
        child.end()
        results["used"][name] += child.used
    return cell


def take_turn(args, row: dict, children: dict, name: str, turn: int) -> None:
    # A slow renderer has fewer turns.
    if len(row["seconds"]) >= 3 and sum(row["seconds"]) > args.limit:
        return
    answer = children[name].ask({"do": "draw", "pose": views.pose(max(turn, 0)).tolist()}, args.limit if turn >= 0 else 4 * args.limit)
    if "error" in answer:
        row["error"] = answer["error"]
        children.pop(name).end()
    elif turn >= 0:
        # The turn before the first warms up.
        row["seconds"].append(answer["seconds"])
        row["processor"].append(answer["processor"])
        row["peak"] = answer["peak"]


def add_errors(cell: dict, mesh, width: int, height: int, folder: str) -> None:
    exact = views.exact(mesh, width, height, views.pose(0), PIXELS)
    x, y = exact.pixels.T
    hit = exact.faces >= 0
    for row in cell.values():
        path = row.pop("kept", None)
        if path is None or not Path(path).exists():
            continue
        with np.load(path) as file:
            images = dict(file)
        Path(path).unlink()
        if "depth" in images:
            depth = images["depth"][y, x].astype(np.float64)
            both = hit & np.isfinite(depth) & (depth > 0)
            relative = np.abs(depth[both] / exact.depth[both] - 1)
            row["depth error"] = {"median": float(np.median(relative)), "p99": float(np.quantile(relative, 0.99))}
            row["other outline"] = float(np.mean(np.isfinite(depth) != hit))
        if "faces" in images:
            row["other face"] = float(np.mean(images["faces"][y, x] != exact.faces))
        if "objects" in images:
            row["other object"] = float(np.mean((images["objects"][y, x] >= 0) != hit))


def measure_starts(args, job: dict, starts: int, results: dict) -> dict:
    """Seconds from the import to the first image in fresh processes, which take turns."""
    names = [name for name in args.only if name in results["versions"] and results["used"][name] <= args.budget]
    seconds = {name: [] for name in names}
    for turn in range(starts):
        for name in names:
            child = Child(name, args.venvs)
            answer = child.ask({"do": "load", "pose": views.pose(turn).tolist(), **job}, 4 * args.limit)
            child.end()
            if "seconds" in answer:
                seconds[name].append(answer["seconds"])
    return seconds


class Child:
    """A renderer's process."""

    def __init__(self, name: str, venvs: Path | None):
        package = next((package for package in PACKAGES if name.startswith(package)), name)
        python = sys.executable if venvs is None else venvs / package.lower() / "bin/python"
        handle, self.file = tempfile.mkstemp(suffix=".npz")
        os.close(handle)
        program = [str(python), str(Path(__file__).with_name("renderers.py")), name]
        self.used = 0.0
        self.log = tempfile.TemporaryFile()
        self.process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log)
        self.answers = selectors.DefaultSelector()
        self.answers.register(self.process.stdout, selectors.EVENT_READ)

    def ask(self, request: dict, limit: float) -> dict:
        started = time.monotonic()
        try:
            self.process.stdin.write(json.dumps(request).encode() + b"\n")
            self.process.stdin.flush()
            if not self.answers.select(limit):
                return {"error": f"no image within {limit:.0f} s"}
            line = self.process.stdout.readline()
        except BrokenPipeError:
            line = b""
        finally:
            self.used += time.monotonic() - started
        return json.loads(line) if line else {"error": self.last_words()}

    def last_words(self) -> str:
        self.process.wait()
        self.log.seek(0)
        lines = self.log.read().decode(errors="replace").strip().splitlines()
        return f"ended with {self.process.returncode}: {lines[-1] if lines else ''}"

    def end(self) -> None:
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
        self.answers.close()
        self.log.close()


def machine() -> dict:
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.processor())
    return {
        "processor": cpu,
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "date": time.strftime("%Y-%m-%d"),
        "load before": os.getloadavg()[0],
    }


if __name__ == "__main__":
    main()
