"""Two oscillators that pound against each other on a shaken ground, against event-driven results.

Masses 9200 and 7000 kg, 2.1 and 3.7 Hz, 1.5 % damping of the mass-proportional kind; plastic impact
(a lumped node keeps no velocity of approach). Ground: 0.30 g sin(2 pi 2.6 t) for 5 s, or an
earthquake of 0.45 g for 15 s; gaps of 5, 2 and 0 cm. Each oscillator is one hexahedron of unit
section and length without Poisson effect, clamped at its far face: its free face carries half of
its mass on the stiffness E A / L.

Reference: solution between events in closed form, event times by bisection to 1e-12 s. The scheme
is of first order at impacts: its errors at four time steps are those that an independent
implementation of the scheme makes on the two masses.
"""
import math
import os
import unittest

import numpy

import program
from recorded import FIXTURES, Recorded, fixture, golden, needs_fixtures, write_sine

MASS = (9200.0, 7000.0)
STIFFNESS = (1601718.3590439898, 3783216.759025573)
ALPHA = (0.3958406743523139, 0.697433569096934)
ACCELERATION, FREQUENCY = 0.30 * 9.81, 2.6

# gap [m], under the harmonic ground: time [s] and impulse [N s] of the first impacts
REFERENCE = {
    0.05: [(0.422429616787, 1221.920827), (0.787569518184, 3355.041405), (1.187177989549, 5271.265067)],
    0.02: [(0.366897113831, 2649.258601), (0.381065922116, 4.167007), (0.747218570206, 4921.420469)],
    0.00: [(0.335794468221, 2345.863299), (0.721708509749, 4991.614191), (1.104032251240, 5658.692036)],
}
CASES = [f"{ground}_gap{gap}" for ground in ("harm", "quake") for gap in ("0.05", "0.02", "0")]
TIME_STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
RANKS = (2, 1, 3, 2)  # for these


def scene(gap, time_step, record, end_time):
    words = ["-structures", "left,right", "-end_time", end_time, "-time_step", repr(time_step),
             "-output_interval", repr(time_step / 2), "-impact_merge_time", 1e-9,
             "-contacts", "gap", "-gap_secondary", "left:x_max", "-gap_primary", "right:x_min",
             "-gap_gap", gap, "-motion_x_record", record, "-motion_x_unit", "m/s2",
             "-probes", "face1,face2", "-face1_structure", "left", "-face1_group", "x_max",
             "-face2_structure", "right", "-face2_group", "x_min"]
    for i, (name, start, wall) in enumerate((("left", -1, "x_min"), ("right", 0, "x_max"))):
        words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set", f"x0={start}",
                  f"-{name}_clamp", wall, f"-{name}_body_element", "hex8",
                  f"-{name}_body_material", name, f"-{name}_damping_alpha", ALPHA[i],
                  f"-material_{name}_young", STIFFNESS[i], f"-material_{name}_poisson", 0,
                  f"-material_{name}_density", 2 * MASS[i]]
    return words


def impacts(run):
    """Times and impulses of the steps at which the faces meet: force after a step without."""
    impulse = run.force("gap") * run.time_step
    first = numpy.nonzero((impulse > 0) & (numpy.append(0, impulse[:-1]) == 0))[0]
    return run.time[first], impulse[first]


class SdofPounding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_sine(ACCELERATION, FREQUENCY, 5.0)

    @classmethod
    def tearDownClass(cls):
        os.remove(cls.record)

    def test_frequencies_are_those_of_the_oscillators(self):
        _, summary = program.must_run(self, scene(0.05, 1e-3, self.record, 0.01) + ["-modes", 12])
        for name, frequency in (("left", 2.1), ("right", 3.7)):
            modes = summary["structures"][name]["frequencies"]
            stretch = [mode["frequency"] for mode in modes
                       if mode["direction"] == "x" and mode["fraction"] > 0.99]
            self.assertAlmostEqual(stretch[0], frequency, delta=1e-6)

    def test_first_impacts(self):
        time_step = 1.25e-4
        for gap, reference in REFERENCE.items():
            run = Recorded(self, scene(gap, time_step, self.record, 1.3))
            times, impulses = impacts(run)
            for time, impulse in reference:
                if impulse < 100:  # a touch at 1 mm/s: which step sees it is a matter of chance
                    continue
                nearest = abs(times - time).argmin()
                self.assertLess(abs(times[nearest] - time), 1.5 * time_step, (gap, time, times))
                self.assertLess(abs(impulses[nearest] / impulse - 1), 0.01, (gap, time))

    def test_same_impacts_on_every_number_of_ranks(self):
        runs = [Recorded(self, scene(0.02, 2e-4, self.record, 0.8), ranks) for ranks in (1, 2, 3)]
        force = runs[0].force("gap")
        for other in runs[1:]:
            self.assertEqual(other.summary["partition"]["interface_ranks"], 2)
            self.assertLess(abs(other.force("gap") - force).max(), 1e-9 * force.max())

    def errors(self, name, time_step, ranks):
        """Of both displacements (root mean square over that of the reference), the largest of the
        first eight impact times [s] and impulses (relative); and the total impulse [N s]."""
        case = fixture("A3_sdof_pounding.json")["cases"][name]
        record = self.record if name.startswith("harm") else \
            os.path.join(FIXTURES, "A3_synthetic_quake_pga045g.csv")
        run = Recorded(self, scene(case["gap"], time_step, record, case["tend"]), ranks)
        reference = golden(f"A3_{name}.csv")
        at = numpy.rint(reference["t"] / time_step).astype(int)
        errors = []
        for probe, column in (("face1.x", "u1"), ("face2.x", "u2")):
            difference = run.displacement(probe)[at] - reference[column]
            errors.append(math.sqrt((difference**2).mean() / (reference[column]**2).mean()))
        times, impulses = impacts(run)
        events = [event for event in case["impacts"] if abs(event["gap_velocity"]) > 0.02][:8]
        nearest = [abs(times - event["t"]).argmin() for event in events]
        errors.append(max(abs(times[i] - event["t"]) for i, event in zip(nearest, events)))
        errors.append(max(abs(impulses[i] / event["impulse"] - 1)
                          for i, event in zip(nearest, events)))
        return errors, run.force("gap")[:-1].sum() * time_step

    @needs_fixtures
    def test_errors_are_those_of_the_scheme_and_of_first_order(self):
        for name in CASES:
            rows = fixture("A3_sdof_pounding.json")["cases"][name]["cdl_convergence"]
            found = []
            for row, time_step, ranks in zip(rows, TIME_STEPS, RANKS):
                errors, impulse = self.errors(name, time_step, ranks)
                found.append(errors)
                with self.subTest(name, time_step=time_step):
                    self.assertEqual(row["dt"], time_step)
                    expected = [row[key] for key in ("rms_rel_u1", "rms_rel_u2",
                                                     "max_impact_time_error",
                                                     "max_first_impulse_rel_error")]
                    for value, reference in zip(errors, expected):
                        self.assertAlmostEqual(value / reference, 1, delta=2e-3)
                    self.assertAlmostEqual(impulse / row["total_impulse"], 1, delta=1e-6)
                    self.assertLess(errors[2], 3.4 * time_step)
            for k in (0, 1):
                order = math.log2(found[0][k] / found[-1][k]) / 3
                self.assertTrue(0.8 < order < 1.3, (name, order, found))


if __name__ == "__main__":
    unittest.main()
