"""One mesh through every operation of both programs, and how the results compare."""
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


def table_of(only):
    return [operation for operation in operations.TABLE if only in operation.name]


def compare_mesh(editor, mesh, only):
    """A row for each operation: its name, the kind of result and both results."""
    before, rows, table = meshes.measure(mesh), [], table_of(only)
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(1) as pool:
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
