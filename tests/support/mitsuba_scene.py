#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders in Mitsuba 3 what `brdf-render export` wrote. Needs the package mitsuba (PyPI), and nothing of this project.

usage: mitsuba_scene.py SCENE.json --spp N --seed S --threads T -o OUT.exr
       prints {"version", "seconds", "processor_seconds"}; loading is not timed
       mitsuba_scene.py compare OURS_1 OURS_2 THEIRS_1 THEIRS_2 [--block B]
       prints how much the means of blocks differ, over what the noise of the four pictures explains
       mitsuba_scene.py without-negatives IN.bsdf OUT.bsdf
       copies an RGL file with its negative values set to 0"""
import argparse
import json
import pathlib
import struct
import sys
import time

import drjit as dr
import mitsuba as mi
import numpy as np

VARIANT = "scalar_rgb"


def rgb(value):
    value = [value] * 3 if np.isscalar(value) else value
    return {"type": "rgb", "value": [float(v) for v in value]}


def material(slot, described):
    """Reflectors look the same from behind here; in Mitsuba they are black there unless told."""
    kind = described["type"]
    if kind == "dielectric":
        return {"type": "dielectric", "int_ior": described["ior"], "ext_ior": 1.0}
    if kind == "lambert":
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(described["albedo"])}}
    if kind == "file" and described["file"].endswith(".bsdf"):
        # `measured` takes the file's incident direction for the viewer's
        return {"type": "twosided", "bsdf": {"type": "measured", "filename": described["file"]}}
    sys.exit(f"materials.{slot}: Mitsuba has no such material")


def environment_picture(path):
    """Rows of an envmap lie on a grid that ends at the poles, ours have their middles half a row from there. A grid of half the
    step has both, and interpolation between its rows gives the same function."""
    picture = np.array(mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))
    edges = np.concatenate([picture[:1], 0.5 * (picture[1:] + picture[:-1]), picture[-1:]])
    rows = np.empty((2 * len(picture) + 1, *picture.shape[1:]), np.float32)
    rows[0::2], rows[1::2] = edges, picture
    return mi.Bitmap(rows)


def environment(described, folder):
    if described["type"] == "constant":
        return {"type": "constant", "radiance": rgb(described["radiance"])}
    # its first column looks along -z, as the middle of ours does; both turn towards +x
    to_world = mi.ScalarTransform4f().rotate([0, 1, 0], 180 - described["rotation"])
    return {"type": "envmap", "bitmap": environment_picture(folder / described["file"]), "to_world": to_world}


def shape(described, folder):
    result = {"bsdf": {"type": "ref", "id": "material-" + described["material"]}}
    if described["type"] == "sphere":
        return {**result, "type": "sphere", "center": described["centre"], "radius": described["radius"]}
    if "emission" in described:
        result["emitter"] = {"type": "area", "radiance": rgb(described["emission"])}
    return {**result, "type": "ply", "filename": str(folder / described["file"]), "face_normals": described["flat"]}


def scene(path, seed, spp):
    folder = path.parent
    described = json.loads(path.read_text(encoding="utf-8"))
    camera, film, limits = (described[key] for key in ("camera", "film", "path"))
    result = {
        "type": "scene",
        # depth counts edges there and vertices here
        "integrator": {"type": "path", "max_depth": limits["max_depth"] + 1, "rr_depth": limits["roulette_depth"]},
        "sensor": {
            "type": "perspective",
            "fov": camera["fov"],
            "fov_axis": "y",
            "near_clip": 1e-3,
            "far_clip": 1e5,
            "to_world": mi.ScalarTransform4f().look_at(camera["position"], camera["target"], camera["up"]),
            "film": {"type": "hdrfilm", "width": film["width"], "height": film["height"], "pixel_format": "rgb",
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": spp, "seed": seed},
        },
    }
    for slot, m in described["materials"].items():
        result["material-" + slot] = {**material(slot, m), "id": "material-" + slot}
    if "environment" in described:
        result["environment"] = environment(described["environment"], folder)
    for i, light in enumerate(described.get("lights", [])):
        result[f"light-{i}"] = {"type": "directional", "direction": light["direction"], "irradiance": rgb(light["irradiance"])}
    for i, s in enumerate(described["shapes"]):
        result[f"shape-{i}"] = shape(s, folder)
    return mi.load_dict(result)


def render(arguments):
    if arguments.threads < 2:
        sys.exit("--threads is less than 2: the main thread, which counts, would wait for ever")
    dr.set_thread_count(arguments.threads)
    loaded = scene(arguments.scene, arguments.seed, arguments.spp)
    wall, cpu = time.perf_counter(), time.process_time()
    picture = mi.render(loaded, spp=arguments.spp, seed=arguments.seed)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    mi.Bitmap(np.array(picture, dtype=np.float32)).write(str(arguments.output))
    return {"version": mi.__version__, "seconds": wall, "processor_seconds": cpu}


def compare(ours, theirs, block):
    """Two pictures of each side say how much noise their means have. In each block and channel the difference of the means, over
    its standard deviation, is then about normal: z."""
    difference = 0.5 * (ours[0] + ours[1]) - 0.5 * (theirs[0] + theirs[1])
    variance = 0.25 * ((ours[0] - ours[1]) ** 2 + (theirs[0] - theirs[1]) ** 2)
    mean = 0.25 * (ours[0] + ours[1] + theirs[0] + theirs[1])

    def blocks(picture):
        height, width = (side // block * block for side in picture.shape[:2])
        return picture[:height, :width].reshape(height // block, block, width // block, block, 3).mean(axis=(1, 3))

    level = np.maximum(blocks(mean), 1e-6)  # black is black on both sides
    # single precision, in what has no noise
    deviation = np.sqrt(blocks(variance) / block**2 + (1e-4 * level) ** 2)
    z = blocks(difference) / deviation
    worst = np.unravel_index(np.abs(z).argmax(), z.shape)
    whole = difference.mean() / np.sqrt(variance.mean() / variance.size)
    return {
        "blocks": int(z.size),
        "rms_z": float(np.sqrt((z**2).mean())),
        "max_z": float(np.abs(z).max()),
        "worst_block": [int(worst[1]), int(worst[0]), int(worst[2])],
        "worst_relative": float((blocks(difference) / level)[worst]),
        "whole_z": float(whole),
        "whole_relative": float(difference.mean() / mean.mean()),
        "median_noise_relative": float(np.median(deviation / level)),
        "most_noise_relative": float((deviation / level).max()),
    }


def read_picture(path):
    return np.array(mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)).astype(np.float64)


def without_negatives(source, target):
    """Of a tensor file (Dupuy and Jakob 2018, supplemental): a table of fields, each with name, shape, type and offset."""
    data = bytearray(pathlib.Path(source).read_bytes())
    fields, at = struct.unpack_from("<I", data, 14)[0], 18
    for _ in range(fields):
        length = struct.unpack_from("<H", data, at)[0]
        name = data[at + 2:at + 2 + length].decode()
        dimensions, kind, offset = struct.unpack_from("<HBQ", data, at + 2 + length)
        shape_of = struct.unpack_from(f"<{dimensions}Q", data, at + 13 + length)
        at += 13 + length + 8 * dimensions
        if name == "rgb":
            assert kind == 10, "float32"
            values = np.frombuffer(data, "<f4", int(np.prod(shape_of)), offset)
            np.maximum(values, 0, out=values)
    pathlib.Path(target).write_bytes(data)


def main():
    if sys.argv[1:2] == ["without-negatives"]:
        without_negatives(*sys.argv[2:4])
        return
    mi.set_variant(VARIANT)
    parser = argparse.ArgumentParser()
    if sys.argv[1:2] == ["compare"]:
        parser.add_argument("pictures", nargs=4)
        parser.add_argument("--block", type=int, default=16)
        arguments = parser.parse_args(sys.argv[2:])
        pictures = [read_picture(p) for p in arguments.pictures]
        result = compare(pictures[:2], pictures[2:], arguments.block)
    else:
        parser.add_argument("scene", type=pathlib.Path)
        parser.add_argument("--spp", type=int, default=64)
        parser.add_argument("--seed", type=int, default=0)
        parser.add_argument("--threads", type=int, default=2)
        parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
        result = render(parser.parse_args())
    print(json.dumps(result))


if __name__ == "__main__":
    main()
