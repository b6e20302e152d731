"""A free plate hits a rigid stop with one end of its face: it stops and spins.

Concrete plate 3 x 2 x 0.22 m at 0.5 m/s along x; the stop is 12.345 um away from the nodes at one
corner, or from half of the face. Whatever the elements do, momentum and angular momentum are those
of the contact impulses with the inertia of the lumped masses, and the scheme loses exactly half of
m_c v0^2. Impulse, velocity and spin of the discrete solution: an independent code.
"""
import unittest

import numpy

from decks import clock, material
from recorded import Recorded, all_nodes, assert_follows, lumped_fractions, reference

LENGTH, WIDTH, THICKNESS, DENSITY, SPEED = 3.0, 2.0, 0.22, 2400.0, 0.5
MASS = LENGTH * WIDTH * THICKNESS * DENSITY

# contact, cells, element, damping ratio at the highest frequency, that frequency [rad/s], time
# step [s], impulse [N s], velocity [m/s] and spin [rad/s] after, contact work [J]
DISCRETE = [
    ("corner", (6, 4), "hex8_full", 0, 33976.316254784695, 5.297807998083124e-05,
     1669.806352753439, -0.027085338621728055, 0.45178743310500696, -4.125),
    ("corner", (6, 4), "hex8_full", 1, 33976.316254784695, 2.1944239236546865e-05,
     1598.385386286375, -0.004540841630832021, 0.4324635785413863, -4.125),
    ("half", (6, 4), "hex8_full", 0, 33976.316254784695, 5.297807998083124e-05,
     2810.2120060854486, -0.38706187060800507, 0.19684070987905541, -20.625),
    ("half", (6, 4), "hex8_full", 1, 33976.316254784695, 2.1944239236546865e-05,
     2646.0472959983695, -0.335242202019872, 0.1805194225912876, -20.625),
    ("corner", (12, 8), "hex8_full", 1, 34450.44937628204, 2.1642226031016034e-05,
     1581.5775204709098, 0.0007646715682988541, 0.4521376559357055, -1.03125),
    ("half", (12, 8), "hex8_full", 1, 34450.44937628204, 2.1642226031016034e-05,
     2643.731734562146, -0.3345112798491746, 0.20767381248194572, -9.28125),
]
INCOMPATIBLE = ("corner", (6, 4), "hex8", 0, 33976.24279730629, 5.297819452075225e-05,
                1673.9072969078081, -0.028379828569692515, 0.45289699591721505, -4.125)

STOPS = {  # a gap that opens along y leaves contact to the nodes of the end only
    "corner": ["-stop_secondary", "plate:x_max", "-stop_gap", "1,1.2345e-5"],
    "half": ["-stop_secondary", "plate:x_max_half", "-stop_gap", "1.2345e-5"],
}


def scene(stop, cells, element, ratio, omega, time_step, end_time):
    return ["-structures", "plate", "-plate_mesh", "tests/meshes/plate.geo",
            "-plate_mesh_set", f"nx={cells[0]},ny={cells[1]}", "-plate_body_element", element,
            "-plate_body_material", "concrete", *material("concrete", 30e9, 0.2, DENSITY),
            "-plate_initial_velocity", f"{SPEED},0,0", "-plate_damping_beta", repr(2 * ratio / omega),
            "-contacts", "stop", "-stop_primary", "wall", *STOPS[stop],
            *clock(repr(time_step), repr(end_time), repr(time_step / 2)), "-energy_interval", 1, "-probes", "all",
            *all_nodes("all", "plate")]


def centre_and_spin(run, cells):
    """Velocity along x of the centre of mass and angular velocity about z from momenta."""
    positions, names = run.nodes("all")
    share = lumped_fractions(positions)
    vx = numpy.array([run.velocity(f"{name}.x") for name in names]).T
    vy = numpy.array([run.velocity(f"{name}.y") for name in names]).T
    x, y = positions[:, 0] - LENGTH / 2, positions[:, 1]
    spin = (vy @ (share * x) - vx @ (share * y)) / (share @ (x**2 + y**2))
    inertia = MASS * (share @ (x**2 + y**2))
    nx, ny = cells
    exact = MASS * (LENGTH**2 * (1 + 2 / nx**2) + WIDTH**2 * (1 + 2 / ny**2)) / 12
    return vx @ share, spin, inertia, exact


class EccentricPlate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.first = cls().hit(DISCRETE[0])

    def hit(self, case):
        stop, cells, element, ratio, omega, time_step = case[:6]
        run = Recorded(self, scene(stop, cells, element, ratio, omega, time_step, 0.0045))
        velocity, spin, inertia, exact = centre_and_spin(run, cells)
        self.assertAlmostEqual(inertia / exact, 1, delta=1e-12)
        return run, velocity, spin, inertia

    def test_impulse_velocity_and_spin(self):
        for case in DISCRETE + [INCOMPATIBLE]:
            *_, impulse, v, omega, work = case
            with self.subTest(case[:4]):
                run, velocity, spin, inertia = self.first if case is DISCRETE[0] else self.hit(case)
                found = run.summary["impacts"]["total_impulse"]
                self.assertAlmostEqual(run.summary["structures"]["plate"]["omega_max"] / case[4], 1,
                                       delta=1e-8)
                self.assertAlmostEqual(found / impulse, 1, delta=1e-8)
                self.assertAlmostEqual(velocity[-1], v, delta=1e-8)
                self.assertAlmostEqual(spin[-1], omega, delta=1e-8)
                self.assertAlmostEqual(run.energy["contact"] / work, 1, delta=1e-10)
                # Balances, whatever the elements: m dv = -J, I omega = J y
                self.assertAlmostEqual(MASS * (SPEED - velocity[-1]) / found, 1, delta=1e-10)
                arm = (run.column("impulse") @ run.column("lateral")) / found
                self.assertAlmostEqual(inertia * spin[-1] / (found * arm), 1, delta=1e-9)
                if case[0] == "corner":
                    self.assertAlmostEqual(arm, WIDTH / 2, delta=1e-12)
                else:
                    self.assertTrue(0 < arm < WIDTH / 2)

    def test_rigid_plate_bounds_the_impulse(self):
        # A rigid plate with a plastic point contact would take m v / (1 + m e^2 / I); the elastic
        # one rebounds, between once and twice that impulse.
        run, _, _, inertia = self.first
        rigid = MASS * SPEED / (1 + MASS * (WIDTH / 2) ** 2 / inertia)
        self.assertTrue(rigid < run.summary["impacts"]["total_impulse"] < 2 * rigid)

    def test_history_step_by_step(self):
        table = reference("eccentric_plate.csv")
        run, velocity, spin, _ = self.first
        assert_follows(self, run.time, DISCRETE[0][5] * table["step"], 1e-12, "time")
        assert_follows(self, run.force("stop") * run.time_step, table["impulse"], 1e-9, "J")
        assert_follows(self, velocity, table["velocity"], 1e-9, "velocity")
        assert_follows(self, spin, table["spin"], 1e-9, "spin")


ON_RANKS = {"a plate that is hit at a corner": scene(*DISCRETE[1][:6], 0.0045)}


if __name__ == "__main__":
    unittest.main()
