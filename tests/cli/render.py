#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdf-render: pictures, exit codes, sentences, interruption."""
import json
import signal
import subprocess
import time
import unittest

from support.cli_harness import compressed, folder, main, measured, program

BRDF_RENDER = program("brdf-render")
SCENE = {
    "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fov": 30},
    "film": {"width": 24, "height": 20},
    "environment": {"type": "sky", "width": 32},
    "materials": {"m": {"type": "lambert", "albedo": 0.5}},
    "shapes": [{"type": "sphere", "material": "m"}],
}


def call(*arguments, stdout=subprocess.PIPE):
    done = subprocess.run([BRDF_RENDER, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE,
                          timeout=300, check=False)
    done.stderr = done.stderr.decode()
    return done


def scene(name="scene.json", **changes):
    path = folder() / name
    path.write_text(json.dumps({**SCENE, **changes}), encoding="utf-8")
    return path


class Render(unittest.TestCase):
    def succeed(self, *arguments):
        done = call(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fail_with(self, code, *arguments, says=()):
        done = call(*arguments)
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr!r}")
        self.assertTrue(done.stderr.startswith("brdf-render: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, done.stderr)

    def out(self, name):
        path = folder() / name
        path.unlink(missing_ok=True)
        return path

    def test_the_verb_may_be_left_out(self):
        first, second = self.out("a.exr"), self.out("b.exr")
        self.succeed(scene(), "-o", first, "--spp", 2)
        self.succeed("render", scene(), "-o", second, "--spp", 2)
        self.assertEqual(first.read_bytes()[:4], b"\x76\x2f\x31\x01")
        self.assertEqual(second.read_bytes()[:4], b"\x76\x2f\x31\x01")

    def test_png_and_report(self):
        png = self.out("a.png")
        done = self.succeed(scene(), "-o", self.out("a.exr"), "--png", png, "--spp", 3, "--threads", 2, "--seed", 5, "--json")
        self.assertEqual(png.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        document = json.loads(done.stdout)
        self.assertEqual(document["schema"], "brdf-render/render/1")
        row = document["rows"][0]
        self.assertEqual((row["width"], row["height"], row["spp"], row["seed"], row["threads"]), (24, 20, 3, 5, 2))
        self.assertTrue(row["complete"])
        self.assertEqual(row["paths"], 24 * 20 * 3)
        for key in ("vertices", "rays", "ns_per_vertex", "rays_per_second", "mean_luminance", "seconds", "processor_seconds"):
            self.assertGreater(row[key], 0, key)
        self.assertEqual(row["materials"], [{"slot": "m", "source": "lambert", "bytes": 0}])

    def test_threads_do_not_change_the_mean(self):
        means = set()
        for threads in (1, 2, 3):
            done = self.succeed(scene(), "-o", self.out("t.exr"), "--spp", 5, "--threads", threads, "--json")
            means.add(json.loads(done.stdout)["rows"][0]["mean_luminance"])
        self.assertEqual(len(means), 1)

    def test_measured_and_compressed_materials(self):
        text = scene("file.json", materials={"m": {"type": "file", "file": ["absent.binary", measured().name]}})
        rows = {}
        for name, extra in {"raw": [], "compressed": ["--material", f"m={compressed()},eval=exact"]}.items():
            done = self.succeed(text, "-o", self.out("m.exr"), "--spp", 16, "--json", *extra)
            rows[name] = json.loads(done.stdout)["rows"][0]
        self.assertEqual(rows["raw"]["materials"][0]["bytes"], measured().stat().st_size)
        self.assertEqual(rows["compressed"]["materials"][0]["bytes"], compressed().stat().st_size)
        self.assertAlmostEqual(rows["raw"]["mean_luminance"] / rows["compressed"]["mean_luminance"], 1, delta=0.05)

    def test_exported_scene_is_the_same_picture(self):
        parts = [
            {"type": "sphere", "material": "file", "radius": 0.5, "transform": [{"scale": 2}, {"translate": [0, 0.2, 0]}]},
            {"type": "blob", "material": "m", "segments": 12, "amplitude": 0.3, "flat": True, "transform": [{"translate": [1.2, 0, 0]}]},
            {"type": "lathe", "material": "glass", "segments": 16, "profile": [[0, -1], [0.6, -0.4], [0, 1]]},
            {"type": "quad", "material": "m", "corner": [-1, 2, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2], "emission": 3},
        ]
        original = scene("parts.json", shapes=parts, lights=[{"type": "directional", "direction": [0, -1, -1], "irradiance": 2}],
                         environment={"type": "sky", "width": 32, "rotation": 90, "lamps": [{"direction": [1, 1, 0]}]},
                         path={"max_depth": 5, "roulette_depth": 2},
                         materials={"m": {"type": "ggx", "alpha": 0.3, "f0": [0.9, 0.5, 0.1]}, "glass": {"type": "dielectric", "ior": 1.4},
                                    "file": {"type": "file", "file": compressed().name, "eval": "fast"},
                                    "unused": {"type": "file", "file": "nowhere.binary"}})
        target = folder() / "exported"
        self.succeed("export", original, "-o", target)
        described = json.loads((target / "scene.json").read_text(encoding="utf-8"))
        self.assertEqual({s["type"] for s in described["shapes"]}, {"sphere", "ply"})
        self.assertEqual(described["environment"]["type"], "map")
        pictures = [self.out("original.exr"), self.out("exported.exr")]
        for source, picture in zip((original, target / "scene.json"), pictures):
            self.succeed(source, "-o", picture, "--spp", 16)
        row = json.loads(self.succeed("difference", *pictures, "--json").stdout)["rows"][0]
        self.assertLess(row["figures"]["max_difference"]["value"], 1e-4)
        self.fail_with(1, "export", original, "-o", target, says="exists already")
        self.succeed("export", original, "-o", target, "-f")
        self.fail_with(2, "export", original, says="--output")
        self.fail_with(2, "export", original, "-o", target, "-f", "--material", f"n={compressed()}", says="'n'")
        self.fail_with(3, "export", scene("bad.json", shapes=[]), "-o", target, "-f", says="no shape")

    def test_incident_direction(self):
        original = scene("file.json", materials={"m": {"type": "file", "file": measured().name, "incident": "viewer"}})
        self.succeed(original, "-o", self.out("i.exr"), "--spp", 1)
        self.fail_with(2, original, "-o", self.out("i.exr"), "--material", f"m={compressed()},incident=viewer", says="measured files")
        self.fail_with(2, original, "-o", self.out("i.exr"), "--material", f"m={measured()},incident=both", says="both")

    def test_bad_command_lines(self):
        out = self.out("never.exr")
        for arguments, word in [
            ([], "subcommand"),
            ([scene()], "--output"),
            ([scene(), "-o", out, "--spp", "0"], "spp"),
            ([scene(), "-o", out, "--spp", "many"], "many"),
            ([scene(), "-o", out, "--sampling", "dice"], "dice"),
            ([scene(), "-o", out, "--seed", "-1"], "-1"),
            ([scene(), "-o", out, "--exposure", "nan"], "exposure"),
            ([scene(), "-o", out, "--png", out], "same name"),
            ([scene(), "-o", out, "--material", "m"], "SLOT=FILE"),
            ([scene(), "-o", out, "--material", f"n={compressed()}"], "'n'"),
            ([scene(), "-o", out, "--material", f"m={compressed()},eval=slow"], "slow"),
            ([scene(), "-o", out, "--material", f"m={compressed()},prefix=7"], "7 bytes"),
            ([scene(), "-o", scene(), "-f"], "input itself"),
        ]:
            with self.subTest(arguments=arguments):
                self.fail_with(2, *arguments, says=word)
        self.assertFalse(out.exists())

    def test_bad_scenes(self):
        out = self.out("never.exr")
        self.fail_with(3, folder() / "absent.json", "-o", out, says=["absent.json", "No such file"])
        self.fail_with(3, scene("bad.json", shapes=[{"type": "sphere", "material": "gold"}]), "-o", out,
                       says=["bad.json: shapes[0].material", "'gold'"])
        self.fail_with(3, scene("bad.json", lamps=[]), "-o", out, says="'lamps'")
        self.fail_with(3, scene("bad.json", shapes=[{"type": "ply", "material": "m", "file": "a.ply"}]), "-o", out, says=["shapes[0]", "a.ply"])
        self.fail_with(3, scene("bad.json", materials={"m": {"type": "file", "file": "bad.json"}}), "-o", out, says="materials.m")
        self.fail_with(3, scene(), "-o", out, "--material", "m=absent.brdfc", says="absent.brdfc")
        (folder() / "nan.json").write_text(json.dumps({**SCENE, "film": {"width": float("nan"), "height": 3}}), encoding="utf-8")
        self.fail_with(3, folder() / "nan.json", "-o", out, says="nan.json:1:")
        self.assertFalse(out.exists())

    def test_outputs_that_cannot_be(self):
        kept = folder() / "kept.exr"
        kept.write_bytes(b"old")
        self.fail_with(1, scene(), "-o", kept, says="exists already")
        self.assertEqual(kept.read_bytes(), b"old")
        self.succeed(scene(), "-o", kept, "-f", "--spp", 1)
        self.fail_with(1, scene(), "-o", folder() / "none" / "a.exr", says="none")
        self.fail_with(1, scene(), "-o", folder(), says="directory")

    def test_interrupt_writes_what_there_is(self):
        out, png = self.out("cut.exr"), self.out("cut.png")
        for wait in (2, 20, 60):  # the first pass of a busy machine may be longer than that of others
            child = subprocess.Popen([BRDF_RENDER, scene(), "-o", out, "-f", "--png", png, "--spp", "1000000", "--json"], stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            time.sleep(wait)
            child.send_signal(signal.SIGINT)
            stdout, stderr = child.communicate(timeout=120)
            self.assertEqual(child.returncode, 130, stderr)
            row = json.loads(stdout)["rows"][0]
            self.assertFalse(row["complete"])
            if row["spp"] >= 1:
                break
        self.assertGreaterEqual(row["spp"], 1)
        self.assertEqual(out.read_bytes()[:4], b"\x76\x2f\x31\x01")
        self.assertEqual(png.read_bytes()[:4], b"\x89PNG")

    def test_help_and_version(self):
        top = self.succeed("--help").stdout.decode()
        self.assertIn("render", top)
        self.assertIn("Exit codes", top)
        self.assertIn("Examples:", self.succeed("render", "--help").stdout.decode())
        self.assertRegex(self.succeed("--version").stdout.decode(), r"^brdf-render \d+\.\d+\.\d+\n$")

    def test_full_stdout(self):
        with open("/dev/full", "wb") as full:
            done = call(scene(), "-o", self.out("f.exr"), "--spp", 1, "--json", stdout=full)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("standard output", done.stderr)


if __name__ == "__main__":
    main()
