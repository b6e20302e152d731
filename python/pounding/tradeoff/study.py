"""The study: every setting on every case, rows of figures, and what they recommend."""

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


def row_of(case: Case, setting: Setting, found: Outcome, reference: Outcome) -> dict:
    probes = FLOOR_2 if isinstance(case, Case) else reference.moving()
    ratios = compare(found.spectra, {probe: reference.spectra[probe] for probe in reference.spectra
                                     if isinstance(case, Case) or probe in probes})
    rms, largest = overall(ratios, probes)
    impacts, expected = found.summary["impacts"], reference.summary["impacts"]
    row = {"case": case.name, "setting": setting.name, "noise": setting.noise, "wall_time": found.wall_time,
           "per_second": found.per_second(), "set_up": found.set_up(),
           "speed_up": reference.per_second() / found.per_second(), "steps": found.summary["steps"],
           "time_step": found.summary["time_step"], "memory": found.summary["peak_memory"],
           "energy_residual": found.summary["energy"]["relative_residual"],
           "estimate": found.summary["fidelity"]["rms"]["1-400"] if "fidelity" in found.summary else None,
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


def study(list_of_cases: list, settings: list, ranks: int, folder, log, noise: list = NOISE) -> list:
    """Rows of all cases; each case begins with its reference."""
    rows = []
    for case in list_of_cases:
        log(f"{case.name}:")
        reference = None
        for setting in [REFERENCE, *noise, *settings]:
            found = run(case, setting, ranks, folder, log)
            if found is None and reference is None:
                log(f"  {case.name}: left out, there is nothing to compare with")
                break
            if found is None:
                continue
            reference = reference or found
            rows.append(row_of(case, setting, found, reference))
            log(f"  {setting.name:22} {rows[-1]['per_second']:8.2f} s/s  rms {100 * rows[-1]['rms']:7.3f} %  "
                f"max {100 * rows[-1]['max']:7.2f} %  {rows[-1]['episodes']} impacts")
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
        result.append({"setting": name, "estimate": max(told, default=None), "noise": mine[0]["noise"], "cases": len(mine), **mean, **worst,
                       "median rms": median(row["rms"] for row in mine),
                       "class": class_of(worst["rms"], worst["max"])})
    return result


def recommendations(summary: list) -> list:
    """Per target rms the cheapest setting that stayed below it in every case."""
    lines = []
    usable = [row for row in summary if not row["noise"]]
    cases_run = max(row["cases"] for row in usable)
    for target in TARGETS:
        good = [row for row in usable if row["rms"] <= target and row["cases"] == cases_run]
        best = min(good, key=lambda row: row["per_second"])
        lines.append({"target": target, "setting": best["setting"], "rms": best["rms"],
                      "per_second": best["per_second"], "speed_up": best["speed_up"]})
    return lines
