"""Weight on columns that lean: P-Delta of the preload against closed forms.

A mass on top of a cantilever has, with P = m g and kappa = sqrt(P / EI), the lateral stiffness
P kappa / (tan(kappa L) - kappa L), P kappa / (kappa L - tanh(kappa L)) where it hangs; it buckles at
pi^2 E I / (4 L^2), and under its own weight q L at q L^3 = 7.8373 E I. A mass on a rod beside a spring k
drifts by F / k / (1 - theta) under a force F, theta = P / (k L), and swings at sqrt((k - P / L) / m).
"""
import math
import os
import tempfile
import unittest

import numpy
import scipy.io

import program
from input.corpus.meshes import document
from recorded import Recorded, assert_continues

GRAVITY = 9.81
YOUNG, INERTIA, AREA, HEIGHT = 3e10, 1e-4, 0.09, 5.0
EULER = math.pi**2 * YOUNG * INERTIA / (4 * HEIGHT**2)


def column(cells, mass, *more, density=1e-1, gravity=-GRAVITY, height=HEIGHT):
    """A cantilever with a mass on top; its sections weigh next to nothing."""
    return ["-structures", "it", "-it_mesh", "tests/meshes/cantilever.geo", "-it_mesh_set",
            f"height={height!r},n={cells}", "-it_clamp", "base", "-it_stem_element", "euler_beam", "-it_stem_material",
            "stuff", "-it_stem_section", "pipe", "-material_stuff_young", YOUNG, "-material_stuff_poisson", 0.2,
            "-material_stuff_density", repr(density), "-section_pipe_area", AREA, "-section_pipe_inertia_y", INERTIA,
            "-section_pipe_inertia_z", INERTIA, "-section_pipe_torsion", INERTIA, "-section_pipe_z_axis", "1,0,0",
            "-it_top_element", "point_mass", "-it_top_mass", repr(mass), "-it_gravity", f"0,0,{gravity!r}",
            "-preload", "static", "-it_p_delta", "true", "-modes", 2, "-end_time", 1e-4, *more]


def frequency(test, words, ranks=program.RANKS):
    _, summary = program.must_run(test, words, ranks)
    return summary["structures"]["it"]["frequencies"][0]["frequency"]


class Yielded(unittest.TestCase):
    """A mass of 60 t on a column of 3 m whose foot yields on a flat skeleton: beneath it less stiffness than P / L is left."""

    def test_beta_beside_it_is_refused_by_its_cause(self):
        inertia, first = .002, 2e-3
        moment = YOUNG * inertia * first
        record = program.write_samples(2.2 * numpy.sin(3 * numpy.pi * numpy.arange(0, 1, 2e-3)), 2e-3)
        with tempfile.NamedTemporaryFile("w", suffix=".msh") as mesh:
            mesh.write(document({1: (0, 0, 0), 2: (0, 0, .5), 3: (0, 0, 3)},
                                [(1, 1, 1, (1, 2)), (2, 1, 2, (2, 3)), (3, 15, 3, (1,)), (4, 15, 4, (3,))],
                                {1: (1, "hinge"), 2: (1, "stem"), 3: (0, "base"), 4: (0, "top")}))
            mesh.flush()
            words = column(1, 6e4, "-it_top_rotary_inertia", "10,10,10", "-material_stuff_density", 2400, "-section_pipe_area",
                           .15, *(word for d in ("inertia_y", "inertia_z", "torsion") for word in (f"-section_pipe_{d}", inertia)),
                           "-section_pipe_z_axis", "0,1,0", "-it_hinge_element", "euler_beam", "-it_hinge_material", "stuff",
                           "-it_hinge_section", "pipe", "-it_hinge_bending_skeleton_z",
                           f"{first!r},{moment!r},{100 * first!r},{1.0001 * moment!r}", "-it_hinge_bending_rule", "kinematic",
                           "-motion_x_record", record, "-motion_x_unit", "m/s2", "-end_time", .5, "-time_step", 4e-5)
            at = words.index("-it_mesh")
            words[at + 1] = mesh.name
            del words[at + 2:at + 4]
            stopped = program.run([*words, "-it_damping_beta", 1e-3])
            self.assertEqual(stopped.returncode, 1)
            self.assertIn("damping gave", stopped.stderr)
            self.assertIn("try damping_alpha alone: beta damps with the stiffness that is left", stopped.stderr)
            program.must_run(self, [*words, "-it_damping_alpha", 1])


class Column(unittest.TestCase):
    def exact(self, mass, gravity=-GRAVITY):
        force = mass * GRAVITY
        kappa = math.sqrt(force / (YOUNG * INERTIA))
        angle = kappa * HEIGHT
        stiffness = force * kappa / (math.tan(angle) - angle if gravity < 0 else angle - math.tanh(angle))
        return math.sqrt(stiffness / mass) / (2 * math.pi)

    def test_falling_frequency(self):
        """Fourth order in the mesh; without the option that of the cantilever as it was."""
        for part in (0.2, 0.5, 0.9):
            mass = part * EULER / GRAVITY
            errors = [frequency(self, column(cells, mass), ranks) / self.exact(mass) - 1
                      for cells, ranks in ((1, 1), (2, 2), (4, 3))]
            self.assertLess(abs(errors[-1]), 4e-4, "frequency")
            self.assertGreater(errors[0] / errors[1], 10)
        plain = frequency(self, column(4, 1000.0, "-it_p_delta", "false"))
        self.assertAlmostEqual(plain * 2 * math.pi / math.sqrt(3 * YOUNG * INERTIA / HEIGHT**3 / 1000), 1, delta=1e-4)

    def test_nearly_straight_line(self):
        """f^2 falls by 1 - P / P_E within 2 %, as the rule has it."""
        plain = frequency(self, column(8, 1000.0, "-it_p_delta", "false")) * math.sqrt(1000.0)
        for part in (0.25, 0.5, 0.75):
            mass = part * EULER / GRAVITY
            square = (frequency(self, column(8, mass)) * math.sqrt(mass) / plain)**2
            self.assertLess(abs(square - (1 - part)), 0.02)

    def test_loads_without_weight(self):
        """A load on top is what the weight of a mass there would be; f^2 falls by 1 - P / P_E within 2 %."""
        mass = 1000.0
        plain = frequency(self, column(8, mass, "-it_p_delta", "false"))
        for part, table in ((0.25, False), (0.75, True), (-0.5, False)):
            force = part * EULER
            history = ["-push_values", f"0,1;1,1"] if table else []
            words = column(8, mass, "-loads", "push", "-push_on", "it:top", "-push_force", f"0,0,{-force!r}", *history, gravity=0.0)
            kappa = math.sqrt(abs(force) / (YOUNG * INERTIA))
            angle = kappa * HEIGHT
            stiffness = abs(force) * kappa / (math.tan(angle) - angle if force > 0 else angle - math.tanh(angle))
            for modal in ([], ["-it_model", "modal", "-it_modal_vectors", 2]):
                found = frequency(self, [*words, *modal])
                self.assertLess(abs(found / (math.sqrt(stiffness / mass) / (2 * math.pi)) - 1), 1e-4)
                self.assertLess(abs((found / plain)**2 - (1 - part)), 0.02)
        at_limit = column(16, mass, "-loads", "push", "-push_on", "it:top", "-push_force", f"0,0,{-1.001 * EULER!r}", gravity=0.0)
        program.must_refuse(self, at_limit, "buckles under its weight and loads")

    def test_a_hanging_mass_stiffens(self):
        mass = 2 * EULER / GRAVITY
        found = frequency(self, column(8, mass, gravity=GRAVITY))
        self.assertLess(abs(found / self.exact(mass, GRAVITY) - 1), 1e-4, "frequency")

    def test_in_modes(self):
        """All modes of the column, or one and its attachment vectors: the first frequency is the same."""
        mass = 0.6 * EULER / GRAVITY
        full = frequency(self, column(4, mass, density=100))
        for ranks, vectors in ((1, 24), (2, 2)):
            found = frequency(self, column(4, mass, "-it_model", "modal", "-it_modal_vectors", vectors, density=100), ranks)
            self.assertLess(abs(found / full - 1), 1e-7)


class Frame(unittest.TestCase):
    """Two columns along y, fixed below a stiff and heavy girder: in the plane of the frame each has the stiffness
    P / (2 tan(kappa L / 2) / kappa - L)."""

    def test_sway(self):
        height, mass = 3.0, 3e5
        words = ["-structures", "it", "-it_mesh", "tests/meshes/portal.geo", "-it_mesh_set", "n=2", "-it_clamp", "base",
                 "-section_pipe_area", AREA, "-section_pipe_inertia_y", 4 * INERTIA, "-section_pipe_inertia_z", INERTIA,
                 "-section_pipe_torsion", INERTIA, "-section_pipe_z_axis", "0,0,1", "-it_gravity", f"0,{-GRAVITY!r},0",
                 "-preload", "static", "-it_p_delta", "true", "-modes", 6, "-end_time", 1e-4]
        for group, material, young, density in (("columns", "stuff", YOUNG, 1e-2),
                                                ("girder", "heavy", 1e4 * YOUNG, mass / (4 * AREA))):
            words += [f"-it_{group}_element", "euler_beam", f"-it_{group}_material", material, f"-it_{group}_section", "pipe",
                      f"-material_{material}_young", young, f"-material_{material}_poisson", 0.2,
                      f"-material_{material}_density", repr(density)]
        kappa = math.sqrt(mass * GRAVITY / 2 / (YOUNG * INERTIA))
        stiffness = mass * GRAVITY / (2 / kappa * math.tan(kappa * height / 2) - height)
        self.assertLess(stiffness, 0.6 * 24 * YOUNG * INERTIA / height**3)
        for ranks in (1, 2):
            _, summary = program.must_run(self, words, ranks)
            found = [mode["frequency"] for mode in summary["structures"]["it"]["frequencies"]
                     if mode["direction"] == "x"]
            self.assertLess(abs(found[0] / (math.sqrt(stiffness / mass) / (2 * math.pi)) - 1), 5e-3, "frequency")


class Buckling(unittest.TestCase):
    def stands(self, words, ranks):
        result = program.run(words + ["-output", tempfile.mkdtemp()], ranks)
        lines = program.error_lines(result)
        self.assertEqual(result.returncode, 1 if lines else 0, result.stderr[-500:])
        for line in lines:
            self.assertIn("-it_p_delta: structure it buckles under its weight and loads, by the axial forces of group stem", line)
        self.assertLessEqual(len(lines), 1)
        return not lines

    def test_eulers_load(self):
        """Eight elements meet it within 2e-5."""
        for ranks, part, expected in ((1, 1 - 2e-5, True), (2, 1 - 2e-5, True), (1, 1 + 2e-5, False),
                                      (2, 1 + 2e-5, False), (3, 1.5, False), (2, 40, False)):
            words = column(8, part * EULER / GRAVITY, density=1e-3)
            self.assertEqual(self.stands(words, ranks), expected, part)

    def test_own_weight(self):
        """Greenhill: 20 elements, each with the weight above its middle."""
        for ranks, part, expected in ((1, 0.995, True), (2, 1.005, False)):
            density = part * 7.83735 * YOUNG * INERTIA / (GRAVITY * AREA * HEIGHT**3)
            words = column(20, 1e-6, density=density)
            self.assertEqual(self.stands(words, ranks), expected, part)

    def test_in_modes(self):
        words = column(4, 1.01 * EULER / GRAVITY, "-it_model", "modal", "-it_modal_vectors", 4)
        for ranks in (1, 2):
            self.assertFalse(self.stands(words, ranks))


class Rod(unittest.TestCase):
    """A mass on a rod without bending stiffness beside a spring: nothing but P-Delta and the spring."""
    MASS, SPRING, LENGTH, SIDE = 2000.0, 2e4, 4.0, 0.3
    THETA = MASS * GRAVITY / (SPRING * LENGTH)

    def words(self, *more, mass=MASS):
        return ["-structures", "it", "-it_mesh", "tests/meshes/pendulum.geo", "-it_mesh_set", f"height={self.LENGTH!r}",
                "-it_clamp", "foot", "-it_rod_element", "bar", "-it_rod_material", "stuff", "-it_rod_area", 1e-2,
                "-material_stuff_young", YOUNG, "-material_stuff_poisson", 0.2, "-material_stuff_density", 1e-6,
                "-it_load_element", "point_mass", "-it_load_mass", repr(mass), "-it_side_element", "grounded_spring",
                "-it_side_stiffness", f"{self.SPRING!r},{self.SPRING!r},0", "-it_gravity",
                f"{self.SIDE!r},0,{-GRAVITY!r}", "-preload", "static", "-it_p_delta", "true", "-time_step", 2e-4,
                "-output_interval", 2e-3, "-probes", "p", "-p_structure", "it", "-p_group", "load", "-end_time", 1.5,
                "-energy_interval", 50, *more]

    def test_drift(self):
        """F / k over 1 - theta = 0.755, and the rest lasts."""
        self.assertAlmostEqual(self.THETA, 0.245, delta=1e-3)
        for ranks in (1, 2):
            u = Recorded(self, self.words(), ranks).displacement("p.x")
            exact = self.MASS * self.SIDE / self.SPRING / (1 - self.THETA)
            self.assertAlmostEqual(u[0] / exact, 1, delta=1e-8)
            self.assertLess(abs(u - u[0]).max() / exact, 1e-9)
        plain = Recorded(self, self.words("-it_p_delta", "false"), 1).displacement("p.x")[0]
        self.assertAlmostEqual(plain / (self.MASS * self.SIDE / self.SPRING), 1, delta=1e-9)

    def test_swing(self):
        """Pushed at 0.1 m/s; damping of the rod's material, which stays straight, takes nothing of the swing."""
        omega = math.sqrt((self.SPRING - self.MASS * GRAVITY / self.LENGTH) / self.MASS)
        for ranks, more in ((1, ()), (2, ("-stiffness", "element")), (1, ("-it_rod_damping_beta", 1e-5))):
            run = Recorded(self, self.words("-it_initial_velocity", "0,0.1,0", *more), ranks)
            exact = 0.1 / omega * numpy.sin(omega * run.time)
            self.assertLess(abs(run.displacement("p.y") - exact).max() / (0.1 / omega), 2e-6, "swing")

    def test_falls(self):
        """An inverted pendulum that the spring cannot hold."""
        heavy = 1.01 * self.SPRING * self.LENGTH / GRAVITY
        for ranks in (1, 2):
            program.must_refuse(self, self.words(mass=heavy) + ["-dry_run"], "group rod", ranks=ranks)


class Step(unittest.TestCase):
    def test_limit_is_that_of_the_matrices(self):
        """The exported stiffness holds the axial forces; its largest frequency sets the step."""
        for gravity, ranks in ((-GRAVITY, 1), (50 * GRAVITY, 2)):
            with tempfile.TemporaryDirectory() as folder:
                words = column(3, 0.5 * EULER / GRAVITY, "-export_matrices", folder, gravity=gravity, density=2000)
                _, summary = program.must_run(self, words, ranks)
                where = os.path.join(folder, "it")
                stiffness = scipy.io.mmread(os.path.join(where, "stiffness.mtx")).toarray()
                mass = scipy.io.mmread(os.path.join(where, "mass.mtx")).toarray().ravel()
            root = 1 / numpy.sqrt(mass)
            squares = numpy.linalg.eigvalsh(stiffness * numpy.outer(root, root))
            limit = summary["structures"]["it"]["stable_time_step"]
            self.assertAlmostEqual(limit * math.sqrt(squares[-1]) / 2, 1, delta=1e-8)
            found = summary["structures"]["it"]["frequencies"][0]["frequency"]
            self.assertAlmostEqual(found * 2 * math.pi / math.sqrt(squares[0]), 1, delta=1e-7)

    def test_at_the_limit(self):
        """Near buckling, thrown sideways: energy stays, and the ledger closes."""
        words = column(3, 0.95 * EULER / GRAVITY, "-it_initial_velocity", "1,2,0.1", "-courant", 0.999, "-end_time",
                       0.5, "-energy_interval", 10, "-output_interval", 0.01, density=2000)
        for ranks in (1, 2):
            folder, summary = program.must_run(self, words, ranks)
            self.assertLess(summary["energy"]["relative_residual"], 1e-12)
            columns = program.read_csv(os.path.join(folder, "energy.csv"))
            total = [float(a) + float(b) - float(c) for a, b, c in
                     zip(columns["kinetic"], columns["strain"], columns["input_work"])]
            self.assertLess(max(abs(e - total[0]) for e in total), 1e-9 * max(abs(float(a)) for a in columns["kinetic"]))


class SameRun(unittest.TestCase):
    def words(self, *more):
        return column(6, 0.7 * EULER / GRAVITY, "-it_initial_velocity", "0.1,0.2,0", "-time_step", 2e-5,
                      "-output_interval", 1e-3, "-probes", "p", "-p_structure", "it", "-p_group", "top", *more,
                      density=2000)

    def test_on_any_ranks(self):
        runs = [Recorded(self, self.words("-end_time", 0.1, "-stiffness", method), ranks)
                for ranks, method in ((1, "assembled"), (1, "element"), (2, "element"), (3, "assembled"))]
        for run in runs[1:]:
            for axis in "xy":
                u = runs[0].displacement(f"p.{axis}")
                self.assertLess(abs(run.displacement(f"p.{axis}") - u).max(), 1e-9 * abs(u).max())

    def test_a_continued_run_is_the_uninterrupted_one(self):
        for ranks in (1, 2):
            assert_continues(self, self.words("-end_time", 0.1), 0.05, 2000, ranks)



class Refused(unittest.TestCase):
    def refused(self, words, *parts):
        for ranks in (1, 2):
            program.must_refuse(self, words + ["-dry_run"], *parts, ranks=ranks)

    def test_what_cannot_be_meant(self):
        words = column(2, 100.0)
        self.refused(words + ["-preload", "none"], "-it_p_delta true", "-preload static")
        self.refused(words + ["-it_gravity", "0,0,0"], "-it_p_delta true", "-gravity")
        late = ["-loads", "push", "-push_on", "it:top", "-push_force", "0,0,-1", "-push_function", "step", "-push_start", 1]
        self.refused(words + ["-it_gravity", "0,0,0", *late], "-it_p_delta true", "loads that act before the run")
        self.refused(words + ["-it_mass_scaling", 1e-3], "-it_p_delta true", "_mass_scaling")
        self.refused(words + ["-it_time_step_target", 1e-3], "-it_p_delta true", "_time_step_target")
        self.refused(words + ["-it_matrices", "there"], "-it_p_delta true", "_matrices")
        solid = ["-structures", "b", "-b_mesh", "tests/meshes/box.geo", "-b_body_element", "hex8", "-b_body_material",
                 "m", "-material_m_young", 1e9, "-material_m_poisson", 0.2, "-material_m_density", 2000, "-b_clamp",
                 "z_min", "-gravity", 9.81, "-preload", "static", "-b_p_delta", "true", "-end_time", 0.01]
        self.refused(solid, "-b_p_delta true", "no beams or bars")

    def test_forces_of_a_reduced_structure(self):
        """What the weight adds as the column leans is in no element, nor in sums over them."""
        modal = ["-it_model", "modal", "-it_modal_vectors", 3]
        for kind, more in (("reactions", []), ("storey", ["-f_level", 2]), ("members", ["-f_group", "stem"]),
                           ("cut", ["-f_group", "stem", "-f_normal", "0,0,1", "-f_level", 2])):
            words = column(2, 100.0, "-forces", "f", "-f_structure", "it", "-f_kind", kind, *more, "-dry_run")
            program.must_refuse(self, [*words, *modal], f"-f_kind {kind}", "structure it is reduced", "-it_p_delta",
                                "give -it_model full")
            if kind == "reactions":
                for taken in ([], [*modal, "-it_p_delta", "false"]):
                    self.assertEqual(program.run([*words, *taken], 1).returncode, 0)


if __name__ == "__main__":
    unittest.main()
