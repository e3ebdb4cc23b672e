#!/usr/bin/python3
"""Errors and times of POV-Ray and Cycles on scenes/peers beside ours: a table in docs/RESULTS.md and a plot.

Measurements are kept in build/bench/peers, one file a scene; what is there is not measured again while the scene file is the same.
Ours come from build/bench/pareto/SCENE.csv, written by airlight-pareto."""
import argparse
import csv
import glob
import hashlib
import json
import math
import os
import re
import subprocess
import tempfile

import cycles
import plot
import povray
import scene as scenes

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CACHE, OURS = os.path.join(ROOT, "build/bench/peers"), os.path.join(ROOT, "build/bench/pareto")
SMALL, FULL = (160, 120), (800, 600)
SCALE = FULL[0] * FULL[1] / (SMALL[0] * SMALL[1])
GOALS = (0.01, 0.001)
THREADS = 2


def truth(path, name):
    stored = os.path.join(ROOT, "tests/data/peers", name + ".pfm")
    if os.path.exists(stored):
        return scenes.read_pfm(stored)
    with open(path, "rb") as file:
        image = os.path.join(CACHE, f"{name}.{hashlib.sha256(file.read()).hexdigest()[:12]}.pfm")
    if not os.path.exists(image):
        subprocess.run([os.path.join(ROOT, "build/release/airlight"), "render", path, "--technique", "reference",
                        "--resolution", "%dx%d" % SMALL, "-o", image], check=True)
    return scenes.read_pfm(image)


def load(path, name):
    with open(path, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    kept = os.path.join(CACHE, name + ".json")
    if os.path.exists(kept):
        with open(kept) as file:
            data = json.load(file)
        if data["scene"] == digest:
            return kept, data
    return kept, {"scene": digest, "points": {}}


def quiet(wall, used):
    """Seconds on a machine that does nothing else, if the threads share the work evenly."""
    return min(wall, used / THREADS)


def measure(path, limit):
    """Every setting: error at 160x120, seconds at 800x600 (25 times the small image's where that is beyond the limit)."""
    scene = scenes.read(path)
    kept, data = load(path, scene.name)
    reference = truth(path, scene.name)
    with tempfile.TemporaryDirectory() as folder:
        for module in (povray, cycles):
            last = {}  # family: seconds of the small image per cost
            for family, label, cost, setting in module.settings(scene):
                key = f"{family}, {label}"
                point = data["points"].get(key)
                if not point:
                    if last.get(family, 0) * cost > limit:
                        continue
                    wall, used, image = module.render(scene, setting, *SMALL, folder)
                    error, trimmed = scenes.errors(image, reference)
                    point = {"family": family, "error": error, "trimmed": trimmed, "small_s": quiet(wall, used), "s": SCALE * quiet(wall, used),
                             "wall_s": SCALE * wall, "estimated": True}
                last[family] = point["small_s"] / cost
                if point["estimated"] and SCALE * point["small_s"] < limit:
                    # Short ones thrice: the least is the least disturbed.
                    times = [module.render(scene, setting, *FULL, folder)[:2] for _ in range(3 if SCALE * point["small_s"] < 2 else 1)]
                    point.update(s=min(quiet(*t) for t in times), wall_s=min(t[0] for t in times), estimated=False)
                data["points"][key] = point
                with open(kept, "w") as file:
                    json.dump(data, file, indent=1)
                print(f"{scene.name}: {key}: {100 * point['error']:.3g} %, {'~' if point['estimated'] else ''}{point['s']:.3g} s (wall {point['wall_s']:.3g} s)", flush=True)


def ours(name):
    """(technique on backend, error, seconds)"""
    path = os.path.join(OURS, name + ".csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [(f"{row['technique']} on {row['backend']}", float(row["error"]), float(row["ms"] or 0) / 1000) for row in csv.DictReader(file)]


def front(points):
    """Those (error, seconds) that no other beats, slowest last."""
    best, kept = math.inf, []
    for seconds, error in sorted((s, e) for e, s in points if e > 0 and s > 0 and math.isfinite(e)):
        if error < best:
            best = error
            kept.append((error, seconds))
    return kept


def seconds_at(points, goal):
    """(seconds, mark): log-log between the neighbours on the front; ~ extrapolated, < the fastest is already better; None if it cannot be told."""
    points = front(points)
    if not points:
        return None
    if points[0][0] <= goal:
        return points[0][1], "" if points[0][0] == goal else "<"
    for (e0, s0), (e1, s1) in zip(points, points[1:]):
        if e1 <= goal:
            return s0 * (s1 / s0) ** (math.log(goal / e0) / math.log(e1 / e0)), ""
    if len(points) < 2:
        return None
    (e0, s0), (e1, s1) = points[-2:]
    # The slope of the last pair, within reason: Monte Carlo has -2, quadrature -1/2 and steeper near a lamp; noise can give anything.
    slope = max(min(math.log(s1 / s0) / math.log(e1 / e0), -0.2), -4)
    return s1 * (goal / e1) ** slope, "~"


def families(points):
    out = {}
    for family, error, seconds in points:
        out.setdefault(family, []).append((error, seconds))
    return out


def best(points, goal, trusting):
    """(seconds, mark, family) of the fastest family; an extrapolated one only if trusting or there is no other."""
    found = [(*at, family) for family, group in families(points).items() if (at := seconds_at(group, goal))]
    return min(found, key=lambda f: (not trusting and f[1] == "~", f[0]), default=None)


def number(value, mark=""):
    return mark + (f"{value:.0f}" if value >= 100 else f"{value:.3g}")


def table(rows):
    lines = ["| scene | " + " | ".join(f"best peer at {100 * g:g} % [s] (which) | ours [s] (which) | ratio" for g in GOALS) + " |",
             "|---" * (1 + 3 * len(GOALS)) + "|"]
    ratios = {goal: [] for goal in GOALS}
    for name, peers, mine in rows:
        cells = [name]
        for goal in GOALS:
            theirs, us = best(peers, goal, True), best(mine, goal, False)  # any doubt is the peers' gain
            cells += [f"{number(*b[:2])} ({b[2]})" if b else "–" for b in (theirs, us)]
            if theirs and us:
                ratios[goal].append(theirs[0] / us[0])
                cells.append(number(ratios[goal][-1], "~" if theirs[1] or us[1] else ""))
            else:
                cells.append("–")
        lines.append("| " + " | ".join(cells) + " |")
    cells = ["geometric mean"]
    for goal in GOALS:
        r = ratios[goal]
        cells += ["", "", number(math.exp(sum(map(math.log, r)) / len(r))) if r else "–"]
    return "\n".join(lines + ["| " + " | ".join(cells) + " |"])


def write_table(text):
    path = os.path.join(ROOT, "docs/RESULTS.md")
    with open(path) as file:
        old = file.read()
    new, count = re.subn(r"(<!-- begin peers -->\n).*?(<!-- end peers -->)", lambda m: m[1] + text + "\n" + m[2], old, flags=re.S)
    if count != 1:
        raise SystemExit("docs/RESULTS.md: expected one pair of <!-- begin peers --> and <!-- end peers -->")
    with open(path, "w") as file:
        file.write(new)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", help="names in scenes/peers (all)")
    parser.add_argument("--limit", type=float, default=30, help="render nothing predicted to take more seconds (30)")
    parser.add_argument("--report", action="store_true", help="measure nothing: table and plot of what is there")
    args = parser.parse_args()
    os.makedirs(CACHE, exist_ok=True)
    paths = sorted(glob.glob(os.path.join(ROOT, "scenes/peers/*.json")))
    chosen = [p for p in paths if not args.scenes or os.path.splitext(os.path.basename(p))[0] in args.scenes]
    if not args.report:
        for path in chosen:
            measure(path, args.limit)
    rows = []
    for path in paths:
        name = os.path.splitext(os.path.basename(path))[0]
        points = load(path, name)[1]["points"].values()
        if points:
            rows.append((name, [(p["family"], p["error"], p["s"]) for p in points], ours(name)))
    write_table(table(rows))
    plot.draw([(name, families(peers), families(mine)) for name, peers, mine in rows], front, os.path.join(ROOT, "docs/images/peers"))


if __name__ == "__main__":
    main()
