# SPDX-License-Identifier: Apache-2.0
"""Residuals in slice coordinates for brdfc_reader.py, written from "Slices" in docs/format.md alone."""
import functools
import itertools
import math
import struct

from support.brdfc_coding import Bits, CoefficientDecoder, RangeDecoder, require


class SliceFrame:
    """The fields of a frame; `rest` is what follows it in the payload."""
    def __init__(self, data):
        bits = Bits(data)
        count, self.width, self.height, self.rows = bits.get(5), bits.get(7), bits.get(7), bits.get(8)
        step, epsilon, nodes, first, length = bits.get(5), bits.get(8), bits.get(8), bits.get(16), bits.get(11)
        codes = [bits.get(16) for _ in range(count)]
        data = bits.rest()
        require(2 <= count <= 24, "the number of slices is not 2 to 24")
        require(all(a < b for a, b in zip(codes, codes[1:])), "the slices do not ascend")
        require(2 <= self.width <= 64 and 2 <= self.height <= 64, "the squares are not of 2 to 64 nodes")
        require(self.rows >= 4 and step <= 20 and epsilon <= 227 and nodes >= 3, "a field is out of range")
        require(length <= len(data), "the ndf is cut")
        self.rest = data[length:]
        self.half_height, self.half_rows = (self.height + 1) // 2, (self.rows + 1) // 2
        self.theta = [t * (math.pi / 2) / 65535 for t in codes]
        self.epsilon = 2.0 ** (epsilon - 128)
        ndf = self.read_ndf(RangeDecoder(data[:length]), nodes, first - 65536 if first >= 32768 else first)
        require(all(abs(b) <= 30 * 2 ** (step / 2) for b in ndf), "the ndf leaves its range")
        self.ndf = [2 ** (b * 2 ** (-step / 2)) for b in ndf]

    @staticmethod
    def read_ndf(coder, nodes, first):
        model, b, before, last = CoefficientDecoder(False), [first, first], 0, 0  # b starts with that of place -1
        for _ in range(1, nodes):
            before, last = last, model.decode_value(coder, True, 2 * min(abs(last), 40) + min(abs(before), 40), 0)
            b.append(2 * b[-1] - b[-2] + last)
        coder.finish()
        return b[1:]

    def reach(self):
        return self.width, self.half_height, len(self.theta)


def cell(x, count):
    """Lower node and fraction of a place among `count` nodes; with one node there is no upper one."""
    x = min(max(x, 0.0), count - 1.0)
    left = max(min(int(x), count - 2), 0)
    return left, x - left


def curve(nodes, u):
    """Linear between nodes evenly spread over [0, 1]."""
    left, t = cell(u * (len(nodes) - 1), len(nodes))
    return nodes[left] + t * (nodes[left + 1] - nodes[left])


def elevation(u):
    return math.pi / 2 * u * u


class SliceMap:
    """From pairs of directions to the squares."""
    def __init__(self, frame):
        self.frame = frame
        nodes = len(frame.ndf)
        self.u = [i / (nodes - 1) for i in range(nodes)]
        self.maps = [self.slice_map(theta) for theta in frame.theta]
        sigma = [self.projected_area(elevation(k / 128)) for k in range(129)]
        self.sigma = [max(v / sigma[0], 1e-6) for v in sigma]

    def slice_map(self, theta):
        """d, c, T, C of a slice."""
        rows, half = self.frame.rows, self.frame.half_rows
        d, c = [], []
        for r in range(half):
            cos_phi = math.cos((2 * r / (rows - 1) - 1) * math.pi)
            d.append([])
            for value, u in zip(self.frame.ndf, self.u):
                sine, cosine = math.sin(elevation(u)), math.cos(elevation(u))
                d[-1].append(value * u * sine * max(0.0, math.cos(theta) * cosine + math.sin(theta) * sine * cos_phi))
            c.append(list(itertools.accumulate(((a + b) / 2 for a, b in zip(d[-1], d[-1][1:])), initial=0.0)))
        total = [row[-1] for row in c]
        before = list(itertools.accumulate(((a + b) / 2 for a, b in zip(total, total[1:])), initial=0.0))
        z = 2 * before[-1] + (total[-1] if rows % 2 == 0 else 0.0) or 1.0
        return ([[v / z for v in row] for row in d], [[v / z for v in row] for row in c],
                [v / z for v in total], [v / z for v in before])

    def projected_area(self, theta):
        """sigma' of an elevation."""
        n, total = len(self.u), 0.0
        for x, (value, u) in enumerate(zip(self.frame.ndf, self.u)):
            a, b = math.cos(theta) * math.cos(elevation(u)), math.sin(theta) * math.sin(elevation(u))
            p = 2 * math.pi * a if a >= b else 2 * (a * math.acos(-a / b) + math.sqrt(b * b - a * a))
            total += (0.5 if x == n - 1 else 1.0) * value * u * math.sin(elevation(u)) / (n - 1) * p
        return total

    def point(self, wi, wo):
        """(s, w, u, v, scale) of a pair."""
        s_x, s_y, s_z = (a + b for a, b in zip(wi, wo))
        theta_i = math.atan2(math.hypot(wi[0], wi[1]), wi[2])
        u_h = math.sqrt(2 * math.atan2(math.hypot(s_x, s_y), s_z) / math.pi)
        phi = 0.0
        if math.hypot(wi[0], wi[1]) > 0 and math.hypot(s_x, s_y) > 0:
            phi = math.atan2(abs(wi[0] * s_y - wi[1] * s_x), wi[0] * s_x + wi[1] * s_y)
        v_h = (math.pi - phi) / (2 * math.pi)

        theta, half = self.frame.theta, self.frame.half_rows
        s = min(max(sum(t <= theta_i for t in theta) - 1, 0), len(theta) - 2)
        w = min(max((theta_i - theta[s]) / (theta[s + 1] - theta[s]), 0.0), 1.0)
        x, alpha = cell(u_h * (len(self.u) - 1), len(self.u))
        y, beta = cell(min(v_h * (self.frame.rows - 1), half - 1), half)
        e = max(v_h * (self.frame.rows - 1) - (half - 1), 0.0)
        (d0, c0, t0, b0), (d1, c1, t1, b1) = self.maps[s], self.maps[s + 1]

        def mix(lower, upper):
            """Between slices and rows of a quantity that is given for each row."""
            below, above = ((1 - w) * lower(r) + w * upper(r) for r in (y, y + 1))
            return below + beta * (above - below)

        a, b = (mix(lambda r, x=x: d0[r][x], lambda r, x=x: d1[r][x]) for x in (x, x + 1))
        total = mix(lambda r: t0[r], lambda r: t1[r])
        along = mix(lambda r: c0[r][x], lambda r: c1[r][x]) + alpha * (a + alpha * (b - a) / 2)
        lower, upper = ((1 - w) * t0[r] + w * t1[r] for r in (y, y + 1))
        v = (1 - w) * b0[y] + w * b1[y] + beta * (lower + beta * (upper - lower) / 2) + e * upper
        sigma = curve(self.sigma, math.sqrt(2 * theta_i / math.pi))
        scale = curve(self.frame.ndf, u_h) / (4 * sigma * max(wo[2], 1e-9))
        return s, w, min(max(along / total if total > 0 else 0.0, 0.0), 1.0), min(max(v, 0.0), 0.5), scale


class SliceTable:
    """f of a residual in slice coordinates; coefficients are {(k, l, m): value of each channel}."""
    def __init__(self, frame, coefficients, channels):
        self.frame, self.channels, self.map = frame, channels, SliceMap(frame)
        sums = coefficients
        for axis, n in enumerate(frame.reach()):  # one frequency after another becomes a node
            cosine = [[math.cos(math.pi * k * (i + 0.5) / n) for i in range(n)] for k in range(n)]
            out = {}
            for place, values in sums.items():
                for i, factor in enumerate(cosine[place[axis]]):
                    target = out.setdefault((*place[:axis], i, *place[axis + 1:]), [0.0] * channels)
                    for c, value in enumerate(values):
                        target[c] += value * factor
            sums = out
        self.zero = [0.0] * channels if sums else [max(0.0, 1 - frame.epsilon)] * channels  # all coefficients are 0
        self.nodes = {place: [max(0.0, math.exp(min(max(y, -80), 80)) - frame.epsilon) for y in values]
                      for place, values in sums.items()}

    def eval(self, wi, wo):
        s, w, u, v, scale = self.map.point(wi, wo)
        width, half = self.frame.width, self.frame.half_height
        i, x = cell(u * (width - 1), width)
        j, y = cell(min(v * (self.frame.height - 1), half - 1), half)
        f = [0.0] * self.channels
        for a, b, c in itertools.product((0, 1), repeat=3):
            weight = (x if a else 1 - x) * (y if b else 1 - y) * (w if c else 1 - w)
            if weight:
                node = self.nodes.get((i + a, j + b, s + c), self.zero)
                f = [p + scale * weight * q for p, q in zip(f, node)]
        return [min(value, 1e30) for value in f]


def unwarp(u, kappa):
    """t with warp(t, kappa) = u: the root in [0, 1] of 0.4 t^2 + (0.6 (1 + kappa) + 0.4 kappa - u) t - u kappa."""
    b = 0.6 * (1 + kappa) + 0.4 * kappa - u
    return 2 * u * kappa / (b + math.sqrt(b * b + 1.6 * u * kappa)) if u > 0 else 0.0


def half_float(x):
    return struct.unpack("<e", struct.pack("<e", x))[0]


class ResampledGrid:
    """R at the nodes of the half/difference grid, made where it is asked for."""
    def __init__(self, size, kappa_h, kappa_d, epsilon, slices, lobes):
        self.size, self.epsilon, self.slices, self.lobes = size, epsilon, slices, lobes
        self.angles_h, self.angles_d = ([self.angle(unwarp(i / (n - 1), kappa)) for i in range(n)]
                                        for n, kappa in zip(size, (kappa_h, kappa_d)))
        self.line = functools.cache(self.line)
        self.adjusted = functools.cache(self.adjusted)

    @staticmethod
    def angle(t):
        """Sine and cosine of a theta."""
        cosine = 1 - t * t
        return math.sqrt(max(1 - cosine * cosine, 1e-12)), cosine

    def line(self, h, p):
        """R along d, before it is adjusted."""
        n_d, u = self.size[1], p / (self.size[2] - 1)
        cos_phi = 1 - 4 * u * u if u <= 0.5 else 4 * (1 - u) ** 2 - 1
        sin_phi = math.sqrt(max(1 - cos_phi * cos_phi, 0.0))
        sin_h, cos_h = self.angles_h[h]
        ratio = []
        for sin_d, cos_d in self.angles_d:
            x, y = sin_d * cos_phi, sin_d * sin_phi
            wi = sin_h * cos_d + cos_h * x, y, cos_h * cos_d - sin_h * x
            wo = sin_h * cos_d - cos_h * x, -y, cos_h * cos_d + sin_h * x
            if min(wi[2], wo[2]) < 0.012:
                break
            ratio.append([self.limited((f + self.epsilon) / (lobe + self.epsilon))
                          for f, lobe in zip(self.slices.eval(wi, wo), self.lobes(wi, wo))])
        beyond = [1.0] * self.slices.channels
        if ratio:
            before = ratio[-2] if len(ratio) > 1 else ratio[-1]
            beyond = [self.limited(b * min(max(b / a, 0.5), 2.0)) for a, b in zip(before, ratio[-1])]
        return ratio + [beyond] * (n_d - len(ratio))

    @staticmethod
    def limited(ratio):
        return min(max(ratio, 1 / 14765), 14765.0)

    def adjusted(self, node, axes):
        """R of a node after the adjustment along the last `axes` of (h, d, p)."""
        if axes == 0:
            return self.line(node[0], node[2])[node[1]]
        axis = 3 - axes
        here = self.adjusted(node, axes - 1)
        if not 0 < node[axis] < self.size[axis] - 1:
            return here
        low, high = (self.adjusted((*node[:axis], node[axis] + step, *node[axis + 1:]), axes - 1) for step in (-1, 1))
        return [b - min(max((a - 2 * b + c) / 12, -b / 20), b / 20) for a, b, c in zip(low, here, high)]

    def ratio(self, coordinates):
        """R between the nodes, at (u_h, u_d, u_p)."""
        cells = [cell(u * (n - 1), n) for u, n in zip(coordinates, self.size)]
        r = [0.0] * self.slices.channels
        for corner in itertools.product((0, 1), repeat=3):
            weight = math.prod(t if up else 1 - t for up, (_, t) in zip(corner, cells))
            if weight:
                node = self.adjusted(tuple(i + up for up, (i, _) in zip(corner, cells)), 3)
                r = [a + weight * half_float(min(max(b, 6.2e-5), 32000.0)) for a, b in zip(r, node)]
        return r
