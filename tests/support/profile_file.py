# SPDX-License-Identifier: Apache-2.0
"""A second reader and writer of profile files, made from docs/profile_format.md alone."""
import math
import struct

from support.brdfc_coding import xxh32

AXES = (48, 24, 12, 16, 18)
THETA_H, THETA_D, PHI_D, PHI_H, THETA = AXES
UNITS = 2 ** 28
PIXEL_UNITS = 2 ** 24
OPERATIONS = ("eval", "sample", "pdf", "transmission")


class BadProfile(Exception):
    """The file is no profile."""


def require(condition, sentence):
    if not condition:
        raise BadProfile(sentence)


def number(value):
    out = bytearray()
    while value >= 0x80:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(out + bytes([value]))


def chord(theta):
    return math.sqrt(2) * math.sin(theta / 2)


def cell_of(wi, wo):
    """Index of the cell of two unit vectors above the horizon."""
    s, d = [a + b for a, b in zip(wi, wo)], [a - b for a, b in zip(wi, wo)]
    theta_h = math.atan2(math.hypot(s[0], s[1]), s[2])
    theta_d = math.atan2(math.hypot(*d), math.hypot(*s))
    scale = 2 * math.sin(theta_h) * math.sin(theta_d)
    phi = math.acos(max(-1, min(1, (wo[2] - wi[2]) / scale))) if scale > 1e-9 else math.pi / 2
    u = math.sin(phi / 2) / math.sqrt(2) if phi <= math.pi / 2 else 1 - math.sin((math.pi - phi) / 2) / math.sqrt(2)
    h, d, p = (min(int(n * x), n - 1) for n, x in ((THETA_H, math.sqrt(chord(theta_h))), (THETA_D, chord(theta_d)), (PHI_D, u)))
    return p + PHI_D * (d + THETA_D * h)


class Material:
    """What was asked of one slot; sums in units."""

    def __init__(self):
        self.operations = [0] * 4
        self.first_hits = self.footprint = self.transmitted = self.contributions = 0
        self.phi_h, self.theta_i, self.theta_o = [0] * PHI_H, [0] * THETA, [0] * THETA
        self.ranges = None
        self.cells = {}

    def add(self, wi, wo, contribution, operation="eval"):
        self.operations[OPERATIONS.index(operation)] += 1
        units = int(contribution * UNITS + 0.5)
        if units == 0:
            return
        self.contributions += 1
        cell = cell_of(wi, wo)
        self.cells[cell] = self.cells.get(cell, 0) + units
        turn = math.atan2(wi[1] + wo[1], wi[0] + wo[0]) / (2 * math.pi) % 1
        self.phi_h[min(int(turn * PHI_H), PHI_H - 1)] += units
        angles = [math.acos(min(w[2], 1)) for w in (wi, wo)]
        for marginal, theta in zip((self.theta_i, self.theta_o), angles):
            marginal[min(int(theta / (math.pi / 2) * THETA), THETA - 1)] += units
        old = self.ranges or (angles[0], angles[0], angles[1], angles[1])
        self.ranges = (min(old[0], angles[0]), max(old[1], angles[0]), min(old[2], angles[1]), max(old[3], angles[1]))

    def write(self):
        sums = [*self.operations, self.first_hits, self.footprint, self.transmitted, self.contributions,
                *self.phi_h, *self.theta_i, *self.theta_o, len(self.cells)]
        out = b"".join(map(number, sums))
        if self.cells:
            out += struct.pack("<4f", *self.ranges)
        following = 0
        for cell in sorted(self.cells):
            out += number(cell - following) + number(self.cells[cell])
            following = cell + 1
        return out


def write_profile(materials):
    """Bytes of a file; `materials` maps names to Material."""
    out = b"BRPF" + bytes([1, *AXES]) + number(len(materials))
    for name in sorted(materials, key=lambda n: n.encode()):
        out += number(len(name.encode())) + name.encode() + materials[name].write()
    return out + struct.pack("<I", xxh32(out, 0))


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        require(self.at + count <= len(self.data), "the file ends too early")
        self.at += count
        return self.data[self.at - count:self.at]

    def number(self):
        value = shift = 0
        while True:
            byte = self.take(1)[0]
            value |= (byte & 0x7F) << shift
            require(value < 2 ** 64 and shift < 70, "a number is too large")
            if not byte & 0x80:
                require(byte or not shift, "a number is not in its shortest form")
                return value
            shift += 7

    def numbers(self, count):
        return [self.number() for _ in range(count)]

    def material(self):
        m = Material()
        m.operations = self.numbers(4)
        m.first_hits, m.footprint, m.transmitted, m.contributions = self.numbers(4)
        m.phi_h, m.theta_i, m.theta_o = self.numbers(PHI_H), self.numbers(THETA), self.numbers(THETA)
        count = self.number()
        if count:
            m.ranges = struct.unpack("<4f", self.take(16))
        following = 0
        for _ in range(count):
            cell = following + self.number()
            require(cell < THETA_H * THETA_D * PHI_D, "a cell lies beyond the last one")
            m.cells[cell] = self.number()
            require(m.cells[cell], "a cell is 0")
            following = cell + 1
        return m


def read_profile(data):
    """Material by name. Raises BadProfile."""
    require(data[:5] == b"BRPF\x01" and len(data) > 14, "not a profile of version 1")
    require(struct.unpack("<I", data[-4:])[0] == xxh32(data[:-4], 0), "the checksum does not match")
    r = Reader(data[:-4])
    r.take(5)
    require(tuple(r.take(5)) == AXES, "other axes")
    materials = {}
    for _ in range(r.number()):
        name = r.take(r.number()).decode()
        require(not materials or max(materials, key=str.encode).encode() < name.encode(), "the names do not ascend")
        materials[name] = r.material()
    require(r.at == len(r.data), "something follows")
    return materials
