"""Two mats on one soil, each under a structure of its own: histories and spectra against the solution over the frequency, rest,
modes, restart, ledger with a joint that closes, motions of their own, soil that is far apart.

As in soil_table_test.py, bodies are shaken by one short pulse until they rest; sums over all steps obey the scheme with
4 sin^2(omega h / 2) / h^2 in the place of omega^2.
"""
import math
import tempfile
import unittest
from pathlib import Path

import numpy

import program
from decks import clock, in_modes, material, probes
from recorded import Recorded, assert_continues, write_samples, write_sine
from soil_tables import coupled, two_mats, write_parts, write_soil

from pounding.soil import half_space  # soil_tables puts it on the path

STEP, END = 1e-3, 10.0
TESTED = 2 * math.pi * numpy.array([1.0, 2.0, 3.5, 5.0, 7.0])
BODIES = {"left": (2e6, 1e8), "right": (3e6, 2e8)}
INERTIA = numpy.diag([value for mass, inertia in BODIES.values() for value in [mass] * 3 + [inertia] * 3])
GIVEN = two_mats()


def pulse(steps=int(END / STEP), centre=0.21, width=0.03):
    return numpy.exp(-((STEP * numpy.arange(steps + 2) - centre) / width)**2)


def body(name, mat, table, mesh="legs=0,height=0", group="body"):
    mass, inertia = BODIES[name]
    return [f"-{name}_mesh", "tests/meshes/mat.geo", f"-{name}_mesh_set", mesh, f"-{name}_body_element", "point_mass",
            f"-{name}_body_mass", mass, f"-{name}_body_rotary_inertia", f"{inertia!r},{inertia!r},{inertia!r}",
            f"-{name}_soil_mat", group, f"-{name}_soil_table", table, f"-{name}_soil_table_mat", mat]


def pair(table, *more):
    return ["-structures", "left,right", *body("left", 1, table), *body("right", 2, table), *clock(STEP, END),
            "-energy_interval", 50, "-modes", 6, *probes(a="left:body", b="right:body"), *more]


def on_legs(table, *more):
    """Bodies on legs; the second mat lies below its body and beside it."""
    words = ["-structures", "left,right", *clock(STEP, 2), "-modes", 6, *probes(a="left:body", b="right:body")]
    for mat, name, offset in ((1, "left", 0), (2, "right", 3)):
        words += body(name, mat, table, f"height=8,offset={offset},half=10", "mat")
        words += [f"-{name}_corners_element", "point_mass", f"-{name}_corners_mass", 1, f"-{name}_legs_element", "spring",
                  f"-{name}_legs_stiffness", "400,400,400", f"-{name}_legs_dashpot", "40,40,40"]
    return words + list(more)


def shaken(axes="xyz", record=None):
    record = record or write_samples(pulse(), STEP)
    return [word for axis in axes for word in (f"-motion_{axis}_record", record, f"-motion_{axis}_unit", "m/s2")]


def sums(values):
    return numpy.exp(-1j * STEP * numpy.outer(TESTED, numpy.arange(len(values)))) @ values


def spectrum(acceleration, step, frequencies, damping):
    """Largest omega^2 u of oscillators on a floor that ends at rest, by Fourier's transform with zeros behind it."""
    count = 4 * len(acceleration)
    omega, floor = 2 * math.pi * numpy.fft.rfftfreq(count, step), numpy.fft.rfft(acceleration, count)
    return numpy.array([own**2 * abs(numpy.fft.irfft(-floor / (own**2 - omega**2 + 2j * damping * own * omega), count)).max()
                        for own in 2 * math.pi * frequencies])


class Dynamics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = write_parts(GIVEN)

    def assert_solved(self, run, impedance, grounds, moving=False):
        """(S - omega^2 M) U = -M A, `grounds` per mat: accelerations of its ground along x, y, z, which end at rest where
        displacements hold them (`moving`)."""
        square = 4 * numpy.sin(TESTED * STEP / 2)**2 / STEP**2
        found = numpy.array([sums(run.displacement(f"{probe}.{axis}")) for probe in "ab" for axis in "xyz"])
        load = numpy.zeros((12, len(TESTED)), complex)
        for mat, ground in enumerate(grounds):
            load[6 * mat:6 * mat + 3] = sums(ground[:len(run.time)])
        matrices = impedance(TESTED) - square[:, None, None] * INERTIA
        exact = numpy.linalg.solve(matrices, -(INERTIA @ load).T[:, :, None])[:, [0, 1, 2, 6, 7, 8], 0].T
        if moving:
            found = found + load[[0, 1, 2, 6, 7, 8]] / square
        self.assertLess((abs(found - exact) / abs(exact).max(axis=0)).max(), 1e-3)

    def test_moves_as_the_solution_over_the_frequency(self):
        for ranks in (1, 2, 3):
            run = Recorded(self, pair(self.table, *shaken()), ranks)
            self.assertLess(run.energy["relative_residual"], 1e-11)
            self.assert_solved(run, GIVEN.at, [pulse()] * 2)

    def test_coupling_is_in_the_answer(self):
        alone = two_mats()
        for matrix in (alone.stiffness, alone.dashpots, alone.masses):
            matrix[:6, 6:] = matrix[6:, :6] = 0
        alone.hidden = []
        apart = Recorded(self, pair(write_parts(alone), *shaken(), "-end_time", 1), 2)
        run = Recorded(self, pair(self.table, *shaken(), "-end_time", 1), 2)
        u, v = run.displacement("a.x"), apart.displacement("a.x")
        self.assertGreater(abs(u - v).max() / abs(u).max(), 0.05)

    def test_history_and_spectra(self):
        """By Fourier's transform of the whole history, which ends at rest; the step is short enough for omega itself."""
        step, count = 2.5e-4, 2**15
        ground = numpy.exp(-((step * numpy.arange(count) - 0.3) / 0.05)**2)
        run = Recorded(self, pair(self.table, *shaken(record=write_samples(ground, step)), "-time_step", step, "-end_time",
                                  step * (count - 1), "-output_interval", step, "-spectra_frequencies", "1:20:30log"), 2)
        omega = 2 * math.pi * numpy.fft.rfftfreq(count, step)
        load = -(INERTIA @ numpy.tile([1, 1, 1, 0, 0, 0], 2))[None] * numpy.fft.rfft(ground)[:, None]
        exact = numpy.linalg.solve(GIVEN.at(omega) - (omega**2)[:, None, None] * INERTIA, load[:, :, None])[:, :, 0]
        for probe, first in (("a", 0), ("b", 6)):
            for c, axis in enumerate("xyz"):
                u = numpy.fft.irfft(exact[:, first + c], count)
                self.assertLess(abs(run.displacement(f"{probe}.{axis}") - u).max() / abs(u).max(), 1e-3)
                total = numpy.fft.irfft(-omega**2 * exact[:, first + c], count) + ground
                frequencies, found = run.spectrum(probe, axis)
                expected = spectrum(total, step, frequencies, 0.05)
                self.assertLess(abs(found / expected - 1).max(), 1e-3)

    def test_grounds_of_their_own(self):
        """A motion per mat, the second later and smaller, of grounds that come back to rest."""
        first, late = (factor * numpy.diff(pulse(centre=centre), 2, append=[0, 0]) / STEP**2 / 1e3
                       for factor, centre in ((1, 0.21), (0.6, 0.26)))
        supports = ["-supports", "one,two", "-one_groups", "left", "-two_groups", "right"]
        for name, motion in (("one", first), ("two", late)):
            record = write_samples(motion, STEP)
            for axis in "xyz":
                supports += [f"-{name}_motion_{axis}_record", record, f"-{name}_motion_{axis}_unit", "m/s2"]
        run = Recorded(self, pair(self.table, *supports), 2, identity=1e-11)
        self.assert_solved(run, GIVEN.at, [first, late], moving=True)

    def test_far_mats_are_two_mats(self):
        """Terms between mats below 0.1 % of the diagonals are left out, and each mat moves as on soil of its own."""
        def far(omega):
            matrix = numpy.zeros((12, 12), complex)
            matrix[:6, :6], matrix[6:, 6:] = coupled(omega), 1.3 * coupled(omega)
            for i in range(6):
                matrix[i, i + 6] = matrix[i + 6, i] = 5e-4 * coupled(omega)[i, i]
            return matrix
        both = Recorded(self, pair(write_soil(far), *shaken(), "-end_time", 2), 2)
        words = pair(write_soil(coupled), *shaken(), "-end_time", 2)
        own = Recorded(self, [*words, "-left_soil_table_mat", 1, "-right_soil_table_mat", 1, "-right_soil_table",
                              write_soil(lambda omega: 1.3 * coupled(omega))], 2)
        for channel in ("a.x", "a.y", "a.z", "b.x", "b.y", "b.z"):
            u, v = both.displacement(channel), own.displacement(channel)
            self.assertLess(abs(u - v).max() / abs(v).max(), 1e-3, channel)

    def test_reciprocity(self):
        """A force on one mat moves the other as that on the other moves the first."""
        def pushed(structure):
            words = pair(self.table, "-loads", "push", "-push_on", f"{structure}:body", "-push_force", "1e6,0,0", "-push_values",
                         "0.1,0;0.15,1;0.2,0", "-end_time", 2)
            return Recorded(self, words, 2)
        one, other = pushed("left").displacement("b.x"), pushed("right").displacement("a.x")
        self.assertLess(abs(one - other).max() / abs(one).max(), 1e-11)
        self.assertGreater(abs(one).max(), 1e-6)

    def test_factor_on_the_ground(self):
        """K(omega; f G) = f K(omega / sqrt(f); G)."""
        factor = 1.7
        run = Recorded(self, pair(self.table, *shaken(), "-left_soil_factor", factor, "-right_soil_factor", factor), 1)
        self.assert_solved(run, lambda omega: factor * GIVEN.at(omega / math.sqrt(factor)), [pulse()] * 2)

    def test_rests_on_both(self):
        """Weight of two bodies settles and tilts both mats, and nothing moves from there."""
        for ranks in (1, 2):
            run = Recorded(self, pair(self.table, "-gravity", 9.81, "-preload", "static", "-end_time", 0.1), ranks)
            rest = numpy.linalg.solve(GIVEN.stiffness, -9.81 * INERTIA @ numpy.tile([0, 0, 1, 0, 0, 0], 2))
            for probe, first in (("a", 0), ("b", 6)):
                for c, axis in enumerate("xyz"):
                    u = run.displacement(f"{probe}.{axis}")
                    self.assertLess(abs(u - rest[first + c]).max(), 1e-8 * abs(rest).max(), (probe, axis))

    def test_all_modes_move_as_the_whole(self):
        words = on_legs(self.table, *shaken())
        full = Recorded(self, words, 1)
        for ranks, reduced in ((1, ("left", "right")), (2, ("right",))):
            run = Recorded(self, words + [word for name in reduced for word in in_modes(name, 18)], ranks)
            for channel in ("a.x", "a.y", "a.z", "b.x", "b.y", "b.z"):
                u, v = full.displacement(channel), run.displacement(channel)
                self.assertLess(abs(u - v).max() / abs(u).max(), 1e-9, channel)

    def test_does_not_shorten_the_step_by_dashpots(self):
        """Thrown at 0.999 of the limit the pair never gains energy."""
        words = pair(self.table, "-courant", 0.999, "-left_initial_velocity", "1,2,3", *clock(0, 5, 0.1), "-energy_interval", 1)
        folder, summary = program.must_run(self, words, 2)
        self.assertLess(summary["energy"]["relative_residual"], 1e-11)
        columns = program.read_csv(f"{folder}/energy.csv")
        total = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
        self.assertLess(max(b - a for a, b in zip(total, total[1:])) / total[0], 1e-11)

    def joint(self):
        """A joint of a tenth of a millimetre between bodies on one soil closes under weight and shaking."""
        return ["-contacts", "stop", "-stop_secondary", "left:body", "-stop_primary", "right:body", "-stop_along", "1,0,0",
                "-stop_gap", 1e-4, *shaken("xz", write_sine(3, 4, 1)), "-end_time", 1]

    def test_joint_that_closes(self):
        for ranks in (1, 2, 3):
            run = Recorded(self, pair(self.table, *self.joint()), ranks)
            self.assertLess(run.energy["relative_residual"], 1e-12)
            self.assertGreater(len(run.column("impulse")), 2)
        assert_continues(self, pair(self.table, *self.joint()), 0.5, 300)

    def test_meshes_cut_before(self):
        """Pieces of meshes hold the rows between mats, and are refused for another file of soil."""
        words = on_legs(self.table, "-left_initial_velocity", "0.1,0,0", "-end_time", 0.1)
        whole = Recorded(self, words, 2)
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            program.must_end(self, [*words, "-mesh_pieces", place, "-write_mesh_pieces", 2], ranks=2)
            cut = Recorded(self, [*words, "-mesh_pieces", place], 2)
            self.assertTrue(numpy.array_equal(cut.displacement("b.x"), whole.displacement("b.x")))
            self.assertGreater(abs(cut.displacement("b.x")).max(), 1e-6)
            with open(self.table) as file:
                text = file.read()
            self.addCleanup(Path(self.table).write_text, text)
            Path(self.table).write_text(text + "# another\n")
            program.must_refuse(self, [*words, "-mesh_pieces", place], "soil table of left", ranks=2)

    def test_reactions_hold_the_weight(self):
        for ranks in (1, 2):
            run = Recorded(self, pair(self.table, "-gravity", 9.81, "-preload", "static", "-end_time", 0.05, "-forces", "base",
                                      "-base_structure", "left", "-base_kind", "reactions"), ranks)
            self.assertLess(abs(run.members("base")[:, 2] / (9.81 * BODIES["left"][0]) - 1).max(), 1e-8)


@program.long
class SoilBlock(unittest.TestCase):
    """Two squares of 8 x 8 m 0.6 m apart, one of which is pushed along x at 12.5 Hz: a block of soil with absorbing faces beside
    the table of a half-space, both extended to elements and patches of no size, in which their errors are linear."""
    FREQUENCY, MASS = 12.5, 24 * 64.0

    def pushed_block(self, size):
        words = ["-structures", "site", "-site_mesh", "tests/meshes/two_squares.geo", "-site_mesh_set",
                 f"around=16,depth=16,size={size}", "-site_soil_element", "hex8", "-site_soil_material", "ground",
                 *material("ground", 2.1328e8, 0.333, 2000), *material("slab", 3e10, 0.2, 24)]
        for mat in ("one", "two"):
            words += [f"-site_{mat}_element", "shell", f"-site_{mat}_thickness", 1, f"-site_{mat}_material", "slab"]
        words += ["-site_rigid", "one,two", "-site_absorbing", "outer", "-site_allow_loose", "true", "-site_damping_beta", 2.55e-4,
                  "-end_time", 0.8, "-output_interval", 1e-3, "-modes", 0, "-loads", "push", "-push_function", "harmonic",
                  "-push_frequency", self.FREQUENCY, "-push_on", "site:one", "-push_surface_force", f"{1e6 / 64},0,0",
                  *probes(a="site:one", b="site:two")]
        run = Recorded(self, words, 2, identity=1e-10)
        last = (run.time > 0.4795) & (run.time < 0.7995)  # four periods
        turn = numpy.exp(-2j * math.pi * self.FREQUENCY * run.time[last])
        return numpy.array([abs(2 * (run.displacement(f"{probe}.x")[last] * turn).mean()) for probe in "ab"])

    def pushed_by_table(self, cells):
        mats = [half_space.Mat((x, 0.0), (8.0, 8.0)) for x in (0.0, 8.6)]
        table = half_space.impedances(mats, half_space.Ground(200.0, 2000.0, 0.333, 0.01), [self.FREQUENCY], cells)
        inertia = numpy.diag([self.MASS * factor for factor in (1, 1, 1, 64 / 12, 64 / 12, 64 / 6)] * 2)
        force = numpy.zeros(12)
        force[0] = 1e6
        return abs(numpy.linalg.solve(table.matrix[0] - (2 * math.pi * self.FREQUENCY)**2 * inertia, force))[[0, 6]]

    def test_both_ways(self):
        coarse, fine = self.pushed_block(1.0), self.pushed_block(0.6)
        block = fine - (coarse - fine) * 0.6 / 0.4
        coarse, fine = self.pushed_by_table(8), self.pushed_by_table(12)
        table = fine - 2 * (coarse - fine)
        self.assertLess(abs(block / table - 1).max(), 0.06, (block, table))


if __name__ == "__main__":
    unittest.main()
