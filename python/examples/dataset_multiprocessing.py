"""A data set on one machine, by processes. Run it again to continue; see docs/scale.md.

    python dataset_multiprocessing.py MODELS OUT --verify 0.01
"""

import functools
import multiprocessing
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import dataset

# The worker process's own.
_drawer = None


def main() -> int:
    args = dataset.arguments(__doc__)
    job = dataset.start(args)
    workers = Workers(job, args.workers, args.retries)
    started, waiting = time.monotonic(), job.unfinished()
    print(f"{len(waiting)} of {job.shards} shards to draw")
    problems = [problem for problem in workers.run(dataset.draw_shard, waiting) if problem]
    print(f"drawn in {time.monotonic() - started:.1f} s")
    verified = None
    if args.verify > 0 and not problems:
        # New processes: none verifies what it drew itself.
        task = functools.partial(dataset.verify_shard, fraction=args.verify)
        problems = [problem for problem in workers.run(task, range(job.shards)) if problem]
        verified = len(job.sample(args.verify))
    return dataset.finish(job, problems, verified)


class Workers:
    """Processes that do tasks. One that dies is replaced, and its task done again, without a delay for the others."""

    def __init__(self, job: dataset.Job, count: int, retries: int, drawer: type[dataset.Drawer] = dataset.Drawer):
        self.job, self.count, self.retries, self.drawer = job, count, retries, drawer

    def run(self, task: Callable, shards: Iterable[int]) -> Iterator[str | None]:
        """Results of `task(drawer, shard)`, in order, by new processes."""
        # A thread for each process, which waits for it. A pool of one process says whose task it was that did not return.
        own = threading.local()
        pools = []

        def pool(anew: bool) -> ProcessPoolExecutor:
            if anew or not hasattr(own, "pool"):
                spawn = multiprocessing.get_context("spawn")
                own.pool = ProcessPoolExecutor(1, spawn, _start, (self.drawer, self.job))
                pools.append(own.pool)
            return own.pool

        def attempt(shard: int) -> str | None:
            for tries in range(self.retries + 1):
                try:
                    return pool(anew=tries > 0).submit(_do, task, shard).result()
                except BrokenProcessPool:
                    continue
            return f"{self.job.path(shard).name}: its worker died {self.retries + 1} times"

        with ThreadPoolExecutor(self.count) as threads:
            try:
                yield from threads.map(attempt, shards)
            finally:
                threads.shutdown(cancel_futures=True)
                for started in pools:
                    started.shutdown()


def _start(drawer: type[dataset.Drawer], job: dataset.Job) -> None:
    global _drawer
    _drawer = drawer(job)


def _do(task: Callable, shard: int) -> str | None:
    return task(_drawer, shard)


if __name__ == "__main__":
    sys.exit(main())
