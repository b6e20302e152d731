"""The motions of a column's file as accelerograms: records as the program reads them, synthetic ones as it makes them."""

import tempfile
from pathlib import Path

import numpy as np

from pounding.files import write_text
from pounding.fragility.motions import POINT, SCENE, options_of
from pounding.fragility.study import Axis
from pounding.motion_signals import Signal, read_signals
from pounding.runs import run
from pounding.scenes import write_scene

from .column_file import Ground
from .curves import ColumnError

WORDS = {"unit": "--unit", "column": "--columns", "time_step": "--time-step"}  # of pounding-spectra
PERIODS = 3.0  # of the column that a motion lasts at least
STEPS = 8.0  # of the motion that a period of the column has at least


def signals_of(ground: Ground) -> dict:
    """(axis, number) -> Signal along x and y, at the peak that the file asks for. Throws UserError."""
    found = {}
    for axis, one in ground.axes.items():
        if axis == "z":
            continue
        for number, motion in enumerate(one.motions):
            signal = _recorded(one, motion) if one.records else _synthetic(one, motion)
            if not signal.peak > 0:
                raise ColumnError(f"motion {signal.name}: the ground does not move")
            factor = ground.level * one.ratio_of(number) / signal.peak if ground.level else one.ratio_of(number)
            found[axis, number] = Signal(signal.name, signal.step, factor * signal.values)
            _check(ground, found[axis, number])
    if not found:
        raise ColumnError(f"{ground.path}: motions has neither x nor y; shear waves move the ground along these")
    return found


def _recorded(axis: Axis, motion: str) -> Signal:
    options = {key: value for key, value in axis.options if (key, value) not in (("unit", "auto"), ("column", "0"), ("time_step", "0"))}
    if unknown := set(options) - set(WORDS):
        raise ColumnError(f"motions: options: {min(unknown)} is none of {', '.join(WORDS)}")
    return read_signals([word for key, value in options.items() for word in (WORDS[key], value)] + [motion])[0]


def _synthetic(axis: Axis, seed: int) -> Signal:
    options = options_of(axis, seed, True)
    with tempfile.TemporaryDirectory(prefix="pounding-") as place:
        folder = Path(place)
        write_text(folder / "point.geo", POINT)
        scene = write_scene(folder / "scene.yaml", {**SCENE, "end_time": float(options["duration"]), "motion": {"x": options}})
        values = np.array(run(scene, folder / "run").history["ground_acceleration"][:, 0])
    values[0] *= 2  # the program's first step is half a one
    return Signal(f"{Path(axis.target).stem}-{seed}", SCENE["time_step"], np.trim_zeros(values, "b"))


def _check(ground: Ground, signal: Signal) -> None:
    period = ground.soil.column.period
    if signal.length < PERIODS * period:
        raise ColumnError(f"motion {signal.name}: {signal.length:.3g} s are too short for a column with a period of {period:.3g} s; give "
                          f"{PERIODS:g} of these or more")
    if signal.step > period / STEPS:
        raise ColumnError(f"motion {signal.name}: a step of {signal.step:g} s is too coarse for layers with a period of {period:.3g} s; "
                          f"give {period / STEPS:.3g} s or less, or leave the layers out")
