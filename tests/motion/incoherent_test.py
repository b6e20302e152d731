"""Motions of rigid mats on incoherent ground (run/incoherent): published numbers, statistics of many seeds against the
formulas, rest before and after, the coherent motion through the same path, and the program on what is written."""
import csv
import json
import os
import re
import sys
import tempfile
import unittest

import numpy

import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding import coherency, incoherent, mats  # noqa: E402

ROCK = coherency.model_of("abrahamson_2007_hard_rock")
STEP = 0.01
PAIR = (incoherent.Mat("west", (0, 0, -1), (30.4, 26.4)), incoherent.Mat("east", (30.5, 0, -1), (30.4, 26.4)))


def record(seed=3, length=25.0):
    """Filtered noise that sets in at 3 s, is strong from 5 to 12 s and fades."""
    random = numpy.random.default_rng(seed)
    time = numpy.arange(0, length, STEP)
    frequency = numpy.fft.rfftfreq(len(time), STEP)
    spectrum = numpy.fft.rfft(random.standard_normal(len(time))) * frequency**2 / (1 + frequency**2) / (1 + (frequency / 12)**4)
    envelope = numpy.clip((time - 3) / 3, 0, 1)**2 * numpy.where(time < 12, 1, numpy.exp(-0.4 * (time - 12)))
    return 3 * numpy.fft.irfft(spectrum, len(time)) * envelope


def strong_part(signal):
    """5 to 75 % of the Arias intensity."""
    energy = numpy.cumsum(signal**2) / numpy.sum(signal**2)
    return slice(int(numpy.searchsorted(energy, 0.05)), int(numpy.searchsorted(energy, 0.75)) + 1)


def way_of(signal):
    """Velocity and displacement of straight lines between the samples."""
    velocity = numpy.concatenate([[0], numpy.cumsum(STEP * (signal[1:] + signal[:-1]) / 2)])
    return velocity, numpy.cumsum(STEP * (velocity[1:] + velocity[:-1]) / 2 - STEP**2 / 12 * (signal[1:] - signal[:-1]))


class Models(unittest.TestCase):
    def test_the_formula_of_hard_rock_at_published_points(self):
        for way, distance, frequency, value in (("horizontal", 10, 20, .6407), ("vertical", 10, 20, .6758),
                                                ("vertical", 10, 30, .4538), ("vertical", 25, 30, .2221)):
            self.assertAlmostEqual(float(ROCK.gamma(way, frequency, numpy.array(distance))), value, delta=5e-5)

    def test_a_table_is_the_formula_that_it_was_made_of(self):
        formula = coherency.luco_wong(0.2, 600.0)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table.csv")
            with open(path, "w", newline="") as file:
                rows = csv.writer(file)
                rows.writerow(["frequency", "distance", "horizontal"])
                rows.writerows([f, xi, float(formula.gamma("horizontal", f, xi))] for f in range(0, 21) for xi in range(0, 41))
            table = coherency.model_of({"table": "table.csv"}, coherency.Path(folder))
        for frequency, distance in ((5, 10.0), (7.5, 12.3), (20, 40.0)):
            self.assertAlmostEqual(float(table.gamma("vertical", frequency, numpy.array(distance))),
                                   float(formula.gamma("vertical", frequency, distance)), delta=2e-3)

    def test_a_table_that_is_no_text_is_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            for content in (b"frequency,distance,horizontal\n1,2,\xff\n", b"frequency,distance,horizontal\n1,2,\0\n"):
                with open(os.path.join(folder, "table.csv"), "wb") as file:
                    file.write(content)
                with self.assertRaisesRegex(coherency.CoherencyError, "table.csv: needs columns"):
                    coherency.model_of({"table": "table.csv"}, coherency.Path(folder))

    def test_two_mats_of_a_plant(self):
        frequencies = [1., 2, 3, 5, 8, 10]
        for axis in "xy":
            spectra = incoherent.factors_of(PAIR, ROCK, numpy.array(frequencies), (axis,))[axis].spectra()
            west, east, both = spectra[:, 0, 0], spectra[:, 2, 2], spectra[:, 0, 2]
            numpy.testing.assert_allclose(numpy.sqrt(west + east - 2 * both), [.011, .039, .081, .200, .411, .529], atol=6e-4)
            numpy.testing.assert_allclose(numpy.sqrt(west)[[3, 5]], [.996, .954], atol=6e-4)

    def test_a_finer_integral_over_the_mats_is_the_same(self):
        def spectra():
            return incoherent.factors_of(PAIR, ROCK, numpy.array([5., 20.]), ("z",))["z"].spectra()
        coarse = spectra()
        points, incoherent.POINTS = incoherent.POINTS, 20
        try:
            numpy.testing.assert_allclose(spectra(), coarse, atol=2e-4 * abs(coarse).max())
        finally:
            incoherent.POINTS = points


class Statistics(unittest.TestCase):
    def check(self, seeds, errors, **records):
        for axis, signal in records.items():
            factors = incoherent.factors_of(PAIR, ROCK, incoherent.grid(0.5 / STEP), (axis,))[axis]
            noise, window = incoherent.Noise(signal, STEP), strong_part(signal)
            translation, relative, before = [], [], []
            for seed in range(seeds):
                made = incoherent.motions(signal, STEP, factors, noise, numpy.random.default_rng([seed, 0]))
                west, east = made["west", axis], made["east", axis]
                translation.append(numpy.mean(west[window]**2))
                relative.append(numpy.mean((west - east)[window]**2))
                onset = int(numpy.argmax(signal != 0))
                before.append(max(abs(one[:onset + 1]).max() / abs(one).max() for one in made.values()))
            self.assertLess(max(before), 1e-3)
            whole = numpy.fft.rfft(signal, 4 * len(signal))
            frequency = numpy.fft.rfftfreq(4 * len(signal), STEP)
            spectra = factors.spectra().real
            of = [k for k, name in enumerate(factors.names) if name[1] == axis]
            for found, part in ((translation, spectra[:, of[0], of[0]]),
                                (relative, spectra[:, of[0], of[0]] + spectra[:, of[1], of[1]] - 2 * spectra[:, of[0], of[1]])):
                # The record with the root of the formula's spectrum, in the window.
                root = numpy.sqrt(numpy.interp(frequency, factors.frequencies, part))
                expected = numpy.mean(numpy.fft.irfft(whole * root, 4 * len(signal))[window]**2)
                self.assertLess(abs(numpy.mean(found) - expected), errors * numpy.std(found) / numpy.sqrt(seeds), (axis, expected))

    def test_a_few_seeds(self):
        self.check(20, 3, x=record())

    @program.long
    def test_two_hundred_seeds(self):
        self.check(200, 3, x=record(), y=record(4), z=record(5))


class Motions(unittest.TestCase):
    RECORDS = {axis: record(seed) for axis, seed in zip("xyz", (3, 4, 5))}

    def made(self, model=ROCK, mats_=PAIR, wave=None, seed=1):
        factors = incoherent.factors_of(mats_, model, incoherent.grid(0.5 / STEP), tuple(self.RECORDS), wave)
        return incoherent.base_motions(self.RECORDS, STEP, factors, seed)

    def test_a_coherent_ground_moves_all_alike(self):
        for motion in self.made(coherency.model_of("coherent")).values():
            for name, values in motion.items():
                record_ = self.RECORDS.get(name, numpy.zeros(len(self.RECORDS["x"])))
                count, peak = len(record_), abs(self.RECORDS["x"]).max()
                numpy.testing.assert_allclose(values[:count], record_, atol=1e-12 * peak)
                self.assertLess(abs(values[count + 2:]).max(), 1e-15 * peak)
                velocity, _ = way_of(values)
                self.assertAlmostEqual(velocity[-1], way_of(record_)[0][-1], delta=1e-12 * peak)

    def test_mats_come_to_rest_where_the_record_does(self):
        coherent = self.made(coherency.model_of("coherent"))
        for mat, motion in self.made().items():
            for name, values in motion.items():
                apart = values - coherent[mat][name]
                velocity, displacement = way_of(apart)
                self.assertGreater(abs(displacement).max(), 1e-6)
                self.assertLess(abs(velocity[-1]), 1e-9 * abs(velocity).max())
                self.assertLess(abs(displacement[-1]), 1e-9 * abs(displacement).max())
                self.assertLess(abs(values[-1]), 1e-20)

    def test_a_seed_gives_the_same_motions_and_another_one_others(self):
        first, again, other = self.made(), self.made(), self.made(seed=2)
        numpy.testing.assert_array_equal(first["east"]["rz"], again["east"]["rz"])
        self.assertGreater(abs(first["east"]["x"] - other["east"]["x"]).max(), 0.1)

    def test_a_wave_arrives_later(self):
        small = tuple(incoherent.Mat(name, (10.0 * place, 0, 0), (0.1, 0.1)) for place, name in enumerate("ab"))
        made = self.made(coherency.model_of("coherent"), small, incoherent.Wave(100.0, (1, 0)))
        numpy.testing.assert_allclose(made["b"]["x"][10:], made["a"]["x"][:-10], atol=0.01 * abs(self.RECORDS["x"]).max())

    def test_a_mat_turns_with_a_wave(self):
        """A wave of 200 m/s along x turns a mat about y and z by the slope of the ground, as long as it is slow."""
        pair = (PAIR[0], incoherent.Mat("far", (60, 0, 0), (1, 1)))
        factors = incoherent.factors_of(pair, coherency.model_of("coherent"), numpy.array([0.05]), ("y", "z"), incoherent.Wave(200., (1, 0)))
        for axis, name, sign in (("y", "rz", -1), ("z", "ry", 1)):
            of = dict(zip(factors[axis].names, factors[axis].told[0]))
            slope = of["west", name] / of["west", axis]
            expected = sign * 2j * numpy.pi * 0.05 / 200 * (1 if axis == "z" else 30.4**2 / (30.4**2 + 26.4**2))
            self.assertAlmostEqual(slope, expected, delta=2e-3 * abs(expected))


class Command(unittest.TestCase):
    FILE = ("mats:\n  west: {centre: '0,0,0', sides: '30.4,26.4', groups: left}\n"
            "  east: {centre: '30.5,0,0', sides: '30.4,26.4', groups: right}\n"
            "motion:\n  x: {record: x.txt, unit: m/s2}\n  y: {record: y.txt, unit: m/s2}\n  z: {record: z.txt, unit: m/s2}\n"
            "model: abrahamson_2007_hard_rock\n")

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name
        for axis, seed in zip("xyz", (3, 4, 5)):
            self.write_record(axis, record(seed), STEP)

    def write_record(self, axis, values, step):
        numpy.savetxt(os.path.join(self.folder, f"{axis}.txt"), numpy.column_stack([step * numpy.arange(len(values)), values]),
                      ["%.6f", "%.17g"])

    def command(self, text, *words):
        path = os.path.join(self.folder, "mats.yaml")
        with open(path, "w") as file:
            file.write(text)
        return program.command("incoherent", path, "--out", os.path.join(self.folder, "out"), *words)

    def test_the_program_moves_the_mats_so(self):
        program.well_ended(self, self.command(self.FILE))
        with open(os.path.join(self.folder, "out", "east.csv")) as file:
            names = file.readline().strip().split(",")
            columns = dict(zip(names, numpy.loadtxt(file, delimiter=",").T))
        expected = Motions.RECORDS["x"]
        factors = incoherent.factors_of(PAIR, ROCK, incoherent.grid(0.5 / STEP), ("x", "y", "z"))
        made = incoherent.base_motions(Motions.RECORDS, STEP, factors, 1)["east"]
        for name in mats.COMPONENTS:
            numpy.testing.assert_allclose(columns[name], made[name], atol=1e-7 * abs(expected).max())
        with open(os.path.join(self.folder, "point.geo"), "w") as file:
            file.write('Point(1) = {0, 0, 0};\nPhysical Point("mass") = {1};\nPhysical Point("foot") = {1};\n')
        words = ["-options_file", os.path.join(self.folder, "out", "supports.yaml"), "-structures", "left,right", "-contacts", "none"]
        for side in ("left", "right"):
            words += [f"-{side}_mesh", os.path.join(self.folder, "point.geo"), f"-{side}_mass_element", "point_mass",
                      f"-{side}_mass_mass", 1e3, f"-{side}_foot_element", "grounded_spring", f"-{side}_foot_stiffness", "1e7,1e7,1e7"]
        for axis in "xyz":
            words += [f"-motion_{axis}_record", os.path.join(self.folder, f"{axis}.txt"), f"-motion_{axis}_unit", "m/s2"]
        output = os.path.join(self.folder, "run")
        program.must_end(self, [*words, "-output", output, "-end_time", 1, "-modes", 0])
        told = {one["component"]: one for one in program.summary(output)["supports"]}
        self.assertEqual(len(told), 12)
        for name, expected in (("x", made["x"]), ("rz", made["rz"])):
            one = told[f"support ground_east, {name}"]
            self.assertIn("east.csv", one["source"])
            signal = expected.copy()
            if name == "x":
                signal[:len(Motions.RECORDS["x"])] -= Motions.RECORDS["x"]
            largest = abs(way_of(signal)[1]).max()
            self.assertAlmostEqual(one["largest"], largest, delta=1e-3 * largest)

    def refused(self, text, *told):
        result = self.command(text)
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        for one in told:
            self.assertIn(one, lines[0])

    def test_wrong_use_is_told_in_one_line(self):
        self.refused(re.sub("  east.*\n", "", self.FILE), "mats:", "there is one", "two or more")
        self.refused(self.FILE.replace("abrahamson_2007_hard_rock", "abramson"), "model: 'abramson' is unknown", "luco_wong")
        self.refused(self.FILE.replace("sides: '30.4,26.4', groups: right", "sides: '30.4'"), "mats: east: sides", "2 numbers above 0")
        self.refused(self.FILE.replace("30.5,0,0", "305,0,0"), "335.8 m apart", "150 m")
        self.refused(self.FILE.replace("abrahamson_2007_hard_rock", "{luco_wong: {gamma: 0.2}}"), "luco_wong", "vs [m/s]")
        self.refused(re.sub("motion:.*\n.*\n.*\n.*\n", "", self.FILE), "motion: needs records")
        self.refused(self.FILE.replace("motion:", "motions:"), "motions is unknown; it has mats, model, wave, seed, motion")
        self.refused(self.FILE.replace("  east:", "  west:"), "west stands twice")
        self.refused(self.FILE.replace("unit: m/s2}\n  y", "units: m/s2}\n  y"), "motion: x: units is unknown")
        self.write_record("y", record(4), 0.005)
        self.refused(self.FILE, "motion: the records have different steps", "y 0.005 s", "give records of one step")


if __name__ == "__main__":
    unittest.main()
