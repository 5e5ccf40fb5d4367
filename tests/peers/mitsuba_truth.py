#!/usr/bin/env python3
"""Six scenes as Mitsuba 3 draws them, beside trigon's images of the same meshes from the same camera.

usage: mitsuba_truth.py FOLDER [--samples N]

FOLDER is what `cargo run --release -p trigon-study --example truth -- FOLDER` wrote. Both images are linear light; Mitsuba
takes N samples a pixel (1,024) of a box filter, and lamps have no size, so that its images have no noise but at edges. Prints
a row for each image: the root of the mean square of the difference, as a share of the mean light, over all pixels that show
a surface and over those whose neighbours show nothing else, and the greatest difference of the latter. Needs mitsuba and numpy.
"""
import argparse
import json
import math
import pathlib

import mitsuba
import numpy

mitsuba.set_variant("scalar_rgb")
from mitsuba import ScalarTransform4f as Map  # noqa: E402 (needs the variant)


def rgb(values):
    return {"type": "rgb", "value": [float(value) for value in values]}


def surface(described, folder):
    """Mitsuba's own model that comes nearest."""
    color = described["color"]
    if described["kind"] == "lambert":
        bsdf = {"type": "diffuse", "reflectance": rgb(color)}
    elif described["metallic"] == 1:
        # A mirror of microfacets without Fresnel's law: what a white metal is.
        alpha = described["roughness"] ** 2
        bsdf = {"type": "roughconductor", "material": "none", "distribution": "ggx", "alpha": alpha, "specular_reflectance": rgb(color)}
    else:
        bsdf = {"type": "principled", "base_color": rgb(color), "roughness": described["roughness"], "metallic": 0.0, "specular": 0.5}
    if "normals" in described:
        image = {"type": "bitmap", "filename": str(folder / described["normals"]), "raw": True}
        bsdf = {"type": "normalmap", "normalmap": image, "bsdf": bsdf}
    return {"type": "twosided", "bsdf": bsdf}


def lamp(light):
    # trigon's intensity is what a white matt surface shows: π times less than what arrives.
    power = rgb([math.pi * light["intensity"]] * 3)
    if light["kind"] == "directional":
        return {"type": "directional", "direction": light["along"], "irradiance": power}
    if light["kind"] == "point":
        return {"type": "point", "position": light["place"], "intensity": power}
    target = [a + b for a, b in zip(light["place"], light["along"])]
    pose = Map().look_at(origin=light["place"], target=target, up=[0.3, 0.1, 1.0])
    return {"type": "spot", "to_world": pose, "intensity": power, "cutoff_angle": light["outer"], "beam_width": light["inner"]}


def draw(scene, folder, samples):
    camera, (width, height) = scene["camera"], scene["size"]
    described = {
        "type": "scene",
        "integrator": {"type": "direct"},
        "sensor": {
            "type": "perspective",
            "to_world": Map().look_at(origin=camera["position"], target=camera["target"], up=camera["up"]),
            "fov": camera["vertical_fov"],
            "fov_axis": "y",
            "near_clip": 0.01,
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "rfilter": {"type": "box"},
                "pixel_format": "rgba",
                "component_format": "float32",
            },
            "sampler": {"type": "stratified", "sample_count": samples},
        },
    }
    for number, one in enumerate(scene["objects"]):
        described[f"object{number}"] = {
            "type": "ply",
            "filename": str(folder / one["mesh"]),
            # PLY counts upwards, Mitsuba from the first row of an image.
            "flip_tex_coords": True,
            "bsdf": surface(one["surface"], folder),
        }
    for number, light in enumerate(scene["lights"]):
        described[f"light{number}"] = lamp(light)
    return numpy.array(mitsuba.render(mitsuba.load_dict(described)))


def inner(mask):
    """The pixels of a mask whose eight neighbours are in it, too."""
    kept = mask.copy()
    for axis in (0, 1):
        for step in (-1, 1):
            kept &= numpy.roll(kept, step, axis)
    kept[[0, -1], :] = kept[:, [0, -1]] = False
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--samples", type=int, default=1024)
    arguments = parser.parse_args()
    print(f"Mitsuba {mitsuba.__version__}, {arguments.samples} samples a pixel")
    print("| image | RMSE, % of the mean light | within surfaces | greatest within, % |")
    print("|---|--:|--:|--:|")
    for scene in json.loads((arguments.folder / "scenes.json").read_text()):
        truth = draw(scene, arguments.folder, arguments.samples)
        numpy.save(arguments.folder / f"{scene['name']}.truth.npy", truth)
        for image in scene["images"]:
            ours = numpy.load(arguments.folder / image["file"])
            covered = (truth[..., 3] > 0) | (ours[..., 3] > 0)
            whole = inner((truth[..., 3] > 0.9999) & (ours[..., 3] > 0.9999))
            difference = ours[..., :3] - truth[..., :3]
            mean = truth[covered][:, :3].mean()
            rms = lambda mask: 100 * math.sqrt((difference[mask] ** 2).mean()) / mean
            greatest = 100 * numpy.abs(difference[whole]).max() / mean
            print(f"| {image['name']} | {rms(covered):.3g} | {rms(whole):.3g} | {greatest:.3g} |")


if __name__ == "__main__":
    main()
