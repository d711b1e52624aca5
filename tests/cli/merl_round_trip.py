#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""decompress and convert: MERL tables that other programs, and this one, read."""
import pathlib
import struct
import os
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
        edge = self.report("compare", measured(), out)[0]["log_mae"]
        # Read as what it is, the table must be nearer to its source than read as something else.
        again = folder() / "again.binary"
        self.succeed("convert", out, "-o", again, "--position", "centre")
        self.assertLess(self.report("compare", measured(), again)[0]["log_mae"], edge)
        out.unlink()
        again.unlink()

    @unittest.skipUnless((SHARED / "paper_white_rgb.bsdf").exists(), "measured files are not here")
    def test_convert_of_a_foreign_file(self):
        source, out = SHARED / "paper_white_rgb.bsdf", folder() / "paper.binary"
        self.succeed("convert", source, "-o", out, "--full-circle")
        self.assertEqual(out.stat().st_size, 12 + 2 * 3 * 8 * MERL_CELLS)
        self.assertLess(self.report("compare", source, out)[0]["log_mae"], 0.01)
        out.unlink()


if __name__ == "__main__":
    main()
