"""A data set from a folder of models: colour, depth, ids and camera of many views of each.

`dataset_multiprocessing.py` and `ray_dataset.py` run this job. Its rows are numbered model by model, a shard is a file with consecutive rows,
and a shard is what a worker draws at once. The same job gives the same bytes, whoever draws it and however often it is interrupted.
"""

import argparse
import dataclasses
import hashlib
import io
import json
import os
import random
from pathlib import Path

import numpy as np
import shards
import trigon3d

SUFFIXES = {".obj", ".gltf", ".glb", ".ply", ".stl", ".off", ".3mf"}


@dataclasses.dataclass(frozen=True)
class Job:
    """What is drawn, and where it goes."""

    models: tuple[str, ...]
    views: int
    width: int
    height: int
    seed: int
    shard_rows: int
    format: str
    folder: str
    out: str

    @property
    def rows(self) -> int:
        return len(self.models) * self.views

    @property
    def shards(self) -> int:
        return -(-self.rows // self.shard_rows)

    def rows_of(self, shard: int) -> range:
        return range(shard * self.shard_rows, min((shard + 1) * self.shard_rows, self.rows))

    def path(self, shard: int) -> Path:
        return Path(self.out) / f"shard-{shard:05}.{self.format}"

    def unfinished(self) -> list[int]:
        return [shard for shard in range(self.shards) if not self.path(shard).exists()]

    def sample(self, fraction: float) -> list[int]:
        """Rows to verify, spread over all rows: the same for the same job, and at least one if `fraction` is not 0."""
        count = min(self.rows, max(round(fraction * self.rows), 1)) if fraction > 0 else 0
        return sorted(random.Random(self.seed).sample(range(self.rows), count))


class Drawer:
    """Draws rows. It keeps the model of the last row, and rows come model by model, so that each model is loaded once a shard."""

    def __init__(self, job: Job):
        # The machine has a worker for each core.
        trigon3d.set_threads(1)
        self.job = job
        self.model = None

    def draw(self, row: int) -> dict:
        """The sample of a row, as `shards` takes it."""
        job = self.job
        model, view = divmod(row, job.views)
        self.load(model)
        camera = self.cameras[view]
        frame = self.scene.render(job.width, job.height, camera, outputs=("color", "depth", "object_ids"))
        images = {"color": frame.to_png(), "depth": npy(frame.depth), "ids": npy(frame.object_ids)}
        about = {
            "model": job.models[model],
            "view": view,
            "width": job.width,
            "height": job.height,
            # OpenCV's conventions: pixels from K, and the pose from the camera to the world.
            "K": camera.K(job.width, job.height).ravel().tolist(),
            "pose": camera.pose("opencv").ravel().tolist(),
            **{f"{name}_sha256": shards.sha256(image) for name, image in images.items()},
        }
        return {"key": f"{row:08}", "about": about, "images": images}

    def load(self, model: int) -> None:
        if self.model != model:
            self.scene = trigon3d.load(Path(self.job.folder) / self.job.models[model])
            self.cameras = self.scene.surround(self.job.views, seed=self.job.seed, aspect=self.job.width / self.job.height)
            self.model = model


def draw_shard(drawer: Drawer, shard: int) -> str | None:
    """Draws a shard unless it is finished. Returns why that failed."""
    path = drawer.job.path(shard)
    try:
        if not path.exists():
            shards.write(path, (drawer.draw(row) for row in drawer.job.rows_of(shard)))
    except (trigon3d.TrigonError, OSError, ValueError) as error:
        return f"{path.name}: {error}"
    return None


def verify_shard(drawer: Drawer, shard: int, fraction: float) -> str | None:
    """Compares every image of a shard with its hash, and the rows of the job's sample, drawn again, byte for byte. Returns what differs."""
    job = drawer.job
    path, rows, again = job.path(shard), job.rows_of(shard), set(job.sample(fraction))
    try:
        samples = list(shards.read(path))
        if [sample["key"] for sample in samples] != [f"{row:08}" for row in rows]:
            return f"{path.name}: has other rows than {rows.start} to {rows.stop - 1}"
        for row, sample in zip(rows, samples, strict=True):
            for name, image in sample["images"].items():
                if shards.sha256(image) != sample["about"][f"{name}_sha256"]:
                    return f"{path.name}: the {name} of row {row} was changed after it was drawn"
            if row in again and drawer.draw(row) != sample:
                return f"{path.name}: row {row} is drawn differently here"
    except (trigon3d.TrigonError, OSError, ValueError, KeyError) as error:
        return f"{path.name}: {error}"
    return None


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def arguments(description: str) -> argparse.Namespace:
    """The command line that both programs have."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("folder", type=Path, help="models, also in its folders")
    parser.add_argument("out", type=Path, help="where the shards go; run again to continue")
    parser.add_argument("--models", type=int, default=100, help="the first so many models, by path")
    parser.add_argument("--views", type=int, default=100, help="of each model")
    parser.add_argument("--size", type=int, nargs=2, default=(512, 512), metavar=("WIDTH", "HEIGHT"), help="in pixels")
    parser.add_argument("--format", choices=("tar", "parquet"), default="tar", help="WebDataset tar, or Parquet (needs pyarrow)")
    parser.add_argument("--shard-rows", type=int, default=100, help="rows of a shard; what is drawn again when a worker dies")
    parser.add_argument("--seed", type=int, default=0, help="of the views")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes, each with one thread")
    parser.add_argument("--retries", type=int, default=20, help="how often a shard is drawn again after its worker died")
    parser.add_argument("--verify", type=float, default=0.0, metavar="FRACTION", help="of the rows is drawn again by other processes and compared")
    return parser.parse_args()


def start(args: argparse.Namespace) -> Job:
    """The job of a command line. Writes `job.json`, or holds the job to the one that is there."""
    # Absolute, because workers may have other current folders.
    folder, out = args.folder.resolve(), args.out.resolve()
    found = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES)
    models = tuple(found[: args.models])
    if not models:
        raise SystemExit(f"{folder} has no model ({', '.join(sorted(SUFFIXES))})")
    width, height = args.size
    job = Job(models, args.views, width, height, args.seed, args.shard_rows, args.format, str(folder), str(out))
    if min(job.views, width, height, job.shard_rows, args.workers) < 1:
        raise SystemExit("views, size, shard rows and workers are at least 1")
    out.mkdir(parents=True, exist_ok=True)
    hold(job)
    return job


def hold(job: Job) -> None:
    """Refuses to add to the shards of another job. Of a model its own file counts, and not those that it names."""
    about = {key: value for key, value in dataclasses.asdict(job).items() if key not in ("folder", "out")}
    about["models"] = {model: hashlib.sha256((Path(job.folder) / model).read_bytes()).hexdigest() for model in job.models}
    about["trigon3d"] = trigon3d.__version__
    path = Path(job.out) / "job.json"
    if path.exists():
        there = json.loads(path.read_text())
        differ = [key for key in about if there.get(key) != about[key]]
        if differ:
            raise SystemExit(f"{path.parent} has shards of another job: {', '.join(differ)} differ. Choose another folder.")
    else:
        temporary = path.with_suffix(shards.TEMPORARY)
        temporary.write_text(json.dumps(about, indent=1))
        temporary.replace(path)


def finish(job: Job, problems: list[str], verified: int | None) -> int:
    """Tells how a run ended, and removes what dead workers left. Returns the exit code."""
    missing = len(job.unfinished())
    for problem in problems:
        print(problem)
    if not missing:
        for part in Path(job.out).glob(f"shard-*{shards.TEMPORARY}"):
            part.unlink(missing_ok=True)
    print(f"{job.shards - missing} of {job.shards} shards, {job.rows} rows in all" + ("" if verified is None else f"; {verified} rows drawn again"))
    return 1 if problems or missing else 0
