"""How likely it is, with error bars: run/fragility STUDY.yaml [--ranks N] [--out DIR]

    run/fragility petsc-options/azalee/fragility.yaml --ranks 2
    run/fragility study.yaml --dry-run          # the members and the motions' correlation, nothing else
    run/fragility study.yaml --part 3/10        # one of ten jobs of an array; when all are done:
    run/fragility study.yaml --collect

Puts samples of ground motion and of what is not known exactly (gaps, stiffness, damping) to every joint and level of
the study: moments of floor spectra, probabilities of contact and of too large spectra with their intervals, lognormal
curves, the joint that is wide enough, how many motions were enough, an error against full order.
docs/manual/fragility.md has the keys of the study file. What is finished is not run again; the same command goes on
where it stopped.
"""

import argparse
import re
import subprocess
import time
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from pounding.arguments import positive, ranks
from pounding.fragility import conditions, controlled, design, envelope, motions, report, rules, stability, struck, study, submittal
from pounding.fragility.analysis import Analysis
from pounding.fragility.both_orders import FULL, REDUCED
from pounding.fragility.runs import Runner
from pounding.plot.report import print_pdf, require_browser
from pounding.runs import program, require_room
from pounding.study import alone_in

from .process import called, parser_of

NAME = called("run/fragility")
GOES_ON = True


def part(text: str) -> tuple:
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise argparse.ArgumentTypeError(f"'{text}' is not i/n with i from 1 to n")
    return int(found[1]), int(found[2])


@contextmanager
def alone(folder: Path, options: argparse.Namespace):
    """Parts of a study share its folder; nothing else does, nor two of the same part."""
    with alone_in(folder, NAME, shared=bool(options.part)):
        if not options.part:
            yield
            return
        with alone_in(folder / "runs" / "part-{}-of-{}".format(*options.part), f"{NAME} --part"):
            yield


def arguments() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("study", metavar="STUDY", type=Path, help="study file")
    parser.add_argument("--ranks", metavar="N", type=ranks, default=1, help="of each job (default: 1)")
    parser.add_argument("--jobs", metavar="N", type=positive(int), default=1,
                        help="runs at a time where each member is a run of its own (default: 1)")
    parser.add_argument("--runner", choices=("auto", "ensemble", "single"), default="auto",
                        help="members at once, each on its own, or at once where the scene allows it (default: auto)")
    parser.add_argument("--samples", metavar="N", type=positive(int), help="in place of those of the study")
    parser.add_argument("--pdf", action="store_true", help="print the submittal, or the page, as PDF as well, with chromium")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of all (default: `output` of the study)")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--part", metavar="i/n", type=part, help="run this part of the members and stop")
    only.add_argument("--collect", action="store_true", help="run nothing; tables, figures and page of the runs that are there")
    only.add_argument("--pilot", action="store_true", help="run the pilot of full_order: accuracy, say how many members it asks for, and stop")
    only.add_argument("--dry-run", action="store_true", help="check study and motions, and stop")
    return parser.parse_args()


def run(options: argparse.Namespace) -> int:
    found = study.read(options.study)
    if options.samples:
        found.samples = max(2, options.samples)
    study.check_orders(found)
    folder = options.out or found.output
    options.browser = require_browser("--pdf") if options.pdf else None
    require_room(options.ranks, options.jobs)
    program()
    with alone(folder, options):
        return carry_out(found, folder, options)


def carry_out(found: study.Study, folder: Path, options: argparse.Namespace) -> int:
    """One study, or one in each of its conditions and their envelope."""
    submittal.read(found)
    in_conditions = conditions.find(found)
    if not in_conditions:
        one = members_of(found, folder, options)
        if one:
            alone_there = conditions.Condition(conditions.ALONE, conditions.ALONE, found)
            submitted(across(envelope.Envelope(found, {alone_there: one}, folder), options), options)
        return 0
    told, analyses = [], {}
    for number, condition in enumerate(in_conditions, 1):
        began = time.monotonic()
        print(f"fragility: {condition.title} ({number} of {len(in_conditions)})", flush=True)
        place = folder / "conditions" / condition.folder
        place.mkdir(parents=True, exist_ok=True)
        with alone(place, options):
            same = condition.study.axes is found.axes
            one = members_of(condition.study, place, options, folder / "motions" if same else None)
        told.append(time.monotonic() - began)
        left = sum(told) / len(told) * (len(in_conditions) - number)
        if left and not options.collect:
            print(f"fragility: {number} of {len(in_conditions)} conditions done, about {left / 60:.0f} min to go", flush=True)
        if one:
            analyses[condition] = one
    if analyses:
        whole = across(envelope.Envelope(found, analyses, folder), options)
        page, text = envelope.write(whole)
        print("\n" + text)
        print(f"see {page}")
        submitted(whole, options)
    return 0


def across(one: envelope.Envelope, options: argparse.Namespace) -> envelope.Envelope:
    """Makes the histories of what spans the joint, and says where they are."""
    if not options.collect:
        one.make_histories()
        print("".join(f"{note}\n" for note in one.notes), end="", flush=True)
    return one


def submitted(one: envelope.Envelope, options: argparse.Namespace) -> None:
    """Writes the submittal where the study has one, and prints it on paper where that is asked for."""
    page = submittal.write(one)
    if page:
        print(f"see {page}")
    if options.browser:
        print(f"see {print_pdf(page or one.folder / 'fragility.html', options.browser, subprocess.run)}")


def members_of(found: study.Study, folder: Path, options: argparse.Namespace,
               kept: Path | None = None) -> Analysis | None:
    """Runs what is asked for of the members of one study, and writes its tables and page where all are there; nothing of
    a part or of a dry run. `kept`: folder of motions that other studies have as well."""
    matrix = motions.check(found, folder, options.jobs, not options.part, kept)
    plan = design.build(found)
    closed = design.clipped(found, plan)
    notes = [f"Doubt: {doubt}" for doubt in study.doubts(found)]
    notes += motions.judged(found, folder, options.jobs, not options.part, kept)
    notes += [f"{closed} gaps would be below zero: these joints are closed."] if closed else []
    count = len(matrix) // len(found.axes)
    pairs = {together: [abs(matrix[i, j]) for i in range(len(matrix)) for j in range(i) if (i % count == j % count) is together]
             for together in (True, False)}
    told = [f"{words} {max(pairs[together]):.3f}" for together, words in ((True, "of one sample"), (False, "of different samples"))
            if pairs[together]]
    print(f"fragility: {len(plan.members)} members, {len(plan.repeated)} of them repeated at full order; largest "
          f"correlation of two motions {', '.join(told) or 'none'}; results in {folder}", flush=True)
    print("".join(f"{note}\n" for note in notes), end="", flush=True)
    runner = Runner(found, plan, folder, options.ranks, options.jobs, options.runner, options.collect)
    ends = [f"Doubt: {doubt}" for doubt in runner.scouted[REDUCED].doubts]
    print("".join(f"{note}\n" for note in ends), end="", flush=True)
    notes += ends
    if options.dry_run:
        return None
    numbers = found.both and controlled.settle(runner, not options.collect and not options.part)
    if numbers:
        print(f"fragility: {numbers.told}", flush=True)
        found, plan = runner.study, runner.design = replace(found, samples=numbers.count), plan.first(numbers.count)
    if options.pilot:
        return None
    if not options.collect:
        began = time.monotonic()
        share = options.part or (1, 1)
        how = controlled.run(runner, numbers, share) if numbers else \
            runner.run(share, {REDUCED: plan.members, **({FULL: [plan.members[index] for index in plan.repeated]} if plan.repeated else {})})
        print(f"fragility: runs ended after {time.monotonic() - began:.0f} s ({how})", flush=True)
        if options.part:
            return None
    gathered, repeats = runner.complete(plan.members), [plan.members[index] for index in plan.repeated]
    full = runner.complete(repeats, FULL, "repeats") if repeats else None
    ruled, note = ({}, "") if found.is_surveyed else rules.find(found, plan, runner.scene(REDUCED), folder, options.jobs)
    notes += [note] if note else []
    analysis = Analysis(found, plan, gathered, runner.equipment, notes, runner.scouted[REDUCED].inputs, runner, runner.mats)
    notes += stability.doubts(analysis) + struck.doubts(analysis)
    analysis.controlled = controlled.Controlled(runner, numbers, analysis) if numbers else None
    page, text = report.write(analysis, full, ruled, notes, folder)
    print("\n" + text)
    print(f"see {page}")
    return analysis


def main() -> int:
    return run(arguments())
