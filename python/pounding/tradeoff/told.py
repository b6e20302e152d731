"""Errors of the runs of a scene as its certificate tells them, beside those that finer runs show."""

from math import hypot, log2

from .metrics import log_ratio
from .runs import Outcome

PARTS = ("reduction", "step", "mesh")
SECONDS = 20  # of a run at full order beside whose time a certificate's stands [s]


def distance(found: Outcome, reference: Outcome, names: list) -> float:
    """rms over the spectra of these names, 1-400 Hz."""
    squares = [log_ratio(*reference.spectra[name][:1], found.spectra[name][1], reference.spectra[name][1])["rms"]**2
               for name in names]
    return (sum(squares) / len(squares))**0.5


def limit(runs: list, names: list, order: float = 2) -> float | None:
    """Error of the first of two or three runs, each with steps or elements half as large as those before, by the order that
    three show, from 1 to 2; None where one is missing."""
    if None in runs:
        return None
    if len(runs) > 2:
        change, following = distance(*runs[:2], names), distance(*runs[1:], names)
        order = min(2.0, max(1.0, log2(change / following))) if change and following else 2
    return distance(runs[0], runs[-1], names) / (1 - 2**(-order * (len(runs) - 1)))


class Errors:
    """Told and true errors of the runs of one scene. `outcomes`: those that came to their end, by name; `why`: reason
    why no run can tell its error, or ''."""

    def __init__(self, outcomes: dict, why: str):
        self.full, found = outcomes["full"], outcomes.get
        self.names = self.full.moving()
        self.truth = found("split-2")
        steps = [self.full, found("noise-step"), found("noise-quarter")]
        meshes = [self.full, found("split-1"), self.truth]
        self.true = {"step": limit(steps, self.names), "mesh": limit(meshes, self.names)}
        told = [one.summary["fidelity"] for one in outcomes.values() if "fidelity" in one.summary]
        judged = [one for one in told if "mesh" in one]
        self.why = why or next((one["mesh_not_judged"] for one in told if not judged), "")
        whole = ([] if judged else [found("split-1")]) + ([] if told else [found("noise-step")])
        self.seconds = sum(one.wall_time for one in whole if one)
        # Error and order: of the window, or of whole runs that are finer, which take these seconds.
        self.told = {"step": (told[0]["step"]["rms"]["1-400"], told[0]["step"]["order"]) if told else
                     (limit(steps[:2], self.names), 2),
                     "mesh": (judged[0]["mesh"]["rms"]["1-400"], judged[0]["mesh"]["order"]) if judged else
                     (limit(meshes[:2], self.names), 2)}

    def of(self, setting, found: Outcome) -> dict:
        """Told and true parts of the error of a run, None where nothing is known, and the told ones as a whole: beside full
        order on a mesh split twice where there is that, else that of the reduction, with the others `beside` it."""
        estimate = found.summary.get("fidelity")
        step, order = self.told["step"]
        mesh, fall = self.told["mesh"]
        told = {"reduction": estimate["rms"]["1-400"] if estimate else None if setting.reduces else 0.0,
                "step": estimate["step"]["rms"]["1-400"] if estimate else
                step and step * (found.summary["time_step"] / self.full.summary["time_step"])**order,
                "mesh": mesh and mesh * 2**(-fall * setting.splits)}
        true = {"reduction": distance(found, self.full, self.names) if setting.reduces else 0.0, **self.true}
        joined = told.values() if self.truth else [told["reduction"] or None]
        row = {"estimate": None if None in joined else hypot(*joined),
               "beside": 0.0 if self.truth else hypot(told["step"] or 0, told["mesh"] or 0),
               "certificate": (self.seconds + (estimate["wall_time"] if estimate else 0))
               / (SECONDS * self.full.per_second() + self.full.set_up())}
        for part in PARTS:
            row |= {f"told {part}": told[part], f"true {part}": true[part]}
        return row
