#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Full disks, missing permissions and read-only folders: exit code 1, one sentence that names the file, nothing left behind."""
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import unittest

from support.cli_harness import BRDF_COMPRESS, CliTest, compressed, folder, main
from support.small_rgl import small_rgl

NOBODY = 65534


def call(*arguments, before=None, wrapper=()):
    """brdf-compress with something done to its process first, or started by another program."""
    return subprocess.run([*wrapper, BRDF_COMPRESS, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, preexec_fn=before, timeout=300, check=False)


def table():
    path = folder() / "small.bsdf"
    if not path.exists():
        path.write_bytes(small_rgl())
    return path


def writers():
    """Verbs that write a file, without the output."""
    return [("compress", table(), "--preset", "fastest", "--target-size", 200), ("decompress", compressed()), ("convert", table())]


class RefusedWrites(CliTest):
    def refused(self, done, *words):
        sentence = done.stderr.decode()
        self.assertEqual(done.returncode, 1, sentence)
        self.assertTrue(sentence.startswith("brdf-compress: "), sentence)
        self.assertEqual(sentence.count("\n"), 1, sentence)
        for word in words:
            self.assertIn(str(word), sentence)

    def place(self, name):
        path = folder() / name
        path.mkdir()
        return path

    def test_device_that_is_full(self):
        for verb in writers():
            with self.subTest(verb=verb[0]):
                self.refused(call(*verb, "-o", "/dev/full", "-f"), "/dev/full", "No space left")

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "wb") as full:
            for verb in (["info", compressed()], ["verify", compressed()], ["sample", compressed(), "--wo", "0,0,1", "-n", "9"]):
                done = subprocess.run([BRDF_COMPRESS, *map(str, verb)], stdout=full, stderr=subprocess.PIPE, check=False)
                self.refused(done, "standard output", "No space left")

    def test_file_larger_than_the_user_may_write(self):
        place = self.place("limited")
        for verb in writers():
            for old in (None, b"old"):
                with self.subTest(verb=verb[0], old=old):
                    out = place / "out.brdfc"
                    out.unlink(missing_ok=True)
                    if old:
                        out.write_bytes(old)
                    done = call(*verb, "-o", out, "-f", before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64)))
                    self.refused(done, out, "too large")
                    self.assertEqual([p.name for p in place.iterdir()], ["out.brdfc"] if old else [])
                    if old:
                        self.assertEqual(out.read_bytes(), old)

    def mounted(self, options, fill, *arguments):
        """Runs with a small file system of its own on `disk`; skips where that is not allowed. Prints what is left there."""
        disk = folder() / "disk"
        disk.mkdir(exist_ok=True)
        script = (f'mount -t tmpfs -o {options} tmpfs "$0" 2>/dev/null || exit 77; {fill} "$@" >/dev/null; code=$?; '
                  'ls -A "$0"; exit $code')
        done = subprocess.run(["unshare", "--mount", "sh", "-c", script, str(disk), BRDF_COMPRESS, *map(str, arguments)],
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=300, check=False)
        if done.returncode == 77 or b"unshare" in done.stderr:
            self.skipTest("no file system can be mounted here")
        return done

    @unittest.skipUnless(shutil.which("unshare") and os.geteuid() == 0, "mounting a file system needs root")
    def test_disk_that_is_full(self):
        disk = folder() / "disk"
        for verb in writers():
            for left in (0, 64):  # kilobytes
                if left and verb[0] != "decompress":
                    continue
                fill = f'head -c {(256 - left) * 1024} /dev/zero > "$0/filler" 2>/dev/null;'
                done = self.mounted("size=256k", fill, *verb, "-o", disk / "out.brdfc")
                self.refused(done, disk / "out.brdfc", "No space left")
                self.assertEqual(done.stdout.split(), [b"filler"])

    @unittest.skipUnless(shutil.which("unshare") and os.geteuid() == 0, "mounting a file system needs root")
    def test_disk_that_is_read_only(self):
        disk = folder() / "disk"
        for verb in writers():
            done = self.mounted("ro", "", *verb, "-o", disk / "out.brdfc")
            self.refused(done, disk / "out.brdfc", "Read-only file system")

    def as_a_user(self, *arguments):
        """Without the rights of root, which no permission stops."""
        def drop():
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)
        try:
            return call(*arguments, before=drop if os.geteuid() == 0 else None)
        except (PermissionError, subprocess.SubprocessError):
            self.skipTest(f"{BRDF_COMPRESS} cannot be run by another user")

    def test_folder_and_file_without_permission(self):
        public = pathlib.Path(folder())
        public.chmod(0o755)
        for file in (compressed(), table()):
            file.chmod(0o644)
        if self.as_a_user("--version").returncode != 0:
            self.skipTest(f"{BRDF_COMPRESS} cannot be run by another user")
        locked = self.place("locked")
        (locked / "old.brdfc").write_bytes(b"old")
        locked.chmod(0o555)
        for verb in writers():
            for name in ("new.brdfc", "old.brdfc"):
                self.refused(self.as_a_user(*verb, "-o", locked / name, "-f"), locked / name, "Permission denied")
        self.assertEqual((locked / "old.brdfc").read_bytes(), b"old")
        self.assertEqual([p.name for p in locked.iterdir()], ["old.brdfc"])
        hidden = self.place("hidden")
        hidden.chmod(0o000)
        self.refused(self.as_a_user(*writers()[0], "-o", hidden / "a.brdfc", "-f"), hidden / "a.brdfc", "Permission denied")
        secret = folder() / "secret.binary"
        secret.write_bytes(b"x")
        secret.chmod(0o000)
        done = self.as_a_user("info", secret)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(b"Permission denied", done.stderr)
        locked.chmod(0o755)
        hidden.chmod(0o755)

    def test_names_that_cannot_be(self):
        loop = folder() / "loop.brdfc"
        loop.symlink_to(loop)
        verb = writers()[0]
        self.refused(call(*verb, "-o", loop, "-f"), loop, "symbolic links")
        self.assertTrue(loop.is_symlink())
        self.refused(call(*verb, "-o", folder() / ("a" * 300), "-f"), "File name too long")
        self.refused(call(*verb, "-o", table() / "a.brdfc", "-f"), "Not a directory")
        self.refused(call(*verb, "-o", folder() / "none" / "a.brdfc", "-f"), "none")
        self.refused(call(*verb, "-o", folder(), "-f"), "directory")

    def test_links_survive(self):
        real, link = folder() / "real.brdfc", folder() / "link.brdfc"
        real.write_bytes(b"old")
        link.symlink_to(real)
        done = call(*writers()[0], "-o", link, "-f")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(link.is_symlink())
        self.assertNotEqual(real.read_bytes(), b"old")


if __name__ == "__main__":
    if not sys.platform.startswith("linux"):
        sys.exit(77)
    main()
