#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""model writes analytic materials, and every other verb takes them or says why not."""
import functools
import math

from support.cli_harness import CliTest, direction, floats, folder, main, pack_floats, run

MODELS = {
    "lambert": ["lambert", "--albedo", ".5,.25,.125"],
    "brushed": ["ggx", "--alpha-x", ".1", "--alpha-y", ".4", "--f0", ".9,.7,.4"],
    "rough": ["ggx", "--alpha", ".6", "--f0", ".8", "--multiple-scattering"],
    "mirror": ["mirror", "--reflectance", ".9,.8,.7"],
    "glass": ["dielectric", "--ior", "1.5"],
}


@functools.cache
def made(name):
    path = folder() / f"{name}.brdfc"
    done = run("model", *MODELS[name], "-o", path, "-q")
    assert done.returncode == 0, done.stderr
    return path


class Models(CliTest):
    def test_info_tells_the_parameters(self):
        row = self.report("info", made("brushed"))[0]
        self.assertEqual(row["model"]["kind"], "ggx")
        self.assertAlmostEqual(row["model"]["alpha_y"], 0.4, 6)
        self.assertEqual(len(row["model"]["f0"]), 3)
        self.assertFalse(row["model"]["multiple_scattering"])
        self.assertEqual(row["refinements_total"], 0)
        self.assertAlmostEqual(self.report("info", made("glass"))[0]["model"]["ior"], 1.5)
        text = self.succeed("info", made("glass")).stdout.decode()
        self.assertIn("dielectric, ior 1.5", text)

    def test_files_are_small(self):
        for name in MODELS:
            self.assertLessEqual(made(name).stat().st_size, 24 + 1 + 5 * 4, name)

    def test_verify_passes(self):
        for name in MODELS:
            rows = self.report("verify", made(name))
            self.assertTrue(all(row["ok"] for row in rows), name)
            checks = {row["check"] for row in rows}
            delta = name in ("mirror", "glass")
            self.assertEqual("pdf integrates to 1" in checks, not delta)
            self.assertEqual("directions obey reflection and refraction" in checks, delta)

    def test_eval_and_pdf(self):
        rows = pack_floats([*direction(30, 0), *direction(40, 90), *direction(100, 0), *direction(40, 90)])
        f = floats(self.succeed("eval", made("lambert"), "--format", "f32", stdin=rows).stdout)
        self.assertAlmostEqual(f[0], 0.5 / math.pi, 6)
        self.assertEqual(f[3:], (0, 0, 0))
        p = floats(self.succeed("pdf", made("lambert"), "--format", "f32", stdin=rows).stdout)
        self.assertAlmostEqual(p[0], math.cos(math.radians(30)) / math.pi, 6)
        for name in ("mirror", "glass"):
            f = floats(self.succeed("eval", made(name), "--format", "f32", stdin=rows).stdout)
            self.assertEqual(set(f), {0.0})

    def test_samples_of_glass_from_inside(self):
        out = floats(self.succeed("sample", made("glass"), "--wo=0.6,0,-0.8", "-n", 200, "--format", "f32").stdout)
        rows = [out[k:k + 7] for k in range(0, len(out), 7)]
        through = [row for row in rows if row[2] > 0]
        self.assertTrue(0 < len(through) < len(rows))
        for row in through:
            self.assertAlmostEqual(row[0], -0.9, 6)
            self.assertAlmostEqual(row[4], 2.25, 5)  # radiance: 1 / eta^2 with eta = 1 / 1.5
        for row in rows:
            if row[2] < 0:
                self.assertAlmostEqual(row[2], -0.8, 6)
                self.assertEqual(row[4], 1)

    def test_what_has_no_meaning(self):
        never = folder() / "never.brdfc"
        for arguments, word in [
            ([], ""),
            (["marble"], "subcommand"),
            (["lambert"], "--albedo"),
            (["lambert", "--albedo", "1.5"], "albedo"),
            (["lambert", "--albedo", "nan"], "albedo"),
            (["lambert", "--albedo", ".5,.5"], "wavelengths"),
            (["ggx", "--f0", ".5"], "--alpha"),
            (["ggx", "--f0", ".5", "--alpha-x", ".1"], "--alpha"),
            (["ggx", "--f0", ".5", "--alpha", ".1", "--alpha-x", ".1"], "--alpha"),
            (["ggx", "--f0", ".5", "--alpha", "0"], "alpha_x"),
            (["ggx", "--f0", ".5", "--alpha-x", ".1", "--alpha-y", ".2", "--multiple-scattering"], "multiple scattering"),
            (["dielectric", "--ior", "0"], "ior"),
            (["dielectric", "--ior", "1.5", "--channels", "2"], "2 channels"),
        ]:
            self.fail_with(2, "model", *arguments, "-o", never, says=word)
            self.assertFalse(never.exists())
        self.fail_with(1, "model", *MODELS["glass"], "-o", made("glass"), says="exists")

    def test_what_other_verbs_refuse(self):
        self.fail_with(3, "bench", made("glass"), says="measured")
        for name in ("mirror", "glass", "brushed"):
            self.fail_with(3, "decompress", made(name), "-o", folder() / "never.binary", says="table")
        self.succeed("decompress", made("lambert"), "-o", folder() / "lambert.binary", "-q")

    def test_spectral(self):
        path = folder() / "spectral.brdfc"
        self.succeed("model", "ggx", "--alpha", ".2", "--f0", ".1,.2,.3,.4", "--wavelengths", "400,500,600,700", "-o", path)
        row = self.report("info", path)[0]
        self.assertEqual(row["wavelengths_nm"], [400, 500, 600, 700])
        self.assertEqual(len(row["lobes"]), 1)


if __name__ == "__main__":
    main()
