"""Whether memory grows: makes and drops many scenes, draws many images, fills arrays, and is refused many times.

    python python/benchmarks/endurance.py [COUNT]

For each kind of work, a twentieth of it first fills caches. Then COUNT (100,000) repetitions follow, and the process's
resident memory is told before and after. The last line is `grown` if any work took more than 8 MiB for good, and the
exit code then is 1. It needs Linux (`/proc/self/statm`) and takes some minutes.
"""

import gc
import os
import sys
import time

import numpy as np
import trigon3d

# A renderer's buffers come and go by so much; a leak of 100 bytes a repetition is more.
MOST_GROWTH = 8 << 20

VERTICES = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
FACES = np.array([[0, 1, 2], [0, 2, 3]])
CAMERA = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
SIDE = 16


def resident() -> int:
    """Bytes of this process in memory."""
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def make_scene() -> trigon3d.Scene:
    """A square with a texture, and a light."""
    scene = trigon3d.Scene()
    material = trigon3d.Material(texture=np.zeros((8, 8, 3), np.uint8))
    scene.add_mesh(VERTICES, FACES, uvs=VERTICES[:, :2], material=material)
    scene.add_light("point", position=(0, 0, 3))
    return scene


SCENE = make_scene()


def draw() -> None:
    """One image with several outputs."""
    SCENE.render(SIDE, SIDE, CAMERA, outputs=("color", "depth", "object_ids"), samples=1, threads=1)


def draw_new_scene() -> None:
    """An image of a scene that is dropped, with its renderer."""
    make_scene().render(SIDE, SIDE, CAMERA, samples=1, threads=1)


def change_and_draw() -> None:
    """Another pose and other vertices."""
    SCENE.set_pose(0, np.eye(4))
    SCENE.set_vertices(0, VERTICES)
    draw()


OUT = {"depth": np.zeros((2, SIDE, SIDE), np.float32)}


def fill() -> None:
    """Arrays that are there already."""
    SCENE.render_many([CAMERA, CAMERA], out=OUT, samples=1, threads=1)


def be_refused() -> None:
    """Errors, with what was made before them."""
    for work in (lambda: SCENE.add_mesh(VERTICES, [[0, 1, 9]]), lambda: SCENE.render(SIDE, SIDE, CAMERA, outputs="deep")):
        try:
            work()
        except ValueError:
            continue
        raise AssertionError("it was not refused")


def main() -> int:
    """The exit code."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    has_grown = False
    for work in (make_scene, draw, draw_new_scene, change_and_draw, fill, be_refused):
        for _ in range(count // 20):
            work()
        before, started = resident(), time.perf_counter()
        for _ in range(count):
            work()
        growth, seconds = resident() - before, time.perf_counter() - started
        has_grown |= growth > MOST_GROWTH
        print(f"{work.__name__:16} {count} times in {seconds:6.1f} s: {before / 2**20:6.1f} MiB, {growth / 2**10:+.0f} KiB", flush=True)
    print("grown" if has_grown else "memory did not grow")
    return int(has_grown)


if __name__ == "__main__":
    sys.exit(main())
