"""What rules say that the joints need, from the modes and the response spectra of the motions."""

import hashlib
import json
from pathlib import Path

from pounding import UserError
from pounding.study import run_side_by_side
from pounding.files import write_text
from pounding.results import load
from pounding.runs import Job, clear, environment, words_of

from .design import Design, motion_columns, motion_values
from .study import Study

MOST = 5  # motions of which the mean is taken
MODES = 6  # of each structure
RULES = {"ABS": ("sum", 1.0), "SRSS": ("srss", 1.0), "EN 1998-1, level floors": ("srss", 0.7), "DDC": ("ddc", 1.0),
         "modal": ("modal", 1.0)}


def find(study: Study, design: Design, scene: Path, folder: Path, jobs: int) -> tuple:
    """Contact -> rule -> joint [m] at a peak ground acceleration of 1 m/s2, the mean of some motions, by runs of two
    steps; and a note where there is none."""
    key = hashlib.sha256((str(scene) + str(study.axes)).encode()).hexdigest()[:12]
    kept = folder / f"rules-{key}.json"
    if not kept.is_file():
        names, variables, failures, told = motion_columns(study), environment(), [], []
        shown = sorted(set(design.motions))[:MOST]

        def start(motion: int) -> Job:
            words = words_of(scene.absolute(), {"end_time": "1e-4", "modes": MODES, **dict(zip(names, motion_values(study, motion, 1.0)))})
            return Job(words, (folder / f"rules-{motion}").absolute(), 1, Path.cwd(), variables)

        def ended(_motion: int, job: Job, _waiting: list, _running: list) -> None:
            failure = job.outcome()
            if failure:
                failures.append(failure)
                return
            told.append(load(job.output).summary.get("separations", {}))
            clear(job.output)

        run_side_by_side(shown[:1], 1, start, ended)
        run_side_by_side(shown[1:] if not failures else [], jobs, start, ended)
        if failures:
            return {}, f"no rules for the joint: {failures[0]}"
        found = {contact: {rule: factor * sum(one[contact][key] for one in told) / len(told)
                           for rule, (key, factor) in RULES.items()}
                 for contact in study.joints if all((one.get(contact) or {}).get("srss") for one in told)}
        write_text(kept, json.dumps(found))
    try:
        found = json.loads(kept.read_text())
    except ValueError as error:
        raise UserError(f"{kept} cannot be read ({error}); remove it") from error
    return found, "" if found else "no rules for the joint: the program tells none of this scene"
