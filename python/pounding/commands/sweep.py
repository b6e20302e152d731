"""One scene at many values of its options: run/sweep SCENE --set NAME=v1,v2 [--set ...] [--ranks N] [--jobs N]

    run/sweep case.yaml --set floor1_gap,floor2_gap=0.01,0.02,0.05 --set motion_x_pga=2,4
    run/sweep case.yaml --set "motion_x_record=el_centro.AT2,kobe.AT2" --set motion_x_pga=3.4,8.1 --zip
    run/sweep case.yaml --set "roof_gap=0.025,0.020;0.05,0.04"      # values with commas of their own

Runs every combination (with --zip: the first values of all, then the second ...), each in a folder of its own below
--out. Names before one = share the value. What is finished is not run again unless the scene or a file of it
changed; the same command goes on where it stopped. A member that fails is told and the others go on. Writes
sweep.csv, sweep.png and sweep.html; run/compare sets members beside each other. Exit status 1 if a member failed.
"""

import argparse
import os
from pathlib import Path

from pounding import UserError
from pounding.arguments import positive, ranks, words
from pounding.results import ResultError, load
from pounding.runs import Job, environment, program, require_room
from pounding.study import Run, alone_in, announcement, run_side_by_side, understood
from pounding.sweep import members, table
from pounding.tables import markdown, write_csv

from .process import called, parser_of

NAME = called("run/sweep")
GOES_ON = True


def arguments() -> argparse.Namespace:
    parser = parser_of(__doc__)
    parser.add_argument("scene", metavar="SCENE", type=Path, help="options file of the scene")
    parser.add_argument("--set", dest="axes", metavar="NAME=v1,v2", action="append", required=True,
                        help="values of an option (may be repeated)")
    parser.add_argument("--zip", action="store_true", help="values go together, not in every combination")
    parser.add_argument("--options", metavar="TEXT", type=words, default=[], help='more options of the program: "-end_time 5"')
    parser.add_argument("--ranks", metavar="N", type=ranks, default=1, help="of each run (default: 1)")
    parser.add_argument("--jobs", metavar="N", type=positive(int),
                        help="runs at a time (default: as many as the cores hold)")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of all (default: results/sweep-SCENE)")
    return parser.parse_args()


class Sweep:
    """The members, what they are run with, and how they ended."""

    def __init__(self, options: argparse.Namespace):
        if not options.scene.is_file():
            raise UserError(f"{options.scene}: no such file")
        self.axes = [members.read_axis(text) for text in options.axes]
        self.members = members.all_members(self.axes, options.zip)
        self.scene, self.more, self.ranks = options.scene, options.options, options.ranks
        if any(word.lstrip("-") in ("output", "dry_run", "restart") for word in self.more):
            raise UserError("--options: not with -output, -dry_run or -restart")
        self.folder = options.out or Path("results") / f"sweep-{options.scene.stem}"
        self.jobs = options.jobs or max(1, len(os.sched_getaffinity(0)) // options.ranks)
        require_room(self.ranks, self.jobs)
        self.failures, self.ended_count = {}, 0

    def place(self, member: members.Member) -> Path:
        return self.folder / member.name

    def run_of(self, member: members.Member) -> Run:
        return member.run(self.scene, self.more, self.place(member), Path.cwd())

    def run(self) -> None:
        todo = [one for one in self.members if not self.run_of(one).is_finished()]
        print(f"sweep: {announcement(len(self.members), len(todo), self.jobs, self.ranks)}; results in {self.folder}",
              flush=True)
        if todo:
            program()
        variables = environment()

        def start(member: members.Member) -> Job:
            return self.run_of(member).start(self.ranks, variables)

        def ended(member: members.Member, job: Job, waiting: list, running: list) -> None:
            self.failures[member] = job.outcome() or self.run_of(member).sign()
            self.ended_count += 1
            print(f"  {self.ended_count}/{len(todo)}  {member.name}: {self.failures[member] or 'done'}; "
                  f"{job.wall_time:.0f} s", flush=True)

        run_side_by_side(todo, self.jobs, start, ended)

    def rows(self) -> list:
        rows = []
        for member in self.members:
            failure = self.failures.get(member, "")
            if not failure:
                try:
                    with understood(self.place(member)):
                        result = load(self.place(member))
                        rows.append(table.row_of(self.axes, member, result, ""))
                        continue
                except ResultError as error:
                    failure = self.failures[member] = str(error)
            rows.append(table.row_of(self.axes, member, None, failure))
        return rows


def main() -> int:
    options = arguments()
    sweep = Sweep(options)
    with alone_in(sweep.folder, NAME):
        sweep.run()
        rows = sweep.rows()
        write_csv(sweep.folder / "sweep.csv", rows)
        page = table.write(rows, sweep.axes, f"Sweep of {sweep.scene.stem}", sweep.folder)
    print("\n" + "\n".join(table.sentences(rows, sweep.axes)))
    print("\n" + markdown("Impacts and largest floor spectra [m/s2]", *table.shown(rows, sweep.axes)))
    commits = {row["commit"] for row in rows if row.get("commit")}
    if len(commits) > 1:
        print(f"note: the members were run by different builds of the program ({', '.join(sorted(commits))})")
    failed = sum(bool(why) for why in sweep.failures.values())
    print(f"sweep: {len(rows)} members, {failed} failed; see {page} and sweep.csv")
    return 1 if failed else 0
