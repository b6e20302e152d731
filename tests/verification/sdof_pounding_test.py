"""Two oscillators that pound against each other on a shaken ground, against event-driven results.

Masses 9200 and 7000 kg, 2.1 and 3.7 Hz, 1.5 % damping of the mass-proportional kind, ground
acceleration 0.30 g sin(2 pi 2.6 t), plastic impact (a lumped node keeps no velocity of approach).
Each oscillator is one hexahedron of unit section and length without Poisson effect, clamped at
its far face: its free face carries half of its mass on the stiffness E A / L. Reference: solution
between events in closed form, event times by bisection to 1e-12 s.
"""
import math
import os
import tempfile
import unittest

import program

MASS = (9200.0, 7000.0)
STIFFNESS = (1601718.3590439898, 3783216.759025573)
ALPHA = (0.3958406743523139, 0.697433569096934)
ACCELERATION, FREQUENCY = 0.30 * 9.81, 2.6

# gap [m]: time [s] and impulse [N s] of the first impacts
REFERENCE = {
    0.05: [(0.422429616787, 1221.920827), (0.787569518184, 3355.041405), (1.187177989549, 5271.265067)],
    0.02: [(0.366897113831, 2649.258601), (0.381065922116, 4.167007), (0.747218570206, 4921.420469)],
    0.00: [(0.335794468221, 2345.863299), (0.721708509749, 4991.614191), (1.104032251240, 5658.692036)],
}


def scene(gap, time_step, record, end_time):
    words = ["-structures", "left,right", "-end_time", end_time, "-time_step", time_step,
             "-output_interval", 1e-3, "-modes", 12,
             "-contacts", "gap", "-gap_secondary", "left:x_max", "-gap_primary", "right:x_min",
             "-gap_gap", gap, "-motion_x_record", record, "-motion_x_unit", "m/s2",
             "-impact_merge_time", 1e-2]
    for i, (name, start, wall) in enumerate((("left", -1, "x_min"), ("right", 0, "x_max"))):
        words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set", f"x0={start}",
                  f"-{name}_clamp", wall, f"-{name}_body_element", "hex8",
                  f"-{name}_body_material", name, f"-{name}_damping_alpha", ALPHA[i],
                  f"-material_{name}_young", STIFFNESS[i], f"-material_{name}_poisson", 0,
                  f"-material_{name}_density", 2 * MASS[i]]
    return words


class SdofPounding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        handle, cls.record = tempfile.mkstemp(suffix=".txt")
        with os.fdopen(handle, "w") as file:
            for i in range(20001):
                t = i * 1e-4
                value = ACCELERATION * math.sin(2 * math.pi * FREQUENCY * t)
                file.write(f"{t:.4f} {value:.17g}\n")

    @classmethod
    def tearDownClass(cls):
        os.remove(cls.record)

    def impacts(self, gap, time_step, ranks, end_time=1.3):
        folder, summary = program.must_run(self, scene(gap, time_step, self.record, end_time), ranks)
        self.assertLess(summary["energy"]["relative_residual"], 1e-12)
        table = program.read_csv(os.path.join(folder, "impacts.csv"))
        return [(float(t), float(j)) for t, j in zip(table["start"], table["impulse"])]

    def test_frequencies_are_those_of_the_oscillators(self):
        _, summary = program.must_run(self, scene(0.05, 1e-3, self.record, 0.01))
        for name, frequency in (("left", 2.1), ("right", 3.7)):
            modes = summary["structures"][name]["frequencies"]
            stretch = [mode["frequency"] for mode in modes if mode["direction"] == "x"]
            self.assertAlmostEqual(stretch[0], frequency, delta=1e-6)

    def test_impact_times_and_impulses(self):
        time_step = 1.25e-4
        for gap, reference in REFERENCE.items():
            found = self.impacts(gap, time_step, ranks=2)
            for time, impulse in reference:
                if impulse < 100:  # a touch at 1 mm/s: which step sees it is a matter of chance
                    continue
                nearest = min(found, key=lambda impact: abs(impact[0] - time))
                self.assertLess(abs(nearest[0] - time), 3 * time_step, (gap, time, found))
                if gap == 0.05:
                    self.assertLess(abs(nearest[1] / impulse - 1), 0.01, (gap, time, found))

    def test_first_order_in_the_time_step(self):
        errors = []
        for time_step in (8e-4, 4e-4, 2e-4, 1e-4):
            found = self.impacts(0.05, time_step, ranks=1, end_time=1.25)
            errors.append(max(abs(a[0] - b[0]) for a, b in zip(found, REFERENCE[0.05])))
        order = math.log2(errors[0] / errors[-1]) / 3
        self.assertGreater(order, 0.8, errors)
        self.assertLess(errors[-1], 3e-4, errors)

    def test_same_impacts_on_every_number_of_ranks(self):
        lists = [self.impacts(0.02, 2e-4, ranks, 0.8) for ranks in (1, 2, 3)]
        for other in lists[1:]:
            self.assertEqual(len(other), len(lists[0]))
            for a, b in zip(lists[0], other):
                self.assertAlmostEqual(a[0], b[0], delta=1e-12)
                self.assertAlmostEqual(a[1], b[1], delta=1e-9 * lists[0][0][1])


if __name__ == "__main__":
    unittest.main()
