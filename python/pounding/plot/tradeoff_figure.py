"""Error against cost of every setting of run/tradeoff: true and told, above the noise floor."""

from pounding.files import written_beside

from . import style

RECOMMENDED = "#B2182B"


def draw(summary: list, path, spectra: str = "floor-2", taken: tuple = ()) -> None:
    """`summary`: a row per setting, as pounding.tradeoff.study.summarised gives them; `spectra`: whose error it is; `taken`:
    settings that are recommended. Beside the worst case of a setting stands the error that it tells, or the median case."""
    figure, axes = style.plt.subplots(figsize=(style.WIDTH, 5.5))
    of_pair = any(row["cases"] > 1 for row in summary)
    beside = "median rms" if of_pair else "estimate"
    savings = [row for row in summary if not row["noise"] and max(row["rms"], row[beside] or 0) > 0]
    full = next(row for row in summary if row["setting"] == "full")
    noise = [row["rms"] for row in summary if row["noise"] and row["rms"] > 0 and full["rms"] == 0]
    if noise:
        what = "shaking + 0.1 %, gaps + 0.01 mm, half the step" if len(noise) > 1 else "half the step"
        axes.axhspan(min(noise), max(noise), color="#DDDDDD", zorder=0, label=f"noise floor: {what}")
    told = [full[f"told {part}"] for part in ("step", "mesh") if full.get(f"told {part}")]
    for part, line in (("step", ":"), ("mesh", "-.")):
        if full.get(f"told {part}"):
            axes.axhline(full[f"told {part}"], color="#009E73", linewidth=1, linestyle=line,
                         label=f"error of the {part}, estimated")
    axes.axvline(full["per_second"], color="#666666", linewidth=1, linestyle="--", label="full order")
    best = float("inf")
    front = []
    for row in sorted(savings, key=lambda row: row["per_second"]):
        errors = [value for value in (row["rms"], row[beside]) if value]
        on_front = max(errors) < best
        best = min(best, *errors) if of_pair else min(best, max(errors))
        front += [row] if on_front else []
        color = RECOMMENDED if row["setting"] in taken else "#0072B2" if on_front else "#9A9A9A"
        axes.plot([row["per_second"]] * len(errors), errors, color=color, linewidth=1, zorder=2)
        if row["rms"]:
            axes.plot(row["per_second"], row["rms"], "o", color=color, zorder=3)
        if row[beside]:
            axes.plot(row["per_second"], row[beside], "o" if of_pair else "D", color=color, markerfacecolor="white",
                      markersize=4 if of_pair else 5, zorder=3)
    style.log_scale(axes, "x", [row["per_second"] for row in summary])
    if savings:
        style.log_scale(axes, "y", [row[key] for row in savings for key in ("rms", beside) if row[key]] + noise + told)
    axes.axvline(1.0, color="#B2182B", linewidth=1, linestyle=":", label="as fast as the earthquake")
    error = "worst case" if of_pair else "true error"
    for color, label in (("#0072B2", f"{error}, on the front"), ("#9A9A9A", error), (RECOMMENDED, "recommended")):
        axes.plot([], [], "o", color=color, label=label)
    axes.plot([], [], "o" if of_pair else "D", color="#9A9A9A", markerfacecolor="white",
              label="median case" if of_pair else "estimated error")
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
            text = axes.annotate(row["setting"], (row["per_second"], row["rms"] or row["estimate"]), xytext=place, fontsize=8,
                                 textcoords="offset points", ha="left" if place[0] > 0 else "right")
            box = text.get_window_extent(figure.canvas.get_renderer())
            outside = box.x0 < axes.bbox.x0 or box.x1 > axes.bbox.x1
            if outside or any(box.overlaps(other) for other in taken):
                text.remove()
                continue
            taken.append(box)
            break
