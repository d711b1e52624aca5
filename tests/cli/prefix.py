#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""--prefix on every verb that reads a material, at every boundary of a small and of a larger file."""
import functools

from support.cli_harness import CliTest, direction, floats, folder, main, measured, pack_floats, run


@functools.cache
def files():
    """Of few and of several refinements."""
    out = []
    for size in [300, 3000]:
        path = folder() / f"prefix{size}.brdfc"
        done = run("compress", measured(), "-o", path, "--preset", "fastest", "--target-size", size, "-q")
        assert done.returncode == 0, done.stderr
        out.append(path)
    return out


def merit(row):
    """What the search for a file of a size raises; log_mae enters in decibels."""
    import math
    return (row["psnr_env"] + row["psnr_lights"] - 20 * math.log10(row["log_mae"])) / 3


class Prefix(CliTest):
    def boundaries(self, path):
        return [r["ends_at"] for r in self.report("info", path)[0]["refinements"]]

    def test_every_boundary_says_k_of_n(self):
        for path in files():
            ends = self.boundaries(path)
            for k, end in enumerate(ends):
                row = self.report("info", path, "--prefix", end)[0]
                self.assertEqual((row["refinements_read"], row["refinements_total"]), (k, len(ends) - 1))
                self.assertIn(f"{k} of {len(ends) - 1}", self.succeed("info", path, "--prefix", end).stdout.decode())
        self.assertGreaterEqual(len(self.boundaries(files()[1])), 3)

    def test_every_boundary_is_better_than_the_one_before(self):
        for path in files():
            before = None
            for k, end in enumerate(self.boundaries(path)):
                row = self.report("compare", measured(), path, "--prefix", end)[0]
                self.assertEqual(row["refinements_read"], k)
                self.assertEqual(row["bytes"], end)
                if before is not None:
                    self.assertGreater(merit(row), merit(before))
                before = row

    def test_every_boundary_verifies(self):
        path = files()[1]
        for end in self.boundaries(path):
            rows = self.report("verify", path, "--prefix", end, "--against", measured())
            self.assertTrue(all(row["ok"] for row in rows), [row for row in rows if not row["ok"]])

    def test_where(self):
        path = files()[1]
        ends = self.boundaries(path)
        rows = self.report("where", measured(), path, "--prefix", ends[1])
        self.assertEqual([r["part"] for r in rows if "part" in r], ["lobes", "refinement 1"])

    def test_rows(self):
        path = files()[1]
        ends = self.boundaries(path)
        pair = pack_floats([*direction(30, 0), *direction(35, 170)])
        values = set()
        for end in ends:
            for verb in ["eval", "pdf"]:
                done = self.succeed(verb, path, "--prefix", end, "--format", "f32", stdin=pair)
                if verb == "eval":
                    values.add(floats(done.stdout))
            self.succeed("sample", path, "--prefix", end, "--wo", "0,0,1", "-n", 4, "--seed", 1)
        self.assertGreater(len(values), 1)
        out = folder() / "cut.binary"
        self.succeed("decompress", path, "-o", out, "-f", "--prefix", ends[0])

    def test_other_lengths_are_refused(self):
        path = files()[0]
        for verb, more in [("info", []), ("verify", []), ("eval", []), ("pdf", []), ("compare", [path]), ("where", [path])]:
            self.fail_with(2, verb, path, *more, "--prefix", self.boundaries(path)[0] + 1, says="refinements")


if __name__ == "__main__":
    main()
