#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds brdf::decode with -O0 and with -O3 and compares, bit by bit, what both make of data/golden.

usage: compare_builds.py SOURCE_DIR COMPILER

Only the baseline instruction set is compiled, which saves most of the time; the others are compared with each other by
the suite itself. Exit code 1 when a value differs.
"""
import pathlib
import subprocess
import sys
import tempfile

LEVELS = ("-O0", "-O3")
BOUND = {"group": "Agreement", "unit": "count", "bound": 0,
         "what": "brdf::decode built with -O0 and with -O3, golden files: values whose bits differ"}


def run(*command):
    result = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{result.stdout}\nFAILED: {' '.join(str(c) for c in command)}")
    return result.stdout


def values(source, compiler, work, level):
    """All values of a build, as words of eight hexadecimal digits, in lines."""
    folder = work / level.strip("-")
    flags = f"{level} -DHWY_COMPILE_ONLY_STATIC"
    run("cmake", "-S", source, "-B", folder, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_CXX_FLAGS_RELEASE={flags}", "-DBRDF_BUILD_ENCODER=OFF", "-DBRDF_BUILD_TOOLS=OFF", "-DBRDF_BUILD_TESTS=OFF")
    run("cmake", "--build", folder, "--target", "brdf_decode")
    program = folder / "print_values"
    run(compiler, "-std=c++20", level, "-ffp-contract=off", f"-I{source}/libbrdf/include",
        source / "tests/extremes/builds/print_values.cpp", next(folder.glob("libbrdf/libbrdf_decode.*")),
        f"-Wl,-rpath,{folder}/libbrdf", "-lhwy", "-o", program)
    return run(program, *sorted((source / "data/golden").glob("*.brdfc"))).splitlines()


def compare(source, compiler):
    """The bound with what was found."""
    source = pathlib.Path(source).resolve()
    with tempfile.TemporaryDirectory() as name:
        first, second = (values(source, compiler, pathlib.Path(name), level) for level in LEVELS)
    files = [f.stem for f in sorted((source / "data/golden").glob("*.brdfc"))]
    different, cases, where = abs(len(first) - len(second)), 0, ""
    for a, b in zip(first, second):
        left, right = a.split(), b.split()
        cases += len(left) - 2
        found = abs(len(left) - len(right)) + sum(x != y for x, y in zip(left, right))
        if found and not where:
            where = f"{files[int(left[0]) - 1]}, {left[1]}"
        different += found
    return {**BOUND, "worst": different, "where": where, "cases": cases}


def main(arguments):
    if len(arguments) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    found = compare(*arguments)
    print(f"{found['cases']} values, {found['worst']} differ {found['where']}")
    return 1 if found["worst"] > found["bound"] or found["cases"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
