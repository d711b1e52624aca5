#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""decompress and convert: MERL tables that other programs, and this one, read."""
import math
import os
import pathlib
import struct
import unittest

from support.cli_harness import CliTest, MERL_BYTES, MERL_CELLS, compressed, folder, main, measured

SHARED = pathlib.Path(os.environ.get("BRDF_SHARED", "")) / "data" / "rgl"


def red(path, i, j, k):
    """Raw value of the first plane of a 90 x 90 x 180 table."""
    with open(path, "rb") as file:
        file.seek(12 + 8 * (k + 180 * (j + 90 * i)))
        return struct.unpack("<d", file.read(8))[0]


class MerlRoundTrip(CliTest):
    def test_decompressed_table_is_the_material(self):
        out = folder() / "back.binary"
        self.succeed("decompress", compressed(), "-o", out, "--to", "merl", "--eval", "exact")
        self.assertEqual(out.stat().st_size, MERL_BYTES)
        with open(out, "rb") as file:
            self.assertEqual(struct.unpack("<3i", file.read(12)), (90, 90, 180))
        self.assertEqual(red(out, 89, 89, 0), -1)  # below the horizon
        self.assertGreaterEqual(red(out, 0, 0, 0), 0)
        row = self.report("compare", compressed(), out, "--eval", "exact")[0]
        self.assertLess(row["log_mae"], 0.003)
        self.fail_with(1, "decompress", compressed(), "-o", out, says="exists")
        fast = folder() / "fast.binary"
        self.succeed("decompress", compressed(), "-o", fast, "--eval", "fast")
        self.assertNotEqual(fast.read_bytes(), out.read_bytes())
        out.unlink()
        fast.unlink()

    def test_prefix_of_decompress(self):
        ends = [r["ends_at"] for r in self.report("info", compressed())[0]["refinements"]]
        fast, cut = folder() / "fast.binary", folder() / "cut.binary"
        self.succeed("decompress", compressed(), "-o", fast, "--eval", "fast")
        self.succeed("decompress", compressed(), "-o", cut, "--prefix", ends[0])
        self.assertEqual(fast.read_bytes(), cut.read_bytes())
        fast.unlink()
        cut.unlink()

    def test_convert_keeps_a_table_that_fits(self):
        out = folder() / "copy.binary"
        self.succeed("convert", measured(), "-o", out)
        row = self.report("compare", measured(), out)[0]
        self.assertEqual(row["log_mae_max"], 0)
        a, b = self.report("info", measured())[0], self.report("info", out)[0]
        self.assertEqual(a["invalid_fraction"], b["invalid_fraction"])
        out.unlink()

    def test_convert_to_bin_centres(self):
        out = folder() / "centres.binary"
        self.succeed("convert", measured(), "-o", out, "--to-centre")
        for i, j, k in [(5, 3, 40), (30, 20, 90), (45, 45, 100), (60, 10, 20)]:
            theta_h = math.radians(((i + 0.5) / 90) ** 2 * 90)
            theta_d, phi_d = math.radians(j + 0.5), math.radians(k + 0.5)
            x, y = math.sin(theta_d) * math.cos(phi_d), math.sin(theta_d) * math.sin(phi_d)
            along, z = math.sin(theta_h) * math.cos(theta_d), math.cos(theta_h) * math.cos(theta_d)
            wi = (math.cos(theta_h) * x + along, y, z - math.sin(theta_h) * x)
            wo = (-math.cos(theta_h) * x + along, -y, z + math.sin(theta_h) * x)
            row = ",".join(repr(v) for v in (*wi, *wo)).encode()
            f = float(self.succeed("eval", measured(), stdin=row).stdout.split(b",")[0])
            self.assertAlmostEqual(red(out, i, j, k) / 1500, f, delta=1e-3 * f)
        out.unlink()

    @unittest.skipUnless((SHARED / "paper_white_rgb.bsdf").exists(), "measured files are not here")
    def test_convert_of_a_foreign_file(self):
        source, out = SHARED / "paper_white_rgb.bsdf", folder() / "paper.binary"
        self.succeed("convert", source, "-o", out, "--full-circle")
        self.assertEqual(out.stat().st_size, 12 + 2 * 3 * 8 * MERL_CELLS)
        self.assertLess(self.report("compare", source, out)[0]["log_mae"], 0.01)
        out.unlink()


if __name__ == "__main__":
    main()
