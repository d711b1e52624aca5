#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compress keeps its promises about size, error, overwriting and repeatability."""
import os
import signal
import subprocess
import time

from support.cli_harness import BRDF_COMPRESS, CliTest, compressed, folder, main, measured, run


class Compress(CliTest):
    def compress(self, name, *options):
        path = folder() / name
        return path, self.report("compress", measured(), "-o", path, "-f", "--preset", "fastest", *options)[0]

    def test_target_size_is_never_exceeded(self):
        for size in [150, 400, 1000, 3000]:
            with self.subTest(size=size):
                path, row = self.compress("sized.brdfc", "--target-size", size)
                self.assertLessEqual(path.stat().st_size, size)
                self.assertEqual(path.stat().st_size, row["bytes"])

    def test_target_size_holds_with_provenance(self):
        path, _ = self.compress("sized.brdfc", "--target-size", 500, "--provenance")
        self.assertLessEqual(path.stat().st_size, 500)

    def test_impossible_size(self):
        out = folder() / "impossible.brdfc"
        arguments = ["compress", measured(), "-o", out, "--preset", "fastest", "--target-size", 10]
        done = self.fail_with(4, *arguments, says="10")
        self.assertRegex(done.stderr, r"smallest\D*\d+ bytes")
        self.assertFalse(out.exists())

    def test_target_error_is_met(self):
        path, row = self.compress("good.brdfc", "--target-error", "log_mae=0.01")
        errors = self.report("compare", measured(), path)[0]
        self.assertLessEqual(errors["log_mae"], 0.01 * 1.05)
        self.assertEqual(row["target_metric"], "log_mae")

    def test_impossible_error(self):
        out = folder() / "impossible.brdfc"
        self.fail_with(4, "compress", measured(), "-o", out, "--preset", "fastest", "--target-error", "log_mae=0",
                       says="log_mae")
        self.assertFalse(out.exists())

    def test_nothing_is_overwritten_unasked(self):
        path = folder() / "precious.brdfc"
        path.write_bytes(b"precious")
        self.fail_with(1, "compress", measured(), "-o", path, "--preset", "fastest", says=["exists", "-f"])
        self.assertEqual(path.read_bytes(), b"precious")
        self.succeed("compress", measured(), "-o", path, "--preset", "fastest", "-f")
        self.assertNotEqual(path.read_bytes(), b"precious")

    def test_output_that_cannot_be_written(self):
        arguments = ["compress", measured(), "--preset", "fastest", "-f", "-o"]
        self.fail_with(1, *arguments, folder() / "no_such_folder" / "a.brdfc", says="no_such_folder")
        self.fail_with(1, *arguments, folder(), says="directory")
        self.fail_with(1, *arguments, "/dev/full", says="/dev/full")
        if os.geteuid() != 0:
            locked = folder() / "locked"
            locked.mkdir(mode=0o500)
            self.fail_with(1, *arguments, locked / "a.brdfc", says="locked")

    def test_same_bytes_for_any_number_of_threads(self):
        one, _ = self.compress("one.brdfc", "--threads", 1)
        three, _ = self.compress("three.brdfc", "--threads", 3)
        self.assertEqual(one.read_bytes(), three.read_bytes())

    def test_report(self):
        path, row = self.compress("report.brdfc", "--provenance")
        self.assertEqual(row["effort"], 0)
        self.assertEqual(row["preset"], "fastest")
        self.assertGreater(row["ratio"], 1000)
        self.assertTrue(any(lobe["kept"] for lobe in row["lobes"]))
        self.assertTrue(all(lobe["reason"] for lobe in row["lobes"]))
        self.assertTrue(row["stop_reason"])
        self.assertEqual({e["level"] for e in row["errors"]}, {"fast", "balanced", "exact"})
        self.assertEqual(self.report("info", path)[0]["name"], "sample")

    def test_messages(self):
        path = folder() / "talk.brdfc"
        arguments = ["compress", measured(), "-o", path, "-f", "--preset", "fastest"]
        quiet, usual, much = run(*arguments, "-q"), run(*arguments), run(*arguments, "-v")
        self.assertEqual([d.returncode for d in (quiet, usual, much)], [0, 0, 0])
        self.assertEqual(quiet.stderr, "")
        self.assertIn("bytes", usual.stderr)
        self.assertIn("kept", much.stderr)
        self.assertEqual(quiet.stdout + usual.stdout + much.stdout, b"")
        self.assertNotIn("\r", usual.stderr)  # a progress bar is for terminals

    def test_interrupt_leaves_nothing(self):
        place = folder() / "interrupted"
        place.mkdir()
        arguments = ["compress", measured(), "-o", place / "a.brdfc", "--preset", "exhaustive"]
        child = subprocess.Popen([BRDF_COMPRESS, *arguments], stderr=subprocess.DEVNULL)
        time.sleep(1)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.wait(timeout=120), 130)
        self.assertEqual(list(place.iterdir()), [])


if __name__ == "__main__":
    compressed()
    main()
