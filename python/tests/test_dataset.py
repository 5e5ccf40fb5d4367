"""`examples/dataset_multiprocessing.py`: kills, resuming, verification. The job by Ray is in `scale/test_ray_kills.py`."""

import io
import json
import os
import signal
import subprocess
import sys
import tarfile
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
sys.path.insert(0, str(EXAMPLES))

import dataset  # noqa: E402
import dataset_multiprocessing  # noqa: E402
import shards  # noqa: E402

CUBE = "".join(f"v {x} {y} {z}\n" for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))
CUBE += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.fixture
def job(tmp_path):
    models = tmp_path / "models"
    models.mkdir()
    (models / "cube.obj").write_text(CUBE)
    (models / "tetrahedron.obj").write_text(TETRAHEDRON)
    out = tmp_path / "whole"
    out.mkdir()
    # 10 rows in 4 shards; the second has rows of both models.
    return dataset.Job(("cube.obj", "tetrahedron.obj"), 5, 32, 24, 0, 3, "tar", str(models), str(out))


class DiesOnce(dataset.Drawer):
    """Kills its process before row 4, and no process after that."""

    def draw(self, row):
        if row == 4 and not (died := Path(self.job.out) / "died").exists():
            died.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return super().draw(row)


class AlwaysDies(dataset.Drawer):
    def draw(self, row):
        if row == 4:
            os.kill(os.getpid(), signal.SIGKILL)
        return super().draw(row)


class Counts(dataset.Drawer):
    """Leaves a file for each row that it draws."""

    def draw(self, row):
        (Path(self.job.out) / f"drew-{row}").touch()
        return super().draw(row)


def drawn(job, drawer=dataset.Drawer, workers=2):
    return list(dataset_multiprocessing.Workers(job, workers, 2, drawer).run(dataset.draw_shard, job.unfinished()))


def verified(job, fraction=1.0):
    task = partial(dataset.verify_shard, fraction=fraction)
    return list(dataset_multiprocessing.Workers(job, 1, 0).run(task, range(job.shards)))


def beside(job, name):
    out = Path(job.out).parent / name
    out.mkdir()
    return replace(job, out=str(out))


def contents(job):
    return [job.path(shard).read_bytes() for shard in range(job.shards)]


def test_after_a_kill_every_byte_is_that_of_an_undisturbed_run(job):
    assert drawn(job) == [None] * 4
    killed = beside(job, "killed")
    assert drawn(killed, DiesOnce) == [None] * 4
    assert (Path(killed.out) / "died").exists()
    assert contents(killed) == contents(job)
    # What the killed worker was writing is gone when the run is told to be complete.
    assert list(Path(killed.out).glob("*.part"))
    assert dataset.finish(killed, [], None) == 0
    assert not list(Path(killed.out).glob("*.part"))


def test_a_shard_whose_workers_always_die_is_named_and_the_others_are_drawn(job):
    assert drawn(job, AlwaysDies) == [None, "shard-00001.tar: its worker died 3 times", None, None]
    assert job.unfinished() == [1]
    assert dataset.finish(job, ["x"], None) == 1


def test_rows_of_finished_shards_are_not_drawn_again(job):
    drawn(job)
    before = contents(job)
    job.path(2).unlink()
    drawn(job, Counts)
    assert sorted(path.name for path in Path(job.out).glob("drew-*")) == ["drew-6", "drew-7", "drew-8"]
    assert contents(job) == before


def test_every_row_is_there_with_images_and_a_camera_that_agree(job):
    drawn(job)
    samples = {}
    for shard in range(job.shards):
        with tarfile.open(job.path(shard)) as tar:
            for member in tar:
                key, ending = member.name.split(".", 1)
                samples.setdefault(key, {})[ending] = tar.extractfile(member).read()
    assert list(samples) == [f"{row:08}" for row in range(10)]
    for row, sample in enumerate(samples.values()):
        about = json.loads(sample["json"])
        assert (about["model"], about["view"]) == (["cube.obj", "tetrahedron.obj"][row // 5], row % 5)
        assert sample["color.png"][:8] == b"\x89PNG\r\n\x1a\n"
        depth, ids = (np.load(io.BytesIO(sample[name])) for name in ("depth.npy", "ids.npy"))
        assert depth.shape == ids.shape == (24, 32) and (np.isfinite(depth) == (ids == 0)).all() and (ids == 0).any()
        if about["model"] == "cube.obj":
            # Depths, taken back into the world by K and the pose, are on the cube's surface, but for the grid of 1/256 pixel of its corners.
            y, x = np.nonzero(ids == 0)
            rays = np.linalg.inv(np.reshape(about["K"], (3, 3))) @ [x, y, np.ones(len(x))]
            pose = np.reshape(about["pose"], (4, 4))
            points = pose[:3, :3] @ (rays * depth[y, x]) + pose[:3, 3:]
            assert np.allclose(np.abs(points).max(axis=0), 1, atol=1e-3)


def test_verification_finds_changed_bytes_and_other_images(job):
    drawn(job)
    assert verified(job) == [None] * 4
    samples = list(shards.read(job.path(1)))
    honest = samples[2]["images"]["depth"]
    samples[2]["images"]["depth"] = honest[:-1] + bytes([honest[-1] ^ 1])
    shards.write(job.path(1), samples)
    assert verified(job, 0)[1] == "shard-00001.tar: the depth of row 5 was changed after it was drawn"
    samples[2]["about"]["depth_sha256"] = shards.sha256(samples[2]["images"]["depth"])
    shards.write(job.path(1), samples)
    assert verified(job, 0) == [None] * 4
    assert verified(job)[1] == "shard-00001.tar: row 5 is drawn differently here"
    shards.write(job.path(1), samples[:2])
    assert verified(job, 0)[1] == "shard-00001.tar: has other rows than 3 to 5"


def test_the_sample_has_the_share_that_was_asked_for(job):
    many = replace(job, views=500)
    assert [len(many.sample(share)) for share in (0, 0.0001, 0.01, 1)] == [0, 1, 10, 1000]


def test_parquet_has_the_same_samples(job):
    pytest.importorskip("pyarrow")
    drawn(job)
    table = beside(replace(job, format="parquet"), "parquet")
    assert drawn(table) == [None] * 4
    for shard in range(job.shards):
        assert list(shards.read(table.path(shard))) == list(shards.read(job.path(shard)))


def test_the_program_draws_verifies_continues_and_refuses_another_job(job):
    out = Path(job.out).parent / "out"
    command = [sys.executable, EXAMPLES / "dataset_multiprocessing.py", job.folder, out, "--views", "2", "--workers", "1"]
    command += ["--size", "16", "16", "--shard-rows", "3"]

    def run(*more):
        return subprocess.run([*command, *more], capture_output=True, text=True)

    first = run("--verify", "1")
    assert first.returncode == 0 and "2 of 2 shards, 4 rows in all; 4 rows drawn again" in first.stdout, first
    assert run().stdout.startswith("0 of 2 shards to draw")
    other = run("--seed", "1")
    assert other.returncode == 1 and "shards of another job: seed differ" in other.stderr


def test_a_model_that_cannot_be_read_is_named(job):
    (Path(job.folder) / "tetrahedron.obj").write_text("nonsense")
    first, second, third, fourth = drawn(job)
    assert first is None and "tetrahedron.obj" in second and "shard-00001" in second and third and fourth
