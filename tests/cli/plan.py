#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdf-render --profile, and brdf-compress plan: choices, files, and what it says of them."""
import json
import subprocess
import unittest

from support.cli_harness import CliTest, folder, main, measured, program, run
from support.profile_file import read_profile

RENDER = program("brdf-render")
SIZES = ["--sizes", "64,200", "--preset", "fastest", "--profile-spp", "4", "--spp", "4"]


def scene():
    path = folder() / "scene.json"
    path.write_text(json.dumps({
        "camera": {"position": [0, 1.6, 5], "target": [0, 0.9, 0], "fov": 30},
        "film": {"width": 48, "height": 36},
        "environment": {"type": "constant", "radiance": [0.8, 0.8, 0.8]},
        "materials": {
            "ball": {"type": "file", "file": str(measured())},
            "far": {"type": "file", "file": str(measured())},
            "hidden": {"type": "file", "file": str(measured())},
            "floor": {"type": "lambert", "albedo": 0.4},
        },
        "shapes": [
            {"type": "sphere", "centre": [0, 1, 0], "radius": 0.9, "material": "ball"},
            {"type": "sphere", "centre": [8, 1, -25], "radius": 0.5, "material": "far"},
            {"type": "sphere", "centre": [0, 1, 40], "radius": 0.3, "material": "hidden"},
            {"type": "quad", "material": "floor", "corner": [-20, 0, 20], "edge_u": [40, 0, 0], "edge_v": [0, 0, -40]},
        ],
    }))
    return path


class Plan(CliTest):
    def plan(self, *arguments):
        done = run("plan", scene(), *SIZES, *arguments, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads(done.stdout)["rows"]
        return {r["slot"]: r for r in rows}

    def output(self, name):
        path = folder() / name
        path.mkdir(exist_ok=True)
        return path

    def test_a_profile_tells_slots_apart(self):
        path = folder() / "scene.prof"
        done = subprocess.run([RENDER, scene(), "--profile", path, "--spp", "8"], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        slots = read_profile(path.read_bytes())
        self.assertIn("ball", slots)
        self.assertGreater(slots["ball"].footprint, 20 * slots["far"].footprint)
        self.assertNotIn("hidden", slots)
        shown = run("profile", "show", path, "--json")
        self.assertEqual(shown.returncode, 0, shown.stderr)

    def test_a_budget_is_kept_and_goes_where_the_scene_looks(self):
        out = self.output("files")
        rows = self.plan("--budget", 264, "-o", out, "-f")
        whole = rows.pop(None)
        self.assertLessEqual(whole["bytes"], 264)
        self.assertEqual(whole["bytes"], sum(r["bytes"] for r in rows.values()))
        self.assertGreater(rows["ball"]["bytes"], rows["far"]["bytes"])
        self.assertNotIn("floor", rows)
        for r in rows.values():
            path = out / f"{r['slot']}.brdfc"
            self.assertEqual(str(path), r["file"])
            self.assertEqual(path.stat().st_size, r["bytes"])
            info = self.report("info", path)[0]
            self.assertIsNotNone(info["fitted_for"])
        # what was promised is what another rendering finds
        done = subprocess.run([RENDER, "compare", scene(), "--spp", "4", "--json",
                               *[x for r in rows.values() for x in ("--candidate", f"{r['slot']}={r['file']},eval={r['level']}")]],
                              capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["rows"][0]["figures"]["flip"]["value"]
        self.assertAlmostEqual(found, whole["flip"]["value"], delta=1e-6)

    def test_a_flip_target_is_met_by_the_picture(self):
        out = self.output("close")
        rows = self.plan("--target-flip", 0.05, "-o", out, "-f")
        self.assertLessEqual(rows[None]["flip"]["value"], 0.05)

    def test_a_dry_run_writes_nothing(self):
        before = sorted(folder().rglob("*"))
        rows = self.plan("--target-ns", 5000, "--dry-run")
        self.assertNotIn("flip", rows[None])
        self.assertGreater(rows[None]["ns_per_eval"], 0)
        self.assertEqual(sorted(folder().rglob("*")), before)

    def test_what_cannot_be_met_writes_nothing(self):
        out = self.output("none")
        done = run("plan", scene(), *SIZES, "--budget", 20, "-o", out)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(list(out.iterdir()), [])

    def test_usage(self):
        for arguments, says in [([], "exactly one of"), (["--budget", 100, "--target-ns", 5], "exactly one of"), (["--budget", 100], "--output"),
                                (["--budget", 100, "-o", folder() / "nowhere"], "no such folder"), (["--target-flip", 0.1, "--dry-run"], "rendering")]:
            done = run("plan", scene(), *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    main()
