"""The page to look at: tables and figures in one file without links."""

import base64
from html import escape
from pathlib import Path

import numpy as np

from pounding.results import Result
from .style import G

CSS = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; margin: 0.8em 0; font-size: 0.9em; }
caption { text-align: left; font-weight: bold; padding: 0.3em 0; }
th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #888; } th:first-child, td:first-child { text-align: left; }
figure { margin: 1.5em 0; } img { max-width: 100%; height: auto; }
figcaption, .note { color: #555; font-size: 0.9em; }
"""


def _number(value) -> str:
    if isinstance(value, bool) or value is None:
        return "–" if value is None else str(value)
    if isinstance(value, (int, np.integer)):
        return f"{value:,}".replace(",", "\u202f")
    if isinstance(value, (float, np.floating)):
        return f"{value:.4g}" if np.isfinite(value) else "not finite"
    return escape(str(value))


def html_table(caption: str, header: list, rows: list) -> str:
    if not rows:
        return ""
    head = "".join(f"<th>{escape(text)}</th>" for text in header)
    body = "".join("<tr>" + "".join(f"<td>{_number(cell)}</td>" for cell in row) + "</tr>\n"
                   for row in rows)
    return f"<table><caption>{escape(caption)}</caption>\n<tr>{head}</tr>\n{body}</table>\n"


def _run_table(summary: dict) -> str:
    labels = (("version", "version"), ("end_time", "end time [s]"), ("time_step", "time step [s]"),
              ("steps", "steps"), ("ranks", "ranks"), ("wall_time", "wall time [s]"),
              ("microseconds_per_step", "µs per step"))
    rows = [(label, summary[key]) for key, label in labels if key in summary]
    return html_table("Run", ["", ""], rows)


def _structure_tables(summary: dict) -> str:
    structures = summary.get("structures", {})
    rows = []
    for name, one in structures.items():
        elements = one.get("elements")
        if isinstance(elements, dict):
            elements = ", ".join(f"{count} {kind}" for kind, count in elements.items())
        rows.append((name, one.get("dofs"), elements, one.get("mass"), one.get("omega_max"),
                     one.get("stable_time_step")))
    text = html_table("Structures", ["", "dofs", "elements", "mass [kg]", "ω max [rad/s]",
                                     "stable time step [s]"], rows)
    for name, one in structures.items():
        modes = []
        for number, mode in enumerate(one.get("frequencies", []), 1):
            share = None
            if mode.get("effective_mass") is not None and one.get("mass"):
                share = 100.0 * mode["effective_mass"] / one["mass"]
            modes.append((number, mode.get("frequency"), mode.get("direction"),
                          mode.get("effective_mass"), share))
        text += html_table(f"Modes of {name}", ["mode", "frequency [Hz]", "direction",
                                                "effective mass [kg]", "share [%]"], modes)
    return text


def _probe_table(summary: dict) -> str:
    rows = []
    for name, probe in summary.get("probes", {}).items():
        peak = probe.get("peak_acceleration") or [None] * 3
        moved = probe.get("peak_displacement") or [None] * 3
        in_g = [None if value is None else value / G for value in peak]
        rows.append((name, *peak, in_g[0], *(None if v is None else 1e3 * v for v in moved)))
    cut = summary.get("peak_frequency")
    caption = "Peaks of the floors" + (f", accelerations below {cut:.4g} Hz" if cut else "")
    return html_table(caption, ["", "a x [m/s²]", "a y", "a z", "a x [g]", "u x [mm]", "u y",
                                "u z"], rows)


def _impact_tables(result: Result) -> str:
    impacts = result.summary.get("impacts", {})
    total = {key: value for key, value in impacts.items() if not isinstance(value, dict)}
    parts = [("all contacts", total)] if total else []
    parts += [(key, value) for key, value in impacts.items() if isinstance(value, dict)]
    text = html_table("Impacts", ["", "impacts", "total impulse [N s]", "largest impulse [N s]",
                                  "largest penetration [m]"],
                  [(name, one.get("episodes"), one.get("total_impulse"),
                    one.get("largest_impulse"), one.get("max_penetration"))
                   for name, one in parts])
    table = result.impacts
    if table and len(table["start"]):
        width = impacts.get("force_window")
        width = f"{1e3 * width:.3g} ms" if width else "a stated time"
        order = np.argsort(-table["impulse"])[:10]
        columns = (("start", "start [s]", 1), ("duration", "duration [ms]", 1e3),
                   ("impulse", "impulse [N s]", 1), ("window_force", f"force over {width} [kN]", 1e-3),
                   ("points", "points", 1), ("energy_lost", "energy lost [J]", 1))
        columns = [column for column in columns if column[0] in table]
        rows = [(str(table["contact"][i]), *(float(table[key][i] * scale)
                                             for key, _, scale in columns)) for i in order]
        text += html_table(f"The strongest {len(rows)} impacts",
                           ["contact"] + [label for _, label, _ in columns], rows)
    return text


def _joint_table(result: Result) -> str:
    closings = result.closings()
    episodes = result.summary.get("impacts", {})
    rows = []
    for name, one in result.summary.get("separations", {}).items():
        closing = closings.get(name)
        hit = closing is not None and episodes.get(name, {}).get("episodes", 0) > 0
        cells = [1e3 * one[key] for key in ("gap", "modal", "ddc", "srss", "sum")]
        rows.append((name, *cells, "hit" if hit else None if closing is None else 1e3 * closing))
    return html_table("Joints: width, and what would be needed by response spectrum so that nothing hits [mm]",
                      ["", "width", "modal", "DDC", "SRSS", "sum", "closed in the history"], rows)


def _energy_table(summary: dict) -> str:
    labels = (("input", "work of the ground [J]"), ("damping", "damping [J]"),
              ("contact", "contact [J]"), ("relative_residual", "relative residual"))
    energy = summary.get("energy", {})
    return html_table("Energy", ["", ""],
                  [(label, energy[key]) for key, label in labels if key in energy])


def html_figure(folder: Path, page: dict) -> str:
    image = base64.b64encode((folder / page["file"]).read_bytes()).decode()
    return (f'<h2>{escape(page["title"])}</h2>\n<figure><img alt="{escape(page["title"])}" '
            f'src="data:image/png;base64,{image}">'
            f'<figcaption>{escape(page["caption"])}</figcaption></figure>\n')


def write_page(path: Path, title: str, content: str) -> Path:
    """Writes a page of its own, its content in HTML, and returns the path."""
    title = escape(title)
    path.write_text(f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
                    f"<style>{CSS}</style></head>\n<body>\n<h1>{title}</h1>\n{content}</body></html>\n", encoding="utf-8")
    return path


def write(result: Result, pages: list, view: str = "") -> Path:
    """Writes report.html into the result folder and returns its path."""
    summary = result.summary
    tables = (_run_table(summary) + _impact_tables(result) + _joint_table(result) + _probe_table(summary)
              + _structure_tables(summary) + _energy_table(summary))
    if not summary:
        tables += '<p class="note">No summary.json in the result folder.</p>\n'
    figures = "".join(html_figure(result.folder, page) for page in pages)
    return write_page(result.folder / "report.html", result.title, tables + view + figures)
