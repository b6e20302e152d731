"""Models whose parts are each in order and that cannot be meant draw one line of doubt with the place, or are refused;
so are options that nothing of the scene uses. What is wrong is named, not what stumbles over it."""
import os
import tempfile
import unittest

import program
from scene_checks_test import CHAIN

TABLE = ["-structures", "s", "-s_mesh", "tests/meshes/table.geo", "-s_slab_element", "shell", "-s_slab_thickness", "0.2",
         "-s_slab_material", "C30/37", "-s_column_element", "beam", "-s_column_section", "HEB200",
         "-section_HEB200_z_axis", "1,0,0", "-s_column_material", "S235", "-end_time", "0.1", "-modes", "3"]
FEET = [*TABLE, "-s_clamp", "base"]
PROBE = ["-probes", "p", "-p_structure", "s", "-p_at", "0,0,3"]

# A house of a slab on two walls, 6 m apart, and a wall 0.1 m beside it, all of shells.
HOUSES = """
Point(1) = {0, 0, 0}; Point(2) = {0, 4, 0}; Point(3) = {0, 4, 3}; Point(4) = {0, 0, 3};
Point(5) = {6, 0, 0}; Point(6) = {6, 4, 0}; Point(7) = {6, 4, 3}; Point(8) = {6, 0, 3};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5}; Line(9) = {4, 8}; Line(10) = {3, 7};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Curve Loop(3) = {9, -7, -10, 3}; Plane Surface(3) = {3};
Transfinite Curve {1:10} = 4; Transfinite Surface {1:3}; Recombine Surface {1:3};
Physical Surface("west") = {1}; Physical Surface("east") = {2}; Physical Surface("slab") = {3};
Physical Curve("feet") = {1, 5};
"""
POST = """
Point(9) = {0, 0, 5}; Line(11) = {4, 9}; Transfinite Curve {11} = 2; Physical Curve("post") = {11};
"""
WALL = """
x = 6.1;
Point(1) = {x, 0, 0}; Point(2) = {x, 4, 0}; Point(3) = {x, 4, 3}; Point(4) = {x, 0, 3};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = 4; Transfinite Surface {1}; Recombine Surface {1};
Physical Surface("wall") = {1}; Physical Curve("feet") = {1};
"""


class Doubts(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def doubts(self, words, ranks=1, dry=True):
        """Lines of doubt of a dry run."""
        result = program.run([*words, "-output", os.path.join(self.folder, "out"), *(["-dry_run"] if dry else [])], ranks)
        self.assertEqual(result.returncode, 0, result.stdout[-1000:] + result.stderr[-1000:])
        return [line[9:] for line in result.stdout.splitlines() if line.startswith("warning: ")]

    def one(self, words, *expected):
        lines = [line for line in self.doubts(words) if all(part in line for part in expected)]
        self.assertEqual(len(lines), 1, self.doubts(words))

    def refuse(self, words, *parts):
        return program.must_refuse(self, [*words, "-output", os.path.join(self.folder, "out")], *parts, ranks=1)


class WithoutMass(Doubts):
    def test_beams_that_weigh_nothing(self):
        self.one([*FEET, "-s_column_material", "light", "-material_light_young", 2e11, "-material_light_poisson", 0.3,
                  "-material_light_density", 0, "-s_mass_scaling", 1e-4], "material light: no density", "weigh nothing")


class WithoutEffect(Doubts):
    IDLE = {"loops_at": "0,0,0", "fields_start": "0.05", "fields_end": "0.08",
            "fields_format": "xdmf", "gap_interval": "1e-3", "force_window": "2e-3", "struck_areas": "1",
            "struck_edges": "1",
            "impact_merge_time": "2e-3", "gap_tolerance": "1e-9", "preload_solver": "direct", "courant": "0.5",
            "motion_level": "2", "resampling": "band_limited", "spectra_damping": "0.02", "spectra_frequencies": "10",
            "peak_frequency": "30", "write_modes": "true", "m_damping_factor": "2", "m_link1_dashpot_exponent": "0.5",
            "m_link1_hardening": "0.1"}

    def test_each_is_named_once(self):
        words = [word for name, value in self.IDLE.items() for word in (f"-{name}", value)]
        lines = self.doubts([*CHAIN, *words])
        named = sorted(line.split()[1] for line in lines if "has no effect" in line)
        self.assertEqual(named, sorted(f"-{name}" for name in self.IDLE))
        self.assertEqual(len(lines), len(self.IDLE), lines)

    def test_a_step_that_may_be_unstable_without_one(self):
        step = CHAIN.index("-time_step")
        self.one([*CHAIN[:step], *CHAIN[step + 2:], "-allow_unstable"], "option -allow_unstable", "goes with -time_step")

    def test_not_what_has_an_effect(self):
        used = ["-fields_interval", 0.01, "-fields_start", 0.05, "-m_damping_beta", 1e-5, "-m_damping_factor", 2,
                "-m_link1_dashpot", "1,1,1", "-m_link1_dashpot_exponent", 0.5, "-probes", "p", "-p_structure", "m", "-p_at",
                "1,0,0", "-spectra_frequencies", 10]
        self.assertEqual(self.doubts([*CHAIN, *used]), [])

    def test_not_what_was_switched_off_nor_defaults(self):
        off = ["-contacts", "none", "-force_window", "2e-3", "-fields_interval", 0, "-fields_start", 0.05, "-loops", "none",
               "-loops_at", "0,0,0", "-m_damping_factor", "1.0", "-m_link1_hardening", 0]
        self.assertEqual(self.doubts([*CHAIN, *off]), [])

    def test_not_when_all_options_in_force_are_repeated(self):
        self.assertEqual(self.doubts(CHAIN, dry=False), [])
        again = ["-options_file", os.path.join(self.folder, "out", "resolved.yaml"), "-output",
                 os.path.join(self.folder, "again"), "-dry_run"]
        self.assertNotIn("warning", program.run(again, 1).stdout)

    def test_a_support_that_moves_as_the_ground_does(self):
        motion = ["-motion_x_unit", "m/s2", "-motion_x_record", self.file("r.txt", "".join(
            f"{0.01 * i:.2f} {(-1) ** i}\n" for i in range(20)))]
        support = [*FEET, *motion, "-supports", "q", "-q_groups", "s"]
        self.one(support, "option -q_groups s has no effect")
        self.assertFalse([line for line in self.doubts([*support, "-q_delay", 0]) if "support" in line])


class Silent(Doubts):
    def test_quantities_in_other_units(self):
        for words, *expected in (
                (["-s_slab_mass_per_area", 0.4], "group slab: mass_per_area 0.4 kg/m2", "t/m2"),
                (["-s_column_mass_per_length", 0.03], "group column: mass_per_length 0.03 kg/m", "t/m"),
                (["-gravity", 1, "-preload", "static"], "gravity 1 m/s2", "in g"),
                (["-s_gravity", "0,0,9.81", "-preload", "static"], "gravity acts upwards"),
                (["-contacts", "c", "-c_secondary", "s:slab", "-c_primary", "wall", "-c_gap", 0.1, "-c_friction", 3],
                 "contact c: friction 3", "percent"),
                (["-contacts", "c", "-c_secondary", "s:slab", "-c_primary", "wall", "-c_gap", 0.1, "-c_filler",
                  "0.1:0.02,0.7:0.05", "-c_filler_unloading", 10], "contact c, filler: its largest pressure 0.05 Pa", "MPa")):
            with self.subTest(expected[0]):
                self.one([*FEET, *words], *expected)
        self.assertEqual(self.doubts([*FEET, "-s_slab_mass_per_area", 400, "-gravity", 9.81, "-preload", "static"]), [])

    def test_a_trolley_in_tonnes(self):
        mass = ["-s_base_element", "point_mass", "-s_base_mass"]
        heavy = [*FEET, "-s_mesh_set", "unit=10", "-s_slab_thickness", 1]
        self.one([*heavy, *mass, 25], "group base: mass 25 kg", "is it in t?")
        self.assertEqual(self.doubts([*heavy, *mass, 25000]), [])
        self.assertEqual(self.doubts([*FEET, *mass, 25]), [])

    def test_a_motion_that_arrives_after_the_run(self):
        motion = ["-motion_x_unit", "m/s2", "-motion_x_record", self.file("r.txt", "".join(
            f"{0.01 * i:.2f} {(-1) ** i}\n" for i in range(20)))]
        support = [*FEET, *motion, "-supports", "q", "-q_groups", "s", "-q_delay"]
        lines = self.doubts([*support, 80])
        self.assertTrue([line for line in lines if "delay 80 s" in line and "in ms" in line], lines)
        self.assertTrue([line for line in lines if "support q: the motion arrives after 80 s" in line], lines)
        self.assertFalse([line for line in self.doubts([*support, 0.02]) if "delay" in line or "arrives" in line])

    def test_walls_as_a_mat(self):
        soil = [*TABLE, "-s_mesh_set", "both=1", "-s_soil_density", 1800, "-s_soil_poisson", 0.3, "-s_soil_vs"]
        self.one([*soil, 200, "-s_soil_mat", "column"], "group column", "from z = 0 to 3 m", "-s_soil_mat")
        self.one([*soil, 0.4, "-s_soil_mat", "base"], "soil_vs 0.4 m/s", "km/s")
        self.assertEqual(self.doubts([*soil, 200, "-s_soil_mat", "base"]), [])

    def test_contact_through_a_building(self):
        pair = ["-structures", "a,b", "-a_mesh", self.file("a.geo", HOUSES), "-b_mesh", self.file("b.geo", WALL), "-end_time",
                0.01, "-modes", 0, "-contacts", "c", "-c_primary", "b:wall", "-a_clamp", "feet", "-b_clamp", "feet",
                "-a_initial_velocity", "0.1,0,0"]
        for group in ("a_west", "a_east", "a_slab", "b_wall"):
            pair += [f"-{group}_element", "shell", f"-{group}_thickness", 0.1, f"-{group}_material", "C30/37"]
        for gap in ("geometry", 0.04):
            self.one([*pair, "-c_secondary", "a:west", "-c_gap", gap], "contact c", "lies structure a at (",
                     "goes through a building")
            self.assertEqual(self.doubts([*pair, "-c_secondary", "a:east", "-c_gap", gap]), [])

    def test_joint_that_nothing_closes(self):
        far = WALL.replace("x = 6.1", "x = 60")
        pair = ["-structures", "a,b", "-a_mesh", self.file("a.geo", WALL), "-b_mesh", self.file("b.geo", far), "-end_time",
                0.01, "-modes", 0, "-contacts", "c", "-c_primary", "b:wall", "-c_secondary", "a:wall", "-a_clamp", "feet",
                "-b_clamp", "feet"]
        for group in ("a_wall", "b_wall"):
            pair += [f"-{group}_element", "shell", f"-{group}_thickness", 0.1, f"-{group}_material", "C30/37"]
        self.one(pair, "contact c: its faces are at least 53.8 m apart", "across the joint")

    def test_storey_above_the_roof(self):
        force = [*FEET, "-forces", "f", "-f_structure", "s", "-f_kind", "storey", "-f_level"]
        self.refuse([*force, 50], "-f_level", "no node of s lies above 50 m", "from 0 to 3 m")
        self.assertEqual(self.doubts([*force, 2]), [])

    def test_a_cabinet_as_a_storey(self):
        """A post on the slab of the house: no floor of it."""
        words = ["-structures", "a", "-a_mesh", self.file("a.geo", HOUSES + POST), "-end_time", 0.01, "-modes", 0, "-a_clamp", "feet",
                 "-a_post_element", "beam", "-a_post_material", "S235", "-a_post_section", "HEB200", "-a_allow_loose",
                 "-section_HEB200_z_axis", "1,0,0", "-probes", "roof,cabinet", "-roof_structure", "a", "-roof_at", "0,0,3",
                 "-roof_floor", "-cabinet_structure", "a", "-cabinet_at", "0,0,5", "-spectra_frequencies", 4,
                 "-a_initial_velocity", "0.1,0,0"]
        for group in ("a_west", "a_east", "a_slab"):
            words += [f"-{group}_element", "shell", f"-{group}_thickness", 0.1, f"-{group}_material", "C30/37"]
        self.one([*words, "-cabinet_floor"], "probe cabinet", "z = 5 m", "-cabinet_floor")
        self.assertEqual(self.doubts(words), [])

    def test_frames_without_number(self):
        self.one([*FEET, "-fields_interval", 1e-9], "-fields_interval 1e-09 s", "frames come every")
        self.one([*FEET, "-fields_interval", 1e-9, "-end_time", 1e6], "frames every", "GB, and", "GB left")
        self.assertEqual(self.doubts([*FEET, "-fields_interval", 1e-3]), [])

    def test_spectra_above_the_samples(self):
        motion = ["-motion_x_unit", "m/s2", "-motion_x_record", self.file("r.txt", "".join(
            f"{0.01 * i:.2f} {(-1) ** i}\n" for i in range(20)))]
        self.one([*FEET, *PROBE, *motion], "its mesh carries waves up to 37 Hz, by elements of 1 m of slab", "to 400 Hz")
        self.one([*FEET, *PROBE, *motion, "-spectra_frequencies", "1:400:9lin"], "go to 400 Hz", "samples of the motion every 0.01 s", "above 50 Hz")
        self.one([*FEET, *PROBE, *motion, "-spectra_frequencies", "1:40:9lin", "-output_interval", 0.02],
                 "go to 40 Hz", "samples of the probes every 0.02 s")
        self.one([*FEET, *PROBE, *motion, "-spectra_frequencies", "1:50:9lin"], "its mesh carries waves", "to 50 Hz")

    def test_matrices_in_other_units(self):
        folder = os.path.join(self.folder, "matrices")
        self.doubts([*FEET, "-export_matrices", folder])
        own = os.path.join(folder, "s") if os.path.isdir(os.path.join(folder, "s")) else folder
        words = [*FEET, "-s_matrices", own]
        self.assertEqual(self.doubts(words), [])
        self.scale(os.path.join(own, "stiffness.mtx"), 1e-3)
        self.one(words, "first frequency is", "N/mm")
        self.scale(os.path.join(own, "stiffness.mtx"), 1e3)
        self.scale(os.path.join(own, "mass.mtx"), 1e-3)
        self.one(words, "its mass is", "not t")

    @staticmethod
    def scale(path, factor):
        with open(path) as file:
            lines = file.read().splitlines()
        data = [i for i, line in enumerate(lines) if not line.startswith("%")][1:]
        for i in data:
            *where, value = lines[i].split()
            lines[i] = " ".join([*where, repr(float(value) * factor)])
        with open(path, "w") as file:
            file.write("\n".join(lines) + "\n")


class Culprit(Doubts):
    def test_a_section_that_is_not_there(self):
        words = list(FEET)
        words[words.index("HEB200")] = "HEB405"
        self.refuse(words, "-s_column_section HEB405", "did you mean HEB400?")

    def test_a_slip_in_the_options_of_a_material(self):
        words = list(FEET)
        words[words.index("C30/37")] = "conc"
        self.refuse([*words, "-material_conc_yuong", 3e10, "-material_conc_poisson", 0.2, "-material_conc_density", 2400],
                    "-material_conc_yuong", "did you mean -material_conc_young?")

    def test_gravity_with_a_sign(self):
        self.refuse([*FEET, "-gravity", -9.81], "-gravity -9.81", "acts along -z", "leave the sign out")

    def test_feet_that_slide(self):
        line = self.refuse([*TABLE, "-s_clamp", "base:x+y", "-s_damping_uniform", 0.05], "structure s: none of its first 3 modes",
                           "the first, along ", "-s_clamp", "-s_damping_reference")
        self.assertLess(line.index("-s_clamp"), line.index("_damping_uniform"))

    def test_size_is_told_before_what_fails_by_it(self):
        for more, part in ((["-gravity", 9.81, "-preload", "static"], "units of mesh and materials"),
                           (["-s_damping_uniform", 0.05], "units of mesh and materials")):
            result = program.run([*FEET, "-s_mesh_set", "unit=200", *more, "-output", self.folder], 1)
            self.assertEqual(result.returncode, 1)
            self.assertIn("warning: structure s: its mesh is 600 m long; meshes are in metres", result.stdout)
            self.assertIn(part, program.error_lines(result)[0])


class Slenderness(Doubts):
    @staticmethod
    def chain(heights, extra=""):
        """A column of one beam per storey, each a group of its own, with a point of each floor."""
        points = "".join(f"Point({i + 1}) = {{0, 0, {z}}};" for i, z in enumerate(heights))
        return points + "".join(
            f"Line({i}) = {{{i}, {i + 1}}}; Transfinite Curve {{{i}}} = 2; Physical Curve(\"b{i}\") = {{{i}}}; "
            f"Physical Point(\"m{i}\") = {{{i + 1}}};" for i in range(1, len(heights))) + 'Physical Point("base") = {1};' + extra + "\n"

    def stick(self, heights, areas, inertias, masses, young, poisson, extra="", more=()):
        words = ["-structures", "s", "-s_mesh", self.file("stick.geo", self.chain(heights, extra)), "-s_clamp", "base", "-end_time",
                 0.1, "-material_c_young", young, "-material_c_poisson", poisson, "-material_c_density", 1e-4, *more]
        for i, (area, inertia, mass) in enumerate(zip(areas, inertias, masses), 1):
            words += [f"-s_b{i}_element", "beam", f"-s_b{i}_material", "c", f"-s_b{i}_section", f"q{i}", f"-s_m{i}_element",
                      "point_mass", f"-s_m{i}_mass", mass, f"-section_q{i}_area", area, f"-section_q{i}_inertia_y", inertia,
                      f"-section_q{i}_inertia_z", inertia / 2, f"-section_q{i}_torsion", 2 * inertia, f"-section_q{i}_z_axis", "1,0,0"]
        return words

    def square(self, count, length, extra="", more=()):
        """A column of one square metre in `count` beams."""
        heights = [length * i / count for i in range(count + 1)]
        return self.stick(heights, [1] * count, [1 / 12] * count, [1e-9] * count, 3e10, 0.2, extra, more)

    def thick(self, words, ranks=1):
        return [line for line in self.doubts(words, ranks) if "slenderness" in line]

    def test_a_stick_model_of_a_plant_building(self):
        """Each region by the height of the whole stick, which lies in one line; the mast on its top is slender."""
        stick = self.stick([0, 8, 13, 22, 33.5, 49, 61, 93], [2000, 2560, 2210, 1960, 1740, 780, 190],
                           [1.1e6, 1.2e6, 1.2e6, 1.3e6, 9e5, 2e5, 900], [85.52, 76.32, 193.22, 114.29, 263.4, 37.12, 25.17],
                           3.45e5, 0.278)
        lines = self.thick(stick)
        self.assertEqual(len(lines), 6, lines)
        for part in ("group b1: slenderness 3.97", "being 93 m long", "give section q1 a shear_area"):
            self.assertIn(part, lines[0])
        self.assertFalse([line for line in lines if "group b7" in line])

    def test_share_of_shear(self):
        line, = self.thick(self.square(1, 2))
        # 12 E I / (kappa G A L2), and 12.36 E I / L4 over (pi / 2)^2 kappa G A / L2, which add as flexibilities
        held = 100 * 12 / 12 * 2.4 / (5 / 6) / 2 ** 2
        self.assertIn(f"{held:.3g} % more flexible held at both ends", line)
        self.assertIn(f"{held * 12.36 / 2.467 / 12:.3g} % as a cantilever", line)

    def test_lines_of_several_beams(self):
        """Arms do not divide them, and beams across are lines of their own."""
        self.assertEqual(len(self.thick(self.square(8, 4))), 8)
        self.assertEqual(self.thick(self.square(8, 20)), [])
        arm = ("Point(20) = {0, 1, 10}; Line(20) = {5, 20}; Transfinite Curve {20} = 2; Physical Curve(\"arm\") = {20};",
               ("-s_arm_element", "beam", "-s_arm_material", "c", "-s_arm_section", "q1"))
        line, = self.thick(self.square(8, 20, *arm))
        for part in ("group arm:", "being 1 m long"):
            self.assertIn(part, line)

    def test_not_where_shear_counts(self):
        """Nor of the beams with shear areas in a line of which some have none."""
        stick = self.square(3, 3)
        self.assertEqual(len(self.thick(stick)), 3)
        given = [word for i in (1, 2, 3) for word in (f"-section_q{i}_shear_area", "0.8,0.8")]
        self.assertEqual(self.thick(stick + given), [])
        line, = self.thick(stick + given[2:])
        self.assertIn("group b1", line)
        euler = [word for i in (1, 2, 3) for word in (f"-s_b{i}_element", "euler_beam")]
        lines = self.thick(stick + given + euler)
        self.assertEqual(len(lines), 3)
        self.assertIn("let its element be beam", lines[0])

    def test_not_of_slender_columns_and_the_plant(self):
        self.assertEqual(self.thick(FEET), [])
        self.assertEqual(self.thick(["-options_file", "petsc-options/plant/small.yaml"]), [])


if __name__ == "__main__":
    unittest.main()
