"""pounding-spectra over all horizontal directions: RotD50, RotD100 and other percentiles of pairs of components."""
import math
import tempfile
import unittest

import numpy

import program
from spectra_command import computed, frequencies, spectra

STEP = 0.005


def write_columns(test, *columns):
    file = tempfile.NamedTemporaryFile("w", suffix=".txt")
    test.addCleanup(file.close)
    for i, row in enumerate(zip(*columns)):
        file.write(" ".join(repr(float(value)) for value in (i * STEP, *row)) + "\n")
    file.flush()
    return file.name


def noise(seed, count=1200):
    random = numpy.random.default_rng(seed)
    t = numpy.arange(count) * STEP
    signal = numpy.zeros(count)
    for frequency in (0.7, 1.9, 3.3, 7.1, 12.0):
        signal += random.normal() * numpy.sin(2 * math.pi * frequency * t + random.uniform(0, 6))
    return signal * numpy.sin(math.pi * numpy.arange(count) / (count - 1))**2


class Rotated(unittest.TestCase):
    ALL = frequencies([0.5, 1, 2.5, 6, 20])
    PERCENTILES = (0, 16, 50, 84, 100)

    def table(self, *columns, more=()):
        names = ",".join(str(2 + i) for i in range(len(columns)))
        return computed(self, write_columns(self, *columns), "--columns", names, "--unit", "m/s2", *self.ALL, *more)

    def of(self, table, percentile, damping=0.05):
        chosen = (table["direction"] == f"rotd{percentile:02d}") & (table["damping"] == damping)
        return table["pseudo_acceleration"][chosen]

    def test_every_direction_by_itself(self):
        x, y = noise(1), noise(2)
        angles = numpy.arange(180) * math.pi / 180
        alone = self.table(*[x * math.cos(a) + y * math.sin(a) for a in angles])
        peaks = alone["pseudo_acceleration"].reshape(180, -1)
        table = self.table(x, y, more=["--rotd", ",".join(map(str, self.PERCENTILES))])
        for percentile in self.PERCENTILES:
            error = self.of(table, percentile) / numpy.percentile(peaks, percentile, axis=0) - 1
            self.assertLess(abs(error).max(), 1e-9, percentile)

    def test_axes_do_not_matter(self):
        x, y = noise(3), noise(4)
        turn = math.radians(37)  # whole degrees: the same directions
        first = self.table(x, y, more=["--rotd", "50,100", "--damping", "0.02,0.05"])
        other = self.table(x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn),
                           more=["--rotd", "50,100", "--damping", "0.02,0.05"])
        for damping in (0.02, 0.05):
            for percentile in (50, 100):
                error = self.of(other, percentile, damping) / self.of(first, percentile, damping) - 1
                self.assertLess(abs(error).max(), 1e-9)

    def test_one_direction_alone(self):
        x = noise(5)
        alone = self.table(x)["pseudo_acceleration"]
        table = self.table(x, x, more=["--rotd", "50,100"])
        self.assertLess(abs(self.of(table, 100) / (math.sqrt(2) * alone) - 1).max(), 1e-9)
        median = numpy.median(abs(numpy.cos(numpy.radians(numpy.arange(180) - 45))))
        self.assertLess(abs(self.of(table, 50) / (math.sqrt(2) * median * alone) - 1).max(), 1e-9)

    def test_what_is_no_pair_is_refused(self):
        one = write_columns(self, noise(6))
        short = write_columns(self, noise(7, 900))
        for words, part in (([one], "no pairs"), ([one, short], "no pair"), ([one, one, one], "no pairs"),
                            ([one, one, "--true"], "--true"), ([one, one, "--rotd", "101"], "[0, 100]")):
            result = spectra("--rotd", 50, "--unit", "g", *words)
            self.assertEqual(result.returncode, 1, words)
            self.assertEqual(len(result.stderr.splitlines()), 1)
            self.assertIn(part, result.stderr)


class OfARun(unittest.TestCase):
    def test_probes(self):
        folder, _ = program.must_run(self, [
            "-structures", "bar", "-bar_mesh", "tests/meshes/box.geo", "-bar_clamp", "z_min", "-bar_body_element", "hex8",
            "-bar_body_material", "stuff", "-material_stuff_young", 1e7, "-material_stuff_poisson", 0.2,
            "-material_stuff_density", 2000, "-probes", "top", "-top_structure", "bar", "-top_group", "z_max",
            "-bar_initial_velocity", "0.2,0.5,0", "-time_step", 1e-4, "-end_time", 0.2, "-modes", 0])
        table = computed(self, f"{folder}/history.h5", "--rotd", "50,100", *Rotated.ALL)
        self.assertEqual(set(table["probe"]), {"top"})
        self.assertEqual(set(table["direction"]), {"rotd50", "rotd100"})
        both = computed(self, f"{folder}/history.h5", "--channels", "top.x,top.y", *Rotated.ALL)
        largest = both["pseudo_acceleration"].reshape(2, -1).max(axis=0)
        self.assertTrue((table["pseudo_acceleration"][table["direction"] == "rotd100"] >= largest * (1 - 1e-12)).all())


if __name__ == "__main__":
    unittest.main()
