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

import numpy

from decks import box_of, clock, contacts, material, probes
from recorded import IDENTITY, IDENTITY_OF_A_FLIGHT, Recorded, assert_follows
from references import chains

LENGTH, SPEED_OF_SOUND, SPEED = 10.0, 30.0, 10.0
MASS, ENERGY = 10.0, 500.0

# elements, Courant number: first contact [s], duration [s], impulse [N s], mean force on the
# plateau and its standard deviation [N], peak force [N], rebound [m/s] of the discrete solution
DISCRETE = {
    (50, 1.0): (0.5, 0.6733333333333333, 199.0, 300.0, 0, 300.0, 9.9),
    (50, 0.9): (0.504, 0.672, 198.6611766321995, 299.9924875, 0.2227296774, 321.3,
                9.86611766321992),
    (50, 0.5): (0.5033333333333334, 0.6733333333333333, 197.98761966225067, 299.9934823,
                0.3182306708, 325.78125, 9.798761966225063),
    (100, 1.0): (0.5033333333333334, 0.6666666666666667, 199.5, 300.0, 0, 300.0, 9.95),
    (100, 0.9): (0.501, 0.669, 199.15515696494072, 299.9988439, 0.07827967803, 321.3,
                 9.915515696494067),
    (100, 0.5): (0.5016666666666667, 0.6716666666666666, 198.75695088262518, 299.9986731,
                 0.1108777178, 325.78125, 9.875695088262514),
    (400, 1.0): (0.5, 0.6666666666666667, 199.875, 300.0, 0, 300.0, 9.9875),
    (400, 0.9): (0.50025, 0.66825, 199.68760477324506, 300.0000076, 0.009696299291, 321.3,
                 9.968760477324436),
    (400, 0.5): (0.5, 0.6683333333333334, 199.52120163099346, 299.999947, 0.01369459846,
                 325.78125, 9.95212016309932),
}
# elements: the same at 0.95 of the stable step with beta = h / (2 c), and the energy lost [J]
DAMPED = {
    100: (0.5010195535465815, 0.6654165945540537, 192.0302059308896, 299.9946613364933,
          0.03058293022611332, 326.13968679371465, 9.203020593088986, 66.17446509118167),
    400: (0.5000409997310608, 0.6663951483695741, 196.01176420045965, 300.0, 0,
          326.13968679370004, 9.601176420045952, 33.09248578146128),
}
# elements, Courant number (of the damped limit where damped): start [s], end [s], impulse [N s]
MANY = {
    (100, 0.99): ((1.0032, 1.6731, 267.1533077723259), (3.6696, 4.3395, 265.9732592562724),
                  (6.3261, 6.9993, 265.61122818047767)),
    (100, 0.5): ((1.0016666666666667, 1.6783333333333335, 267.05318726118367),
                 (3.665, 4.341666666666667, 265.29758798246087),
                 (6.311666666666667, 6.988333333333334, 264.20824147402857)),
    (400, 0.99): ((1.000725, 1.668975, 266.8115378943823), (3.66795, 4.3362, 266.5052702332297),
                  (6.33105, 6.9993, 266.2588927686239)),
    (400, 0.5): ((1.0004166666666667, 1.6708333333333336, 266.7890989656191),
                 (3.6654166666666668, 4.335833333333333, 266.1094564640424),
                 (6.324583333333334, 6.995, 265.79023650849706)),
}
MANY_DAMPED = {
    (100, 0.95): ((1.0000819994621215, 1.6968123161128366, 261.113846344764),
                  (3.4621233993121194, 4.250837774621776, 240.9895820001314),
                  (5.755853542892563, 6.646337515016369, 221.20958037667356)),
    (400, 0.95): ((1.0000819994621215, 1.6821340088800263, 264.03790829229735),
                  (3.5560645656021035, 4.295851250135728, 253.756640486229),
                  (6.098347378324796, 6.788227818266867, 249.58538801915398)),
}
RATIO = 0.5  # damping ratio at the highest frequency 2 c/h that beta = h / (2 c) gives


def scene(elements, time_step, end_time, height, *more, cells_across=1):
    return ["-structures", "bar",
            *box_of("bar", f"lz=10,nz={elements},lx={cells_across},nx={cells_across}", "soft", "hex8_full"),
            *material("soft", 900, 0, 1), *contacts(stop=("bar:z_min", "wall", height)),
            *clock(repr(time_step), end_time, repr(time_step / 2)), "-energy_interval", 1,
            *probes(whole="bar:body", bottom="bar:z_min", top="bar:z_max"), *more]


def step_of(elements, courant, ratio=0.0):
    """Part of the stable time step; ratio: of damping at the highest frequency."""
    stable = LENGTH / elements / SPEED_OF_SOUND * (math.sqrt(1 + ratio**2) - ratio)
    return courant * stable


def damping(elements):
    return "-bar_damping_beta", repr(RATIO * LENGTH / elements / SPEED_OF_SOUND)


def thrown(elements, courant, height=5.0, *more, end_time=1.9, ratio=0.0, **mesh):
    return scene(elements, step_of(elements, courant, ratio), end_time, height,
                 "-bar_initial_velocity", f"0,0,{-SPEED}", *more, **mesh)


def dropped(elements, courant, end_time, *more, ratio=0.0, height=5.0):
    return scene(elements, step_of(elements, courant, ratio), end_time, height,
                 "-bar_gravity", "0,0,-10", "-impact_merge_time", 0.1, *more)


def fall(test, elements, arguments):
    return Recorded(test, arguments, identity=IDENTITY if elements <= 50 else IDENTITY_OF_A_FLIGHT)


def velocity(run, elements):
    """Of the centre of mass."""
    return run.bar_velocity("whole", ("bottom", "top"), elements, "z")


class OneImpact(unittest.TestCase):
    def compare(self, run, elements, figures, late=1e-9):
        """Against d'Alembert, and against the discrete solution; late: by which release may be."""
        first, duration, impulse, force, spread, peak, rebound = figures
        self.assertEqual(len(run.column("start")), 1)
        start = run.column("start")[0]
        inside = (run.time > 0.5 + 0.15 * 2 / 3) & (run.time < 0.5 + 0.85 * 2 / 3)
        plateau = run.force("stop")[inside]
        self.assertAlmostEqual(plateau.mean(), 300, delta=1e-3 * 300)
        self.assertAlmostEqual(plateau.mean(), force, delta=1e-6)
        self.assertAlmostEqual(plateau.std(), spread, delta=1e-6)
        self.assertAlmostEqual(start, first, delta=1e-9)
        self.assertAlmostEqual(start, 0.5, delta=1.01 * run.time_step)
        self.assertAlmostEqual(run.column("duration")[0], duration, delta=late)
        self.assertLess(abs(run.column("duration")[0] / (2 / 3) - 1), 0.02)
        self.assertAlmostEqual(run.column("impulse")[0] / impulse, 1, delta=1e-6)
        self.assertAlmostEqual(run.column("peak_force")[0] / peak, 1, delta=1e-6)
        self.assertAlmostEqual(velocity(run, elements)[-1] / rebound, 1, delta=1e-6)
        self.assertLessEqual(run.column("max_penetration")[0], SPEED * run.time_step)
        contact_work = MASS / elements / 2 * SPEED**2 / 2
        self.assertAlmostEqual(run.column("energy_lost")[0] / contact_work, 1, delta=1e-8)

    def test_constant_force_for_two_transits(self):
        rebound = {}
        for (elements, courant), figures in DISCRETE.items():
            with self.subTest(elements=elements, courant=courant):
                # The bar may be at the wall on a step to round-off: a little more room decides.
                height = 5 + 1e-10 if figures[0] > 0.5 else 5.0
                run = fall(self, elements, thrown(elements, courant, height, "-allow_unstable"))
                # At Courant number one the force ends on a step, to round-off.
                self.compare(run, elements, figures, run.time_step if courant == 1 else 1e-9)
                rebound[elements, courant] = velocity(run, elements)[-1]
        for courant, lowest, highest in ((1.0, 0.999, 1.001), (0.9, 0.65, 0.75), (0.5, 0.65, 0.75)):
            for coarse, fine in ((50, 100), (100, 400)):
                order = math.log((10 - rebound[coarse, courant]) / (10 - rebound[fine, courant]),
                                 fine / coarse)
                self.assertTrue(lowest < order < highest, (courant, coarse, fine, order))

    def test_stiffness_damping_sets_the_restitution(self):
        for elements, (*figures, lost) in DAMPED.items():
            run = fall(self, elements, thrown(elements, 0.95, 5.0, *damping(elements), ratio=RATIO))
            self.compare(run, elements, figures)
            left = run.energy["kinetic"] + run.energy["strain"]
            self.assertAlmostEqual((ENERGY - left) / lost, 1, delta=0.01)
            law = 1 - 2 / math.sqrt(math.pi) * math.sqrt(RATIO / elements)
            self.assertAlmostEqual(velocity(run, elements)[-1] / SPEED, law, delta=1e-3)

    def test_energy_lost_is_that_of_the_contact_nodes(self):
        for elements, courant, peak in ((50, 0.9, 321.3), (100, 0.5, 325.78125)):
            run = fall(self, elements, thrown(elements, courant, 5.00137))
            lost = MASS / elements / 2 * SPEED**2 / 2
            self.assertAlmostEqual(run.column("energy_lost")[0] / lost, 1, delta=1e-10)
            self.assertAlmostEqual(run.energy["contact"] / -lost, 1, delta=1e-10)
            self.assertAlmostEqual((run.energy["kinetic"] + run.energy["strain"]) / (ENERGY - lost),
                                   1, delta=1e-12)
            self.assertAlmostEqual(run.column("peak_force")[0] / peak, 1, delta=1e-9)

    def test_exact_at_courant_number_one(self):
        elements = 100
        run = fall(self, elements, thrown(elements, 1.0, 5.00137, "-allow_unstable", end_time=1.4))
        contact_mass = MASS / elements / 2
        self.assertAlmostEqual(run.column("impulse")[0], SPEED * (2 * MASS - contact_mass),
                               delta=1e-7)
        self.assertAlmostEqual(velocity(run, elements)[-1],
                               SPEED * (1 - contact_mass / MASS), delta=1e-8)
        force = run.force("stop")
        first = int((force > 1e-6).argmax())
        self.assertAlmostEqual(force[first], 150, delta=1e-6)
        self.assertLess(abs(force[first + 1:first + 199] - 300).max(), 1e-6)

    def test_history_step_by_step(self):
        elements = 40
        follow_chain(self, Recorded(self, thrown(elements, 0.7, 5.00137, end_time=1.55)), elements, 5.00137, -SPEED)

    def test_history_when_the_ranks_share_the_contact_face(self):
        # Forty bars side by side: the mesh is cut across its long side, and so is the face.
        bars = 40
        run = Recorded(self, thrown(10, 0.5, 5.00137, end_time=1.55, cells_across=bars), 3)
        self.assertEqual(run.summary["partition"]["interface_ranks"], 3)
        follow_chain(self, run, 10, 5.00137, -SPEED, bars=bars)


class ManyImpacts(unittest.TestCase):
    def check(self, run, reference):
        self.assertEqual(len(run.column("start")), len(reference))
        for found, (start, end, impulse) in zip(
                zip(run.column("start"), run.column("end"), run.column("impulse")), reference):
            self.assertAlmostEqual(found[0], start, delta=1e-9)
            self.assertAlmostEqual(found[1], end, delta=1e-9)
            self.assertAlmostEqual(found[2] / impulse, 1, delta=1e-7)
        self.assertLessEqual(run.column("max_penetration").max(), 1.01 * SPEED * run.time_step)

    def test_windows_and_impulses(self):
        for (elements, courant), reference in MANY.items():
            with self.subTest(elements=elements, courant=courant):
                height = 5 + 1e-10 if courant == 0.5 else 5.0  # on a step to round-off
                run = fall(self, elements, dropped(elements, courant, 7.2, height=height))
                self.check(run, reference)
                for k, exact in enumerate((1, 11 / 3)):  # d'Alembert
                    self.assertAlmostEqual(run.column("start")[k], exact, delta=0.005 * (k + 1))
                    self.assertAlmostEqual(run.column("impulse")[k] / (800 / 3), 1,
                                           delta=0.005 * (k + 1))
                if courant > 0.9:  # 30 (10 + 10 t') in the first contact, back to 300 N in the second
                    for time, force in ((1.2, 360), (1.5, 450), (3.85, 445), (4.15, 355)):
                        self.assertAlmostEqual(run.plateau("stop", time - 0.03, time + 0.03) / force, 1, delta=0.01)

    def test_windows_and_impulses_with_damping(self):
        for (elements, courant), reference in MANY_DAMPED.items():
            with self.subTest(elements=elements):
                self.check(fall(self, elements, dropped(elements, courant, 7.2, *damping(elements), ratio=RATIO)), reference)

    def test_history_step_by_step(self):
        run = Recorded(self, dropped(20, 0.9, 5.5))
        follow_chain(self, run, 20, 5.0, 0.0, gravity=-10.0)


def follow_chain(test, run, elements, height, speed, gravity=0.0, bars=1):
    """Step by step what an independent implementation of the scheme makes of masses and springs."""
    mass, stiffness = chains.bar(elements, LENGTH, 900.0, 1.0)
    bottom = numpy.zeros(elements + 1)
    bottom[0] = 1
    steps = len(run.time)
    u, v, impulse = chains.march(mass, stiffness, bottom, height, run.time_step, steps,
                                 numpy.full(elements + 1, speed), gravity)
    test.assertGreater(impulse.sum(), 190)
    assert_follows(test, run.time, run.time_step * numpy.arange(steps), 1e-12, "time")
    assert_follows(test, run.force("stop") * run.time_step / bars, impulse, 1e-9, "impulse")
    for end, place in (("bottom", 0), ("top", -1)):
        assert_follows(test, run.displacement(f"{end}.z"), u[:, place], 1e-9, end)
    assert_follows(test, velocity(run, elements), chains.centre(mass, v), 1e-9, "velocity")


ON_RANKS = {"bars on a wall": thrown(10, 0.5, 5.00137, end_time=1.55, cells_across=12)}


if __name__ == "__main__":
    unittest.main()
