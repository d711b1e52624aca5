#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compress follows the profile of a scene; profile shows and merges such files. The profiles come from a second writer."""
import unittest

from support.brdfc_reader import Brdfc
from support.cli_harness import CliTest, direction, folder, main, measured, run
from support.profile_file import PIXEL_UNITS, BadProfile, Material, read_profile, write_profile


def made(*materials):
    """Path of a profile; (name, list of (theta_i, theta_o, phi, contribution, operation), pixels)."""
    sums = {}
    for name, queries, pixels in materials:
        m = sums[name] = Material()
        for theta_i, theta_o, phi, contribution, operation in queries:
            m.add(direction(theta_i, 0), direction(theta_o, phi), contribution, operation)
        m.footprint, m.first_hits = int(pixels * PIXEL_UNITS), 10
    path = folder() / ("-".join(sums) + ".prof")
    path.write_bytes(write_profile(sums))
    return path


def retro():
    return [(t, t + d, p, 1, "eval") for t in range(10, 70, 2) for d in range(-6, 7, 2) for p in (-8, -2, 3, 9)]


def far():
    return [(50, 30, 120, 0.001, "sample")]


class Profiles(CliTest):
    def compress(self, name, *options):
        path = folder() / name
        return path, self.report("compress", measured(), "-o", path, "-f", "--preset", "fastest", *options)[0]

    def test_bytes_go_where_the_scene_looks(self):
        profile = made(("wall", retro(), 500))
        path, row = self.compress("retro.brdfc", "--target-size", 250, "--profile", profile)
        self.assertLessEqual(path.stat().st_size, 250)
        self.assertGreater(row["profile"]["rms"], 0)
        self.assertEqual(row["profile"]["share"], 1)
        # the other way round: about that error needs no more bytes
        target = 1.1 * row["profile"]["rms"]
        small, promised = self.compress("small.brdfc", "--profile", profile, "--target-error", f"profile={target:.6f}")
        self.assertLessEqual(small.stat().st_size, 250)
        self.assertLessEqual(promised["profile"]["rms"], target)

    def test_what_is_small_and_far_away_ends_at_a_few_dozen_bytes(self):
        profile = made(("near", retro(), 5000), ("far", far(), 3))
        path, row = self.compress("far.brdfc", "--profile", profile, "--profile-material", "far", "--target-error", "profile=0.2")
        self.assertLessEqual(path.stat().st_size, 64)
        self.assertLessEqual(row["profile"]["rms"], 0.2)
        self.assertLess(row["profile"]["share"], 0.001)

    def test_info_says_what_a_file_is_fit_for(self):
        profile = made(("near", retro(), 5000), ("far", far(), 3))
        path, row = self.compress("told.brdfc", "--profile", profile, "--profile-material", "far", "--target-size", 200)
        said = self.report("info", path)[0]["fitted_for"]
        self.assertEqual(said["operations"], ["sample"])
        self.assertAlmostEqual(said["theta_i"][0], 50, delta=0.51)
        self.assertAlmostEqual(said["theta_o"][1], 30, delta=0.51)
        self.assertAlmostEqual(said["footprint_pixels"], 3, delta=0.2)
        self.assertGreaterEqual(said["rms"], row["profile"]["rms"])
        self.assertLessEqual(said["rms"], row["profile"]["rms"] * 1.0906)
        self.assertIn("fit for", run("info", path).stdout.decode())
        again = Brdfc(path.read_bytes()).fitted_for  # the second reader
        self.assertEqual(again["operations"], said["operations"])
        self.assertEqual(again["level"], said["level"])
        for key in ("share", "footprint_pixels", "rms", "log_error"):
            self.assertAlmostEqual(again[key], said[key], delta=1e-9)
        for key in ("theta_i", "theta_o"):
            for a, b in zip(again[key], said[key]):
                self.assertAlmostEqual(a, b, delta=1e-4)
        plain, _ = self.compress("plain.brdfc", "--target-size", 200)
        self.assertIsNone(self.report("info", plain)[0]["fitted_for"])

    def test_what_is_never_sampled_brings_no_tables(self):
        profile = made(("wall", retro(), 500))
        _, row = self.compress("no-cdf.brdfc", "--profile", profile, "--store-cdf", "--target-size", 6000)
        self.assertEqual(row["cdf_bytes"], 0)
        self.assertIn("no sample", row["profile"]["left_out"])

    def test_bytes_do_not_depend_on_threads(self):
        profile = made(("wall", retro(), 500))
        one, _ = self.compress("one.brdfc", "--profile", profile, "--target-size", 220, "--threads", 1)
        many, _ = self.compress("many.brdfc", "--profile", profile, "--target-size", 220, "--threads", 3)
        self.assertEqual(one.read_bytes(), many.read_bytes())

    def test_bad_profiles(self):
        out = folder() / "never.brdfc"
        arguments = ["compress", measured(), "-o", out, "--preset", "fastest"]
        good = made(("near", retro(), 5000), ("far", far(), 3))
        data = good.read_bytes()
        bad = folder() / "bad.prof"
        for content, word in [(b"", "BRPF"), (b"BRFC" + data[4:], "BRPF"), (data[:-1], "checksum"), (data[:40] + b"\xff" + data[41:], "checksum"),
                              (b"BRPF\x02" + data[5:], "version 2"), (data + b"\0", "checksum")]:
            bad.write_bytes(content)
            self.fail_with(3, *arguments, "--profile", bad, says=["bad.prof", word])
            self.fail_with(3, "profile", "show", bad, says=["bad.prof", word])
        self.fail_with(3, *arguments, "--profile", folder() / "missing.prof", says="missing.prof")
        self.fail_with(3, *arguments, "--profile", good, says=["--profile-material", "far or near"])
        self.fail_with(3, *arguments, "--profile", good, "--profile-material", "door", says=["'door'", "far or near"])
        self.fail_with(3, *arguments, "--profile", made(("nothing", [], 0)), says="asks nothing")
        self.fail_with(2, *arguments, "--target-error", "profile=0.1", says="--profile")
        self.fail_with(2, *arguments, "--profile-material", "far", says="--profile")
        self.assertFalse(out.exists())

    def test_show(self):
        profile = made(("near", retro(), 5000), ("far", far(), 3))
        rows = self.report("profile", "show", profile)
        self.assertEqual([r["material"] for r in rows], ["near", "far"])
        self.assertEqual(rows[0]["operations"]["eval"], len(retro()))
        self.assertEqual(rows[1]["operations"]["sample"], 1)
        self.assertAlmostEqual(rows[0]["footprint_pixels"], 5000)
        self.assertAlmostEqual(sum(rows[0]["theta_i_shares"]), 1)
        self.assertAlmostEqual(sum(map(sum, rows[0]["theta_d_theta_h_shares"])), 1)
        self.assertAlmostEqual(rows[0]["share"] + rows[1]["share"], 1)
        text = run("profile", "show", profile).stdout.decode()
        self.assertIn("near", text)
        self.assertIn("@", text)

    def test_merge_adds_up(self):
        first, second = made(("near", retro(), 5000), ("far", far(), 3)), made(("near", retro()[:20], 10))
        both, turned = folder() / "both.prof", folder() / "turned.prof"
        self.succeed("profile", "merge", first, second, "-o", both)
        self.succeed("profile", "merge", second, first, "-o", turned)
        self.assertEqual(both.read_bytes(), turned.read_bytes())
        sums = read_profile(both.read_bytes())
        self.assertEqual(sums["near"].operations[0], len(retro()) + 20)
        self.assertEqual(sums["near"].footprint, 5010 * PIXEL_UNITS)
        self.assertEqual(write_profile(sums), both.read_bytes())
        self.fail_with(1, "profile", "merge", first, "-o", both, says="exists")
        self.fail_with(3, "profile", "merge", first, measured(), "-o", folder() / "x.prof", says="BRPF")
        self.fail_with(2, "profile", says="subcommand")
        with self.assertRaises(BadProfile):
            read_profile(both.read_bytes()[:-1])


if __name__ == "__main__":
    unittest.TestCase.maxDiff = None
    main()
