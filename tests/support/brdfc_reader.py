#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A second reader of .brdfc files, written from docs/format.md alone and made to be read, not to be fast.

It evaluates the residual as the formula that it is, without a grid; one in slices also as libbrdf resamples it for its balanced level. Usage,
in the folder tests:
  python3 -m support.brdfc_reader FILE [REFINEMENTS] < rows of wi.xyz wo.xyz > rows of f
"""
import math
import struct
import sys

from support.brdfc_coding import (Bits, Bytes, CoefficientDecoder, FormatError, RangeDecoder, coefficient_order,
                                  require, xxh32)
from support.brdfc_analytic import AnalyticModel
from support.brdfc_lobes import ggx, half_difference, read_coded_lobes, read_packed_lobes
from support.brdfc_slices import ResampledGrid, SliceFrame, SliceTable

__all__ = ["Brdfc", "FormatError", "xxh32"]
BALANCED = (56, 28, 25), (48, 40, 21), (72, 32, 17), (32, 44, 29)


def channel_matrix(transform, n):
    if transform == 1 and n == 3:
        rows = (1, 1, 1), (1, 0, -1), (1, -2, 1)
        return [[v / math.sqrt(sum(x * x for x in row)) for v in row] for row in rows]
    if transform == 2:
        return [[math.sqrt((1 if t == 0 else 2) / n) * math.cos(math.pi * t * (c + 0.5) / n) for c in range(n)]
                for t in range(n)]
    return [[float(t == c) for c in range(n)] for t in range(n)]


class Brdfc:
    """A file, read up to `refinements` (all when None). `prefix` allows it to be cut at a boundary."""
    def __init__(self, data, refinements=None, prefix=False):
        self.lobes, self.layers, self.errors, self.order = None, [], [], []
        self.model = None
        self.table = self.grid = None
        self.read_header(data)
        require(len(data) <= self.total, "the file is longer than its header says")
        require(prefix or len(data) == self.total, "the file is cut")
        at, seed = self.header_bytes, self.header_checksum
        for code, length in self.directory:
            if at == len(data) and self.lobes is not None:
                break
            payload = data[at:at + length]
            require(at + length + 4 <= len(data), "the file ends within a chunk")
            seed = xxh32(payload, seed)
            require(seed == struct.unpack_from("<I", data, at + length)[0], "a chunk's checksum does not match")
            at += length + 4
            self.read_chunk(code, payload)
        require(self.lobes is not None, "there is no lobes chunk")
        self.layers = self.layers[:refinements]
        self.coefficients = self.add_layers()

    def read_header(self, data):
        r = Bytes(data)
        require(data[:4] == b"BRFC", "not a .brdfc file")
        r.take(4)
        require(r.u8() == 1, "not version 1")
        require(r.u8() == 0, "reserved flags are set")
        self.total = r.varint()
        require(r.varint() == 1, "more than one component")
        first, second = r.u8(), r.u8()
        self.axes = first >> 2 & 7
        self.mirror, self.reciprocal = bool(first & 0x20), bool(first & 0x40)
        require(first & 0x83 == 0 and self.axes < 2 and (self.mirror or self.reciprocal) and second & 0xE0 == 0,
                "the component is of a later version")
        require(not (self.axes and self.reciprocal), "slices cannot be reciprocal")
        self.channel_model, self.transform, self.channels = second & 3, second >> 2 & 7, r.varint()
        require(self.transform < 3, "unknown channel transform")
        require(self.channels == {0: 3, 1: 3, 3: 1}.get(self.channel_model, self.channels) > 0, "wrong number of channels")
        self.wavelengths = []
        if self.channel_model == 2:
            require(r.u8() == 1, "unknown form of wavelengths")
            self.wavelengths = list(struct.unpack(f"<{self.channels}f", r.take(4 * self.channels)))
        self.directory = [(r.u8(), r.varint()) for _ in range(r.varint())]
        self.header_checksum = xxh32(data[:r.at], 0)
        require(struct.unpack("<I", r.take(4))[0] == self.header_checksum, "the header's checksum does not match")
        self.header_bytes = r.at
        require(self.total == r.at + sum(length + 4 for _, length in self.directory), "the total is not the sum")

    def read_chunk(self, code, payload):
        if code in (1, 4):
            require(self.lobes is None, "a second lobes chunk")
            self.read_errors(0, ["fast"], payload)
            read = read_packed_lobes if code == 1 else read_coded_lobes
            self.lobes = read(payload[2:], self.channels)
        elif code == 5:
            require(self.lobes is None, "a second lobes or analytic chunk")
            self.lobes, self.model = [], AnalyticModel(payload, self.channels)
            require(self.axes == 0 and self.transform == 0 and self.mirror and self.reciprocal == self.model.reciprocal,
                    "the component does not fit its model")
        elif code == 2:
            require(self.lobes is not None and not self.layers and self.model is None, "the residual is in the wrong place")
            self.read_errors(1, ["balanced", "exact"], payload)
            self.read_layer(self.read_basis(payload[4:]))
        elif code == 3:
            require(self.layers, "a refinement without a residual")
            self.read_errors(len(self.layers) + 1, ["balanced", "exact"], payload)
            self.read_layer(payload[4:])
        elif code == 0x89:
            self.read_provenance(payload)
        elif code == 0x8A:
            require(self.model is None, "sampling tables of an analytic model")
        else:
            require(code & 0x80, f"unknown critical chunk {code}")

    def read_errors(self, refinement, levels, payload):
        require(len(payload) >= 2 * len(levels), "a chunk ends within its errors")
        for i, level in enumerate(levels):
            log_mae, psnr = payload[2 * i:2 * i + 2]
            self.errors.append((refinement, level, 2 ** ((log_mae - 240) / 8) if log_mae else 0.0, psnr / 4))

    def read_basis(self, data):
        bits = Bits(data)
        self.kappa_h = 0.003 * 2 ** (bits.get(5) / 3)
        self.kappa_d = 0.125 * 2 ** (bits.get(4) / 2)
        self.window_h = 0.02 * 2 ** (bits.get(4) / 2.5)
        self.window_d = 0.02 * 2 ** (bits.get(4) / 2.5)
        epsilon = bits.get(8)
        require(epsilon <= 227, "epsilon is too large")
        self.epsilon = 2.0 ** (epsilon - 128)
        shape, count = bits.get(3), bits.get(15)
        require(count <= 16384, "too many coefficients")
        self.balanced = BALANCED[bits.get(2)]
        require(bits.get(3) == 0, "reserved bits of the basis are set")
        rest, reach = bits.rest(), (64, 32, 24)
        if self.axes == 1:
            self.frame = SliceFrame(rest)
            rest, reach = self.frame.rest, self.frame.reach()
        self.order = coefficient_order(shape, self.reciprocal and self.mirror, count, reach)
        self.decoder = CoefficientDecoder(self.reciprocal and self.mirror)
        return rest

    def read_layer(self, data):
        coder = RangeDecoder(data)
        step, restart = 2 ** (4 - coder.raw(8) / 8), coder.raw(1)
        if restart:
            self.decoder.known.clear()
        begin = [0] * self.channels if restart or not self.layers else self.layers[-1][1]
        end = [b + coder.count() for b in begin]
        require(max(end) <= len(self.order), "a layer goes beyond the declared count")
        values = []
        for j in range(min(begin), max(end)):
            for c in range(self.channels):
                if begin[c] <= j < end[c]:
                    q = self.decoder.decode(coder, c, j, self.order[j])
                    values.append((c, j, q * step))
        coder.finish()
        self.layers.append((values, end))

    def read_provenance(self, payload):
        r = Bytes(payload)
        names = "name", "format", "description", "licence", "fitter"
        self.provenance = {name: r.take(r.varint()).decode("utf-8", "replace") for name in names}
        self.provenance["content_hash"] = struct.unpack("<Q", r.take(8))[0]
        self.provenance["file_bytes"] = r.varint()

    def add_layers(self):
        """{place: coefficient of each channel}, the channel transform undone."""
        stored = {}
        for values, _ in self.layers:
            for c, j, value in values:
                stored.setdefault(j, [0.0] * self.channels)[c] += value
        n, matrix = self.channels, channel_matrix(self.transform, self.channels)
        return {j: [sum(matrix[t][c] * b[t] for t in range(n)) for c in range(n)]
                for j, b in stored.items() if any(b)}

    def lobe_sum(self, wi, wo):
        f = [0.0] * self.channels
        for kind, alpha, f90, color in self.lobes:
            lobe = [rho / math.pi for rho in color] if kind == 0 else ggx(kind, alpha, f90, color, wi, wo)
            f = [a + b for a, b in zip(f, lobe)]
        return f

    def eval(self, wi, wo):
        """f in 1/sr, without the cosine."""
        n = self.channels
        if wi[2] <= 0 or wo[2] <= 0:
            return [0.0] * n
        if self.model is not None:
            return self.model.eval(wi, wo)
        if not self.has_residual():
            return self.lobe_sum(wi, wo)
        if self.axes == 1:
            return self.slice_table().eval(wi, wo)
        theta_h, theta_d, cos_phi = half_difference(wi, wo)
        u_h, u_d, _ = self.coordinates(wi, wo)
        phi = math.acos(cos_phi)
        if (wi[0] + wo[0]) * (wi[1] - wo[1]) < (wi[1] + wo[1]) * (wi[0] - wo[0]):
            phi = -phi
        window = (math.sin(theta_h) / math.hypot(math.sin(theta_h), self.window_h)
                  * math.sin(theta_d) / math.hypot(math.sin(theta_d), self.window_d))
        r = [0.0] * n
        for j, a in self.coefficients.items():
            k, l, m = self.order[j]
            value = math.cos(math.pi * k * u_h) * math.cos(math.pi * l * u_d) * self.azimuth(m, phi, window)
            r = [x + y * value for x, y in zip(r, a)]
        return self.with_ratio(wi, wo, [math.exp(min(max(y, -9.7), 10.39)) for y in r])

    def azimuth(self, m, phi, window):
        if m % 2 and self.reciprocal:
            return math.sin((m + 1) * phi) * window ** (m + 1)
        return math.cos(m * phi) * window ** m

    def eval_resampled(self, wi, wo):
        """f as libbrdf has it at level "balanced"; of files with axes 1."""
        require(self.axes == 1, "the residual is not in slices")
        if wi[2] <= 0 or wo[2] <= 0 or not self.has_residual():
            return self.eval(wi, wo)
        if self.grid is None:
            self.grid = ResampledGrid(self.balanced, self.kappa_h, self.kappa_d, self.epsilon, self.slice_table(), self.lobe_sum)
        return self.with_ratio(wi, wo, self.grid.ratio(self.coordinates(wi, wo)))

    def has_residual(self):
        """Whether a layer has a place in any channel."""
        return any(max(end) > 0 for _, end in self.layers)

    def slice_table(self):
        if self.table is None:
            self.table = SliceTable(self.frame, {self.order[j]: a for j, a in self.coefficients.items()}, self.channels)
        return self.table

    def with_ratio(self, wi, wo, ratio):
        return [max(0.0, (x + self.epsilon) * r - self.epsilon) for x, r in zip(self.lobe_sum(wi, wo), ratio)]

    def coordinates(self, wi, wo):
        """u_h, u_d, u_p."""
        theta_h, theta_d, cos_phi = half_difference(wi, wo)

        def axis(theta, kappa):
            t = math.sqrt(2) * math.sin(theta / 2)
            return t * (0.6 * (1 + kappa) / (t + kappa) + 0.4)

        u_p = math.sqrt(1 - cos_phi) / 2 if cos_phi >= 0 else 1 - math.sqrt(1 + cos_phi) / 2
        return axis(theta_h, self.kappa_h), axis(theta_d, self.kappa_d), u_p


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as file:
        material = Brdfc(file.read(), int(sys.argv[2]) if len(sys.argv) > 2 else None)
    for line in sys.stdin:
        x = [float(v) for v in line.replace(",", " ").split()]
        print(",".join(f"{v:.9g}" for v in material.eval(x[:3], x[3:])))
