"""What each saving costs: the two-storey pair at full order, disturbed by next to nothing (the noise floor), and
with every saving, over the same window of motion; wall time, steps, memory, and the error of the 5 % floor
spectra as rms and largest ln-ratio, band by band.

With --scene FILE the same for a scene of one's own: full order, half the step (how far the scheme itself moves the
spectra), scaled mass, 25 to 800 modes with and without it; errors are those of all probes and directions that move.
With --estimate S the reduced runs estimate their errors as well, by S seconds at full order (-fidelity_window): the
estimate stands beside the error.

Writes tradeoff.csv (all cases), tradeoff.md (one line per setting, recommendations) and tradeoff.png. Finished
runs are kept and not repeated. Run it with nothing else running: the wall times are compared.
"""

import argparse
import sys
from pathlib import Path

from pounding import tables
from pounding.arguments import positive, ranks
from pounding.files import write_text
from pounding.plot import tradeoff_figure
from pounding.runs import SOURCE, RunError, program
from pounding.study import alone_in, build
from pounding.tradeoff import runs, settings, study

from .process import called, parser_of

NAME = called("run/tradeoff")
GOES_ON = True
NAMES = [setting.name for setting in settings.SAVINGS]
SCENE_NAMES = [setting.name for setting in settings.of_scene([], sys.maxsize, 1.0)]  # of a scene with any number of dofs


def arguments() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("--scene", metavar="FILE", type=Path, help="this scene in place of the two-storey pair")
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
                        "--scene results/tradeoff-SCENE here)")
    parser.add_argument("--estimate", metavar="S", type=positive(float),
                        help="with --scene: reduced runs estimate their errors by so many seconds at full order")
    options = parser.parse_args()
    if options.estimate and not options.scene:
        parser.error("--estimate: for --scene FILE")
    if options.scene and not options.scene.is_file():
        parser.error(f"{options.scene}: no such file")
    if options.scene and options.gap:
        parser.error("--gap is about the two-storey pair, not with --scene")
    known = SCENE_NAMES if options.scene else NAMES
    unknown = [name for name in options.only or [] if name not in known]
    if unknown:
        parser.error(f"--only {unknown[0]}: none of {', '.join(known)}")
    return options


def percent(value: float) -> str:
    return f"{100 * value:.2g}" if value else "0"


def setting_table(summary: list, savings: list) -> str:
    head = ["setting", "s per s of motion", "times faster", "set-up s", "memory MB", "median rms %", "rms %", "max %",
            "1-10 Hz", "10-50", "50-150", "150-400", "impulse %", "drift %", "class", "estimated rms %"]
    what = {one.name: one.what for one in [settings.REFERENCE, *settings.NOISE, *savings]}
    rows = [[f"{row['setting']}: {what[row['setting']]}", row["per_second"], row["speed_up"], row["set_up"],
             row["memory"] / 1e6, percent(row["median rms"]), percent(row["rms"]), percent(row["max"]),
             percent(row["rms 1-10"]), percent(row["rms 10-50"]), percent(row["rms 50-150"]),
             percent(row["rms 150-400"]), percent(row["impulse_error"]), percent(row["drift_error"]), row["class"],
             "" if row["estimate"] is None else percent(row["estimate"])]
            for row in summary]
    return tables.markdown("Cost (mean over the cases) and error (worst case; rms also of the median case)", head, rows)


def recommendation_table(lines: list, spectra: str) -> str:
    rows = [[f"{percent(line['target'])} %", line["setting"], percent(line["rms"]) + " %", line["per_second"],
             line["speed_up"]] for line in lines]
    return tables.markdown(f"Cheapest setting for an error of the {spectra} spectra, 1-400 Hz",
                           ["at most", "take", "found", "s per s of motion", "times faster"], rows)


def to_paste(lines: list, savings: list) -> str:
    """The options of each setting that ran, as a command line takes them."""
    wanted = dict.fromkeys(line["setting"] for line in lines)
    told = [f"{one.name}: {settings.pasted(one)}\n" for one in savings if one.name in wanted]
    return "Options to paste\n\n" + "".join(f"    {line}" for line in told) if told else ""


def say(line: str) -> None:
    print(line, flush=True)


def scene_study(options: argparse.Namespace, folder: Path) -> tuple:
    """Rows and settings of a scene of the user's. Throws RunError if full order fails."""
    case = runs.SceneCase(options.scene, options.window)
    failures = []
    full = runs.run(case, settings.REFERENCE, options.ranks, folder, failures.append)
    if full is None:
        raise RunError(failures[-1].strip())
    if not full.moving():
        raise RunError(f"{options.scene}: no spectrum of a probe to compare; has it probes, and does the ground move?")
    structures = tuple(full.summary["structures"])
    dofs = max(one["dofs"] for one in full.summary["structures"].values())
    savings = settings.of_scene(structures, dofs, full.summary["time_step"], options.estimate)
    unknown = [name for name in options.only or [] if name not in [one.name for one in savings]]
    if unknown:
        raise RunError(f"--only {unknown[0]}: none of {', '.join(one.name for one in savings)}")
    savings = [one for one in savings if not options.only or one.name in options.only]
    rows = study.study([case], savings, options.ranks, folder, say, settings.scene_noise(full.summary["time_step"]))
    return rows, savings


def pair_study(options: argparse.Namespace, folder: Path) -> tuple:
    """As scene_study, for the two-storey pair."""
    savings = [one for one in settings.SAVINGS if not options.only or one.name in options.only]
    cases = study.cases(options.window or 5.0, options.records, options.gap or study.GAPS)
    return study.study(cases, savings, options.ranks, folder, say), savings


def study_all(options: argparse.Namespace, folder: Path) -> int:
    """Every setting, beside each other; 1 if no run came to its end."""
    rows, savings = (scene_study if options.scene else pair_study)(options, folder)
    if not rows:
        print(f"{NAME}: no run came to its end", file=sys.stderr)
        return 1
    summary = study.summarised(rows)
    spectra = "floor" if options.scene else "floor-2"
    tables.write_csv(folder / "tradeoff.csv", rows)
    text = setting_table(summary, savings) + "\n" + recommendation_table(study.recommendations(summary), spectra)
    text += "\n" + to_paste(summary, savings)
    write_text(folder / "tradeoff.md", text)
    tradeoff_figure.draw(summary, folder / "tradeoff.png", spectra)
    print("\n" + text, end="")
    print(f"see {folder / 'tradeoff.csv'} and tradeoff.png")
    return 0


def main() -> int:
    options = arguments()
    ours = Path("results") / f"tradeoff-{options.scene.stem}" if options.scene else SOURCE / "results" / "tradeoff"
    folder = (options.output or ours).resolve()
    with alone_in(folder, NAME):
        build(SOURCE, "pounding")
        program()
        return study_all(options, folder)
