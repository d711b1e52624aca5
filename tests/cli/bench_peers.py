#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench: the peers that it compares with, the plots, and the committed baseline's verdicts."""
import contextlib
import csv
import io
import json
import os
import random
import struct
import subprocess
import unittest
import zipfile

from bench import baseline
from support.cli_harness import CliTest, folder, main, measured, run

QUICK = ["--presets", "fastest", "--sizes", "400"]


def npz(name, arrays):
    """A NumPy archive, made without NumPy."""
    path = folder() / name
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for array, weights in arrays.items():
            header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({len(weights)},), }}".ljust(117) + "\n"
            data = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
            archive.writestr(array + ".npy", data + struct.pack(f"<{len(weights)}f", *weights))
    return path


def network(count=675):
    """Weights of no one's network; the last three are biases of the output, log(1 + f) of a grey."""
    draw = random.Random(3)
    return [draw.uniform(-0.02, 0.02) for _ in range(count - 3)] + [0.1, 0.1, 0.1]


def has_matplotlib():
    return any(subprocess.run([python, "-c", "import matplotlib"], capture_output=True, check=False).returncode == 0
               for python in ("python3", "/usr/bin/python3") if os.path.exists(python) or "/" not in python)


class Peers(CliTest):
    def test_the_raw_table_is_read_in_batches_and_one_by_one(self):
        row = self.report("bench", measured(), *QUICK)[0]
        self.assertTrue(0 < row["raw_eval_ns"] < row["raw_eval_ns_scalar"])
        self.assertTrue(0 < row["pdf_ns"] < row["pdf_ns_scalar"])
        self.assertGreater(row["log_mae_85_90"], 0)
        text = self.succeed("bench", measured(), *QUICK, "--against", "raw").stdout.decode()
        self.assertIn("times faster", text)
        self.assertIn("scalar raw", text)

    def test_a_network_is_a_row_of_its_own(self):
        sheet = folder() / "neural.csv"
        rows = self.report("bench", measured(), *QUICK, "--against", "raw,neural", "--networks",
                           npz("other.npz", {"nobody": network()}), "--networks", npz("own.npz", {"sample": network()}),
                           "--csv", sheet)
        self.assertEqual([row["preset"] for row in rows], ["fastest", "neural"])
        row = rows[1]
        self.assertEqual(list(row), list(rows[0]))
        self.assertEqual((row["material"], row["bytes"], row["bugs"]), ("sample", 2700, 0))
        for key in ["effort", "target", "eval_level", "encode_s", "decode_us", "pdf_ns", "sample_ns", "sample_ns_scalar"]:
            self.assertIsNone(row[key], key)
        for key in ["eval_ns", "eval_ns_scalar", "raw_eval_ns", "log_mae", "psnr_env", "psnr_lights", "albedo_error"]:
            self.assertGreater(row[key], 0, key)
        table = list(csv.DictReader(io.StringIO(sheet.read_text())))
        self.assertEqual((table[1]["preset"], table[1]["encode_s"], table[1]["bytes"]), ("neural", "", "2700"))

    def test_what_a_network_may_lack(self):
        def bench(*arguments, code, says):
            done = run("bench", measured(), *QUICK, "--against", "neural", *arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            return done.stdout.decode()

        bench("--networks", folder() / "missing.npz", code=3, says="missing.npz")
        bench("--networks", measured(), code=3, says="zip")
        # the compressed material is measured all the same
        self.assertIn("fastest", bench("--networks", npz("a.npz", {"nobody": network()}), code=5, says="no network"))
        self.assertIn("fastest", bench("--networks", npz("b.npz", {"sample": network(674)}), code=5, says="674"))
        self.fail_with(2, "bench", measured(), "--against", "nothing")

    def test_the_published_networks_score_as_published(self):
        data = os.path.join(os.environ.get("BRDF_SHARED", "../shared"), "data")
        file = os.path.join(data, "rgl", "vch_golden_yellow_rgb.bsdf")
        if not os.path.exists(file):
            self.skipTest(f"{file} is absent")
        row = self.report("bench", file, *QUICK, "--against", "neural")[1]
        self.assertAlmostEqual(row["psnr_env"], 42.8, delta=0.1)
        self.assertAlmostEqual(row["psnr_lights"], 32.0, delta=0.1)
        self.assertAlmostEqual(row["log_mae"], 0.0023, delta=0.0001)

    def test_plots(self):
        if not has_matplotlib():
            self.skipTest("matplotlib is absent")
        plots = folder() / "plots"
        arguments = ["bench", measured(), "--presets", "fastest", "--sizes", "300,900", "--against", "raw,neural",
                     "--networks", npz("plot.npz", {"sample": network()}), "--plots", plots]
        self.succeed(*arguments)
        self.assertEqual(len(json.loads((plots / "tradeoff.json").read_text())["rows"]), 3)
        for name in ["error-bytes", "error-ns"]:
            self.assertTrue((plots / f"{name}.png").read_bytes().startswith(b"\x89PNG"))
            self.assertIn("<svg", (plots / f"{name}.svg").read_text())
        self.fail_with(1, *arguments, says="exists")

    def test_plots_say_at_once_what_is_missing(self):
        self.fail_with(1, "bench", measured(), "--plots", measured(), says="folder")
        done = run("bench", measured(), *QUICK, "--plots", folder() / "none", "-q")
        if not has_matplotlib():
            self.assertEqual(done.returncode, 1)
            self.assertIn("matplotlib", done.stderr)


class Baseline(unittest.TestCase):
    def test_verdicts(self):
        for figure, now, then, expected in [
                ("log_mae", 0.001, 0.001, "PASS"), ("log_mae", 0.0008, 0.001, "PASS"), ("log_mae", 0.00101, 0.001, "WARN"),
                ("log_mae", 0.0011, 0.001, "FAIL"), ("psnr_env", 40, 40, "PASS"), ("psnr_env", 39.9, 40, "WARN"),
                ("psnr_env", 39, 40, "FAIL"), ("bugs", 1, 0, "FAIL"), ("bugs", 0, 0, "PASS"), ("bytes", 530, 500, "FAIL"),
                ("eval_ns", 90, 0.5, "WARN"), ("eval_ns", 0.6, 0.5, "PASS")]:
            self.assertEqual(baseline.verdict(figure, now, then)[0], expected, (figure, now, then))

    def test_the_committed_rows_hold_every_figure(self):
        rows = json.loads(baseline.BASELINE.read_text())["rows"]
        self.assertEqual(len(rows), 12)
        for row in rows:
            self.assertEqual(list(row), baseline.KEYS + list(baseline.LIMITS))
        with contextlib.redirect_stdout(io.StringIO()) as lines:
            self.assertEqual(baseline.compare(rows, rows)["WARN"], 0)
            self.assertEqual(baseline.compare(rows[1:], rows)["FAIL"], len(baseline.LIMITS))
        self.assertEqual(len(lines.getvalue().splitlines()), 2 * len(rows) * len(baseline.LIMITS))


if __name__ == "__main__":
    main()
