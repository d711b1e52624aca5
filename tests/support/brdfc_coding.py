# SPDX-License-Identifier: Apache-2.0
"""What brdfc_reader.py reads with: bytes, bits, checksums, the range coder and its model of coefficients."""
import struct

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

    def finish(self):
        require(self.at - len(self.data) <= 4, "a stream goes on beyond its end")

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


def coefficient_order(shape, reciprocal, count, reach=(64, 32, 24)):
    """The frequencies (k, l, m) of each place; `reach` bounds them."""
    a, b, c = SHAPES[shape]
    places = [(a * k + b * l + c * m, m, l, k)
              for m in range(0, reach[2], 2 if reciprocal else 1) for l in range(reach[1]) for k in range(reach[0])]
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
        q = self.decode_value(coder, c == 0, v, sum(place >= bound for bound in (6, 12, 24, 48, 96)))
        if q:
            self.known[c, k, l, m] = min(abs(q), 255)
        return q

    def decode_value(self, coder, luma, v, b):
        """One q, given its activity before classes and the radius."""
        a = v if v < 4 else 4 if v < 6 else 5 if v < 9 else 6 if v < 14 else 7
        if not coder.bit(self.nonzero[int(luma)][a][b if a < 4 else 0]):
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
        return -n if negative else n
