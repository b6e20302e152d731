"""Tables of a comparison: lists of dictionaries, one per row, that go to CSV files and to the page."""

import numpy as np

from pounding.results import DIRECTIONS

from .runs import ROUND_OFF, Runs

# What differs between any two runs and is told elsewhere, or says nothing of the scene.
OF_NO_SCENE = ("output", "title", "restart")


def spectra(runs: Runs) -> list:
    """A row per probe, direction, damping ratio and frequency: PSA [m/s2] of every run, and the ratio to the first;
    no ratio where the first has round-off only."""
    rows = []
    for damping in runs.dampings:
        for probe in runs.probes:
            floor = runs.round_off(probe, damping)
            for way in runs.moving(probe, damping):
                values = [np.where(one > floor, one, 0.0) for one in runs.spectra(probe, way, damping)]
                for index, frequency in enumerate(runs.frequency):
                    row = {"probe": probe, "direction": way, "damping": f"{damping:g}", "frequency": f"{frequency:.6g}"}
                    for label, own in zip(runs.labels, values):
                        row[f"PSA {label} [m/s2]"] = f"{own[index]:.7g}"
                    for label, own in zip(runs.labels[1:], values[1:]):
                        first = values[0][index]
                        row[f"{label} / {runs.labels[0]}"] = f"{own[index] / first:.6g}" if first > 0 else ""
                    rows.append(row)
    return rows


def impacts(runs: Runs) -> list:
    """A row per contact and run, and one per run of all contacts: number, strongest and total impulse [N s], energy
    lost [J]. A contact that a run does not have has no number."""
    found = [result.summary.get("impacts", {}) for result in runs.results]
    contacts = list(dict.fromkeys(name for one in found for name, value in one.items() if isinstance(value, dict)))
    columns = (("episodes", "impacts"), ("largest_impulse", "strongest impulse [N s]"),
               ("total_impulse", "total impulse [N s]"), ("energy_lost", "energy lost [J]"))
    rows = []
    for contact in ["all contacts", *contacts]:
        for label, one in zip(runs.labels, found):
            own = one if contact == "all contacts" else one.get(contact, {})
            rows.append({"contact": contact, "run": label, **{title: own.get(key, "") for key, title in columns}})
    return rows


def peaks(runs: Runs) -> list:
    """A row per probe and direction: peak acceleration [m/s2], displacement [m] of every run, ratios to the first."""
    rows = []
    for probe in runs.probes:
        found = [result.summary.get("probes", {}).get(probe, {}) for result in runs.results]
        for index, way in enumerate(DIRECTIONS):
            for key, title in (("peak_acceleration", "acceleration [m/s2]"), ("peak_displacement", "displacement [m]")):
                triples = [one.get(key) or [0, 0, 0] for one in found]
                values = [triple[index] or 0 for triple in triples]
                floor = ROUND_OFF * max(value or 0 for triple in triples for value in triple)
                if max(values) <= floor:
                    continue
                row = {"probe": probe, "direction": way, "peak": title}
                values = [value if value > floor else 0.0 for value in values]
                row.update(zip(runs.labels, values))
                row.update({f"{label} / {runs.labels[0]}": value / values[0] if values[0] > floor else ""
                            for label, value in zip(runs.labels[1:], values[1:])})
                rows.append(row)
    return rows


def equipment(runs: Runs) -> list:
    """A row per item of equipment: smallest ratio of capacity over required of every run, and whether it holds."""
    found = [result.verdicts for result in runs.results]
    rows = []
    for name in dict.fromkeys(name for one in found for name in one):
        row = {"item": name}
        for label, one in zip(runs.labels, found):
            own = one.get(name, {})
            row[f"ratio {label}"] = own.get("ratio") if own.get("ratio") is not None else ""
            row[f"at Hz {label}"] = own.get("frequency", "")
            row[f"holds {label}"] = {True: "yes", False: "NO"}.get(own.get("passes"), "")
        rows.append(row)
    return rows


def same(one: str | None, other: str | None) -> bool:
    """Whether two texts say the same: as words, or as numbers."""
    if one == other:
        return True
    try:
        return float(one) == float(other)
    except (TypeError, ValueError):
        return False


def options(runs: Runs) -> list:
    """A row per option of the scene that is not the same in every run; '(not there)' where a run has none."""
    found = [result.summary.get("options", {}) for result in runs.results]
    names = dict.fromkeys(name for one in found for name in one)
    rows = []
    for name in names:
        values = [one.get(name) for one in found]
        if name not in OF_NO_SCENE and not all(same(value, values[0]) for value in values[1:]):
            rows.append({"option": name, **{label: "(not there)" if value is None else value
                                            for label, value in zip(runs.labels, values)}})
    for key in ("commit", "ranks"):
        values = [result.summary.get(key, "") for result in runs.results]
        if len(set(values)) > 1:
            rows.append({"option": {"commit": "(the program's commit)", "ranks": "(number of ranks)"}[key],
                         **dict(zip(runs.labels, map(str, values)))})
    return rows


def worst_ratios(runs: Runs) -> list:
    """A row per probe, direction and run: smallest and largest ratio of its spectrum to the first run's, with the
    frequencies [Hz], at the first common damping ratio."""
    rows = []
    damping = runs.dampings[0]
    for probe in runs.probes:
        for way in runs.moving(probe, damping):
            floor = runs.round_off(probe, damping)
            first, *others = (np.where(one > floor, one, 0.0) for one in runs.spectra(probe, way, damping))
            held = first > 0
            for label, own in zip(runs.labels[1:], others):
                if not held.any():
                    continue
                ratios, frequency = own[held] / first[held], runs.frequency[held]
                low, high = ratios.argmin(), ratios.argmax()
                rows.append({"probe": probe, "direction": way, "run": label,
                             "smallest": float(ratios[low]), "at Hz": float(frequency[low]),
                             "largest": float(ratios[high]), "at  Hz": float(frequency[high])})
    return rows
