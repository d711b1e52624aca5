# SPDX-License-Identifier: Apache-2.0
"""Analytic chunks, for brdfc_reader: written from docs/format.md alone."""
import math
import struct

from support.brdfc_coding import require

LAMBERT, GGX, MIRROR, DIELECTRIC = range(4)
STEPS = 120


class AnalyticModel:
    """The parameters, and f. What transmits or mirrors has no f: sampling it is what its parameters say."""
    def __init__(self, payload, channels):
        require(len(payload) > 0, "the analytic chunk is empty")
        first = payload[0]
        self.kind, anisotropic, self.compensated = first & 15, bool(first & 16), bool(first & 32)
        require(self.kind <= DIELECTRIC, "unknown kind of model")
        require(first & 0xC0 == 0 and (self.kind == GGX or first < 16), "reserved bits of the analytic chunk are set")
        roughnesses = (2 if anisotropic else 1) if self.kind == GGX else 0
        count = 1 if self.kind == DIELECTRIC else channels + roughnesses
        require(len(payload) == 1 + 4 * count, "the analytic chunk has another length")
        values = struct.unpack(f"<{count}f", payload[1:])
        self.channels, self.reciprocal = channels, self.kind != DIELECTRIC
        if self.kind == DIELECTRIC:
            self.ior = values[0]
            low, high = (struct.unpack("<f", struct.pack("<f", v))[0] for v in (0.1, 10))
            require(low <= self.ior <= high, "the index of refraction is out of range")
            return
        self.color = values[roughnesses:]
        require(all(0 <= v <= 1 for v in self.color), "a reflectance is out of range")
        if self.kind == GGX:
            self.alpha = values[0], values[roughnesses - 1]
            least = struct.unpack("<f", struct.pack("<f", 1e-4))[0]
            require(all(least <= a <= 1 for a in self.alpha), "a roughness is out of range")
            require(anisotropic == (self.alpha[0] != self.alpha[1]), "two roughnesses that are the same")
            require(not (anisotropic and self.compensated), "compensation of two roughnesses")
            self.losses, self.mean_loss = {}, None

    def eval(self, wi, wo):
        """f of each channel, for directions above the horizon."""
        if self.kind == LAMBERT:
            return [rho / math.pi for rho in self.color]
        if self.kind != GGX:
            return [0.0] * self.channels
        s = [a + b for a, b in zip(wi, wo)]
        length2 = sum(v * v for v in s)
        ax, ay = self.alpha
        q = ((s[0] / ax) ** 2 + (s[1] / ay) ** 2 + s[2] ** 2) / length2
        slope_i, slope_o = (math.sqrt(w[2] ** 2 + (ax * w[0]) ** 2 + (ay * w[1]) ** 2) for w in (wi, wo))
        shape = 1 / (math.pi * ax * ay * q * q) * 0.5 / (slope_i * wo[2] + slope_o * wi[2])
        weight = (1 - math.sqrt(length2) / 2) ** 5
        f = [shape * (f0 + (1 - f0) * weight) for f0 in self.color]
        if not self.compensated:
            return f
        if self.mean_loss is None:
            cosines = [((i + 0.5) / 64) for i in range(64)]
            self.mean_loss = sum(2 * mu * self.loss(mu) / 64 for mu in cosines)
        more = self.loss(wi[2]) * self.loss(wo[2]) / (math.pi * self.mean_loss)
        for c, f0 in enumerate(self.color):
            mean = (20 * f0 + 1) / 21
            f[c] += more * mean * mean * (1 - self.mean_loss) / (1 - mean * self.mean_loss)
        return f

    def loss(self, mu):
        """1 - E of one roughness: 1 minus the mean of G2 / G1 over the visible normals that reflect upwards."""
        if mu in self.losses:
            return self.losses[mu]
        a, sine = self.alpha[0], math.sqrt(max(1 - mu * mu, 0.0))
        slope = math.sqrt(mu * mu + a * a * sine * sine)
        lambda_o = (slope / mu - 1) / 2
        kept = 0.0
        for i in range(STEPS):
            # tan theta_m = a tan v: the density of visible normals per dv dphi has no peak
            v = math.pi / 2 * (i + 0.5) / STEPS
            tangent = a * math.tan(v)
            cos2 = 1 / (1 + tangent * tangent)
            for j in range(STEPS):
                cos_phi = math.cos(math.pi * (j + 0.5) / STEPS)
                seen = sine * tangent * cos_phi + mu
                cos_i = 2 * seen * cos2 - mu
                if seen <= 0 or cos_i <= 0:
                    continue
                tan2 = max(1 / (cos_i * cos_i) - 1, 0.0)
                lambda_i = (math.sqrt(1 + a * a * tan2) - 1) / 2
                density = (sine * a * math.sin(v) ** 2 * cos_phi + mu * math.sin(v) * math.cos(v)) * 2 / (mu + slope) / math.pi
                kept += density * (1 + lambda_o) / (1 + lambda_o + lambda_i)
        cell = math.pi / 2 / STEPS * 2 * math.pi / STEPS
        self.losses[mu] = 1 - kept * cell
        return self.losses[mu]
