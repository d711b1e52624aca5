#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what `brdf-compress bench` measures now with tests/bench/baseline.json.

usage: tests/bench/baseline.py [--rewrite]     --rewrite makes the baseline from what is measured now

One line a figure, PASS, WARN or FAIL, then a summary; exit code 1 when one is FAIL. Bytes and errors of the made samples
are deterministic and held to tight limits. Times are compared as ratios to the raw table's in the same run, and only
warn. The programs are $BRDF_COMPRESS and $BRDF_GONIO, or those of build/release/bin.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BASELINE = HERE / "baseline.json"
SURFACES = ["lacquer", "matte"]
SETTINGS = ["--presets", "fast", "--sizes", "512,2700", "--eval", "all"]

# figure -> (kind of limit, WARN beyond, FAIL beyond). "more": relative growth; "less": fall in the figure's unit;
# "times": factor by which the ratio to the raw table may grow, which never fails.
LIMITS = {
    "bytes": ("more", 0.005, 0.02),
    "resident_bytes": ("more", 0.005, 0.10),
    "log_mae": ("more", 0.005, 0.02),
    "log_mae_0_60": ("more", 0.01, 0.05),
    "log_mae_60_75": ("more", 0.01, 0.05),
    "log_mae_75_85": ("more", 0.01, 0.05),
    "log_mae_p95": ("more", 0.01, 0.05),
    "psnr_env": ("less", 0.05, 0.25),
    "psnr_lights": ("less", 0.05, 0.25),
    "albedo_error": ("more", 0.02, 0.10),
    "bugs": ("more", 0, 0),
    "eval_ns": ("times", 1.75, None),
    "pdf_ns": ("times", 1.75, None),
    "sample_ns": ("times", 1.75, None),
    "eval_ns_scalar": ("times", 1.75, None),
    "sample_ns_scalar": ("times", 1.75, None),
}
KEYS = ["material", "preset", "target", "eval_level"]


def program(variable, name):
    return os.environ.get(variable) or str(HERE.parent.parent / "build" / "release" / "bin" / name)


def measure():
    """Rows of the made samples, with times as ratios to the raw table's."""
    with tempfile.TemporaryDirectory(prefix="brdf-baseline-") as folder:
        files = []
        for surface in SURFACES:
            files.append(os.path.join(folder, f"{surface}.binary"))
            subprocess.run([program("BRDF_GONIO", "brdf-gonio"), "sample", "--surface", surface, "-o", files[-1]],
                           check=True, stderr=subprocess.DEVNULL)
        command = [program("BRDF_COMPRESS", "brdf-compress"), "bench", *files, *SETTINGS, "--json", "-q"]
        report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    rows = []
    for row in report["rows"]:
        kept = {key: row[key] for key in KEYS}
        for figure, (kind, _, _) in LIMITS.items():
            raw = row["raw_eval_ns_scalar" if figure.endswith("_scalar") else "raw_eval_ns"]
            kept[figure] = round(row[figure] / raw, 3) if kind == "times" else float(f"{row[figure]:.7g}")
        rows.append(kept)
    return rows


def verdict(figure, now, then):
    """How `now` stands against the baseline, and by how much it differs, as text."""
    kind, warn, fail = LIMITS[figure]
    if kind == "less":
        worse, text = then - now, f"{now - then:+.3f}"
    elif kind == "times":
        worse, text = now / then if then else 1.0, f"x{now / then:.2f}" if then else "-"
    else:
        worse = (now - then) / then if then else float(now > then)
        text = f"{100 * (now - then) / then:+.2f} %" if then else f"{now - then:+g}"
    slack = 1e-6  # instruction sets and compilers round differently
    if fail is not None and worse > fail + slack:
        return "FAIL", text
    return ("WARN" if worse > warn + slack else "PASS"), text


def name_of(row):
    return " ".join(str(row[key]) for key in KEYS)


def compare(rows, baseline):
    """Prints a line for each figure of the baseline; returns the count of each verdict."""
    counts = {"PASS": 0, "WARN": 0, "FAIL": 0}
    fresh = {name_of(row): row for row in rows}
    for then in baseline:
        now = fresh.get(name_of(then))
        for figure in LIMITS:
            if now is None:
                word, text, value = "FAIL", "is missing", "-"
            else:
                word, text = verdict(figure, now[figure], then[figure])
                value = f"{now[figure]:g}"
            counts[word] += 1
            unit = " x raw" if LIMITS[figure][0] == "times" else ""
            print(f"{word}  {name_of(then)}  {figure} {value}{unit}  baseline {then[figure]:g}  {text}")
    return counts


def main(arguments):
    if arguments not in ([], ["--rewrite"]):
        sys.exit(__doc__)
    rows = measure()
    if arguments:
        lines = ",\n".join(" " + json.dumps(row) for row in rows)
        BASELINE.write_text(f'{{"schema": "brdf-compress/baseline/1", "rows": [\n{lines}\n]}}\n')
        print(f"{BASELINE.name} holds {len(rows)} rows")
        return 0
    counts = compare(rows, json.loads(BASELINE.read_text())["rows"])
    print(", ".join(f"{count} {word}" for word, count in counts.items()))
    return 1 if counts["FAIL"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
