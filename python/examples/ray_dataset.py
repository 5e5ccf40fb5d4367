"""A data set by Ray Data, on one machine or a cluster. Run it again to continue; see docs/scale.md.

    pip install "ray[data]" pyarrow
    python ray_dataset.py MODELS OUT --format parquet --verify 0.01

Ray places, restarts and retries. What it is given is a data set with a row for each shard; an actor keeps its loaded model from row to row.
"""

import sys
import time
from pathlib import Path

import dataset
import numpy as np
import ray


def main() -> int:
    args = dataset.arguments(__doc__)
    job = dataset.start(args)
    # The modules beside this file go to workers on other machines; trigon3d is installed there.
    ray.init(runtime_env={"working_dir": str(Path(__file__).parent)}, logging_level="warning")
    # A shard that fails again and again does not stop the others; `finish` tells of it.
    ray.data.DataContext.get_current().max_errored_blocks = -1
    started, waiting = time.monotonic(), job.unfinished()
    print(f"{len(waiting)} of {job.shards} shards to draw")
    problems = run(DrawShards, waiting, args, [job])
    print(f"drawn in {time.monotonic() - started:.1f} s")
    verified = None
    if args.verify > 0 and not problems and not job.unfinished():
        # New actors: none verifies what it drew itself.
        problems = run(VerifyShards, range(job.shards), args, [job, args.verify])
        verified = len(job.sample(args.verify))
    return dataset.finish(job, problems, verified)


def run(actor: type, shards, args, given: list) -> list[str]:
    """What went wrong with each shard, by a pool of actors. Ray Data restarts those that die; a task of theirs has so many retries."""
    if not shards:
        return []
    # A block for each shard, because a block is what is retried.
    rows = ray.data.from_items([{"shard": shard} for shard in shards], override_num_blocks=len(shards))
    done = rows.map_batches(
        actor,
        fn_constructor_args=given,
        batch_size=1,
        compute=ray.data.ActorPoolStrategy(size=args.workers),
        num_cpus=1,
        max_restarts=-1,
        max_task_retries=args.retries,
    ).take_all()
    return [row["problem"] for row in done if row["problem"]]


class DrawShards:
    def __init__(self, job: dataset.Job):
        self.drawer = dataset.Drawer(job)

    def __call__(self, batch: dict) -> dict:
        return told(batch, [dataset.draw_shard(self.drawer, int(shard)) for shard in batch["shard"]])


class VerifyShards:
    def __init__(self, job: dataset.Job, fraction: float):
        self.drawer, self.fraction = dataset.Drawer(job), fraction

    def __call__(self, batch: dict) -> dict:
        return told(batch, [dataset.verify_shard(self.drawer, int(shard), self.fraction) for shard in batch["shard"]])


def told(batch: dict, problems: list) -> dict:
    return {"shard": batch["shard"], "problem": np.array([problem or "" for problem in problems])}


if __name__ == "__main__":
    sys.exit(main())
