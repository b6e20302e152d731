"""Sweeps of what joins masses beside linear elements: tension-only bars that switch, dashpots and
damping, which may take energy and never give any. Each returns its rows."""

import math

import numpy as np

from . import scenes
from .bench import Bench, Row, checked

BAR = 2 * (2e9 * 1e-4 / 5) * 0.8**2  # stiffness of the pair of bars on one side [N/m]
MASS, SPEED = 100.0, 1.0


def hung_mass(ratio: float, beta: float, courant: float) -> list:
    """A mass on a grounded spring 1 / ratio times as stiff as the tension-only bars on its left."""
    spring = repr(BAR / ratio)
    period = 2 * math.pi * math.sqrt(MASS * ratio / BAR / (1 + ratio))
    return ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo", "-frame_clamp", "anchors",
            "-frame_ignore", "right", "-frame_initial_velocity", f"{SPEED},0,0", "-frame_damping_beta",
            repr(beta * period), *scenes.material("steel", 2e9, 0.3, 1e-9), "-courant", courant,
            "-end_time", repr(300 * period), "-output_interval", repr(period), "-energy_interval", 1,
            "-frame_mass_element", "point_mass", "-frame_mass_mass", MASS,
            "-frame_left_element", "bar", "-frame_left_material", "steel", "-frame_left_area", 1e-4,
            "-frame_left_tension_only", "true", "-frame_support_element", "grounded_spring",
            "-frame_support_stiffness", f"{spring},{spring},{spring}", *scenes.cheap("frame:mass")]


def most_gained(run) -> float:
    """Largest rise of the energy from one line of the ledger to the next, over the first."""
    energy = run.ledger["kinetic"] + run.ledger["strain"]
    return max(0.0, np.diff(energy).max()) / energy[0]


def switching_bars(bench: Bench) -> list:
    """A mass between a spring and bars that pull only: the limit of the taut bars is no limit of the
    switching ones where their tension is frozen."""
    rows = []
    for ratio in bench.choose((0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 10.0, 100.0), (0.2, 10.0)):
        for courant in bench.choose((0.4, 0.6, 0.9, 0.99), (0.4, 0.9)):
            for beta in (0.0, 1e-3):
                run = bench.run(hung_mass(ratio, beta, courant), 1)
                row = Row("switching bars", f"k_bar / k_spring {ratio:g}, {courant:g} of the step, beta {beta:g} T",
                          "energy never rises by 1e-9 of itself", "", run.end, limit=1e-9)
                if run.runs:
                    row.measure = max(most_gained(run), run.residual)
                    row.seen = f"{run.summary['steps']} steps, energy at the end " \
                               f"{(run.ledger['kinetic'] + run.ledger['strain'])[-1]:.4g} J of 50"
                rows.append(checked(row, run))
    return rows


DEVICES = {
    "grounded dashpot": ["-chain_support_dashpot", "{rate},0,0"],
    "dashpot between nodes": ["-chain_link2_dashpot", "{rate},0,0"],
    "damping of a region": ["-chain_link2_damping_beta", "{beta}"],
    "alpha": ["-chain_damping_alpha", "{alpha}"],
    "beta": ["-chain_damping_beta", "{beta}"],
}


def passive_devices(bench: Bench) -> list:
    """Two masses on springs, thrown, with one thing at a time that takes energy."""
    rows = []
    for name, words in DEVICES.items():
        for ratio in bench.choose((0.01, 1.0, 30.0), (1.0,)):
            values = {"rate": repr(2 * ratio), "alpha": repr(2 * ratio), "beta": repr(2 * ratio)}
            run = bench.run(["-structures", "chain", *scenes.two_masses("chain", 1.0, 1.0, 0.5),
                             "-end_time", 30, "-output_interval", 0.1, "-energy_interval", 1,
                             *(word.format(**values) for word in words), *scenes.cheap("chain:first")], 1)
            row = Row("passive devices", f"{name}, {ratio:g} of critical",
                      "takes energy at every step, to 1e-12 of the first", "", run.end, limit=1e-12)
            if run.runs:
                taken = run.ledger["damping_loss"] + run.ledger["device_work"] + run.ledger["plastic_loss"]
                first = run.ledger["kinetic"][0] + run.ledger["strain"][0]
                row.measure = max(max(0.0, -np.diff(taken).min()) / first, run.residual)
                row.seen = f"{100 * taken[-1] / first:.3g} % taken"
            rows.append(checked(row, run))
    return rows


SWEEPS = {"switching_bars": switching_bars, "passive_devices": passive_devices}
