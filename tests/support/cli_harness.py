# SPDX-License-Identifier: Apache-2.0
"""What the tests of the command line share: running the programs, and files made by them."""
import atexit
import functools
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
MERL_CELLS = 90 * 90 * 180
MERL_BYTES = 12 + 3 * 8 * MERL_CELLS


def program(name):
    """Path of a program that CTest names in the environment; without it nothing can be tested."""
    variable = name.upper().replace("-", "_")
    path = os.environ.get(variable)
    if not path:
        print(f"{variable} is not set")
        sys.exit(SKIPPED)
    return path


BRDF_COMPRESS = program("brdf-compress")


def run(*arguments, stdin=b"", stdout=subprocess.PIPE, timeout=300):
    """Runs brdf-compress; stdout and stderr are bytes and text."""
    done = subprocess.run([BRDF_COMPRESS, *map(str, arguments)], input=stdin, stdout=stdout, stderr=subprocess.PIPE,
                          timeout=timeout, check=False)
    done.stderr = done.stderr.decode()
    return done


@functools.cache
def folder():
    """A folder for this process, removed at its end."""
    path = pathlib.Path(tempfile.mkdtemp(prefix="brdf-cli-"))
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


@functools.cache
def measured():
    """A measured file of no one's property, from the simulated gonioreflectometer."""
    path = folder() / "sample.binary"
    subprocess.run([program("brdf-gonio"), "sample", "-o", path], check=True, stderr=subprocess.DEVNULL)
    return path


@functools.cache
def compressed():
    """The same, compressed."""
    path = folder() / "sample.brdfc"
    done = run("compress", measured(), "-o", path, "--preset", "fastest", "--target-size", 1024, "-q")
    assert done.returncode == 0, done.stderr
    return path


def floats(data):
    return struct.unpack(f"<{len(data) // 4}f", data)


def pack_floats(values):
    return struct.pack(f"<{len(values)}f", *values)


def direction(theta, phi):
    """Unit vector; degrees."""
    t, p = math.radians(theta), math.radians(phi)
    return math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)


class CliTest(unittest.TestCase):
    """Assertions about a run."""

    def succeed(self, *arguments, **options):
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fail_with(self, code, *arguments, says=(), **options):
        """Runs and expects an exit code and one sentence on stderr that has every word of `says`."""
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr!r}")
        self.assertTrue(done.stderr.startswith("brdf-compress: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, done.stderr)
        return done

    def report(self, verb, *arguments, code=0):
        """Rows of a --json report, its envelope checked."""
        done = run(verb, *arguments, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        document = json.loads(done.stdout)
        self.assertEqual(set(document), {"schema", "rows"})
        self.assertEqual(document["schema"], f"brdf-compress/{verb}/1")
        self.assertGreater(len(document["rows"]), 0)
        return document["rows"]


def main():
    unittest.main(verbosity=1)
