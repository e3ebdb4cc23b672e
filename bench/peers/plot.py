"""Error over time, one panel a scene."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = {"POV-Ray method 2": "tab:blue", "POV-Ray method 3": "tab:cyan", "Cycles equiangular": "tab:orange",
           "Cycles multiple importance": "tab:brown"}
MARKS = "^vDPX*"


def draw(rows, front, path):
    """rows: (scene, peers, ours), both {family: [(error, seconds)]}"""
    if not rows:
        return
    columns = min(3, len(rows))
    lines = (len(rows) + columns - 1) // columns
    matplotlib.rcParams["svg.hashsalt"] = "airlight"
    figure, axes = pyplot.subplots(lines, columns, figsize=(4.6 * columns, 3.8 * lines), squeeze=False)
    handles = {}
    mine = sorted({family for _, _, ours in rows for family in ours})
    for axis, (name, peers, ours) in zip(axes.flat, rows):
        for group, is_ours in ((peers, False), (ours, True)):
            for family, points in group.items():
                base, _, step = family.partition(", step ")
                style = {"color": "tab:red", "marker": MARKS[mine.index(family) % len(MARKS)]} if is_ours else {
                    "color": COLOURS[base], "marker": "o", "linestyle": {"": "-", "0.4": ":", "0.1": "--"}.get(step, "-")}
                kept = front(points)
                handles[("airlight " if is_ours else "") + family], = axis.plot(
                    [s for _, s in kept], [100 * e for e, _ in kept], markersize=3.5, linewidth=1.2, **style)
        axis.set(xscale="log", yscale="log", title=name, xlabel="seconds at 800 x 600", ylabel="relative RMSE [%]")
        axis.grid(True, which="major", alpha=0.3)
        for goal in (1, 0.1):
            axis.axhline(goal, color="grey", linewidth=0.6, linestyle="--")
    for axis in list(axes.flat)[len(rows):]:
        axis.set_visible(False)
    figure.tight_layout(rect=(0, 0.8 / (3.8 * lines), 1, 1))
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=columns + 1, fontsize=8, frameon=False)
    figure.savefig(path + ".svg", metadata={"Date": None})
    figure.savefig(path + ".png", dpi=110)
