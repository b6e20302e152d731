"""Scenes, runs and results of the program `pounding` from Python: numpy arrays, SI units.

    import pounding
    pounding.run("case.yaml", "results/wide", ranks=2, roof_gap=0.05)
    wide = pounding.load("results/wide")
    frequency, acceleration = wide.spectrum("roof", "x")

python/examples/gaps.py is a whole script. `pip install ./python` of the repository, or put that folder on
PYTHONPATH.
"""

from importlib import import_module

_PLACES = {"Ensemble": "ensembles", "Missing": "results", "Modes": "results", "Result": "results", "ResultError": "results",
           "RunError": "runs", "SceneError": "scenes", "flatten": "scenes", "load": "results", "load_ensemble": "ensembles",
           "load_modes": "results", "program": "runs", "read_scene": "scenes", "run": "runs", "write_scene": "scenes"}
__all__ = ["UserError", *_PLACES]


class UserError(Exception):
    """A mistake, or a lack in files, that is one line for the user."""


def __getattr__(name: str):
    """A name of the package, or a module of these, when it is first asked for: commands that need no arrays start at once."""
    if name in _PLACES.values():
        return import_module(f"{__name__}.{name}")
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
