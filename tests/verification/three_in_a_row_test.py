"""Three buildings in a row: the middle one is hit from both sides at once, or one drives the next.

Rigid bricks that move along x: an impact is plastic, so bodies that touch go on together. References: momentum; the
impulses that bring each body to the common speed.
"""
import unittest

from decks import box_of, clock, contacts
from recorded import Recorded

GAP = 0.01


def scene(masses, speeds, first=GAP, second=GAP, *more):
    """Bricks of 1 m a, b, c with gaps between them, one at a distance from the next."""
    words = ["-structures", "a,b,c", *contacts(ab=("a:x_max", "b:x_min"), bc=("b:x_max", "c:x_min")),
             *clock(1e-4, 0.05), "-energy_interval", 10, "-probes", "pa,pb,pc"]
    for name, mass, speed, x in zip("abc", masses, speeds, (0, 1 + first, 2 + first + second)):
        words += [*box_of(name, f"x0={x!r}", f"stuff{name}"), f"-material_stuff{name}_young", 1e3,
                  f"-material_stuff{name}_poisson", 0, f"-material_stuff{name}_density", mass, f"-{name}_rigid", "body",
                  f"-{name}_initial_velocity", f"{speed},0,0", f"-p{name}_structure", name, f"-p{name}_at",
                  f"{x!r},0,0"]
    return words + list(more)


class ThreeInARow(unittest.TestCase):
    def impulses(self, run):
        return {name: sum(float(value) for value, contact in zip(run.impacts["impulse"], run.impacts["contact"])
                          if contact == name) for name in ("ab", "bc")}

    def test_hit_from_both_sides_at_once(self):
        masses, speeds = (100.0, 200.0, 300.0), (1.0, 0.0, -1.0)
        together = sum(m * v for m, v in zip(masses, speeds)) / sum(masses)
        for friction, ranks in ((0, 1), (0, 2), (0.5, 2), (0, 3)):
            run = Recorded(self, scene(masses, speeds, GAP, GAP, "-ab_friction", friction, "-bc_friction", friction),
                           ranks, identity=1e-11)
            for name in "abc":
                self.assertAlmostEqual(run.velocity(f"p{name}.x")[-1], together, delta=1e-9)
            impulses = self.impulses(run)
            self.assertAlmostEqual(impulses["ab"] / (masses[0] * (speeds[0] - together)), 1, delta=1e-9)
            self.assertAlmostEqual(impulses["bc"] / (masses[2] * (together - speeds[2])), 1, delta=1e-9)
            self.assertLess(run.column("max_penetration").max(), 1.0001e-4)

    def test_handed_on(self):
        """a takes b along, and both of them c."""
        masses, speeds = (300.0, 200.0, 100.0), (2.0, 0.0, 0.0)
        for ranks in (1, 2):
            run = Recorded(self, scene(masses, speeds, GAP, 2 * GAP), ranks, identity=1e-11)
            pair = masses[0] * speeds[0] / (masses[0] + masses[1])
            together = masses[0] * speeds[0] / sum(masses)
            for name in "abc":
                self.assertAlmostEqual(run.velocity(f"p{name}.x")[-1], together, delta=1e-9)
            impulses = self.impulses(run)
            self.assertAlmostEqual(impulses["bc"] / (masses[2] * together), 1, delta=1e-9)
            self.assertAlmostEqual(impulses["ab"] / (masses[0] * (speeds[0] - together)), 1, delta=1e-9)
            before = run.velocity("pb.x")[(run.time > GAP / 2 + 3e-4) & (run.time < GAP / 2 + 5e-3)]
            self.assertLess(abs(before - pair).max(), 1e-9)


if __name__ == "__main__":
    unittest.main()
