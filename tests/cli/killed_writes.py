#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Killed at 200 random moments, brdf-compress leaves the old file or the whole new one, and nothing else that anybody could
take for a file."""
import concurrent.futures
import os
import random
import signal
import subprocess
import time

from support.cli_harness import BRDF_COMPRESS, CliTest, compressed, folder, main, run
from support.small_rgl import small_rgl

OLD = b"the file that was there before\n"
KILLS = 200
SEED = 20240607


class Writer:
    """A command that writes one file, run in a folder of its own."""

    def __init__(self, name, *arguments):
        self.name, self.arguments = name, arguments
        whole = folder() / f"{name}.whole"
        start = time.monotonic()
        done = run(*arguments, "-o", whole, "-q")
        assert done.returncode == 0, done.stderr
        self.seconds = time.monotonic() - start
        self.whole = whole.read_bytes()

    def killed_after(self, number, wait, existing):
        """Starts over an old file or none, kills, and returns what is wrong with what is left, the name that the output has
        had, and whether the kill came in time."""
        place = folder() / f"{self.name}-{number}"
        place.mkdir()
        out = place / "out.brdfc"
        if existing:
            out.write_bytes(OLD)
        child = subprocess.Popen([BRDF_COMPRESS, *map(str, self.arguments), "-o", str(out), "-q", "-f"],
                                 stderr=subprocess.DEVNULL)
        time.sleep(wait)
        child.send_signal(signal.SIGKILL)
        in_time = child.wait() == -signal.SIGKILL
        wrong = []
        left = sorted(os.listdir(place))
        if not out.exists():
            if existing or not in_time:
                wrong.append("the output is missing")
        else:
            data = out.read_bytes()
            if data == OLD:
                state = "old"
            elif data == self.whole:
                state = "new"
            else:
                state = "partial"
                wrong.append(f"the output has {len(data)} bytes that are neither the old file nor the new one")
            if not in_time and state != "new":
                wrong.append(f"the program ended by itself and left the {state} file")
        for name in left:
            # a temporary is hidden, ends in .tmp, and so is no material to any list of files
            if name != "out.brdfc" and not (name.startswith(".") and name.endswith(".tmp")):
                wrong.append(f"{name} is left behind")
        for name in left:
            (place / name).unlink()
        place.rmdir()
        return [f"{self.name} killed after {wait:.4f} s: {w}" for w in wrong], in_time


class KilledWrites(CliTest):
    def test_no_partial_file_is_ever_visible(self):
        table = folder() / "small.bsdf"
        table.write_bytes(small_rgl())
        writers = [Writer("compress", "compress", table, "--preset", "fastest", "--target-size", 200),
                   Writer("decompress", "decompress", compressed())]
        draw = random.Random(SEED)
        jobs = []
        for number in range(KILLS):
            writer = writers[number % len(writers)]
            # half of them anywhere, half around the end, where the file is written; two at a time are slower than one was
            moment = draw.uniform(0, 1.2) if draw.random() < 0.5 else draw.uniform(0.7, 2.2)
            jobs.append((writer, number, moment * writer.seconds, draw.random() < 0.5))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda job: job[0].killed_after(*job[1:]), jobs))
        wrong = [sentence for found, _ in results for sentence in found]
        self.assertEqual(wrong, [])
        in_time = sum(killed for _, killed in results)
        print(f"{in_time} of {KILLS} runs were killed before they ended")
        self.assertGreater(in_time, KILLS // 20, "the test killed next to nothing")
        self.assertLess(in_time, KILLS, "no run came to its end, so none was near it")


if __name__ == "__main__":
    main()
