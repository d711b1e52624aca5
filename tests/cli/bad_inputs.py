#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files that cannot be read end with exit code 3 and a sentence that names the file and what is wrong with it."""
import struct

from support.cli_harness import CliTest, MERL_BYTES, MERL_CELLS, compressed, folder, main, measured

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


if __name__ == "__main__":
    main()
