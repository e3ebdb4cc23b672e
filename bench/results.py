#!/usr/bin/env python3
"""bench/results.py OUT: puts what bench/run left in OUT into docs/RESULTS.md.

What stands between <!-- begin NAME --> and <!-- end NAME --> is made again; all other text stays. A block whose figures are not in
OUT stays as it is. Figures of the fronts are copied to docs/images.
"""
import csv
import json
import math
import os
import re
import shutil
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RESULTS = os.path.join(ROOT, "docs", "RESULTS.md")
IMAGES = os.path.join(ROOT, "docs", "images")


def short(value):
    """Three digits, of small values two; no exponent."""
    if value == 0:
        return "0"
    digits = max(0, (2 if value >= 0.1 else 1) - math.floor(math.log10(value)))
    return f"{value:.{digits}f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read().splitlines()


def machine(out):
    return "\n".join("* " + line for line in lines_of(os.path.join(out, "machine.txt")))


def frames(out):
    scenes = {}
    with open(os.path.join(out, "frames.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            scenes.setdefault(row["scene"], {}).setdefault(row["row"], {})[row["what"]] = float(row["ms"])
    blocks = []
    for scene, rows in scenes.items():
        names = list(rows)
        what = list(rows[names[0]])
        body = [[name] + [short(rows[name][w]) for w in what] for name in names]
        if "gl" in rows:
            # CPU steps are thread time summed over two workers, those of GL are wall time on the same cores.
            share = [1 if w in ("frame", "steps") else 2 for w in what]
            first = rows[names[0]]
            ratios = [short(k * rows["gl"][w] / first[w]) if first[w] > 0 else "" for k, w in zip(share, what)]
            body.append(["**gl / first row**"] + [f"**{r}**" for r in ratios])
        blocks.append(table([scene + " [ms]"] + what, body))
    return "\n\n".join(blocks)


def kernels(out):
    with open(os.path.join(out, "kernels.json"), encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    cases, columns = {}, []
    for run in runs:
        match = re.fullmatch(r"(.*?/.*?)/(cpu/.*|gl)/real_time", run["name"])
        if not match or run.get("error_occurred"):
            continue
        case, backend = match.groups()
        cases.setdefault(case, {})[backend] = run["real_time"]
        if backend not in columns:
            columns.append(backend)
    best = [c for c in columns if c.endswith("/2") and c not in ("cpu/not_fused/2", "cpu/scalar/2")]
    compare = best[-1] if best else "cpu/scalar/2"
    rows = []
    for case, times in cases.items():
        row = [case] + [short(times[c]) if c in times else "" for c in columns]
        rows.append(row + [short(times["gl"] / times[compare]) if "gl" in times and compare in times else ""])
    return table(["400 x 300 [ms]"] + columns + ["gl / " + compare], rows)


def startup(out):
    rows = []
    for line in lines_of(os.path.join(out, "startup.txt")):
        match = re.fullmatch(r"(.*?)\s+([\d.]+) ms, median\s+([\d.]+) ms", line)
        rows.append([match.group(1), short(float(match.group(2)) / 1e3), short(float(match.group(3)) / 1e3)])
    return table(["process start to exit [s]", "best of 11", "median"], rows)


def instructions(out):
    lines = lines_of(os.path.join(out, "instructions.txt"))
    groups = {}
    for line in lines:
        match = re.fullmatch(r"(\w+)/\S+\s+([\d.]+|-)\s+([\d.]+)\s+([\d.]+|new).*", line)
        if match:
            groups.setdefault(match.group(1), []).append((match.group(2), float(match.group(3))))
    rows = []
    for name, counts in groups.items():
        before, now = [c[0] for c in counts], sum(c[1] for c in counts)
        stored = "" if "-" in before else f"{now / sum(map(float, before)):.4f}"
        rows.append([name, str(len(counts)), short(now), stored])
    summary = [line for line in lines if line.startswith("# ") or " cases, " in line]
    head = ["algorithm", "cases", "millions of instructions", "ratio to `bench/instructions.csv`"]
    return "\n\n".join([summary[0][len("# now: "):] + ".", table(head, rows), summary[-1][0].upper() + summary[-1][1:] + "."])


def shadows(out):
    return "\n".join(lines_of(os.path.join(out, "shadows.txt"))).strip()


def rules(out):
    return "\n".join(lines_of(os.path.join(out, "rules.txt"))).strip()


def sampled(out):
    return "\n".join(lines_of(os.path.join(out, "sampled.txt"))).strip()


def propagation(out):
    return "```\n" + "\n".join(lines_of(os.path.join(out, "propagation.txt"))).strip() + "\n```"


def gaussians(out):
    return "```\n" + "\n".join(lines_of(os.path.join(out, "gaussians.txt"))).strip() + "\n```"


def erf(out):
    """Two tables of bench/erf.cpp: by name, a column an instruction set; the best of all repetitions, by CPU time."""
    with open(os.path.join(out, "erf.json"), encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    found, targets, limit = {"erf": {}, "line": {}}, [], {}
    for run in sorted((r for r in runs if r["run_type"] == "iteration"), key=lambda r: (r["family_index"], r["items_per_second"])):
        kind, rest = run["name"].split("/", 1)
        name, target = rest.rsplit("/", 1)
        if kind == "limit":
            limit[name, target] = run["items_per_second"]
            continue
        found[kind].setdefault(name, {})[target] = run
        if target not in targets:
            targets.append(target)

    def rows(kind, text):
        for name, by_target in found[kind].items():
            cells, shares = [], []
            for t in targets:
                run = by_target.get(t)
                cells.append(text(run["items_per_second"]) if run else "")
                if run and "multiplications" in run and ("fma", t) in limit:
                    shares.append(f"{100 * run['multiplications'] * run['items_per_second'] / limit['fma', t]:.0f} %")
            error = max(run["error"] for run in by_target.values())
            yield [name] + cells + [f"{error:.1e}", " / ".join(shares)]

    share = "of the multiplication ports, " + " / ".join(t for t in targets if ("fma", t) in limit)
    erfs = table(["erf [ns]"] + targets + ["largest error", share], rows("erf", lambda rate: f"{1e9 / rate:.3f}"))
    lines = table(["Gaussian x ray [10^9/s]"] + targets + ["largest error", share], rows("line", lambda rate: f"{rate / 1e9:.3f}"))
    ports = ", ".join(f"{t}: {limit['fma', t] / 1e9:.1f} multiply-adds, {limit['sqrt', t] / 1e9:.1f} square roots"
                      for t in targets if ("fma", t) in limit)
    return f"{erfs}\n\n{lines}\n\nPorts, measured in the same run [10^9/s]: {ports}."


def choice(points, backend, error):
    """The fastest timed configuration of the backend within the error."""
    within = [p for p in points if p["backend"] == backend and p["ms"] and p["error"] is not None and p["error"] <= error]
    if not within:
        return ["", ""]
    best = min(within, key=lambda p: p["ms"])
    same = [p["knobs"] for p in points if p["technique"] == best["technique"]]
    knobs = [f"{k} {v}" for k, v in best["knobs"].items() if any(other.get(k) != v for other in same)]
    return [best["technique"] + (", " + " ".join(knobs) if knobs else ""), short(best["ms"])]


def pareto(out):
    folder = os.path.join(out, "fronts")
    blocks = []
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".json"):
            continue
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            m = json.load(file)
        scene = m["scene"]
        for extension in (".svg", ".png"):
            shutil.copyfile(os.path.join(folder, scene + extension), os.path.join(IMAGES, f"pareto_{scene}{extension}"))
        backends = list(m["devices"])
        rows, last = [], None
        for percent in (30, 10, 3, 1, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001):
            row = [cell for b in backends for cell in choice(m["points"], b, percent / 100)]
            if not any(row):
                break
            if row == last:
                rows[-1][0] = f"{percent:g} %"  # the smallest error that this is good for
            else:
                rows.append([f"{percent:g} %"] + row)
            last = row
        block = [f"**{scene}**, {len(m['points'])} configurations:", f"![{scene}: time against error](images/pareto_{scene}.svg)"]
        if rows:
            block.append(table(["error at most"] + [c for b in backends for c in (f"fastest on {b}", "ms")], rows))
        if m["left_out"]:
            block.append("\n".join("* not measured: " + line for line in m["left_out"]))
        blocks.append("\n\n".join(block))
    return "\n\n".join(blocks)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: bench/results.py OUT")
    out = sys.argv[1]
    with open(RESULTS, encoding="utf-8") as file:
        text = file.read()
    makers = {"machine": (machine, "machine.txt"), "frames": (frames, "frames.csv"), "kernels": (kernels, "kernels.json"),
              "startup": (startup, "startup.txt"), "instructions": (instructions, "instructions.txt"), "pareto": (pareto, "fronts"),
              "shadows": (shadows, "shadows.txt"), "rules": (rules, "rules.txt"),
              "propagation": (propagation, "propagation.txt"), "sampled": (sampled, "sampled.txt"),
              "gaussians": (gaussians, "gaussians.txt"), "erf": (erf, "erf.json")}
    for name, (make, needs) in makers.items():
        begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
        if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
            sys.exit(f"docs/RESULTS.md: expected one block between {begin} and {end}")
        if not os.path.exists(os.path.join(out, needs)) or os.path.getsize(os.path.join(out, needs)) == 0:
            print(f"{name}: nothing measured, kept", file=sys.stderr)
            continue
        text = text[:text.index(begin) + len(begin)] + "\n" + make(out) + "\n" + text[text.index(end):]
    with open(RESULTS + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(RESULTS + ".part", RESULTS)


main()
