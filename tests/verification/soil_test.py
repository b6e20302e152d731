"""Soil under a rigid mat: impedances that come back out of motions, rest under gravity, energy, limits.

A body with rotary inertia on soil is shaken by one short pulse and left to itself until it rests. Sums
over all steps, U = sum u_n exp(-i omega n h) and likewise A, then obey the scheme without any error of
windows, and the impedance comes out of them: S = M (4 sin^2(omega h / 2) / h^2 - A / U) along an axis; about
an axis by the coupling of an arm. References: the published functions of a disk of Veletsos and Verbic
and of Wolf's cones, written here once more.
"""
import math
import tempfile
import unittest

import h5py
import numpy

import program
from decks import clock, contacts, in_modes, material, probes, section
from recorded import Recorded, assert_continues, write_samples

VELOCITY, DENSITY, RADIUS = 200.0, 2000.0, 10.0
MASS, INERTIA = 2e6, 1e8
STEP, END = 1e-3, 12.0
TESTED = (0.3, 0.6, 1.0, 1.5, 2.0)  # a0
THIRD = 1 / 3


def disk(mode, nu, a0):
    """Impedance of a disk over G R or G R^3 at a0."""
    spring = {"x": 8 / (2 - nu), "z": 4 / (1 - nu), "r": 8 / (3 * (1 - nu)), "t": 16 / 3}[mode]
    if nu == THIRD and mode != "t":
        if mode == "x":
            return spring * (1 + 0.65j * a0)
        first, second, ground = {"z": (0.35, 0.8, 0.75), "r": (0.8, 0.5, 0)}[mode]
        turned = (second * a0)**2 / (1 + (second * a0)**2)
        return spring * (1 - first * turned + 1j * a0 * (ground + first * second * turned))
    speed = {"x": 1, "t": 1}.get(mode, 2 if nu > THIRD else math.sqrt(2 * (1 - nu) / (1 - 2 * nu)))
    trapped = max(0, nu - THIRD)
    if mode in "xz":
        return spring + 1j * a0 * math.pi * speed - (2.4 * trapped * math.pi * a0**2 if mode == "z" else 0)
    inertia = math.pi / 4 if mode == "r" else math.pi / 2
    apex = 9 * math.pi / 32 * ((1 - nu) * speed**2 if mode == "r" else 1)
    b0 = a0 * apex / speed
    value = spring * (1 - (1 - 1j * b0) * b0**2 / (1 + b0**2) / 3)
    return value - (1.2 * trapped * inertia * a0**2 if mode == "r" else 0)


def impedance(mode, nu, a0):
    return disk(mode, nu, a0) * DENSITY * VELOCITY**2 * RADIUS * (RADIUS**2 if mode in "rt" else 1)


def pulse(steps=int(END / STEP)):
    width = 0.03
    times = STEP * numpy.arange(steps + 2)
    return numpy.exp(-((times - 7 * width) / width)**2)


def ground(nu, *more):
    return ["-block_soil_vs", VELOCITY, "-block_soil_density", DENSITY, "-block_soil_poisson", repr(nu), *more]


def body(*more):
    return ["-structures", "block", "-block_mesh", "tests/meshes/mat.geo", "-block_body_element", "point_mass",
            "-block_body_mass", MASS, "-block_body_rotary_inertia", f"{INERTIA!r},{INERTIA!r},{INERTIA!r}",
            *clock(STEP, END), "-energy_interval", 50, "-modes", 6, *probes(it="block:body"), *more]


def alone(nu, *more):
    """The body is the mat: nothing couples its motions."""
    return body("-block_mesh_set", "legs=0,height=0", "-block_soil_mat", "body", "-block_soil_shape", "disk",
                "-block_soil_size", 2 * RADIUS, *ground(nu), *more)


def on_arm(nu, height, offset, *more):
    """The mat lies below the body or beside it: its corners weigh next to nothing."""
    return body("-block_mesh_set", f"height={height},offset={offset},half={RADIUS}", "-block_soil_mat", "mat",
                "-block_soil_shape", "disk", "-block_corners_element", "point_mass", "-block_corners_mass", 1,
                "-block_legs_element", "spring", "-block_legs_stiffness", "400,400,400", "-block_legs_dashpot",
                "40,40,40", *ground(nu), *more)


class Harmonic:
    """Sums of a run's motion and of its ground over all steps at some circular frequencies."""

    def __init__(self, run, omega):
        self.run, self.omega = run, omega
        self.square = 4 * numpy.sin(omega * STEP / 2)**2 / STEP**2  # of the scheme, in place of omega^2

    def sum(self, values):
        steps = numpy.arange(len(values))
        return numpy.exp(-1j * STEP * numpy.outer(self.omega, steps)) @ values

    def motion(self, axis):
        return self.sum(self.run.displacement(f"it.{axis}"))


class Impedance(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_samples(pulse(), STEP)
        cls.omega = numpy.array(TESTED) * VELOCITY / RADIUS

    def shaken(self, words, axes, ranks):
        motion = [word for axis in axes
                  for word in (f"-motion_{axis}_record", self.record, f"-motion_{axis}_unit", "m/s2")]
        run = Recorded(self, words + motion, ranks)
        self.assertLess(run.energy["relative_residual"], 1e-11)
        self.assertGreater(run.energy["devices"], 0)
        for axis in axes:
            u = abs(run.displacement(f"it.{axis}"))
            self.assertLess(u[-1], 1e-7 * u.max())  # it rests again
        return Harmonic(run, self.omega)

    def check(self, found, mode, nu):
        for a0, value in zip(TESTED, found):
            exact = impedance(mode, nu, a0)
            self.assertLess(abs(value / exact - 1), 1e-3, (mode, nu, a0))

    def of_translation(self, harmonic, axis):
        return MASS * (harmonic.square - harmonic.sum(pulse()[:len(harmonic.run.time)]) / harmonic.motion(axis))

    def test_along_the_axes(self):
        for nu, ranks in ((THIRD, 1), (THIRD, 2), (0.2, 2), (0.45, 1)):
            harmonic = self.shaken(alone(nu), "xyz", ranks)
            for axis in "xyz":
                self.check(self.of_translation(harmonic, axis), "z" if axis == "z" else "x", nu)

    def of_rotation(self, harmonic, arm, nu):
        """Shaken along x, the middle of the mat moves by w = u + arm theta."""
        sliding = numpy.array([impedance("x", nu, a0) for a0 in TESTED])
        u = harmonic.motion("x")
        w = MASS * (harmonic.square * u - harmonic.sum(pulse()[:len(harmonic.run.time)])) / sliding
        theta = (w - u) / arm
        return harmonic.square * INERTIA - arm * sliding * w / theta

    def test_rocking(self):
        for nu, ranks in ((THIRD, 1), (THIRD, 2), (0.45, 2), (0.2, 1)):
            harmonic = self.shaken(on_arm(nu, 8, 0), "x", ranks)
            self.check(self.of_rotation(harmonic, -8, nu), "r", nu)

    def test_torsion(self):
        for nu, ranks in ((THIRD, 2), (0.45, 1)):
            harmonic = self.shaken(on_arm(nu, 0, 5), "x", ranks)
            self.check(self.of_rotation(harmonic, -5, nu), "t", nu)

    def test_without_frequency_dependence(self):
        """Static springs, and the dashpots of a0 = 1."""
        harmonic = self.shaken(alone(0.45, "-block_soil_frequency_dependence", "no"), "z", 2)
        for a0, value in zip(TESTED, self.of_translation(harmonic, "z")):
            exact = impedance("z", 0.45, 0) + 1j * a0 * impedance("z", 0.45, 1).imag
            self.assertLess(abs(value / exact - 1), 1e-3)

    def test_in_all_modes(self):
        full = self.shaken(on_arm(0.45, 8, 3), "xz", 1)
        for ranks in (1, 2):
            reduced = self.shaken(on_arm(0.45, 8, 3, *in_modes("block", 18)), "xz", ranks)
            for axis in "xyz":
                u, v = full.run.displacement(f"it.{axis}"), reduced.run.displacement(f"it.{axis}")
                self.assertLess(abs(u - v).max() / abs(u).max(), 1e-9)

    def test_a_kept_basis_is_read_again(self):
        """Soil acts on rotations too, which are places of the basis as translations are."""
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            words = on_arm(0.45, 8, 3, *in_modes("block", 18), "-motion_x_record", self.record,
                           "-motion_x_unit", "m/s2", "-end_time", 0.3, "-block_modal_basis", f"{place}/basis.h5")
            made, read = Recorded(self, words, 2), Recorded(self, words, 2)
            with h5py.File(f"{place}/basis.h5") as file:
                self.assertEqual(set(file["points"][:, 1]), set(range(6)))
        self.assertTrue(numpy.array_equal(made.displacement("it.x"), read.displacement("it.x")))
        self.assertGreater(abs(made.displacement("it.x")).max(), 0)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        words = on_arm(0.45, 8, 3, "-motion_x_record", self.record, "-motion_x_unit", "m/s2", "-end_time", 1)
        assert_continues(self, words, 0.5, 300)


class Limits(unittest.TestCase):
    """Soils of one stiffness and far apart in everything else: K decides the step, and nothing blows up."""
    FACTORS = (1, 1e-3, 30)  # on V_s; the density goes with its inverse square, K stays

    def soil(self, factor, nu, *more):
        return alone(nu, "-block_soil_vs", VELOCITY * factor, "-block_soil_density", repr(DENSITY / factor**2), *more)

    def test_step_is_that_of_the_springs(self):
        fastest = max(math.sqrt(abs(impedance(mode, THIRD, 0)) / mass)
                      for mode, mass in (("x", MASS), ("z", MASS), ("r", INERTIA), ("t", INERTIA)))
        for factor in self.FACTORS:
            _, summary = program.must_run(self, self.soil(factor, THIRD, "-end_time", STEP), 1)
            self.assertAlmostEqual(summary["structures"]["block"]["stable_time_step"] * fastest / 2, 1, delta=1e-9)

    def test_energy_never_grows_at_the_limit(self):
        """Thrown sideways and up at 0.999 of the limit, with a mass on the mat as well."""
        for factor, ranks in zip(self.FACTORS, (1, 2, 1)):
            words = self.soil(factor, 0.45, "-courant", 0.999, *clock(0, 20, 0.1), "-block_initial_velocity", "1,2,3",
                              "-energy_interval", 1)
            folder, summary = program.must_run(self, words, ranks)
            self.assertLess(summary["energy"]["relative_residual"], 1e-11)
            columns = program.read_csv(f"{folder}/energy.csv")
            total = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
            self.assertGreater(len(total), 500)
            self.assertLess(max(b - a for a, b in zip(total, total[1:])) / total[0], 1e-11, factor)


class Rest(unittest.TestCase):
    def test_settles_by_its_weight_over_the_spring(self):
        """The middle of the mat settles, and the body with it, which stands beside it: it tilts as well."""
        for ranks in (1, 2):
            run = Recorded(self, on_arm(THIRD, 0, 2, "-gravity", 9.81, "-preload", "static", "-end_time", 0.1), ranks)
            sag = MASS * 9.81 * (1 / impedance("z", THIRD, 0) + 2**2 / impedance("r", THIRD, 0)).real
            u = run.displacement("it.z")
            self.assertAlmostEqual(u[0] / -sag, 1, delta=1e-5)
            self.assertLess(abs(u - u[0]).max(), 1e-11 * sag)

    def test_stands_for_a_hundred_thousand_steps(self):
        words = on_arm(THIRD, 0, 2, "-gravity", 9.81, "-preload", "static", "-end_time", 100, "-output_interval", 0.5,
                       "-energy_interval", 10000)
        run = Recorded(self, words, 2)
        self.assertEqual(run.summary["steps"], 100000)
        self.assertLess(abs(run.velocity("it.z")).max(), 1e-9)
        # No node may move faster than all the energy would let it.
        self.assertLess(math.sqrt(2 * abs(run.energy["kinetic"])), 1e-9)

    def test_sizes_come_from_the_group(self):
        """A rectangle of the corners' box; its impedances in the summary are those of the formulas."""
        words = [word for word in on_arm(THIRD, 8, 3, "-end_time", STEP) if word not in ("disk", "-block_soil_shape")]
        _, summary = program.must_run(self, words, 2)
        soil = summary["structures"]["block"]["soil"]
        self.assertEqual((soil["shape"], soil["size"], soil["centre"]), ("rectangle", [20, 20], [0, 3, 0]))
        unit = DENSITY * VELOCITY**2 * RADIUS
        for found, expected in zip(soil["stiffness"], (5.52, 5.52, 7.05, 600, 600, 831)):
            self.assertAlmostEqual(found / unit, expected, delta=1e-3 * expected)
        self.assertAlmostEqual(soil["dashpot"][0] / (DENSITY * VELOCITY * 400), 1, delta=1e-12)
        self.assertAlmostEqual(soil["largest_frequency"], VELOCITY / (math.pi * RADIUS), delta=1e-12)


class MatOfShells(unittest.TestCase):
    """A mat of shells alone on soil: its nodes move as one."""
    SIDE, THICKNESS, HEAVY = 2.0, 0.05, 7800.0

    def words(self, *more):
        return ["-structures", "t", "-t_mesh", "tests/meshes/table.geo", "-t_ignore", "column",
                "-t_slab_element", "shell", "-t_slab_material", "steel", "-t_slab_thickness", self.THICKNESS,
                *material("steel", 200e9, 0.3, self.HEAVY), "-t_soil_mat", "slab", "-t_soil_vs", VELOCITY,
                "-t_soil_density", DENSITY, "-t_soil_poisson", repr(THIRD), "-end_time", 0.01, "-modes", 6, *more]

    def test_frequencies_are_those_of_a_rigid_mat(self):
        unit = DENSITY * VELOCITY**2 * self.SIDE / 2
        mass = self.SIDE**2 * self.THICKNESS * self.HEAVY
        turn = mass / 2 * (self.SIDE / 2)**2  # lumped at 3 x 3 nodes: half of it stands at the edges
        for ranks in (1, 2, 3):
            run = Recorded(self, self.words("-gravity", 9.81, "-preload", "static",
                                            *probes(p="t:slab")), ranks, identity=1e-11)
            structure = run.summary["structures"]["t"]
            found = {mode["direction"]: mode["frequency"] for mode in structure["frequencies"]}
            for direction, stiffness, inertia in (("x", 5.52, mass), ("z", 7.05, mass), ("rx", 6.0, turn),
                                                  ("rz", 8.31, 2 * turn)):
                expected = math.sqrt(stiffness * unit / inertia) / (2 * math.pi)
                self.assertAlmostEqual(found[direction] / expected, 1, delta=2e-3, msg=direction)
            self.assertAlmostEqual(run.displacement("p.z")[0] * 7.05 * unit / (-mass * 9.81), 1, delta=2e-3)
            self.assertEqual(structure["rigid_groups"][0]["motions"], 6)
            # The shells, which would hold the step at 1e-5 s, never strain.
            self.assertGreater(structure["stable_time_step"], 1e-3)

    def test_a_mat_may_be_part_of_a_larger_body(self):
        _, summary = program.must_run(self, self.words("-t_rigid", "slab", "-output_interval", 1e-3), 2)
        self.assertEqual(len(summary["structures"]["t"]["rigid_groups"]), 1)


class Stick(unittest.TestCase):
    """Four floors of 2,200 kip every 16 ft on a square mat of 64 ft, 5 ft thick: of the published stick 4.97 Hz on
    fixed ground and, on a rigid mat on soil, 3.83 Hz with 12.7 times the ground's acceleration at the roof. The
    column has the bending stiffness that makes it 4.97 Hz and 4 % of critical at 3.83 Hz, the soil the published
    horizontal stiffness of the mat, 1.48e10 N/m, nu = 1/3 and 2000 kg/m3.
    """
    HEIGHT, SIDE, DEPTH = 16 * 0.3048, 64 * 0.3048, 5 * 0.3048
    FLOOR = 2.2e6 * 4.44822 / 9.80665
    MAT = SIDE**2 * DEPTH * 2403
    BENDING, YOUNG = 3.6596e12, 3e10  # N m2, Pa
    TIME = 8.0

    def words(self, *more):
        inertia = self.BENDING / self.YOUNG
        turns = self.MAT * (self.SIDE**2 + self.DEPTH**2) / 12
        return ["-structures", "stick", "-stick_mesh", "tests/meshes/stick.geo",
                "-stick_mesh_set", f"storey={self.HEIGHT!r}", "-stick_column_element", "beam",
                "-stick_column_material", "light", "-stick_column_section", "pipe",
                *material("light", self.YOUNG, 0.2, 100), *section("pipe", 3, inertia, inertia, inertia, "1,0,0"),
                "-stick_column_damping_beta", 2 * 0.04 / (2 * math.pi * 3.83), "-stick_floors_element", "point_mass",
                "-stick_floors_mass", self.FLOOR, "-stick_floors_rotary_inertia", "3e6,3e6,3e6",
                "-stick_foot_element", "point_mass", "-stick_foot_mass", self.MAT,
                "-stick_foot_rotary_inertia", f"{turns!r},{turns!r},{2 * turns!r}", "-modes", 4, *more]

    def on_soil(self, *more):
        velocity = math.sqrt(1.48e10 / (5.52 * self.SIDE / 2) / 2000)
        return self.words("-stick_soil_mat", "foot", "-stick_soil_size", f"{self.SIDE!r},{self.SIDE!r}",
                          "-stick_soil_vs", repr(velocity), "-stick_soil_density", 2000,
                          "-stick_soil_poisson", repr(THIRD), *more)

    def test_frequency_and_amplification(self):
        record = write_samples(pulse(int(self.TIME / STEP)), STEP)
        run = Recorded(self, self.on_soil("-motion_x_record", record, "-motion_x_unit", "m/s2",
                                          *clock(2e-4, self.TIME, STEP), *probes(it="stick:roof")), 2)
        self.assertLess(run.energy["relative_residual"], 1e-11)
        frequencies = numpy.arange(3.3, 4.4, 0.005)
        harmonic = Harmonic(run, 2 * math.pi * frequencies)
        ratio = abs(1 - harmonic.square * harmonic.motion("x") / harmonic.sum(pulse()[:len(run.time)]))
        peak = ratio.argmax()
        self.assertAlmostEqual(frequencies[peak] / 3.83, 1, delta=0.03)
        self.assertAlmostEqual(ratio[peak] / 12.7, 1, delta=0.10)

    def test_soil_does_not_shorten_the_step(self):
        steps = []
        for words in (self.on_soil("-stick_soil_vs", 1e-3), self.on_soil()):
            _, summary = program.must_run(self, words + ["-end_time", 1e-3], 2)
            steps.append(summary["structures"]["stick"]["stable_time_step"])
        self.assertGreater(steps[1], steps[0] * (1 - 1e-6))


class AtAWall(unittest.TestCase):
    """A slab on soil that is thrown against a wall: its soil holds energy between two looks at the gap."""

    def test_gaps_looked_at_more_rarely_change_no_impact(self):
        found = []
        for interval, ranks in ((0, 1), (0.05, 1), (0.05, 2)):
            run = Recorded(self, ["-structures", "slab", "-slab_mesh", "tests/meshes/torsional_slab.geo",
                                  "-slab_body_element", "hex8", "-slab_body_material", "c",
                                  *material("c", 3e10, 0.2, 2400), "-slab_middle_element", "point_mass",
                                  "-slab_middle_mass", 1e3, "-slab_middle_rotary_inertia", "1e5,1e5,1e5",
                                  "-slab_soil_mat", "middle", "-slab_soil_size", 4, "-slab_soil_vs", 40,
                                  "-slab_soil_density", 1800, "-slab_soil_poisson", 0.45, "-slab_soil_shape", "disk",
                                  "-slab_initial_velocity", "0.2,0,0.1", *contacts(hit=("slab:far_high", "wall", 2e-3)),
                                  "-end_time", 0.2, "-output_interval", 1e-3, "-gap_interval", interval,
                                  *probes(it="slab:middle")], ranks,
                           identity=1e-11)
            self.assertLess(run.energy["relative_residual"], 1e-11)
            found.append(run)
        often, rarely, two = found
        self.assertGreater(often.summary["impacts"]["hit"]["episodes"], 0)
        self.assertEqual(rarely.summary["impacts"], often.summary["impacts"])
        self.assertTrue(numpy.array_equal(rarely.displacement("it.x"), often.displacement("it.x")))
        self.assertLess(rarely.summary["interface_looks"], often.summary["steps"] / 3)
        u = often.displacement("it.x")
        self.assertLess(abs(two.displacement("it.x") - u).max(), 1e-6 * abs(u).max())


class PlantPair(unittest.TestCase):
    def test_stands_on_soil_and_keeps_its_ledger(self):
        """Rigid mats on a half-space, rigid floors, uniform damping, gravity and shaking in one scene."""
        found = []
        for ranks in (1, 2):
            run = Recorded(self, ["-options_file", "petsc-options/plant/on_soil.yaml", "-block_mesh_set", "m=1",
                                  "-frame_mesh_set", "m=1,x0=24.801", "-end_time", 0.05, "-output_interval", 1e-3,
                                  "-modes", 2], ranks, identity=1e-11)
            self.assertLess(run.energy["relative_residual"], 1e-11)
            for found_in in run.summary["structures"].values():  # neither springs nor shells of a rigid mat
                self.assertNotIn("mat'", found_in["stiffest_element"] + found_in["limiting_element"])
            rest = run.summary["equilibrium"]["structures"]
            for name, side in (("block", 24.384), ("frame", 15.24)):
                self.assertLess(rest[name]["imbalance"], 1e-10)
                soil = run.summary["structures"][name]["soil"]
                self.assertAlmostEqual(min(soil["size"]) / side, 1, delta=1e-6)
            kinds = [group["kind"] for group in run.summary["structures"]["frame"]["rigid_groups"]]
            self.assertEqual(sorted(kinds), ["diaphragm", "diaphragm", "diaphragm", "rigid"])
            found.append(run.displacement("frame_roof.x"))
        self.assertLess(abs(found[1] - found[0]).max(), 1e-9 * abs(found[0]).max())


if __name__ == "__main__":
    unittest.main()
