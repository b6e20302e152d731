"""Tables of what a run found: impacts, joints, floors, drifts, forces, energy, warnings."""

import numpy as np

from pounding.results import Result
from .markup import html_table, paragraphs
from .style import G

STRONGEST = 10  # impacts that are listed
MOST_FORCES = 60  # rows of the table of forces; forces.csv has all


ROUND_OFF = 1e-9  # of the largest value of its kind: what is below it is shown as 0


def _times(value, factor: float):
    return None if value is None else factor * value


def _settled(rows: list, *kinds: range) -> list:
    """Rows with 0 for what is round-off beside the largest value in the columns of its kind."""
    rows = [list(row) for row in rows]
    for columns in kinds:
        largest = max((abs(row[i] or 0) for row in rows for i in columns), default=0.0)
        for row in rows:
            for i in columns:
                row[i] = 0 if row[i] is not None and abs(row[i]) < ROUND_OFF * largest else row[i]
    return rows


def probe_table(result: Result, twin: Result | None = None) -> str:
    summary = result.summary
    rows = []
    for name, probe in summary.get("probes", {}).items():
        peak = probe.get("peak_acceleration") or [None] * 3
        moved = probe.get("peak_displacement") or [None] * 3
        row = [name, *peak, *(_times(value, 1 / G) for value in peak), *(_times(value, 1e3) for value in moved)]
        if twin:
            other = twin.summary.get("probes", {}).get(name, {}).get("peak_acceleration") or [None] * 3
            row += other
        rows.append(row)
    rows = _settled(rows, range(1, 4), range(4, 7), range(7, 10), *([range(10, 13)] if twin else []))
    cut = summary.get("peak_frequency")
    caption = "Peaks of the floors" + (f", accelerations below {cut:.4g} Hz" if cut else "")
    header = ["", "a x [m/s²]", "a y", "a z", "a x [g]", "a y", "a z", "u x [mm]", "u y", "u z"]
    return html_table(caption, header + (["without: a x [m/s²]", "a y", "a z"] if twin else []), rows)


def impact_tables(result: Result) -> str:
    impacts = result.summary.get("impacts", {})
    total = {key: value for key, value in impacts.items() if not isinstance(value, dict)}
    parts = [("all contacts", total)] if total else []
    parts += [(key, value) for key, value in impacts.items() if isinstance(value, dict)]
    width = impacts.get("force_window")
    width = f"{1e3 * width:.3g} ms" if width else "a stated time"
    text = html_table("Impacts", ["", "impacts", "total impulse [N s]", "largest impulse [N s]", f"largest force over {width} [kN]",
                                  "energy lost [J]", "largest penetration [m]"],
                      [(name, one.get("episodes"), one.get("total_impulse"), one.get("largest_impulse"),
                        _times(one.get("window_force"), 1e-3), one.get("energy_lost"), one.get("max_penetration"))
                       for name, one in parts])
    table = result.impacts
    if table and len(table["start"]):
        order = np.argsort(-table["impulse"])[:STRONGEST]
        columns = (("start", "start [s]", 1), ("duration", "duration [ms]", 1e3),
                   ("impulse", "impulse [N s]", 1), ("window_force", f"force over {width} [kN]", 1e-3),
                   ("points", "points", 1), ("energy_lost", "energy lost [J]", 1))
        columns = [column for column in columns if column[0] in table]
        rows = [(str(table["contact"][i]), *(float(table[key][i] * scale) for key, _, scale in columns)) for i in order]
        text += html_table(f"The strongest {len(rows)} impacts, of {len(table['start'])}",
                           ["contact"] + [label for _, label, _ in columns], rows)
    return text


def joint_table(result: Result) -> str:
    closings = result.closings()
    episodes = result.summary.get("impacts", {})
    rows = []
    for name, one in result.summary.get("separations", {}).items():
        closing = closings.get(name)
        hit = closing is not None and episodes.get(name, {}).get("episodes", 0) > 0
        cells = [1e3 * one[key] for key in ("gap", "modal", "ddc", "srss", "sum")]
        rows.append((name, *cells, "hit" if hit else None if closing is None else 1e3 * closing))
    return html_table("Joints: width, and width needed by response spectrum so that nothing hits [mm]",
                      ["", "width", "modal", "DDC", "SRSS", "sum", "closed in the history"], rows)


def yield_table(result: Result) -> str:
    """Elements that may yield, by law and, where floors are named, by storey."""
    rows = []
    for name, law in result.summary.get("yielding", {}).items():
        parts = [(name, "", law), *(("", storey, part) for storey, part in law.get("storeys", {}).items())]
        rows += [(law_name, storey, part["yielded"], part["elements"], part["ductility"], part["element"], part["first_time"],
                  part["energy_lost"]) for law_name, storey, part in parts]
    return html_table("Yielding", ["law", "storey", "yielded", "of", "ductility", "of element", "first at [s]", "lost [J]"], rows,
                      text=(0, 1))


def drift_table(result: Result) -> str:
    rows = [(one["structure"], one["upper"], one["lower"], one["height"],
             *(value for peak, time in zip(one["peak"], one["time"]) for value in (100 * peak, time)))
            for one in result.summary.get("drifts", [])]
    return html_table("Drifts between floors", ["structure", "floor", "over", "height [m]", "along x [%]", "at [s]",
                                                "along y [%]", "at [s]"], rows, text=(1, 2))


def span_table(result: Result) -> str:
    rows = [(name, *(1e3 * value for value in span.largest[0]), span.largest[1][3]) for name, span in result.spans.items()]
    return html_table("Spans: largest motion of the second end against the first, since the start",
                      ["span", "ux [mm]", "uy", "uz", "|u|", "rx [mrad]", "ry", "rz", "|r|", "|u| at [s]"],
                      _settled(rows, range(1, 5), range(5, 9)), text=(0,))


def force_table(result: Result, twin: Result | None = None) -> str:
    """The largest value of each component of each item, and which element has it."""

    def largest(table: dict) -> dict:
        found = {}
        for i in range(len(table.get("peak", []))):
            key = str(table["item"][i]), str(table["component"][i])
            if key not in found or abs(table["peak"][i]) > abs(table["peak"][found[key]]):
                found[key] = i
        return found

    table = result.forces
    own, others = largest(table), largest(twin.forces) if twin else {}
    rows = []
    for (item, component), i in list(own.items())[:MOST_FORCES]:
        unit = str(table["unit"][i]) if "unit" in table else "N m" if component[0] in "MT" else "N"
        element = int(table["element"][i])
        row = [item, component, 1e-3 * table["peak"][i], f"k{unit}", table["time"][i], element or None]
        if twin:
            j = others.get((item, component))
            row.append(None if j is None else 1e-3 * float(twin.forces["peak"][j]))
        rows.append(row)
    more = f" ({MOST_FORCES} of {len(own)}, all in forces.csv)" if len(own) > MOST_FORCES else ""
    header = ["item", "component", "largest", "unit", "at [s]", "element"]
    return html_table(f"Forces: largest values of the samples{more}", header + (["without pounding"] if others else []),
                      [row[:len(header) + bool(others)] for row in rows], text=(1, 3))


def energy_table(result: Result) -> str:
    labels = (("input", "work of the ground [J]"), ("gravity", "of which gravity [J]"), ("damping", "damping [J]"),
              ("contact", "contact [J]"), ("friction", "friction of contacts [J]"), ("devices", "links and dashpots [J]"),
              ("plastic", "yielding, damage and crushing [J]"),
              ("relative_residual", "largest residual of the identity, part of the largest term"))
    energy = result.summary.get("energy", {})
    always = ("input", "damping", "contact", "relative_residual")
    return html_table("Energy at the end", ["", ""], [(label, energy[key]) for key, label in labels
                                                      if key in energy and (energy[key] or key in always)])


def warnings(result: Result) -> str:
    return paragraphs(result.summary.get("warnings", []), "Warnings")
