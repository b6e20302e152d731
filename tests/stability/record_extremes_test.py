"""Records of few samples, shorter than the run, out of step with it; spectra at both ends.

One mass on a spring under a record: displacements are those of the scheme, with the record linear
between its samples and zero outside, to round-off. Spectra: an infinitely stiff oscillator follows
the floor, PSA = max |a|; an infinitely soft one stays where it is, SD = largest displacement of the
floor as its acceleration has it, PSA = 0.
"""
import math
import os
import tempfile
import unittest

import numpy

from history import History, refused, scenes

MASS, OMEGA, TIME_STEP, STEPS = 50.0, 2 * math.pi * 3, 1e-3, 1000


class Records(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def words(self, text, *more):
        path = os.path.join(self.folder, "record.txt")
        with open(path, "w") as file:
            file.write(text)
        return ["-structures", "mass", *scenes.oscillator("mass", MASS * OMEGA**2, MASS, 0.0),
                "-time_step", TIME_STEP, "-end_time", STEPS * TIME_STEP, "-output_interval", TIME_STEP / 2,
                "-motion_x_record", path, "-motion_x_unit", "m/s2", "-probes", "it", "-it_structure", "mass",
                "-it_at", "1,0,0", "-modes", 0, "-spectra_frequencies", "1e-6,3,1e5",
                "-spectra_damping", "0,0.05,0.999", *more]

    def follow(self, samples, interval, offset=0.0):
        """A run under the record against the scheme."""
        text = "".join(f"{offset + i * interval!r} {value!r}\n" for i, value in enumerate(samples))
        run = History(self, self.words(text, "-motion_x_time_step", repr(interval)))
        time = numpy.arange(STEPS + 1) * TIME_STEP
        ground = numpy.interp(time, numpy.arange(len(samples)) * interval, samples, right=0.0)
        u, v, exact = 0.0, 0.0, []
        for n, acceleration in enumerate(ground):
            duration = TIME_STEP if n > 0 else TIME_STEP / 2
            u = u + TIME_STEP * v if n > 0 else u
            v = v - duration * (acceleration + OMEGA**2 * u)
            exact.append(u)
        found = run.channel("displacement", "it.x")
        self.assertEqual(len(found), STEPS + 1)
        self.assertLess(abs(found - exact).max(), 1e-12 * abs(numpy.array(exact)).max())
        self.assertLess(abs(run.data["ground_acceleration"][1:, 0] - ground[1:]).max(), 1e-12 * abs(ground).max())
        return run

    def test_shorter_than_the_run_and_out_of_step_with_it(self):
        self.follow([0.0, 1.0, -2.0, 1.5, 0.25], 0.0137)
        self.follow([0.0, 1.0, -2.0, 1.5, 0.25], 0.0137, offset=3.0)  # its first time becomes 0

    def test_coarser_than_the_run_by_far_or_finer(self):
        self.follow([1.0, -1.0, 0.5], 0.77)
        rough = numpy.random.default_rng(7).standard_normal(5000)
        self.follow([float(value) for value in rough], 0.1 * TIME_STEP)

    def test_begins_with_its_full_strength(self):
        run = self.follow([5.0] * 40, 0.0137)
        # The first step is half a step of velocity: v = -a dt / 2, absolute velocity 0.
        self.assertAlmostEqual(run.channel("velocity", "it.x")[0], -5.0 * TIME_STEP / 2, delta=1e-15)

    def test_shortest_one_has_two_samples(self):
        self.follow([3.0, 3.0], 0.1)
        refused(self, self.words("0 3\n"), "record.txt", "at least 2")

    def test_what_is_no_record(self):
        for text, *words in (("0 1\n0.1 inf\n0.2 1\n", "record.txt:2", "inf"),
                             ("0 1\n0.1 abc\n0.2 1\n", "record.txt:2", "abc"),
                             ("0 1\n0.1\n0.2 1\n", "record.txt:"), ("0 1\n\n0.2 1\n", "record.txt:2", "empty"),
                             ("", "record.txt", "empty"), ("0 1\n0.2 1\n0.1 1\n0.3 1\n", "record.txt:3", "increase")):
            with self.subTest(text):
                refused(self, self.words(text), *words, ranks=2)

    def spectrum(self, run, damping, frequency):
        row = [i for i in range(len(run.spectra["frequency"])) if run.spectra["direction"][i] == "x"
               and run.spectra["probe"][i] != "ground"
               and float(run.spectra["damping"][i]) == damping and float(run.spectra["frequency"][i]) == frequency]
        self.assertEqual(len(row), 1)
        return {key: float(run.spectra[key][row[0]]) for key in ("displacement", "pseudo_acceleration")}

    def test_ends_of_the_spectrum(self):
        run = self.follow([0.0, 1.0, -2.0, 1.5, 0.25], 0.0137)
        acceleration = run.channel("acceleration", "it.x")
        # Twice integrated, linear between samples: the floor as the oscillators feel it.
        velocity = numpy.concatenate([[0], numpy.cumsum((acceleration[1:] + acceleration[:-1]) / 2)]) * TIME_STEP
        floor = numpy.concatenate([[0], numpy.cumsum(velocity[:-1] + (2 * acceleration[:-1] + acceleration[1:])
                                                     * TIME_STEP / 6)]) * TIME_STEP
        for damping in (0.0, 0.05, 0.999):
            soft, stiff = (self.spectrum(run, damping, f) for f in (1e-6, 1e5))
            self.assertAlmostEqual(soft["displacement"] / abs(floor).max(), 1, delta=1e-4)
            self.assertLess(soft["pseudo_acceleration"], 1e-9)
            self.assertAlmostEqual(stiff["pseudo_acceleration"] / abs(acceleration).max(), 1, delta=1e-6)
            self.assertLess(stiff["displacement"], 1e-10)
        light, heavy = (self.spectrum(run, damping, 3)["pseudo_acceleration"] for damping in (0.0, 0.999))
        self.assertGreater(light, 2 * heavy)
        self.assertGreater(heavy, 0)


if __name__ == "__main__":
    unittest.main()
