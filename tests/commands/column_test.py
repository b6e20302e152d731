"""Columns of layers whose moduli agree with their strains (run/column): numbers of other programs, energy, an integration by other
matrices and one in time, the soils that a study takes, and mistakes in one line."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy
import yaml

import program
from references import shake2000_column

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding import UserError  # noqa: E402
from pounding.column import answer, column_file, curves, iteration, motions  # noqa: E402
from pounding.column.waves import Column, Given, Waves  # noqa: E402
from pounding.fragility import study, study_file  # noqa: E402
from pounding.motion_signals import response_spectra  # noqa: E402

CURVES = Path(program.SOURCE, "petsc-options", "curves")
STEP = 0.01


def record(seed=3, length=12.0, peak=3.0):
    """Noise from .3 to 8 Hz that rises for 2 s and fades from 6 s on."""
    time = numpy.arange(0, length, STEP)
    frequency = numpy.fft.rfftfreq(len(time), STEP)
    noise = numpy.fft.rfft(numpy.random.default_rng(seed).standard_normal(len(time)))
    signal = numpy.fft.irfft(noise * frequency**2 / (0.1 + frequency**2) / (1 + (frequency / 8)**4), len(time))
    signal *= numpy.clip(time / 2, 0, 1) * numpy.exp(-0.8 * numpy.maximum(time - 6, 0))
    return peak * signal / abs(signal).max()


def column_of(*rows):
    """A column of rows of thickness, density, speed and damping, the last one a half-space."""
    thickness, density, speed, damping = numpy.array(rows, float).T
    return Column(thickness[:-1], density, density * speed**2, damping)


# Sample of SHAKE91 with its final moduli [ksf] and damping [%]; feet, kcf, 32.2 ft/s2.
SHAKE91 = column_of(*((h, w / 32.2, (g / (w / 32.2)) ** 0.5, d / 100) for h, w, g, d in zip(
    [5, 5] + [10] * 14, [.125] * 8 + [.130] * 8,
    [3851.5, 3020.0, 2803.8, 2985.8, 3621.7, 3540.5, 4296.0, 4239.8, 5402.8, 5266.1, 6288.3, 6203.6, 7357.0, 7290.6, 8570.2, 11292.4],
    [.7, 1.4, 2.3, 2.8, 3.0, 3.5, 3.4, 3.7, 3.4, 3.7, 3.4, 3.5, 3.2, 3.3, 3.0, 2.6])), (0, .140 / 32.2, 4000, .008))


class Transfer(unittest.TestCase):
    def waves(self, column, *frequencies, outcrop=True, at=None):
        return Waves(column, 2 * numpy.pi * numpy.array(frequencies), Given(len(column.thickness) if at is None else at, outcrop))

    def test_a_layer_on_rock(self):
        """Numbers of other programs, and the closed form."""
        column = column_of((30, 2000, 200, .05), (0, 2200, 1000, .01))
        found = self.waves(column, .5, 1.5, 5 / 3, 2)
        within = abs(found.within(0) / found.within(1))
        for value, ratio, known in zip(numpy.concatenate([within, abs(found.within(0))]), (1, 1, 1, 1) * 2,
                                       ("1.1216", "5.771", "12.715", "3.116", "1.1150", "3.412", "3.833", "2.412")):
            self.assertEqual(f"{value:.{len(known.split('.')[1])}f}", known, ratio)
        modulus = column.modulus * (1 - 2 * column.damping**2 + 2j * column.damping * numpy.sqrt(1 - column.damping**2))
        speed = numpy.sqrt(modulus / column.density)
        phase = found.omega * 30 / speed[0]
        step = column.density[0] * speed[0] / (column.density[1] * speed[1])
        numpy.testing.assert_allclose(found.within(0), 1 / (numpy.cos(phase) + 1j * step * numpy.sin(phase)), rtol=1e-12)
        numpy.testing.assert_allclose(found.within(0) / found.within(1), 1 / numpy.cos(phase), rtol=1e-12)

    def test_the_column_of_shake91(self):
        found = abs(self.waves(SHAKE91, 0, 1, 2, 3, 5).within(0))
        numpy.testing.assert_allclose(found, [1, 1.328, 3.322, 1.738, 2.048], rtol=1e-3)
        self.assertAlmostEqual(found[0], 1, delta=1e-12)

    def test_energy_that_comes_in_is_lost_in_the_layers(self):
        """The flux through the top of the rock, by stress and velocity, is the loss of all layers, by quadrature of the strain."""
        frequencies = numpy.array([.3, 1, 2.2, 5, 12, 40])
        for column in (SHAKE91, column_of((7, 1900, 150, .12), (20, 2000, 320, 0), (9, 1800, 210, .2), (0, 2200, 900, 0.02))):
            found = self.waves(column, *frequencies)
            omega, count = found.omega, len(column.thickness)
            complex_modulus = column.modulus * (1 - 2 * column.damping**2 + 2j * column.damping * numpy.sqrt(1 - column.damping**2))
            nodes, weights = numpy.polynomial.legendre.leggauss(24)
            lost = sum(weight * h / 2 * omega / 2 * complex_modulus[m].imag * abs(found.strain(m, h / 2 * (1 + node)))**2
                       for m, h in enumerate(column.thickness) for node, weight in zip(nodes, weights))
            # Stress is continuous: from the last layer's bottom, where its strain acts on what lies above.
            last = count - 1
            stress = complex_modulus[last] * found.strain(last, column.thickness[last])
            velocity = found.within(count) / (1j * omega)
            come = 0.5 * (stress * velocity.conj()).real
            numpy.testing.assert_allclose(come, lost, rtol=1e-9)
            # And it is what the wave in the rock brings less what it takes, where the rock loses nothing.
            if column.damping[-1] == 0:
                up, down = abs(found.up[-1])**2, abs(found.up[-1] * found.ratio[-1])**2
                numpy.testing.assert_allclose(come, column.density[-1] * column.speed[-1] / 2 * (up - down) / omega**2, rtol=1e-9)

    def test_high_frequencies_of_soft_deep_ground_stay_finite(self):
        found = self.waves(column_of((900, 1800, 120, .3), (0, 2200, 900, .02)), 0, 10, 400)
        for values in (found.within(0), found.within(1), found.strain(0, 450)):
            self.assertTrue(numpy.isfinite(values).all())

    def test_a_motion_given_inside_is_met_there(self):
        column = SHAKE91
        for entry in (0, 5, 16):
            found = self.waves(column, 1, 7, at=entry, outcrop=False)
            numpy.testing.assert_allclose(found.within(entry), 1, rtol=1e-12)
            other = self.waves(column, 1, 7)
            numpy.testing.assert_allclose(found.within(3), other.within(3) / other.within(entry), rtol=1e-9)
        found = self.waves(column, 1, 7, at=5)
        numpy.testing.assert_allclose(found.outcrop(5), 1, rtol=1e-12)
        numpy.testing.assert_allclose(found.within(5), (1 + found.ratio[5]) / 2, rtol=1e-12)


def by_stiffness(column, omega):
    """Displacements at the tops of layers and half-space for an acceleration of 1 of the rock outcrop, shape (frequencies, layers + 1),
    by stiffness matrices of layers (E. Kausel and J. M. Roesset, Bull. Seism. Soc. Am. 71, 1981) in place of waves."""
    shear = column.modulus * (1 - 2 * column.damping**2 + 2j * column.damping * numpy.sqrt(1 - column.damping**2))
    speed = numpy.sqrt(shear / column.density)
    count = len(column.thickness)
    matrix = numpy.zeros((len(omega), count + 1, count + 1), complex)
    for m, h in enumerate(column.thickness):
        k = omega / speed[m]
        own, other = shear[m] * k / numpy.tan(k * h), -shear[m] * k / numpy.sin(k * h)
        matrix[:, m, m] += own
        matrix[:, m + 1, m + 1] += own
        matrix[:, m, m + 1] += other
        matrix[:, m + 1, m] += other
    impedance = 1j * omega * column.density[-1] * speed[-1]
    matrix[:, count, count] += impedance
    force = numpy.zeros((len(omega), count + 1, 1), complex)
    force[:, count, 0] = impedance * -1 / omega**2
    return numpy.linalg.solve(matrix, force)[..., 0], speed


def other_iteration(soil, motion, ratio, rounds):
    """Moduli, damping, largest strains and the surface after so many rounds, by the matrices above, sums of cosines by numpy and curves
    interpolated here."""
    size = 3 * len(motion)
    omega = 2 * numpy.pi * numpy.fft.rfftfreq(size, STEP)[1:]
    spectrum = numpy.fft.rfft(motion, size)
    small, modulus, damping = soil.column, None, None
    effective = numpy.full(len(small.thickness), 1e-9)
    for _ in range(rounds):
        parts = [(numpy.interp(numpy.log10(e), numpy.log10(c.strain), c.modulus),
                  numpy.interp(numpy.log10(e), numpy.log10(c.strain), c.damping)) for e, c in zip(effective, soil.curves)]
        modulus = numpy.append(small.modulus[:-1] * [one[0] for one in parts], small.modulus[-1])
        damping = numpy.append([one[1] for one in parts], small.damping[-1])
        moved, speed = by_stiffness(Column(small.thickness, small.density, modulus, damping), omega)
        largest = []
        for m, h in enumerate(small.thickness):
            k = omega / speed[m]
            strain = (moved[:, m + 1] - moved[:, m]) * k / (2 * numpy.sin(k * h / 2))
            still = small.density[:m] @ small.thickness[:m] + small.density[m] * h / 2  # by inertia alone
            largest.append(abs(numpy.fft.irfft(numpy.append(spectrum[0] * still / modulus[m], spectrum[1:] * strain), size)).max())
        effective = ratio * numpy.array(largest)
    surface = numpy.fft.irfft(numpy.append(spectrum[0], -omega**2 * moved[:, 0] * spectrum[1:]), size)
    return modulus, damping, numpy.array(largest), surface


class Iteration(unittest.TestCase):
    def soil(self, curve, *rows):
        column = column_of(*rows)
        return iteration.Soil(column, (curve,) * len(column.thickness), tuple(map(str, range(len(rows)))))

    def iterate(self, soil, motion, tolerance=1e-9, most=200, ratio=0.65):
        rock = len(soil.column.thickness)
        return iteration.iterate(soil, motion, STEP, Given(rock, True), Given(0, True), iteration.Rule(ratio, tolerance, most))

    def test_two_columns_are_found_again_by_other_matrices(self):
        sand = curves.read("sand", CURVES / "epri93_20_50ft.csv")
        clay = curves.read("clay", CURVES / "vucetic_dobry_pi30.csv")
        for curve, rows, peak, ratio in ((sand, [(2, 1950, 220 + 15 * k, 0) for k in range(10)] + [(0, 2200, 760, .01)], 3.5, 0.65),
                                  (clay, [(1.5, 1750, 140 + 12 * k, 0) for k in range(12)] + [(0, 2100, 600, .01)], 3.5, 0.5)):
            soil, motion = self.soil(curve, *rows), record(5, peak=peak)
            found = self.iterate(soil, motion, 1e-10, ratio=ratio)
            modulus, damping, strain, surface = other_iteration(soil, motion, ratio, found.iterations)
            self.assertGreater(strain.max(), 1e-3)
            self.assertLess((modulus / soil.column.modulus).min(), 0.65)
            numpy.testing.assert_allclose(found.column.modulus, modulus, rtol=1e-5)
            numpy.testing.assert_allclose(found.column.damping, damping, rtol=1e-5)
            numpy.testing.assert_allclose(found.strain, strain, rtol=1e-5)
            numpy.testing.assert_allclose(found.surface[:len(motion)], surface[:len(motion)], atol=1e-4 * peak)

    def test_the_sample_of_another_program(self):
        found = next(Path(program.SHARED).glob("records/**/DIAM.ACC"), None)
        if found is None:
            self.skipTest("no record DIAM.ACC")
        deviations = shake2000_column.deviations(found)
        self.assertLess(abs(deviations["moduli"]).max(), 3e-4)
        self.assertLess(abs(deviations["strains"]).max(), 2e-3)
        self.assertLess(abs(deviations["accelerations"]).max(), 1e-4)

    def test_curves_that_know_no_strain_are_the_linear_column(self):
        flat = curves.Curve("flat", numpy.array([1e-6, 1e-2]), numpy.array([1., 1]), numpy.array([.05, .05]))
        rows = [(3, 1900, 200, .05), (4, 2000, 260, .05), (0, 2200, 800, .01)]
        found = self.iterate(self.soil(flat, *rows), record())
        linear = self.iterate(self.soil(None, *rows), record())
        self.assertEqual(found.iterations, 1)
        numpy.testing.assert_allclose(found.surface, linear.surface, atol=1e-13)
        twice = self.iterate(self.soil(flat, *rows), 2 * record())
        numpy.testing.assert_allclose(twice.surface[:1200], 2 * linear.surface[:1200], atol=1e-13)

    def test_an_elastic_column_is_that_of_waves_followed_in_time(self):
        """Layers through which a wave takes whole steps: up and down waves handed on from step to step, no frequencies."""
        column = column_of((4 * STEP * 200, 1900, 200, 0), (3 * STEP * 300, 2000, 300, 0), (0, 2300, 900, 0))
        motion = record()
        impedance = column.density * column.speed
        up, down = [numpy.zeros(4), numpy.zeros(3)], [numpy.zeros(4), numpy.zeros(3)]  # on their way, the first about to arrive
        expected = []
        for value in motion:
            arrives_up, arrives_down = [one[0] for one in up], [one[0] for one in down]
            expected.append(2 * arrives_up[0])
            a, b = impedance[0], impedance[1]  # down in 0 and up in 1 meet: velocities as continuous stress and motion ask for
            up0, down1 = ((a - b) * arrives_down[0] + 2 * b * arrives_up[1]) / (a + b), (2 * a * arrives_down[0] + (b - a) * arrives_up[1]) / (a + b)
            a, b = impedance[1], impedance[2]
            up1 = ((a - b) * arrives_down[1] + 2 * b * value / 2) / (a + b)
            up = [numpy.append(one[1:], new) for one, new in zip(up, (up0, up1))]
            down = [numpy.append(one[1:], new) for one, new in zip(down, (arrives_up[0], down1))]
        found = self.iterate(self.soil(None, *((h, rho, c, 0) for h, rho, c in zip((*column.thickness, 0), column.density, column.speed))), motion)
        numpy.testing.assert_allclose(found.surface[:len(motion)], expected, atol=1e-9)

    def test_what_does_not_settle_is_told(self):
        steep = curves.Curve("steep", numpy.array([1e-5, 1.2e-3]), numpy.array([1., .05]), numpy.array([.01, .2]))
        with self.assertRaisesRegex(curves.ColumnError, "after 3 iterations layer 0 still changes by .* %"):
            self.iterate(self.soil(steep, (5, 1900, 200, .02), (0, 2200, 800, .01)), record(), most=3)


GROUND = """
layers:
  - {name: fill, thickness: 6, vs: 180, density: 1900, curve: sand}
  - {name: till, thickness: 10, g: 2.6e8, density: 2050, damping: 0.03}
halfspace: {vs: 900, density: 2200, damping: 0.01}
curves: {sand: sand.csv}
motions:
  x: {records: [one.csv, two.csv], options: {unit: m/s2}}
  z: {records: [one.csv, two.csv], ratio: 0.7, options: {unit: m/s2}}
level: 2
mats: {depth: 4, over: 12, poisson: 0.35, structures: left, tables: {right: "right-{}.csv"}}
"""


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "sand.csv").write_bytes((CURVES / "seed_idriss_sand_mean.csv").read_bytes())
        for seed, name in ((1, "one.csv"), (2, "two.csv")):
            self.write_record(name, record(seed))

    def write_record(self, name, values, step=STEP):
        (self.folder / name).write_text("time,acceleration\n" + "".join(f"{step * k:.9g},{a:.12g}\n" for k, a in enumerate(values)))

    def ran(self, text=GROUND):
        (self.folder / "ground.yaml").write_text(text)
        return program.command("column", "ground.yaml", "--out", "out", cwd=self.folder)

    def rows(self, name):
        with open(self.folder / "out" / name) as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def test_tables_motions_and_soils_of_a_study(self):
        result = self.ran()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(len([line for line in result.stdout.splitlines() if " iterations, peak 2 m/s2" in line]), 6)
        ground = column_file.read(self.folder / "ground.yaml")
        best = self.rows("best.csv")
        self.assertEqual(float(best[-1]["top"]), 16)
        self.assertIn("4", [row["top"] for row in best])
        # The table is what the library finds for the two motions, in the geometric mean.
        signals = [2 * record(seed) / abs(record(seed)).max() for seed in (1, 2)]
        found = [iteration.iterate(ground.estimates()["best"], one, STEP, ground.given, ground.at_mats, ground.rule) for one in signals]
        numpy.testing.assert_allclose([float(row["modulus"]) for row in best],
                                      numpy.sqrt(found[0].column.modulus * found[1].column.modulus), rtol=1e-6)
        mats = numpy.array([float(row["mats"]) for row in self.rows("motions/best-x2-two.csv")])
        numpy.testing.assert_allclose(mats, found[1].mat, atol=1e-6)
        # Upper and lower estimates at small strain, and half-spaces by the way of a wave through 12 m below the mats.
        for name, factor in (("upper", 1.5), ("lower", 1 / 1.5)):
            for one, other in zip(self.rows(f"{name}.csv"), best):
                self.assertAlmostEqual(float(one["vs_small_strain"]) / float(other["vs_small_strain"]), factor**.5, delta=1e-6)
        soils = yaml.safe_load((self.folder / "out" / "soils.yaml").read_text())["soils"]
        self.assertEqual(list(soils), ["best", "upper", "lower"])
        options = soils["best"]["options"]
        below = [row for row in best if float(row["top"]) >= 4 and row["thickness"]]
        self.assertAlmostEqual(options["left_soil"]["vs"], 12 / sum(float(row["thickness"]) / float(row["vs"]) for row in below), delta=1e-2)
        self.assertEqual(options["right_soil_table"], str(self.folder.resolve() / "right-best.csv"))
        # A study takes the block, scales the motions to their peaks, and reads the column of the mats.
        scene = self.folder / "scene.yaml"
        scene.write_text('left: {mesh: a.geo, soil: {mat: base, vs: 300, density: 2000, poisson: 0.3}}\n')
        axes = soils["lower"]["motions"]
        self.assertEqual(axes["z"], {"records": [str(self.folder / name) for name in ("one.csv", "two.csv")], "ratio": 0.7,
                                     "options": {"unit": "m/s2"}})
        read, *_, count = study.read_motions(study_file.Reader({"motions": axes}, scene, "", ("motions",)))
        self.assertEqual((list(read), count), (["x", "z"], 2))
        for number, file in enumerate(axes["x"]["records"]):
            peak = max(abs(float(row["mats"])) for row in self.rows(file))
            self.assertAlmostEqual(2 * read["x"].ratio_of(number), peak, delta=1e-6)
        samples = self.folder / "samples.csv"
        subprocess.run([os.path.join(program.BUILD, "pounding-spectra"), "--unit", "m/s2", "--columns", "2", "--frequencies", "1",
                        "--samples", samples, "--output", self.folder / "spectra.csv", axes["x"]["records"][1]], check=True)
        with open(samples) as lines:
            read_again = [float(row["acceleration"]) for row in csv.DictReader(lines)]
        numpy.testing.assert_array_equal(read_again, [float(row["mats"]) for row in self.rows(axes["x"]["records"][1])])

    def test_shipped_files_are_read(self):
        for name, count in (("plant/ground.yaml", 16), ("new/joint-review/ground.yaml", 12)):
            ground = column_file.read(Path(program.SOURCE, "petsc-options", name))
            self.assertEqual((len(ground.soil.curves), len(ground.mats.structures), list(ground.axes)), (count, 2, ["x", "y"]))

    def test_what_a_study_takes(self):
        scene = self.folder / "study.yaml"
        axis = {"records": ["one.csv", "two.csv"], "ratio": [1.5]}
        with self.assertRaisesRegex(UserError, "ratio: .* are 1 of 2 records"):
            study.read_motions(study_file.Reader({"motions": {"x": axis}}, scene, "", ("motions",)))
        for text, told in (("soils: {}\nother: 1\n", "is no file with a block `soils`"), (None, "No such file")):
            if text:
                (self.folder / "soils.yaml").write_text(text)
            with self.assertRaisesRegex(UserError, told):
                study.soils_of(study_file.Reader({"soils": "soils.yaml" if text else "none.yaml"}, scene, "", ("soils",)))
        (self.folder / "soils.yaml").write_text("soils: {best: {factor: 2}}\n")
        found = study.soils_of(study_file.Reader({"soils": "soils.yaml"}, scene, "", ("soils",)))
        self.assertEqual(found, {"best": {"factor": 2}})

    def test_synthetic_motions_are_those_of_the_program(self):
        """The spectrum follows the target, and the peak is that of the level; records without a level are as recorded."""
        target = Path(program.SOURCE, "petsc-options", "spectra", "rg160.csv")
        text = GROUND.replace("x: {records: [one.csv, two.csv], options: {unit: m/s2}}",
                              f"x: {{target: {target}, seeds: [4, 5], ratio: 1.5, options: {{duration: 20}}}}")
        (self.folder / "ground.yaml").write_text(text)
        signals = motions.signals_of(column_file.read(self.folder / "ground.yaml"))
        for one in signals.values():
            self.assertAlmostEqual(one.peak, 3, delta=1e-12)
        self.assertLess(abs(numpy.corrcoef(signals["x", 0].values[:3900], signals["x", 1].values[:3900])[0, 1]), 0.3)
        points = numpy.loadtxt(target, delimiter=",", skiprows=4)
        frequency, found = response_spectra(list(signals.values()), "1,2,4,8,16", 0.05, Path(program.BUILD, "pounding-spectra"))
        wanted = 3 * numpy.exp(numpy.interp(numpy.log(frequency), *numpy.log(points).T))
        numpy.testing.assert_allclose(found.mean(0), wanted, rtol=0.15)
        (self.folder / "ground.yaml").write_text(GROUND.replace("level: 2\n", ""))
        signals = motions.signals_of(column_file.read(self.folder / "ground.yaml"))
        self.assertAlmostEqual(signals["x", 1].peak, 3, delta=1e-9)
        (self.folder / "ground.yaml").write_text(text.replace("level: 2\n", ""))
        with self.assertRaisesRegex(UserError, "level is missing"):
            column_file.read(self.folder / "ground.yaml")

    def test_numbers_beyond_those_that_are_meant_are_doubted(self):
        result = self.ran(GROUND.replace("level: 2", "level: 14") + "thickest: 20\ncv: 0\n")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, "warning: best: a shear strain of .* % in fill; equivalent linear ground is not meant for more than 1 %")
        self.assertRegex(result.stdout, "warning: best: waves take .* ms through a sublayer of fill, 4 m thick")
        (self.folder / "sand.csv").write_text("strain,modulus,damping\n1e-6,1,0.01\n1e-4,0.8,0.04\n")
        (self.folder / "ground.yaml").write_text(GROUND.replace("level: 2", "level: 0.2"))
        ground = column_file.read(self.folder / "ground.yaml")
        self.assertEqual(column_file.doubts_of(ground), ["a level of 0.2 m/s2 (in g?)"])
        signals = motions.signals_of(ground)
        best = answer.estimate(ground, "best", ground.soil, signals)
        self.assertEqual(answer.doubts_of(best, signals, ground.rule.ratio), [])
        signals = {key: replace(one, values=20 * one.values) for key, one in signals.items()}
        doubts = answer.doubts_of(answer.estimate(ground, "best", ground.soil, signals), signals, ground.rule.ratio)
        self.assertEqual(doubts, ["best: effective strains in fill are beyond the last of curve sand, 0.01 %, whose values go on"])

    def refused(self, old, new, *parts):
        self.assertIn(old, GROUND)
        (self.folder / "ground.yaml").write_text(GROUND.replace(old, new))
        with self.assertRaises((UserError, OSError)) as told:
            motions.signals_of(column_file.read(self.folder / "ground.yaml"))
        for part in parts:
            self.assertIn(part, str(told.exception))
        self.assertNotIn("\n", str(told.exception))

    def test_mistakes_in_one_line(self):
        result = self.ran(GROUND.replace("vs: 180", "vs: 0.18"))
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), result.stderr)
        self.assertIn("run/column: ground.yaml: layers: fill: vs: 0.18", result.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.refused("vs: 180", "vs: 0.18", "layers: fill: vs: 0.18 is not from 10 to 10000 m/s; in km/s?")
        self.refused("density: 1900", "density: 1.9", "layers: fill: density", "in t/m3?")
        self.refused("damping: 0.03", "damping: 3", "layers: till: damping: 3", "in %?")
        self.refused("g: 2.6e8", "g: 260", "layers: till: g", "in MPa?")
        self.refused("g: 2.6e8", "g: 2.6e8, vs: 300", "one of the two")
        self.refused("curve: sand", "curve: snad", "'snad' is none of sand")
        self.refused("curve: sand", "curve: sand, damping: 0.02", "is that of the curve")
        self.refused("sand.csv}", "nowhere.csv}", "nowhere.csv", "No such file")
        self.refused("depth: 4", "depth: 40", "lie below the layers, which are 16 m thick")
        self.refused("level: 2", "level: 2\ninput: {at: rock}", "input: at: 'rock' is none of fill, till, halfspace")
        self.refused("level: 2", "levels: 2", "levels is unknown")
        self.refused("two.csv], options", "three.csv], options", "three.csv: no such file")
        self.write_record("short.csv", record()[300:340])
        self.refused("two.csv], options", "short.csv], options", "motion short: 0.39 s are too short for a column")
        self.write_record("coarse.csv", record(length=20)[::8], 8 * STEP)
        self.refused("two.csv], options", "coarse.csv], options", "motion coarse: a step of 0.08 s is too coarse for layers")

    def test_mistakes_in_curves(self):
        for row, told in (("0.02,0.05,0.2", "strain 0.02 does not increase"), ("1,0.05,0.2", "in %?"), ("0.05,0.05,20", "in %?"),
                          ("0.05,1.2,0.2", "a modulus of 1.2"), ("0.05,x,0.2", "is not three numbers")):
            (self.folder / "sand.csv").write_text(f"strain,modulus,damping\n1e-5,1,0.01\n0.03,0.1,0.2\n{row}\n")
            self.refused("level: 2", "level: 2", "sand.csv, line 4", told)
        (self.folder / "sand.csv").write_text("gamma,modulus,damping\n")
        self.refused("level: 2", "level: 2", "line 1", "strain, modulus, damping")


if __name__ == "__main__":
    unittest.main()
