#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the authors' own programs say of the pictures of tests/image/metric_pictures.h, as JSON: the golden values of
tests/image/metrics_test.cpp. Needs flip-evaluator from PyPI, and for PSNR and SSIM scikit-image:

    python3 -m venv VENV && VENV/bin/pip install flip-evaluator scikit-image && VENV/bin/python tests/support/metric_pictures.py
"""
import json
import math
import struct

WIDTH, HEIGHT = 96, 64


def smooth(x, y):
    """Stripes, a step, a dark corner and a highlight of radiance 40: linear radiance."""
    u, v = x / WIDTH, y / HEIGHT
    wave = 0.5 + 0.5 * math.sin(0.9 * x * u + 3 * v)
    level = 0.6 if u + v > 1 else 0.08
    highlight = 40 * math.exp(-((x - 70) ** 2 + (y - 20) ** 2) / 8)
    return [level * (0.2 + wave) + highlight, level * (0.5 + 0.5 * v) + highlight, level * (1 - 0.8 * u * wave) + 0.5 * highlight]


def pictures():
    """Reference and candidate as lists of rows of pixels."""
    reference, candidate = [], []
    state = 1
    for y in range(HEIGHT):
        reference.append([smooth(x, y) for x in range(WIDTH)])
        row = []
        for x in range(WIDTH):
            moved = smooth(x + 0.4, y)
            for c in range(3):
                state = (state * 1664525 + 1013904223) % 2**32
                noise = state / 2**32 - 0.5
                moved[c] = max(0.0, moved[c] * (0.9 + 0.05 * c + 0.2 * noise) + 0.01 * noise)
            row.append(moved)
        candidate.append(row)
    return reference, candidate


def exr_bytes(rows):
    """An uncompressed OpenEXR file of 32-bit floats (openexr.com, "OpenEXR File Layout")."""
    height, width = len(rows), len(rows[0])
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    attributes = [(b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"), (b"dataWindow", b"box2i", window),
                  (b"displayWindow", b"box2i", window), (b"lineOrder", b"lineOrder", b"\0"),
                  (b"pixelAspectRatio", b"float", struct.pack("<f", 1)), (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
                  (b"screenWindowWidth", b"float", struct.pack("<f", 1))]
    head = struct.pack("<2i", 20000630, 2)
    head += b"".join(name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value for name, kind, value in attributes) + b"\0"
    lines = [struct.pack("<2i", y, 12 * width) + b"".join(struct.pack(f"<{width}f", *(pixel[c] for pixel in row)) for c in (2, 1, 0))
             for y, row in enumerate(rows)]
    first = len(head) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * len(lines[0])) for y in range(height))
    return head + offsets + b"".join(lines)


def main():
    import flip_evaluator
    import numpy

    reference, candidate = (numpy.array(p, dtype=numpy.float32) for p in pictures())
    found = {}
    clipped = [numpy.clip(p, 0, 1) for p in (reference, candidate)]
    ldr, found["flip"], _ = flip_evaluator.evaluate(*clipped, "LDR", inputsRGB=False, applyMagma=False)
    found.update({"flip_max": ldr.max(), "flip_70_20": ldr[20, 70, 0], "flip_10_5": ldr[5, 10, 0]})
    _, found["flip_30_per_degree"], _ = flip_evaluator.evaluate(*clipped, "LDR", inputsRGB=False, applyMagma=False,
                                                                parameters={"ppd": 30.0})
    hdr, found["hdr_flip"], used = flip_evaluator.evaluate(reference, candidate, "HDR", applyMagma=False)
    found.update({"hdr_flip_max": hdr.max(), "hdr_flip_10_5": hdr[5, 10, 0], "start_exposure": used["startExposure"],
                  "stop_exposure": used["stopExposure"], "exposures": used["numExposures"]})
    try:
        import skimage.metrics
    except ImportError:
        pass
    else:
        x = [p.astype(numpy.float64) for p in clipped]
        r, c = (numpy.where(p <= 0.0031308, 12.92 * p, 1.055 * p ** (1 / 2.4) - 0.055) for p in x)
        weights = numpy.array([0.2126, 0.7152, 0.0722])
        found["psnr"] = skimage.metrics.peak_signal_noise_ratio(r, c, data_range=1)
        found["ssim"] = skimage.metrics.structural_similarity(r @ weights, c @ weights, gaussian_weights=True, sigma=1.5,
                                                              use_sample_covariance=False, data_range=1)
    print(json.dumps({name: float(value) for name, value in found.items()}, indent=2))


if __name__ == "__main__":
    main()
