#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/effort.md holds the table of efforts that the program prints."""
import pathlib

from support.cli_harness import CliTest, main

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "effort.md"


class Efforts(CliTest):
    def test_the_page_holds_the_table_of_the_code(self):
        printed = self.succeed("compress", "--efforts").stdout.decode()
        page = PAGE.read_text(encoding="utf-8")
        begin, end = "<!-- begin efforts -->\n", "<!-- end efforts -->"
        self.assertEqual(page[page.index(begin) + len(begin):page.index(end)], printed)
        for name in ["fastest", "fast", "medium", "thorough", "exhaustive"]:
            self.assertIn(f" {name} |", printed)


if __name__ == "__main__":
    main()
