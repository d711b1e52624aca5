#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/format.md is enough to write a reader: one made from it agrees with the library on the golden files."""
import math
import os
import pathlib
import subprocess
import sys
import unittest

from support.brdfc_reader import Brdfc, FormatError, xxh32

ROOT = pathlib.Path(os.environ.get("BRDF_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
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
                    self.close(materials[refinements].eval(wi, wo), f, 1e-6, f"{file.name} {refinements} {wi} {wo}")

    def test_prefixes(self):
        for file in FILES:
            data = file.read_bytes()
            whole = Brdfc(data)
            at, refinements = whole.header_bytes, -1
            for code, length in whole.directory:
                at += length + 4
                refinements += code in (1, 2, 3)
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

    @unittest.skipUnless(os.environ.get("BRDF_COMPRESS"), "brdf-compress is not built")
    def test_command_line(self):
        pairs = list(directions(100))
        rows = "".join(",".join(f"{v:.9g}" for v in (*wi, *wo)) + "\n" for wi, wo in pairs)
        for file in FILES:
            command = [os.environ["BRDF_COMPRESS"], "eval", str(file), "--eval", "exact", "--format", "csv"]
            out = subprocess.run(command, input=rows, capture_output=True, text=True, check=True).stdout.splitlines()
            self.assertEqual(len(out), len(pairs))
            material = Brdfc(file.read_bytes())
            for (wi, wo), line in zip(pairs, out):
                self.close([float(v) for v in line.split(",")], material.eval(wi, wo), 0.01, f"{file.name} {wi} {wo}")


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False, verbosity=1).result.wasSuccessful())
