"""Scaling, measured and modelled, as Markdown, CSV and JSON."""

import json
from pathlib import Path

from pounding.tables import markdown, number, write_csv
from pounding.files import write_text

from .machine import Machine
from .scaling_model import Messages, undivided

PARTS = ("compute", "within", "between", "exchange", "rows", "agreement")


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
    rows = []
    for study in studies:
        single = study.model.predict(undivided(study.parts[0]))["step"]
        for part in study.parts:
            times = study.model.predict(part)
            ideal = part["elements"] / part["parts"]
            found = [point for point in points if (point.kind, point.case, point.ranks)
                     == (study.kind, study.case, part["parts"])]
            rows.append({
                "source": "modelled", "kind": study.kind, "case": study.case, "dofs": part["dofs"],
                "ranks": part["parts"], "microseconds_per_step": 1e6 * times["step"],
                "nanoseconds_per_dof": 1e9 * times["step"] / part["dofs"],
                "speed_up": single / times["step"],
                "efficiency": single / times["step"] / part["parts"],
                "beside_a_share_alone": times["alone"] / times["step"],
                "overlapped_microseconds": 1e6 * times["overlapped"],
                "overlapped_efficiency": single / times["overlapped"] / part["parts"],
                "overlapped_beside_a_share_alone": times["alone"] / times["overlapped"],
                **{f"{name}_microseconds": 1e6 * times[name] for name in PARTS},
                "measured_microseconds": 1e6 * found[0].seconds.median if found else None,
                "divided": part["divided"], "largest_dofs": part["dofs_per_part"]["largest"],
                "imbalance": part["elements_per_part"]["largest"] / ideal,
                "mean_held": part["elements_per_part"]["mean"] / ideal,
                "mean_outer": part["outer_per_part"]["mean"] / ideal,
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


def contact_of(row: dict) -> float:
    """Time of constraints, and of what ranks agree on [µs]."""
    return sum(row[f"{name}_microseconds"] for name in ("exchange", "rows", "agreement"))


def modelled_table(rows: list) -> str:
    """Parts of the time and the largest of everything are in table.csv."""
    head = ["dofs", "parts", "dofs of the largest part", "elements held, largest over ideal", "ghost dofs, mean",
            "neighbours, mean", "messages [µs]", "contact [µs]", "step [µs]", "efficiency",
            "beside an equal share alone", "measured [µs]"]
    cells = [[row["dofs"], row["ranks"], row["largest_dofs"], row["imbalance"], row["mean_halo"],
              row["mean_neighbours"], row["within_microseconds"] + row["between_microseconds"], contact_of(row),
              row["overlapped_microseconds"], row["overlapped_efficiency"], row["overlapped_beside_a_share_alone"],
              row["measured_microseconds"]] for row in rows if row["kind"] == "pair"]
    return markdown("Modelled: two buildings of three storeys, the interface looked at in every step", head, cells)


def large_table(studies: list, rows: list) -> str:
    """Large pairs, below one that METIS parts by its bricks, and by bricks in fives as well."""
    network = next(study.model.network for study in studies if study.kind == "large")
    head = ["dofs", "parts", "METIS sees bricks of", "elements held over ideal, mean / largest",
            "elements with ghosts over ideal", "ghost dofs, mean / largest", "neighbours, mean / largest",
            "messages within / between nodes [µs]", "contact [µs]", "step, without / with overlap [µs]", "efficiency",
            "beside an equal share alone"]
    cells = [[row["dofs"], row["ranks"], f"{row['divided']}³" if row["divided"] > 1 else "1",
              *(" / ".join(number(row[name]) for name in names) for names in (
                  ("mean_held", "imbalance"), ("mean_outer",), ("mean_halo", "largest_halo"),
                  ("mean_neighbours", "largest_neighbours"), ("within_microseconds", "between_microseconds"))),
              contact_of(row),
              *(" / ".join(number(row[name]) for name in names) for names in (
                  ("microseconds_per_step", "overlapped_microseconds"), ("efficiency", "overlapped_efficiency"),
                  ("beside_a_share_alone", "overlapped_beside_a_share_alone")))]
             for row in rows if row["kind"] == "large"]
    return markdown(f"Modelled on nodes of {network.cores} cores, {number(1e6 * network.latency)} µs and "
                    f"{number(1e-9 * network.bandwidth)} GB/s between them: the two buildings", head, cells)


def machine_table(machine: Machine, messages: Messages) -> str:
    rows = [[f"multiply-adds, {ranks} rank{'s' if ranks > 1 else ''} [Gflop/s]", series.median / 1e9,
             series.lowest / 1e9, series.highest / 1e9] for ranks, series in machine.flops.items()]
    table = markdown("Machine in the same run", ["", "median", "lowest", "highest"], rows)
    return table + (f"\nMessages between two ranks: {number(1e6 * messages.latency)} µs for the shortest, "
                    f"{number(messages.bandwidth / 1e9)} GB/s.\n")


NOTES = """\
- `apart`: every rank a model of its own, nothing exchanged; `pair`: the two buildings of the model below.
- Medians over the rounds in which the ranks had their cores (multiply-adds at 0.9 of the ideal), over all where no
  round was quiet. All points of a case take turns.
- `efficiency` is beside the same model on one rank, whose memory is slower than the caches of a small part; an
  equal share alone has the cost per dof of its own size: uneven shares, elements on both sides of cuts, messages
  and contact are left.
- The modelled times add up compute, halo and constraints of the slowest part, at this machine's cost per dof and its
  messages within a node; those between nodes, by latency and bandwidth, travel while elements without ghosts are done.
  They are an estimate, not a measurement; where the same mesh was run, the last column has it.
"""


def write(folder: Path, points: list, studies: list, machine: Machine, messages: Messages, about: dict) -> str:
    """Writes table.md, table.csv and scaling.json; returns the tables."""
    measured, modelled = measured_rows(points), modelled_rows(studies, points)
    tables = [measured_table(measured), modelled_table(modelled), machine_table(machine, messages)]
    if any(study.kind == "large" for study in studies):
        tables.insert(2, large_table(studies, modelled))
    tables += [f"- {reason}" for reason in about["skipped"]]
    text = "\n".join([*tables, f"{about['processor']}, {about['cores']} cores, {about['date']}\n", NOTES])
    write_text(folder / "table.md", text)
    write_csv(folder / "table.csv", measured + modelled)
    rounds = [{**row, "seconds_per_step": point.seconds.as_json()} for row, point in zip(measured, points)]
    write_text(folder / "scaling.json", json.dumps(
        {**about, "measured": rounds, "modelled": modelled,
         "partitions": [{"case": study.case, "parts": study.parts} for study in studies],
         "machine": machine.as_json()}, indent=1) + "\n")
    return text
