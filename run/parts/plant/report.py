"""The page of run/plant: the answer of every run, impacts by floor, spectra beside each other, what it cost."""

import subprocess
from html import escape
from pathlib import Path

from parts import called
from parts.tables import markdown
from parts.compare import page
from parts.compare.runs import Runs
from parts.plot import answer
from parts.plot.markup import html_table, write_page
from pounding.runs import SOURCE, ending_with_us

COST = ["run", "dofs", "ranks", "steps", "microseconds per step", "wall time [s]", "seconds per second of motion",
        "memory of all ranks [GB]"]


def cost_rows(runs: Runs) -> list:
    """A row per run; start-up, modes and bases are part of the wall time, not of the steps."""
    rows = []
    for label, result in zip(runs.labels, runs.results):
        told = result.summary
        dofs = sum(structure["dofs"] for structure in told["structures"].values())
        step = told["microseconds_per_step"]
        stepping = 1e-6 * step * told["steps"] / told["end_time"]
        rows.append([label, dofs, told["ranks"], told["steps"], f"{step:.1f}", f"{told['wall_time']:.1f}",
                     f"{stepping:.3g}", f"{told['peak_memory'] / 1e9:.3g}"])
    return rows


def text(runs: Runs) -> str:
    return markdown("Cost", COST, cost_rows(runs))


def draw(folder: Path) -> str:
    """Figures and page of one run by run/plot: '' or why there are none."""
    done = subprocess.run([str(SOURCE / "run" / "plot"), str(folder)], capture_output=True, text=True,
                          preexec_fn=ending_with_us())
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or [f"{called('run/plot')} failed"])[-1]


def write(runs: Runs, folder: Path) -> Path:
    """Draws every run, compares them, writes plant.html and returns its path."""
    links = ""
    for label, result in zip(runs.labels, runs.results):
        why = draw(result.folder)
        link = result.folder.resolve().relative_to(folder.resolve()) / "report.html"
        links += (f'<li><a href="{escape(str(link))}">{escape(label)}</a></li>\n' if not why else
                  f"<li>{escape(label)}: {escape(why)}</li>\n")
    apart = next((one for one in runs.results if not one.summary.get("contacts")), None)
    content = page.box(runs, f"<p>Reports of the runs, with pictures of the model:</p>\n<ul>\n{links}</ul>\n")
    content += "".join(f"<h2>The answer of {escape(label)}</h2>\n{answer.html(result, apart, '')}"
                       for label, result in zip(runs.labels, runs.results) if result is not apart)
    content += page.body(runs, folder / "comparison") + "<h2>What it cost</h2>\n" + html_table("", COST, cost_rows(runs))
    title = runs.results[0].summary.get("title") or "The plant pair"
    return write_page(folder / "plant.html", title, content)
