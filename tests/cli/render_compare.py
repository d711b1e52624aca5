#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdf-render compare: what exchanging a material does to a picture, beside its noise."""
import json
import signal
import struct
import subprocess
import time
import unittest
import zlib

from support.cli_harness import compressed, folder, main, program

RENDER = program("brdf-render")

SCENE = {
    "camera": {"position": [0, 1.6, 5], "target": [0, 0.9, 0], "fov": 30},
    "film": {"width": 48, "height": 36},
    "environment": {"type": "constant", "radiance": [0.8, 0.8, 0.8]},
    "materials": {
        "white": {"type": "lambert", "albedo": 0.9},
        "black": {"type": "lambert", "albedo": 0.001},
        "floor": {"type": "lambert", "albedo": 0.4},
        "idle": {"type": "lambert", "albedo": 0.4},
    },
    "shapes": [
        {"type": "sphere", "centre": [-0.7, 1, 0], "radius": 0.8, "material": "white"},
        {"type": "sphere", "centre": [0.9, 1, 0], "radius": 0.8, "material": "black"},
        {"type": "quad", "material": "floor", "corner": [-20, 0, 20], "edge_u": [40, 0, 0], "edge_v": [0, 0, -40]},
    ],
}


def scene():
    path = folder() / "scene.json"
    path.write_text(json.dumps(SCENE))
    return path


def render(*arguments):
    done = subprocess.run([RENDER, *map(str, arguments)], capture_output=True, timeout=300, check=False)
    done.stderr = done.stderr.decode()
    return done


def png_pixels(data):
    """Width, height and rows of RGB bytes of a PNG, by the standard library alone (PNG specification, sections 5 and 9)."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + size
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert (depth, colour, interlaced) == (8, 2, 0) and b"sRGB" in chunks
    raw, rows, above, step = zlib.decompress(chunks[b"IDAT"]), [], bytes(3 * width), 3 * width + 1
    for y in range(height):
        kind, row = raw[y * step], bytearray(raw[y * step + 1:(y + 1) * step])
        for i, value in enumerate(row):
            left, up, corner = (row[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
            nearest = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))[2]
            row[i] = (value + (0, left, up, (left + up) // 2, nearest)[kind]) & 255
        rows.append(bytes(row))
        above = row
    return width, height, rows


class RenderCompare(unittest.TestCase):
    def compare(self, *arguments):
        done = render("compare", scene(), "--json", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        document = json.loads(done.stdout)
        self.assertEqual(document["schema"], "brdf-render/compare/1")
        return document["rows"][0]

    def fail_with(self, code, *arguments, says):
        done = render("compare", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(says, done.stderr)

    def test_a_material_is_equal_to_itself(self):
        row = self.compare("--material", f"white={compressed()}", "--candidate", f"white={compressed()}", "--spp", "4")
        figures = row["figures"]
        self.assertEqual(figures["flip"]["value"], 0)
        self.assertEqual(figures["hdr_flip"]["value"], 0)
        self.assertEqual(figures["psnr"]["value"], 100)
        self.assertEqual(figures["ssim"]["value"], 1)
        self.assertEqual(figures["max_difference"]["value"], 0)
        self.assertEqual(row["mean_difference"]["value"], 0)
        self.assertEqual(row["candidates"][0]["candidate_bytes"], compressed().stat().st_size)

    def test_darker_and_brighter_candidates_have_their_signs(self):
        darker = self.compare("--candidate", f"white={compressed()}", "--spp", "8")
        brighter = self.compare("--candidate", f"black={compressed()}", "--spp", "8")
        for row, sign in ((darker, -1), (brighter, 1)):
            mean = row["mean_difference"]
            self.assertGreater(sign * mean["value"], 10 * mean["standard_deviation"])
            for name, figure in row["figures"].items():
                self.assertIsNotNone(figure["noise_floor"], name)
            self.assertGreater(row["figures"]["flip"]["value"], 2 * row["figures"]["flip"]["noise_floor"])
            self.assertLess(row["figures"]["psnr"]["value"], row["figures"]["psnr"]["noise_floor"])
            self.assertIsNotNone(row["figures"]["relative_mse"]["without_noise"])

    def test_more_samples_lower_the_floor_and_keep_the_figure(self):
        def mse(spp, seed):
            return self.compare("--candidate", f"white={compressed()}", "--spp", spp, "--seed", seed)["figures"]["mse"]
        few, many = [mse(4, seed) for seed in range(3)], mse(64, 0)
        # variance falls with the number of samples: a sixteenth, with room for chance
        self.assertLess(many["noise_floor"], few[0]["noise_floor"] / 8)
        # one estimate from 4 samples per pixel has a standard deviation of 5 %
        self.assertAlmostEqual(sum(f["without_noise"] for f in few) / 3 / many["without_noise"], 1, delta=0.1)

    def test_seed_and_threads(self):
        arguments = ["--candidate", f"white={compressed()}", "--spp", "4"]
        first = self.compare(*arguments, "--threads", "1")
        self.assertEqual(first["figures"], self.compare(*arguments, "--threads", "3")["figures"])
        self.assertNotEqual(first["figures"], self.compare(*arguments, "--seed", "1")["figures"])
        self.assertEqual(self.compare("--candidate", f"white={compressed()}", "--spp", "7")["spp"], 8)

    def test_pictures(self):
        png, prefix = folder() / "both.png", folder() / "both"
        arguments = ["--candidate", f"white={compressed()}", "--spp", "4", "--png", png, "--exr-prefix", prefix]
        figures = self.compare(*arguments)["figures"]
        width, height, rows = png_pixels(png.read_bytes())
        self.assertGreater(width, 4 * 240)
        self.assertGreater(height, 180)
        self.assertGreater(len({row[3 * x:3 * x + 3] for row in rows for x in range(width)}), 100)
        done = render("difference", f"{prefix}-reference.exr", f"{prefix}-candidate.exr", "--json")
        again = json.loads(done.stdout)["rows"][0]["figures"]
        for name, figure in again.items():
            self.assertAlmostEqual(figure["value"], figures[name]["value"], delta=1e-6, msg=name)
        self.assertTrue((folder() / "both-difference.exr").exists())
        self.assertTrue((folder() / "both-flip.exr").exists())
        before = png.read_bytes()
        self.fail_with(1, scene(), *arguments, says="exists")
        self.assertEqual(png.read_bytes(), before)

    def test_wrong_candidates_get_a_sentence(self):
        self.fail_with(2, scene(), "--candidate", f"gold={compressed()}", says="no material is called 'gold'")
        self.fail_with(2, scene(), "--candidate", f"idle={compressed()}", says="idle")
        self.fail_with(2, scene(), "--candidate", "white", says="SLOT=FILE")
        self.fail_with(2, scene(), "--candidate", f"white={compressed()}", "--candidate", f"white={compressed()}", says="twice")
        self.fail_with(2, scene(), "--candidate", f"white={compressed()},eval=slow", says="slow")
        self.fail_with(2, scene(), says="--candidate")
        self.fail_with(2, scene(), "--candidate", f"white={compressed()}", "--spp", "1", says="--spp")
        self.fail_with(3, scene(), "--candidate", "white=/nowhere.brdfc", says="/nowhere.brdfc")
        self.fail_with(3, scene(), "--candidate", f"white={scene()}", says="scene.json")

    def test_an_interruption_tells_and_writes_what_there_is(self):
        png = folder() / "interrupted.png"
        for wait in (3, 30, 90):  # the first passes of a busy machine may be longer than those of others
            running = subprocess.Popen([RENDER, "compare", scene(), "--candidate", f"white={compressed()}", "--spp", "1000000",
                                        "--png", png, "-f", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            time.sleep(wait)
            running.send_signal(signal.SIGINT)
            out, _ = running.communicate(timeout=120)
            self.assertEqual(running.returncode, 130)
            row = json.loads(out)["rows"][0]
            self.assertFalse(row["complete"])
            if row["spp"] >= 2:
                break
        self.assertGreaterEqual(row["spp"], 2)
        self.assertLess(row["spp"], 1000000)
        png_pixels(png.read_bytes())


class RenderDifference(unittest.TestCase):
    def test_wrong_pictures_get_a_sentence(self):
        picture = folder() / "a.exr"
        self.assertEqual(render(scene(), "-o", picture, "--spp", "1", "-f").returncode, 0)
        other = folder() / "other.exr"
        other.write_bytes(b"no picture")
        for arguments, code, says in (([picture, other], 3, "not an OpenEXR file"), ([picture, "/nowhere.exr"], 3, "/nowhere.exr"),
                                      ([picture], 2, "CANDIDATE"), ([picture, picture, "--png", picture], 2, "input itself")):
            done = render("difference", *arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    main()
