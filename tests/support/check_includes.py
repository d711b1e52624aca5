#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the rules of the source tree: include directions, file sizes, file names, licence lines.

usage: check_includes.py ROOT         prints file:line: problem for each violation; exit code 1 when there is one
       check_includes.py --self-test  shows each rule a tree that breaks it
"""
import pathlib
import re
import sys
import tempfile

# module -> the modules whose internal headers it may include besides its own. Nothing points backwards.
MODULES = {
    "base": [],
    "geometry": ["base"],
    "lobes": ["base", "geometry"],
    "ingest": ["base", "geometry"],
    "residual": ["base", "geometry", "lobes"],
    "slices": ["base", "residual"],
    "analytic": ["base", "geometry", "lobes"],
    "container": ["base", "lobes", "residual", "analytic"],
    "eval": ["base", "geometry", "lobes", "residual", "slices", "analytic"],
    "sample": ["base", "geometry", "lobes", "analytic", "eval"],
    "decode": ["container", "residual", "analytic", "slices", "eval", "sample", "lobes", "base"],
    "fit": ["ingest", "lobes", "geometry", "base"],
    "metrics": ["base", "geometry"],
}
MODULES["encode"] = sorted(MODULES)

# What programs may take from inside the library: file access and the file formats. The rest is what users have, too.
PROGRAMS = {"base", "geometry", "ingest"}

# Public headers that belong to one side. Those not listed here are plain vocabulary, open to every module.
PUBLIC = {
    "brdf/lobes.h": {"lobes", "fit", "residual", "analytic", "container", "eval", "sample", "decode", "encode"},
    "brdf/material.h": {"analytic", "container", "eval", "sample", "decode", "encode"},
    "brdf/check.h": {"decode"},
    "brdf/ingest.h": {"ingest", "encode"},
    "brdf/fit.h": {"fit", "encode"},
    "brdf/metrics.h": {"metrics", "encode"},
    "brdf/encode.h": {"encode"},
}

# What brdf::decode may not see, by the start of an include's name: a renderer links no fitter.
ENCODER_ONLY = ("ceres/", "Eigen/", "glog/", "tbb/", "oneapi/", "nlohmann/", "CLI/")
DECODE_MODULES = {"base", "geometry", "lobes", "residual", "slices", "analytic", "container", "eval", "sample", "decode"}

MAX_LINES = 400
BAD_STEMS = {"utils", "util", "misc", "common"}
CODE = {".cpp", ".h", ".py", ".sh", ".cmake", ".proto"}
FOLDERS = ("libbrdf", "tools", "server", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(text):
    """(line number, quote character, name) of each include."""
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def check_module_file(module, path, text):
    """Problems of one file below libbrdf/src/<module>."""
    if module not in MODULES:
        yield 1, f"module '{module}' has no row in the table of include directions"
        return
    for number, quote, name in includes(text):
        if quote == '"':
            target = name.split("/")[0]
            if "/" not in name:
                yield number, f'"{name}" must be written "{module}/{name}"'
            elif target not in MODULES:
                yield number, f'"{name}" names no module; public and system headers are written <...>'
            elif target != module and target not in MODULES[module]:
                yield number, f'{module} must not include "{name}": {target} comes later in the data flow'
        elif name in PUBLIC and module not in PUBLIC[name]:
            yield number, f"{module} must not include <{name}>"
        elif (module in DECODE_MODULES and not path.name.endswith("_encoder.cpp")
              and name.startswith(ENCODER_ONLY)):
            yield number, f"{module} is part of brdf::decode, which must not need <{name}>"


def check_public_header(text):
    """Problems of one file below libbrdf/include/brdf."""
    for number, quote, name in includes(text):
        if quote == '"':
            yield number, f'public headers include only <...>, found "{name}"'


def check_program_file(text):
    """Problems of one file below tools or server."""
    for number, quote, name in includes(text):
        module = name.split("/")[0]
        if quote == '"' and "/" in name and module in MODULES and module not in PROGRAMS:
            yield number, f'programs must not include "{name}": use the public headers'


def check_any_file(path, text):
    """Problems that any file of code can have."""
    lines = text.splitlines()
    if not any("SPDX-License-Identifier: Apache-2.0" in line for line in lines[:2]):
        yield 1, "no SPDX-License-Identifier in the first two lines"
    if len(lines) > MAX_LINES:
        yield MAX_LINES + 1, f"{len(lines)} lines, at most {MAX_LINES} allowed: one idea per file"
    if path.stem in BAD_STEMS:
        yield 1, f"'{path.name}' says nothing of what is in it"


def check_tree(root):
    """All problems below root, as (path, line, sentence), and the number of files read."""
    problems, count = [], 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            named_code = path.suffix in CODE or path.name == "CMakeLists.txt"
            if not path.is_file() or not named_code or "corpus" in path.parts:
                continue
            count += 1
            text = path.read_text(encoding="utf-8")
            parts = path.relative_to(root).parts
            found = list(check_any_file(path, text))
            if parts[:2] == ("libbrdf", "src") and len(parts) > 3:
                found += check_module_file(parts[2], path, text)
            elif parts[:2] == ("libbrdf", "include"):
                found += check_public_header(text)
            elif parts[0] in ("tools", "server"):
                found += check_program_file(text)
            problems += [(path.relative_to(root), line, sentence) for line, sentence in found]
    return problems, count


def self_test():
    """Each rule is shown one clean tree and one that breaks it."""
    spdx = "// SPDX-License-Identifier: Apache-2.0\n"
    cases = [
        ("libbrdf/src/eval/a.cpp", spdx + '#include "lobes/x.h"\n#include <brdf/material.h>\n', None),
        ("libbrdf/src/eval/a.cpp", spdx + '#include "fit/x.h"\n', 2),
        ("libbrdf/src/metrics/a.cpp", spdx + "\n#  include <brdf/encode.h>\n", 3),
        ("libbrdf/src/eval/a.cpp", spdx + "#include <ceres/ceres.h>\n", 2),
        ("libbrdf/src/fit/a.cpp", spdx + "#include <ceres/ceres.h>\n", None),
        ("libbrdf/src/lobes/a.cpp", spdx + '#include "a.h"\n', 2),
        ("libbrdf/src/lobes/a.cpp", spdx + '#include "brdf/lobes.h"\n', 2),
        ("libbrdf/src/plot/a.cpp", spdx, 1),
        ("libbrdf/include/brdf/a.h", spdx + '#include "lobes/x.h"\n', 2),
        ("tools/x/a.cpp", spdx + '#include "table.h"\n#include "base/x.h"\n', None),
        ("tools/x/a.cpp", spdx + '#include "residual/x.h"\n', 2),
        ("tools/x/a.cpp", "int a;\n", 1),
        ("tools/x/utils.cpp", spdx, 1),
        ("tests/unit/a.cpp", spdx + "\n" * MAX_LINES, MAX_LINES + 1),
        ("tests/unit/a.cpp", spdx + "\n" * (MAX_LINES - 1), None),
    ]
    failed = 0
    for name, text, line in cases:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            problems, _ = check_tree(pathlib.Path(folder))
        wanted = [] if line is None else [(pathlib.PurePath(name), line)]
        if [(p, n) for p, n, _ in problems] != wanted:
            failed += 1
            print(f"{name}: expected {wanted}, found {problems}")
    print(f"{len(cases)} cases, {failed} failed")
    return 1 if failed else 0


def main(arguments):
    if len(arguments) != 1:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    if arguments[0] == "--self-test":
        return self_test()
    problems, count = check_tree(pathlib.Path(arguments[0]))
    for path, line, sentence in problems:
        print(f"{path}:{line}: {sentence}")
    print(f"{count} files, {len(problems)} problems")
    return 1 if problems or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
