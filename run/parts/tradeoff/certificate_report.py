"""What a certificate says, in words, tables and files."""

import json
from pathlib import Path

from parts import tables
from pounding.files import write_text

from .certificate import Certificate
from .climb import BAND_NAMES
from .ladder import FULL
from .study import fidelity_table


def percent(value: float | None) -> str:
    return "—" if value is None else f"{100 * value:.2g} %" if value else "0"


def rows_of(found: Certificate, folder: Path) -> list:
    """A row per rung: cost, estimated error per band, distance from the next rung, what its basis lacks."""
    lacking = found.lacking(folder)
    rows = []
    for k, one in enumerate(found.climbed):
        rows.append({"rung": one.rung.setting.name, "seconds per second": one.outcome.per_second(),
                     "set-up": one.outcome.set_up(), "impacts": one.outcome.summary["impacts"]["episodes"],
                     "lacking": lacking[k], **{f"error {band}": found.errors[k][band] for band in BAND_NAMES},
                     "chosen": k == found.chosen})
        if found.true:
            rows[-1] |= {f"true {band}": found.true[k][band] for band in BAND_NAMES}
    return rows


def text_of(found: Certificate, scene: str, ladder: list) -> str:
    """Markdown: the answer first, then the ladder (rows_of), the noise floor, the parts of the error."""
    window = found.window or found.end_time
    sure = "full order itself, run over the window" if found.full else "its neighbours on the ladder"
    cost = found.outcome.per_second()
    lines = [f"# Fidelity of {scene}", "",
             f"{found.setting.name}: {found.setting.what}. Its floor spectra (1-400 Hz, rms of the logarithm over all "
             f"probes and directions that move) are {percent(found.beside_full_order())} from full order, told by "
             f"{sure}; {percent(found.target)} were asked: {'reached' if found.reached else 'NOT reached'}.",
             f"It takes {cost:.3g} s per second of motion; " + _beside_full_order(found, cost), ""]
    if found.floor_of() > found.target:
        lines += [f"The noise floor, {percent(found.floor_of())}, is above the target: no single run says more about "
                  "this scene, whatever its fidelity. Repeat it with the gap or the shaking a little changed.", ""]
    if not found.confirmed:
        lines += ["It is the finest rung that was run, and none beside it confirms what it is held to lack: read its "
                  "error as a bound. Ask for less, or give full order more time (--budget).", ""]
    if not found.shrank:
        lines += ["The last step of the ladder was no smaller than the one before: the estimates are not on firm "
                  "ground.", ""]
    head = ["rung", "s per s", "set-up s", "impacts", "lacks of an impulse", *(f"{band} Hz" for band in BAND_NAMES), ""]
    rows = [[row["rung"], row["seconds per second"], row["set-up"], row["impacts"], percent(row["lacking"]),
             *(percent(row[f"error {band}"]) for band in BAND_NAMES), "taken" if row["chosen"] else ""]
            for row in ladder]
    title = f"Ladder over {window:g} of {found.end_time:g} s: error, " + ("measured" if found.full else "estimated")
    parts = [[what, *(percent(values[band]) for band in BAND_NAMES)]
             for what, values in [*((f"noise: {name}", one) for name, one in found.floor.items()),
                                  *((_words(name), part) for name, part in found.parts.items())]]
    if "mesh" not in found.parts:
        parts.append(["mesh", *["not measured (--finer)"] * len(BAND_NAMES)])
    parts.append(["all that was measured", *(percent(found.all_parts(band)) for band in BAND_NAMES)])
    checks = []
    if found.true:
        checks = [[one.rung.setting.name, percent(found.errors[k]["1-400"]), percent(found.true[k]["1-400"]),
                   found.errors[k]["1-400"] / found.true[k]["1-400"] if found.true[k]["1-400"] > 0 else ""]
                  for k, one in enumerate(found.climbed)]
        checks = [tables.markdown("Checked by full order, 1-400 Hz", ["rung", "estimated", "true", "ratio"], checks)]
    return "\n".join([*lines, tables.markdown(title, head, rows), *checks,
                      tables.markdown("What the error holds", ["part", *(f"{band} Hz" for band in BAND_NAMES)], parts)])


def _beside_full_order(found: Certificate, cost: float) -> str:
    if found.setting.name == FULL.setting.name:
        return "of the settings that were tried no other one is within the target and faster."
    return (f"full order {found.facts.cost:.3g}: {found.facts.cost / cost:.3g} times faster, and "
            f"{found.facts.cost * found.end_time:.3g} s for the whole scene at full order.")


def _words(name: str) -> str:
    return {"reduction": "reduction to modes", "longer step": "scaled mass and a longer step",
            "step": "time step, by half of it", "mesh": "mesh, by the finer one"}[name]


def write(found: Certificate, scene: str, folder: Path) -> str:
    """Writes certificate.md, certificate.json, ladder.csv and fidelity.csv into the folder; returns the text."""
    rows = rows_of(found, folder)
    text = text_of(found, scene, rows)
    write_text(folder / "certificate.md", text)
    tables.write_csv(folder / "ladder.csv", rows)
    write_text(folder / "certificate.json", json.dumps({
        "scene": scene, "target": found.target, "reached": found.reached, "setting": found.setting.name,
        "options": {name: str(value).replace("{folder}", str(folder)) for name, value in found.setting.changes},
        "error": {band: found.beside_full_order(band) for band in BAND_NAMES},
        "noise_floor": {band: found.floor_of(band) for band in BAND_NAMES}, "parts": found.parts,
        "all_parts": {band: found.all_parts(band) for band in BAND_NAMES}, "measured": found.full,
        "confirmed": found.confirmed,
        "ladder_shrank": found.shrank, "window": found.window or found.end_time, "end_time": found.end_time,
        "seconds_per_second": found.outcome.per_second(), "full_order_seconds_per_second": found.facts.cost,
        "structures_key": found.facts.key}, indent=1) + "\n")
    settings = [(one.rung.setting, found.errors[k]["1-400"], one.outcome) for k, one in enumerate(found.climbed)]
    settings += [(one.setting, max(one.error, found.floor_of()), one.outcome) for one in found.tried]
    settings.append((found.setting, found.beside_full_order(), found.outcome))
    summary = [{"setting": setting.name, "structures_key": found.facts.key, "rms": rms,
                "per_second": outcome.per_second()} for setting, rms, outcome in
               {setting.name: (setting, rms, outcome) for setting, rms, outcome in settings}.values()]
    what = (scene, "all probes that move, 1-400 Hz, estimated" if not found.full else "all probes that move, 1-400 Hz",
            f"those of {scene}")
    write_text(folder / "fidelity.csv", fidelity_table(summary, [one for one, _, _ in settings],
                                                       found.facts.structures, what))
    return text
