"""Two bars collide whose faces are meshed differently: 2 x 2 squares on 3 x 3.

Concrete bars of 2 m, section 0.3 x 0.3 m, the first at 1 m/s; node-to-face contact from either
side, and from both. Theory as for equal bars (two_bars_test): force Z v0 / 2 for 2 L/c, impulse
m v0. The figures of the discrete solution come from an independent code in three dimensions; its
plateau and duration leave open how they are cut out of the history, the impulse does not.
"""
import math
import unittest

from decks import box_of, clock, contacts, material
from recorded import Recorded, all_nodes

LENGTH, SIDE, YOUNG, DENSITY = 2.0, 0.3, 30e9, 2400.0
SOUND = math.sqrt(YOUNG / DENSITY)
MASS = DENSITY * SIDE**2 * LENGTH
FORCE = DENSITY * SOUND * SIDE**2 / 2
DURATION = 2 * LENGTH / SOUND
GAP = 0.000100137

COARSE, FINE = (40, 2, 2), (60, 3, 3)
# Poisson, first mesh, second mesh, secondary bar, beta [s], time step [s]: force, impulse and
# duration over those of the theory
DISCRETE = [
    (0.0, COARSE, FINE, 2, 0.0, 8.485281374238532e-06,
     0.999962056, 0.990925248083, 1.012500),
    (0.0, COARSE, FINE, 1, 0.0, 8.48528137423854e-06,
     0.999156693, 0.990713630209, 1.012500),
    (0.2, COARSE, COARSE, 2, 0.0, 1.2073349793289012e-05,
     0.997890487, 0.977886888986, 1.013786),
    (0.2, COARSE, FINE, 2, 0.0, 8.049422694977902e-06,
     0.998609822, 0.975330934571, 1.024524),
    (0.2, COARSE, FINE, 2, 2e-05, 1.7178397833643352e-06,
     0.988921514, 0.894808080746, 0.988459),
    (0.2, COARSE, FINE, 1, 2e-05, 1.7178397833643356e-06,
     0.989629428, 0.897058039883, 0.993014),
]


def scene(poisson, meshes, secondary, beta, time_step, passes):
    faces = {1: "one:x_max", 2: "two:x_min"}
    words = ["-structures", "one,two", *contacts(joint=(faces[secondary], faces[3 - secondary], GAP)), "-joint_passes",
             passes, *clock(repr(time_step), 0.0028, 8.5e-6), "-impact_merge_time", 1e-4, "-one_initial_velocity",
             "1,0,0", "-probes", "all1,all2", *all_nodes("all1", "one"), *all_nodes("all2", "two"),
             *material("concrete", YOUNG, poisson, DENSITY)]
    for name, start, (nx, ny, nz) in (("one", -LENGTH, meshes[0]), ("two", 0, meshes[1])):
        words += [*box_of(name, f"x0={start},lx={LENGTH},ly={SIDE},lz={SIDE},nx={nx},ny={ny},nz={nz}", "concrete",
                          "hex8_full"),
                  f"-{name}_damping_beta", repr(beta)]
    return words


class UnmatchedFaces(unittest.TestCase):
    def collide(self, poisson, first, second, secondary, beta, time_step, passes=1):
        run = Recorded(self, scene(poisson, (first, second), secondary, beta, time_step, passes))
        start = run.column("start")[0]
        self.assertAlmostEqual(start, GAP, delta=2 * time_step)
        impulse = run.summary["impacts"]["total_impulse"]
        last = run.column("end")[-1]
        after = [run.mean_velocity(f"all{i}", "x")[-1] for i in (1, 2)]
        self.assertAlmostEqual(after[0], 1 - impulse / MASS, delta=1e-9)
        self.assertAlmostEqual(after[1], impulse / MASS, delta=1e-9)
        self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-9)
        force = run.plateau("joint", start + 0.2 * DURATION, start + 0.8 * DURATION)
        return run, force / FORCE, impulse / MASS, (last - start) / DURATION

    def test_force_and_impulse(self):
        for *case, force, impulse, duration in DISCRETE:
            with self.subTest(case):
                run, *found = self.collide(*case)
                self.assertEqual(run.summary["contacts"]["joint"]["unmatched_nodes"], 0)
                self.assertAlmostEqual(found[0] / force, 1, delta=0.01)
                self.assertAlmostEqual(found[1] / impulse, 1, delta=1e-8)
                self.assertAlmostEqual(found[2] / duration, 1, delta=0.03)
                self.assertAlmostEqual(found[0], 1, delta=0.02)

    def test_both_sides_secondary(self):
        for poisson, force, impulse in ((0.0, 0.9996, 0.991), (0.2, 0.9986, 0.9753)):
            with self.subTest(poisson):
                _, *found = self.collide(poisson, COARSE, FINE, 2, 0.0, 8e-6, passes=2)
                self.assertAlmostEqual(found[0] / force, 1, delta=0.01)
                self.assertAlmostEqual(found[1] / impulse, 1, delta=0.01)


class ManyRows(unittest.TestCase):
    """Faces of 13 x 13 nodes against 9 x 9 cells, turned so that some of them meet first: 169 rows, more than
    the dense solver takes."""

    def run_them(self, ranks, *more):
        words = scene(0.2, ((6, 12, 12), (6, 9, 9)), 1, 0.0, 6e-6, 1)
        words += ["-joint_gap", "0,1e-5,2e-5,3e-5", "-one_initial_velocity", "1,0.2,0.1",
                  "-output_interval", 1e-4, *more]
        return Recorded(self, words, ranks)

    def assert_alike(self, one, other):
        for name in ("start", "end", "impulse", "points"):
            for a, b in zip(one.column(name), other.column(name), strict=True):
                self.assertAlmostEqual(a, b, delta=1e-9 * max(abs(a), 1e-3), msg=name)

    def test_impulses_and_ranks(self):
        one = self.run_them(1)
        self.assertEqual(one.summary["coupled_rows"], 169)
        self.assertLess(one.summary["impacts"]["complementarity_residual"], 1e-13)
        impulse = one.summary["impacts"]["total_impulse"]
        after = one.mean_velocity("all2", "x")[-1]
        self.assertAlmostEqual(after, impulse / MASS, delta=1e-9)
        self.assert_alike(one, self.run_them(3))

    def test_with_friction(self):
        one = self.run_them(1, "-joint_friction", 0.4)
        self.assertLess(one.summary["impacts"]["complementarity_residual"], 1e-13)
        self.assertGreater(one.summary["impacts"]["friction_loss"], 0)
        self.assert_alike(one, self.run_them(2, "-joint_friction", 0.4))


ON_RANKS = {"faces that do not match": scene(0.2, ((10, 2, 2), (15, 3, 3)), 2, 0.0, 1.6e-5, 1),
            "a face that ranks solve together": [*scene(0.2, ((6, 24, 24), (6, 17, 17)), 1, 0.0, 3e-6, 1), "-joint_gap",
                                                 "0,1e-5,2e-5,3e-5", "-one_initial_velocity", "1,0.2,0.1",
                                                 "-end_time", 6e-4]}


if __name__ == "__main__":
    unittest.main()
