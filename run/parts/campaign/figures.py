"""The figures of the paper, drawn from our own results of its cases. Spectra at 5 % damping."""

import numpy as np

from pounding.plot.style import WIDTH, legend_above, log_scale, plt, save, stacked

from . import paper
from .cases import VARIANTS
from .findings import SLAB_MODE
from .results import TREATMENTS, Campaign

COLOURS = {"A": "#08519C", "B": "#E69F00", "A-symmetric": "#B2182B", "A-apart": "#777777"}
TREATMENT_STYLES = {"complete": ("#222222", "-", 1.8), "all_peaks": ("#0072B2", "--", 1.4),
                    "highest_peak": ("#009E73", "-.", 1.4), "without_peaks": ("#999999", "-", 1.2),
                    "dirac": ("#C0392B", ":", 1.6)}
FACE_WIDTH = 2.28  # [m]
AMPLITUDE = 0.35  # of the largest displacement, drawn [m]
FACE_COLOURS = ("#9ECAE1", "#08519C")  # lower and upper faces


def _gap_name(gap: int) -> str:
    return f"gap {gap} cm"


def present(campaign: Campaign) -> tuple[list, list]:
    """Motions and gaps of which there are results, in the paper's order."""
    keys = {(one.case.motion, one.case.gap) for one in campaign.all()}
    return ([motion for motion in paper.MOTIONS if any(motion == key[0] for key in keys)],
            [gap for gap in paper.GAPS if any(gap == key[1] for key in keys)])


def gaps(campaign: Campaign, folder) -> list:
    figure, rows = plt.subplots(1, 3, figsize=(WIDTH, 2.8), sharey=True)
    for axes, gap in zip(rows, paper.GAPS):
        corners = paper.CORNERS[gap]
        for floor, (start, end), colour in (("floor 1", "DC", "#7FB0D9"), ("floor 2", "AB", "#08519C")):
            values = [corners[start], corners[end]]
            axes.plot([0, FACE_WIDTH], values, "o-", color=colour,
                      label=f"{floor}: {start} {values[0]}, {end} {values[1]} cm")
        axes.axhline(gap, color="#B2182B", lw=0.8, ls="--", label="nominal")
        axes.set(title=_gap_name(gap), xlabel="along the face, y [m]")
        axes.set_ylim(-0.4, 8)
        axes.legend(loc="upper right", fontsize=8)
    rows[0].set_ylabel("distance of the faces [cm]")
    return save(figure, folder, "fig4_gaps.png", "Fig. 4: gaps",
                "Initial distances between the faces, as measured in the tests and as applied here; dashed: "
                "the symmetric variant.")


def histories(campaign: Campaign, folder, motion: str = "Kobe") -> list:
    shown = [gap for gap in paper.GAPS if campaign.get(gap, motion, "A")]
    if not shown:
        return []
    figure, grid = plt.subplots(len(shown), 2, figsize=(WIDTH, 0.6 + 2.0 * len(shown)), sharex=True, squeeze=False)
    for (left, right), gap in zip(grid, shown):
        for variant in ("B", "A"):
            one = campaign.get(gap, motion, variant)
            if one is None:
                continue
            style = {"color": COLOURS[variant], "lw": 0.8, "label": VARIANTS[variant]}
            left.plot(one.series["drift_time"], 100 * one.series["drift"], **style)
            right.plot(one.series["acceleration_time"], one.series["acceleration"] / paper.G, **style)
        left.set(title=f"{_gap_name(gap)}: drift", ylabel="drift [%]")
        count = campaign.get(gap, motion, "A").count("floor2")
        right.set(title=f"{_gap_name(gap)}: acceleration, {count} impacts", ylabel="acceleration [g]")
    legend_above(grid[0, 0], columns=2)
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    return save(figure, folder, "fig5_drift_acceleration.png", "Fig. 5: drift and acceleration",
                f"Structure 2 under {motion}: drift of the second storey over its height, absolute acceleration "
                "of the second floor; no experimental series is printed to set beside them.")


def _panels(campaign: Campaign, draw, folder, name: str, title: str, caption: str, height: float = 2.3) -> list:
    """A panel per motion (rows) and gap (columns); `draw(axes, motion, gap)` may draw nothing."""
    motions, columns = present(campaign)
    figure, grid = plt.subplots(len(motions), len(columns), figsize=(WIDTH, 0.9 + height * len(motions)),
                                squeeze=False, sharex=True, sharey="row")
    handles = {}
    for row, motion in zip(grid, motions):
        for axes, gap in zip(row, columns):
            draw(axes, motion, gap)
            lines = axes.get_lines()
            log_scale(axes, "x", [0.5, 400])
            log_scale(axes, "y", np.concatenate([line.get_ydata() for line in lines]) if lines else [1, 10])
            axes.set_xlim(0.5, 400)
            axes.set_title(f"{motion}, {_gap_name(gap)}", fontsize=9)
            for handle, label in zip(*axes.get_legend_handles_labels()):
                handles.setdefault(label, handle)
        row[0].set_ylabel("PSA [m/s²]")
    for axes in grid[-1]:
        axes.set_xlabel("frequency [Hz]")
    above = 0.35 / figure.get_figheight()  # for the legend
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - above))
    if handles:
        figure.legend(handles.values(), handles.keys(), loc="upper center", ncol=5)
    return save(figure, folder, name, title, caption)


def spectra(campaign: Campaign, folder) -> list:
    def draw(axes, motion, gap):
        for variant in ("A-apart", "A-symmetric", "B", "A"):
            one = campaign.get(gap, motion, variant)
            if one:
                axes.plot(one.frequency, one.roof, color=COLOURS[variant], lw=1.3, label=VARIANTS[variant])

    return _panels(campaign, draw, folder, "fig6_spectra.png", "Fig. 6: floor response spectra",
                   "Second floor of Structure 2 along the direction of the impacts.")


def treated_spectra(campaign: Campaign, folder) -> list:
    def draw(axes, motion, gap):
        one = campaign.get(gap, motion, "A")
        for name in TREATMENTS if one and one.treated else ():
            colour, line, width = TREATMENT_STYLES[name]
            axes.plot(one.frequency, one.treated[name], line, color=colour, lw=width, label=name.replace("_", " "))

    return _panels(campaign, draw, folder, "fig8_treated_spectra.png", "Fig. 8: spectra of the treated signals",
                   "Model A, second floor of Structure 2: the complete signal, all its peaks, the peak with the "
                   "highest impulse, the signal without peaks, and a Dirac of the same impulse, its base two time "
                   "steps.")


def first_floor(campaign: Campaign, folder) -> list:
    def draw(axes, motion, gap):
        axes.axvspan(*SLAB_MODE, color="#C0392B", alpha=0.12, lw=0)
        for variant in ("B", "A"):
            one = campaign.get(gap, motion, variant)
            if one:
                hit = one.count("floor1")
                axes.plot(one.frequency, one.spectra["s1_floor1.x"], color=COLOURS[variant], lw=1.3,
                          label=VARIANTS[variant])
                if hit and variant == "A":
                    axes.text(0.03, 0.04, f"hit {hit} times", transform=axes.transAxes, fontsize=7, color="#555555")

    return _panels(campaign, draw, folder, "fig9_first_floor.png", "Fig. 9: first floor",
                   "First floor of Structure 1; the strip holds the antisymmetric mode of its slab.")


def treatments(campaign: Campaign, folder) -> list:
    """The case of Model A whose highest peak is the highest of all."""
    cases = [one for one in campaign.of("A") if one.peaks]
    if not cases:
        return []
    one = max(cases, key=lambda result: max(abs(peak["impulse"]) for peak in result.peaks))
    time, values = one.series["acceleration_time"], one.series["acceleration"] / paper.G
    within = np.zeros(len(time), dtype=bool)
    highest = within.copy()
    for peak in one.peaks:
        inside = (time >= peak["start"]) & (time <= peak["end"])
        within |= inside
        if peak["highest"]:
            highest |= inside
    figure, rows = stacked(3, 1.9, sharey=True)
    for axes, kept, title in ((rows[0], within, "(a) all peaks"), (rows[1], highest, "(b) the peak with the highest "
                              "impulse"), (rows[2], ~within, "(c) without peaks")):
        axes.plot(time, values, color="#CCCCCC", lw=0.7)
        axes.plot(time, np.where(kept, values, 0), color="#08519C", lw=0.8)
        axes.set(title=title, ylabel="acceleration [g]")
    rows[2].set_xlabel("time [s]")
    return save(figure, folder, "fig7_treatments.png", "Fig. 7: treatments of a signal",
                f"Second floor of Structure 2, Model A, gap {one.case.gap} cm, {one.case.motion}; grey: complete.")


def contact_places(campaign: Campaign, folder) -> list:
    """Not in the paper: duration, impulse and place of every impact of Model A."""
    hits = [(one, hit) for one in campaign.of("A") for hit in one.impacts]
    if not hits:
        return []
    figure, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 3.6))
    for gap, colour in zip(paper.GAPS, ("#08519C", "#009E73", "#B2182B")):
        own = [hit for one, hit in hits if one.case.gap == gap]
        if not own:
            continue
        column = {name: np.array([hit[name] for hit in own]) for name in ("impulse", "contact_time", "left", "bottom")}
        left.plot(column["impulse"], 1e3 * column["contact_time"], "o", ms=3.5, alpha=0.6, color=colour,
                  label=_gap_name(gap))
        right.plot(100 * column["left"], 100 * column["bottom"], "o", ms=3.5, alpha=0.6, color=colour,
                   label=_gap_name(gap))
    left.set(xlabel="impulse [N s]", ylabel="time in contact [ms]", title="impulse and duration")
    log_scale(left, "x", [hit["impulse"] for _, hit in hits])
    log_scale(left, "y", [1e3 * hit["contact_time"] for _, hit in hits])
    right.set(xlabel="share of the half at y = 0 [%]", ylabel="share of the lower half [%]",
              title="where the impulse acts", xlim=(-5, 105), ylim=(-5, 105))
    left.legend(loc="best")
    return save(figure, folder, "impact_places.png", "Impacts: impulse, duration, place",
                "Every impact of Model A with its measured gaps: durations from the multipliers; shares of the "
                "impulse in the halves of the face.")


def _surface(axes, mode, height: float, colour: str) -> None:
    """One plane of nodes, displaced."""
    own = np.isclose(mode.nodes[:, 2], height, atol=1e-6)
    nodes, moved = mode.nodes[own], mode.nodes[own] + AMPLITUDE * mode.shape[own]
    order = np.lexsort((nodes[:, 0], np.round(nodes[:, 1], 6)))
    rows = len(set(np.round(nodes[:, 1], 6)))
    x, y, z = (moved[order, i].reshape(rows, -1) for i in range(3))
    axes.plot_wireframe(x, y, z, color=colour, lw=0.4)


def slab_modes(modes: list, folder) -> list:
    """The antisymmetric mode of the slabs, Models A and B side by side."""
    if not modes:
        return []
    figure = plt.figure(figsize=(WIDTH, 4.4))
    for number, mode in enumerate(modes, start=1):
        axes = figure.add_subplot(1, len(modes), number, projection="3d")
        for height in mode.faces:
            _surface(axes, mode, height, FACE_COLOURS[height - np.floor(2 * height) / 2 > 0.1])
        dots = mode.nodes[mode.dots] + AMPLITUDE * mode.shape[mode.dots]
        axes.scatter(*dots.T, color="black", s=18, depthshade=False)
        axes.set_box_aspect((3.36, 2.28, 3.0))
        axes.view_init(elev=14, azim=-70)
        axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        axes.set_title(f"Model {mode.model}: {mode.frequency:.1f} Hz; along x {mode.at_dots:+.3f} at the dots, "
                       f"{mode.at_middle:+.3f} at mid-plane", fontsize=8)
    return save(figure, folder, "fig10_slab_mode.png", "Fig. 10: antisymmetric mode of the slabs",
                "Structure 1, largest displacement 1, amplified; black: accelerometers of floor 1. They lie "
                "on the upper face in Model A, which moves along x, on the mid-plane in Model B, which hardly does.")


ALL = (gaps, histories, spectra, treatments, treated_spectra, first_floor, contact_places)
