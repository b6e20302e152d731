"""Sweeps of what a user may ask for: gaps, shaking, models of one element, ranks, long runs. Each
returns its rows."""

import math

import numpy as np

from . import scenes
from .bench import Bench, Row, checked

GRAVITY = 9.80665
STOREY = 2.5  # of the pair [m]
HISTORIES = ("displacement", "velocity", "acceleration")


def gaps(bench: Bench) -> list:
    """Initial gap of the pair, from an overlap to so wide that nothing ever touches."""
    words = scenes.shaken_pair(bench.folder, 6.0, 0.5)
    alone = bench.run([*words, "-contacts", "none"], 1)
    rows = []
    for gap in bench.choose((-1e-3, 0.0, 1e-6, 1e-3, 0.02, 1.0, 1e6), (-1e-3, 1e-3, 1e6)):
        run = bench.run([*words, "-floor1_gap", repr(gap), "-floor2_gap", repr(gap)], 1)
        row = Row("gaps", f"{1000 * gap:g} mm", "", "", run.end)
        if run.runs:
            impacts, energy = run.summary["impacts"], run.summary["energy"]
            row.seen = f"{impacts['episodes']} impacts, {impacts['total_impulse']:.0f} N s"
        if gap >= 1:
            row.expected = "no impact; the same bits as without contacts"
            row.limit = 0.0
            row.measure = run.difference(alone, *HISTORIES) + impacts["episodes"] if run.runs else math.nan
        else:
            row.expected = "no push-out, no energy gained; at most 0.1 mm more overlap"
            row.limit = 1e-4
            if run.runs:
                gained = math.inf if energy["contact"] > 1e-12 * energy["input"] else 0.0
                row.measure = gained + max(0.0, impacts["max_penetration"] + min(gap, 0.0))
        rows.append(checked(row, run))
    return rows


def shaking(bench: Bench) -> list:
    """Peak ground acceleration, from nothing to far beyond what the hypotheses bear."""
    rows = []
    values = bench.choose((0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0, 1000.0), (0.0, 1.0, 1000.0))
    for peak in values:
        run = bench.run(scenes.shaken_pair(bench.folder, peak * GRAVITY), 1)
        row = Row("shaking", f"{peak:g} g", "finite; energy closes to 1e-9", "", run.end, limit=1e-9)
        if run.runs:
            displacement = abs(run.history["displacement"]).max()
            row.measure = run.residual
            row.seen = f"{displacement:.3g} m, {run.summary['impacts']['episodes']} impacts"
            if peak == 0:
                row.expected, row.limit = "every value exactly 0", 0.0
                row.measure = max(abs(run.history[name]).max() for name in HISTORIES)
            elif displacement > 0.1 * STOREY:
                row.seen += "; displacements no longer small beside the storey"
        rows.append(checked(row, run))
    return rows


def one_element(bench: Bench) -> list:
    """A structure that is one free element, of each kind."""
    names = list(scenes.ELEMENTS)
    run = bench.run(scenes.lone_elements(names), 2)
    rows = []
    for name, exact in scenes.lone_frequencies().items():
        row = Row("one element", scenes.ELEMENTS[name][0], "omega_max of the closed form to 1e-9", "",
                  run.end, limit=1e-9)
        if run.runs:
            omega = run.summary["structures"][name]["omega_max"]
            row.measure = abs(omega / exact - 1)
            row.seen = f"omega_max {omega:.6g} rad/s, {run.summary['steps']} steps"
        rows.append(checked(row, run))
    return rows


def ranks(bench: Bench) -> list:
    """More and more ranks, soon more than there are elements."""
    scene = {"two bricks": scenes.blocks((2.0, 3.0), young=1e6, time_step=1e-4, end_time=0.02),
             "the pair": scenes.shaken_pair(bench.folder, 6.0, 0.5, 0.002, 0.06)}
    rows = []
    for name, words in scene.items():
        alone = bench.run(words, 1)
        for count in bench.choose(range(2, 9), (3, 8)):
            run = bench.run(words, count)
            row = Row("ranks", f"{name} on {count}", "histories of one rank to 1e-9", "", run.end,
                      limit=1e-9)
            if run.runs:
                row.measure = run.difference(alone, *HISTORIES, "gap", "contact_force")
                row.seen = f"{run.summary['impacts']['episodes']} impacts, " \
                           f"{run.summary['partition']['interface_ranks']} ranks hold the contact"
            rows.append(checked(row, run))
    return rows


def long_run(bench: Bench) -> list:
    """The pair shaken, then left to itself for as long as it takes."""
    steps = 1e7 if bench.long else 1e5 if bench.quick else 1e6
    words = scenes.shaken_pair(bench.folder, 6.0, 0.5)
    probe = bench.run([*words, "-end_time", 1e-9], 1)
    end_time = steps * probe.summary["time_step"]
    run = bench.run([*words, "-end_time", repr(end_time), "-output_interval", repr(end_time / 2e4)], 2)
    row = Row("long run", f"{steps:.0e} steps", "energy closes to 1e-9, times are n dt, comes to rest", "",
              run.end, limit=1e-9)
    if run.runs:
        time, dt = run.history["time"], run.summary["time_step"]
        exact = np.array_equal(time, np.rint(time / dt) * dt)
        left = run.summary["energy"]["kinetic"] + run.summary["energy"]["strain"]
        row.measure = run.residual if exact and 0 <= left <= run.summary["energy"]["input"] else math.inf
        row.seen = (f"t = {end_time:.4g} s, {run.summary['impacts']['episodes']} impacts, {left:.2g} J left of "
                    f"{run.summary['energy']['input']:.4g} J, {run.summary['microseconds_per_step']:.0f} us per step")
    return [checked(row, run)]


SWEEPS = {"gaps": gaps, "shaking": shaking, "one_element": one_element, "ranks": ranks, "long_run": long_run}
