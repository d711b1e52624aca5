# SPDX-License-Identifier: Apache-2.0
"""An RGL tensor file of a few kilobytes, made from a formula: the smallest measurement that can be compressed."""
import math
import struct


def field(name, kind, shape, data):
    return name.encode(), kind, shape, data


def floats(values):
    return struct.pack(f"<{len(values)}f", *values)


def tensor_file(fields):
    """Bytes of a tensor file, version 1.0."""
    offset = 18 + sum(13 + len(name) + 8 * len(shape) for name, _, shape, _ in fields)
    head, body = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields)), b""
    for name, kind, shape, data in fields:
        head += struct.pack("<H", len(name)) + name + struct.pack("<HBQ", len(shape), kind, offset + len(body))
        head += struct.pack(f"<{len(shape)}Q", *shape)
        body += data
    return head + body


def small_rgl(elevations=4, size=8):
    """Isotropic, RGB: a rough highlight over a diffuse base, without the jacobian of the visible normals."""
    theta = [1.4 * i / (elevations - 1) for i in range(elevations)]
    rgb = []
    for t in range(elevations):
        for channel in range(3):
            for y in range(size):
                for x in range(size):
                    peak = math.exp(-4 * x / size) * (1 + 0.2 * math.cos(6.28 * y / size))
                    rgb.append((0.1 + 0.05 * channel + peak) * math.cos(0.8 * theta[t]))
    ones = [1.0] * (elevations * size * size)
    return tensor_file([
        field("description", 1, [6], b"a test"),
        field("phi_i", 10, [1], floats([0.0])),
        field("theta_i", 10, [elevations], floats(theta)),
        field("sigma", 10, [2, 2], floats([1.0] * 4)),
        field("ndf", 10, [2, 2], floats([1.0] * 4)),
        field("vndf", 10, [1, elevations, size, size], floats(ones)),
        field("rgb", 10, [1, elevations, 3, size, size], floats(rgb)),
        field("jacobian", 1, [1], b"\0"),
    ])
