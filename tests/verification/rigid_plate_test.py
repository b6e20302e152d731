"""A plate that does not vibrate is stopped at one point, off its centre: it slows down and spins.

Rigid plate of mass m and sides a x b at speed v; a plastic stop without friction at the eccentricity
e takes the impulse J = m v / (1 + m e^2 / I), I = m (a^2 + b^2) / 12; then v' = v - J/m and the spin
is J e / I; the energy J v / 2 is lost.

The plate of the program is elastic, with stiffness-proportional damping so strong that it hardly
springs back: of the velocity of approach 1/(beta omega)^2 is left, omega being its lowest frequency
in its plane. Lumped masses have m [a^2 (1 + 2/nx^2) + b^2 (1 + 2/ny^2)] / 12 about the centre; a
is made shorter so that this is the I above.
"""
import math
import unittest

import numpy

from recorded import Recorded, all_nodes, lumped_fractions

YOUNG = 30e9
OVERDAMPING = 300  # beta times the frequency (E / density)^(1/2) / b

# mass [kg], sides [m], speed [m/s], cells; eccentricity [m]: impulse [N s], speed [m/s] and spin
# [rad/s] after, energy lost [J]
PLATES = [
    (7000.0, 2.0, 2.5, 0.5, (8, 10), {
        0.0: (3500, 0, 0, 875), 0.25: (3261.363636, 0.0340909091, 0.136363636, 815.340909),
        0.5: (2707.54717, 0.113207547, 0.226415094, 676.886792),
        1.0: (1612.359551, 0.269662921, 0.269662921, 403.089888),
        1.25: (1237.068966, 0.323275862, 0.25862069, 309.267241)}),
    (1.0, 1.0, 1.0, 1.0, (4, 8), {
        0.0: (1, 0, 0, 0.5), 0.25: (0.7272727273, 0.272727273, 1.09090909, 0.363636364),
        0.5: (0.4, 0.6, 1.2, 0.2)}),
]


def length_of_equal_inertia(a, b, cells):
    """Side along x that gives the lumped masses the inertia of the solid plate."""
    nx, ny = cells
    return math.sqrt((a**2 + b**2 - b**2 * (1 + 2 / ny**2)) / (1 + 2 / nx**2))


def scene(plate, eccentricity):
    mass, a, b, speed, cells, _ = plate
    length, thickness = length_of_equal_inertia(a, b, cells), b / 5
    density = mass / (length * b * thickness)
    sound = math.sqrt(YOUNG / density)
    beta = OVERDAMPING * b / sound
    duration = 40 * b / sound / OVERDAMPING  # of the slowest relaxation, 40 times
    # Of the struck face of one cell, only the edge at the eccentricity can reach the wall.
    row = round((eccentricity / b + 0.5) * cells[1])
    near = repr(1e-2 * speed * duration)
    gap = f"{near},1"
    if row == cells[1]:
        row, gap = row - 1, f"1,{near}"
    return ["-structures", "plate", "-plate_mesh", "tests/meshes/struck_plate.geo",
            "-plate_mesh_set", f"lx={length!r},ly={b},lz={thickness},nx={cells[0]},ny={cells[1]},"
            f"row={row}", "-plate_body_element", "hex8_full", "-plate_body_material", "stiff",
            "-material_stiff_young", YOUNG, "-material_stiff_poisson", 0,
            "-material_stiff_density", repr(density), "-plate_initial_velocity", f"{speed},0,0",
            "-plate_damping_beta", repr(beta), "-contacts", "stop",
            "-stop_secondary", "plate:struck", "-stop_primary", "wall", "-stop_gap", gap,
            "-end_time", repr(duration), "-output_interval", repr(duration / 50),
            "-energy_interval", 10,
            "-probes", "all", *all_nodes("all", "plate")]


class RigidPlate(unittest.TestCase):
    def hit(self, plate, eccentricity, ranks):
        mass, a, b, speed, _, results = plate
        impulse, velocity, spin, lost = results[eccentricity]
        run = Recorded(self, scene(plate, eccentricity), ranks)
        positions, names = run.nodes("all")
        share = lumped_fractions(positions)
        x, y = positions[:, 0] - positions[:, 0].mean(), positions[:, 1]
        radius = share @ (x**2 + y**2)
        self.assertAlmostEqual(radius / ((a**2 + b**2) / 12), 1, delta=1e-9)
        vx = numpy.array([run.velocity(f"{name}.x")[-1] for name in names])
        vy = numpy.array([run.velocity(f"{name}.y")[-1] for name in names])
        found = (vy @ (share * x) - vx @ (share * y)) / radius
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / impulse, 1, delta=5e-5)
        self.assertAlmostEqual(share @ vx / speed, velocity / speed, delta=5e-5)
        self.assertAlmostEqual(found * b / speed, spin * b / speed, delta=5e-5)
        # It moves as a rigid body again.
        self.assertLess(abs(vx - (share @ vx) + found * y).max(), 5e-5 * speed)
        energy = mass * speed**2 / 2
        left = run.energy["kinetic"] + run.energy["strain"]
        self.assertAlmostEqual((energy - left) / lost, 1, delta=5e-5)

    def test_impulse_speed_spin_and_loss(self):
        for plate in PLATES:
            for number, eccentricity in enumerate(plate[-1]):
                with self.subTest(mass=plate[0], eccentricity=eccentricity):
                    self.hit(plate, eccentricity, ranks=1 + number % 3)


if __name__ == "__main__":
    unittest.main()
