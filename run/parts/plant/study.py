"""Runs of the plant pair: without contacts, and with them at each fidelity."""

import time
from pathlib import Path

from parts.sweep.members import Member
from pounding.runs import SOURCE, environment, finish, program

SIZES = ("small", "medium", "large")
FIDELITIES = ("full", "modal")
APART = "apart"  # the run without contacts
JOINTS = ("floor1", "floor2")
DEVIATION = 0.005  # by which the joint is narrower at one end [m]
BUILDINGS = ("block", "frame")
RARE_GAPS = "0.01"  # time between two samples of the gaps of a reduced run [s]


class StudyError(Exception):
    """One line for the user."""


def scene_of(size: str) -> Path:
    return SOURCE / "petsc-options" / "plant" / f"{size}.yaml"


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
    StudyError for a gap below the deviation, and for a fidelity that stands twice."""
    if len(set(fidelities)) < len(fidelities):
        raise StudyError("--fidelity: one stands twice")
    if gap < DEVIATION:
        raise StudyError(f"--gap {gap:g}: below the joint's deviation of {DEVIATION:g} m, so that it would be closed")

    def member(name: str, fidelity: str, more: dict) -> Member:
        options = {"end_time": f"{seconds:g}", "write_model": "true", **options_of(fidelity, modes, folder / name),
                   **more}
        return Member(name, (name,), tuple(options.items()))

    joints = {f"{joint}_gap": f"{gap:g},{gap - DEVIATION:g}" for joint in JOINTS}
    return [member(APART, fidelities[0], {"contacts": "none"}),
            *(member(fidelity, fidelity, joints) for fidelity in fidelities)]


def run_all(wanted: list, size: str, more: list, ranks: int, folder: Path) -> None:
    """Runs what is not finished, one after another, from the folder of the sources. Throws StudyError."""
    forbidden = [word for word in more if word.lstrip("-") in ("output", "dry_run", "restart", "contacts", "structures")]
    if forbidden:
        raise StudyError(f"--options: not with {forbidden[0]}, which is the study's own")
    folder.mkdir(parents=True, exist_ok=True)
    scene, variables = scene_of(size), environment()
    for member in wanted:
        run = member.run(scene, more, folder / member.name, SOURCE)
        if run.is_finished():
            print(f"  {member.name}: finished before", flush=True)
            continue
        program()
        began = time.monotonic()
        failure = finish(lambda run=run: run.start(ranks, variables)) or run.sign()
        if failure:
            raise StudyError(f"run {member.name}: {failure}")
        print(f"  {member.name}: done; {time.monotonic() - began:.0f} s", flush=True)
