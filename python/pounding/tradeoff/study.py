"""The study: every setting on every case, rows of figures, and what they recommend."""

from math import hypot
from statistics import median

from .metrics import class_of, compare
from .runs import Case, Outcome, run
from .settings import NOISE, REFERENCE, Setting

FLOOR_2 = ("s1_floor2", "s2_floor2")
GAPS = {"gap2": {"floor1": (0.021, 0.019), "floor2": (0.025, 0.020)},
        "gap5": {"floor1": (0.050, 0.047), "floor2": (0.055, 0.050)}}
PGA = {"gap2": 2.4525, "gap5": 3.4335}  # [m/s2]; strong enough to hit within the window
TARGETS = (0.01, 0.03, 0.05, 0.10, 0.15)  # rms of the recommendations


def cases(window: float, records, gaps) -> list:
    """Gap by gap the synthetic motion and, where it is there, El Centro."""
    motions = {"synthetic": {"motion_x_target": "petsc-options/spectra/alluvial.csv", "motion_x_seed": 1,
                             "motion_x_duration": 12, "motion_x_envelope": "1,5"}}
    record = records / "elcentro_1940" / "elCentro.AT2" if records else None
    if record and record.exists():
        motions["elcentro"] = {"motion_x_record": str(record.resolve())}
    return [Case(f"{gap}-{name}", GAPS[gap], {**motion, "motion_x_pga": PGA[gap]}, window)
            for gap in gaps for name, motion in motions.items()]


def overall(ratios: dict, probes, band: str = "1-400") -> tuple:
    """rms over the spectra that count, and the largest of any: for the pair the second floors of both buildings."""
    squares = [ratios[probe][band]["rms"]**2 for probe in probes]
    return (sum(squares) / len(squares))**0.5, max(ratios[probe][band]["max"] for probe in probes)


def row_of(case: Case, setting: Setting, found: Outcome, full: Outcome, reference: Outcome) -> dict:
    """Cost beside that of full order, error beside the reference, which is that unless there is a finer run."""
    probes = FLOOR_2 if isinstance(case, Case) else full.moving()
    ratios = compare(found.spectra, {probe: reference.spectra[probe] for probe in reference.spectra
                                     if isinstance(case, Case) or probe in probes})
    rms, largest = overall(ratios, probes)
    impacts, expected = found.summary["impacts"], reference.summary["impacts"]
    row = {"case": case.name, "setting": setting.name, "noise": setting.noise, "wall_time": found.wall_time,
           "per_second": found.per_second(), "set_up": found.set_up(),
           "speed_up": full.per_second() / found.per_second(), "steps": found.summary["steps"],
           "time_step": found.summary["time_step"], "memory": found.summary["peak_memory"],
           "energy_residual": found.summary["energy"]["relative_residual"],
           "estimate": None, "beside": 0.0,
           "rms": rms, "max": largest, "class": class_of(rms, largest),
           "impulse": impacts["total_impulse"], "episodes": impacts["episodes"],
           "impulse_error": impacts["total_impulse"] / expected["total_impulse"] - 1
           if expected["total_impulse"] > 0 else 0.0,
           "peak_drift": found.peak_drift(), "drift_error": found.peak_drift() / reference.peak_drift() - 1}
    for probe, bands in ratios.items():
        for band, figure in bands.items():
            row[f"{probe} {band} rms"] = figure["rms"]
            row[f"{probe} {band} max"] = figure["max"]
    for band in ("1-10", "10-50", "50-150", "150-400"):
        row[f"rms {band}"] = overall(ratios, probes, band)[0]
    return row


def run_all(case: Case, settings: list, ranks: int, folder, log) -> dict:
    """What these settings left, by name, as far as they came to their end; nothing where the first of them, full order,
    did not."""
    log(f"{case.name}:")
    outcomes = {}
    for setting in settings:
        found = run(case, setting, ranks, folder, log)
        if found is None and not outcomes:
            log(f"  {case.name}: left out, there is nothing to compare with")
            break
        if found is not None:
            outcomes[setting.name] = found
            log(f"  {setting.name:22} {found.per_second():8.2g} s/s  {found.summary['impacts']['episodes']} impacts")
    return outcomes


def study(list_of_cases: list, settings: list, ranks: int, folder, log, noise: list = NOISE) -> list:
    """Rows of all cases; each case begins with its reference."""
    rows, settings = [], [REFERENCE, *noise, *settings]
    for case in list_of_cases:
        outcomes = run_all(case, settings, ranks, folder, log)
        rows += [row_of(case, one, outcomes[one.name], outcomes["full"], outcomes["full"])
                 for one in settings if one.name in outcomes]
    return rows


def summarised(rows: list) -> list:
    """One row per setting: costs averaged over the cases, errors the worst of them, and the median rms."""
    result = []
    for name in dict.fromkeys(row["setting"] for row in rows):
        mine = [row for row in rows if row["setting"] == name]
        mean = {key: sum(row[key] for row in mine) / len(mine)
                for key in ("per_second", "set_up", "speed_up", "memory", "steps")}
        worst = {key: max(abs(row[key]) for row in mine)
                 for key in ("rms", "max", "rms 1-10", "rms 10-50", "rms 50-150", "rms 150-400",
                             "impulse_error", "drift_error", "energy_residual")}
        told = [row["estimate"] for row in mine if row["estimate"] is not None]
        most = max([worst["rms"], *told])
        result.append({"setting": name, "estimate": max(told, default=None), "noise": mine[0]["noise"],
                       "cases": len(mine), **mean, **worst, "error": hypot(most, mine[0]["beside"]),
                       **{key: mine[0].get(key) for key in ("told step", "told mesh")},
                       "median rms": median(row["rms"] for row in mine),
                       "class": class_of(worst["rms"], worst["max"])})
    return result


def recommendations(summary: list, targets: tuple = TARGETS) -> list:
    """Per target rms the cheapest setting that stayed below it in every case, by the larger of its told and true errors;
    of a scene whose mesh is not split twice with those that are told of step and mesh."""
    lines = []
    usable = [row for row in summary if not row["noise"]]
    cases_run = max(row["cases"] for row in usable)
    for target in targets:
        good = [row for row in usable if row["error"] <= target and row["cases"] == cases_run]
        best = min(good, key=lambda row: row["per_second"], default={})
        lines.append({"target": target, **{key: best.get(key) for key in ("setting", "error", "per_second", "speed_up")}})
    return lines
