"""What each saving costs: the two-storey pair at full order, disturbed by next to nothing (the noise floor), and
with every saving, over the same window of motion; wall time, steps, memory, and the error of the 5 % floor
spectra as rms and largest ln-ratio, band by band.

With --scene FILE the same for a scene of one's own, of all probes and directions that move: full order, half the step,
numbers in 32 bits, scaled mass, 25 to 800 modes with and without it. Reduced runs tell their errors, and the first of
them those of step and mesh, by S seconds at full order (--estimate S); these stand beside the true ones, which are
those beside full order and, of small scenes, beside full order on the mesh with every element split twice. The cheapest
setting within the accuracy asked is recommended, with its options to paste. Of several scenes a table of told and true
errors is left as well, certificates.md.

Writes tradeoff.csv (all cases), tradeoff.md (one line per setting, recommendations) and tradeoff.png. Finished
runs are kept and not repeated. Run it with nothing else running: the wall times are compared.
"""

import argparse
import re
import sys
from dataclasses import replace
from pathlib import Path

from pounding import tables
from pounding.arguments import positive, ranks
from pounding.files import write_text
from pounding.plot import tradeoff_figure
from pounding.runs import SOURCE, Job, RunError, clear, environment, finish, program
from pounding.study import alone_in, build
from pounding.tradeoff import runs, settings, study
from pounding.tradeoff.told import PARTS, SECONDS, Errors

from .process import called, parser_of

NAME = called("run/tradeoff")
GOES_ON = True
NAMES = [setting.name for setting in settings.SAVINGS]
SCENE_NAMES = [setting.name for setting in settings.of_scene([], ["any"], ["any"], sys.maxsize, 1.0)]  # with any number of dofs
SMALL = 3000  # dofs of a scene that is run on the mesh split twice as well, of bricks with 64 times as many


def arguments() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("--scene", metavar="FILE", type=Path, nargs="+", default=[],
                        help="this scene, or these, in place of the two-storey pair")
    parser.add_argument("--window", type=positive(float), metavar="S",
                        help="seconds of motion (default: 5; of --scene all of it)")
    parser.add_argument("--gap", action="append", choices=study.GAPS, help="this gap only (may be repeated)")
    parser.add_argument("--only", metavar="NAME", action="append",
                        help="this saving (may be repeated), of the pair: " + ", ".join(NAMES) + "; of --scene: " + ", ".join(SCENE_NAMES))
    parser.add_argument("--records", metavar="DIR", type=Path, default=SOURCE.parent / "shared" / "records",
                        help="folder with elcentro_1940/elCentro.AT2: a real motion beside the synthetic one")
    parser.add_argument("--ranks", type=ranks, default=2, help="(default: 2)")
    parser.add_argument("--output", metavar="DIR", type=Path,
                        help="folder of runs, tables and figure (default: results/tradeoff of the repository, of "
                        "--scene results/tradeoff-SCENE here, of several results/tradeoff-scenes)")
    parser.add_argument("--accuracy", metavar="PART", type=positive(float),
                        help="error that is accepted, 0.05 for 5 %% (default: a list from 1 to 15 %%)")
    parser.add_argument("--estimate", metavar="S", type=positive(float),
                        help="with --scene: seconds at full order by which reduced runs estimate their errors (default: 1)")
    parser.add_argument("--splits", type=int, choices=(0, 2),
                        help="with --scene: times that every element is split for the true error of the mesh "
                        f"(default: 2 up to {SMALL} dofs, else 0, without it)")
    options = parser.parse_args()
    for name in ("estimate", "splits"):
        if getattr(options, name) is not None and not options.scene:
            parser.error(f"--{name}: for --scene FILE")
    for scene in options.scene:
        if not scene.is_file():
            parser.error(f"{scene}: no such file")
    if (options.accuracy or 0) > 1:
        parser.error("--accuracy: a part, 0.05 for 5 %")
    if len({scene.stem for scene in options.scene}) < len(options.scene):
        parser.error("--scene: two of one name")
    if options.scene and options.gap:
        parser.error("--gap is about the two-storey pair, not with --scene")
    known = SCENE_NAMES if options.scene else NAMES
    unknown = [name for name in options.only or [] if name not in known]
    if unknown:
        parser.error(f"--only {unknown[0]}: none of {', '.join(known)}")
    return options


def percent(value: float) -> str:
    return "" if value is None else tables.number(100 * value, 2)


def setting_table(summary: list, savings: list) -> str:
    head = ["setting", "s per s of motion", "times faster", "set-up s", "memory MB", "median rms %", "rms %", "max %",
            "1-10 Hz", "10-50", "50-150", "150-400", "impulse %", "drift %", "class", "estimated rms %"]
    what = {one.name: one.what for one in [settings.REFERENCE, *settings.NOISE, *savings]}
    rows = [[f"{row['setting']}: {what[row['setting']]}", row["per_second"], row["speed_up"], row["set_up"],
             row["memory"] / 1e6, percent(row["median rms"]), percent(row["rms"]), percent(row["max"]),
             percent(row["rms 1-10"]), percent(row["rms 10-50"]), percent(row["rms 50-150"]),
             percent(row["rms 150-400"]), percent(row["impulse_error"]), percent(row["drift_error"]), row["class"],
             percent(row["estimate"])]
            for row in summary]
    return tables.markdown("Cost (mean over the cases) and error (worst case; rms also of the median case)", head, rows)


def recommendation_table(lines: list, spectra: str) -> str:
    rows = [[f"{percent(line['target'])} %", line["setting"] or "none of these", line["error"] and percent(line["error"]) + " %",
             line["per_second"], line["speed_up"]] for line in lines]
    return tables.markdown(f"Cheapest setting for an error of the {spectra} spectra, 1-400 Hz",
                           ["at most", "take", "found", "s per s of motion", "times faster"], rows)


def certificate_table(rows: list) -> str:
    """Told and true errors of the runs that told theirs, and of full order where none can."""
    lines = []
    for row in rows:
        pairs = [f"{percent(row[f'told {part}']) or '—'} / {percent(row[f'true {part}']) or '—'}" for part in PARTS]
        told, true = row["estimate"], row["rms"]
        lines.append([row["scene"], row["setting"], *pairs, f"{percent(told) or '—'} / {percent(true)}",
                      told / true if told and true else None, row["certificate"], row["why"]])
    return tables.markdown("Estimated / true error of the floor spectra in %, 1-400 Hz; the certificate's time over that of "
                           f"{SECONDS} s at full order", ["scene", "setting", "reduction", "step", "mesh", "whole",
                                                       "estimated over true", "time", "remark"], lines)


def to_paste(lines: list, savings: list) -> str:
    """The options of each setting that ran, as a command line takes them."""
    wanted = dict.fromkeys(line["setting"] for line in lines)
    told = [f"{one.name}: {settings.pasted(one)}\n" for one in savings if one.name in wanted]
    return "Options to paste\n\n" + "".join(f"    {line}" for line in told) if told else ""


def say(line: str) -> None:
    print(line, flush=True)


def reducible(case: runs.SceneCase, structures: list, told: tuple, options: argparse.Namespace, folder: Path) -> tuple:
    """The structures that can be in modes, and the reason why runs cannot tell their errors, or '': by dry runs, without
    those that a refusal names."""
    why = ""
    for words in (told, ()):
        left = structures
        while left:
            trial = settings.Setting("trial", "", (*settings.in_modes(left, 1, words), ("dry_run", "true")))
            failure = finish(lambda: Job(case.words(trial, folder), folder / "trial", options.ranks, case.folder,
                                         environment()))
            clear(folder / "trial")
            if not failure:
                return left, why
            kept = [name for name in left if not re.search(rf"(?<![A-Za-z0-9]){name}(?![A-Za-z0-9])", failure)]
            left = kept if len(kept) < len(left) else []
        why = why or re.sub(r"^pounding: (option -fidelity_window: no error can be estimated, since )?|; leave it out$",
                            "", failure)
    return [], why


def scene_study(scene: Path, options: argparse.Namespace, folder: Path) -> tuple:
    """Rows and settings of a scene of the user's, and its errors. Throws RunError if full order fails."""
    case = runs.SceneCase(scene, options.window)
    failures = []
    full = runs.run(case, settings.REFERENCE, options.ranks, folder, failures.append)
    if full is None:
        raise RunError(failures[-1].strip())
    if not full.moving():
        raise RunError(f"{scene}: no spectrum of a probe to compare; has it probes, and does the ground move?")
    structures, step = full.summary["structures"], full.summary["time_step"]
    reduced = [name for name, one in structures.items() if "modal" in one]
    if reduced:
        raise RunError(f"{scene}: {reduced[0]} is in modes; leave -{reduced[0]}_model and its options out, the study sets them")
    dofs = [one["dofs"] for one in structures.values()]
    splits = options.splits if options.splits is not None else 2 * (sum(dofs) <= SMALL)
    window = (("fidelity_window", options.estimate or 1),)
    left, why = reducible(case, list(structures), window, options, folder)
    solids = [name for name, one in structures.items()
              if any(region["element"].startswith("hex8") for region in one["regions"].values())]
    savings = settings.of_scene(list(structures), left, solids, max(dofs), step, () if why else window)
    unknown = [name for name in options.only or [] if name not in [one.name for one in savings]]
    if unknown:
        raise RunError(f"--only {unknown[0]}: none of {', '.join(one.name for one in savings)}")
    savings = [one for one in savings if not options.only or one.name in options.only]
    first = next((i for i, one in enumerate(savings) if one.changes[-1] == settings.RARE and not why), None)
    if first is not None:
        savings[first] = replace(savings[first], changes=(*savings[first].changes, ("fidelity_mesh", "true")))
    every = [settings.REFERENCE, *settings.finer(step, splits), *savings]
    outcomes = study.run_all(case, every, options.ranks, folder, say)
    errors = Errors(outcomes, why)
    reference = errors.truth or full
    rows = [{"scene": scene.stem, "why": errors.why, **study.row_of(case, one, outcomes[one.name], full, reference),
             **errors.of(one, outcomes[one.name])} for one in every if one.name in outcomes]
    return rows, every[1:]


def pair_study(options: argparse.Namespace, folder: Path) -> tuple:
    """As scene_study, for the two-storey pair."""
    savings = [one for one in settings.SAVINGS if not options.only or one.name in options.only]
    cases = study.cases(options.window or 5.0, options.records, options.gap or study.GAPS)
    return study.study(cases, savings, options.ranks, folder, say), savings


def study_one(scene: Path | None, options: argparse.Namespace, folder: Path) -> list:
    """Every setting of one scene, or of the pair, beside each other, in a folder: its rows, none if no run came to its end."""
    rows, savings = scene_study(scene, options, folder) if scene else pair_study(options, folder)
    if not rows:
        print(f"{NAME}: no run came to its end", file=sys.stderr)
        return rows
    summary = study.summarised(rows)
    spectra = "floor" if scene else "floor-2"
    lines = study.recommendations(summary, (options.accuracy,) if options.accuracy else study.TARGETS)
    tables.write_csv(folder / "tradeoff.csv", rows)
    text = setting_table(summary, savings) + "\n" + recommendation_table(lines, spectra)
    text += "\n" + (certificate_table(told_ones(rows)) + "\n" if scene else "") + to_paste(summary, savings)
    write_text(folder / "tradeoff.md", text)
    tradeoff_figure.draw(summary, folder / "tradeoff.png", spectra, [line["setting"] for line in lines])
    print("\n" + text, end="")
    print(f"see {folder / 'tradeoff.csv'} and tradeoff.png")
    return rows


def told_ones(rows: list) -> list:
    """The rows of runs that told their errors; without one that of full order."""
    return [row for row in rows if row["told reduction"]] or rows[:1]


def study_all(options: argparse.Namespace, folder: Path) -> int:
    """The pair, a scene, or one scene after the other with a table of all; 1 if no run came to its end."""
    if len(options.scene) < 2:
        return 0 if study_one(*(options.scene or [None]), options, folder) else 1
    rows = [row for scene in options.scene for row in told_ones(study_one(scene, options, folder / scene.stem))]
    print("\n" + tables.leave(folder, "certificates", certificate_table(rows), rows), end="")
    return 0


def main() -> int:
    options = arguments()
    name = options.scene[0].stem if len(options.scene) == 1 else "scenes"
    ours = Path("results") / f"tradeoff-{name}" if options.scene else SOURCE / "results" / "tradeoff"
    folder = (options.output or ours).resolve()
    with alone_in(folder, NAME):
        build(SOURCE, "pounding")
        program()
        return study_all(options, folder)
