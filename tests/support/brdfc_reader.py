#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A second reader of .brdfc files, written from docs/format.md alone and made to be read, not to be fast.

It evaluates the residual as the formula that it is, without a grid. Usage:
  brdfc_reader.py FILE [REFINEMENTS] < rows of wi.xyz wo.xyz > rows of f
"""
import math
import struct
import sys

RATES = [18725, 14564, 11916, 10082, 8738, 7710, 6899, 6242, 5699, 5243, 4855, 4520, 4228, 3972, 3745, 3542]
SHAPES = [(10, 17, 24), (8, 20, 30), (6, 20, 30), (14, 14, 22), (10, 20, 17), (8, 12, 40), (5, 30, 40), (14, 20, 14)]
MASK = 0xFFFFFFFF


class FormatError(Exception):
    """The file contradicts docs/format.md or needs a later version of it."""


def require(condition, sentence):
    if not condition:
        raise FormatError(sentence)


def xxh32(data, seed):
    p1, p2, p3, p4, p5 = 2654435761, 2246822519, 3266489917, 668265263, 374761393

    def rotate(x, r):
        return (x << r | x >> (32 - r)) & MASK

    at = 0
    if len(data) >= 16:
        lanes = [(seed + p1 + p2) & MASK, (seed + p2) & MASK, seed & MASK, (seed - p1) & MASK]
        while at + 16 <= len(data):
            for i, word in enumerate(struct.unpack_from("<4I", data, at)):
                lanes[i] = rotate((lanes[i] + word * p2) & MASK, 13) * p1 & MASK
            at += 16
        h = sum(rotate(v, r) for v, r in zip(lanes, (1, 7, 12, 18)))
    else:
        h = seed + p5
    h = (h + len(data)) & MASK
    while at + 4 <= len(data):
        h = rotate((h + struct.unpack_from("<I", data, at)[0] * p3) & MASK, 17) * p4 & MASK
        at += 4
    for byte in data[at:]:
        h = rotate((h + byte * p5) & MASK, 11) * p1 & MASK
    h = (h ^ h >> 15) * p2 & MASK
    h = (h ^ h >> 13) * p3 & MASK
    return h ^ h >> 16


class Bytes:
    """Reads forward."""
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, n):
        require(self.at + n <= len(self.data), "the data end too early")
        self.at += n
        return self.data[self.at - n:self.at]

    def u8(self):
        return self.take(1)[0]

    def varint(self):
        value = 0
        for i in range(8):
            byte = self.u8()
            value |= (byte & 127) << 7 * i
            if byte < 128:
                require(byte > 0 or i == 0, "a varint is not in its shortest form")
                return value
        raise FormatError("a varint has more than 8 bytes")


class Bits:
    """Most significant first."""
    def __init__(self, data):
        self.data, self.at = data, 0

    def get(self, n):
        require(self.at + n <= 8 * len(self.data), "the bits end too early")
        value = 0
        for _ in range(n):
            value = value << 1 | self.data[self.at // 8] >> (7 - self.at % 8) & 1
            self.at += 1
        return value

    def rest(self):
        while self.at % 8:
            require(self.get(1) == 0, "padding bits are not 0")
        return self.data[self.at // 8:]


class AdaptiveBit:
    def __init__(self, p):
        self.p, self.n = p, 0

    def update(self, bit):
        rate = RATES[self.n] if self.n < 16 else 65536 // (self.n + 3)
        change = ((65208 if bit else 327) - self.p) * rate
        self.p += change // 65536 if change >= 0 else -(-change // 65536)
        self.n = min(self.n + 1, 40)


class RangeDecoder:
    def __init__(self, data):
        self.data, self.at, self.range, self.code = data, 0, MASK, 0
        for _ in range(4):
            self.code = self.code << 8 | self.next()

    def next(self):
        self.at += 1
        return self.data[self.at - 1] if self.at <= len(self.data) else 0

    def renew(self):
        while self.range < 1 << 24:
            self.range <<= 8
            self.code = (self.code << 8 | self.next()) & MASK

    def raw(self, n):
        value = 0
        for _ in range(n):
            self.range >>= 1
            bit = int(self.code >= self.range)
            if bit:
                self.code -= self.range
            self.renew()
            value = value << 1 | bit
        return value

    def bit(self, model):
        bound = self.range * model.p >> 16
        bit = self.code < bound
        if bit:
            self.range = bound
        else:
            self.code -= bound
            self.range -= bound
        model.update(bit)
        self.renew()
        return bit

    def count(self):
        width = self.raw(4)
        return 0 if width == 0 else 1 << (width - 1) | self.raw(width - 1)


def coefficient_order(shape, reciprocal, count):
    a, b, c = SHAPES[shape]
    places = [(a * k + b * l + c * m, m, l, k)
              for m in range(0, 24, 2 if reciprocal else 1) for l in range(32) for k in range(64)]
    return [(k, l, m) for _, m, l, k in sorted(places)[:count]]


class CoefficientDecoder:
    """The contexts and their adaptive bits; one object for all layers."""
    def __init__(self, reciprocal):
        z = (5, 20, 30, 40, 50, 60, 70, 85)
        self.nonzero = [[[AdaptiveBit(65536 * z[a] * (10 - b) // 1000) for b in range(6)] for a in range(8)]
                        for _ in range(2)]
        self.more = [[AdaptiveBit(65536 * (30 + 10 * a) // 100) for _ in range(5)] for a in range(4)]
        self.reciprocal, self.known = reciprocal, {}

    def decode(self, coder, channel, place, frequency):
        k, l, m = frequency

        def g(c, k, l, m):
            return self.known.get((c, k, l, m), 0)

        c = channel
        v = 2 * g(c, k - 1, l, m) + g(c, k - 2, l, m) + 2 * g(c, k, l - 1, m) + g(c, k, l - 2, m)
        v += g(c, k - 1, l - 1, m) + g(c, k, l, m - 2) + (g(c, k, l, m - 2) if self.reciprocal else g(c, k, l, m - 1))
        v += 2 * g(0, k, l, m) if c > 0 else 0
        v += g(c - 1, k, l, m) if c > 1 else 0
        a = v if v < 4 else 4 if v < 6 else 5 if v < 9 else 6 if v < 14 else 7
        b = 0 if a >= 4 else sum(place >= bound for bound in (6, 12, 24, 48, 96))
        if not coder.bit(self.nonzero[int(c == 0)][a][b]):
            return 0
        negative = coder.raw(1)
        n = 1
        while n < 15 and coder.bit(self.more[a >> 1][min(n, 5) - 1]):
            n += 1
        if n == 15:
            e = 0
            while e < 21 and coder.raw(1):
                e += 1
            n += (1 << e) + coder.raw(e) - 1
        self.known[c, k, l, m] = min(n, 255)
        return -n if negative else n


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
        require(first & 0x9F == 0 and first & 0x20 and second & 0xE0 == 0, "the component is of a later version")
        self.reciprocal = bool(first & 0x40)
        self.model, self.transform, self.channels = second & 3, second >> 2 & 7, r.varint()
        require(self.transform < 3, "unknown channel transform")
        require(self.channels == {0: 3, 1: 3, 3: 1}.get(self.model, self.channels) > 0, "wrong number of channels")
        self.wavelengths = []
        if self.model == 2:
            require(r.u8() == 1, "unknown form of wavelengths")
            self.wavelengths = list(struct.unpack(f"<{self.channels}f", r.take(4 * self.channels)))
        self.directory = [(r.u8(), r.varint()) for _ in range(r.varint())]
        self.header_checksum = xxh32(data[:r.at], 0)
        require(struct.unpack("<I", r.take(4))[0] == self.header_checksum, "the header's checksum does not match")
        self.header_bytes = r.at
        require(self.total == r.at + sum(length + 4 for _, length in self.directory), "the total is not the sum")

    def read_chunk(self, code, payload):
        if code == 1:
            require(self.lobes is None, "a second lobes chunk")
            self.read_errors(0, ["fast"], payload)
            self.read_lobes(payload[2:])
        elif code == 2:
            require(self.lobes is not None and not self.layers, "the residual is in the wrong place")
            self.read_errors(1, ["balanced", "exact"], payload)
            self.read_layer(self.read_basis(payload[4:]))
        elif code == 3:
            require(self.layers, "a refinement without a residual")
            self.read_errors(len(self.layers) + 1, ["balanced", "exact"], payload)
            self.read_layer(payload[4:])
        elif code == 0x89:
            self.read_provenance(payload)
        else:
            require(code & 0x80, f"unknown critical chunk {code}")

    def read_errors(self, refinement, levels, payload):
        require(len(payload) >= 2 * len(levels), "a chunk ends within its errors")
        for i, level in enumerate(levels):
            log_mae, psnr = payload[2 * i:2 * i + 2]
            self.errors.append((refinement, level, 2 ** ((log_mae - 240) / 8) if log_mae else 0.0, psnr / 4))

    def read_lobes(self, data):
        bits = Bits(data)
        count, exponent = bits.get(4), bits.get(8) - 128
        require(exponent <= 99, "the lobes are too large")

        def amplitude():
            code = bits.get(11)
            return 2 ** (exponent - (2047 - code) / 128) if code else 0.0

        self.lobes = []
        for _ in range(count):
            kind, alpha, f90 = bits.get(3), 1.0, 1.0
            require(kind <= 2, "unknown lobe kind")
            if kind:
                alpha = 2 ** (-16.6096404744368 * bits.get(11) / 2047)
                f90 = amplitude()
            self.lobes.append((kind, alpha, f90, [amplitude() for _ in range(self.channels)]))
        require(not bits.rest(), "bytes are left after the lobes")

    def read_basis(self, data):
        bits = Bits(data)
        self.kappa_h = 0.003 * 2 ** (bits.get(5) / 3)
        self.kappa_d = 0.125 * 2 ** (bits.get(4) / 2)
        self.window_h = 0.02 * 2 ** (bits.get(4) / 2.5)
        self.window_d = 0.02 * 2 ** (bits.get(4) / 2.5)
        epsilon = bits.get(8)
        require(epsilon <= 227, "epsilon is too large")
        self.epsilon = 2.0 ** (epsilon - 128)
        shape, self.count = bits.get(3), bits.get(15)
        require(self.count <= 16384, "too many coefficients")
        require(bits.get(5) == 0, "reserved bits of the basis are set")
        self.order = coefficient_order(shape, self.reciprocal, self.count)
        self.decoder = CoefficientDecoder(self.reciprocal)
        return bits.rest()

    def read_layer(self, data):
        coder = RangeDecoder(data)
        step, restart = 2 ** (4 - coder.raw(8) / 8), coder.raw(1)
        if restart:
            self.decoder.known.clear()
        begin = [0] * self.channels if restart or not self.layers else self.layers[-1][1]
        end = [b + coder.count() for b in begin]
        require(max(end) <= self.count, "a layer goes beyond the declared count")
        values = []
        for j in range(min(begin), max(end)):
            for c in range(self.channels):
                if begin[c] <= j < end[c]:
                    q = self.decoder.decode(coder, c, j, self.order[j])
                    values.append((c, j, q * step))
        require(coder.at - len(data) <= 4, "a layer goes on beyond its end")
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

    def eval(self, wi, wo):
        """f in 1/sr, without the cosine."""
        n = self.channels
        if wi[2] <= 0 or wo[2] <= 0:
            return [0.0] * n
        f = [0.0] * n
        for kind, alpha, f90, color in self.lobes:
            lobe = [rho / math.pi for rho in color] if kind == 0 else ggx(kind, alpha, f90, color, wi, wo)
            f = [a + b for a, b in zip(f, lobe)]
        if not self.layers:
            return f
        theta_h, theta_d, cos_phi = half_difference(wi, wo)
        phi = math.acos(cos_phi)

        def axis(theta, kappa):
            t = math.sqrt(2) * math.sin(theta / 2)
            return t * (0.6 * (1 + kappa) / (t + kappa) + 0.4)

        u_h, u_d = axis(theta_h, self.kappa_h), axis(theta_d, self.kappa_d)
        window = (math.sin(theta_h) / math.hypot(math.sin(theta_h), self.window_h)
                  * math.sin(theta_d) / math.hypot(math.sin(theta_d), self.window_d))
        r = [0.0] * n
        for j, a in self.coefficients.items():
            k, l, m = self.order[j]
            value = math.cos(math.pi * k * u_h) * math.cos(math.pi * l * u_d) * math.cos(m * phi) * window ** m
            r = [x + y * value for x, y in zip(r, a)]
        return [max(0.0, (x + self.epsilon) * math.exp(min(max(y, -9.7), 10.39)) - self.epsilon) for x, y in zip(f, r)]


def half_difference(wi, wo):
    """theta_h, theta_d, cos phi_d."""
    s, d = [a + b for a, b in zip(wi, wo)], [a - b for a, b in zip(wi, wo)]
    theta_h = math.atan2(math.hypot(s[0], s[1]), s[2])
    theta_d = math.atan2(math.hypot(*d), math.hypot(*s))
    below = 2 * math.sin(theta_h) * math.sin(theta_d)
    cos_phi = (wo[2] - wi[2]) / below if below > 0 else 0.0
    return theta_h, theta_d, min(max(cos_phi, -1.0), 1.0)


def ggx(kind, alpha, f90, color, wi, wo):
    ci, co, a2 = wi[2], wo[2], alpha * alpha
    if kind == 2:
        wo = (-wo[0], -wo[1], wo[2])
    theta_h, theta_d, _ = half_difference(wi, wo)
    d = a2 / (math.pi * (math.sin(theta_h) ** 2 + a2 * math.cos(theta_h) ** 2) ** 2)
    v = 1 / (2 * (co * math.sqrt(ci * ci + a2 * (1 - ci * ci)) + ci * math.sqrt(co * co + a2 * (1 - co * co))))
    schlick = (1 - math.cos(theta_d)) ** 5
    return [(f0 + (f90 - f0) * schlick) * d * v for f0 in color]


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as file:
        material = Brdfc(file.read(), int(sys.argv[2]) if len(sys.argv) > 2 else None)
    for line in sys.stdin:
        x = [float(v) for v in line.replace(",", " ").split()]
        print(",".join(f"{v:.9g}" for v in material.eval(x[:3], x[3:])))
