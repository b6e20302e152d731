"""The answer of a run in sentences: did they touch, where, how hard, what it does to the floors, what is left; and the
picture beside them: how far the decisive joint was open, and what its floor feels."""

from dataclasses import dataclass

import numpy as np

from pounding.results import DIRECTIONS, GROUND, Missing, Result
from . import equipment
from . import twin as twins
from .contact_figures import draw_gap
from .markup import answer_box, readable
from .spectra_figures import draw_spectrum
from .style import WIDTH, plt, save

HEARD = 0.05  # of the largest floor spectrum of the run: what is below it is not looked at
FELT = 0.01   # of the largest one without pounding: below it nothing moved, and a ratio says nothing
LOW = 33.0    # up to here are the frequencies of structures and of most equipment [Hz]
CLOSED = 1e-6  # residual of the energy identity up to here is round-off and its growth
SOLVED = 1e-8  # likewise of the contact problem


@dataclass
class Change:
    """Where a floor spectrum is most changed: values of the run and of its twin [m/s2] at a frequency [Hz]."""

    probe: str
    way: str
    damping: float
    frequency: float
    value: float
    without: float

    @property
    def ratio(self) -> float:
        return self.value / self.without

    def text(self) -> str:
        return (f"{self.ratio:.3g} times at {self.frequency:.3g} Hz at {self.probe} along {self.way} "
                f"(from {self.without:.3g} to {self.value:.3g} m/s²)")


def _pairs(run: Result, twin: Result, damping: float) -> list:
    """(probe, direction, frequencies, values, values without pounding) of all floor spectra that both have."""
    probes = [probe for probe in run.spectrum_probes if probe in twin.spectrum_probes]
    found = []
    for probe in probes:
        for way in DIRECTIONS:
            own, other = run.spectrum_if_any(probe, way, damping), twin.spectrum_if_any(probe, way, damping)
            if own and other:
                found.append((probe, way, own[0], own[1], other[1]))
    return found


def _largest(pairs: list) -> tuple:
    """The largest values with and without pounding."""
    return tuple(max((pair[place].max() for pair in pairs), default=0.0) for place in (3, 4))


def lowest_damping(run: Result) -> float | None:
    return float(np.min(run.spectra["damping"])) if run.spectrum_probes else None


def largest_change(run: Result, twin: Result, below: float = np.inf, along: tuple = DIRECTIONS) -> Change | None:
    """The largest ratio of the floor spectra at the smallest damping ratio, of frequencies up to `below` and directions
    `along`, where the run has HEARD of its largest spectrum and the other one FELT of its own."""
    damping = lowest_damping(run)
    pairs = _pairs(run, twin, damping) if damping is not None else []
    largest, largest_without = _largest(pairs)
    changes = []
    for probe, way, frequency, values, without in (pair for pair in pairs if pair[1] in along):
        for i in np.flatnonzero((values >= HEARD * largest) & (without >= FELT * largest_without) & (without > 0)
                                & (frequency <= below)):
            changes.append(Change(probe, way, damping, float(frequency[i]), float(values[i]), float(without[i])))
    return max(changes, key=lambda change: change.ratio, default=None)


def awakened(run: Result, twin: Result) -> tuple | None:
    """Probe, direction, largest value [m/s2] and its frequency [Hz] of the strongest spectrum where nothing moved
    without pounding."""
    pairs = _pairs(run, twin, lowest_damping(run)) if run.spectrum_probes else []
    largest, largest_without = _largest(pairs)
    found = [(float(values.max()), float(frequency[values.argmax()]), probe, way)
             for probe, way, frequency, values, without in pairs
             if without.max() < FELT * largest_without and values.max() >= HEARD * largest]
    if not found:
        return None
    value, frequency, probe, way = max(found)
    return probe, way, value, frequency


def strongest_spectrum(run: Result, along: tuple = DIRECTIONS) -> tuple | None:
    """Probe, direction and damping ratio of the largest floor spectrum in the directions `along`."""
    table = run.spectra
    rows = (np.isin(table["probe"], run.spectrum_probes) & np.isin(table["direction"].astype(str), list(along))
            if table else np.array([]))
    if not rows.any():
        return None
    i = np.flatnonzero(rows)[np.argmax(table["pseudo_acceleration"][rows])]
    return str(table["probe"][i]), str(table["direction"][i]), float(table["damping"][i])


def plural(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"


def _millimetres(value: float) -> str:
    return f"{1e3 * value:.3g} mm"


def _force(value: float) -> str:
    return f"{readable(1e-3 * value)} kN"


def smallest_gaps(run: Result) -> dict:
    """Contact -> (smallest gap of the history [m], its time [s], smallest gap at rest [m])."""
    found = {}
    for column, name in enumerate(run.contacts if "gap" in run.history else []):
        gap = run.history["gap"][:, column]
        rest = run.summary.get("contacts", {}).get(name, {}).get("initial_gap")
        if np.isfinite(gap).any() and rest:
            at = int(np.nanargmin(gap))
            found[name] = (float(gap[at]), float(run.history["time"][at]), float(rest[0]))
    return found


def decisive(run: Result) -> str | None:
    """Contact of the largest impulse, else the one that a stronger motion closes first, else that of the smallest gap."""
    if run.impacts and len(run.impacts["impulse"]):
        name = str(run.impacts["contact"][int(np.argmax(run.impacts["impulse"]))])
        return name if name in run.contacts else None
    factors = run.closing_factors()
    if factors:
        return min(factors, key=factors.get)
    gaps = smallest_gaps(run)
    return min(gaps, key=lambda name: gaps[name][0], default=None)


def verdict(run: Result) -> str:
    """The joint that decides, whether it closes, and its margin: "floor2 of 10 mm closes, with 2 impacts in all and no
    margin"; nothing of a run without contacts."""
    name = decisive(run) or next(iter(run.summary.get("contacts", {})), None)
    if name is None:
        return ""
    low, high = (1e3 * (gap or 0) for gap in run.summary.get("contacts", {}).get(name, {}).get("initial_gap") or (0, 0))
    width = f"{low:.3g} mm" if abs(high - low) <= 1e-3 * abs(high) else f"{low:.3g} to {high:.3g} mm"
    if touched(run):
        asked = run.summary.get("separations", {}).get(name, {}).get("srss")
        margin = f", where response spectra ask for {_millimetres(asked)} (SRSS)" if asked else " and no margin"
        return f"{name} of {width} closes, with {plural(run.summary['impacts']['episodes'], 'impact')} in all{margin}"
    factor = run.closing_factors().get(name)
    margin = f" with a margin of {factor:.3g} on the {run.scaled_by_closing(name)}" if factor else ""
    return f"{name} of {width} stays open{margin}"


def headline(runs: dict) -> str:
    """Joint, margin and confidence of runs by their labels, in one sentence; nothing where none has contacts."""
    told = {label: verdict(run) for label, run in runs.items() if run.summary.get("contacts")}
    if not told:
        return ""
    if len(told) == 1:
        return f"The joint {next(iter(told.values()))}; one motion in one joint gives no confidence."
    closed = sum(touched(runs[label]) for label in told)
    how = "all" if closed == len(told) else "none" if closed == 0 else f"{closed}"
    listed = "; ".join(f"{label}: {words}" for label, words in told.items())
    return f"The joint closes in {how} of {len(told)} runs ({listed}); one motion in one joint each gives no confidence."


def _touched(run: Result) -> list:
    impacts = run.summary["impacts"]
    by = {name: one["episodes"] for name, one in impacts.items() if isinstance(one, dict) and one.get("episodes")}
    where = ", ".join(f"{count} at {name}" for name, count in by.items())
    lines = [f"The buildings touched: {plural(impacts['episodes'], 'impact')}, {where}."]
    table = run.impacts
    if table and len(table["start"]):
        i = int(np.argmax(table["impulse"]))
        hard = f"The hardest came at {table['start'][i]:.4g} s at {table['contact'][i]}: {readable(table['impulse'][i])} N s"
        if "window_force" in table and impacts.get("force_window"):
            j = int(np.argmax(table["window_force"]))
            hard += f"; the largest force over {1e3 * impacts['force_window']:.3g} ms was {_force(table['window_force'][j])}"
            hard += "" if i == j else f", at {table['contact'][j]} at {table['start'][j]:.4g} s"
        first, last = table["start"].min(), table["end"].max()
        lines.append(f"{hard}. All impacts lie between {first:.4g} and {last:.4g} s; together they are "
                     f"{readable(impacts['total_impulse'])} N s.")
    return lines


def _yielding(run: Result) -> list:
    """How much yields, and the law that goes farthest beyond its first corner."""
    laws = run.summary.get("yielding", {})
    if not laws:
        return []
    name = max(laws, key=lambda one: laws[one]["ductility"])
    far = laws[name]
    most = f"{far['ductility']:.3g} times its first corner (element {far['element']})"
    if far["ductility"] <= 1:
        return [f"Nothing yields: {name} comes nearest, to {most}."]
    over = [law for law in laws.values() if law["yielded"]]
    count, all_laws = (sum(law[key] for law in laws.values()) for key in ("yielded", "elements"))
    lost = sum(law["energy_lost"] for law in over)
    return [f"Of {all_laws} laws of elements {count} yield, the first at {min(law['first_time'] for law in over):.4g} s; {name} "
            f"goes farthest, to {most}. They took {readable(1e-3 * lost)} kJ."]


def _apart(run: Result) -> list:
    gaps = smallest_gaps(run)
    lines = ["The buildings did not touch."]
    if gaps:
        name = min(gaps, key=lambda one: gaps[one][0])
        gap, time, rest = gaps[name]
        closing = run.closings()[name]
        lines.append(f"The smallest gap was {_millimetres(gap)} at {name} at {time:.4g} s, of {_millimetres(rest)} at rest: "
                     f"the joint closed by {_millimetres(closing)}" + (f", and {100 * gap / rest:.3g} % of it is left." if rest > 0 else "."))
        factors = run.closing_factors()
        if factors:
            first = min(factors, key=factors.get)
            scaled = run.scaled_by_closing(first)
            scaled = "a motion" if scaled == "motion" else scaled
            lines.append(f"As long as everything stays linear, {scaled} {factors[first]:.3g} times as strong would close "
                         f"{'it' if first == name else f'{first}, the first of the joints'}.")
    return lines


def _margin(run: Result) -> list:
    """Width that response spectra ask of the joint that has least of it."""
    needed = {name: one for name, one in run.summary.get("separations", {}).items() if one.get("srss")}
    if not needed:
        return []
    name = max(needed, key=lambda one: needed[one]["srss"] / max(needed[one]["gap"], 1e-12))
    one = needed[name]
    word = "is wide enough" if one["gap"] >= one["srss"] else "is too narrow"
    return [f"By response spectrum the joint {name} of {_millimetres(one['gap'])} {word}: the codes' root of the sum of "
            f"squares asks for {_millimetres(one['srss'])}, the sum of both peaks for {_millimetres(one['sum'])}."]


def _floors(run: Result, twin: Result | None, why: str) -> list:
    if twin is None:
        return [f"No run without pounding is beside this one{f' ({why})' if why else ''}: the effect of the impacts on the "
                "floors is not known. The command at the end of this part makes it; then draw again."]
    change = largest_change(run, twin)
    if change is None:
        return [f"The run without pounding, {twin.folder.name}, has no floor spectra beside which these can be set."]
    lines = [f"Beside the run without pounding ({twin.folder.name}) the floor spectra ({100 * change.damping:g} %) grow at most "
             f"{change.text()}."]
    low = largest_change(run, twin, LOW)
    if low and change.frequency > LOW:
        lines[0] += f" Up to {LOW:g} Hz it is at most {low.text()}."
    awake = awakened(run, twin)
    if awake:
        lines.append(f"Impacts move floors at rest without them: {awake[0]} along {awake[1]} reaches {awake[2]:.3g} m/s² at "
                     f"{awake[3]:.3g} Hz.")
    peaks = _peaks(run, twin)
    return lines + ([peaks] if peaks else [])


def _peaks(run: Result, twin: Result) -> str:
    """The floor whose stated peak acceleration grew most, of those with HEARD of the largest."""
    found = []
    for name, probe in run.summary.get("probes", {}).items():
        other = twin.summary.get("probes", {}).get(name, {}).get("peak_acceleration") or [None] * 3
        for way, value, without in zip(DIRECTIONS, probe.get("peak_acceleration") or [None] * 3, other):
            if value and without is not None:
                found.append((value, without, name, way))
    largest, largest_without = (max((one[place] for one in found), default=0.0) for place in (0, 1))
    found = [(one[0] / one[1], *one) for one in found
             if one[0] >= HEARD * largest and one[1] >= FELT * largest_without > 0]
    if not found:
        return ""
    ratio, value, without, name, way = max(found)
    cut = run.summary.get("peak_frequency")
    return (f"The peak acceleration{f' below {cut:g} Hz' if cut else ''} changes most at {name} along {way}: {ratio:.3g} times, "
            f"from {without:.3g} to {value:.3g} m/s².")


def checks(run: Result) -> list:
    """Whether the energy identity, the contact problem and the penetration close."""
    summary, lines = run.summary, []
    residual = summary.get("energy", {}).get("relative_residual")
    if residual is not None:
        lines.append(f"The energy identity of the scheme {'closes' if residual <= CLOSED else 'DOES NOT CLOSE'}: its largest "
                     f"residual is {readable(residual, 2)} of the largest term.")
    impacts = summary.get("impacts", {})
    left = impacts.get("complementarity_residual")
    if impacts.get("episodes") and left is not None:
        lines.append(f"The contact problem of every step was {'' if left <= SOLVED else 'NOT '}solved: residual "
                     f"{readable(left, 2)}. The faces went into each other by at most "
                     f"{1e6 * impacts.get('max_penetration', 0):.3g} µm, less than they move in a step.")
    count = len(summary.get("warnings", []))
    lines.append(f"The run warned {plural(count, 'time')}; see Warnings." if count else "The run gave no warning.")
    return lines


def touched(run: Result) -> bool:
    return bool(run.summary.get("impacts", {}).get("episodes"))


def sentences(run: Result, twin: Result | None, why: str = "") -> list:
    """The answer, its first line alone enough for who reads no further. Nothing of a folder without summary.json."""
    if not run.summary:
        return []
    held = [*equipment.sentences(run, twin), *filter(None, [headline({"": run})]), *_yielding(run)]
    if touched(run):
        return [*held, *_touched(run), *_floors(run, twin, why), *_margin(run), *checks(run)]
    if not run.summary.get("contacts"):
        return [*held, "No contacts: each building moves on its own in this run.", *checks(run)]
    return [*held, *_apart(run), *_margin(run), *checks(run)]


def html(run: Result, twin: Result | None, why: str) -> str:
    lines = sentences(run, twin, why)
    command = twins.command(run) if touched(run) and twin is None else ""
    return answer_box(lines, touched(run), command) if lines else ""


def _across(result: Result, name: str | None) -> tuple:
    """The direction across a joint, in which it closes; every one if nothing tells it."""
    normal = result.summary.get("contacts", {}).get(name, {}).get("normal") if name else None
    return (DIRECTIONS[int(np.argmax(np.abs(normal)))],) if normal else DIRECTIONS


def _floor(result: Result, along: tuple) -> tuple | None:
    """Probe, direction and damping ratio whose spectrum is shown, in the directions `along` if there is one: the most
    changed, else the largest."""
    for ways in dict.fromkeys((along, DIRECTIONS)):
        change = largest_change(result, result.without, along=ways) if result.without else None
        if change:
            return change.probe, change.way, change.damping
        found = strongest_spectrum(result, ways)
        if found:
            return found
    return None


def picture(result: Result) -> list:
    name = decisive(result) if "gap" in result.history and len(result.history["time"]) else None
    floor = _floor(result, _across(result, name))
    if not name and not floor:
        raise Missing("neither gaps nor spectra")
    figure, panels = plt.subplots(1, 2 if name and floor else 1, figsize=(WIDTH, 3.5), squeeze=False)
    panels = list(panels[0])
    if name:
        least, count = draw_gap(panels[0], result, name, 14, 120)
        panels[0].set(title=f"{name}: {plural(count, 'impact') if count else f'smallest gap {least:.3g} mm'}", xlabel="time [s]")
    if floor:
        probe, way, damping = floor
        draw_spectrum(panels[-1], result, probe, way, [damping], in_g=True)
        panels[-1].set_title(f"{probe}, {way}, {100 * damping:g} %")
        panels[-1].set(xlabel="frequency [Hz]", ylabel="pseudo-acceleration [m/s²]")
        if panels[-1].get_legend_handles_labels()[0]:
            panels[-1].legend(loc="best")
    words = ["the gap of the joint that decides"] if name else []
    if floor:
        across = f" along {way} (across that joint)" if _across(result, name) == (way,) else ""
        words.append(f"the floor spectrum{across} that changes most, with and without pounding" if result.without else
                     f"the largest floor spectrum{across}")
        if result.spectrum_if_any(GROUND, way, damping):
            words[-1] += ", and that of the ground"
    words = "; ".join(words)
    return save(figure, result.folder, "answer.png", "In one picture", words[:1].upper() + words[1:] + ".",
                columns=[[axes] for axes in panels])
