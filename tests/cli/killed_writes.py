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


def wait_for_write(child, place):
    """Until the program has a file of this folder open, with a name or without; Linux only."""
    fds = f"/proc/{child.pid}/fd"
    while child.poll() is None:
        try:
            if any(os.readlink(f"{fds}/{fd}").startswith(f"{place}/") for fd in os.listdir(fds)):
                return
        except OSError:
            pass  # closed while it was looked at, or ended
        time.sleep(0.0005)


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

    def killed_after(self, number, wait, existing, from_write):
        """Starts over an old file or none, kills, and returns what is wrong with what is left and whether the kill came in
        time. `wait` counts from the start, or from the moment at which the write begins."""
        place = folder() / f"{self.name}-{number}"
        place.mkdir()
        out = place / "out.brdfc"
        if existing:
            out.write_bytes(OLD)
        child = subprocess.Popen([BRDF_COMPRESS, *map(str, self.arguments), "-o", str(out), "-q", "-f"],
                                 stderr=subprocess.DEVNULL)
        if from_write:
            wait_for_write(child, place)
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
        begin = "the write began" if from_write else "the start"
        return [f"{self.name} killed {wait:.4f} s after {begin}: {w}" for w in wrong], in_time


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
            # half of them anywhere, half while the file is written
            from_write = draw.random() < 0.5
            wait = draw.uniform(0, 0.05) if from_write else draw.uniform(0, 1.5) * writer.seconds
            jobs.append((writer, number, wait, draw.random() < 0.5, from_write))
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
