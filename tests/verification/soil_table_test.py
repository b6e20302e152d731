"""Soil fitted by run/soil to a table of impedances over the frequency: the program's own half-space given back as a table,
coupled soil of springs, dashpots and masses against the solution over the frequency, rest, modes, matrices, restart.

As in soil_test.py, a body is shaken by one short pulse until it rests; sums over all steps obey the scheme with
4 sin^2(omega h / 2) / h^2 in the place of omega^2, and nothing is lost by windows.
"""
import math
import tempfile
import unittest

import numpy
import scipy.io

import program
from decks import clock, in_modes, probes
from recorded import Recorded, assert_continues, write_samples
from soil_tables import cell, coupled, write_soil

MASS, INERTIA = 2e6, 1e8
STEP, END = 1e-3, 12.0
TESTED = 2 * math.pi * numpy.array([1.0, 2.0, 3.5, 5.0, 7.0])


def pulse(steps=int(END / STEP)):
    width = 0.03
    times = STEP * numpy.arange(steps + 2)
    return numpy.exp(-((times - 7 * width) / width)**2)


def of_summary(soil):
    """Impedance of a half-space by the numbers of the report."""
    keys = ("stiffness", "dashpot", "inner_dashpot", "inner_mass", "moving_mass")
    return lambda omega: numpy.diag([cell(omega, *(soil[key][c] for key in keys)) for c in range(6)])


def body(*more):
    return ["-structures", "block", "-block_mesh", "tests/meshes/mat.geo", "-block_body_element", "point_mass",
            "-block_body_mass", MASS, "-block_body_rotary_inertia", f"{INERTIA!r},{INERTIA!r},{INERTIA!r}",
            *clock(STEP, END), "-energy_interval", 50, "-modes", 6, *probes(it="block:body"), *more]


def alone(*more):
    """The body is the mat: nothing couples its motions but the soil."""
    return body("-block_mesh_set", "legs=0,height=0", "-block_soil_mat", "body", *more)


def on_arm(*more):
    """The mat lies below the body and beside it; its corners weigh next to nothing."""
    return body("-block_mesh_set", "height=8,offset=3,half=10", "-block_soil_mat", "mat",
                "-block_corners_element", "point_mass", "-block_corners_mass", 1,
                "-block_legs_element", "spring", "-block_legs_stiffness", "400,400,400", "-block_legs_dashpot",
                "40,40,40", *more)


def shaken(axes="xyz"):
    record = write_samples(pulse(), STEP)
    return [word for axis in axes
            for word in (f"-motion_{axis}_record", record, f"-motion_{axis}_unit", "m/s2")]


class OwnHalfSpace(unittest.TestCase):
    """A half-space and the table of its impedances shake a body in the same way, to a thousandth."""
    SOIL = ["-block_soil_vs", 250, "-block_soil_density", 2000, "-block_soil_poisson", repr(1 / 3)]

    def compared(self, *more, damping=()):
        words = on_arm(*shaken(), "-end_time", 4, "-spectra_frequencies", "1:40:30log", *damping)
        formula = Recorded(self, words + self.SOIL + list(more), 2)
        soil = formula.summary["structures"]["block"]["soil"]
        table = write_soil(of_summary(soil))
        for ranks in (1, 2):
            fitted = Recorded(self, words + ["-block_soil_table", table], ranks)
            for axis in "xyz":
                u, v = formula.displacement(f"it.{axis}"), fitted.displacement(f"it.{axis}")
                self.assertLess(abs(u - v).max() / abs(u).max(), 1e-3, axis)
                _, spectrum = formula.spectrum("it", axis)
                _, other = fitted.spectrum("it", axis)
                self.assertLess(abs(other / spectrum - 1).max(), 1e-3, axis)
        found = fitted.summary["structures"]["block"]["soil"]
        self.assertEqual([misfit["motions"] for misfit in found["misfits"]], ["x", "y", "z", "rx", "ry", "rz"])
        self.assertLess(max(misfit["largest"] for misfit in found["misfits"]), 1e-3)
        for stiffness, expected in zip(found["stiffness"], soil["stiffness"]):
            self.assertAlmostEqual(stiffness / expected, 1, delta=2e-3)

    def test_square(self):
        """Stiffness damping acts on the springs of both."""
        self.compared(damping=["-block_damping_beta", 2e-4])

    def test_embedded_rectangle(self):
        """And so does uniform damping."""
        self.compared("-block_soil_size", "30,20", "-block_soil_embedment", 4,
                      damping=["-block_damping_uniform", 0.03])

    def test_disk_with_trapped_masses(self):
        self.compared("-block_soil_shape", "disk", "-block_soil_poisson", 0.45)


class Coupled(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = write_soil(coupled)
        cls.words = ["-block_soil_table", cls.table]

    def sums(self, run, values):
        steps = numpy.arange(len(values))
        return numpy.exp(-1j * STEP * numpy.outer(TESTED, steps)) @ values

    def test_moves_as_the_solution_over_the_frequency(self):
        """(S - omega^2 M) U = -M A of a body that is the mat, along x and y, which rock it as well."""
        for ranks in (1, 2):
            run = Recorded(self, alone(*self.words, *shaken()), ranks)
            self.assertLess(run.energy["relative_residual"], 1e-11)
            ground = self.sums(run, pulse()[:len(run.time)])
            square = 4 * numpy.sin(TESTED * STEP / 2)**2 / STEP**2
            found = numpy.array([self.sums(run, run.displacement(f"it.{axis}")) for axis in "xyz"])
            inertia = numpy.diag([MASS] * 3 + [INERTIA] * 3)
            for k, omega in enumerate(TESTED):
                load = -inertia @ numpy.array([1, 1, 1, 0, 0, 0]) * ground[k]
                exact = numpy.linalg.solve(coupled(omega) - square[k] * inertia, load)[:3]
                self.assertLess(abs(found[:, k] - exact).max() / abs(exact).max(), 1e-3, omega)

    def test_coupling_is_in_the_answer(self):
        """Without the terms between the motions the body would move otherwise, by twenty times the tolerance."""
        plain = write_soil(lambda omega: numpy.diag(numpy.diag(coupled(omega))))
        run = Recorded(self, alone(*self.words, *shaken()), 2)
        other = Recorded(self, alone("-block_soil_table", plain, *shaken()), 2)
        u, v = run.displacement("it.x"), other.displacement("it.x")
        self.assertGreater(abs(u - v).max() / abs(u).max(), 0.02)

    def test_report(self):
        _, summary = program.must_run(self, alone(*self.words, "-end_time", STEP), 2)
        soil = summary["structures"]["block"]["soil"]
        self.assertEqual([misfit["motions"] for misfit in soil["misfits"]], ["x, ry", "y, rx", "z", "rz"])
        for misfit in soil["misfits"]:
            self.assertLess(misfit["largest"], 2e-3)
            self.assertLess(misfit["mean"], misfit["largest"] + 1e-12)
        for omega in (0, *TESTED):
            sum_of_parts = sum(cell(omega, *(part[key] for key in (
                "stiffness", "dashpot", "inner_dashpot", "inner_mass", "moving_mass", "inner_stiffness")))
                * numpy.outer(part["motion"], part["motion"]) for part in soil["parts"])
            exact = coupled(omega)
            size = numpy.sqrt(abs(numpy.diag(exact)))
            self.assertLess((abs(sum_of_parts - exact) / numpy.outer(size, size)).max(), 2e-3, omega)

    def test_rests_on_the_static_stiffness(self):
        """Its weight, and a pull of gravity along x that tilts it."""
        for ranks in (1, 2):
            run = Recorded(self, alone(*self.words, "-gravity", 9.81, "-preload", "static", "-end_time", 0.1), ranks)
            u = run.displacement("it.z")
            self.assertAlmostEqual(u[0] / (-MASS * 9.81 / 3e9), 1, delta=2e-3)
            self.assertLess(abs(u - u[0]).max(), 1e-11 * abs(u[0]))

    def test_exported_matrices_hold_the_coupling(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            program.must_run(self, alone(*self.words, "-end_time", STEP, "-export_matrices", place), 2)
            found = scipy.io.mmread(f"{place}/block/stiffness.mtx").toarray()
            damping = scipy.io.mmread(f"{place}/block/damping.mtx").toarray()
        with open(self.table) as file:
            lines = file.read().splitlines()
        for name, matrix in (("stiffness", found), ("dashpots", damping)):
            at = lines.index(name) + 1
            given = numpy.array([[float(word) for word in line.split(",")] for line in lines[at:at + 6]])
            size = numpy.sqrt(numpy.diag(given))
            self.assertLess((abs(matrix - given) / numpy.outer(size, size)).max(), 1e-12)
        exact = coupled(0).real
        size = numpy.sqrt(numpy.diag(exact))
        self.assertLess((abs(found - exact) / numpy.outer(size, size)).max(), 2e-3)
        self.assertGreater(abs(found[0, 4]), 0.1 * abs(exact[0, 4]))
        self.assertGreaterEqual(numpy.linalg.eigvalsh(damping)[0], -1e-9 * abs(damping).max())

    def test_all_modes_move_as_the_whole(self):
        words = on_arm(*self.words, *shaken(), "-end_time", 2)
        full = Recorded(self, words, 1)
        for ranks in (1, 2):
            reduced = Recorded(self, words + in_modes("block", 18), ranks)
            for axis in "xyz":
                u, v = full.displacement(f"it.{axis}"), reduced.displacement(f"it.{axis}")
                self.assertLess(abs(u - v).max() / abs(u).max(), 1e-9)

    def test_does_not_shorten_the_step_that_the_springs_set(self):
        """Thrown at 0.999 of the limit it never gains energy."""
        words = alone(*self.words, "-courant", 0.999, "-block_initial_velocity", "1,2,3", *clock(0, 5, 0.1),
                      "-energy_interval", 1)
        folder, summary = program.must_run(self, words, 2)
        self.assertLess(summary["energy"]["relative_residual"], 1e-11)
        columns = program.read_csv(f"{folder}/energy.csv")
        total = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
        self.assertLess(max(b - a for a, b in zip(total, total[1:])) / total[0], 1e-11)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, on_arm(*self.words, *shaken("x"), "-end_time", 1), 0.5, 300)


if __name__ == "__main__":
    unittest.main()
