"""The report of a run: the answer first, then what was found, what was computed, and where it all comes from."""

from html import escape
from pathlib import Path

from pounding.results import Missing, Result
from pounding.scenes import SceneError, read_scene
from . import (answer, contact_figures, design_spectra, equipment, floor_figures, force_figures, model_tables, origin_tables,
               result_tables, spectra_figures, view)
from .markup import html_figure, write_page


class _Drawn:
    """Figures as they are asked for; what cannot be drawn is said. `told` hears the name of each before it is drawn."""

    def __init__(self, result: Result, told=lambda name: None):
        self.result, self.count, self.skipped, self.told = result, 0, [], told

    def html(self, *figures, level: int = 3) -> str:
        text = ""
        for figure in figures:
            self.told(figure.__name__)
            try:
                pages = figure(self.result)
            except Missing as reason:
                self.skipped.append(f"{figure.__name__} skipped: {reason}")
                continue
            self.count += len(pages)
            text += "".join(html_figure(self.result.folder, page, level) for page in pages)
        return text


def _part(title: str, content: str) -> str:
    """A part of the report; nothing of no content."""
    return f"<h2>{escape(title)}</h2>\n{content}" if content else ""


def _design_spectra(result: Result) -> str:
    if not result.spectrum_probes:
        return ""
    runs = {"with pounding": result, "without": result.without} if result.without else {"floor": result}
    return design_spectra.write(runs, result.spectrum_probes, sorted(set(result.spectra["damping"])), result.folder)


def _found(result: Result, drawn: _Drawn) -> str:
    twin = result.without
    joints = (result_tables.impact_tables(result) + result_tables.joint_table(result)
              + drawn.html(*contact_figures.JOINT))
    floors = (result_tables.probe_table(result, twin) + drawn.html(*spectra_figures.ALL) + _design_spectra(result)
              + result_tables.drift_table(result) + drawn.html(*floor_figures.ALL))
    items = equipment.table(result, twin) + drawn.html(*equipment.ALL) if equipment.items(result) else ""
    forces = result_tables.force_table(result, twin) + drawn.html(*force_figures.ALL)
    energy = result_tables.energy_table(result) + drawn.html(contact_figures.energy_balance)
    return (_part("Equipment", items) + _part("Yielding", result_tables.yield_table(result)) + _part("The joints", joints)
            + _part("The floors", floors) + _part("Forces and links", forces) + _part("Energy", energy))


def _computed(result: Result, drawn: _Drawn) -> str:
    motion = model_tables.motion_table(result) if result.summary else ""
    motion += drawn.html(floor_figures.ground_motion)
    model = (model_tables.structure_table(result) + model_tables.contact_table(result)
             + model_tables.damping_table(result) + drawn.html(model_tables.damping) + model_tables.material_tables(result)
             + model_tables.region_table(result) + model_tables.mode_tables(result))
    return _part("The motion", motion) + _part("The model", model)


def _view(result: Result, drawn: _Drawn) -> str:
    try:
        return view.html(result)
    except Missing as reason:
        drawn.skipped.append(f"view skipped: {reason}")
        return ""


def stopped(result: Result) -> str:
    """How far a run came that did not reach its end, as far as the folder tells it; nothing of one that did."""
    if result.summary:
        return ""
    try:
        end = float(read_scene(result.folder / "resolved.yaml")["end_time"])
    except (OSError, KeyError, ValueError, SceneError):
        end = None
    if "time" not in result.history or not len(result.history["time"]) or not end:
        return "No summary.json in the result folder."
    last = result.history["time"][-1]
    where = f"at {last:.1f} of {end:g} s: what is shown ends there" if last < 0.999 * end else "after its last step, before its spectra"
    return f"The run stopped {where}."


def write(result: Result, why: str = "", told=lambda name: None) -> tuple:
    """Draws the figures and writes report.html into the result folder; `why` there is no run without pounding beside
    it; `told` hears what is drawn. Returns the number of figures, what was skipped and the path."""
    drawn = _Drawn(result, told)
    content = answer.html(result, result.without, why) + drawn.html(answer.picture)
    content += result_tables.warnings(result)
    if not result.summary:
        content += f'<p class="note">{stopped(result)}</p>\n'
    content += _found(result, drawn) + _computed(result, drawn) + _view(result, drawn)
    origin = model_tables.run_table(result) + origin_tables.tables(result)
    content += _part("Where this report comes from", origin) + origin_tables.options(result)
    path = write_page(result.folder / "report.html", origin_tables.title(result), content, origin_tables.line(result))
    return drawn.count, drawn.skipped, path


def print_pdf(page: Path, browser: str, run) -> Path:
    """Prints a page with a browser of the family of Chromium; `run` starts it (subprocess.run). Throws OSError."""
    path = page.with_suffix(".pdf")
    path.unlink(missing_ok=True)
    words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer", "--virtual-time-budget=10000",
             f"--print-to-pdf={path.resolve()}", page.resolve().as_uri()]
    done = run(words, capture_output=True, text=True, timeout=300)
    if done.returncode != 0 or not path.exists():
        reason = (done.stderr.strip().splitlines() or ["it left no file"])[-1]
        raise OSError(f"{browser} does not print {page}: {reason}")
    return path
