"""Rigid masses stand on one another under gravity: every joint carries the weight above it.

The impulse of joint k is g dt (m_k + m_{k+1} + ...) at every step, half of that in the first half
step, and nothing moves, whatever the ratio of the masses: 1e9 between the ends, light under heavy
and heavy under light. Each mass is one square of shell that has no reason to bend; one more flies
by, so that the energy identity has an energy to be measured against. The wall is where the normals
of the shells point, so the tower hangs upwards.
"""
import unittest

from recorded import Recorded

GRAVITY, TIME_STEP, STEPS, THICKNESS = 9.81, 1e-3, 200, 0.1

TOWERS = {  # masses from the wall on [kg], relative tolerance of the reactions
    "one light mass": ([1.0], 1e-14),
    "one heavy mass": ([9200.0], 1e-14),
    "another mass": ([7000.3], 1e-14),
    "five equal masses": ([1.0] * 5, 1e-14),
    "twenty equal masses": ([1.0] * 20, 1e-13),
    "ten times heavier each": ([10.0**k for k in range(10)], 1e-12),
    "ten times lighter each": ([0.1**k for k in range(9)], 1e-12),
    "a hundred times heavier each": ([100.0**k for k in range(5)], 1e-12),
    "a hundred times lighter each": ([0.01**k for k in range(5)], 1e-12),
}


def square(name, height, mass):
    density = mass / THICKNESS
    return [f"-{name}_mesh", "tests/meshes/floor.geo", f"-{name}_mesh_set", f"z={height}",
            f"-{name}_plate_element", "shell", f"-{name}_plate_material", name,
            f"-{name}_plate_thickness", THICKNESS, f"-material_{name}_young", repr(density / 10),
            f"-material_{name}_poisson", 0, f"-material_{name}_density", repr(density)]


def scene(masses):
    levels = [f"level{k}" for k in range(len(masses))]
    words = ["-structures", ",".join(levels + ["bird"]), "-time_step", TIME_STEP,
             "-end_time", STEPS * TIME_STEP, "-output_interval", TIME_STEP / 2,
             "-energy_interval", 1, "-contacts", ",".join(f"joint{k}" for k in range(len(masses))),
             "-probes", ",".join(f"at_{name}" for name in levels),
             *square("bird", 1, max(masses)), "-bird_initial_velocity", "1,0,0"]
    for k, name in enumerate(levels):
        words += square(name, -k, masses[k])
        words += [f"-{name}_gravity", f"0,0,{GRAVITY}", f"-joint{k}_gap", 0,
                  f"-joint{k}_secondary", f"{name}:plate",
                  f"-joint{k}_primary", f"{levels[k - 1]}:plate" if k > 0 else "wall",
                  f"-at_{name}_structure", name, f"-at_{name}_group", "plate"]
    return words


class Tower(unittest.TestCase):
    def test_every_joint_carries_what_stands_on_it(self):
        for number, (label, (masses, tolerance)) in enumerate(TOWERS.items()):
            with self.subTest(label):
                run = Recorded(self, scene(masses), 1 + number % 3)
                for k in range(len(masses)):
                    weight = GRAVITY * sum(masses[k:])
                    force = run.force(f"joint{k}")
                    self.assertEqual(len(force), STEPS + 1)
                    self.assertAlmostEqual(2 * force[0] / weight, 1, delta=tolerance)
                    self.assertLess(abs(force[1:] / weight - 1).max(), tolerance)
                    self.assertLess(abs(run.displacement(f"at_level{k}.z")).max(), 1e-15)
                self.assertEqual(len(run.column("start")), len(masses))


if __name__ == "__main__":
    unittest.main()
