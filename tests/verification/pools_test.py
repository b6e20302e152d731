"""Water in a tank: a rigid one on a spring beside the closed solution, a flexible one that is hit.

Closed solution: a mass on a spring and a dashpot, with the impulsive mass of the water on it and its waves on springs of
their own beside it; masses and frequencies by the series of docs/reference/theory/pools.md, written here anew.
"""
import math
import tempfile
import unittest

import numpy
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

import program
from decks import in_modes
from recorded import Recorded, assert_continues, ensemble_of, write_sine

LX, LY, DEPTH, HEIGHT, GRAVITY = 6.0, 4.0, 2.5, 3.0, 9.80665
WATER = 1000 * LX * LY * DEPTH
TANK = 2400 * .2 * (LX * LY + 2 * (LX + LY) * HEIGHT)
STIFFNESS, MODES, RATIO = 3e7, 2, .05
BASIN = ["-structures", "t", "-t_mesh", "tests/meshes/basin.geo", "-t_body_element", "shell", "-t_body_material", "concrete",
         "-t_body_thickness", .2, "-material_concrete_young", 3e10, "-material_concrete_poisson", .2,
         "-material_concrete_density", 2400]
POOL = ["-pools", "tank", "-tank_structure", "t", "-tank_faces", "body", "-tank_level", DEPTH, "-tank_modes", MODES]
RIGID = [*BASIN, "-t_mesh_set", f"h={HEIGHT}", "-t_rigid", "body", "-t_foot_element", "grounded_spring", "-t_foot_points",
         f"{LX / 2},{LY / 2},0", "-t_foot_stiffness", f"{STIFFNESS},{STIFFNESS},1e13,1e13,1e13,1e13"]


def series(length):
    """Impulsive mass, and mass and circular frequency of the waves, the last with the mass of those left out."""
    a = numpy.pi * DEPTH / length * numpy.arange(1, 2001, 2)
    n = numpy.arange(1, 2001, 2)
    masses = WATER * 8 * numpy.tanh(a) / ((n * numpy.pi)**3 * DEPTH / length)
    rest = WATER * 8 / (numpy.pi**3 * DEPTH / length) / (4 * 2000**2)  # of n > 2000
    omega = numpy.sqrt(GRAVITY * n * numpy.pi / length * numpy.tanh(a))
    waves = masses[:MODES].copy()
    waves[-1] += masses[MODES:].sum() + rest
    return WATER - waves.sum(), waves, omega[:MODES], 4 * numpy.tanh(a[:MODES]) / (n[:MODES] * numpy.pi)


def matrices(length):
    """Mass and stiffness of the tank and its waves, and the damping of these."""
    impulsive, waves, omega, _ = series(length)
    springs = waves * omega**2
    mass = numpy.diag([TANK + impulsive, *waves])
    stiffness = numpy.diag([STIFFNESS + springs.sum(), *springs])
    stiffness[0, 1:] = stiffness[1:, 0] = -springs
    dashpots = 2 * RATIO * waves * omega
    damping = numpy.diag([dashpots.sum(), *dashpots])
    damping[0, 1:] = damping[1:, 0] = -dashpots
    return mass, stiffness, damping


class RigidTank(unittest.TestCase):
    def test_modes(self):
        """Frequencies along both sides; the mass is that of tank and water, all of it in the modes."""
        for density in (1000, 1e-6):
            _, found = program.must_run(self, [*RIGID, *POOL, "-tank_density", density, "-modes", 6, "-end_time", 1e-3])
            modes = found["structures"]["t"]
            mass = TANK + WATER * density / 1000
            self.assertAlmostEqual(modes["mass"] / mass, 1, delta=1e-12)
            if density < 1:
                continue
            known = []
            for length in (LX, LY):
                m, k, _ = matrices(length)
                known += list(numpy.sqrt(eigh(k, m, eigvals_only=True)) / 2 / math.pi)
            frequencies = [mode["frequency"] for mode in modes["frequencies"]]
            numpy.testing.assert_allclose(frequencies, sorted(known), rtol=2e-5)
            water = modes["pools"]["tank"]
            self.assertAlmostEqual(water["mass"] / WATER, 1, delta=1e-12)
            for axis, length in (("x", LX), ("y", LY)):
                impulsive, waves, _, _ = series(length)
                self.assertAlmostEqual(water[axis]["impulsive"]["mass"] / impulsive, 1, delta=1e-6)
                numpy.testing.assert_allclose([wave["mass"] for wave in water[axis]["waves"]], waves, rtol=1e-5)

    def test_response(self):
        """Shaken near the first wave: motion of the tank and height of the waves."""
        end, acceleration, frequency = 8.0, .5, .35
        run = Recorded(self, [*RIGID, *POOL, "-tank_damping", RATIO, "-motion_x_record", write_sine(acceleration, frequency, end),
                              "-motion_x_time_step", 1e-4, "-motion_x_unit", "m/s2", "-probes", "p", "-p_structure", "t",
                              "-p_group", "foot", "-end_time", end, "-time_step", 2e-4, "-output_interval", .01,
                              "-energy_interval", 1000], identity=1e-10)
        mass, stiffness, damping = matrices(LX)
        inverse = numpy.linalg.inv(mass)

        def rate(t, y):
            u, v = y[:3], y[3:]
            ground = acceleration * math.sin(2 * math.pi * frequency * t)
            return [*v, *(-inverse @ (stiffness @ u + damping @ v) - ground)]

        known = solve_ivp(rate, (0, end), numpy.zeros(6), t_eval=run.time, rtol=1e-10, atol=1e-14).y
        motion = run.displacement("p.x")
        self.assertLess(abs(motion - known[0]).max(), 2e-4 * abs(known[0]).max())
        wave = abs(series(LX)[3] @ (known[1:3] - known[0])).max()
        pool = run.summary["pools"]["tank"]
        self.assertAlmostEqual(pool["wave_height"] / wave, 1, delta=2e-4)
        self.assertAlmostEqual(pool["freeboard"], HEIGHT - DEPTH, delta=1e-12)
        self.assertGreater(pool["wave_height"], pool["freeboard"])
        self.assertTrue(any("spills" in line for line in run.summary["warnings"]), run.summary["warnings"])

    def test_weight(self):
        """All of the water's weight comes down through the floor."""
        run = Recorded(self, [*RIGID, *POOL, "-gravity", 9.81, "-preload", "static", "-forces", "all", "-all_structure", "t",
                              "-all_kind", "reactions", "-end_time", .01, "-output_interval", .005])
        self.assertAlmostEqual(run.members("all")[0][2] / (9.81 * (TANK + WATER)), 1, delta=1e-9)


class Plant(unittest.TestCase):
    def test_numbers_by_hand(self):
        """Those at the head of the scene."""
        _, found = program.must_run(self, ["-options_file", "petsc-options/plant/pool.yaml", "-end_time", .01, "-modes", 3])
        water = found["structures"]["block"]["pools"]["fuel"]
        self.assertAlmostEqual(water["mass"], 156077, delta=.5)
        for axis in "xy":
            self.assertAlmostEqual(water[axis]["impulsive"]["mass"], 96122, delta=.5)
            waves = [(round(wave["frequency"], 4), round(wave["mass"])) for wave in water[axis]["waves"]]
            self.assertEqual(waves, [(.3531, 56928), (.6197, 3028)])
            self.assertGreater(water[axis]["waves"][0]["damping"], .005)


class HitTank(unittest.TestCase):
    """A flexible basin, clamped at its floor, whose wetted wall strikes a rigid one."""
    HIT = [*BASIN, *POOL, "-t_mesh_set", "nx=3,ny=2,nz=4", "-t_clamp", "floor", "-contacts", "joint", "-joint_secondary",
           "t:high_x", "-joint_primary", "wall", "-joint_gap", 2e-4, "-probes", "p", "-p_structure", "t", "-p_group", "low_x",
           "-end_time", .1, "-time_step", 2e-5, "-output_interval", 2e-4, "-energy_interval", 100, "-spectra_frequencies", "10"]
    MOTION = ["-motion_x_record", write_sine(-30, 12, .2), "-motion_x_time_step", 1e-4, "-motion_x_unit", "m/s2"]

    def hit(self, *words, ranks=1):
        run = Recorded(self, [*self.HIT, *self.MOTION, *words], ranks)
        self.assertGreater(run.summary["impacts"]["total_impulse"], 100)
        return run.displacement("p.x"), run.summary

    def test_ranks_and_all_modes(self):
        motion, found = self.hit("-tank_damping", 0)
        for ranks in (2, 3):
            other, there = self.hit("-tank_damping", 0, ranks=ranks)
            self.assertLess(abs(motion - other).max(), 1e-9 * abs(motion).max())
            self.assertAlmostEqual(there["pools"]["tank"]["wave_height"] / found["pools"]["tank"]["wave_height"], 1, delta=1e-9)
        all_modes, there = self.hit("-tank_damping", 0, "-t_model", "modal", "-t_modal_vectors", 1000)
        self.assertLess(abs(motion - all_modes).max(), 1e-8 * abs(motion).max())
        self.assertAlmostEqual(there["pools"]["tank"]["wave_height"] / found["pools"]["tank"]["wave_height"], 1, delta=1e-8)

    def test_waves_of_a_structure_in_modes_between_strikes(self):
        """Their height is that of full order, though the arrays of displacements are not brought in modes."""
        words = [*self.HIT, *self.MOTION, "-tank_damping", 0, "-joint_gap", 1]
        full = Recorded(self, words).summary
        run = Recorded(self, [*words, "-t_model", "switched", "-t_modal_vectors", 60, "-t_switched_part", 1e-2]).summary
        self.assertGreater(run["in_modes"]["share"], .5)
        self.assertAlmostEqual(run["pools"]["tank"]["wave_height"] / full["pools"]["tank"]["wave_height"], 1, delta=1e-2)

    def test_members_with_damping_of_their_own(self):
        """Waves keep the ratio of their pool, also where the scene has no damping."""
        words = [*self.HIT, *self.MOTION, *in_modes("t", 60)]
        ratios = .05, .3
        for more in ([], ["-t_modal_damping", .02]):
            peaks, _ = ensemble_of(self, [*words, *more], "t_modal_damping", ratios)
            for member, ratio in zip(peaks, ratios):
                single = self.hit(*in_modes("t", 60), "-t_modal_damping", ratio)[0]
                self.assertAlmostEqual(member[0] / abs(single).max(), 1, delta=1e-9)

    def test_members_of_other_damping_than_the_waves_make_up_for_are_refused(self):
        uniform = ["-t_damping_uniform", .03, "-t_damping_reference", 20]
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
            table.write("t_damping_factor\n1\n2\n")
            table.flush()
            for damping in (["-t_damping_beta", 1e-5], uniform, [*uniform, *in_modes("t", 60)]):
                program.must_refuse(self, [*self.HIT, *self.MOTION, "-ensemble", table.name, *damping],
                                    "column t_damping_factor", "the waves of structure t")

    def test_continues(self):
        whole, continued = assert_continues(self, [*self.HIT, *self.MOTION], .05, 2000)
        self.assertEqual(whole["pools"], continued["pools"])


if __name__ == "__main__":
    unittest.main()
