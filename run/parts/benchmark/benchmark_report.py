"""The comparison of the ways to step as Markdown, CSV and JSON."""

import json
from pathlib import Path

from pounding.tables import by_ranks, markdown, number, write_csv
from pounding.files import write_text

from .comparison import BYTES_PER_DOF, LABELS
from .machine import Machine


def figures(rows: list) -> list:
    """One dictionary per row of the table; what was not measured is None, with the reason."""
    elements = {(row.dofs, row.ranks): row.seconds.median for row in rows
                if row.way == "element" and row.seconds.values}
    listed = []
    for row in rows:
        one = {"dofs": row.dofs, "cells": "x".join(str(n) for n in row.cells), "ranks": row.ranks,
               "way": row.way, "label": LABELS[row.way], "microseconds_per_step": None,
               "nanoseconds_per_dof": None, "lowest": None, "highest": None,
               "ratio_to_element": None, "ratio_to_triad": None,
               "memory_per_dof": row.memory_per_dof, "rounds": len(row.seconds.values),
               "quiet_rounds": sum(row.seconds.quiet), "note": row.reason}
        if row.seconds.values:
            scale = 1e9 / row.dofs
            median = row.seconds.median
            one.update({"microseconds_per_step": 1e6 * median, "nanoseconds_per_dof": scale * median,
                        "lowest": scale * row.seconds.lowest, "highest": scale * row.seconds.highest,
                        "ratio_to_triad": median / row.bound})
            if (row.dofs, row.ranks) in elements:
                one["ratio_to_element"] = median / elements[row.dofs, row.ranks]
            if row.seconds.disturbed:
                one["note"] = "disturbed"
        listed.append(one)
    return listed


def step_table(listed: list) -> str:
    """A line per size, and one for every way that was disturbed or not measured."""
    rows = [{"dofs": one["dofs"], "ranks": one["ranks"], "ns": one["nanoseconds_per_dof"], "triad": one["ratio_to_triad"],
             "memory": one["memory_per_dof"],
             **{other["way"]: other["ratio_to_element"] for other in listed
                if (other["dofs"], other["ranks"]) == (one["dofs"], one["ranks"])}}
            for one in listed if one["way"] == "element"]
    columns = {"free dofs": "dofs", "ns per dof": "ns", **{f"{LABELS[way]}, ×": way for way in LABELS if way != "element"},
               "× triad": "triad", "memory [B per dof]": "memory"}
    text = by_ranks("Whole steps of a clamped concrete brick of hexahedra, harmonic ground motion, Rayleigh damping, no "
                    "contact: element by element, and times over that", "dofs", rows, columns)
    return text + "".join(f"\n- {one['label']}, {one['dofs']} dofs on {one['ranks']} ranks: {one['note']}"
                          for one in listed if one["note"]) + "\n"


def machine_table(machine: Machine) -> str:
    def row(label: str, series: dict) -> list:
        cells = [f"{number(series[ranks].median / 1e9)} ({number(series[ranks].lowest / 1e9)} to "
                 f"{number(series[ranks].highest / 1e9)})" if ranks in series else "—" for ranks in machine.ranks]
        return [label, *cells]

    names = list(dict.fromkeys(name for name, _ in machine.triad))
    rows = [row("multiply-adds in registers [Gflop/s]", machine.flops)]
    rows += [row(f"triad, {name} [GB/s]", {ranks: series for (where, ranks), series
                                           in machine.triad.items() if where == name})
             for name in names]
    head = [""] + [f"{ranks} rank{'s' if ranks > 1 else ''}" for ranks in machine.ranks]
    return markdown("Machine in the same run, median (lowest to highest)", head, rows)


NOTES = f"""\
- Medians over rounds in which every way took its turn; table.csv has the lowest and the highest.
- A round is quiet if the multiply-adds just before and after it reached 0.9 of the best that one rank did in this
  run, times the number of ranks (1.8 for two). Figures are medians over the quiet rounds, and marked as disturbed
  where there is none.
- `× triad`: over the time in which the triad of this run, on arrays of the same size, moves {BYTES_PER_DOF} bytes per
  dof: reading and writing the two arrays of the state. Masses, coordinates and element matrices can be shared by
  congruent bricks and are not counted.
- `element by element` is the program's own step with its energy ledger; the others are the same scheme written out
  around one product without a ledger. All have moved the brick alike to 1e-9 after their first steps.
- Memory: growth of the resident set from an empty process to a stepping one, mesh and all included, over the ranks
  together.
- What is compared is linear elasticity on congruent bricks, for which the first is specialised; small bricks stay in
  cache where matrices do not. These are ratios of this case, on this machine, in this run.
"""


def write(folder: Path, rows: list, machine: Machine, about: dict) -> str:
    """Writes table.md, table.csv and benchmark.json; returns the table."""
    listed = figures(rows)
    text = "\n".join([step_table(listed), machine_table(machine),
                      f"{about['processor']}, {about['cores']} cores, {about['date']}\n", NOTES])
    write_text(folder / "table.md", text)
    write_csv(folder / "table.csv", listed)
    measured = [{**one, "seconds_per_step": row.seconds.as_json() if row.seconds.values else None}
                for one, row in zip(listed, rows)]
    write_text(folder / "benchmark.json", json.dumps(
        {**about, "bytes_per_dof": BYTES_PER_DOF, "steps": measured, "machine": machine.as_json()}, indent=1) + "\n")
    return text
