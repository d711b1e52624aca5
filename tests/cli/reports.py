#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""info, verify, compare and bench: keys and plausibility of what they report."""
import csv
import io
import subprocess

from support.cli_harness import CliTest, compressed, folder, main, measured, program, run

BENCH_KEYS = """material preset effort target eval_level bytes ratio ratio_native encode_s decode_us resident_bytes
eval_ns eval_ns_scalar pdf_ns pdf_ns_scalar sample_ns sample_ns_scalar raw_eval_ns raw_eval_ns_scalar log_mae
log_mae_0_60 log_mae_60_75 log_mae_75_85 log_mae_85_90 log_mae_p95 log_mae_max psnr_env psnr_lights albedo_error simd
threads version bugs""".split()


class Reports(CliTest):
    def test_info_of_a_measured_file(self):
        row = self.report("info", measured())[0]
        self.assertEqual((row["kind"], row["format"], row["channels"]), ("measured", "MERL", 3))
        self.assertEqual(row["cells"], 90 * 90 * 180)
        self.assertEqual(row["numbers"], 3 * row["cells"])
        self.assertEqual(row["file_bytes"], measured().stat().st_size)
        self.assertTrue(0 < row["invalid_fraction"] < 0.5)
        self.assertTrue(0 < row["max_albedo"] < 1.5)
        self.assertRegex(row["content_hash"], "^[0-9a-f]{16}$")
        self.assertIn(row["content_hash"], self.succeed("info", measured()).stdout.decode())

    def test_info_of_a_compressed_file(self):
        row = self.report("info", compressed())[0]
        self.assertEqual(row["kind"], "compressed")
        self.assertEqual(row["total_bytes"], compressed().stat().st_size)
        self.assertEqual(row["refinements_read"], row["refinements_total"])
        self.assertEqual([r["refinement"] for r in row["refinements"]], list(range(row["refinements_total"] + 1)))
        ends = [r["ends_at"] for r in row["refinements"]]
        self.assertEqual(ends, sorted(set(ends)))
        self.assertEqual(set(row["resident_bytes"]), {"fast", "balanced", "exact"})
        self.assertLess(row["resident_bytes"]["fast"], row["resident_bytes"]["exact"])
        self.assertEqual(set(row["temporary_bytes"]), {"fast", "balanced", "exact"})
        self.assertGreaterEqual(row["temporary_bytes"]["exact"], row["temporary_bytes"]["fast"])
        self.assertTrue(all(lobe["kind"] in ("lambert", "ggx", "retro_ggx") for lobe in row["lobes"]))
        self.assertIn("ends at byte", self.succeed("info", compressed()).stdout.decode())

    def test_verify_passes(self):
        rows = self.report("verify", compressed(), "--against", measured())
        self.assertTrue(all(row["ok"] for row in rows), [row for row in rows if not row["ok"]])
        names = {row["check"] for row in rows}
        for name in ["every prefix decodes", "pdf integrates to 1", "samples follow pdf (chi-squared p)",
                     "log_mae is as recorded"]:
            self.assertIn(name, names)

    def test_verify_notices_another_source(self):
        other = folder() / "other.binary"
        surface = [line.split()[0] for line in self.surfaces()][-1]
        self.gonio("sample", "-o", other, "--surface", surface)
        rows = self.report("verify", compressed(), "--against", other, code=1)
        self.assertTrue(any(row["check"] == "log_mae is as recorded" and not row["ok"] for row in rows))
        done = run("verify", compressed(), "--against", other)
        self.assertEqual(done.returncode, 1)
        self.assertIn("checks failed", done.stderr)
        other.unlink()

    def gonio(self, *arguments):
        command = [program("brdf-gonio"), *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True)

    def surfaces(self):
        return self.gonio("sample", "--list").stdout.splitlines()

    def test_compare(self):
        row = self.report("compare", measured(), compressed())[0]
        self.assertTrue(0 < row["log_mae"] < 0.2, row["log_mae"])
        self.assertTrue(10 < row["psnr_env"] <= 60)
        self.assertEqual((row["not_finite"], row["negative"]), (0, 0))
        self.assertGreaterEqual(row["log_mae_max"], row["log_mae_p95"])
        exact = self.report("compare", measured(), compressed(), "--eval", "exact")[0]
        fast = self.report("compare", measured(), compressed(), "--eval", "fast")[0]
        self.assertLess(exact["log_mae"], fast["log_mae"])
        same = self.report("compare", compressed(), compressed())[0]
        self.assertEqual((same["log_mae"], same["cbrt_rms"], same["psnr_env"]), (0, 0, 60))

    def test_where(self):
        rows = self.report("where", measured(), compressed())
        parts = [row for row in rows if "part" in row]
        bands = [row for row in rows if "perfect" in row]
        self.assertEqual(parts[0]["part"], "lobes")
        self.assertLessEqual(sum(part["bytes"] for part in parts), compressed().stat().st_size)
        self.assertTrue(all(part["bytes"] > 0 for part in parts))
        self.assertEqual(bands[0]["perfect"], "none")
        self.assertEqual({row["perfect"] for row in bands}, {"none", "theta_h", "theta_d", "theta_max", "channel"})
        for row in bands[1:]:  # a part that is perfect cannot add to the error
            self.assertLessEqual(row["log_mae"], bands[0]["log_mae"] * (1 + 1e-9))
        self.assertLess(min(row["log_mae"] for row in bands), 0.95 * bands[0]["log_mae"])
        # the bands of one axis share the whole error out between them
        for axis in ["theta_h", "theta_d", "theta_max"]:
            gains = sum(bands[0]["log_mae"] - row["log_mae"] for row in bands if row["perfect"] == axis)
            self.assertAlmostEqual(gains, bands[0]["log_mae"], delta=1e-6 * bands[0]["log_mae"])
        self.assertIn("if perfect", self.succeed("where", measured(), compressed()).stdout.decode())

    def test_bench(self):
        sheet, page = folder() / "rows.csv", folder() / "table.md"
        rows = self.report("bench", measured(), "--presets", "fastest", "--sizes", "300,1000", "--eval", "all",
                           "--csv", sheet, "--markdown", page)
        self.assertEqual(len(rows), 6)
        for row in rows:
            self.assertEqual(set(BENCH_KEYS) - set(row), set())
            self.assertEqual(row["bugs"], 0)
            self.assertLessEqual(row["bytes"], row["target"])
            self.assertEqual(row["preset"], "fastest")
            for key in ["eval_ns", "eval_ns_scalar", "pdf_ns", "sample_ns", "sample_ns_scalar", "raw_eval_ns",
                        "decode_us", "encode_s", "resident_bytes"]:
                self.assertGreater(row[key], 0, key)
        self.assertEqual({row["eval_level"] for row in rows}, {"fast", "balanced", "exact"})
        table = list(csv.DictReader(io.StringIO(sheet.read_text())))
        self.assertEqual([int(r["bytes"]) for r in table], [r["bytes"] for r in rows])
        self.assertEqual(list(table[0]), list(rows[0]))
        text = page.read_text()
        self.assertIn("brdf-compress bench", text)
        self.assertEqual(sum(line.startswith("| sample |") for line in text.splitlines()), 6)
        self.fail_with(1, "bench", measured(), "--presets", "fastest", "--csv", sheet, says="exists")

    def test_bench_says_what_failed_and_goes_on(self):
        done = run("bench", measured(), folder() / "missing.binary", "--presets", "fastest", "--sizes", "20,600",
                   "--against", "raw")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("missing.binary", done.stderr)
        text = done.stdout.decode()
        self.assertIn("times faster", text)
        self.assertEqual(sum(line.startswith("sample ") for line in text.splitlines()), 1)

    def test_bench_of_several_materials_has_mean_and_worst(self):
        text = self.succeed("bench", measured(), measured(), "--presets", "fastest", "--sizes", "400").stdout.decode()
        lines = [line.split() for line in text.splitlines()]
        self.assertEqual([line[0] for line in lines[1:]], ["sample", "sample", "mean", "worst"])


if __name__ == "__main__":
    main()
