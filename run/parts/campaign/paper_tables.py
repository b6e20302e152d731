"""Table 1 and the time steps of the paper beside ours, from a few steps of Models A and B."""

import json
import subprocess
from pathlib import Path

from pounding import UserError
from pounding.runs import ending_with_us

from . import paper

SOURCE = Path(__file__).resolve().parents[3]
FILES = {"A": "pair", "B": "pair-b"}


class TableError(UserError):
    """One line for the user, or what the program said."""


def run_model(model: str, folder: Path, ranks: int, more: list) -> dict:
    """A few steps, with more options; returns the summary."""
    command = 'source run/environment; [ -x "$build/pounding" ] || run/setup >&2; ' \
              'exec mpirun -n "$2" "$build/pounding" -options_file "$0" -end_time 2e-5 "${@:3}" -output "$1"'
    file = f"petsc-options/azalee/{FILES[model]}.yaml"
    words = [file, str(folder), str(ranks), *more]
    result = subprocess.run(["bash", "-c", command, *words], cwd=SOURCE, stdout=subprocess.PIPE, text=True,
                            preexec_fn=ending_with_us())
    if result.returncode != 0:
        raise TableError(f"{file} failed, see above\n{result.stdout}")
    return json.loads((folder / "summary.json").read_text())


def run_models(folder: Path, ranks: int = 2, more=()) -> dict:
    """Model -> summary."""
    return {model: run_model(model, folder_of(folder, model), ranks, list(more)) for model in FILES}


def folder_of(folder: Path, model: str) -> Path:
    return folder / f"model-{model.lower()}"


def six_frequencies(structure: dict) -> list[float]:
    """X, Y: the first two modes with over 1 % of the mass in that direction; rotation: the first two
    that turn about z."""
    modes = structure["frequencies"]
    found = []
    for kept in (lambda m: m["effective_modal_mass"][0] > 0.01 * structure["mass"],
                 lambda m: m["effective_modal_mass"][1] > 0.01 * structure["mass"], lambda m: m["direction"] == "rz"):
        pair = [mode["frequency"] for mode in modes if kept(mode)][:2]
        if len(pair) < 2:
            raise TableError("fewer than two modes in a direction among those computed; raise -modes")
        found += pair
    return found


def frequency_table(summaries: dict) -> tuple[str, list[str], list[list[str]]]:
    head = ["structure", "mode", "measured", "paper A", "paper B", "ours A", "%", "ours B", "%"]
    rows = []
    for number, (name, measured) in enumerate(paper.MEASURED_FREQUENCIES.items(), start=1):
        ours = {model: six_frequencies(summaries[model]["structures"][name]) for model in FILES}
        for i, mode in enumerate(paper.MODES):
            row = [str(number), mode, f"{measured[i]:.1f}"]
            row += [f"{paper.FREQUENCIES[model][name][i]:.1f}" for model in FILES]
            for model in FILES:
                value = ours[model][i]
                row += [f"{value:.2f}", f"{100 * (value / measured[i] - 1):+.1f}"]
            rows.append(row)
    return "Frequencies [Hz]; % is the difference from the measured ones", head, rows


def time_step_table(summaries: dict) -> tuple[str, list[str], list[list[str]]]:
    head = ["model", "whose", "dofs", "omega_max [rad/s]", "2 / omega_max [s]", "stable time step [s]"]
    rows = []
    for model, (dofs, omega, step) in paper.TIME_STEPS.items():
        rows.append([model, "paper", str(dofs), f"{omega:.2e}", f"{2 / omega:.2e}", f"{step:.2e}"])
        for name, structure in summaries[model]["structures"].items():
            rows.append([model, f"ours, structure {name[1:]}", str(structure["dofs"]), f"{structure['omega_max']:.3e}",
                         f"{structure['stable_time_step_undamped']:.3e}", f"{structure['stable_time_step']:.3e}"])
    return "Stable time step (Eq. 12); the smaller of the two structures governs", head, rows
