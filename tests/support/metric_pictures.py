#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints what the authors' own programs say of the pictures of tests/image/metric_pictures.h: the golden values of
tests/image/metrics_test.cpp. Needs flip-evaluator and scikit-image from PyPI:

    python3 -m venv VENV && VENV/bin/pip install flip-evaluator scikit-image && VENV/bin/python tests/support/metric_pictures.py
"""
import math

import flip_evaluator
import numpy
import skimage.metrics

WIDTH, HEIGHT = 96, 64


def smooth(x, y):
    """Stripes, a step, a dark corner and a highlight of radiance 40: linear radiance."""
    u, v = x / WIDTH, y / HEIGHT
    wave = 0.5 + 0.5 * math.sin(0.9 * x * u + 3 * v)
    level = 0.6 if u + v > 1 else 0.08
    highlight = 40 * math.exp(-((x - 70) ** 2 + (y - 20) ** 2) / 8)
    return [level * (0.2 + wave) + highlight, level * (0.5 + 0.5 * v) + highlight, level * (1 - 0.8 * u * wave) + 0.5 * highlight]


def pictures():
    reference = numpy.zeros((HEIGHT, WIDTH, 3))
    candidate = numpy.zeros((HEIGHT, WIDTH, 3))
    state = 1
    for y in range(HEIGHT):
        for x in range(WIDTH):
            reference[y, x] = smooth(x, y)
            moved = smooth(x + 0.4, y)
            for c in range(3):
                state = (state * 1664525 + 1013904223) % 2**32
                noise = state / 2**32 - 0.5
                candidate[y, x, c] = max(0.0, moved[c] * (0.9 + 0.05 * c + 0.2 * noise) + 0.01 * noise)
    return reference.astype(numpy.float32), candidate.astype(numpy.float32)


def encoded(linear):
    x = numpy.clip(linear.astype(numpy.float64), 0, 1)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def main():
    reference, candidate = pictures()
    r, c = encoded(reference), encoded(candidate)
    weights = numpy.array([0.2126, 0.7152, 0.0722])
    print("psnr", skimage.metrics.peak_signal_noise_ratio(r, c, data_range=1))
    print("ssim", skimage.metrics.structural_similarity(r @ weights, c @ weights, gaussian_weights=True, sigma=1.5,
                                                         use_sample_covariance=False, data_range=1))
    clipped = [numpy.clip(p, 0, 1).astype(numpy.float32) for p in (reference, candidate)]
    ldr, ldr_mean, _ = flip_evaluator.evaluate(*clipped, "LDR", inputsRGB=False, applyMagma=False)
    print("flip", ldr_mean, "max", float(ldr.max()), "at (70, 20)", float(ldr[20, 70, 0]), "at (10, 5)", float(ldr[5, 10, 0]))
    _, wide_mean, _ = flip_evaluator.evaluate(*clipped, "LDR", inputsRGB=False, applyMagma=False, parameters={"ppd": 30.0})
    print("flip at 30 pixels per degree", wide_mean)
    hdr, hdr_mean, used = flip_evaluator.evaluate(reference, candidate, "HDR", applyMagma=False)
    print("hdr-flip", hdr_mean, "max", float(hdr.max()), "at (10, 5)", float(hdr[5, 10, 0]), used)


if __name__ == "__main__":
    main()
