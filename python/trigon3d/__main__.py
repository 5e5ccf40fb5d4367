"""Draws models to PNG files: ``python -m trigon3d chair.glb --output chair.png``."""

import argparse
import sys
from typing import Literal

import trigon3d


def main() -> int:
    """The exit code: 0 done, 1 a file could not be read, drawn or written, 2 the command line is invalid."""
    parser = argparse.ArgumentParser(prog="python -m trigon3d", description="Draw a model to a PNG file.")
    parser.add_argument("model", help="OBJ, glTF, GLB, PLY, STL, OFF or 3MF")
    parser.add_argument("--output", required=True, metavar="FILE.png")
    parser.add_argument("--resolution", default="1000,600", metavar="W,H")
    parser.add_argument("--samples", type=int, default=3, help="along each side of a pixel, 1 to 4")
    parser.add_argument("--up", help="the axis that points up, such as +Z")
    parser.add_argument("--no-background", action="store_true")
    arguments = parser.parse_args()
    try:
        width, height = (int(number) for number in arguments.resolution.replace("x", ",").split(","))
    except ValueError:
        parser.error("--resolution takes a width and a height, such as 1000,600")
    background: Literal["transparent", "default"] = "transparent" if arguments.no_background else "default"
    try:
        scene = trigon3d.load(arguments.model, up=arguments.up)
        scene.render(width, height, samples=arguments.samples, background=background).save(arguments.output)
    except (trigon3d.TrigonError, ValueError) as error:
        print(f"trigon3d: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
