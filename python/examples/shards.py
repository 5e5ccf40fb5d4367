"""Files of a data set: WebDataset tar and Parquet. A sample is a dict: `key`, `about` (what JSON can hold), and `images`, bytes by name.

A file gets its name when it is complete, so that a file with its name is a finished one. The same samples give the same bytes.
"""

import hashlib
import io
import json
import os
import tarfile
import uuid
from collections.abc import Iterable, Iterator
from pathlib import Path

# Names of the images, with the endings that WebDataset decodes by.
IMAGES = {"color": "color.png", "depth": "depth.npy", "ids": "ids.npy"}
TEMPORARY = ".part"


def write(path: Path, samples: Iterable[dict]) -> None:
    """Writes to a temporary name beside `path` and renames it. Two writers of one file do no harm: both write the same."""
    temporary = path.with_name(f"{path.name}.{uuid.uuid4().hex}{TEMPORARY}")
    writer = {".tar": _write_tar, ".parquet": _write_parquet}[path.suffix]
    try:
        with temporary.open("wb") as file:
            writer(file, samples)
            file.flush()
            # Otherwise a machine that stops could leave a file that has its name and not its contents.
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def read(path: Path) -> Iterator[dict]:
    """The samples of a finished file, in order."""
    yield from {".tar": _read_tar, ".parquet": _read_parquet}[path.suffix](path)


def sha256(image: bytes) -> str:
    return hashlib.sha256(image).hexdigest()


def _write_tar(file, samples: Iterable[dict]) -> None:
    with tarfile.open(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for sample in samples:
            members = {IMAGES[name]: image for name, image in sample["images"].items()}
            members["json"] = json.dumps(sample["about"]).encode()
            for ending, content in members.items():
                # Neither a time nor a user, so that the bytes depend on the samples alone.
                member = tarfile.TarInfo(f"{sample['key']}.{ending}")
                member.size = len(content)
                tar.addfile(member, io.BytesIO(content))


def _read_tar(path: Path) -> Iterator[dict]:
    names = {ending: name for name, ending in IMAGES.items()}
    with tarfile.open(path) as tar:
        sample = None
        for member in tar:
            key, ending = member.name.split(".", 1)
            if sample is None or sample["key"] != key:
                sample = {"key": key, "about": None, "images": {}}
            content = tar.extractfile(member).read()
            if ending == "json":
                # The last member of a sample.
                sample["about"] = json.loads(content)
                yield sample
            else:
                sample["images"][names[ending]] = content


def _write_parquet(file, samples: Iterable[dict]) -> None:
    import pyarrow
    import pyarrow.parquet

    rows = [{"key": sample["key"], **sample["about"], **sample["images"]} for sample in samples]
    pyarrow.parquet.write_table(pyarrow.Table.from_pylist(rows), file)


def _read_parquet(path: Path) -> Iterator[dict]:
    import pyarrow.parquet

    for row in pyarrow.parquet.read_table(path, partitioning=None).to_pylist():
        images = {name: row.pop(name) for name in IMAGES}
        yield {"key": row.pop("key"), "about": row, "images": images}
