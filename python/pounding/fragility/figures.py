"""Figures of a study."""

from pathlib import Path

import numpy as np
from scipy import stats

from pounding.plot.style import WIDTH, WITH, WITHOUT, g_axis, log_scale, plt, save
from pounding.fragility import Fragility, moments, scatter

from .analysis import CONTACT, EXCEEDED, Analysis, gap_text, name_of
from .study import own_gap

COLOURS = ("#08519C", "#0072B2", "#009E73", "#E69F00", "#D55E00", "#B2182B", "#762A83")
STEPS = 40  # contours of the map between two levels


def shown(analysis: Analysis) -> tuple:
    """Gap, level, channel and damping ratio that figures of spectra show: those of `show`, else the joint of the scene
    where the study has it, in the cell that touches in about half of its members, and there the channel whose mean
    pounding raises most, of those that move without."""
    study, found = analysis.study, analysis.outcomes
    own = own_gap(study)
    share = {(gap, level): analysis.hits(CONTACT, gap)[:, k].mean() for gap in ([own] if own is not None else study.gaps)
             for k, level in enumerate(study.levels)}
    best = max(share, key=lambda cell: (-abs(share[cell] - 0.5), cell[1]))
    gap, level = (float(study.show.get(key, default)) for key, default in zip(("gap", "level"), best))
    damping = analysis.damping(0.05)
    raised = (found.spectra[analysis.of(gap, level)].mean(0)[:, damping].max(-1)
              - found.spectra[analysis.of(None, level)].mean(0)[:, damping].max(-1))
    channel = max(analysis.main(found.spectra[analysis.of(None, level)]), key=lambda number: raised[number])
    if "channel" in study.show:
        channel = found.channels.index(study.show["channel"])
    return gap, level, channel, damping


def draw_floor(axes, analysis: Analysis) -> str:
    """Median floor spectrum with its 16-84 % band, with and without pounding; returns its caption."""
    gap, level, channel, damping = shown(analysis)
    found = analysis.outcomes
    for cell, colour, label in ((None, WITHOUT, "without pounding"), (gap, WITH, "with pounding")):
        one = moments(found.spectra[analysis.of(cell, level)][:, channel, damping])
        axes.fill_between(found.frequency, one.low, one.high, color=colour, alpha=0.25, lw=0)
        axes.plot(found.frequency, one.median, color=colour, lw=1.5, label=label)
    log_scale(axes, "x", found.frequency)
    log_scale(axes, "y", found.spectra[analysis.of(gap, level)][:, channel, damping])
    axes.set(xlim=(found.frequency[0], found.frequency[-1]), xlabel="frequency [Hz]",
             ylabel="pseudo-acceleration [m/s²]",
             title=f"{found.channels[channel]}, {analysis.study.joint_named(gap)}, {level / 9.81:.2g} g")
    axes.legend(loc="upper left")
    g_axis(axes)
    return (f"Median and 16-84 % band of {analysis.study.samples} members, {100 * found.damping[damping]:g} % damping: "
            f"{found.channels[channel]}, {analysis.study.joint_named(gap)}, peak ground acceleration {level:g} m/s².")


def _edges(values: list) -> np.ndarray:
    """Edges of cells around values, halfway between them."""
    values = np.asarray(values, float)
    if len(values) == 1:
        return np.array([0.5, 1.5]) * values[0] if values[0] > 0 else np.array([-0.5, 0.5])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[max(0.0, 2 * values[0] - middle[0])], middle, [2 * values[-1] - middle[-1]]])


def draw_map(axes, analysis: Analysis) -> str:
    """P(contact) over gap and level, with its interval in every cell, and lines of the joints that runs apart need."""
    study = analysis.study
    _, part, low, high = np.array([analysis.probability(CONTACT, gap) for gap in study.gaps]).swapaxes(0, 1)
    places, levels = 1e3 * np.array(study.gaps), np.array(study.levels) / 9.81
    picture = axes.pcolormesh(_edges(places), _edges(levels), part.T, cmap="YlOrRd", vmin=0, vmax=1)
    for i, gap in enumerate(places):
        for k, level in enumerate(levels):
            axes.text(gap, level, f"{part[i, k]:.2f}\n{low[i, k]:.2f}-{high[i, k]:.2f}", ha="center", va="center",
                      fontsize=7, color="white" if part[i, k] > 0.6 else "black")
    needed = 1e3 * analysis.needed(torsion=1)
    for beyond, style in zip(EXCEEDED, ("-", "--", ":")):
        axes.plot(np.quantile(needed, 1 - beyond, axis=0), levels, color="#1B4F72", ls=style, lw=1.6,
                  label=f"{100 * beyond:g} % would need more")
    axes.set(xlim=_edges(places)[[0, -1]], ylim=_edges(levels)[[0, -1]])
    axes.grid(False)
    axes.set(xlabel=f"{study.width_title} [mm]", ylabel="peak ground acceleration [g]",
             title="Probability that the buildings touch")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), fontsize=8, ncol=3, columnspacing=1.0)
    axes.figure.colorbar(picture, ax=axes, label="P(contact)")
    return (f"{study.samples} members in each cell, with the {100 * study.confidence:g} % interval of Clopper and "
            "Pearson; lines: joints beyond which so many of the runs without pounding would need to be apart.")


def draw_bars(axes, analysis: Analysis, event) -> str:
    """The probability of an event at the only level, a bar for each joint with its interval; returns its caption."""
    study, gaps = analysis.study, analysis.gaps_of(event)
    _, share, low, high = np.array([analysis.probability(event, gap) for gap in gaps])[..., 0].T
    axes.bar(range(len(gaps)), share, width=0.6, color=[WITHOUT if gap is None else WITH for gap in gaps], alpha=0.7,
             yerr=np.clip([share - low, high - share], 0, None), capsize=4, ecolor="#333333")
    axes.set_xticks(range(len(gaps)), ["apart" if gap is None else f"{1e3 * gap:g} mm" for gap in gaps])
    axes.set(ylim=(0, 1.03), xlabel=study.width_title, ylabel="probability")
    axes.grid(axis="x", visible=False)
    return (f"{study.samples} members in each joint at {study.levels[0]:g} m/s², with the {100 * study.confidence:g} % interval of "
            "Clopper and Pearson.")


def summary(analysis: Analysis, folder: Path) -> list:
    figure, panels = plt.subplots(1, 2, figsize=(1.35 * WIDTH, 4.6))
    if len(analysis.study.levels) > 1:
        captions = draw_floor(panels[0], analysis), draw_map(panels[1], analysis)
    else:
        captions = draw_floor(panels[0], analysis), draw_bars(panels[1], analysis, CONTACT)
        panels[1].set_title("Probability that the buildings touch")
    return save(figure, folder, "fragility.png", "Floor spectrum and probability of contact", " ".join(captions),
                columns=[[panels[0]], [axes for axes in figure.axes if axes is not panels[0]]])


def scatter_parts(analysis: Analysis, folder: Path) -> list:
    """Deviations of ln S over the frequency in the cell and of the channel that other figures show: of all, of the
    joint with the motion held, of the motion with the joint held."""
    gap, level, channel, damping = shown(analysis)
    found = analysis.outcomes
    one = scatter(*(values[:, 0, damping] for values in analysis.logarithms(gap, level, [channel])))
    figure, axes = plt.subplots(figsize=(WIDTH, 3.6))
    for values, colour, label in ((one.all, "black", "motion, building and joint"), (one.motion, WITHOUT, "motion and building alone"),
                                  (one.joint, WITH, "joint alone")):
        axes.plot(found.frequency, values, color=colour, lw=1.5, label=label)
    log_scale(axes, "x", found.frequency)
    axes.set(xlim=(found.frequency[0], found.frequency[-1]), ylim=(0, None), xlabel="frequency [Hz]",
             ylabel="deviation of ln S",
             title=f"{found.channels[channel]}, {analysis.study.joint_named(gap)}, {level / 9.81:.2g} g")
    axes.legend(loc="upper left")
    return save(figure, folder, "scatter.png", "How much of the scatter is the joint's",
                f"Standard deviation of the logarithm of the spectrum over {analysis.study.samples} samples, "
                f"{100 * found.damping[damping]:g} % damping: {found.channels[channel]}, {analysis.study.joint_named(gap)}, "
                f"{level:g} m/s²; and of what varies alone while the rest is held.")


def curves(analysis: Analysis, fits: dict, folder: Path) -> list:
    """A panel per event: shares with their intervals, and the curves that fit."""
    study, events = analysis.study, analysis.events
    width = max(0.75 * WIDTH, 4.6 * len(events))
    figure, panels = plt.subplots(1, len(events), figsize=(width, 4.2), squeeze=False, sharey=True)
    levels = np.linspace(0.0, 1.15 * study.levels[-1], 300)[1:]
    if len(study.levels) == 1:
        for axes, event in zip(panels[0], events):
            words = draw_bars(axes, analysis, event)
            axes.set_title(name_of(event), fontsize=8)
            axes.tick_params(labelleft=True)
        return save(figure, folder, "curves.png", "Probability by joint", words, columns=[[axes] for axes in panels[0]])
    for axes, event in zip(panels[0], events):
        for gap, colour in zip(analysis.gaps_of(event), COLOURS * 9):
            _, share, low, high = analysis.probability(event, gap)
            label = "apart" if gap is None else f"{1e3 * gap:g} mm"
            axes.errorbar(np.array(study.levels) / 9.81, share, (share - low, high - share), fmt="o", ms=4,
                          color=colour, lw=0.9, capsize=2, label=label)
            fit = fits[event][gap]
            if isinstance(fit, Fragility):
                axes.plot(levels / 9.81, fit.probability(levels), color=colour, lw=1.4)
        axes.set_title(name_of(event), fontsize=8)
        axes.tick_params(labelleft=True)
        axes.set(xlabel="peak ground acceleration [g]", ylim=(-0.03, 1.03))
        axes.legend(fontsize=8)
    panels[0][0].set_ylabel("probability")
    return save(figure, folder, "curves.png", "Fragility curves", "Shares with their intervals, and lognormal curves "
                "of largest likelihood where the counts allow one, by joint.", columns=[[axes] for axes in panels[0]])


def enough(analysis: Analysis, folder: Path) -> tuple:
    """Half width of the interval of the mean over the number of members, with and without pounding; figure and rows."""
    study, found = analysis.study, analysis.outcomes
    gap, level, channel, damping = shown(analysis)
    figure, panels = plt.subplots(1, 2, figsize=(WIDTH, 4.0), sharey=True)
    rows, order = [], np.random.default_rng(study.seed).permutation(study.samples)
    counts = range(3, study.samples + 1)
    for axes, logs in zip(panels, (False, True)):
        for cell, colour, label in ((None, WITHOUT, "without pounding"), (gap, WITH, "with pounding")):
            values = found.spectra[analysis.of(cell, level)][order][:, channel, damping]
            values = np.log(values) if logs else values
            wide = []
            for count in counts:
                first = values[:count]
                deviation = first.std(0, ddof=1) / (1.0 if logs else first.mean(0))
                t = stats.t.ppf(0.5 + study.confidence / 2, count - 1) / np.sqrt(count)
                half = np.expm1(t * deviation) if logs else t * deviation
                wide.append((half.max(), np.median(half)))
                rows.append({"mean of": "logarithms" if logs else "values", "gap [m]": gap_text(cell),
                             "members": count, "half width, worst frequency": float(half.max()),
                             "half width, median": float(np.median(half))})
            axes.plot(counts, [one[0] for one in wide], color=colour, lw=1.5, label=f"{label}, worst frequency")
            axes.plot(counts, [one[1] for one in wide], color=colour, lw=1.1, ls="--", label=f"{label}, median")
        axes.axhline(0.1, color="#555555", lw=0.8)
        axes.set(xlabel="members", title="of the mean of logarithms" if logs else "of the mean")
        log_scale(axes, "y", [0.01, 1])
        axes.tick_params(labelleft=True)
    panels[0].set_ylabel(f"half width of the {100 * study.confidence:g} % interval")
    panels[1].legend(fontsize=8)
    pages = save(figure, folder, "enough.png", "How many motions were enough",
                 f"{found.channels[channel]}, {100 * found.damping[damping]:g} % damping, {study.joint_named(gap)}, "
                 f"{level:g} m/s², over the frequencies: the first members of an order drawn by the seed.", columns=[[axes] for axes in panels])
    return pages, rows


def joints(analysis: Analysis, rules: dict, folder: Path) -> list:
    """Part of the runs apart that need more than a joint, by level, and what rules say of the contact that needs
    most."""
    study, needed = analysis.study, 1e3 * analysis.needed()
    figure, axes = plt.subplots(figsize=(WIDTH * 0.8, 4.2))
    parts = 1 - (np.arange(study.samples) + 0.5) / study.samples
    worst = max(rules, key=lambda name: rules[name]["SRSS"]) if rules else None
    for number, (level, colour) in enumerate(zip(study.levels, COLOURS * 9)):
        axes.step(np.sort(needed[:, number]), parts, color=colour, lw=1.5, label=f"{level / 9.81:.2g} g")
        if worst:
            for rule, style in (("ABS", ":"), ("SRSS", "--"), ("DDC", "-.")):
                axes.axvline(1e3 * level * rules[worst][rule], color=colour, lw=0.9, ls=style,
                             label=rule if number == 0 else None)
    for part in EXCEEDED:
        axes.axhline(part, color="#BBBBBB", lw=0.7)
    axes.set_yscale("log")
    axes.set(ylim=(0.8 / study.samples / 2, 1.1), xlabel=f"{study.width_title} [mm]",
             ylabel="part of the members that need more")
    axes.legend(fontsize=8, ncol=2)
    return save(figure, folder, "joint.png", "The joint that is wide enough",
                "Of the runs without pounding, by peak ground acceleration; vertical lines are those of the rules"
                + (f" of {worst}" if worst else "") + f"{study.torsion.told}.")
