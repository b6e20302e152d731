"""An elastic bar falls on a rigid wall: one impact at constant speed, many under gravity.

Bar of length 10 m, section 1 m2, E = 900 Pa, density 1 kg/m3, without Poisson effect, so that
hexahedra behave as the one-dimensional bar: wave speed c = 30 m/s, impedance 30 N s/m.

A1a: at -10 m/s from 5 m. d'Alembert: force 300 N for 2 L/c = 2/3 s, impulse 200 N s, rebound at
10 m/s. The scheme loses half of m_c v0^2 exactly, m_c being the lumped mass of the contact nodes;
at Courant number one its impulse is v0 (2 m - m_c). A1b: at rest from 5 m under g = 10 m/s2:
contacts 1 to 5/3 s and 11/3 to 13/3 s, period 16/3 s, impulse 266.67 N s each.
Reference: Doyen, Ern, Piperno, SIAM J. Sci. Comput. 33 (2011) 223-249 (the problem); figures of
the discrete solution from an independent one-dimensional code.
"""
import math
import unittest

from recorded import Recorded, all_nodes, assert_follows, golden, needs_fixtures

LENGTH, SPEED_OF_SOUND, SPEED = 10.0, 30.0, 10.0
MASS, ENERGY = 10.0, 500.0

# elements, Courant number: first contact [s], duration [s], impulse [N s], mean force [N],
# rebound [m/s] of the discrete solution
DISCRETE = {
    (50, 0.9): (0.504, 0.672, 198.6611766321995, 299.9924875, 9.86611766321992),
    (100, 0.9): (0.501, 0.669, 199.15515696494072, 299.9988439, 9.915515696494067),
}


def scene(elements, time_step, end_time, height, *more):
    return ["-structures", "bar", "-bar_mesh", "tests/meshes/box.geo",
            "-bar_mesh_set", f"lz=10,nz={elements}", "-bar_body_element", "hex8_full",
            "-bar_body_material", "soft", "-material_soft_young", 900, "-material_soft_poisson", 0,
            "-material_soft_density", 1, "-contacts", "stop", "-stop_secondary", "bar:z_min",
            "-stop_primary", "wall", "-stop_gap", height, "-time_step", repr(time_step),
            "-end_time", end_time, "-output_interval", repr(time_step / 2), "-energy_interval", 1,
            "-probes", "all,bottom,top", "-bottom_structure", "bar", "-bottom_group", "z_min",
            "-top_structure", "bar", "-top_group", "z_max", *all_nodes("all", "bar"), *more]


def thrown(elements, courant, height=5.0, *more, end_time=1.9):
    return scene(elements, courant * LENGTH / elements / SPEED_OF_SOUND, end_time, height,
                 "-bar_initial_velocity", f"0,0,{-SPEED}", *more)


def dropped(elements, courant, end_time, *more):
    return scene(elements, courant * LENGTH / elements / SPEED_OF_SOUND, end_time, 5.0,
                 "-bar_gravity", "0,0,-10", "-impact_merge_time", 0.1, *more)


class OneImpact(unittest.TestCase):
    def test_constant_force_for_two_transits(self):
        for (elements, courant), figures in DISCRETE.items():
            first, duration, impulse, force, rebound = figures
            run = Recorded(self, thrown(elements, courant))
            start = run.column("start")[0]
            mean = run.plateau("stop", start + 0.2 * 2 / 3, start + 0.8 * 2 / 3)
            self.assertAlmostEqual(mean, 300, delta=1e-3 * 300)
            self.assertAlmostEqual(mean, force, delta=1e-4 * 300)
            self.assertEqual(len(run.column("start")), 1)
            self.assertAlmostEqual(start, first, delta=1e-9)
            self.assertAlmostEqual(run.column("duration")[0], duration, delta=1e-9)
            self.assertLess(abs(run.column("duration")[0] / (2 / 3) - 1), 0.02)
            self.assertAlmostEqual(run.column("impulse")[0] / impulse, 1, delta=1e-6)
            self.assertAlmostEqual(run.mean_velocity("all", "z")[-1] / rebound, 1, delta=1e-6)
            self.assertLessEqual(run.column("max_penetration")[0], SPEED * run.time_step)

    def test_energy_lost_is_that_of_the_contact_nodes(self):
        for elements, courant, peak in ((50, 0.9, 321.3), (100, 0.5, 325.78125)):
            run = Recorded(self, thrown(elements, courant, 5.00137))
            lost = MASS / elements / 2 * SPEED**2 / 2
            self.assertAlmostEqual(run.column("energy_lost")[0] / lost, 1, delta=1e-10)
            self.assertAlmostEqual(run.energy["contact"] / -lost, 1, delta=1e-10)
            self.assertAlmostEqual((run.energy["kinetic"] + run.energy["strain"]) / (ENERGY - lost),
                                   1, delta=1e-12)
            self.assertAlmostEqual(run.column("peak_force")[0] / peak, 1, delta=1e-9)
            self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_exact_at_courant_number_one(self):
        elements = 100
        run = Recorded(self, thrown(elements, 1.0, 5.00137, "-allow_unstable", end_time=1.4))
        contact_mass = MASS / elements / 2
        self.assertAlmostEqual(run.column("impulse")[0], SPEED * (2 * MASS - contact_mass),
                               delta=1e-7)
        self.assertAlmostEqual(run.mean_velocity("all", "z")[-1],
                               SPEED * (1 - contact_mass / MASS), delta=1e-8)
        force = run.force("stop")
        first = int((force > 1e-6).argmax())
        self.assertAlmostEqual(force[first], 150, delta=1e-6)
        self.assertLess(abs(force[first + 1:first + 199] - 300).max(), 1e-6)

    def test_stiffness_damping_sets_the_restitution(self):
        beta = 0.5 * 0.1 / SPEED_OF_SOUND
        ratio = 0.5  # of the highest frequency 2 c/h
        courant = 0.95 * (math.sqrt(1 + ratio**2) - ratio)
        run = Recorded(self, thrown(100, courant, 5.0, "-bar_damping_beta", repr(beta)))
        rebound = run.mean_velocity("all", "z")[-1]
        self.assertAlmostEqual(rebound, 9.20302, delta=1e-3)
        law = 1 - 2 / math.sqrt(math.pi) * math.sqrt(beta * SPEED_OF_SOUND / LENGTH)
        self.assertAlmostEqual(rebound / SPEED, law, delta=1e-3)
        self.assertAlmostEqual(run.column("energy_lost")[0], 2.5, delta=2.5e-10)

    @needs_fixtures
    def test_history_step_by_step(self):
        reference = golden("A1a_golden_ne10_cfl05.csv")
        for ranks in (1, 2, 3):
            run = Recorded(self, thrown(10, 0.5, 5.00137, end_time=1.55), ranks)
            follow_golden(self, run, reference)


class ManyImpacts(unittest.TestCase):
    def test_windows_and_impulses(self):
        run = Recorded(self, dropped(100, 0.99, 7.2))
        reference = ((1.0032, 1.6731, 267.1533077723259), (3.6696, 4.3395, 265.9732592562724),
                     (6.3261, 6.9993, 265.61122818047767))
        self.assertEqual(len(run.column("start")), len(reference))
        for found, (start, end, impulse) in zip(
                zip(run.column("start"), run.column("end"), run.column("impulse")), reference):
            self.assertAlmostEqual(found[0], start, delta=1e-9)
            self.assertAlmostEqual(found[1], end, delta=1e-9)
            self.assertAlmostEqual(found[2] / impulse, 1, delta=1e-7)
        for k, exact in enumerate((1, 11 / 3)):  # d'Alembert
            self.assertAlmostEqual(run.column("start")[k], exact, delta=5e-3)
            self.assertAlmostEqual(run.column("impulse")[k] / (800 / 3), 1, delta=5e-3)
        self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_force_rises_then_falls(self):
        run = Recorded(self, dropped(100, 0.99, 4.5))
        # 30 (10 + 10 t') in the first contact, back to 300 N in the second
        for time, force in ((1.2, 360), (1.5, 450), (3.85, 445), (4.15, 355)):
            self.assertAlmostEqual(run.plateau("stop", time - 0.03, time + 0.03) / force, 1,
                                   delta=0.01)

    @needs_fixtures
    def test_history_step_by_step(self):
        reference = golden("A1b_golden_ne20_cfl09.csv")
        run = Recorded(self, dropped(20, 0.9, 0.015 * (len(reference["t"]) + 1)))
        follow_golden(self, run, reference)


def follow_golden(test, run, reference):
    assert_follows(test, run.time, reference["t"], 1e-12, "time")
    assert_follows(test, run.force("stop") * run.time_step, reference["lambda"], 1e-9, "impulse")
    for end in ("bottom", "top"):
        assert_follows(test, run.displacement(f"{end}.z")[1:], reference[f"u_{end}(t+dt)"], 1e-9, end)
    assert_follows(test, run.mean_velocity("all", "z"), reference["vcm(t+dt/2)"], 1e-9, "velocity")


if __name__ == "__main__":
    unittest.main()
