# SPDX-License-Identifier: Apache-2.0
"""The preview ball, rendered by brdf-render and by Mitsuba 3."""
import dataclasses
import json
import os
import pathlib
import subprocess

RENDER = os.environ.get("BRDF_RENDER")
PEERS = os.environ.get("BRDF_RENDER_PEERS")
ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = pathlib.Path(os.environ.get("BRDF_SHARED", ROOT.parent / "shared")) / "data"


@dataclasses.dataclass
class Rendered:
    picture: pathlib.Path
    seconds: float            # of rendering alone, without loading
    processor_seconds: float  # of all threads together


def run(*command):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: exit code {done.returncode}: {done.stderr}")
    return done.stdout


def call_peer(*arguments):
    """Runs mitsuba_scene.py in the environment of Mitsuba; what it printed."""
    text = run(pathlib.Path(PEERS) / "bin/python", ROOT / "tests/support/mitsuba_scene.py", *arguments)
    return json.loads(text[text.rindex("{"):]) if text else None  # its log, in colours, comes before


class Ball:
    """data/scenes/ball.json with one measured file in its slot, in a folder of its own."""

    def __init__(self, folder, material, incident, size):
        self.folder = pathlib.Path(folder) / f"{pathlib.Path(material).stem}_{incident}"
        self.scene = self.folder / "scene.json"
        run(RENDER, "export", ROOT / "data/scenes/ball.json", "-o", self.folder, "-f", "--material", f"ball={material},incident={incident}")
        described = json.loads(self.scene.read_text(encoding="utf-8"))
        described["film"] = {"width": size, "height": size}
        self.scene.write_text(json.dumps(described), encoding="utf-8")

    def ours(self, spp, seed, threads=2, name="ours", extra=()):
        picture = self.folder / f"{name}_{seed}.exr"
        text = run(RENDER, self.scene, "-o", picture, "-f", "--json", "--spp", spp, "--seed", seed, "--threads", threads, *extra)
        row = json.loads(text)["rows"][0]
        return Rendered(picture, row["seconds"], row["processor_seconds"])

    def theirs(self, spp, seed, threads=2):
        picture = self.folder / f"theirs_{seed}.exr"
        figures = call_peer(self.scene, "--spp", spp, "--seed", seed, "--threads", threads, "-o", picture)
        return Rendered(picture, figures["seconds"], figures["processor_seconds"])
