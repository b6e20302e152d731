"""States of a structure and of its soil: factors on stiffness and damping by group, and on the soil's shear modulus.

A factor is the same as numbers that are multiplied by hand. On the soil's shear modulus, at one density and damping,
K(omega; f G) = f K(omega / sqrt(f); G): springs times f, dashpots times sqrt(f), masses as they are. In modes the factors on
damping act in the mean by strain energy, as composite modal damping: of a chain of two masses by hand here.
"""
import math
import tempfile
import unittest

import numpy

import program
from decks import clock, in_modes, material, probes, section
from input.corpus.meshes import document
from recorded import Recorded, ensemble_of, write_samples

STIFFNESS, MASSES = (3e8, 2e8), (4e4, 3e4)
CHAIN = document({1: (0, 0, 0), 2: (1, 0, 0), 3: (2, 0, 0)},
                 [(1, 1, 1, (1, 2)), (2, 1, 2, (2, 3)), (3, 15, 3, (1,)), (4, 15, 4, (2,)), (5, 15, 5, (3,))],
                 {1: (1, "lower"), 2: (1, "upper"), 3: (0, "foot"), 4: (0, "first"), 5: (0, "second")})


class Meshed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.mesh = cls.folder.name + "/chain.msh"
        with open(cls.mesh, "w") as file:
            file.write(CHAIN)
        cls.record = write_samples(3 * numpy.sin(25 * numpy.arange(0, .5, 1e-3)), 1e-3)

    def chain(self, *more, young=STIFFNESS):
        """Two masses on two bars of 1 m and 1 m2 along x; Young's moduli are the stiffnesses."""
        words = ["-structures", "it", "-it_mesh", self.mesh, "-it_clamp", "foot,first:y+z,second:y+z", *clock(5e-4, .4),
                 "-motion_x_record", self.record, "-motion_x_unit", "m/s2", *probes(top="it:second")]
        for group, e, place, mass in zip(("lower", "upper"), young, ("first", "second"), MASSES):
            words += [*material(group, repr(e), 0, 0), f"-it_{group}_element", "bar", f"-it_{group}_material", group,
                      f"-it_{group}_area", 1, f"-it_{place}_element", "point_mass", f"-it_{place}_mass", mass]
        return [*words, *more]

    def assert_same(self, words, by_hand, tolerance=0.0, ranks=program.RANKS):
        found, expected = (Recorded(self, list(given), ranks).displacement("top.x") for given in (words, by_hand))
        self.assertGreater(abs(expected).max(), 1e-5)
        self.assertLessEqual(abs(found - expected).max(), tolerance * abs(expected).max())


class Groups(Meshed):
    def test_stiffness_is_that_of_the_moduli(self):
        cracked = (STIFFNESS[0] / 2, STIFFNESS[1])
        for more in ((), ("-it_damping_beta", 1e-3), (*in_modes("it", 2), "-it_modal_damping", .04)):
            for ranks in (1, program.RANKS):
                self.assert_same(self.chain("-it_lower_stiffness_factor", .5, *more), self.chain(*more, young=cracked),
                                 ranks=ranks)

    def test_it_multiplies_that_of_the_structure(self):
        self.assert_same(self.chain("-it_lower_stiffness_factor", .5, "-it_stiffness_factor", 3),
                         self.chain(young=(1.5 * STIFFNESS[0], 3 * STIFFNESS[1])))
        self.assert_same(self.chain("-it_lower_stiffness_factor", .5, "-it_stiffness_factor", 3, *in_modes("it", 2)),
                         self.chain(*in_modes("it", 2), young=(1.5 * STIFFNESS[0], 3 * STIFFNESS[1])), 1e-10)

    def test_strengths_stay_and_elongations_follow(self):
        def yielding(factor):
            strain = 4e-4 / factor
            return ("-it_lower_skeleton", f"{strain!r},{STIFFNESS[0] * 4e-4!r},{4 * strain!r},{STIFFNESS[0] * 7e-4!r}",
                    "-it_lower_rule", "peak", "-it_lower_hardening", .01)
        half = self.chain(*yielding(.5), young=(STIFFNESS[0] / 2, STIFFNESS[1]))
        run = Recorded(self, half)
        self.assertGreater(run.energy["plastic"], 1000)
        self.assert_same(self.chain(*yielding(1), "-it_lower_stiffness_factor", .5), half, 1e-12)
        self.assert_same(self.chain(*yielding(1), "-it_lower_stiffness_factor", .5, *in_modes("it", 2)),
                         [*half, *in_modes("it", 2)], 1e-12)
        both = self.chain(*yielding(.5), young=(STIFFNESS[0] / 2, STIFFNESS[1] / 2))
        self.assert_same(self.chain(*yielding(1), "-it_stiffness_factor", .5), both, 1e-12)
        reduced = [*self.chain(*yielding(1), "-it_stiffness_factor", .5), *in_modes("it", 2)]
        self.assert_same(reduced, [*both, *in_modes("it", 2)], 1e-10)
        peaks, _ = ensemble_of(self, [*self.chain(*yielding(1)), *in_modes("it", 2)], "it_stiffness_factor", (.5, 2))
        single = abs(Recorded(self, reduced).displacement("top.x")).max()
        self.assertLess(abs(peaks.reshape(2, -1)[0].max() / single - 1), 1e-9)

    def test_damping_is_that_of_the_group(self):
        rayleigh = ("-it_damping_alpha", 2, "-it_damping_beta", 1e-3)
        self.assert_same(self.chain(*rayleigh, "-it_lower_damping_factor", 1.75),
                         self.chain(*rayleigh, "-it_lower_damping_alpha", 3.5, "-it_lower_damping_beta", 1.75e-3))

    def test_composite_damping_of_modes(self):
        k, m, d = numpy.array(STIFFNESS), numpy.diag(MASSES), (2.5, 0)
        stiffness = numpy.array([[k[0] + k[1], -k[1]], [-k[1], k[1]]])
        weighted = numpy.array([[d[0] * k[0] + d[1] * k[1], -d[1] * k[1]], [-d[1] * k[1], d[1] * k[1]]])
        root = numpy.diag(1 / numpy.sqrt(MASSES))
        squares, vectors = numpy.linalg.eigh(root @ stiffness @ root)
        expected = [vectors[:, i] @ root @ weighted @ root @ vectors[:, i] / squares[i] for i in range(2)]
        factors = ("-it_lower_damping_factor", d[0], "-it_upper_damping_factor", d[1])
        for ranks in (1, program.RANKS):
            run = Recorded(self, self.chain(*in_modes("it", 2), "-it_modal_damping", .04, "-modes", 2, *factors), ranks)
            found = [mode["damping_weight"] for mode in run.summary["structures"]["it"]["frequencies"]]
            numpy.testing.assert_allclose(found, expected, rtol=1e-9)
        self.assertGreater(expected[0], 1.5 * expected[1])
        ratios = ",".join(repr(.04 * weight) for weight in expected)
        self.assert_same(self.chain(*in_modes("it", 2), "-it_modal_damping", .04, *factors),
                         self.chain(*in_modes("it", 2), "-it_modal_damping", ratios), 1e-9)
        beta = (*in_modes("it", 2), "-it_damping_beta", 1e-3)
        self.assert_same(self.chain(*beta, "-it_lower_damping_factor", 1.5, "-it_upper_damping_factor", 1.5),
                         self.chain(*in_modes("it", 2), "-it_damping_beta", 1.5e-3), 1e-9)

    def test_wrong_use(self):
        self.refuse("out of range", "-it_lower_stiffness_factor", 0)
        self.refuse("not for the element point_mass", "-it_second_stiffness_factor", 2)
        self.refuse("take the damping of their structure", "-it_lower_damping_factor", 2, "-it_lower_tension_only", "true")
        self.refuse("not in a structure with -it_damping_uniform", "-it_lower_damping_factor", 2, "-it_damping_uniform", .04)

    def refuse(self, words, *more):
        result = program.run(self.chain(*more))
        self.assertEqual(result.returncode, 1)
        self.assertIn(words, result.stderr)


VELOCITY, DENSITY = 300.0, 1900.0
STIFF = "2e8,2e8,4e8,3e9,3e9,3e9"
SOIL = {"stiffness": numpy.diag([2e9, 2.5e9, 3e9, 3e11, 2e11, 4e11]), "dashpots": numpy.diag([3e7, 3e7, 8e7, 5e8, 5e8, 2e9]),
        "masses": numpy.diag([0, 0, 4e4, 0, 1e6, 0.]),
        "hidden": numpy.array([[0, 0, 1, 0, 0, 0, 2e7, 0, 4e5], [1, 0, 0, 0, 3, 0, 2e7, 6e8, 0], [0, 1, 0, -4, 0, 0, 1.5e7, 9e8, 3e5]])}


def write_soil(path, factor):
    """Numbers of SOIL, those of springs times a factor, those of dashpots times its root."""
    root = math.sqrt(factor)
    scales = {"stiffness": factor, "dashpots": root, "masses": 1, "hidden": numpy.array([1] * 6 + [root, factor, 1])}
    with open(path, "w") as file:
        file.write("pounding soil,1\nmats,1\nmisfit,x,0.01,5,0.005\n")
        for name, rows in SOIL.items():
            file.write(name + "\n" + "".join(",".join(repr(float(v)) for v in row) + "\n" for row in rows * scales[name]))
    return path


class Soil(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_samples(2 * numpy.sin(30 * numpy.arange(0, .4, 1e-3)), 1e-3)

    def block(self, *more, velocity=VELOCITY, legs=STIFF):
        """A body on springs over a mat on soil."""
        soil = () if "-block_soil_table" in more else (
            "-block_soil_vs", repr(velocity), "-block_soil_density", DENSITY, "-block_soil_poisson", .3)
        return ["-structures", "block", "-block_mesh", "tests/meshes/mat.geo", "-block_mesh_set", "height=8,offset=3,half=5",
                "-block_body_element", "point_mass", "-block_body_mass", 2e5, "-block_body_rotary_inertia", "1e6,1e6,1e6",
                "-block_soil_mat", "mat", *soil, "-block_corners_element", "point_mass", "-block_corners_mass", 4e4,
                "-block_legs_element", "spring", "-block_legs_stiffness", legs, *clock(2e-4, .3), *probes(top="block:body"),
                "-motion_x_record", self.record, "-motion_x_unit", "m/s2", "-motion_z_record", self.record,
                "-motion_z_unit", "m/s2", *more]

    def assert_same(self, words, by_hand, tolerance=1e-12):
        runs = [Recorded(self, list(given), identity=1e-11) for given in (words, by_hand)]
        for axis in "xyz":
            found, expected = (run.displacement(f"top.{axis}") for run in runs)
            scale = max(abs(expected).max(), 1e-4)
            self.assertLessEqual(abs(found - expected).max(), tolerance * scale)
        return runs[0]

    def test_half_space(self):
        for factor in (2.0, 1 / 1.5):
            for more in ((), ("-block_soil_frequency_dependence", "false"), ("-block_soil_shape", "disk"), in_modes("block", 8)):
                self.assert_same(self.block("-block_soil_factor", repr(factor), *more),
                                 self.block(*more, velocity=VELOCITY * math.sqrt(factor)))

    def test_table(self):
        with tempfile.TemporaryDirectory() as folder:
            nominal = write_soil(folder + "/soil.csv", 1)
            softer = write_soil(folder + "/softer.csv", .5)
            for more in ((), in_modes("block", 8)):
                self.assert_same(self.block("-block_soil_table", nominal, "-block_soil_factor", .5, *more),
                                 self.block("-block_soil_table", softer, *more))

    def test_building_on_it_has_a_factor_of_its_own(self):
        half = ",".join(repr(float(number) / 2) for number in STIFF.split(","))
        for more in ((), in_modes("block", 8)):
            self.assert_same(self.block("-block_stiffness_factor", .5, "-block_soil_factor", 2, *more),
                             self.block(*more, velocity=VELOCITY * math.sqrt(2), legs=half))

    def test_ensemble_has_the_factors_of_its_scene(self):
        reduced = [*self.block(*in_modes("block", 8)), "-block_stiffness_factor", .5, "-block_soil_factor", 2]
        single = Recorded(self, [*reduced, "-motion_x_scale", 1.5])
        peaks, residuals = ensemble_of(self, reduced, "motion_x_scale", (1, 1.5))
        self.assertLess(abs(residuals).max(), 1e-10)
        largest = max(abs(single.displacement(f"top.{axis}")).max() for axis in "xyz")
        self.assertLess(abs(peaks.reshape(2, -1)[1].max() / largest - 1), 1e-9)

    def test_wrong_use(self):
        self.refuse("goes with -block_soil_mat", "-block_soil_mat", "none", "-block_soil_factor", 2)
        self.refuse("out of range", "-block_soil_factor", -1)
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
            table.write("block_stiffness_factor\n1\n2\n")
            table.flush()
            self.refuse("the modes of structure block hold its soil as well; make an ensemble for each factor",
                        "-ensemble", table.name, *in_modes("block", 8))

    def refuse(self, words, *more):
        result = program.run(self.block(*more))
        self.assertEqual(result.returncode, 1)
        self.assertIn(words, result.stderr)


def with_factors():
    Soil.setUpClass()
    return Soil.block(Soil, "-block_soil_factor", 2, "-block_stiffness_factor", .5, "-block_legs_stiffness_factor", .8,
                      "-block_damping_beta", 1e-4, "-block_legs_damping_factor", 1.5)


ON_RANKS = {"factors on soil, structure and a group": with_factors}


class Leaning(Meshed):
    """Forces at rest that turn with a column have no part in the factor on its stiffness."""

    def test_factor_with_p_delta(self):
        def column(young, *more):
            return ["-structures", "it", "-it_mesh", "tests/meshes/cantilever.geo", "-it_mesh_set", "height=5,n=4", "-it_clamp",
                    "base", "-it_stem_element", "euler_beam", "-it_stem_material", "stuff", "-it_stem_section", "pipe",
                    *material("stuff", repr(young), .2, 2500), *section("pipe", .09, 1e-4, 1e-4, 1e-4, "1,0,0"),
                    "-it_top_element", "point_mass", "-it_top_mass", 2e4, "-gravity", 9.81, "-preload", "static", "-it_p_delta",
                    "true", *clock(1e-4, .2), *probes(top="it:top"), "-motion_x_record", self.record, "-motion_x_unit", "m/s2",
                    "-it_mass_scaling", 0, *more]
        for more in ((), in_modes("it", 6)):
            self.assert_same(column(3e10, "-it_stiffness_factor", .8, *more), column(2.4e10, *more))
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
            table.write("it_stiffness_factor\n1\n2\n")
            table.flush()
            result = program.run(column(3e10, *in_modes("it", 6), "-ensemble", table.name))
        self.assertEqual(result.returncode, 1)
        self.assertIn("hold its forces at rest (p_delta) as well", result.stderr)


if __name__ == "__main__":
    unittest.main()
