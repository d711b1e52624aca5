#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plots of a report of `brdf-compress bench`: error against bytes, and error against ns per evaluation.

usage: plot_tradeoff.py REPORT.json FOLDER     writes error-bytes and error-ns to FOLDER, as SVG and PNG

Each panel shows the mean over the materials and the worst material. Where networks were measured, the points are those of
the materials that have one, so that like is compared with like.
"""
import collections
import json
import pathlib
import sys

import matplotlib

matplotlib.use("agg")
from matplotlib import patheffects, pyplot, ticker  # noqa: E402

# (key, label, whether more is better)
ERRORS = [("log_mae", "log_mae", False), ("psnr_env", "PSNR, environment (dB)", True),
          ("psnr_lights", "PSNR, four lights (dB)", True)]
COLOURS = {"fast": "#d95f02", "balanced": "#1f78b4", "exact": "#33a02c"}
MARKERS = {"fast": "v", "balanced": "o", "exact": "s"}
NEURAL, RAW = "#7b3294", "#555555"
# name, how the values of several materials become one, line style, opacity
KINDS = [("mean", lambda values, more: sum(values) / len(values), "-", 1.0),
         ("worst", lambda values, more: min(values) if more else max(values), "--", 0.55)]

Point = collections.namedtuple("Point", "x y level label")


def settings(rows):
    """Rows by setting, only the settings that every material has."""
    found = collections.defaultdict(list)
    for row in rows:
        found[row["preset"], row["target"], row["eval_level"]].append(row)
    most = len({row["material"] for row in rows})
    return {key: group for key, group in found.items() if len(group) == most}


def label_of(key):
    preset, target, _ = key
    return preset if target is None else f"{target} B"


def points(groups, x_key, y_key, more, reduce):
    """One point a setting: x is always the mean."""
    made = []
    for key, group in groups.items():
        x = sum(row[x_key] for row in group) / len(group)
        made.append(Point(x, reduce([row[y_key] for row in group], more), key[2], label_of(key)))
    return made


def pareto(made, more):
    """Points that no other beats in both directions, by x."""
    front = []
    for point in sorted(made, key=lambda p: (p.x, -p.y if more else p.y)):
        if not front or (point.y > front[-1].y if more else point.y < front[-1].y):
            front.append(point)
    return front


def draw_panel(axes, rows, networks, x_key, error):
    y_key, title, more = error
    groups = settings(rows)
    for kind, reduce, style, opacity in KINDS:
        made = points(groups, x_key, y_key, more, reduce)
        front = pareto(made, more)
        axes.plot([p.x for p in front], [p.y for p in front], style, color="black", alpha=opacity, linewidth=1.2, zorder=2)
        for p in made:
            on_front = p in front
            axes.plot(p.x, p.y, MARKERS.get(p.level, "o"), color=COLOURS.get(p.level, "black"), alpha=opacity, zorder=3,
                      markersize=6, markerfacecolor=COLOURS.get(p.level, "black") if on_front else "white")
        if kind == "mean" and x_key == "eval_ns":
            for p in made:
                if p.level == "balanced" or all(q.level != "balanced" for q in made):
                    axes.annotate(p.label, (p.x, p.y), xytext=(4, 5), textcoords="offset points", fontsize=8,
                                  color="#333333", zorder=5,
                                  path_effects=[patheffects.withStroke(linewidth=2.5, foreground="white")])
        if networks:
            x = sum(row[x_key] for row in networks) / len(networks)
            axes.plot(x, reduce([row[y_key] for row in networks], more), "*", color=NEURAL, alpha=opacity, markersize=13,
                      markeredgewidth=0.5, markeredgecolor="black", zorder=4)
    axes.set_ylabel(title)
    if not more:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:g}"))
        axes.yaxis.set_minor_formatter(ticker.NullFormatter())
    axes.grid(True, which="major", linewidth=0.4, alpha=0.6)


def bytes_axis(axes, rows, networks):
    axes.set_xscale("log")
    sizes = [row["bytes"] for row in rows + networks]
    low, high = min(sizes) / 1.4, max(sizes) * 1.4
    axes.set_xlim(low, high)
    ticks = [2 ** k for k in range(4, 24) if low <= 2 ** k <= high]
    axes.xaxis.set_major_locator(ticker.FixedLocator(ticks))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:g}"))
    axes.set_xlabel("bytes per material")


def ns_axis(axes, rows, networks):
    raw = [row["raw_eval_ns"] for row in rows if row["raw_eval_ns"]]
    groups = list(settings(rows).values()) + ([networks] if networks else [])
    highest = max(sum(row["eval_ns"] for row in group) / len(group) for group in groups)
    if raw:
        x = sum(raw) / len(raw)
        axes.axvline(x, color=RAW, linestyle=":", linewidth=1.5, zorder=1)
        highest = max(highest, x)
    axes.set_xlim(0, 1.25 * highest)
    axes.set_xlabel("ns per evaluation, batches on one thread")


def legend_handles(rows, networks, with_raw):
    line = matplotlib.lines.Line2D
    handles = [line([], [], color="black", linestyle=style, alpha=opacity,
                    label=f"Pareto front, {'mean of materials' if kind == 'mean' else 'worst material'}")
               for kind, _, style, opacity in KINDS]
    for level in COLOURS:
        if any(row["eval_level"] == level for row in rows):
            handles.append(line([], [], color=COLOURS[level], marker=MARKERS[level], linestyle="", label=f"eval {level}"))
    handles.append(line([], [], color="black", marker="o", markerfacecolor="white", linestyle="", label="off the front"))
    if networks:
        handles.append(line([], [], color=NEURAL, marker="*", markersize=11, linestyle="", markeredgecolor="black",
                            markeredgewidth=0.5, label="network, 675 weights"))
    if with_raw:
        handles.append(line([], [], color=RAW, linestyle=":", label="raw table, float RGB"))
    return handles


def draw(rows, networks, x_key, axis, headline, with_raw):
    figure, panels = pyplot.subplots(1, 3, figsize=(13, 4.8))
    for axes, error in zip(panels, ERRORS):
        draw_panel(axes, rows, networks, x_key, error)
        axis(axes, rows, networks)
    materials = len({row["material"] for row in rows})
    figure.suptitle(f"{headline}, {materials} material{'s' if materials > 1 else ''}")
    figure.legend(handles=legend_handles(rows, networks, with_raw), loc="lower center", ncol=4, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.13, 1, 1))
    return figure


def main(report, folder):
    matplotlib.rcParams.update({"svg.hashsalt": "brdf-compress", "font.family": "DejaVu Sans", "font.size": 10})
    rows = json.loads(pathlib.Path(report).read_text())["rows"]
    networks = [row for row in rows if row["preset"] == "neural"]
    rows = [row for row in rows if row["preset"] != "neural"]
    if networks:
        named = {row["material"] for row in networks} & {row["material"] for row in rows}
        rows, networks = ([row for row in group if row["material"] in named] for group in (rows, networks))
    if not rows:
        sys.exit("nothing to plot: no material has both a compressed row and a network")
    has_raw = any(row["raw_eval_ns"] for row in rows)
    for name, x_key, axis, headline, with_raw in [
            ("error-bytes", "bytes", bytes_axis, "Error against size", False),
            ("error-ns", "eval_ns", ns_axis, "Error against time of evaluation", has_raw)]:
        figure = draw(rows, networks, x_key, axis, headline, with_raw)
        for suffix, metadata in (("svg", {"Date": None, "Creator": None}), ("png", {"Software": None})):
            figure.savefig(pathlib.Path(folder) / f"{name}.{suffix}", metadata=metadata, dpi=110)
        pyplot.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
