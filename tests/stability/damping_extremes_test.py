"""Damping from none to a million times too much: stable step, decay, and the end of both.

The stable step 2 / (omega (sqrt(1 + xi^2) + xi)) with xi = alpha / (2 omega) + beta omega / 2, in the form
that does not cancel; for omega = 3.05e5 rad/s, the largest frequency of the paper's hexahedra. A free
mass knows damping alone: its step is 2 / alpha.
"""
import math
import unittest

from history import History, refused, scenes

OMEGA, MASS, SPEED = 3.05e5, 2.0, 1.0

# alpha [1/s], beta [s]: stable step [s]
STEPS = {
    (0.0, 0.0): 6.5573770491803276e-06,
    (0.0, 1e-3): 2.1499365771194167e-08,
    (0.0, 1.0): 2.149959688232733e-11,
    (0.0, 1e6): 2.1499596882558452e-17,
    (1e6, 0.0): 1.8421577329316017e-06,
}


def oscillators(cases):
    words = ["-structures", ",".join(f"case{i}" for i in range(len(cases))), "-modes", 0,
             "-spectra_frequencies", 10]
    for i, (alpha, beta) in enumerate(cases):
        words += scenes.oscillator(f"case{i}", MASS * OMEGA**2, MASS, SPEED, beta)
        words += [f"-case{i}_damping_alpha", repr(alpha)]
    return words


class StableStep(unittest.TestCase):
    def test_keeps_its_digits_however_strong_the_damping(self):
        run = History(self, [*oscillators(STEPS), "-end_time", 1e-17], 2)
        for i, step in enumerate(STEPS.values()):
            found = run.summary["structures"][f"case{i}"]
            self.assertAlmostEqual(found["stable_time_step"] / step, 1, delta=1e-8, msg=i)
            self.assertAlmostEqual(found["stable_time_step_undamped"] * OMEGA / 2, 1, delta=1e-8, msg=i)
        for i, (alpha, _) in enumerate(STEPS):  # a rigid motion must be stable as well
            self.assertLess(run.summary["structures"][f"case{i}"]["stable_time_step"] * alpha, 2)
        self.assertLessEqual(run.summary["time_step"], min(STEPS.values()))

    def test_is_the_limit(self):
        for (alpha, beta), step in STEPS.items():
            with self.subTest(alpha=alpha, beta=beta):
                words = [*oscillators([(alpha, beta)]), "-end_time", repr(3000 * step), "-output_interval",
                         repr(step / 2), "-probes", "it", "-it_structure", "case0", "-it_at", "1,0,0"]
                run = History(self, [*words, "-time_step", repr(0.999 * step)])
                velocity = abs(run.channel("velocity", "it.x"))
                self.assertLess(run.energy["relative_residual"], 1e-11)
                # So near to the limit the velocity alternates; it is bounded by the discrete energy.
                self.assertLessEqual(velocity[1500:].max(), velocity[:1500].max() * (1 + 1e-3))
                self.assertLessEqual(velocity.max(), SPEED / math.sqrt(1 - 0.999**2))
                refused(self, [*words, "-time_step", repr(1.01 * step), "-allow_unstable", "true"],
                        "the run diverged")

    def test_of_a_free_mass_is_that_of_its_damping(self):
        alpha = 1e6
        words = ["-structures", "mass", "-mass_mesh", "tests/meshes/chain.geo", "-mass_first_element", "point_mass",
                 "-mass_first_mass", MASS, "-mass_initial_velocity", f"{SPEED},0,0", "-mass_damping_alpha", alpha,
                 "-probes", "it", "-it_structure", "mass", "-it_at", "1,0,0", "-modes", 0, "-spectra_frequencies", 10]
        run = History(self, [*words, "-courant", 0.25, "-end_time", 1e-4, "-output_interval", 1e-9])
        self.assertAlmostEqual(run.summary["stable_time_step"] * alpha / 2, 1, delta=1e-12)
        dt = run.summary["time_step"]
        velocity = run.channel("velocity", "it.x")
        for n in range(40):  # half a step, then whole ones
            exact = SPEED * (1 - alpha * dt / 2) * (1 - alpha * dt)**n
            self.assertAlmostEqual(velocity[n] / exact, 1, delta=1e-12)


class Pair(unittest.TestCase):
    def test_any_stiffness_damping_closes_the_energy(self):
        for beta in (0.0, 1e-9, 1e-4):
            with self.subTest(beta=beta):
                words = [word for name in ("s1", "s2") for word in (f"-{name}_damping_beta", beta)]
                run = History(self, [*scenes.program.COARSE_PAIR, *words, "-s1_initial_velocity", "0.5,0,0",
                                     "-floor1_gap", 0.002, "-floor2_gap", 0.002, "-end_time", 0.02, "-modes", 0], 2)
                self.assertGreater(run.summary["impacts"]["episodes"], 0)
                self.assertLess(run.energy["relative_residual"], 1e-10)
                self.assertGreater(run.energy["damping"], 0)  # alpha remains
                for structure in run.summary["structures"].values():
                    omega, alpha = structure["omega_max"], structure["damping"]["alpha"]
                    ratio = alpha / (2 * omega) + beta * omega / 2
                    self.assertAlmostEqual(structure["stable_time_step"] * omega / 2,
                                           1 / (math.sqrt(1 + ratio**2) + ratio), delta=1e-6)


if __name__ == "__main__":
    unittest.main()
