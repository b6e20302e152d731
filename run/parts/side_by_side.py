"""Several runs at a time."""

import time
from typing import Callable

from pounding.runs import interrupts_held


def run_side_by_side(waiting: list, jobs: int, start: Callable, ended: Callable, look: Callable | None = None) -> None:
    """Starts what waits, `jobs` at a time: `start(item)` gives a pounding.runs.Job. Calls `ended(item, job, waiting,
    running)` for each that ended, and `look(waiting, running)` ten times a second; `running` holds jobs. Stops what
    it started if it is interrupted."""
    waiting, running, item_of = list(waiting), [], {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                item = waiting.pop(0)
                with interrupts_held():
                    job = start(item)
                    running.append(job)
                    item_of[job] = item
            if look:
                look(waiting, running)
            time.sleep(0.1)
            for job in [job for job in running if not job.running]:
                running.remove(job)
                ended(item_of[job], job, waiting, running)
    finally:
        for job in running:
            job.stop()
