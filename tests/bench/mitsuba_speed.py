#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Time of Mitsuba 3, scalar_rgb, on the preview ball against brdf-render with the same file as a raw table and compressed.

usage: BRDF_RENDER=... BRDF_COMPRESS=... BRDF_RENDER_PEERS=... tests/bench/mitsuba_speed.py [--file NAME] [--size PIXELS] [--spp N]
                                                                 [--threads T] [--rounds R] [--bytes B | --compressed FILE] [--json OUT]
Equal picture size, samples, depth, roulette and threads; loading is not counted. The three take turns, so that what else the machine
does meets all alike, and of each the fastest round counts. Prints rows of a Markdown table."""
import argparse
import json
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support import mitsuba_peer  # noqa: E402


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--file", default="vch_golden_yellow_rgb.bsdf", help="an RGL file of $BRDF_SHARED/data/rgl")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2, help="at least 2; with 1 Mitsuba waits for ever")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--bytes", type=int, default=2048, help="of the compressed file")
    parser.add_argument("--compressed", type=pathlib.Path, help="a .brdfc of the same file, instead of making one")
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    compress = os.environ.get("BRDF_COMPRESS")
    source = mitsuba_peer.SHARED / "rgl" / arguments.file
    if not (compress and mitsuba_peer.RENDER and mitsuba_peer.PEERS and source.exists()):
        sys.exit("needs $BRDF_RENDER, $BRDF_COMPRESS, $BRDF_RENDER_PEERS and " + str(source))

    with tempfile.TemporaryDirectory(prefix="brdf-mitsuba-") as folder:
        small = arguments.compressed or pathlib.Path(folder) / "small.brdfc"
        if not arguments.compressed:
            mitsuba_peer.run(compress, "compress", source, "-o", small, "--target-size", arguments.bytes, "-q")
        ball = mitsuba_peer.Ball(folder, source, "light", arguments.size)
        compressed = ["--material", f"ball={small},eval=balanced"]
        runs = {
            "Mitsuba 3 `scalar_rgb`, `measured`": lambda seed: ball.theirs(arguments.spp, seed, arguments.threads),
            "brdf-render, raw table": lambda seed: ball.ours(arguments.spp, seed, arguments.threads),
            f"brdf-render, {small.stat().st_size} bytes at balanced": lambda seed: ball.ours(arguments.spp, seed, arguments.threads, "small", compressed),
        }
        rounds = {name: [] for name in runs}
        for seed in range(arguments.rounds):
            for name, render in runs.items():
                rounds[name].append(render(seed))

    rows = []
    for name, results in rounds.items():
        row = {"what": name, "seconds": min(r.seconds for r in results), "processor_seconds": min(r.processor_seconds for r in results)}
        row["paths_per_processor_second"] = arguments.size**2 * arguments.spp / row["processor_seconds"]
        row["speed"] = rows[0]["processor_seconds"] / row["processor_seconds"] if rows else 1.0
        row["speed_wall"] = rows[0]["seconds"] / row["seconds"] if rows else 1.0
        rows.append(row)
    settings = {key: getattr(arguments, key) for key in ("file", "size", "spp", "threads", "rounds")}
    if arguments.json:
        arguments.json.write_text(json.dumps({"settings": settings, "rows": rows}, indent=2) + "\n", encoding="utf-8")
    print(f"{arguments.file}, {arguments.size} x {arguments.size}, {arguments.spp} spp, {arguments.threads} threads, best of {arguments.rounds}\n")
    print("| renderer | wall s | processor s | 1000 paths per processor second | speed by processor time | by wall time |\n|---|---|---|---|---|---|")
    for r in rows:
        print(f"| {r['what']} | {r['seconds']:.2f} | {r['processor_seconds']:.2f} | {r['paths_per_processor_second'] / 1000:.0f} | {r['speed']:.2f} | {r['speed_wall']:.2f} |")


if __name__ == "__main__":
    main()
