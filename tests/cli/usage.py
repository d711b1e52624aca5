#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Command lines without meaning end with exit code 2 and one sentence; help and version go to stdout."""
import os

from support.cli_harness import CliTest, compressed, folder, main, measured, run

VERBS = ["compress", "model", "decompress", "convert", "info", "verify", "compare", "where", "bench", "eval", "sample", "pdf", "profile", "plan"]


class Usage(CliTest):
    def test_help_of_every_verb_has_examples(self):
        top = self.succeed("--help").stdout.decode()
        for verb in VERBS:
            self.assertIn(verb, top)
            text = self.succeed(verb, "--help").stdout.decode()
            self.assertIn("Examples:", text)
            self.assertIn(f"brdf-compress {verb} ", text)

    def test_version(self):
        self.assertRegex(self.succeed("--version").stdout.decode(), r"^brdf-compress \d+\.\d+\.\d+\n$")

    def test_help_of_compress_lists_the_presets(self):
        text = self.succeed("compress", "--help").stdout.decode()
        for preset in ["fastest", "fast", "medium", "thorough", "exhaustive"]:
            self.assertIn(preset, text)

    def test_no_or_unknown_verb(self):
        self.fail_with(2)
        self.fail_with(2, "squeeze")
        self.fail_with(2, "info")
        self.fail_with(2, "info", "a", "b")
        self.fail_with(2, "info", "a", "--colour")

    def test_bad_values_are_named(self):
        out = folder() / "never.brdfc"
        for arguments, word in [
            (["--preset", "best"], "best"),
            (["--effort", "101"], "101"),
            (["--effort", "-1"], "-1"),
            (["--effort", "10", "--preset", "fast"], "preset"),
            (["--target-size", "many"], "many"),
            (["--target-error", "beauty=3"], "beauty"),
            (["--target-error", "log_mae"], "log_mae"),
            (["--target-error", "log_mae=nan"], "nan"),
            (["--target-error", "log_mae=-1"], "-1"),
            (["--target-error", "log_mae=0.1", "--target-size", "500"], "target"),
            (["--eval", "slow"], "slow"),
            (["--reciprocity", "maybe"], "maybe"),
            (["--position", "middle"], "middle"),
            (["--threads", "-2"], "-2"),
            (["-q", "-v"], "quiet"),
        ]:
            with self.subTest(arguments=arguments):
                self.fail_with(2, "compress", "in.binary", "-o", out, *arguments, says=word)
        self.assertFalse(out.exists())

    def test_bad_wo(self):
        for wo in ["1,2", "1,2,3", "0,0,0", "0,0,1,0", "a,b,c", "nan,0,1", "0,0,1.01"]:
            with self.subTest(wo=wo):
                self.fail_with(2, "sample", compressed(), f"--wo={wo}", "-n", 1, says="--wo")
        self.fail_with(2, "sample", compressed(), "--wo", "0,0,1", says="--count")

    def test_bad_counts(self):
        for n in ["-5", "1e3", "18446744073709551616", "many"]:
            with self.subTest(n=n):
                self.fail_with(2, "sample", compressed(), "--wo", "0,0,1", f"--count={n}", says=n)
                self.fail_with(2, "eval", compressed(), f"--prefix={n}", says=n)
                self.fail_with(2, "compress", measured(), "-o", folder() / "never.brdfc", f"--target-size={n}", says=n)
                self.fail_with(2, "bench", measured(), f"--sizes=100,{n}", says=n)
        self.fail_with(2, "bench", measured(), "--presets", "fast,quick", says="quick")

    def test_the_output_may_not_be_the_input(self):
        before = measured().read_bytes()
        self.fail_with(2, "compress", measured(), "-o", measured(), "-f", says="input itself")
        self.assertEqual(measured().read_bytes(), before)

    def test_full_and_closed_stdout(self):
        for arguments in [["--help"], ["info", compressed()], ["info", compressed(), "--json"],
                          ["sample", compressed(), "--wo", "0,0,1", "-n", "100000"]]:
            with self.subTest(arguments=arguments):
                with open("/dev/full", "wb") as full:
                    done = run(*arguments, stdout=full)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("standard output", done.stderr)
                reader, writer = os.pipe()
                os.close(reader)
                done = run(*arguments, stdout=writer)
                os.close(writer)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("standard output", done.stderr)


if __name__ == "__main__":
    main()
