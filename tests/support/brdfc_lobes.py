# SPDX-License-Identifier: Apache-2.0
"""The lobes of a .brdfc file: both codes of their parameters, and what they add up to."""
import math

from support.brdfc_coding import AdaptiveBit, Bits, RangeDecoder, require

NONZERO = 70, 95, 94
WIDER = ((95, 97, 97, 96, 95, 93, 85, 60, 70, 60, 40), (99, 98, 97, 96, 95, 93, 90, 80, 57, 25, 10),
         (97, 98, 97, 92, 90, 85, 68, 55, 45, 20, 20))


def percent(p):
    return AdaptiveBit(65536 * p // 100)


def alpha_of(code):
    return 2 ** (-16.6096404744368 * code / 2047)


def amplitude_of(code, exponent):
    return 2 ** (exponent - (2047 - code) / 128) if code else 0.0


def read_packed_lobes(data, channels):
    """(kind, alpha, f90, colour) of each lobe in chunk 0x01."""
    bits = Bits(data)
    count, exponent = bits.get(4), bits.get(8) - 128
    require(exponent <= 99, "the lobes are too large")
    lobes = []
    for _ in range(count):
        kind, alpha, f90 = bits.get(3), 1.0, 1.0
        require(kind <= 2, "unknown lobe kind")
        if kind:
            alpha = alpha_of(bits.get(11))
            f90 = amplitude_of(bits.get(11), exponent)
        lobes.append((kind, alpha, f90, [amplitude_of(bits.get(11), exponent) for _ in range(channels)]))
    require(not bits.rest(), "bytes are left after the lobes")
    return lobes


def read_coded_lobes(data, channels):
    """(kind, alpha, f90, colour) of each lobe in chunk 0x04."""
    coder = RangeDecoder(data)
    count, exponent = coder.raw(4), coder.raw(8) - 128
    require(exponent <= 99, "the lobes are too large")
    microfacets, retro = [percent(40), percent(95)], percent(8)
    nonzero, wider = [percent(p) for p in NONZERO], [[percent(p) for p in row] for row in WIDER]

    def amplitude(role, expected):
        if not coder.bit(nonzero[role]):
            return 0
        width = 0
        while width < 11 and coder.bit(wider[role][width]):
            width += 1
        if width:
            negative = True if role == 0 else coder.raw(1)
            size = 1 << (width - 1) | coder.raw(width - 1)
            expected += -size if negative else size
        require(1 <= expected <= 2047, "an amplitude is out of range")
        return expected

    lobes = []
    for i in range(count):
        kind, alpha, f90, expected, color = 0, 1.0, 1.0, 1500, []
        if coder.bit(microfacets[min(i, 1)]):
            kind = 2 if coder.bit(retro) else 1
            alpha = alpha_of(coder.raw(11))
            f90 = amplitude_of(amplitude(0, 2047), exponent)
        for c in range(channels):
            code = amplitude(1 if c == 0 else 2, expected)
            expected = code or expected
            color.append(amplitude_of(code, exponent))
        lobes.append((kind, alpha, f90, color))
    coder.finish()
    require(coder.at >= len(data), "bytes are left after the lobes")
    return lobes


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
