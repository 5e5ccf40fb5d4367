"""The job by Ray with two workers, of which one is killed at random times, twenty times. Linux, Ray; takes minutes; see docs/testing.md.

When a kill comes is left to chance; that every row is there with the right bytes must hold whenever it comes.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("ray")

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
sys.path.insert(0, str(EXAMPLES))

import shards  # noqa: E402

MODELS, VIEWS, KILLS = 10, 20, 20
OPTIONS = [f"--views={VIEWS}", "--size", "128", "128", "--shard-rows=10", "--workers=2"]


@pytest.mark.parametrize("format", ["tar", "parquet"])
def test_kills_change_nothing(tmp_path, format):
    models = make_models(tmp_path / "models")
    options = [*OPTIONS, f"--format={format}"]
    alone = tmp_path / "alone"
    subprocess.run([sys.executable, EXAMPLES / "dataset_multiprocessing.py", models, alone, *options, "--workers=1"], check=True)
    chance = random.Random(format)
    kills = runs = 0
    while kills < KILLS // 2:
        out = tmp_path / f"run-{runs}"
        # A few in each run, so that they come at every stage of it.
        kills += run_with_kills(models, out, options, chance, min(4, KILLS // 2 - kills))
        runs += 1
        assert samples(out, format) == samples(alone, format)
    print(f"{format}: {kills} kills in {runs} runs, {MODELS * VIEWS} rows each")


def test_a_shard_that_always_kills_its_worker_is_missed_and_the_others_are_drawn(tmp_path):
    models, out, examples = make_models(tmp_path / "models"), tmp_path / "out", tmp_path / "examples"
    shutil.copytree(EXAMPLES, examples)
    with (examples / "dataset.py").open("a") as file:
        file.write("_draw = Drawer.draw\nDrawer.draw = lambda self, row: os.kill(os.getpid(), 9) if row == 57 else _draw(self, row)\n")
    command = [sys.executable, examples / "ray_dataset.py", models, out, *OPTIONS, "--retries=2"]
    program = subprocess.run(command, capture_output=True, text=True)
    assert program.returncode == 1 and "19 of 20 shards" in program.stdout, program
    assert not (out / "shard-00005.tar").exists()


def run_with_kills(models, out, options, chance, most):
    """Runs the program to its end, with at most so many kills. Returns how many there were."""
    command = [sys.executable, EXAMPLES / "ray_dataset.py", models, out, *options, "--verify=0.05", "--retries=100"]
    program = subprocess.Popen(command)
    kills = 0
    while program.poll() is None:
        time.sleep(chance.uniform(0.1, 2.5))
        actors = [pid for pid in descendants(program.pid) if b"DrawShards" in name(pid) or b"VerifyShards" in name(pid)]
        if actors and kills < most:
            os.kill(chance.choice(actors), signal.SIGKILL)
            kills += 1
    assert program.returncode == 0
    return kills


def samples(out, format):
    """Everything of every row, by its key."""
    paths = sorted(out.glob(f"*.{format}"))
    rows = [sample for path in paths for sample in shards.read(path)]
    assert [row["key"] for row in rows] == [f"{row:08}" for row in range(MODELS * VIEWS)]
    return rows


def make_models(folder):
    """Spheres with different bumps."""
    folder.mkdir()
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 60), np.linspace(0.01, np.pi - 0.01, 40))
    at = np.arange(u.size).reshape(u.shape) + 1
    faces = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)
    for model in range(MODELS):
        radius = 1 + 0.1 * np.sin((model + 2) * v) * np.cos(3 * u)
        points = np.stack([np.sin(v) * np.cos(u), np.cos(v), np.sin(v) * np.sin(u)], axis=-1) * radius[..., None]
        lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points.reshape(-1, 3)]
        lines += ["f " + " ".join(map(str, face)) for face in faces]
        (folder / f"{model}.obj").write_text("\n".join(lines))
    return folder


def name(pid):
    """What a process calls itself; empty when it is gone."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


def descendants(pid):
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        parents[int(stat.parent.name)] = int(fields[1])
    found = [pid]
    for ancestor in found:
        found += [child for child, parent in parents.items() if parent == ancestor]
    return found[1:]
