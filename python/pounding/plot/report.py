"""The report of a run: the answer first, then what was found, what was computed, and where it all comes from."""

import shutil
import subprocess
from pathlib import Path

from pounding.results import Missing, Result
from pounding.scenes import SceneError, read_scene
from . import (answer, contact_figures, design_spectra, equipment, floor_figures, force_figures, model_tables, origin_tables,
               result_tables, spectra_figures, view)
from .markup import html_figures, html_view, paragraphs, write_page

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


class _Drawn:
    """Figures as they are asked for; what cannot be drawn is said. `told` hears the name of each before it is drawn."""

    def __init__(self, result: Result, told=lambda name: None):
        self.result, self.count, self.skipped, self.told = result, 0, [], told

    def html(self, *figures) -> str:
        drawn = []
        for figure in figures:
            self.told(figure.__name__)
            try:
                drawn += figure(self.result)
            except Missing as reason:
                self.skipped.append(f"{figure.__name__} skipped: {reason}")
        self.count += len(drawn)
        return html_figures(self.result.folder, drawn, 3)

    def view(self) -> str:
        try:
            return html_view(*view.texts(self.result))
        except Missing as reason:
            self.skipped.append(f"view skipped: {reason}")
            return ""


def _design_spectra(result: Result) -> str:
    if not result.spectrum_probes:
        return ""
    runs = {"with pounding": result, "without": result.without} if result.without else {"floor": result}
    return design_spectra.write(runs, result.spectrum_probes, sorted(set(result.spectra["damping"])), result.folder)


def _parts(result: Result, drawn: _Drawn) -> list:
    """Titles and contents: what was found, what was computed, and where it all comes from."""
    twin, found, model, draw = result.without, result_tables, model_tables, drawn.html
    return [
        ("Equipment", equipment.table(result, twin) + draw(*equipment.ALL) if equipment.items(result) else ""),
        ("Yielding", found.yield_table(result)),
        ("The joints", found.impact_tables(result) + found.joint_table(result) + found.span_table(result) + draw(*contact_figures.JOINT)),
        ("The floors", found.probe_table(result, twin) + draw(*spectra_figures.ALL) + _design_spectra(result)
         + found.drift_table(result) + draw(*floor_figures.ALL)),
        ("Forces and links", found.force_table(result, twin) + draw(*force_figures.ALL)),
        ("Energy", found.energy_table(result) + draw(contact_figures.energy_balance)),
        ("The motion", (model.motion_table(result) if result.summary else "") + draw(floor_figures.ground_motion)),
        ("The model", model.structure_table(result) + model.contact_table(result) + model.damping_table(result)
         + draw(model.damping) + model.material_tables(result) + model.region_table(result) + model.mode_tables(result)),
        ("The model and its motion", drawn.view()),
        ("Where this report comes from", model.run_table(result) + origin_tables.tables(result) + origin_tables.options(result))]


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
    box, picture, parts = answer.html(result, result.without, why), drawn.html(answer.picture), _parts(result, drawn)
    before = picture + result_tables.warnings(result) + paragraphs(filter(None, [stopped(result)]), kind="note")
    path = write_page(result.folder / "report.html", origin_tables.title(result), parts, answer=box, before=before,
                      under=origin_tables.line(result))
    return drawn.count, drawn.skipped, path


def require_browser(option: str) -> str:
    """A browser that prints pages. Throws OSError."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not browser:
        raise OSError(f"{option}: none of {', '.join(BROWSERS)} is there; print the page from any browser instead")
    return browser


def print_pdf(page: Path, browser: str, run) -> Path:
    """Prints a page with a browser of the family of Chromium; `run` starts it (subprocess.run). Throws OSError."""
    path = page.with_suffix(".pdf")
    path.unlink(missing_ok=True)
    words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer", "--virtual-time-budget=10000",
             f"--print-to-pdf={path.resolve()}", page.resolve().as_uri()]
    try:
        done = run(words, capture_output=True, text=True, timeout=300)
    except subprocess.TimeoutExpired as error:
        raise OSError(str(error)) from error
    if done.returncode != 0 or not path.exists():
        reason = (done.stderr.strip().splitlines() or ["it left no file"])[-1]
        raise OSError(f"{browser} does not print {page}: {reason}")
    return path
