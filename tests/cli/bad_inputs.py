#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files that cannot be read end with exit code 3 and a sentence that names the file and what is wrong with it."""
import json
import os
import struct
import subprocess
import threading

from support.brdfc_coding import xxh32
from support.cli_harness import BRDF_COMPRESS, CliTest, MERL_BYTES, MERL_CELLS, compressed, folder, main, measured, run
from support.small_rgl import small_rgl

LFS_POINTER = (b"version https://git-lfs.github.com/spec/v1\n"
               b"oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 34992012\n")


def written(name, data):
    path = folder() / name
    path.write_bytes(data)
    return path


class BadInputs(CliTest):
    def refused(self, path, *words):
        """By every verb that reads a measured file, and nothing is written."""
        out = folder() / "never.brdfc"
        says = [str(path), *words]
        self.fail_with(3, "compress", path, "-o", out, says=says)
        self.fail_with(3, "info", path, says=says)
        self.fail_with(3, "eval", path, says=says)
        self.fail_with(3, "bench", path, "--presets", "fastest", says=says)
        self.assertFalse(out.exists())

    def test_missing(self):
        self.refused(folder() / "no_such_file.binary")

    def test_directory(self):
        self.refused(folder(), "directory")

    def test_empty(self):
        self.refused(written("empty.binary", b""), "empty")

    def test_text(self):
        self.refused(written("notes.binary", b"theta phi value\n0 0 1\n" * 40), "text")

    def test_git_lfs_pointer(self):
        self.refused(written("pointer.binary", LFS_POINTER), "Git-LFS")

    def test_unknown_content(self):
        self.refused(written("noise.binary", bytes(range(256)) * 16))

    def test_truncated_table(self):
        self.refused(written("short.binary", measured().read_bytes()[:100000]))

    def test_wrong_dimensions(self):
        for name, n in [("negative", (-90, 90, 180)), ("zero", (0, 0, 0)), ("huge", (2**30, 2**30, 180)),
                        ("other", (45, 45, 180))]:
            with self.subTest(name=name):
                self.refused(written(f"{name}_dims.binary", struct.pack("<3i", *n) + bytes(4096)))

    def test_table_of_nan_has_nothing_to_fit(self):
        cells = struct.pack("<d", float("nan")) * 3 * MERL_CELLS
        nan = written("all_nan.binary", struct.pack("<3i", 90, 90, 180) + cells)
        self.assertEqual(nan.stat().st_size, MERL_BYTES)
        self.fail_with(3, "compress", nan, "-o", folder() / "never.brdfc", "--preset", "fastest", says=str(nan.stem))
        nan.unlink()

    def test_single_nan_cells_are_masked(self):
        data = bytearray(measured().read_bytes())
        for cell in range(90 * 180 * 20, 90 * 180 * 20 + 500):
            for channel in range(3):
                struct.pack_into("<d", data, 12 + 8 * (channel * MERL_CELLS + cell), float("nan"))
        holes = written("holes.binary", bytes(data))
        before = self.report("info", measured())[0]["invalid_fraction"]
        self.assertGreater(self.report("info", holes)[0]["invalid_fraction"], before)
        holes.unlink()

    def test_truncated_brdfc(self):
        data = compressed().read_bytes()
        for size in [0, 3, 5, 11, len(data) // 2, len(data) - 1]:
            with self.subTest(size=size):
                cut = written("cut.brdfc", data[:size])
                self.fail_with(3, "eval", cut, says=str(cut))
                self.fail_with(3, "verify", cut, says=str(cut))

    def test_damaged_brdfc(self):
        data = compressed().read_bytes()
        for at in range(0, len(data), 37):
            with self.subTest(at=at):
                bent = written("bent.brdfc", data[:at] + bytes([data[at] ^ 0x10]) + data[at + 1:])
                self.fail_with(3, "verify", bent, says=str(bent))

    def test_trailing_bytes(self):
        longer = written("longer.brdfc", compressed().read_bytes() + b"x")
        self.fail_with(3, "info", longer, says=str(longer))

    def test_wrong_kind_of_file(self):
        out = folder() / "never.binary"
        self.fail_with(3, "compress", compressed(), "-o", out, says="compressed")
        self.fail_with(3, "decompress", measured(), "-o", out, says="convert")
        self.fail_with(3, "convert", compressed(), "-o", out, says="decompress")
        self.fail_with(3, "verify", measured(), says="measured")
        self.fail_with(3, "bench", compressed(), says="measured")
        self.assertFalse(out.exists())

    def quickly_refused(self, path, *words):
        """Without reading what is large: little time and memory."""
        child = subprocess.Popen([BRDF_COMPRESS, "info", path], stderr=subprocess.PIPE)
        sentence = child.stderr.read().decode()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        child.stderr.close()
        self.assertEqual(child.returncode, 3, sentence)
        self.assertEqual(sentence.count("\n"), 1, sentence)
        for word in [str(path), *words]:
            self.assertIn(word, sentence)
        self.assertLess(usage.ru_utime + usage.ru_stime, 2)
        self.assertLess(usage.ru_maxrss, 300 << 10)  # KiB; sanitizers take some

    def sparse(self, name, size, head=b""):
        path = written(name, head)
        os.truncate(path, size)
        return path

    def test_enormous_files(self):
        self.quickly_refused(self.sparse("large.binary", 2 << 30), "2147483648 bytes", "limit")
        self.quickly_refused(self.sparse("limit.binary", 1 << 30), "no file that can be read")
        self.quickly_refused(self.sparse("text.binary", 1 << 30, b"text " * 200), "text")
        self.quickly_refused(self.sparse("pointer.binary", 1 << 30, LFS_POINTER + b" " * 600), "Git-LFS")
        self.quickly_refused(self.sparse("large.brdfc", 1 << 30, compressed().read_bytes()), "1073741824 bytes", "67108864")

    def test_devices(self):
        self.quickly_refused("/dev/zero", "no file that can be read")
        self.quickly_refused("/dev/null", "empty")
        for verb in (["eval"], ["verify"], ["compress", "-o", folder() / "never.brdfc"]):
            self.fail_with(3, *verb, "/dev/zero", says="/dev/zero")

    def test_pipes(self):
        pipe = folder() / "pipe"
        os.mkfifo(pipe)
        for data, code in [(b"", 3), (LFS_POINTER, 3), (bytes(5000), 3), (compressed().read_bytes(), 0), (small_rgl(), 0),
                           (compressed().read_bytes()[:-1], 3), (measured().read_bytes()[:10**6], 3)]:
            def feed():
                try:
                    pipe.write_bytes(data)
                except BrokenPipeError:
                    pass  # what was not wanted is not read
            writer = threading.Thread(target=feed)
            writer.start()
            done = run("info", pipe)
            writer.join()
            self.assertEqual(done.returncode, code, done.stderr)

    def test_links_that_lead_nowhere(self):
        loop, dangling = folder() / "loop", folder() / "dangling"
        loop.symlink_to(loop)
        dangling.symlink_to(folder() / "gone")
        self.refused(loop, "symbolic links")
        self.refused(dangling, "No such file")

    def test_names_that_are_no_text(self):
        name = os.fsencode(folder()) + b"/\xff\xc3\x28\x1b[31mred\nline.brdfc"
        for wanted in (3, 0):
            for options in ([], ["--json"]):
                done = subprocess.run([BRDF_COMPRESS, "info", name, *options], capture_output=True, check=False)
                self.assertEqual(done.returncode, wanted, done.stderr)
                for text in (done.stdout.decode(), done.stderr.decode()):
                    self.assertNotIn("\x1b", text)
                self.assertEqual(done.stderr.count(b"\n"), 1 if wanted else 0, done.stderr)
                if options and not wanted:
                    json.loads(done.stdout)
            if wanted:
                with open(name, "wb") as file:
                    file.write(compressed().read_bytes())
        os.unlink(name)

    def test_text_of_the_file_does_not_command_the_terminal(self):
        out = folder() / "named.brdfc"
        self.succeed("compress", measured(), "-o", out, "-f", "--preset", "fastest", "--target-size", 500, "--provenance", "-q")
        data = out.read_bytes()
        at = data.index(b"sample")  # the material's name, in the provenance chunk, which is the last
        begin = at - 1
        seed = None
        for end in range(begin - 8, begin + 1):
            before = int.from_bytes(data[end - 4:end], "little")
            if xxh32(data[end:-4], before) == int.from_bytes(data[-4:], "little"):
                seed, payload = before, data[end:-4]
        self.assertIsNotNone(seed, "the provenance chunk was not found")
        payload = payload.replace(b"sample", b"\x1b[31m\n", 1)
        out.write_bytes(data[:-4 - len(payload)] + payload + xxh32(payload, seed).to_bytes(4, "little"))
        shown = self.succeed("info", out).stdout.decode()
        self.assertNotIn("\x1b", shown)
        self.assertIn("[31m", shown)
        self.assertIn("\x1b", self.report("info", out)[0]["name"])  # JSON has its own escapes

    def test_rows_of_any_kind(self):
        for row in [b"nan,0,1,0,0,1", b"0,0,1,0,0,inf", b"1e300,0,1,0,0,1", b"0,0,1", b"0,0,1,0,0,1,7", b"\0\0\0", b"a,b,c,d,e,f",
                    b"0,0,1,0,0,--1", b"0,0,1,0,0,0x1", b"," * 5, b"\xff\xfe", b"1" * 100000, b"0,0,1,0,0,1\n0,0,1,0,0,nan"]:
            with self.subTest(row=row[:40]):
                for verb in ("eval", "pdf"):
                    self.fail_with(3, verb, compressed(), stdin=row + b"\n", says="standard input: ")
        for row in [b"0,0,1,0,0,1e-300", b"0,0,1,1e-40,1e-40,1e-40", b"0,0,1,0,0,-1", b"-0,-0,1,-0,-0,1", b"1e38,1e38,1e38,-1e38,0,1e38", b"0,0,0,0,0,0"]:
            for verb in ("eval", "pdf"):
                done = run(verb, compressed(), stdin=row)
                self.assertIn(done.returncode, (0, 3), (row, done.stderr))
                for number in done.stdout.replace(b"\n", b",").split(b",")[:-1]:
                    self.assertTrue(0 <= float(number) < float("inf"), (row, done.stdout))
        for nothing in (b"", b"\n\n", b"# no rows\n"):
            self.assertEqual(self.succeed("eval", compressed(), stdin=nothing).stdout, b"")

    def test_numbers_at_their_ends(self):
        out = folder() / "ends.brdfc"
        arguments = ["compress", measured(), "-o", out, "-f", "--preset", "fastest", "-q"]
        self.succeed(*arguments, "--target-size", 2**64 - 1)
        self.assertLess(out.stat().st_size, 1 << 20)
        before = out.read_bytes()
        for size in ("-1", "0", "1e99", "18446744073709551616", "", " 5", "0x10", "5 "):
            self.fail_with(2, *arguments, f"--target-size={size}", says="--target-size")
        self.fail_with(4, *arguments, "--target-size", 1)
        for error in ("log_mae=inf", "log_mae=", "=1", "log_mae=1e999", "psnr_env=-inf", "psnr_env=nan"):
            self.fail_with(2, *arguments, f"--target-error={error}", says="--target-error")
        self.fail_with(4, *arguments, "--target-error=psnr_env=1e300")
        self.assertEqual(out.read_bytes(), before)
        self.succeed("eval", out, "--prefix", 2**64 - 1)
        self.fail_with(2, "eval", out, "--prefix", 1, says="--prefix")


if __name__ == "__main__":
    main()
