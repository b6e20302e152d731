"""Beams whose sections yield: closed forms of one beam, sticks against the linear ones, ranks, rests, continued runs.

One beam whose end only sways is a spring k = 1 / (L / G A + L^3 / (12 E I)) that yields at Q in shear: a mass that is
thrown at it turns back where its energy is spent.
"""
import math
import os
import re
import shutil
import tempfile
import unittest

import numpy

import program
from loops_test import Loops
from recorded import Recorded, assert_continues, ensemble_of

YOUNG, POISSON = 30e9, 0.2
SHEAR = YOUNG / (2 * (1 + POISSON))
LENGTH, AREA, INERTIA = 4.0, 1.0, 1 / 12
SECTION = ["-section_wall_area", 1, "-section_wall_inertia_y", repr(INERTIA), "-section_wall_inertia_z", repr(INERTIA),
           "-section_wall_torsion", 0.14, "-section_wall_shear_area", "0.8,0.8", "-section_wall_z_axis", "0,0,1",
           "-material_concrete_young", YOUNG, "-material_concrete_poisson", POISSON]
STIFF = SHEAR * 0.8
BENDS = YOUNG * INERTIA


def pairs(first_slope, *corners):
    """A skeleton whose first corner is given by its force, the others by multiples of its elongation."""
    force = corners[0]
    values = [force / first_slope, force]
    for ductility, at in corners[1:]:
        values += [ductility * force / first_slope, at]
    return ",".join(repr(value) for value in values)


def beam(*more, time_step=1e-5, end=0.1, mass=2e5):
    """One beam along x with a mass at its end."""
    return ["-structures", "one", "-one_mesh", "tests/meshes/line.geo", "-one_mesh_set", f"length={LENGTH},n=1",
            "-one_line_element", "beam", "-one_line_material", "concrete", "-one_line_section", "wall",
            "-material_concrete_density", 1e-3, "-one_x_max_element", "point_mass", "-one_x_max_mass", mass, *SECTION,
            "-time_step", repr(time_step), "-end_time", end, "-output_interval", repr(time_step), "-energy_interval", 10,
            "-probes", "tip", "-tip_structure", "one", "-tip_at", f"{LENGTH},0,0", *more]


class OneBeam(unittest.TestCase):
    def test_in_shear(self):
        stiffness = 1 / (LENGTH / STIFF + LENGTH**3 / (12 * BENDS))
        mass, speed, force = 2e5, 1.5, 4e6
        top = force / stiffness + (mass * speed**2 / 2 - force**2 / stiffness / 2) / force
        for axis, across in (("z", "y"), ("y", "z")):
            velocity = f"0,{speed if axis == 'y' else 0},{speed if axis == 'z' else 0}"
            run = Recorded(self, beam(
                "-one_clamp", f"x_min,x_max:x+{across}+rx+ry+rz", "-one_initial_velocity", velocity,
                f"-one_line_shear_skeleton_{axis}", pairs(STIFF, force)))
            found = run.displacement(f"tip.{axis}")
            self.assertAlmostEqual(found.max() / top, 1, delta=1e-5)
            found = run.summary["yielding"][f"one:line:shear_{axis}"]
            self.assertEqual((found["elements"], found["yielded"]), (1, 1))
            sheared = (top - force * LENGTH**3 / (12 * BENDS)) / LENGTH  # its force is that of the flat skeleton
            self.assertAlmostEqual(found["ductility"] / (sheared * STIFF / force), 1, delta=1e-5)
            self.assertAlmostEqual(found["energy_lost"] / run.energy["plastic"], 1, delta=1e-9)

    def test_ductility_is_of_the_shear_strain(self):
        """Pushed beyond the first corner slowly, a slender beam: its sway is mostly bending, its ductility the section's."""
        force, hardening, push = 4e6, 0.2, 5.6e6
        strain = (force + (push - force) / hardening) / STIFF
        run = Recorded(self, beam("-one_clamp", "x_min,x_max:x+z+rx+ry+rz", "-one_line_shear_skeleton_y",
                                  pairs(STIFF, force, (100, force * (1 + 99 * hardening))), "-one_line_shear_rule", "peak", "-loads",
                                  "push", "-push_on", "one:x_max", "-push_force", f"0,{push},0", "-preload", "static", end=1e-3))
        self.assertAlmostEqual(run.summary["yielding"]["one:line:shear_y"]["ductility"] / (strain * STIFF / force), 1, delta=1e-3)

    def test_unloading_is_that_of_the_section(self):
        """Pushed far and let go slowly, a slender beam: the shear strain that stays is that of the section's rule."""
        force, hardening, push, exponent = 4e6, 0.2, 7e6, 0.6
        run = Recorded(self, beam("-one_clamp", "x_min,x_max:x+z+rx+ry+rz", "-one_line_shear_skeleton_y",
                                  pairs(STIFF, force, (100, force * (1 + 99 * hardening))), "-one_line_shear_rule", "peak",
                                  "-one_line_unloading_exponent", exponent, "-loads", "push", "-push_on", "one:x_max", "-push_force",
                                  f"0,{push},0", "-push_values", "0,0;1,1;2,0", "-one_damping_alpha", 5, time_step=1e-3, end=2, mass=2e4))
        found, bends = run.displacement("tip.y"), LENGTH**3 / (12 * BENDS)
        strain = (found.max() - (1 - hardening) * force * bends) / (LENGTH + hardening * STIFF * bends)
        top = force + hardening * (STIFF * strain - force)
        stays = strain - top / STIFF / (top / strain / STIFF)**exponent
        self.assertAlmostEqual(found[-1] / (stays * LENGTH), 1, delta=5e-3)

    def test_without_flexibility_in_shear(self):
        words = ["euler_beam" if word == "beam" else word for word in beam("-one_line_shear_skeleton_y", pairs(STIFF, 4e6))]
        program.must_refuse(self, words, "-one_line_shear_skeleton_y", "no strength in it", "-one_line_element beam", ranks=1)


class AtRest(unittest.TestCase):
    """One beam pushed at its end, at rest beyond its first corner."""
    MOMENT, HARDENING = 4e6, 0.05

    def rest(self, push, *more, hardening=HARDENING, rule="kinematic", ranks=1):
        corners = [self.MOMENT, (100, self.MOMENT * (1 + 99 * hardening))]
        words = beam("-one_clamp", "x_min", "-one_x_max_rotary_inertia", "1e5,1e5,1e5", "-one_line_bending_skeleton_z",
                     pairs(BENDS, *corners), "-one_line_bending_rule", rule, "-loads", "push", "-push_on", "one:x_max",
                     "-push_force", ",".join(map(repr, push)), "-preload", "static", *more, end=1e-3)
        return Recorded(self, words, ranks) if ranks else words

    def curvature(self, moment, strength=1.0):
        first = strength * self.MOMENT
        return moment / BENDS if moment < first else (first + (moment - first) / self.HARDENING) / BENDS

    def assert_stays(self, run, expected, tolerance):
        self.assertLess(abs(run.displacement("tip.y") / expected - 1).max(), tolerance)

    def tip(self, push, curvature):
        """Deflection of the tip by a force there, the middle of the beam having a curvature."""
        return push * (LENGTH / STIFF + LENGTH**3 / (12 * BENDS)) + curvature * LENGTH * LENGTH / 2

    def test_axial_force_takes_from_the_strength(self):
        push = 2.2e6
        for axial, exponent in ((0, 1), (3e6, 1), (-3e6, 2)):
            strength = 1 - (abs(axial) / 1.2e7)**exponent
            run = self.rest((axial, push, 0.0), "-one_line_bending_axial", f"1.2e7,{exponent}")
            curvature = self.curvature(push * LENGTH / 2, strength)
            self.assert_stays(run, self.tip(push, curvature), 1e-8)
            found = run.summary["yielding"]["one:line:bending_z"]["ductility"]
            self.assertAlmostEqual(found / (curvature * BENDS / strength / self.MOMENT), 1, delta=1e-8)
        program.must_refuse(self, self.rest((0, push, 0), "-one_line_bending_axial", 1e7, rule="peak", ranks=0), "kinematic")
        modal = self.rest((0, push, 0), "-one_line_bending_axial", 1e7, "-one_model", "modal", ranks=0)
        program.must_refuse(self, modal, "-one_model full")

    def leaning(self, push, weight, slope, offset):
        """Deflection and rotation of the tip under a weight along the beam: the moment in its middle is slope times
        the rotation, and an offset; the geometric stiffness is the consistent one."""
        phi = 12 * BENDS / (STIFF * LENGTH**2)
        sway = 1 / (LENGTH / STIFF + LENGTH**3 / (12 * BENDS))
        turned = -weight / (30 * LENGTH * (1 + phi)**2) * numpy.array(
            [[36 + 60 * phi + 30 * phi**2, -3 * LENGTH], [-3 * LENGTH, (4 + 5 * phi + 2.5 * phi**2) * LENGTH**2]])
        matrix = sway * numpy.array([[1, -LENGTH / 2], [-LENGTH / 2, LENGTH**2 / 4]]) + turned
        matrix[1, 1] += slope
        return numpy.linalg.solve(matrix, [push, -offset])

    def test_p_delta_of_a_yielded_column(self):
        mass = 1e6
        weight, first = mass * 9.81, BENDS / LENGTH
        lean = ["-one_x_max_mass", mass, "-one_gravity", "-9.81,0,0", "-one_p_delta", "true"]
        for push in (1.2e6, 2.2e6):
            linear = self.leaning(push, weight, first, 0)
            yields = first * linear[1] > self.MOMENT
            expected = self.leaning(push, weight, self.HARDENING * first, (1 - self.HARDENING) * self.MOMENT) if yields else linear
            run = self.rest((0, push, 0), *lean)
            self.assert_stays(run, expected[0], 1e-7)
            self.assertAlmostEqual(run.summary["yielding"]["one:line:bending_z"]["ductility"] * self.MOMENT / first / expected[1],
                                   1, delta=1e-7)
        self.assertTrue(yields)
        self.assertGreater(expected[0], 1.2 * self.tip(push, self.curvature(push * LENGTH / 2)))
        # Where hardening is less than the weight takes, the column is gone as soon as it yields.
        at_one = self.leaning(1.0, weight, first, 0)[1] * first
        for part in (0.999, 1.001):
            words = self.rest((0, part * self.MOMENT / at_one, 0), *lean, hardening=0.005, ranks=0)
            if part < 1:
                self.assertLess(Recorded(self, words, 1).summary["yielding"]["one:line:bending_z"]["ductility"], 1)
            else:
                program.must_refuse(self, words, "yielding elements carry less", ranks=1)

    def test_hinge_with_a_length(self):
        """A short beam that yields at the foot of an elastic one: its rotation is its curvature times its length."""
        hinge = 0.4
        with tempfile.NamedTemporaryFile("w", suffix=".geo") as mesh:
            mesh.write(f"Point(1) = {{0, 0, 0}}; Point(2) = {{{hinge}, 0, 0}}; Point(3) = {{{LENGTH}, 0, 0}};\n"
                       "Line(1) = {1, 2}; Line(2) = {2, 3}; Transfinite Curve {1, 2} = 2;\nPhysical Curve(\"hinge\") = {1};\n"
                       "Physical Curve(\"line\") = {2}; Physical Point(\"x_min\") = {1}; Physical Point(\"x_max\") = {3};\n")
            mesh.flush()
            for push in (0.9e6, 1.1e6, 1.3e6):
                words = beam("-one_mesh", mesh.name, "-one_clamp", "x_min", "-one_x_max_rotary_inertia", "1e5,1e5,1e5",
                             "-one_hinge_element", "beam", "-one_hinge_material", "concrete", "-one_hinge_section", "wall",
                             "-one_hinge_bending_skeleton_z", pairs(BENDS, self.MOMENT, (100, self.MOMENT * 5.95)),
                             "-material_concrete_density", 2400, "-loads", "push", "-push_on", "one:x_max", "-push_force",
                             f"0,{push},0", "-preload", "static", end=1e-3)
                moment = push * (LENGTH - hinge / 2)
                plastic = (self.curvature(moment) - moment / BENDS) * hinge
                expected = push * (LENGTH**3 / (3 * BENDS) + LENGTH / STIFF) + plastic * (LENGTH - hinge / 2)
                run = Recorded(self, [word for word in words if word not in ("-one_mesh_set", f"length={LENGTH},n=1")], 1)
                self.assert_stays(run, expected, 1e-8)
                self.assertEqual(plastic > 0, run.summary["yielding"]["one:hinge:bending_z"]["ductility"] > 1)


STICK_STEP = 1e-4


def stick(*more, time_step=STICK_STEP, end=0.6, factor=1.0):
    """Four storeys of 4 m with a mass on each, shaken along x and y."""
    shear = pairs(STIFF, factor * 1.2e6, (3, factor * 1.7e6), (15, factor * 2.4e6))
    moment = pairs(BENDS, factor * 5e6, (3, factor * 8e6), (20, factor * 1e7))
    return ["-structures", "s", "-s_mesh", "tests/meshes/stick.geo", "-s_clamp", "foot", "-s_column_element", "beam",
            "-s_column_material", "concrete", "-s_column_section", "wall", "-s_column_divide", 2,
            "-material_concrete_density", 2400, "-s_floors_element", "point_mass", "-s_floors_mass", 1e5,
            "-s_floors_rotary_inertia", "1e5,1e5,1e5", *SECTION[:-6], "-section_wall_z_axis", "1,0,0", *SECTION[-4:],
            "-s_column_shear_skeleton_y", shear, "-s_column_shear_skeleton_z", shear,
            "-s_column_bending_skeleton_y", moment, "-s_column_bending_skeleton_z", moment,
            "-time_step", repr(time_step), "-end_time", end, "-output_interval", repr(5 * time_step),
            "-energy_interval", 5, "-probes", "roof", "-roof_structure", "s", "-roof_at", "0,0,16", *more]


class Stick(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        time = numpy.arange(0, 0.7, 0.005)
        cls.wave = 20 * numpy.sin(2 * numpy.pi * 4 * time) * numpy.sin(numpy.pi * time / 0.7)
        cls.record = program.write_samples(cls.wave, 0.005)
        cls.motion = ["-motion_x_record", cls.record, "-motion_x_unit", "m/s2", "-motion_y_record", cls.record,
                      "-motion_y_unit", "m/s2", "-motion_y_scale", 0.7]

    @classmethod
    def tearDownClass(cls):
        os.remove(cls.record)

    def unmarked(self, words):
        """The same words without laws of sections."""
        return [word for before, word in zip(["", *words], words) if "_skeleton_" not in f"{before}{word}"]

    def test_elastic_it_is_the_linear_one(self):
        for damping in (["-s_damping_beta", 1e-4], ["-s_damping_uniform", 0.04]):
            words = stick(*self.motion, *damping, factor=1e4)
            linear = Recorded(self, self.unmarked(words), 1)
            marked = Recorded(self, words)
            for channel in ("roof.x", "roof.y"):
                expected = linear.displacement(channel)
                self.assertGreater(abs(expected).max(), 1e-2)
                self.assertLess(abs(marked.displacement(channel) - expected).max(), 1e-11 * abs(expected).max())

    def test_yields_alike_continued(self):
        words = stick(*self.motion, "-s_damping_beta", 1e-4, "-s_gravity", "0,0,-9.81")
        whole = Recorded(self, words, 1)
        yielding = whole.summary["yielding"]
        for part in ("shear_y", "shear_z", "bending_y", "bending_z"):
            self.assertGreater(yielding[f"s:column:{part}"]["ductility"], 1.5, part)
        self.assertGreater(sum(part["energy_lost"] for part in yielding.values()), 1e4)
        lost = sum(part["energy_lost"] for part in yielding.values())
        self.assertAlmostEqual(lost / whole.energy["plastic"], 1, delta=1e-3)
        assert_continues(self, [*words, "-modes", 1, "-spectra_frequencies", 10, "-loops", "s:column"], 0.3, 2000)

    def test_on_a_support_that_moves_on_its_own(self):
        """By the motion of the ground it yields as on the ground, and the support's work is in the ledger."""
        words = stick("-s_damping_beta", 1e-4)
        ground = Recorded(self, [*words, *self.motion], 1)
        moved = [word.replace("-motion", "-base_motion") if isinstance(word, str) else word for word in self.motion]
        run = Recorded(self, [*words, "-supports", "base", "-base_groups", "s:foot", *moved, "-probes", "roof,foot",
                              "-foot_structure", "s", "-foot_at", "0,0,0"])
        for axis in "xy":
            expected = ground.displacement(f"roof.{axis}")
            found = run.displacement(f"roof.{axis}") - run.displacement(f"foot.{axis}")
            self.assertLess(abs(found - expected).max(), 1e-9 * abs(expected).max())
        for law, of in ground.summary["yielding"].items():
            self.assertAlmostEqual(run.summary["yielding"][law]["energy_lost"] / of["energy_lost"], 1, delta=1e-8)
        self.assertAlmostEqual(run.energy["plastic"] / ground.energy["plastic"], 1, delta=1e-6)

    def test_second_order(self):
        end = ["-end_time", 0.5, "-output_interval", 0.005]
        x = [Recorded(self, stick(*self.motion, *end, time_step=step), 1).displacement("roof.x")
             for step in (1e-4, 5e-5, 1.25e-5)]
        errors = [abs(found - x[-1]).max() for found in x[:-1]]
        self.assertLess(errors[1], errors[0] / 3)
        self.assertLess(errors[1], 1e-4 * abs(x[-1]).max())

    def test_loops_take_what_the_table_says(self):
        words = [*stick(*self.motion), "-output_interval", repr(STICK_STEP), "-loops", "s:column"]
        run = Loops(self, words, 2)
        self.assertEqual(len(run.names), 8 * 4)
        self.assertTrue(run.names[0].endswith(".shear_y"), run.names[0])
        work = ((run.force[1:] + run.force[:-1]) / 2 * numpy.diff(run.elongation, axis=0)).sum()
        self.assertAlmostEqual(work / run.summary["loops"]["s:column"]["energy_taken"], 1, delta=1e-2)
        # The farthest point of each loop is on the skeleton of the section.
        half = 2.0  # m, of one of the two beams of a storey
        for name, e, f in zip(run.names, run.elongation.T, run.force.T):
            shear = ".shear" in name
            first, slope = (1.2e6, STIFF) if shear else (5e6, BENDS)
            corners = [(1, first), (3, 1.7e6), (15, 2.4e6)] if shear else [(1, first), (3, 8e6), (20, 1e7)]
            along = [half * d * first / slope + (force * half**3 / 12 / BENDS if shear else 0) for d, force in corners]
            far = abs(e).argmax()
            on = numpy.interp(abs(e[far]), [0, *along], [0, *(force for _, force in corners)])
            self.assertAlmostEqual(abs(f[far]) / on, 1, delta=1e-9, msg=name)
        lost = sum(part["energy_lost"] for part in run.summary["yielding"].values())
        self.assertGreater(lost, 0.1 * work)
        self.assertLess(lost, work)

    def test_rest_under_gravity(self):
        gravity = ["-s_gravity", "0.4,0,-9.81", "-preload", "static", "-end_time", 0.05]
        for damping in (["-s_damping_beta", 1e-4], ["-s_damping_uniform", 0.04]):
            run = Recorded(self, stick(*gravity, *damping))
            x = run.displacement("roof.x")
            self.assertGreater(abs(x[0]), 1e-4)
            self.assertLess(abs(x - x[0]).max(), 1e-10 * abs(x[0]))

    def test_rest_beyond_the_first_corner(self):
        """Moments of a stick that leans are those of its weights: each section is on its skeleton."""
        masses = {2.0 * i: 4800 + 1e5 * (i % 2 == 0) for i in range(1, 8)} | {16.0: 1e5 + 2400}
        moment = sum(0.4 * mass * (height - 1) for height, mass in masses.items())
        ductility = 1 + 2 * (moment - 1e6) / 6e5
        found = []
        for damping in (["-s_damping_beta", 1e-4], ["-s_damping_uniform", 0.04]):
            run = Recorded(self, stick("-s_gravity", "0.4,0,-9.81", "-preload", "static", "-end_time", 0.05, *damping,
                                       factor=0.2))
            self.assertAlmostEqual(run.summary["yielding"]["s:column:bending_y"]["ductility"] / ductility, 1, delta=1e-8)
            self.assertEqual(run.summary["yielding"]["s:column:shear_y"]["yielded"], 0)
            self.assertLess(run.energy["plastic"], 1e-9 * run.energy["strain"])
            found.append(run.displacement("roof.x"))
            self.assertLess(abs(found[-1] - found[-1][0]).max(), 1e-9 * found[-1][0])
        self.assertAlmostEqual(found[1][0] / found[0][0], 1, delta=1e-9)
        reduced = Recorded(self, [*stick("-s_gravity", "0.4,0,-9.81", "-preload", "static", factor=0.2), "-end_time", 0.05,
                                  "-s_model", "modal", "-time_step", repr(STICK_STEP / 2), "-s_modal_vectors", 10000])
        x = reduced.displacement("roof.x")
        self.assertLess(abs(x / found[0][0] - 1).max(), 1e-8)
        program.must_refuse(self, stick("-s_gravity", "4,0,-9.81", "-preload", "static", factor=0.2),
                            "yielding elements carry less")

    def test_refusals(self):
        for more, said in ((["-s_model", "modal", "-s_modal_vectors", 5, "-s_damping_uniform", .04], "-s_damping_uniform"),
                           (["-s_column_bending_skeleton_y", "1,5e6"], "not on the line of the stiffness"),
                           (["-export_matrices", "/tmp/nothing"], "elements that yield"),
                           (["-s_column_pinch", "0.2,0.5"], "goes with")):
            program.must_refuse(self, stick(*more), said, ranks=1)

    def test_doubts_of_shells_are_none_of_beams(self):
        self.assertNotIn("drilling", program.must_end(self, stick("-dry_run"), ranks=1).stdout)

    REDUCED = ["-s_model", "modal", "-time_step", repr(STICK_STEP / 2), "-s_gravity", "0,0,-9.81"]

    def reduced(self, vectors, *more):
        return [*stick(*self.motion), *self.REDUCED, "-s_modal_vectors", vectors, *more]

    def test_reduced_keeps_what_yields(self):
        """With all modes it is full order to round-off; with two, and vectors at what yields, near; without these far off."""
        full = Recorded(self, [*stick(*self.motion), *self.REDUCED[2:]], 1)
        largest = abs(full.displacement("roof.x")).max()
        error = {}
        for name, words in (("all", self.reduced(10000)), ("two", self.reduced(2)),
                            ("bare", self.reduced(2, "-s_modal_attachment", "false"))):
            run = Recorded(self, words)
            error[name] = max(abs(run.displacement(c) - full.displacement(c)).max() for c in ("roof.x", "roof.y")) / largest
            if name in ("all", "two"):
                for part, of in full.summary["yielding"].items():
                    found = run.summary["yielding"][part]
                    self.assertAlmostEqual(found["energy_lost"] / of["energy_lost"], 1, delta=1e-6, msg=part)
        self.assertLess(error["all"], 1e-9)
        self.assertLess(error["two"], 1e-6)
        self.assertGreater(error["bare"], 0.01)
        assert_continues(self, [*self.reduced(2), "-modes", 1, "-spectra_frequencies", 10, "-loops", "s:column"], 0.3, 4000)

    def test_reduced_at_rest(self):
        for more, said in (([], ""), (["-s_column_bending_skeleton_y", pairs(BENDS, 1e4)], "yielding elements carry less")):
            words = self.reduced(2, "-s_gravity", "0.4,0,-9.81", "-preload", "static", "-motion_x_record", "none",
                                 "-motion_y_record", "none", "-end_time", 0.05, *more)
            if said:
                program.must_refuse(self, words, said)
                continue
            x = Recorded(self, words).displacement("roof.x")
            self.assertGreater(abs(x[0]), 1e-4)
            self.assertLess(abs(x - x[0]).max(), 1e-10 * abs(x[0]))

    def test_members_are_single_runs(self):
        words = self.reduced(2, "-output_interval", repr(STICK_STEP / 2), "-spectra_frequencies", 10)
        values = ("0.3", "0.8", "1.2")
        peaks, residual = ensemble_of(self, [*words, "-modes", 1], "motion_x_scale", values)
        self.assertLess(residual.max(), 1e-11)
        for k, value in enumerate(values):
            run = Recorded(self, [*words, "-motion_x_scale", value])
            largest = abs(run.displacement("roof.x")).max()
            self.assertLess(abs(peaks[k].ravel() - largest).min(), 1e-9 * largest)
            self.assertGreater(run.summary["yielding"]["s:column:shear_y"]["ductility"], 1)

    def test_storeys_places_and_times(self):
        floors = [word for i in range(1, 5) for word in (
            f"-level{i}_structure", "s", f"-level{i}_at", f"0,0,{4 * i}", f"-level{i}_average", "true", f"-level{i}_floor", "true")]
        words = [*stick(*self.motion), *floors, "-probes", "roof,level1,level2,level3,level4"]
        runs = []
        for ranks in (1, 2):
            folder, summary = program.must_run(self, [*words, "-modes", 1, "-spectra_frequencies", 10], ranks)
            self.addCleanup(shutil.rmtree, folder)
            runs.append((summary["yielding"], program.read_csv(os.path.join(folder, "yielding.csv"))))
        for law, of in runs[0][0].items():
            storeys = of["storeys"]
            self.assertEqual(list(storeys), ["level1 over base", *(f"level{i + 1} over level{i}" for i in (1, 2, 3))])
            self.assertEqual(sum(storey["elements"] for storey in storeys.values()), of["elements"])
            self.assertEqual(sum(storey["yielded"] for storey in storeys.values()), of["yielded"])
            self.assertAlmostEqual(sum(storey["energy_lost"] for storey in storeys.values()), of["energy_lost"], delta=1e-6)
            self.assertEqual(max(storey["ductility"] for storey in storeys.values()), of["ductility"])
            first = [storey["first_time"] for storey in storeys.values() if storey["first_time"] is not None]
            self.assertEqual(min(first), of["first_time"])
            self.assertEqual(max(storeys.values(), key=lambda storey: storey["ductility"])["place"], of["place"])
            other = runs[1][0][law]
            self.assertAlmostEqual(other["ductility"], of["ductility"], delta=1e-8)
            self.assertEqual((other["first_time"], other["place"]), (of["first_time"], of["place"]))
        program.must_do(self, "plot", folder)
        with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
            page = re.sub(r"<[^>]*>", " ", file.read())
        laws = runs[1][0]
        farthest = max(laws, key=lambda law: laws[law]["ductility"])
        self.assertGreater(laws[farthest]["ductility"], 1)
        self.assertIn(f"Of {sum(law['elements'] for law in laws.values())} laws of elements "
                      f"{sum(law['yielded'] for law in laws.values())} yield, the first at "
                      f"{min(law['first_time'] for law in laws.values() if law['yielded']):.4g} s; {farthest} goes farthest, to "
                      f"{laws[farthest]['ductility']:.3g} times its first corner", page)
        rows = re.split(r"\n", page[page.index("\n", page.index("ductility")):])
        self.assertTrue(any(re.search(r"level2 over level1 +\d+ +2 ", row) for row in rows[:20]), rows[:20])
        table = runs[0][1]
        rows = [i for i, name in enumerate(table["law"]) if name == "s:column:shear_y"]
        self.assertEqual(sorted(float(table["z"][i]) for i in rows), [1, 3, 5, 7, 9, 11, 13, 15])
        for i in rows:
            self.assertEqual(math.isnan(float(table["first_time"][i])), float(table["ductility"][i]) <= 1)

    def test_two_sticks_that_pound(self):
        """The shipped scene: rest under gravity, walls that yield, strikes, in one ledger."""
        run = Recorded(self, ["-options_file", "petsc-options/plant/yielding_stick.yaml", "-end_time", 5.2], 1)
        self.assertGreater(run.summary["impacts"]["episodes"], 0)
        self.assertGreater(run.summary["yielding"]["annex:b7:bending_z"]["ductility"], 1)
        self.assertGreater(run.summary["yielding"]["annex:b7:bending_z"]["energy_lost"], 1e3)


def shaken(*more, reduced=False):
    """Words of the stick that yields as it is shaken, with two modes or all of its own."""
    Stick.setUpClass()
    problem = Stick()
    return [*(problem.reduced(2) if reduced else stick(*problem.motion)), "-end_time", 0.3, *more]


ON_RANKS = {"beams that yield": lambda: shaken("-s_damping_beta", 1e-4, "-s_gravity", "0,0,-9.81"),
            "beams that yield, in modes": lambda: shaken(reduced=True)}


if __name__ == "__main__":
    unittest.main()
