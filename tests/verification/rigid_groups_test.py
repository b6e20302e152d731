"""Rigid groups and diaphragms beside dense algebra on the matrices of the same model without them.

T has a column for every dof that follows nothing and for every motion of a group about its centre.
Frequencies are those of T^T K T and T^T M T; so are the largest one, the stable step, static
displacements, and the steps themselves: central differences of the projected model.
"""
import csv
import os
import tempfile
import unittest

import numpy
import scipy.io
import scipy.linalg

import program
from decks import box_of, clock, contacts, in_modes, material, probes, section
from recorded import Recorded, write_sine

GRAVITY = 9.81
MATERIALS = [*material("steel", 200e9, 0.3, 7800), *section("tube", 1e-2, 1e-5, 1e-5, 1e-5, "1,0,0")]
TABLE = ["-structures", "t", "-t_mesh", "tests/meshes/table.geo", "-t_column_element", "euler_beam", "-t_column_material",
         "steel", "-t_column_section", "tube", "-t_slab_element", "shell", "-t_slab_material", "steel",
         "-t_slab_thickness", 0.05, *MATERIALS]
SOLID = [{"shell": "hex8"}.get(word, word) for word in TABLE if word not in ("-t_slab_thickness", 0.05)]
HELD = ["-t_clamp", "base"]
# Four feet on springs each, as one rigid mat.
SPRUNG = ["-t_base_element", "grounded_spring", "-t_base_stiffness", "2e6,3e6,5e6,1e5,2e5,3e5"]


class Dense:
    """K and M of a scene without rigid groups, and T of those that it is to have."""

    def __init__(self, case, arguments, groups):
        folder = tempfile.mkdtemp()
        result = program.must_end(case, [*arguments, "-end_time", 1e-4, "-dry_run", "-export_matrices", folder], 1)
        place = os.path.join(folder, "t")
        self.stiffness = scipy.io.mmread(os.path.join(place, "stiffness.mtx")).toarray()
        self.mass = scipy.io.mmread(os.path.join(place, "mass.mtx")).toarray().ravel()
        with open(os.path.join(place, "dofs.csv")) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.place = numpy.array([[float(row[key]) for key in rows[0] if key in ("x", "y", "z")] for row in rows])
        self.component = [row["component"].removeprefix("u") for row in rows]
        self.admit(groups)

    def admit(self, groups):
        """`groups`: a predicate of places and the components that follow; where places differ, those of each as well."""
        columns = []
        follows = numpy.zeros(len(self.component), bool)
        for is_in, components, *own in groups:
            rows = own[0] if own else lambda x, all_of=components: all_of
            inside = numpy.array([is_in(x) and c in rows(x) for x, c in zip(self.place, self.component)])
            centre = self.place[inside].mean(axis=0)
            follows |= inside
            for motion in components:
                column = numpy.zeros(len(inside))
                for i in numpy.flatnonzero(inside):
                    column[i] = self.displacement(motion, self.component[i], self.place[i] - centre)
                columns.append(column)
        alone = numpy.eye(len(follows))[:, ~follows]
        self.motions = numpy.column_stack([alone, *columns]) if columns else alone
        self.reduced_stiffness = self.motions.T @ self.stiffness @ self.motions
        self.reduced_mass = self.motions.T @ (self.mass[:, None] * self.motions)

    @staticmethod
    def displacement(motion, component, x):
        if motion == component:
            return 1.0
        if not motion.startswith("r") or component.startswith("r"):
            return 0.0
        axis = numpy.zeros(3)
        axis["xyz".index(motion[1])] = 1
        return numpy.cross(axis, x)["xyz".index(component)]

    def squared_frequencies(self):
        return scipy.linalg.eigh(self.reduced_stiffness, self.reduced_mass, eigvals_only=True)

    def average(self, is_in, component):
        """Row of the mean displacement of some nodes."""
        row = numpy.array([float(is_in(x) and c == component) for x, c in zip(self.place, self.component)])
        return row / row.sum() @ self.motions


ALL = ("x", "y", "z", "rx", "ry", "rz")
PLANE = ("x", "y", "rz")
IN_SLAB = (lambda x: x[2] > 3 - 1e-6)
IN_BASE = (lambda x: x[2] < 1e-6)
IN_HUB = (lambda x: numpy.allclose(x, (1, 1, 3)))
HUB = ["-t_hub_points", "1,1,3"]
CASES = {
    "rigid slab": ([*TABLE, *HELD], [(IN_SLAB, ALL)], ["-t_rigid", "slab"]),
    "diaphragm": ([*TABLE, *HELD], [(IN_SLAB, PLANE)], ["-t_diaphragm", "slab"]),
    "rigid mat on springs below a diaphragm": ([*TABLE, *SPRUNG], [(IN_BASE, ALL), (IN_SLAB, PLANE)],
                                               ["-t_rigid", "base", "-t_diaphragm", "slab"]),
    "a hub and spokes that turn": ([*TABLE, *HELD], [(IN_SLAB, ALL, lambda x: ALL if IN_HUB(x) else ALL[:3])],
                                   [*HUB, "-t_rigid", "hub:slab:x+y+z"]),
    "a hub and single components": ([*TABLE, *HELD], [(lambda x: IN_HUB(x) or abs(x[2] - 2) < 1e-6, ALL,
                                                       lambda x: ALL if IN_HUB(x) else ("z", "rx"))],
                                    [*HUB, "-t_ring_points", "0,0,2; 2,0,2; 2,2,2; 0,2,2", "-t_rigid", "hub:ring:z+rx"]),
    "a floor in its plane without its turning": ([*TABLE, *HELD], [(IN_SLAB, PLANE, lambda x: PLANE[:2])],
                                                 ["-t_rigid", "slab:x+y"]),
    "rigid slab of solids": ([*SOLID, "-t_mesh_set", "slab=0", *HELD], [(IN_SLAB, ALL)], ["-t_rigid", "slab"]),
}


class RigidGroups(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = {}

    def dense(self, name):
        if name not in self.known:
            arguments, groups, _ = CASES[name]
            self.known[name] = Dense(self, arguments, groups)
        return self.known[name]

    def test_frequencies_and_the_stable_step(self):
        for name, (arguments, _, options) in CASES.items():
            squares = self.dense(name).squared_frequencies()
            for ranks in (1, 3) if name in ("diaphragm", "a hub and single components") else (1,):
                with self.subTest(case=name, ranks=ranks):
                    run = Recorded(self, [*arguments, *options, "-end_time", 1e-4, "-modes", 8], ranks)
                    structure = run.summary["structures"]["t"]
                    found = numpy.array([mode["frequency"] for mode in structure["frequencies"]])
                    self.assertLess(abs(found * 2 * numpy.pi / numpy.sqrt(squares[:8]) - 1).max(), 1e-7)
                    self.assertAlmostEqual(structure["omega_max"] / numpy.sqrt(squares[-1]), 1, delta=1e-7)
                    share = sum(mode["effective_modal_mass"][0] for mode in structure["frequencies"])
                    self.assertLessEqual(share, structure["mass"])
                    self.assertEqual([body["motions"] for body in structure["rigid_groups"]],
                                     [3 if body["kind"] == "diaphragm" or "plane" in name else 6
                                      for body in structure["rigid_groups"]])

    def test_what_cannot_follow_is_named(self):
        for rigid, *words in (("hub:slab:x+q", "'q' is no component"), ("hub:slab:slab:x", "group:group:x+y+z"),
                              ("hub:hub:x", "group:group:x+y+z"), ("hub:", "group:x+y+z"), ("hub:none:x", "'none'"),
                              ("hub:base:x", "at (0, 0, 0)", "is clamped"), ("hub:slab:x,slab", "as well")):
            program.must_refuse(self, [*TABLE, *HELD, *HUB, "-end_time", 1e-4, "-t_rigid", rigid], "-t_rigid", *words, ranks=1)

    def test_no_frequency_rises_and_the_step_grows(self):
        """What a body holds altogether limits nothing: 54 dofs of a stiff slab let the step grow 22 times."""
        arguments, _, options = CASES["rigid slab"]
        steps = []
        for more in ([], options):
            run = Recorded(self, [*arguments, *more, "-end_time", 1e-4])
            steps.append(run.summary["structures"]["t"]["stable_time_step"])
        self.assertGreater(steps[1], 20 * steps[0])

    def test_steps_are_those_of_the_projected_model(self):
        record = write_sine(3.0, 5.0, 0.2)
        for name, (arguments, _, options) in CASES.items():
            dense = self.dense(name)
            step = 0.9 * 2 / numpy.sqrt(dense.squared_frequencies()[-1])
            step = float(f"{min(step, 1e-3):.2g}")
            count = 200
            inverse = numpy.linalg.inv(dense.reduced_mass)
            iota = numpy.array([float(c == "x") for c in dense.component])
            load = dense.motions.T @ (dense.mass * iota)
            row = dense.average(IN_SLAB, "x")
            u = numpy.zeros(len(inverse))
            v = u.copy()
            expected = []
            for n in range(count):
                expected.append(row @ u)
                ground = 3.0 * numpy.sin(2 * numpy.pi * 5.0 * n * step)
                v = v + (step if n else step / 2) * inverse @ (-dense.reduced_stiffness @ u - load * ground)
                u = u + step * v
            with self.subTest(case=name):
                run = Recorded(self, [*arguments, *options, *clock(step, count * step), *probes(p="t:slab"),
                                      "-motion_x_record", record, "-motion_x_unit", "m/s2"])
                found = run.displacement("p.x")[:count]
                size = abs(numpy.array(expected)).max()
                self.assertGreater(size, 0)
                # The record is linear between its samples, 1e-4 s apart.
                self.assertLess(abs(found - expected).max() / size, 2e-6)

    def test_rest_under_gravity(self):
        for name, (arguments, _, options) in CASES.items():
            dense = self.dense(name)
            down = numpy.array([-GRAVITY * float(c == "z") for c in dense.component])
            u = numpy.linalg.solve(dense.reduced_stiffness, dense.motions.T @ (dense.mass * down))
            expected = dense.average(IN_SLAB, "z") @ u
            for more in ([], ["-preload_solver", "iterative"]) if "mat" in name else ([],):
                with self.subTest(case=name, more=more):
                    run = Recorded(self, [*arguments, *options, "-gravity", GRAVITY, "-preload", "static", "-end_time",
                                          0.02, "-output_interval", 1e-3, *probes(p="t:slab"), *more])
                    found = run.displacement("p.z")
                    self.assertLess(abs(found / expected - 1).max(), 1e-7)
                    rest = run.summary["equilibrium"]["structures"]["t"]
                    self.assertLess(rest["imbalance"], 1e-9)

    def test_reduced_structures(self):
        """As many coordinates as there are independent dofs are the whole model."""
        for name, (arguments, _, options) in CASES.items():
            squares = self.dense(name).squared_frequencies()
            for count in (5, len(squares)) if "mat" in name else (5,):
                with self.subTest(case=name, count=count):
                    run = Recorded(self, [*arguments, *options, *in_modes("t", count), "-end_time", 1e-4, "-modes",
                                          count])
                    found = [mode["frequency"] for mode in run.summary["structures"]["t"]["frequencies"]]
                    wanted = numpy.sqrt(squares[:len(found)]) / (2 * numpy.pi)
                    self.assertGreaterEqual(len(found), min(count, 5))
                    self.assertLess(abs(found[:count] / wanted[:count] - 1).max(), 1e-6)


class StruckPlate(unittest.TestCase):
    """A plate of one rigid group hits a wall with one edge, then with its face: J = m v / (1 + m e^2 / I)."""
    SPEED, LENGTH, WIDTH, CELLS = 0.5, 1.0, 2.0, (2, 4)
    MASS = 2400.0 * 1.0 * 2.0 * 0.5
    # Of the lumped masses.
    INERTIA = MASS * (LENGTH**2 * (1 + 2 / CELLS[0]**2) + WIDTH**2 * (1 + 2 / CELLS[1]**2)) / 12

    def scene(self, gap, *more):
        return ["-structures", "b", *box_of("b", "lx=1,ly=2,lz=0.5,nx=2,ny=4", "c"), *material("c", 30e9, 0.2, 2400),
                "-b_rigid", "body", "-b_initial_velocity", f"{self.SPEED},0,0", *contacts(w=("b:x_max", "wall", gap)),
                "-end_time", 0.02, "-time_step", 1e-5, *more]

    def test_impulses(self):
        first = self.MASS * self.SPEED / (1 + self.MASS / self.INERTIA)
        run = Recorded(self, self.scene("0.001,0.002"))
        impulses = run.column("impulse")
        self.assertAlmostEqual(impulses[0] / first, 1, delta=1e-9)
        # Plastic impacts without friction stop it in the end.
        self.assertAlmostEqual(sum(impulses) / (self.MASS * self.SPEED), 1, delta=1e-9)
        self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-9)
        self.assertLess(run.energy["kinetic"], 1e-20)
        # It never deforms: 30 GPa times round-off.
        self.assertLess(abs(run.energy["strain"]), 1e-9)

    def test_a_whole_face_at_once(self):
        """Ten rows close on six motions: their impulses are not unique, their sum is."""
        run = Recorded(self, self.scene("0.001"))
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / (self.MASS * self.SPEED), 1, delta=1e-12)
        self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-9)


class PlantedBeam(unittest.TestCase):
    """A steel beam whose foot and the face of a concrete cube are one rigid group: a clamped cantilever."""
    LENGTH, INERTIA, AREA = 2.0, 1e-5, 1e-2

    def test_frequency_of_a_cantilever(self):
        clamped = 1.8751040687**2 / (2 * numpy.pi * self.LENGTH**2) * numpy.sqrt(
            200e9 * self.INERTIA / (7800 * self.AREA))
        run = Recorded(self, ["-structures", "b", "-b_mesh", "tests/meshes/planted_beam.geo", "-b_clamp", "back",
                              "-b_body_element", "hex8", "-b_body_material", "c", *material("c", 30e9, 0.2, 2400),
                              "-b_beam_element", "beam", "-b_beam_material", "steel", "-b_beam_section", "tube",
                              "-b_rigid", "joint", *MATERIALS[:-2], "-section_tube_z_axis", "0,0,1", "-end_time",
                              1e-4, "-modes", 2])
        structure = run.summary["structures"]["b"]
        for mode in structure["frequencies"]:  # it bends in two planes
            self.assertLess(abs(mode["frequency"] / clamped - 1), 0.01)
        self.assertEqual(structure["connectivity"]["pieces"], 1)


class JoinedAndPinned(unittest.TestCase):
    """A strip of slab on a beam below it bends as one section; a beam with a hinge as two cantilevers."""
    LENGTH, WIDTH, THICKNESS, OFFSET, YOUNG, DENSITY = 4.0, 0.4, 0.1, 0.3, 30e9, 2400.0
    BEAM = ["-c_beam_element", "beam", "-c_beam_material", "c", "-c_beam_section", "rib",
            *material("c", YOUNG, 0, DENSITY), *section("rib", 0.04, 1.2e-4, 1.5e-4, 1e-4, "0,0,1"), "-c_clamp", "end"]
    SCENE = ["-structures", "c", "-c_mesh", "tests/meshes/composite.geo", *BEAM]
    REST = ["-gravity", GRAVITY, "-preload", "static", "-end_time", 1e-3, "-probes", "p", "-p_structure", "c"]

    def sag(self, inertia, weight, length):
        return weight * length**4 / (8 * self.YOUNG * inertia)

    def test_composite_section(self):
        slab = self.WIDTH * self.THICKNESS
        together = (self.WIDTH * self.THICKNESS**3 / 12 + 1.2e-4 +
                    self.OFFSET**2 * slab * 0.04 / (slab + 0.04))
        expected = self.sag(together, self.DENSITY * GRAVITY * (slab + 0.04), self.LENGTH)
        scene = [*self.SCENE, "-c_slab_element", "shell", "-c_slab_material", "c", "-c_slab_thickness", self.THICKNESS,
                 "-c_join", "beam:spine", *self.REST, "-p_group", "tip"]
        errors = []
        for cells in (40, 80):
            run = Recorded(self, [*scene, "-c_mesh_set", f"n={cells}"], identity=1e-11)
            errors.append(abs(-run.displacement("p.z")[0] / expected - 1))
            group = run.summary["structures"]["c"]["rigid_groups"][0]
            # One pair of each cross-section; the clamped one needs none.
            self.assertEqual((group["kind"], group["bodies"], group["nodes"], group["motions"]),
                             ("join", cells, 2 * cells, 6 * cells))
        # Beams stretch in straight lines where they bend in cubic ones, and the slab lags at its edges.
        self.assertLess(errors[1], 4e-3)
        self.assertLess(errors[1], errors[0])
        self.assertEqual([line for line in run.summary["warnings"] if "join" in line], [])

    def test_a_join_over_a_distance_is_doubted(self):
        run = Recorded(self, [*self.SCENE, "-c_slab_element", "shell", "-c_slab_material", "c", "-c_slab_thickness",
                              self.THICKNESS, "-c_join", "beam:spine", "-c_mesh_set", "offset=1.25,n=4", *self.REST,
                              "-p_group", "tip"], identity=1e-11)
        self.assertTrue(any("join beam:spine holds nodes 1.25 m apart" in line for line in run.summary["warnings"]))

    def test_hinge(self):
        expected = self.sag(1.2e-4, self.DENSITY * GRAVITY * 0.04, self.LENGTH / 2)
        scene = [*self.SCENE, "-c_mesh_set", "hinge=1", *self.REST, "-p_group", "middle"]
        run = Recorded(self, [*scene, "-c_pin", "middle"], identity=1e-11)
        self.assertLess(abs(-run.displacement("p.z")[0] / expected - 1), 3e-3)
        group = run.summary["structures"]["c"]["rigid_groups"][0]
        self.assertEqual((group["bodies"], group["dofs"], group["motions"]), (1, 6, 3))
        # Without the hinge, a beam clamped at both ends: w l^4 / (24 E I) of its half.
        run = Recorded(self, [*scene, "-c_rigid", "middle"], identity=1e-11)
        self.assertLess(abs(-run.displacement("p.z")[0] / (expected / 3) - 1), 1e-2)


class Diaphragm(unittest.TestCase):
    def test_is_what_a_stiff_floor_tends_to(self):
        """Shells stiffened a thousand times in their plane, by their modulus, and thinned so that they bend alike."""
        arguments, _, options = CASES["diaphragm"]
        found = []
        for more in (options, []):
            scene = list(arguments) + ["-modes", 3, "-end_time", 1e-4, *more]
            if not more:
                # E t^3 as before, E t a hundred times; the mass stays by the density.
                for name, value in (("-t_slab_material", "stiff"), ("-t_slab_thickness", 0.005)):
                    scene[scene.index(name) + 1] = value
                scene += [*material("stiff", 200e12, 0.3, 78000)]
            run = Recorded(self, scene)
            structure = run.summary["structures"]["t"]
            found.append(numpy.array([mode["frequency"] for mode in structure["frequencies"]] +
                                     [structure["stable_time_step"]]))
        self.assertLess(abs(found[0][:3] / found[1][:3] - 1).max(), 1e-3)
        self.assertGreater(found[0][3], 5 * found[1][3])

    def test_floors_of_a_plane_frame(self):
        """Clamped across its plane in all nodes: a floor has one motion there, along x."""
        handle, path = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write("Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {0, 0, 3}; Point(4) = {4, 0, 3};\n"
                       "Line(1) = {1, 3}; Line(2) = {2, 4}; Line(3) = {3, 4}; Transfinite Curve {1, 2, 3} = 4;\n"
                       'Physical Curve("column") = {1, 2}; Physical Curve("slab") = {3};\n'
                       'Physical Curve("flat") = {1, 2, 3}; Physical Point("base") = {1, 2};\n')
        frame = ["-structures", "t", "-t_mesh", path, "-t_clamp", "base,flat:y+rx+rz", *MATERIALS, "-section_tube_z_axis", "0,1,0"]
        for group in ("column", "slab"):
            frame += [f"-t_{group}_element", "euler_beam", f"-t_{group}_material", "steel", f"-t_{group}_section", "tube"]
        squares = Dense(self, frame, [(IN_SLAB, ("x",))]).squared_frequencies()
        run = Recorded(self, [*frame, "-t_diaphragm", "slab", "-end_time", 1e-4, "-modes", 6])
        structure = run.summary["structures"]["t"]
        found = numpy.array([mode["frequency"] for mode in structure["frequencies"]])
        self.assertLess(abs(found * 2 * numpy.pi / numpy.sqrt(squares[:6]) - 1).max(), 1e-7)
        self.assertEqual([body["motions"] for body in structure["rigid_groups"]], [1])
        program.must_refuse(self, [*frame, "-t_clamp", "base,flat:y", "-t_diaphragm", "slab", "-end_time", 1e-4],
                            "-t_diaphragm slab", "is clamped")

    def test_every_floor_is_one_of_its_own(self):
        """Feet and slab in one group: two levels 3 m apart, of four and of nine nodes."""
        scene = [*TABLE, *SPRUNG, "-end_time", 1e-4, "-modes", 6]
        found = []
        for options in (["-t_diaphragm", "base,slab"], ["-t_mesh_set", "both=1", "-t_diaphragm", "floors"]):
            run = Recorded(self, scene + options)
            structure = run.summary["structures"]["t"]
            found.append([mode["frequency"] for mode in structure["frequencies"]])
        body = structure["rigid_groups"][0]
        self.assertEqual((body["bodies"], body["nodes"], body["motions"]), (2, 13, 6))
        self.assertLess(abs(numpy.array(found[0]) / found[1] - 1).max(), 1e-9)


class MasslessEnd(unittest.TestCase):
    """A mass on a rigid arm whose other end, on a spring, has none: six motions of one body, by hand."""
    MASS, ROTARY, STIFFNESS, ARM = 100.0, 10.0, 1e6, numpy.array([1.0, 0.2, -0.3])

    def scene(self, *more, rotary="10,10,10"):
        x, y, z = self.ARM
        handle, path = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write(f"Point(1) = {{0, 0, 0}};\nPoint(2) = {{{x}, {y}, {z}}};\nPhysical Point(\"mass\") = {{1}};\n"
                       'Physical Point("spring") = {2};\nPhysical Point("arm") = {1, 2};\n')
        return ["-structures", "t", "-t_mesh", path, "-t_mass_element", "point_mass", "-t_mass_mass", self.MASS,
                *(["-t_mass_rotary_inertia", rotary] if rotary else []), "-t_spring_element", "grounded_spring",
                "-t_spring_stiffness", ",".join(["1e6"] * 6), "-modes", 6, *more]

    def matrices(self):
        """M and K in the six motions of the mass."""
        mass = numpy.diag([self.MASS] * 3 + [self.ROTARY] * 3)
        x, y, z = self.ARM
        motion = numpy.eye(6)
        motion[:3, 3:] = numpy.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
        return mass, self.STIFFNESS * motion.T @ motion

    def test_frequencies(self):
        mass, stiffness = self.matrices()
        expected = numpy.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)) / (2 * numpy.pi)
        _, summary = program.must_run(self, self.scene("-t_rigid", "arm", "-end_time", 1e-3))
        structure = summary["structures"]["t"]
        found = [mode["frequency"] for mode in structure["frequencies"]]
        self.assertLess(numpy.abs(numpy.array(found) / expected - 1).max(), 1e-6)
        self.assertEqual(structure["mass"], self.MASS)
        self.assertFalse([line for line in summary["warnings"] if "no stiffness" in line])
        self.assertLess(abs(structure["omega_max"] / (2 * numpy.pi * expected[-1]) - 1), 1e-3)

    def test_history_of_the_end_without_mass(self):
        """It is thrown, at full order and in modes: u = sum of phi_i (phi_i . M v) sin(omega_i t) / omega_i."""
        mass, stiffness = self.matrices()
        square, modes = scipy.linalg.eigh(stiffness, mass)
        omega = numpy.sqrt(square)
        thrown = modes.T @ mass @ numpy.array([0.3, 1, -0.2, 0, 0, 0])
        for more in ([], [*in_modes("t", 6)]):
            run = Recorded(self, self.scene("-t_rigid", "arm", *clock(2e-5, 0.1, 1e-3), "-t_initial_velocity",
                                            "0.3,1,-0.2", *probes(p="t:spring"), *more))
            times = run.time
            motions = modes @ (thrown[:, None] * numpy.sin(numpy.outer(omega, times)) / omega[:, None])
            x, y, z = self.ARM
            expected = {"x": motions[0] + z * motions[4] - y * motions[5], "y": motions[1] - z * motions[3] + x * motions[5],
                        "z": motions[2] + y * motions[3] - x * motions[4]}
            for axis, values in expected.items():
                self.assertLess(numpy.abs(run.displacement(f"p.{axis}") - values).max(), 1e-4 * numpy.abs(values).max())

    def test_a_body_without_inertia_is_refused(self):
        """Nothing resists that the arm turns about its mass."""
        program.must_refuse(self, self.scene("-t_rigid", "arm", "-end_time", 1e-3, rotary=""), "(1, 0.2, -0.3)",
                            "nothing in arm", "rotary_inertia")
        program.must_refuse(self, self.scene("-end_time", 1e-3, "-t_allow_loose"), "(1, 0.2, -0.3)", "no mass along x",
                            "only spring holds it", "point_mass")

    def test_a_tied_end(self):
        """A spring on a node that a tie carries acts as one on the corner of the face where that node lies."""
        handle, path = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write('SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\nPoint(100) = {1, 1, 1};\n'
                       "Transfinite Curve {1:12} = 2; Transfinite Surface {1:6}; Recombine Surface {1:6}; Transfinite Volume {1};\n"
                       'Physical Volume("body") = {1}; Physical Surface("bottom") = {5}; Physical Surface("top") = {6};\n'
                       'Physical Point("corner") = {7}; Physical Point("end") = {100};\n')
        scene = ["-structures", "t", "-t_mesh", path, "-t_clamp", "bottom", "-t_body_element", "hex8", "-t_body_material",
                 "C30", "-modes", 4, "-end_time", 1e-5, "-t_ignore", "ungrouped"]
        found = []
        for group, more in (("corner", []), ("end", ["-t_tie", "end:top"])):
            _, summary = program.must_run(self, [*scene, f"-t_{group}_element", "grounded_spring", f"-t_{group}_stiffness",
                                                 "1e9,2e9,3e9", *more])
            found.append([mode["frequency"] for mode in summary["structures"]["t"]["frequencies"]])
        self.assertLess(numpy.abs(numpy.array(found[1]) / found[0] - 1).max(), 1e-6)


class LinksOnABody(unittest.TestCase):
    """A rigid mat that rocks on springs which push only, each with dashpots: its links move each other, all of them.
    They are solved for by the motions of the body; in a structure reduced to all of its modes pair by pair.
    """
    SCENE = ["-structures", "m", "-m_mesh", "tests/meshes/mast.geo", "-m_beams_element", "beam", "-m_beams_material",
             "stiff", "-m_beams_section", "s", *material("stiff", 1e10, 0.3, 1000),
             *section("s", 1e-2, 1e-3, 1e-3, 1e-3, "0,1,0"), "-m_load_element", "point_mass", "-m_load_mass", 2000,
             "-m_load_rotary_inertia", "1e3,1e3,1e3", "-m_bed_element", "grounded_spring", "-m_bed_stiffness",
             "1e6,1e6,1e6,1e5,0,1e5", "-m_bed_compression_only", "true", "-m_rigid", "bed", "-gravity", GRAVITY,
             "-preload", "static", "-m_initial_velocity", "1.5,0.2,0", *clock(2e-5, 0.8, 1e-3), *probes(top="m:load")]

    def test_same_pair_by_pair(self):
        for dashpot in ("2e4,1e4,3e3,1e2,0,1e2", "1e9,1e9,3e3,0,0,0"):
            scene = [*self.SCENE, "-m_bed_dashpot", dashpot]
            pairs = Recorded(self, [*scene, *in_modes("m", 12)], 1, identity=1e-9)
            run = Recorded(self, scene, identity=1e-11)
            self.assertLess(run.summary["contact_ratio"]["m"]["smallest"], 0.5)
            for axis in "xyz":
                u, v = run.displacement(f"top.{axis}"), pairs.displacement(f"top.{axis}")
                self.assertLess(abs(u - v).max(), 1e-7 * abs(v).max())


class AllTermsTogether(unittest.TestCase):
    """A rigid mat on springs with dashpots below a diaphragm, under gravity and in motion: the ledger closes."""
    SCENE = [*TABLE, *SPRUNG, "-t_base_dashpot", "2e4,2e4,5e4,1e3,1e3,1e3", "-t_rigid", "base", "-t_diaphragm", "slab",
             "-gravity", GRAVITY, "-preload", "static", "-t_initial_velocity", "0.3,0.1,0", "-end_time", 0.1,
             *probes(p="t:slab")]

    def test_ledger_with_rayleigh_and_uniform_damping(self):
        for more in (["-t_damping_alpha", 0.3, "-t_damping_beta", 1e-5], ["-t_damping_uniform", 0.04],
                     ["-t_column_damping_beta", 2e-5]):
            with self.subTest(more=more):
                run = Recorded(self, [*self.SCENE, *more], identity=1e-11)
                self.assertGreater(abs(run.displacement("p.x")).max(), 1e-3)
                self.assertGreater(run.energy["devices"], 1)


# The light ends of the mat leave round-off in accelerations, which are differences of velocities over 5e-6 s.
ON_RANKS = {"a rigid plate that strikes a wall": StruckPlate().scene("0.001,0.002"),
            "a rigid slab that is shaken": [*TABLE, *HELD, "-t_rigid", "slab", "-t_initial_velocity", "0.3,0.1,0", "-end_time", 0.05,
                                            *probes(p="t:slab")],
            "a rigid mat below a diaphragm, with Rayleigh damping": (
                [*AllTermsTogether.SCENE, "-t_damping_alpha", 0.3, "-t_damping_beta", 1e-5, "-end_time", 0.03],
                {"tolerance": 1e-10}),
            "a rigid mat below a diaphragm, with uniform damping": (
                [*AllTermsTogether.SCENE, "-t_damping_uniform", 0.04, "-end_time", 0.03], {"tolerance": 1e-10}),
            "springs that a rigid mat lifts off from": (
                [*LinksOnABody.SCENE, "-m_bed_dashpot", "2e4,1e4,3e3,1e2,0,1e2", "-end_time", 0.15])}


if __name__ == "__main__":
    unittest.main()
