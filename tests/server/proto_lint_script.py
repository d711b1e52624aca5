#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""server/proto under buf's standard rules, where $BRDF_BUF names the program (tests/run --long installs it from npm)."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUF = os.environ.get("BRDF_BUF")
PROTO = pathlib.Path(os.environ.get("BRDF_SOURCE_DIR", ".")) / "server" / "proto"


def lint(folder):
    return subprocess.run([BUF, "lint"], cwd=folder, capture_output=True, text=True, timeout=120, check=False)


class ProtoLint(unittest.TestCase):
    def test_standard_rules(self):
        done = lint(PROTO)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_violation_is_found(self):
        with tempfile.TemporaryDirectory() as name:
            copy = pathlib.Path(name) / "proto"
            shutil.copytree(PROTO, copy)
            file = copy / "brdf" / "v1" / "brdf_service.proto"
            file.write_text(file.read_text().replace("rpc GetMaterial(", "rpc get_material("))
            self.assertIn("PascalCase", lint(copy).stdout)


if __name__ == "__main__":
    if not BUF:
        print("BRDF_BUF is not set")
        sys.exit(77)
    unittest.main()
