"""Scaling, measured and modelled, as Markdown, CSV and JSON."""

import json
from pathlib import Path

from pounding.tables import markdown, number, write_csv
from pounding.files import write_text

from .machine import Machine
from .scaling_model import Messages

PARTS = ("compute", "halo", "exchange", "rows")


def measured_rows(points: list) -> list:
    """Speed-up over the fewest ranks of the same case; apart: at equal load per rank."""
    rows = []
    for point in points:
        first = min((other for other in points if (other.kind, other.case) == (point.kind, point.case)),
                    key=lambda other: other.ranks)
        faster = first.seconds.median / point.seconds.median
        growth = point.dofs / first.dofs
        ideal = point.ranks / first.ranks
        rows.append({"source": "measured", "kind": point.kind, "case": point.case,
                     "dofs": point.dofs, "ranks": point.ranks,
                     "microseconds_per_step": 1e6 * point.seconds.median,
                     "lowest": 1e6 * point.seconds.lowest, "highest": 1e6 * point.seconds.highest,
                     "nanoseconds_per_dof": 1e9 * point.seconds.median / point.dofs,
                     "speed_up": faster * growth, "efficiency": faster * growth / ideal,
                     "quiet_rounds": sum(point.seconds.quiet), "rounds": len(point.seconds.values),
                     "contact_microseconds": 1e6 * point.contact.median if point.contact.values else None})
    return rows


def modelled_rows(studies: list, points: list) -> list:
    """`studies`: (case, Model, lines of the study) per mesh."""
    rows = []
    for case, model, parts in studies:
        single = model.predict(parts[0])["step"]
        for part in parts:
            times = model.predict(part)
            found = [point for point in points if point.kind == "pair"
                     and (point.case, point.ranks) == (case, part["parts"])]
            rows.append({
                "source": "modelled", "kind": "pair", "case": case, "dofs": part["dofs"],
                "ranks": part["parts"], "microseconds_per_step": 1e6 * times["step"],
                "nanoseconds_per_dof": 1e9 * times["step"] / part["dofs"],
                "speed_up": single / times["step"],
                "efficiency": single / times["step"] / part["parts"],
                "beside_a_share_alone": times["alone"] / times["step"],
                **{f"{name}_microseconds": 1e6 * times[name] for name in PARTS},
                "measured_microseconds": 1e6 * found[0].seconds.median if found else None,
                "largest_dofs": part["dofs_per_part"]["largest"],
                "imbalance": part["elements_per_part"]["largest"] * part["parts"] / part["elements"],
                "largest_halo": part["received"]["largest"], "mean_halo": part["received"]["mean"],
                "largest_neighbours": part["neighbours"]["largest"],
                "mean_neighbours": part["neighbours"]["mean"],
                "contact_rows": part["contact_rows"], "contact_members": part["contact_members"],
                "largest_contact_rows": part["contact_rows_per_part"]})
    return rows


def measured_table(rows: list) -> str:
    head = ["scaling", "case", "dofs", "ranks", "µs per step", "lowest to highest", "ns per dof",
            "speed-up", "efficiency", "quiet rounds"]
    cells = [[row["kind"], row["case"], row["dofs"], row["ranks"], row["microseconds_per_step"],
              f"{number(row['lowest'])} to {number(row['highest'])}", row["nanoseconds_per_dof"], row["speed_up"],
              row["efficiency"], f"{row['quiet_rounds']} of {row['rounds']}"] for row in rows]
    return markdown("Measured", head, cells)


def modelled_table(rows: list) -> str:
    """Parts of the time and the largest of everything are in table.csv."""
    head = ["dofs", "parts", "dofs of the largest part", "elements held, largest over ideal", "ghost dofs, mean",
            "neighbours, mean", "messages [µs]", "contact [µs]", "step [µs]", "efficiency",
            "beside an equal share alone", "measured [µs]"]
    cells = [[row["dofs"], row["ranks"], row["largest_dofs"], row["imbalance"], row["mean_halo"],
              row["mean_neighbours"], row["halo_microseconds"],
              row["exchange_microseconds"] + row["rows_microseconds"], row["microseconds_per_step"],
              row["efficiency"], row["beside_a_share_alone"], row["measured_microseconds"]] for row in rows]
    return markdown("Modelled: two buildings of three storeys, the interface looked at in every step", head, cells)


def machine_table(machine: Machine, messages: Messages) -> str:
    rows = [[f"multiply-adds, {ranks} rank{'s' if ranks > 1 else ''} [Gflop/s]", series.median / 1e9,
             series.lowest / 1e9, series.highest / 1e9] for ranks, series in machine.flops.items()]
    table = markdown("Machine in the same run", ["", "median", "lowest", "highest"], rows)
    source = "given" if messages.given else "measured between two ranks"
    return table + (f"\nMessages, {source}: {number(1e6 * messages.latency)} µs for the shortest, "
                    f"{number(messages.bandwidth / 1e9)} GB/s.\n")


NOTES = """\
- `apart`: every rank a model of its own, nothing exchanged; `pair`: the two buildings of the model below.
- Medians over the rounds in which the ranks had their cores (multiply-adds at 0.9 of the ideal), over all where no
  round was quiet. All points of a case take turns.
- `efficiency` is beside the same model on one rank, whose memory is slower than the caches of a small part; an
  equal share alone has the cost per dof of its own size: uneven shares, elements on both sides of cuts, messages
  and contact are left.
- The modelled times add up compute, halo and constraints of the part that has most of each, with nothing
  overlapping, at this machine's cost per dof and its messages (within one machine, unless latency and bandwidth are
  given). They are an estimate, not a measurement; where the same mesh was run, the last column has it.
"""


def write(folder: Path, points: list, studies: list, machine: Machine, messages: Messages, about: dict) -> str:
    """Writes table.md, table.csv and scaling.json; returns the tables."""
    measured, modelled = measured_rows(points), modelled_rows(studies, points)
    tables = [measured_table(measured), modelled_table(modelled), machine_table(machine, messages)]
    tables += [f"- {reason}" for reason in about["skipped"]]
    text = "\n".join([*tables, f"{about['processor']}, {about['cores']} cores, {about['date']}\n", NOTES])
    write_text(folder / "table.md", text)
    write_csv(folder / "table.csv", measured + modelled)
    rounds = [{**row, "seconds_per_step": point.seconds.as_json()} for row, point in zip(measured, points)]
    write_text(folder / "scaling.json", json.dumps(
        {**about, "measured": rounds, "modelled": modelled,
         "partitions": [{"case": case, "parts": parts} for case, _, parts in studies],
         "machine": machine.as_json()}, indent=1) + "\n")
    return text
