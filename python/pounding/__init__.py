"""Scenes, runs and results of the program `pounding` from Python: numpy arrays, SI units.

    import pounding
    pounding.run("case.yaml", "results/wide", ranks=2, roof_gap=0.05)
    wide = pounding.load("results/wide")
    frequency, acceleration = wide.spectrum("roof", "x")

python/examples/gaps.py is a whole script. `pip install ./python` of the repository, or put that folder on
PYTHONPATH.
"""

from .ensembles import Ensemble, load_ensemble
from .results import Missing, Modes, Result, ResultError, load, load_modes
from .runs import RunError, program, run
from .scenes import SceneError, flatten, read_scene, write_scene

__all__ = ["Ensemble", "Missing", "Modes", "Result", "ResultError", "RunError", "SceneError", "flatten", "load",
           "load_ensemble", "load_modes", "program", "read_scene", "run", "write_scene"]
