"""Runs of the plant pair: without contacts, and with them at each fidelity; the page with the answer of every run, impacts
by floor, spectra beside each other, what it cost."""

import subprocess
import time
from pathlib import Path

from pounding import UserError
from pounding.commands import called, words_of_command
from pounding.compare import page
from pounding.compare.runs import Runs
from pounding.plot import answer
from pounding.plot.markup import html_table, write_page
from pounding.sweep.members import Member
from pounding.tables import markdown
from pounding.runs import SOURCE, ending_with_us, environment, finish, folder_of_programs, program, shipped

SIZES = ("small", "medium", "large")
FIDELITIES = ("full", "modal")
APART = "apart"  # the run without contacts
JOINTS = ("floor1", "floor2")
DEVIATION = 0.005  # by which the joint is narrower at one end [m]
BUILDINGS = ("block", "frame")
RARE_GAPS = "0.01"  # time between two samples of the gaps of a reduced run [s]
COST = ["run", "dofs", "ranks", "steps", "microseconds per step", "wall time [s]", "seconds per second of motion",
        "memory of all ranks [GB]"]


def scene_of(size: str) -> Path:
    """Throws UserError where the scenes are not with the program."""
    name = f"petsc-options/plant/{size}.yaml"
    if scene := shipped(name):
        return scene
    raise UserError(f"{name}: neither in {SOURCE} nor beside the program, {folder_of_programs()}")


def options_of(fidelity: str, modes: int, folder: Path) -> dict:
    """Options of a fidelity; bases are kept in the folder of the run, with what its contacts ask of them."""
    if fidelity == "full":
        return {}
    found = {"gap_interval": RARE_GAPS}  # to look at gaps costs a reduced step more than its coordinates do
    for building in BUILDINGS:
        found |= {f"{building}_model": "modal", f"{building}_modal_vectors": str(modes),
                  f"{building}_modal_basis": str((folder / f"{building}.basis").absolute())}
    return found


def members(fidelities: list, modes: int, seconds: float, gap: float, folder: Path) -> list:
    """The first one has no contacts and the first fidelity; the others have contacts, one fidelity each. Throws
    UserError for a gap below the deviation, and for a fidelity that stands twice."""
    if len(set(fidelities)) < len(fidelities):
        raise UserError("--fidelity: one stands twice")
    if gap < DEVIATION:
        raise UserError(f"--gap {gap:g}: below the joint's deviation of {DEVIATION:g} m, so that it would be closed")

    def member(name: str, fidelity: str, more: dict) -> Member:
        options = {"end_time": f"{seconds:g}", "write_model": "true", **options_of(fidelity, modes, folder / name),
                   **more}
        return Member(name, (name,), tuple(options.items()))

    joints = {f"{joint}_gap": f"{gap:g},{gap - DEVIATION:g}" for joint in JOINTS}
    return [member(APART, fidelities[0], {"contacts": "none"}),
            *(member(fidelity, fidelity, joints) for fidelity in fidelities)]


def run_all(wanted: list, size: str, more: list, ranks: int, folder: Path) -> None:
    """Runs what is not finished, one after another, from the folder of the sources. Throws UserError."""
    forbidden = [word for word in more if word.lstrip("-") in ("output", "dry_run", "restart", "contacts", "structures")]
    if forbidden:
        raise UserError(f"--options: not with {forbidden[0]}, which is the study's own")
    folder.mkdir(parents=True, exist_ok=True)
    scene, variables = scene_of(size), environment()
    for member in wanted:
        run = member.run(scene, more, folder / member.name, scene.parents[2])
        if run.is_finished():
            print(f"  {member.name}: finished before", flush=True)
            continue
        program()
        began = time.monotonic()
        failure = finish(lambda run=run: run.start(ranks, variables)) or run.sign()
        if failure:
            raise UserError(f"run {member.name}: {failure}")
        print(f"  {member.name}: done; {time.monotonic() - began:.0f} s", flush=True)


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
    done = subprocess.run(words_of_command("plot", folder), capture_output=True, text=True, preexec_fn=ending_with_us())
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or [f"{called('run/plot')} failed"])[-1]


def write(runs: Runs, folder: Path) -> Path:
    """Draws every run, compares them, writes plant.html and returns its path."""
    links = [(label, result.folder.resolve().relative_to(folder.resolve()) / "report.html", draw(result.folder))
             for label, result in zip(runs.labels, runs.results)]
    apart = next((one for one in runs.results if not one.summary.get("contacts")), None)
    parts = [(f"The answer of {label}", answer.html(result, apart, ""))
             for label, result in zip(runs.labels, runs.results) if result is not apart]
    parts += [*page.parts(runs, folder / "comparison"), ("What it cost", html_table("", COST, cost_rows(runs)))]
    title = runs.results[0].summary.get("title") or "The plant pair"
    return write_page(folder / "plant.html", title, parts, answer=page.box(runs, links), before=page.notes(runs))
