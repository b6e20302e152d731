"""What each form that serves speed alone earns: time of a step without it over that with it."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from parts.tables import markdown, write_csv
from pounding.files import write_text

from .comparison import check_agreement
from .workers import Stepper, block_cells, slab_cells, step_benchmark

# Where arrays come to lie differs from process to process, and with it the time by some percent.
PROCESSES = 4
CONTROLS = ["without:nothing_1", "without:nothing_2"]  # two models with all forms

# Names as in src/stiffness/rows/product_forms.h, and the update's.
LABELS = {
    "bricks": "boxes in rows, split by their mid-planes",
    "rectangles": "rectangular shells likewise",
    "strains": "elements of general shape by their strains",
    "beams": "beams from their local stiffnesses",
    "best_axis": "rows along the best axis",
    "hand_over": "forces handed over chain by chain",
    "best_thickness": "pairs along the better axis",
    "both_sides": "bricks on both sides of a pair in one step",
    "lent_lines": "lines lent to a pair that is alone",
    "row_pairs": "rows of such a pair loaded together",
    "rows": "dofs that follow each other in vectors",
    "part_cores": "where some nodes move otherwise",
    "set_behind": "first forces on a pair set",
    "set_joins": "first forces on a chain set",
    "shell_vectors": "nodes with six dofs in vectors",
    "update_vectors": "update of nodes in vectors",
    "nothing": "(nothing left out)",
}
OF_ROWS = ["best_axis", "hand_over"]
OF_BRICKS = ["bricks", *OF_ROWS, "best_thickness", "both_sides", "lent_lines", "row_pairs", "rows",
             "part_cores", "set_behind", "set_joins"]
OF_SHELLS = ["rectangles", *OF_ROWS, "shell_vectors"]
OF_ANY = ["update_vectors", "nothing"]


@dataclass(frozen=True)
class Case:
    """A model and the forms that can matter to it."""

    label: str
    model: list
    forms: list


def cells(numbers: tuple) -> list:
    return ["-cells", ",".join(str(n) for n in numbers)]


SLAB = slab_cells(36_000)
PLATE = (*SLAB[:2], 0)
CASES = {
    "slab": Case("slab of bricks, 36k", cells(SLAB), OF_BRICKS + OF_ANY),
    "block": Case("block of bricks, 100k", cells(block_cells(100_000)), OF_BRICKS + OF_ANY),
    "plate": Case("plate of shells, 36k", cells(PLATE), OF_SHELLS + OF_ANY),
    "opening": Case("plate with an opening, 33k", [*cells(PLATE), "-opening"], OF_SHELLS + OF_ANY),
    "million": Case("block of bricks, 1M", cells(block_cells(1_000_000)),
                    ["set_behind", "nothing"]),
    "skew": Case("slab of skew bricks, 36k", [*cells(SLAB), "-skew"], ["strains"] + OF_ANY),
    "pair": Case("two-storey pair, bricks", ["-scene", "petsc-options/azalee/gap2.yaml"],
                 OF_BRICKS + ["beams"] + OF_ANY),
    "pair-b": Case("two-storey pair, shells", ["-scene", "petsc-options/azalee/b-gap2.yaml"],
                   OF_SHELLS + ["beams"] + OF_ANY),
}


@dataclass
class Earning:
    """Ratios of one form in one case, one per turn, and the times of the step with it [s]."""

    case: str
    ranks: int
    form: str
    ratios: list = field(default_factory=list)
    seconds: list = field(default_factory=list)

    @property
    def median(self) -> float:
        return float(np.median(self.ratios))

    def quartile(self, part: float) -> float:
        return float(np.quantile(self.ratios, part))


def measure(folder: Path, motion: Path, name: str, ranks: int, rounds: int, lasting: float) -> list:
    """Every form once per round, between two steps that lack nothing."""
    case = CASES[name]
    earnings = [Earning(name, ranks, form) for form in case.forms]

    def seconds(stepper: Stepper, way: str) -> float:
        return stepper.ask(f"{way} {lasting}")["quiet_seconds_per_step"]

    for process in range(PROCESSES):
        order = earnings[::-1] if process % 2 else earnings
        ways = [CONTROLS[0], *(f"without:{earning.form}" for earning in order), CONTROLS[1]]
        with Stepper(step_benchmark(folder, ranks, motion, case.model, ways)) as stepper:
            check_agreement({(way, ranks): told["displacement_square"]
                             for way, told in stepper.ways.items()})
            for _ in range(rounds):
                before = seconds(stepper, CONTROLS[0])
                for turn, earning in enumerate(order):
                    without = seconds(stepper, f"without:{earning.form}")
                    after = seconds(stepper, CONTROLS[1 - turn % 2])
                    earning.ratios.append(2 * without / (before + after))
                    earning.seconds.append(after)
                    before = after
    return earnings


def table(earnings: list) -> str:
    columns = list(dict.fromkeys((earning.case, earning.ranks) for earning in earnings))
    found = {(earning.form, earning.case, earning.ranks): earning for earning in earnings}
    head = ["form"] + [f"{CASES[case].label}{f', {ranks} ranks' if ranks > 1 else ''}"
                       for case, ranks in columns]
    rows = [[f"`{form}`: {LABELS[form]}"] + [f"{found[form, *column].median:.2f}" if (form, *column) in found else ""
                              for column in columns]
            for form in LABELS if any(earning.form == form for earning in earnings)]
    return markdown("Time of a step without a form over that with it", head, rows)


def write(folder: Path, earnings: list) -> str:
    """Writes forms.md and forms.csv; returns the table."""
    text = table(earnings)
    write_text(folder / "forms.md", text)
    write_csv(folder / "forms.csv", [
        {"case": earning.case, "ranks": earning.ranks, "form": earning.form, "ratio": earning.median,
         "quarter_below": earning.quartile(0.25), "quarter_above": earning.quartile(0.75),
         "microseconds_per_step": 1e6 * float(np.median(earning.seconds)), "turns": len(earning.ratios)}
        for earning in earnings])
    return text
