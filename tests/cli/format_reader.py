#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/format.md is enough to write a reader: one made from it agrees with the library on the golden files."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support.brdfc_reader import Brdfc, FormatError, xxh32

ROOT = pathlib.Path(os.environ.get("BRDF_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
MEASURED = pathlib.Path(os.environ.get("BRDF_SHARED", "")) / "data" / "rgl" / "vch_golden_yellow_rgb.bsdf"
FILES = sorted((ROOT / "data" / "golden").glob("*.brdfc"))


def expectations(file):
    """(level, refinements, wi, wo, f) of each row."""
    for line in file.with_suffix(".txt").read_text().splitlines():
        if not line.startswith("#"):
            level, refinements, *numbers = line.split()
            numbers = [float(v) for v in numbers]
            yield level, int(refinements), numbers[:3], numbers[3:6], numbers[6:]


def directions(count):
    """Pairs above the horizon, well spread and the same on every machine."""
    def hemisphere(a, b):
        z = 0.05 + 0.95 * a
        return math.sqrt(1 - z * z) * math.cos(2 * math.pi * b), math.sqrt(1 - z * z) * math.sin(2 * math.pi * b), z

    ratios = 0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101
    for i in range(count):
        u = [(0.5 + r * (i + 1)) % 1 for r in ratios]
        yield hemisphere(u[0], u[1]), hemisphere(u[2], u[3])


class FormatReader(unittest.TestCase):
    def close(self, found, expected, relative, where):
        self.assertEqual(len(found), len(expected), where)
        for a, b in zip(found, expected):
            self.assertLessEqual(abs(a - b), relative * abs(b) + 1e-6, f"{where}: {a} and {b}")

    def test_there_are_files(self):
        self.assertGreaterEqual(len(FILES), 4)

    def test_xxh32(self):
        self.assertEqual(xxh32(b"", 0), 0x02CC5D05)
        self.assertEqual(xxh32(b"Nobody inspects the spammish repetition", 0), 0xE2293B2F)
        self.assertEqual(xxh32(b"I want an unsigned 32-bit seed!", 0), 0xF7A35AF8)
        self.assertEqual(xxh32(b"I want an unsigned 32-bit seed!", 1), 0xD8D4B4BA)

    def test_golden_values(self):
        for file in FILES:
            data, materials = file.read_bytes(), {}
            for level, refinements, wi, wo, f in expectations(file):
                if level == "direct":
                    if refinements not in materials:
                        materials[refinements] = Brdfc(data, refinements)
                    # libbrdf holds the table in slices in float
                    # and the reader integrates the compensation by another rule
                    tolerance = {"rgb-slices": 1e-4, "model-compensated": 5e-4}.get(file.stem, 1e-6)
                    self.close(materials[refinements].eval(wi, wo), f, tolerance, f"{file.name} {refinements} {wi} {wo}")

    def test_prefixes(self):
        for file in FILES:
            data = file.read_bytes()
            whole = Brdfc(data)
            at, refinements = whole.header_bytes, -1
            for code, length in whole.directory:
                at += length + 4
                refinements += code in (1, 2, 3, 4, 5)
                cut = Brdfc(data[:at], prefix=True)
                self.assertEqual(len(cut.layers), refinements)
                self.assertEqual(cut.coefficients, Brdfc(data, refinements).coefficients)
                if at < len(data):
                    self.assertRaises(FormatError, Brdfc, data[:at])
                self.assertRaises(FormatError, Brdfc, data[:at - 1], prefix=True)

    def test_changed_bytes(self):
        data = bytearray(FILES[0].read_bytes())
        for i in range(len(data)):
            data[i] ^= 1 << i % 8
            self.assertRaises(FormatError, Brdfc, bytes(data))
            data[i] ^= 1 << i % 8

    def evaluated(self, file, pairs, level):
        """What the command line says about some pairs."""
        rows = "".join(",".join(f"{v:.9g}" for v in (*wi, *wo)) + "\n" for wi, wo in pairs)
        command = [os.environ["BRDF_COMPRESS"], "eval", str(file), "--eval", level, "--format", "csv"]
        out = subprocess.run(command, input=rows, capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(len(out), len(pairs))
        return [[float(v) for v in line.split(",")] for line in out]

    @unittest.skipUnless(os.environ.get("BRDF_COMPRESS"), "brdf-compress is not built")
    def test_command_line(self):
        pairs = list(directions(100))
        for file in FILES:
            material = Brdfc(file.read_bytes())
            for (wi, wo), f in zip(pairs, self.evaluated(file, pairs, "exact")):
                self.close(f, material.eval(wi, wo), 0.01, f"{file.name} {wi} {wo}")

    @unittest.skipUnless(os.environ.get("BRDF_COMPRESS"), "brdf-compress is not built")
    @unittest.skipUnless(MEASURED.exists(), "measured files are not here")
    def test_slices(self):
        with tempfile.TemporaryDirectory(prefix="brdf-format-") as folder:
            file = pathlib.Path(folder) / "slices.brdfc"
            command = [os.environ["BRDF_COMPRESS"], "compress", str(MEASURED), "-o", str(file), "--target-size", "1500"]
            subprocess.run([*command, "-q"], check=True)
            data = file.read_bytes()
            material = Brdfc(data)
            self.assertEqual(material.axes, 1)
            self.assertGreater(len(material.layers), 0)
            # one along the normal, where azimuths mean nothing, and one below the nodes that stand for the horizon
            pairs = [*directions(60), ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8)),
                     ((math.sqrt(1 - 1e-4), 0.0, 0.01), (-math.sqrt(0.5), 0.0, math.sqrt(0.5)))]
            # nodes are the same but for ties of half floats; the tolerance is that of the other files
            for (wi, wo), f in zip(pairs, self.evaluated(file, pairs, "balanced")):
                self.close(f, material.eval_resampled(wi, wo), 0.01, f"balanced {wi} {wo}")
            for (wi, wo), f in zip(pairs, self.evaluated(file, pairs, "exact")):
                self.close(f, material.eval(wi, wo), 0.001, f"exact {wi} {wo}")
            lobes = Brdfc(data, 0)
            for (wi, wo), f in zip(pairs, self.evaluated(file, pairs, "fast")):
                self.close(f, lobes.eval(wi, wo), 0.001, f"fast {wi} {wo}")
            self.closed_formula_is_near(material, pairs[:20])

    def closed_formula_is_near(self, material, pairs):
        """The grid is another form of the formula: most values hardly differ."""
        near = [abs(a - b) <= 0.05 * b + 1e-3 for wi, wo in pairs
                for a, b in zip(material.eval_resampled(wi, wo), material.eval(wi, wo))]
        self.assertGreater(sum(near), 0.8 * len(near))


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False, verbosity=1).result.wasSuccessful())
