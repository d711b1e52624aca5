#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""eval, pdf and sample: formats, prefixes, repeatability, and agreement with each other."""
import math
import random

from support.cli_harness import CliTest, compressed, direction, floats, folder, main, measured, pack_floats


def random_rows(count, seed=1):
    """wi and wo above the horizon, flattened, as float32."""
    rng = random.Random(seed)
    values = []
    for _ in range(2 * count):
        z = 1 - rng.random()
        phi, r = 2 * math.pi * rng.random(), math.sqrt(1 - z * z)
        values += [r * math.cos(phi), r * math.sin(phi), z]
    return floats(pack_floats(values))


def as_csv(values, columns=6, separator=","):
    return "".join(separator.join(f"{v:.9g}" for v in values[i:i + columns]) + "\n"
                   for i in range(0, len(values), columns)).encode()


def csv_floats(data):
    """The numbers of a text answer, as float32."""
    return floats(pack_floats([float(v) for line in data.decode().splitlines() for v in line.split(",")]))


class Rows(CliTest):
    def test_text_and_binary_are_the_same_numbers(self):
        rows = random_rows(500)
        for material in [compressed(), measured()]:
            for verb, columns in [("eval", 3), ("pdf", 1)]:
                with self.subTest(verb=verb, material=material.name):
                    text = self.succeed(verb, material, stdin=as_csv(rows)).stdout
                    self.assertTrue(all(line.count(",") == columns - 1 for line in text.decode().splitlines()))
                    binary = self.succeed(verb, material, "--format", "f32", stdin=pack_floats(rows)).stdout
                    self.assertEqual(len(binary), 500 * columns * 4)
                    self.assertEqual(csv_floats(text), floats(binary))
                    self.assertTrue(all(math.isfinite(v) and v >= 0 for v in floats(binary)))
                    self.assertGreater(max(floats(binary)), 0)

    def test_more_rows_than_a_block(self):
        rows = random_rows(40000, seed=2)
        whole = floats(self.succeed("eval", compressed(), "--format", "f32", stdin=pack_floats(rows)).stdout)
        self.assertEqual(len(whole), 40000 * 3)
        tail = floats(self.succeed("eval", compressed(), "--format", "f32", stdin=pack_floats(rows[6 * 39990:])).stdout)
        self.assertEqual(whole[3 * 39990:], tail)

    def test_text_may_have_blanks_comments_and_windows_line_ends(self):
        rows = random_rows(3, seed=3)
        plain = self.succeed("eval", compressed(), stdin=as_csv(rows)).stdout
        lines = as_csv(rows, separator=" \t").decode().splitlines()
        dressed = ("# wi, wo\r\n\n" + "\r\n  \r\n".join(lines)).encode()  # the last line has no end
        self.assertEqual(self.succeed("eval", compressed(), stdin=dressed).stdout, plain)

    def test_malformed_text_names_the_line(self):
        good = "0,0,1,0,0,1\n"
        for bad in ["0,0,1,0,0\n", "0,0,1,0,0,1,5\n", "0,0,one,0,0,1\n", "0,0,1,0,,1\n", "0,0,1,0,0,1,\n",
                    "0,0,nan,0,0,1\n", "0,0,1,inf,0,1\n", "0,0,1e99,0,0,1\n", "0;0;1;0;0;1\n", "0,0,1x,0,0,1\n"]:
            with self.subTest(bad=bad):
                text = ("# comment\n" + good + bad + good).encode()
                self.fail_with(3, "eval", compressed(), stdin=text, says="line 3")
        self.fail_with(3, "eval", compressed(), stdin=b"7" * 100000, says="line 1")

    def test_malformed_binary_names_the_row(self):
        rows = list(random_rows(3, seed=4))
        arguments = ["eval", compressed(), "--format", "f32"]
        self.fail_with(3, *arguments, stdin=pack_floats(rows)[:-1], says="row 2")
        self.fail_with(3, *arguments, stdin=pack_floats(rows[:7]), says="row 1")
        rows[14] = math.nan
        self.fail_with(3, *arguments, stdin=pack_floats(rows), says="row 3")
        rows[14] = math.inf
        self.fail_with(3, *arguments, stdin=pack_floats(rows), says="row 3")

    def test_no_rows(self):
        for verb in ["eval", "pdf"]:
            self.assertEqual(self.succeed(verb, compressed(), stdin=b"").stdout, b"")
            self.assertEqual(self.succeed(verb, compressed(), "--format", "f32", stdin=b"").stdout, b"")
        self.assertEqual(self.succeed("sample", compressed(), "--wo", "0,0,1", "-n", 0).stdout, b"")

    def test_zero_at_and_below_the_horizon(self):
        up, level, down = (0, 0, 1), (1, 0, 0), (0.6, 0, -0.8)
        rows = [*up, *down, *down, *up, *level, *up, *up, *level, *down, *down, 0, 0, 0, *up, *up, *up]
        values = floats(self.succeed("eval", compressed(), "--format", "f32", stdin=pack_floats(rows)).stdout)
        self.assertEqual(values[:18], (0,) * 18)
        self.assertGreater(min(values[18:]), 0)

    def test_long_directions_are_scaled(self):
        wi, wo = direction(30, 20), direction(50, 200)
        unit = self.succeed("eval", measured(), stdin=as_csv([*wi, *wo])).stdout
        scaled = self.succeed("eval", measured(), stdin=as_csv([*(2 * v for v in wi), *(0.5 * v for v in wo)])).stdout
        for a, b in zip(csv_floats(unit), csv_floats(scaled)):
            self.assertAlmostEqual(a, b, delta=1e-4 * max(a, b))

    def test_levels_differ(self):
        rows = pack_floats(random_rows(200, seed=5))
        answers = {level: self.succeed("eval", compressed(), "--format", "f32", "--eval", level, stdin=rows).stdout
                   for level in ["fast", "balanced", "exact"]}
        self.assertEqual(len(set(answers.values())), 3)
        self.assertEqual(answers["balanced"], self.succeed("eval", compressed(), "--format", "f32", stdin=rows).stdout)

    def test_prefix(self):
        rows = pack_floats(random_rows(200, seed=6))
        info = self.report("info", compressed())[0]
        ends = [r["ends_at"] for r in info["refinements"]]
        self.assertGreater(len(ends), 1)
        whole = self.succeed("eval", compressed(), "--format", "f32", stdin=rows).stdout
        lobes = self.succeed("eval", compressed(), "--format", "f32", "--eval", "fast", stdin=rows).stdout
        coarse = self.succeed("eval", compressed(), "--format", "f32", "--prefix", ends[0], stdin=rows).stdout
        self.assertNotEqual(coarse, whole)
        self.assertEqual(coarse, lobes)  # the first boundary is after the lobes
        for prefix in [ends[-1], 10**9]:
            done = self.succeed("eval", compressed(), "--format", "f32", "--prefix", prefix, stdin=rows)
            self.assertEqual(done.stdout, whole)
        self.fail_with(2, "eval", compressed(), "--prefix", ends[0] + 1, says=["--prefix", str(ends[0])])
        cut = folder() / "cut_at_boundary.brdfc"
        cut.write_bytes(compressed().read_bytes()[:ends[0]])
        self.fail_with(3, "eval", cut)
        self.assertEqual(self.succeed("eval", cut, "--format", "f32", "--prefix", ends[0], stdin=rows).stdout, coarse)
        row = self.report("info", compressed(), "--prefix", ends[0])[0]
        self.assertEqual((row["refinements_read"], row["refinements_total"]), (0, len(ends) - 1))

    def test_sample_repeats_and_rows_stand_alone(self):
        for material in [compressed(), measured()]:
            arguments = ["sample", material, "--wo=-0.48,0.36,0.8", "--format", "f32"]
            ten = self.succeed(*arguments, "-n", 10, "--seed", 7).stdout
            self.assertEqual(len(ten), 10 * 7 * 4)
            self.assertEqual(self.succeed(*arguments, "-n", 10, "--seed", 7).stdout, ten)
            self.assertEqual(self.succeed(*arguments, "-n", 3, "--seed", 7).stdout, ten[:3 * 28])
            self.assertNotEqual(self.succeed(*arguments, "-n", 10, "--seed", 8).stdout, ten)
            text = self.succeed("sample", material, "--wo=-0.48,0.36,0.8", "-n", 10, "--seed", 7).stdout
            self.assertEqual(csv_floats(text), floats(ten))
        many = self.succeed("sample", compressed(), "--wo", "0,0,1", "-n", 40000, "--seed", 1, "--format", "f32").stdout
        few = self.succeed("sample", compressed(), "--wo", "0,0,1", "-n", 16385, "--seed", 1, "--format", "f32").stdout
        self.assertEqual(many[:len(few)], few)

    def test_sample_agrees_with_pdf_and_eval(self):
        wo = floats(pack_floats((0.6, 0.0, 0.8)))
        for material in [compressed(), measured()]:
            data = floats(self.succeed("sample", material, "--wo", "0.6,0,0.8", "-n", 2000, "--seed", 3,
                                       "--format", "f32").stdout)
            drawn = [data[i:i + 7] for i in range(0, len(data), 7)]
            accepted = [row for row in drawn if row[3] > 0]
            self.assertGreater(len(accepted), 1000)
            for row in drawn:
                if row[3] <= 0:
                    self.assertEqual(row[3:], (0, 0, 0, 0))
            pairs = pack_floats([v for row in accepted for v in (*row[:3], *wo)])
            pdf = floats(self.succeed("pdf", material, "--format", "f32", stdin=pairs).stdout)
            f = floats(self.succeed("eval", material, "--format", "f32", stdin=pairs).stdout)
            for k, row in enumerate(accepted):
                self.assertAlmostEqual(math.hypot(*row[:3]), 1, delta=1e-5)
                self.assertGreater(row[2], 0)
                self.assertAlmostEqual(pdf[k] / row[3], 1, delta=1e-2)
                for c in range(3):
                    weight = f[3 * k + c] * row[2] / row[3]
                    self.assertAlmostEqual(row[4 + c], weight, delta=1e-2 * max(weight, 1e-3))

    def test_view_below_the_horizon_is_all_rejected(self):
        data = floats(self.succeed("sample", compressed(), "--wo=0,0,-1", "-n", 5, "--format", "f32").stdout)
        self.assertEqual([data[i + 3:i + 7] for i in range(0, len(data), 7)], [(0, 0, 0, 0)] * 5)


if __name__ == "__main__":
    main()
