"""Error against cost of every setting of run/tradeoff, above the noise floor."""

from pounding.files import written_beside

from . import style


def draw(summary: list, path, spectra: str = "floor-2") -> None:
    """`summary`: a row per setting, as tradeoffs.study.summarised gives them; `spectra`: whose error it is."""
    figure, axes = style.plt.subplots(figsize=(style.WIDTH, 5.5))
    savings = [row for row in summary if not row["noise"] and row["median rms"] > 0]
    noise = [row["rms"] for row in summary if row["noise"] and row["rms"] > 0]
    full = [row for row in summary if row["setting"] == "full"]
    if noise:
        axes.axhspan(min(noise), max(noise), color="#DDDDDD", zorder=0,
                     label="noise floor: shaking + 0.1 %, gaps + 0.01 mm, half the step")
    for row in full:
        axes.axvline(row["per_second"], color="#666666", linewidth=1, linestyle="--", label="full order")
    best = float("inf")
    front = []
    for row in sorted(savings, key=lambda row: row["per_second"]):
        on_front = row["rms"] < best
        best = min(best, row["rms"])
        front += [row] if on_front else []
        color = "#0072B2" if on_front else "#9A9A9A"
        axes.plot(row["per_second"], row["rms"], "o", color=color, zorder=3)
        axes.plot([row["per_second"]] * 2, [row["median rms"], row["rms"]], color=color, linewidth=1, zorder=2)
        axes.plot(row["per_second"], row["median rms"], "o", color=color, markerfacecolor="white", markersize=4,
                  zorder=3)
    style.log_scale(axes, "x", [row["per_second"] for row in summary])
    if savings:
        style.log_scale(axes, "y", [row[key] for row in savings for key in ("rms", "median rms")] + noise)
    axes.axvline(1.0, color="#B2182B", linewidth=1, linestyle=":", label="as fast as the earthquake")
    axes.plot([], [], "o", color="#0072B2", label="worst case, on the front")
    axes.plot([], [], "o", color="#9A9A9A", label="worst case")
    axes.plot([], [], "o", color="#9A9A9A", markerfacecolor="white", markersize=4, label="median case")
    axes.set_xlabel("wall time per second of motion [s/s]")
    axes.set_ylabel(f"rms of ln(spectrum / reference), {spectra} spectra, 1-400 Hz [-]")
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, columnspacing=1.2)
    _name(figure, axes, front + [row for row in savings if row not in front])
    with written_beside(path) as draft:
        figure.savefig(draft)
    style.plt.close(figure)


def _name(figure, axes, rows: list) -> None:
    """Writes the name of each setting beside its point, the first of them first, where none stands yet."""
    figure.canvas.draw()
    taken = []
    for row in rows:
        for place in ((5, 4), (5, -10), (-5, 4), (-5, -10)):
            text = axes.annotate(row["setting"], (row["per_second"], row["rms"]), xytext=place, fontsize=8,
                                 textcoords="offset points", ha="left" if place[0] > 0 else "right")
            box = text.get_window_extent(figure.canvas.get_renderer())
            outside = box.x0 < axes.bbox.x0 or box.x1 > axes.bbox.x1
            if outside or any(box.overlaps(other) for other in taken):
                text.remove()
                continue
            taken.append(box)
            break
