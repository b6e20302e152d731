"""Sweeps of what the scheme must bear: time step, damping, ratios of masses and stiffnesses, thin
elements. Each returns its rows."""

import math

import numpy as np

from . import scenes
from .bench import REFUSED, STOPPED, Bench, Row, checked


def time_step(bench: Bench) -> list:
    """Fractions of the stable time step; above it the run must stop by itself."""
    words = scenes.shaken_pair(bench.folder, 6.0, 0.5)
    stable = bench.run([*words, "-end_time", 1e-9], 1).summary["stable_time_step"]
    rows, reference = [], None
    for fraction in bench.choose((0.5, 0.8, 0.9, 0.99, 0.999, 1.0, 1.001, 1.003, 1.01), (0.5, 0.999, 1.01)):
        run = bench.run([*words, "-time_step", repr(fraction * stable), "-allow_unstable", "true"], 1)
        row = Row("time step", f"{fraction:g} of the stable one", "", "", run.end)
        rows.append(row)
        if fraction > 1:
            row.expected = "stops with a line that says where it diverged"
            row.seen = f"{run.end}: {run.message}" if run.message else run.end
            row.good = run.end == STOPPED and "diverged" in run.message
            continue
        row.expected = "stable; largest displacement within 2 % of that of half the step"
        if run.runs:
            peak = abs(run.history["displacement"]).max()
            reference = reference or peak
            row.measure, row.limit = abs(peak / reference - 1), 0.02
            row.seen = f"{1000 * peak:.2f} mm, {run.summary['impacts']['episodes']} impacts"
        checked(row, run)
    run = bench.run([*words, "-time_step", repr(1.01 * stable)], 1)
    rows.append(Row("time step", "1.01, not asked for", "refused before it starts",
                    f"{run.end}: {run.message}", run.end, good=run.end == REFUSED and "-time_step" in run.message))
    return rows


def damping(bench: Bench) -> list:
    """Stiffness damping of the pair, from none to a hundredfold."""
    words = scenes.shaken_pair(bench.folder, 6.0, 0.5)
    rows = []
    for factor in bench.choose((0.0, 0.01, 0.1, 1.0, 10.0, 100.0), (0.0, 10.0)):
        betas = {"s1": factor * 1.2557e-5, "s2": factor * 1.2426e-5}
        run = bench.run([*words, *(word for name, beta in betas.items()
                                   for word in (f"-{name}_damping_beta", repr(beta)))], 1)
        row = Row("damping", f"beta x {factor:g}", "stable step of Eq. 12; energy closes to 1e-9",
                  "", run.end, limit=1e-9)
        if run.runs:
            row.measure = max(run.residual, abs(run.summary["stable_time_step"] / eq12(run, betas) - 1))
            row.seen = (f"step {run.summary['stable_time_step']:.3g} s, "
                        f"{run.summary['impacts']['episodes']} impacts, "
                        f"peak {abs(run.history['acceleration']).max():.0f} m/s2")
        rows.append(checked(row, run))
    return rows


def eq12(run, betas: dict) -> float:
    """The smallest stable step of the structures, from their omega_max: 2 / (omega (sqrt(1 + xi^2) + xi))."""
    steps = []
    for name, structure in run.summary["structures"].items():
        omega = structure["omega_max"]
        ratio = structure["damping"]["alpha"] / (2 * omega) + betas[name] * omega / 2
        steps.append(2 / (omega * (math.sqrt(1 + ratio**2) + ratio)))
    return min(steps)


def mass_ratio(bench: Bench) -> list:
    """A mass of 1 kg at 1 m/s hits another at rest: v+ = m1 v / (m1 + m2), impulse m1 m2 v / (m1 + m2)."""
    rows = []
    exponents = range(-8, 9, 2)
    for ratio in bench.choose([10.0**e for e in exponents], [1e-8, 1.0, 1e8]):
        run = bench.run(scenes.blocks((2.0, 2.0 * ratio), young=1e-30, end_time=0.003), 1)
        row = Row("mass ratio", f"1 kg on {ratio:g} kg", "plastic impact to 1e-12", "", run.end,
                  limit=1e-12)
        if run.runs:
            reduced = ratio / (1 + ratio)
            impulse = run.summary["impacts"]["total_impulse"]
            one, two = run.history["velocity"][-1, [0, 3]]
            row.measure = max(abs(impulse / reduced - 1), abs(one + ratio * two - 1),
                              abs(one - 1 / (1 + ratio)), abs(two * (1 + ratio) - 1))
            row.seen = f"impulse {impulse:.9g} N s, velocities {one:.6g} and {two:.6g} m/s"
        rows.append(checked(row, run))
    return rows


def stiffness_ratio(bench: Bench) -> list:
    """Two masses on springs in a row, the second spring stiffer and stiffer."""
    rows, speed = [], 0.5
    for ratio in bench.choose([10.0**e for e in range(0, 11, 2)], [1.0, 1e10]):
        dt = min(0.9 * math.sqrt(2 / ratio), 1e-2)
        run = bench.run(["-structures", "mass", *scenes.two_masses("mass", 1.0, ratio, speed),
                         "-time_step", repr(dt), "-end_time", 1, "-output_interval", 1e-3, "-modes", 0,
                         "-spectra_frequencies", 10, "-probes", "first", "-first_structure", "mass",
                         "-first_at", "1,0,0"], 1)
        row = Row("stiffness ratio", f"1 and {ratio:g} N/m", "history of the two modes to 1e-8", "",
                  run.end, limit=1e-8)
        if run.runs:
            exact = scenes.two_masses_history(ratio, speed, dt, np.rint(run.history["time"] / dt))
            row.measure = abs(run.history["displacement"][:, 0] - exact).max() / abs(exact).max()
            row.seen = f"{run.summary['steps']} steps, energy identity to {run.residual:.1e}"
        rows.append(checked(row, run))
    return rows


def slivers(bench: Bench) -> list:
    """One thin layer in a column of 0.1 m cubes thrown at a wall: the impulse is nearly 2 m v."""
    rows = []
    for ratio in bench.choose((1.0, 10.0, 100.0, 1e3, 1e4), (1.0, 1e4)):
        thickness = 0.1 / ratio
        run = bench.run(scenes.column(thickness), 1)
        row = Row("sliver elements", f"layer of {1000 * thickness:g} mm",
                  "impulse within 5 % of 2 m v; the step shrinks with the root of the layer", "", run.end,
                  limit=0.05)
        if run.runs:
            mass = run.summary["structures"]["column"]["mass"]
            impulse = run.summary["impacts"]["total_impulse"]
            row.measure = abs(impulse / (2 * mass) - 1)
            row.seen = f"step {run.summary['stable_time_step']:.3g} s, impulse {impulse / (2 * mass):.3f} x 2 m v"
        rows.append(checked(row, run))
    return rows


SWEEPS = {"time_step": time_step, "damping": damping, "mass_ratio": mass_ratio,
          "stiffness_ratio": stiffness_ratio, "slivers": slivers}
