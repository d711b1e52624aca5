#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brdf-render difference says of two pictures what NVIDIA's flip-evaluator and OpenImageIO's idiff say of them.

$BRDF_IMAGE_PEERS names a Python environment with the packages flip-evaluator and openimageio; `tests/run --all --long` makes one.
Without it what is installed on the system is used, and what is not is skipped."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import metric_pictures

SKIPPED = 77
RENDER = os.environ.get("BRDF_RENDER")
if not RENDER:
    print("BRDF_RENDER is not set")
    sys.exit(SKIPPED)
PEERS = os.environ.get("BRDF_IMAGE_PEERS")
PYTHON = str(pathlib.Path(PEERS) / "bin/python") if PEERS else sys.executable
IDIFF = str(pathlib.Path(PEERS) / "bin/idiff") if PEERS else shutil.which("idiff")


class ImagePeers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="brdf-peers-")
        cls.pictures = [pathlib.Path(cls.folder.name) / name for name in ("reference.exr", "candidate.exr")]
        for path, rows in zip(cls.pictures, metric_pictures.pictures()):
            path.write_bytes(metric_pictures.exr_bytes(rows))
        done = subprocess.run([RENDER, "difference", *cls.pictures, "--json"], check=True, capture_output=True)
        row = json.loads(done.stdout)["rows"][0]
        cls.figures = {name: figure["value"] for name, figure in row["figures"].items()}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_flip_evaluator(self):
        if subprocess.run([PYTHON, "-c", "import flip_evaluator"], capture_output=True, check=False).returncode != 0:
            self.skipTest("flip-evaluator (PyPI) is not installed")
        done = subprocess.run([PYTHON, metric_pictures.__file__], check=True, capture_output=True)
        theirs = json.loads(done.stdout)
        self.assertAlmostEqual(self.figures["flip"], theirs["flip"], delta=2e-5)
        self.assertAlmostEqual(self.figures["hdr_flip"], theirs["hdr_flip"], delta=2e-5)

    def test_idiff(self):
        if not IDIFF or not os.path.exists(IDIFF):
            self.skipTest("idiff is not installed (openimageio-tools of Debian, or openimageio of PyPI)")
        done = subprocess.run([IDIFF, *self.pictures], check=False, capture_output=True, text=True)
        for name, figure in (("Mean error", "mean_absolute"), ("Max error", "max_difference")):
            theirs = float(re.search(rf"{name}\s*=\s*(\S+)", done.stdout).group(1))
            self.assertAlmostEqual(self.figures[figure] / theirs, 1, delta=1e-5, msg=done.stdout)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    ran = program.result.testsRun - len(program.result.skipped)
    sys.exit(SKIPPED if ran == 0 and program.result.wasSuccessful() else not program.result.wasSuccessful())
