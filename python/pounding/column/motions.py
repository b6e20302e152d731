"""The motions of a column's file as accelerograms: records as the program reads them, synthetic ones as it makes them."""

import tempfile
from pathlib import Path

from pounding.fragility.motions import STEP, Motions
from pounding.fragility.study import Axis
from pounding.motion_signals import WORDS, Signal, read_record

from .column_file import Ground
from .curves import ColumnError

PERIODS = 3.0  # of the column that a motion lasts at least
STEPS = 8.0  # of the motion that a period of the column has at least


def signals_of(ground: Ground) -> dict:
    """(axis, number) -> Signal along x and y, at the peak that the file asks for. Throws UserError."""
    found, axes = {}, {axis: one for axis, one in ground.axes.items() if axis != "z"}
    if not axes:
        raise ColumnError(f"{ground.path}: motions has neither x nor y; shear waves move the ground along these")
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        made = Motions(ground, Path(folder), 1, "")
        for axis, one in axes.items():
            for number, motion in enumerate(one.motions):
                signal = _recorded(one, motion) if one.records else _synthetic(made, axis, motion)
                if not signal.peak > 0:
                    raise ColumnError(f"motion {signal.name}: the ground does not move")
                factor = ground.level * one.ratio_of(number) / signal.peak if ground.level else one.ratio_of(number)
                found[axis, number] = Signal(signal.name, signal.step, factor * signal.values)
                _check(ground, found[axis, number])
    return found


def _recorded(axis: Axis, motion: str) -> Signal:
    options = {key: value for key, value in axis.options if (key, value) not in (("unit", "auto"), ("column", "0"), ("time_step", "0"))}
    if unknown := set(options) - set(WORDS):
        raise ColumnError(f"motions: options: {min(unknown)} is none of {', '.join(WORDS)}")
    return read_record(motion, options)


def _synthetic(made: Motions, axis: str, seed: int) -> Signal:
    made.make([(axis, seed)])
    return Signal(f"{Path(made.study.axes[axis].target).stem}-{seed}", STEP, made.record(axis, seed, 1.0))


def _check(ground: Ground, signal: Signal) -> None:
    period = ground.soil.column.period
    if signal.length < PERIODS * period:
        raise ColumnError(f"motion {signal.name}: {signal.length:.3g} s are too short for a column with a period of {period:.3g} s; give "
                          f"{PERIODS:g} of these or more")
    if signal.step > period / STEPS:
        raise ColumnError(f"motion {signal.name}: a step of {signal.step:g} s is too coarse for layers with a period of {period:.3g} s; "
                          f"give {period / STEPS:.3g} s or less, or leave the layers out")
