"""The run without pounding beside which a run is set: found, and looked at whether it is the same model."""

import shlex
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.compare.tables import same
from pounding.results import Result, ResultError, load
from pounding.runs import folder_of_programs

SUFFIX = "-without"  # of the folder beside that of the run
APART = "apart"      # the run without contacts of run/plant, beside its others

# Options in which the two may differ: what is written where, how far the start-up goes, and what is recorded.
FREE = {"contacts", "output", "title", "restart", "write_modes", "write_model", "fields_interval", "fields_start",
        "fields_end", "fields_format", "checkpoint_interval", "checkpoint_steps", "csv_digits", "partition", "mesh_pieces",
        "write_mesh_pieces", "modes", "modes_solver", "loops", "loops_at", "export_matrices", "progress_interval",
        "mesh_time_limit", "gap_interval", "energy_interval", "impact_merge_time", "force_window", "gap_tolerance",
        "time_step", "courant", "omega_max_tolerance", "allow_unstable", "stiffness", "dry_run", "vector_unit"}
READ = ("_mesh", "_record", "_target", "_matrices", "_table", "_initial_state")  # endings of options whose files decide the model


class NoTwin(UserError):
    """Two runs that are not the same model with and without pounding: one line for the user."""


def _contacts(options: dict) -> list:
    return [name for name in options.get("contacts", "none").split(",") if name != "none"]


def _differing(run: dict, twin: dict) -> list:
    """Names of the options by which the two are unlike models."""
    contacts = {*_contacts(run), *_contacts(twin)}

    def free(name: str) -> bool:
        return (name in FREE or name.endswith("_modal_basis") or any(name.startswith(f"{one}_") for one in contacts)
                or name.endswith(READ))  # files count by their contents
    return [name for name in dict.fromkeys([*run, *twin]) if not free(name) and not same(run.get(name), twin.get(name))]


def _hashes(summary: dict) -> dict:
    """Option -> hashes of its files, and "included" -> those of what geometries include."""
    found = {}
    for one in summary.get("inputs", []):
        if one["option"].endswith(READ) or one["option"] == "included":
            found.setdefault(one["option"], []).append(one["sha256"])
    return found


def check(run: Result, twin: Result) -> None:
    """Throws NoTwin unless `twin` is the model of `run` without pounding: the same structures, motion, time step and
    duration, the same oscillators, and no impact."""
    ours, theirs, folder = run.summary, twin.summary, twin.folder
    if not theirs:
        raise NoTwin(f"{folder} has no summary.json: that run did not reach its end")
    impacts = theirs.get("impacts", {}).get("episodes", 0)
    if impacts:
        raise NoTwin(f"{folder} is no run without pounding: its buildings touched {impacts} times")
    if list(ours.get("structures", {})) != list(theirs.get("structures", {})):
        raise NoTwin(f"{folder} is another model: its structures are {', '.join(theirs.get('structures', {})) or 'none'}")
    if "inputs" in ours and "inputs" in theirs:
        before, after = _hashes(theirs), _hashes(ours)
        for option in dict.fromkeys([*after, *before]):
            if before.get(option) != after.get(option):
                what = "a file that geometries include" if option == "included" else f"the file of {option}"
                raise NoTwin(f"{folder} is another model: {what} has other contents")
    differing = _differing(ours.get("options", {}), theirs.get("options", {}))
    if differing:
        name = differing[0]
        raise NoTwin(f"{folder} is another model: option {name} is {theirs['options'].get(name, 'not there')}, in "
                     f"{run.folder} {ours['options'].get(name, 'not there')}")
    for key, what in (("time_step", "time step"), ("end_time", "end time")):
        if not np.isclose(ours.get(key, 0), theirs.get(key, 0), rtol=1e-9, atol=0):
            raise NoTwin(f"{folder} has another {what}: {theirs.get(key)} s, {run.folder} {ours.get(key)} s")
    if run.spectra and twin.spectra:
        for key in ("frequency", "damping"):
            if not np.array_equal(np.unique(run.spectra[key]), np.unique(twin.spectra[key])):
                raise NoTwin(f"{folder} has spectra at other values of {key}")


def find(run: Result, given: Path | None) -> tuple:
    """The run without pounding and a line that says why there is none: (Result, "") or (None, why). A folder that is
    given must be one, or NoTwin or ResultError is thrown; else one beside that of the run is taken if it is."""
    if given:
        if given.resolve() == run.folder.resolve():
            raise NoTwin(f"{given} is the run itself")
        twin = load(given)
        check(run, twin)
        return twin, ""
    if not _contacts(run.summary.get("options", {})):
        return None, ""
    place = run.folder.resolve()
    why = ""
    for folder in (place.with_name(place.name + SUFFIX), place.with_name(APART)):
        if folder == place or not folder.is_dir():
            continue
        try:
            twin = load(folder)
            check(run, twin)
            return twin, ""
        except (NoTwin, ResultError) as reason:
            why = why or str(reason)
    return None, why


def command(run: Result) -> str:
    """The command that makes the run without pounding where `find` looks for it."""
    summary, place = run.summary, run.folder.resolve()
    options = summary.get("options", {})
    words = ["mpirun", "-n", str(summary.get("ranks", 1)), str(folder_of_programs() / "pounding"), "-options_file", str(place / "resolved.yaml"),
             "-contacts", "none", "-time_step", repr(summary.get('time_step', 0)), "-restart", "none",
             "-output", str(place.with_name(place.name + SUFFIX))]
    for name, value in options.items():
        if name.endswith("_modal_basis") and value != "none":
            words += [f"-{name}", "none"]
    if options.get("loops", "none") != "none":
        words += ["-loops", "none"]
    line = shlex.join(words)
    folder = summary.get("machine", {}).get("folder")
    return f"cd {shlex.quote(folder)} && {line}" if folder else line
