"""Runs that start from the static equilibrium under gravity, contacts and tension-only bars included.

Closed forms: the sag rho g L^2 / (2 E) of a hung bar, and the force (sag - gap) E A / L of a wall
that it would reach; weights above the joints of a stack; m g / k on springs and on a pair of taut
bars. What starts at rest stays there, and small motions about it are those without gravity.
"""
import math
import os
import tempfile
import unittest

import numpy
import scipy.io

import program
from decks import box_of, clock, contacts, in_modes, material, probes, section
from recorded import Recorded, write_sine

GRAVITY, YOUNG, DENSITY = 9.81, 30e9, 2400.0
REST = ["-gravity", GRAVITY, "-preload", "static"]


def box(name, sizes, *more, poisson=0.0):
    return [*box_of(name, sizes, "concrete"), *material("concrete", YOUNG, poisson, DENSITY), *more]


def largest_speed(run, mass):
    """Bound of the speed of any dof of at least this mass, from the kinetic energy at the end."""
    return math.sqrt(2 * abs(run.energy["kinetic"]) / mass)


class HungBar(unittest.TestCase):
    """Clamped at the top, of 10 bricks."""
    LENGTH, AREA = 5.0, 0.25
    SAG = DENSITY * GRAVITY * LENGTH**2 / (2 * YOUNG)
    WEIGHT = DENSITY * GRAVITY * LENGTH * AREA
    SIZES = "lx=0.5,ly=0.5,lz=5,nz=10"

    def hang(self, *more, ranks=program.RANKS, steps=50):
        step = 5e-5
        return Recorded(self, ["-structures", "bar", *box("bar", self.SIZES, "-bar_clamp", "z_max"),
                               *clock(step, steps * step), *probes(foot="bar:z_min"), *REST, *more], ranks)

    def assert_hangs(self, run, tolerance=1e-12):
        foot = run.displacement("foot.z")
        self.assertLess(abs(foot / -self.SAG - 1).max(), tolerance)
        rest = run.summary["equilibrium"]["structures"]["bar"]
        self.assertAlmostEqual(rest["weight"][2] / -self.WEIGHT, 1, delta=1e-12)
        self.assertAlmostEqual(rest["support"][2] / self.WEIGHT, 1, delta=1e-10)
        self.assertLess(rest["imbalance"], 1e-10)

    def test_sags_as_it_must_and_stays(self):
        for ranks in (1, 2, 3):
            run = self.hang(ranks=ranks)
            self.assert_hangs(run)
            rest = run.summary["equilibrium"]
            self.assertAlmostEqual(rest["structures"]["bar"]["largest_displacement"] / self.SAG, 1, delta=1e-12)
            self.assertIn("(0", rest["structures"]["bar"]["place"])
            self.assertEqual([line for line in run.summary["warnings"] if "gravity" in line], [])

    def test_nothing_without_weight_is_doubted(self):
        run = self.hang("-gravity", 0)
        self.assertEqual(abs(run.displacement("foot.z")).max(), 0)
        self.assertEqual(len([line for line in run.summary["warnings"] if "no structure has a weight" in line]), 1)

    def test_iteration_finds_the_same(self):
        run = self.hang("-preload_solver", "iterative")
        self.assert_hangs(run, 1e-9)
        self.assertIn("conjugate gradients", run.summary["equilibrium"]["structures"]["bar"]["method"])

    def test_few_modes_find_the_same(self):
        run = self.hang(*in_modes("bar", 2))
        self.assertLess(abs(run.displacement("foot.z") / -self.SAG - 1).max(), 1e-6)

    def test_matrices_find_the_same(self):
        folder = tempfile.mkdtemp()
        self.hang("-export_matrices", folder)
        read = self.hang("-bar_matrices", os.path.join(folder, "bar"))
        self.assertLess(abs(read.displacement("foot.z") / -self.SAG - 1).max(), 1e-12)
        # The files know nothing of the mass of clamped nodes.
        rest = read.summary["equilibrium"]["structures"]["bar"]
        self.assertAlmostEqual(rest["support"][2] / (self.WEIGHT * 0.95), 1, delta=1e-10)

    def test_uniform_damping_leaves_the_rest_alone(self):
        uniform = ["-bar_damping_uniform", 0.05, "-bar_damping_reference", 100]
        for ranks, filters, more in ((1, 3, []), (2, 8, []), (3, 1, []), (2, 3, ["-bar_mass_scaling", 1e-4])):
            run = self.hang(*uniform, "-bar_damping_filters", filters, *more, ranks=ranks, steps=500)
            self.assertLess(run.summary["structures"]["bar"]["damping"]["stiffness_at_rest"], 0.98)
            self.assert_hangs(run)
        reduced = self.hang(*uniform, *in_modes("bar", 2), steps=500)
        self.assertLess(abs(reduced.displacement("foot.z") / -self.SAG - 1).max(), 1e-6)
        self.assertLess(numpy.ptp(reduced.displacement("foot.z")), 1e-12 * self.SAG)

    def test_forces_of_a_rest_are_its_weight_under_uniform_damping(self):
        items = ["-forces", "top,middle", "-top_structure", "bar", "-top_kind", "reactions", "-middle_structure", "bar",
                 "-middle_kind", "cut", "-middle_group", "body", "-middle_level", 2.25]
        for more in ([], ["-bar_damping_uniform", 0.05, "-bar_damping_reference", 100]):
            run = self.hang(*items, *more)
            # nodes on the clamp carry their own mass
            self.assertLess(abs(run.members("top")[1:, 2] / (0.95 * self.WEIGHT) - 1).max(), 1e-10)
            self.assertLess(abs(abs(run.members("middle")[1:, 2]) / (0.45 * self.WEIGHT) - 1).max(), 1e-10)

    def test_reaches_the_wall_below(self):
        gap = 0.4 * self.SAG
        force = (self.SAG - gap) * YOUNG * self.AREA / self.LENGTH
        wall = [*contacts(stop=("bar:z_min", "wall", repr(gap)))]
        for more in ([], [*in_modes("bar", 2)]):
            run = self.hang(*wall, *more)
            self.assertLess(abs(run.displacement("foot.z") / -gap - 1).max(), 1e-9)
            self.assertLess(abs(run.force("stop")[1:] / force - 1).max(), 1e-5 if more else 1e-10)
            contact = run.summary["equilibrium"]["contacts"]["stop"]
            self.assertEqual(contact["points"], 4)
            self.assertAlmostEqual(contact["force"] / force, 1, delta=1e-5 if more else 1e-12)

    def test_a_wall_out_of_reach_carries_nothing(self):
        run = self.hang(*contacts(stop=("bar:z_min", "wall", repr(1.001 * self.SAG))))
        self.assert_hangs(run)
        self.assertEqual(run.summary["equilibrium"]["contacts"]["stop"], {"points": 0, "force": 0})
        self.assertEqual(run.summary["impacts"]["episodes"], 0)

    def test_dropped_it_swings_to_twice_the_sag(self):
        run = self.hang("-preload", "none", steps=150)
        self.assertNotIn("equilibrium", run.summary)
        self.assertAlmostEqual(run.displacement("foot.z").min() / -self.SAG, 2, delta=0.05)
        self.assertEqual(run.energy["gravity"], run.energy["input"])
        self.assertGreater(run.energy["gravity"], 0)


class RestingColumn(unittest.TestCase):
    """2 x 2 x 6 bricks with Poisson's ratio 0.2 on a wall, free otherwise."""
    WEIGHT = DENSITY * GRAVITY * 0.4 * 0.4 * 1.2
    CORNER = DENSITY * 0.4 * 0.4 * 1.2 / 24 / 8  # kg: the smallest mass of a node

    def stand(self, steps, ranks, *more):
        step = 4.5e-5
        return Recorded(self, ["-structures", "body", *box("body", "lx=0.4,ly=0.4,lz=1.2,nx=2,ny=2,nz=6", poisson=0.2),
                               *contacts(stop=("body:z_min", "wall", 0)), *clock(step, steps * step, 10 * step),
                               "-energy_interval", 1000, *probes(top="body:z_max"), *REST, *more], ranks)

    def assert_stands(self, run):
        self.assertLess(abs(run.force("stop")[1:] / self.WEIGHT - 1).max(), 1e-10)
        top = run.displacement("top.z")
        self.assertLess(abs(top - top[0]).max(), 1e-15)
        self.assertLess(largest_speed(run, self.CORNER), 1e-9)
        self.assertEqual(len(run.column("start")), 1)
        self.assertEqual(run.summary["equilibrium"]["contacts"]["stop"]["points"], 9)

    def test_stands_for_a_hundred_thousand_steps(self):
        self.assert_stands(self.stand(100000, 1))

    def test_stands_on_more_ranks_and_in_modes(self):
        self.assert_stands(self.stand(2000, 2))
        self.assert_stands(self.stand(2000, 3))
        self.assert_stands(self.stand(2000, 2, *in_modes("body", 12)))

    def test_options_reach_its_solvers(self):
        words = ["-structures", "body", *box("body", "nz=2", "-body_clamp", "z_min"), "-end_time", 1e-4, *REST]
        for more, said in ((["-rest_mat_mumps_icntl_4", 2], "MUMPS"),
                           (["-preload_solver", "iterative", "-rest_ksp_converged_reason"], "solve converged"),
                           (["-preload_solver", "iterative", "-rest_ksp_max_it", 1], "does not converge")):
            result = program.run([*words, *more, "-output", tempfile.mkdtemp()], 2)
            self.assertIn(said, result.stdout + result.stderr)

    def test_what_nothing_holds_is_refused(self):
        for more, why in ((["-contacts", "none", "-body_allow_loose", "true"], "finds no rest under its weight"),
                          (["-body_initial_displacement", "0,0,0.1"], "not with -preload static"),
                          (["-preload", "dynamic"], "none static"), (["-gravity", -9.81], ">= 0")):
            words = ["-structures", "body", *box("body", "nz=2"), *contacts(stop=("body:z_min", "wall", 0)),
                     "-end_time", 0.01, *REST, *more]
            program.must_refuse(self, [*words, "-output", tempfile.mkdtemp()], why, ranks=2)


class Stack(unittest.TestCase):
    """Three blocks of different sizes on a wall, nothing else holds them."""

    def test_every_joint_carries_what_stands_on_it(self):
        heights = (0.5, 0.3, 0.8)
        words = ["-structures", "a,b,c", "-contacts", "ground,joint1,joint2", "-time_step", 2e-5,
                 "-output_interval", 2e-4, "-energy_interval", 500, *REST]
        base = 0.0
        for name, height, n in zip("abc", heights, (3, 2, 4)):
            words += box(name, f"z0={base},lx=0.6,ly=0.6,lz={height},nx=3,ny=3,nz={n}", poisson=0.2)
            base += height
        for contact, upper, lower in (("ground", "a", "wall"), ("joint1", "b", "a:z_max"), ("joint2", "c", "b:z_max")):
            words += [f"-{contact}_secondary", f"{upper}:z_min", f"-{contact}_primary", lower, f"-{contact}_gap", 0]
        for ranks, steps in ((1, 100000), (2, 5000)):
            run = Recorded(self, [*words, "-end_time", steps * 2e-5], ranks)
            for contact, above in (("ground", 1.6), ("joint1", 1.1), ("joint2", 0.8)):
                weight = DENSITY * GRAVITY * 0.36 * above
                self.assertLess(abs(run.force(contact)[1:] / weight - 1).max(), 1e-10)
            self.assertLess(largest_speed(run, DENSITY * 0.2**2 * 0.15 / 8), 1e-9)
            self.assertEqual(len(run.column("start")), 3)


class Cantilever(unittest.TestCase):
    """A beam of bricks that bends down to a wall below, beside dense algebra on its exported matrices."""

    def matrix(self, folder, name):
        return scipy.io.mmread(os.path.join(folder, name)).toarray()

    def solve(self, stiffness, load, rows, gaps):
        """Displacement and forces of closed rows, by trying sets of rows until none pulls and none is violated."""
        closed = numpy.zeros(len(gaps), dtype=bool)
        flexible = numpy.linalg.solve(stiffness, numpy.column_stack([load, rows.T]))
        compliance = rows @ flexible[:, 1:]
        for _ in range(100):
            force = numpy.zeros(len(gaps))
            free = gaps + rows @ flexible[:, 0]
            force[closed] = numpy.linalg.solve(compliance[numpy.ix_(closed, closed)], -free[closed])
            wanted = numpy.where(closed, force > 0, free + compliance @ force < -1e-15)
            if (wanted == closed).all():
                return flexible[:, 0] + flexible[:, 1:] @ force, force
            closed = wanted
        self.fail("no set of rows found")

    def test_lies_on_the_wall_where_dense_algebra_says(self):
        folder = tempfile.mkdtemp()
        gap = 5e-6
        words = ["-structures", "arm", *box("arm", "lx=4,ly=0.5,lz=0.25,nx=8,ny=1,nz=1", "-arm_clamp", "x_min",
                                            poisson=0.2), "-contacts", "floor", "-floor_secondary", "arm:z_min",
                 "-floor_primary", "wall", "-floor_gap", gap, "-end_time", 0.002, "-probes", "tip", "-tip_structure",
                 "arm", "-tip_group", "x_max", "-export_matrices", folder, *REST]
        for ranks in (1, 2, 3):
            run = Recorded(self, words, ranks)
            mass = self.matrix(folder, "arm/mass.mtx")[:, 0]
            down = self.matrix(folder, "arm/influence.mtx")[:, 2]
            rows = self.matrix(folder, "arm/contact.mtx")
            displacement, force = self.solve(self.matrix(folder, "arm/stiffness.mtx"), -GRAVITY * mass * down,
                                             rows, numpy.full(len(rows), gap))
            contact = run.summary["equilibrium"]["contacts"]["floor"]
            self.assertGreater((force > 0).sum(), 1)
            self.assertGreater((force == 0).sum(), 3)
            self.assertEqual(contact["points"], (force > 0).sum())
            self.assertAlmostEqual(contact["force"] / force.sum(), 1, delta=1e-9)
            self.assertLess(abs(run.force("floor")[1:] / force.sum() - 1).max(), 1e-9)
            tip = self.matrix(folder, "arm/probes.mtx")[2] @ displacement
            self.assertLess(abs(run.displacement("tip.z") / tip - 1).max(), 1e-9)


class OnSprings(unittest.TestCase):
    def test_settles_by_its_weight_over_the_springs(self):
        stiffness, mass = 4e4, 100.0
        words = ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo",
                 "-frame_ignore", "anchors,left,right", "-frame_mass_element", "point_mass", "-frame_mass_mass", mass,
                 "-frame_support_element", "grounded_spring", "-frame_support_stiffness", f"1e4,1e4,{stiffness}",
                 "-frame_support_dashpot", "0,0,50,0,0,0", *probes(hung="frame@0,0,0"), "-time_step", 1e-3,
                 "-end_time", 1, "-frame_gravity", f"0.1,0,{-GRAVITY}", *REST]
        for more in ([], [*in_modes("frame", 3)]):
            run = Recorded(self, words + more)
            self.assertLess(abs(run.displacement("hung.z") / (-mass * GRAVITY / stiffness) - 1).max(), 1e-12)
            self.assertLess(abs(run.displacement("hung.x") / (mass * 0.1 / 1e4) - 1).max(), 1e-12)
            self.assertLess(largest_speed(run, mass), 1e-12)


class HungOnBraces(unittest.TestCase):
    """A mass between two pairs of bars that resist stretching only: one pair carries it."""
    MASS, AREA = 100.0, 1e-4
    PAIR = 2 * (2e9 * AREA / 5) * 0.8**2

    def test_one_pair_is_taut(self):
        words = ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo", "-frame_clamp", "anchors",
                 "-frame_ignore", "support", *material("steel", 2e9, 0.3, 1e-9), "-frame_mass_element", "point_mass",
                 "-frame_mass_mass", self.MASS, "-frame_gravity", f"{GRAVITY},0,0", *probes(hung="frame@0,0,0"),
                 "-time_step", 1e-3, "-end_time", 2, "-preload", "static"]
        for side in ("left", "right"):
            words += [f"-frame_{side}_element", "bar", f"-frame_{side}_material", "steel", f"-frame_{side}_area",
                      self.AREA, f"-frame_{side}_tension_only", "true"]
        modal = [*in_modes("frame", 3)]
        for ranks, more in ((1, []), (2, []), (3, []), (2, modal)):
            with self.subTest(ranks=ranks, more=more):
                run = Recorded(self, words + more, ranks)
                self.assertLess(abs(run.displacement("hung.x") / (self.MASS * GRAVITY / self.PAIR) - 1).max(), 1e-10)
                self.assertLess(largest_speed(run, self.MASS), 1e-9)
                rest = run.summary["equilibrium"]
                self.assertEqual((rest["acting_links"], rest["idle_links"]), (2, 2))
                self.assertAlmostEqual(rest["structures"]["frame"]["support"][0] / (self.MASS * GRAVITY), -1,
                                       delta=1e-10)


class Portal(unittest.TestCase):
    """A frame of beams, shaken: without contact the motion about the rest is that without gravity."""

    SCENE = ["-structures", "frame", "-frame_mesh", "tests/meshes/portal.geo", "-frame_clamp", "base",
             "-material_steel_young", 210e9, "-material_steel_poisson", 0.3, "-material_steel_density", 7850,
             *(word for group in ("columns", "girder") for word in (
                 f"-frame_{group}_element", "beam", f"-frame_{group}_material", "steel",
                 f"-frame_{group}_section", "i")),
             "-section_i_area", 5e-3, "-section_i_inertia_y", 2e-5, "-section_i_inertia_z", 4e-5,
             "-section_i_torsion", 1e-6, "-section_i_z_axis", "0,0,1", "-time_step", 2e-5,
             "-output_interval", 1e-3, "-probes", "middle,corner", "-middle_structure", "frame", "-middle_at", "2,3,0",
             "-corner_structure", "frame", "-corner_at", "0,3,0"]
    WEIGHT = ["-frame_gravity", f"0,{-GRAVITY},0", "-preload", "static"]

    def shake(self, *more, ranks=program.RANKS):
        record = write_sine(2.0, 3.0, 0.3)
        words = [*self.SCENE, "-motion_x_record", record, "-motion_x_unit", "m/s2", "-end_time", 0.3,
                 "-frame_damping_alpha", 1]
        return Recorded(self, words + list(more), ranks, identity=1e-11)

    def test_stands_for_a_hundred_thousand_steps(self):
        """Clamped, under its weight, without damping."""
        run = Recorded(self, [*self.SCENE, *self.WEIGHT, "-end_time", 2, "-energy_interval", 1000], 1)
        self.assertLess(largest_speed(run, 7850 * 5e-3 * 3 / 16), 1e-9)  # of the lightest node that moves
        rest = run.summary["equilibrium"]["structures"]["frame"]
        self.assertAlmostEqual(rest["support"][1] / -rest["weight"][1], 1, delta=1e-10)
        self.assertLess(run.displacement("middle.y")[0], -1e-5)

    def assert_alike(self, still, moved, tolerance):
        scale = abs(still.displacement("middle.x")).max()
        self.assertGreater(scale, 1e-4)
        for channel in ("middle.x", "middle.y", "corner.x", "corner.y"):
            more = moved.displacement(channel) - moved.displacement(channel)[0]
            self.assertLess(abs(more - still.displacement(channel)).max(), tolerance * scale)

    def test_moves_about_its_rest_as_without_gravity_under_uniform_damping(self):
        uniform = ["-frame_damping_alpha", 0, "-frame_damping_uniform", 0.05, "-time_step", 1.6e-5]
        for more, tolerance in (([], 1e-8), ([*in_modes("frame", 8)], 1e-3)):
            still, moved = self.shake(*uniform, *more), self.shake(*uniform, *more, *self.WEIGHT)
            self.assertLess(moved.displacement("middle.y")[0], -1e-5)
            self.assert_alike(still, moved, tolerance)

    def test_moves_about_its_rest_as_without_gravity(self):
        still, moved = self.shake(), self.shake(*self.WEIGHT)
        self.assertLess(moved.displacement("middle.y")[0], -1e-5)
        self.assert_alike(still, moved, 1e-8)
        modal = [*in_modes("frame", 8)]
        reduced = self.shake(*self.WEIGHT, *modal)
        self.assertAlmostEqual(reduced.displacement("middle.y")[0] / moved.displacement("middle.y")[0], 1, delta=1e-6)
        self.assert_alike(self.shake(*modal), reduced, 1e-3)


class Sag(unittest.TestCase):
    """A clamped beam of twenty elements sags by w L^4 / (384 E I) under its weight, however it is damped."""

    def test_is_that_of_the_stiffness(self):
        area, inertia, length = 0.04, 1.3e-4, 10.0
        words = ["-structures", "a", "-a_mesh", "tests/meshes/line.geo", "-a_mesh_set", f"length={length},n=20",
                 "-a_clamp", "x_min,x_max", "-a_line_element", "beam", "-a_line_material", "steel",
                 "-a_line_section", "box", *material("steel", 2e11, 0.3, 7850),
                 *section("box", area, inertia, inertia, 2.2e-4, "0,0,1"), *probes(mid="a@5,0,0"), "-end_time", 0.002,
                 "-output_interval", 0.001, *REST]
        sag = 7850 * area * GRAVITY * length**4 / (384 * 2e11 * inertia)
        self.assertAlmostEqual(1e3 * sag, 3.0853, delta=5e-4)
        reduced = [*in_modes("a", 6)]
        for more in (["-a_damping_ratio", 0.05, "-a_damping_frequencies", "5,50"], ["-a_damping_uniform", 0.05],
                     ["-a_damping_uniform", 0.05, "-a_damping_band", "1,400", "-a_damping_reference", 200],
                     ["-a_damping_uniform", 0.05, *reduced]):
            run = Recorded(self, words + more)
            self.assertLess(abs(run.displacement("mid.z") / -sag - 1).max(), 1e-6, more)


class ThinStrip(unittest.TestCase):
    """A strip of steel, half a millimetre thick, sags as a beam does: its rotary inertia is next to nothing."""

    def test_finds_its_rest(self):
        length, thickness, young, density = 0.1, 5e-4, 2e11, 7850.0
        words = ["-structures", "strip", "-strip_mesh", "tests/meshes/quadrilateral.geo",
                 "-strip_mesh_set", f"length={length},width_0=0.02,width_1=0.02,nx=40,ny=8", "-strip_clamp", "x_min",
                 "-strip_plate_element", "shell", "-strip_plate_thickness", thickness, "-strip_plate_material", "steel",
                 *material("steel", young, 0, density), "-probes", "tip", "-tip_structure", "strip",
                 "-tip_at", f"{length},0.01,0", "-end_time", 1e-5, "-output_interval", 1e-6, *REST]
        sag = density * GRAVITY * length**4 / 8 / (young * thickness**2 / 12)
        for ranks, more in ((1, []), (2, []), (2, ["-strip_damping_uniform", 0.02, "-strip_damping_band", "1,4000"])):
            run = Recorded(self, words + more, ranks)
            self.assertAlmostEqual(run.displacement("tip.z")[0] / -sag, 1, delta=0.01)
            self.assertLess(numpy.ptp(run.displacement("tip.z")), 1e-6 * sag)


class SameBits(unittest.TestCase):
    """A factor shared by ranks differs from run to run; the rest that comes of it does not."""

    def test_two_runs_start_from_the_same_bits(self):
        words = ["-options_file", "petsc-options/plant/standing.yaml", "-block_mesh_set", "m=1", "-frame_mesh_set",
                 "m=1,x0=24.801", "-end_time", 1e-3, "-output_interval", 1e-4, "-modes", 1, "-spectra_frequencies", 5]
        for more in ([], ["-block_soil_compression_only", "false", "-frame_soil_compression_only", "false"]):
            starts = []
            for _ in range(2):
                run = Recorded(self, [*words, *more], 2, identity=1e-9)
                starts.append(numpy.array([run.displacement(f"{probe}.{axis}") for probe in
                                           ("tower_roof", "block_floor", "frame_roof") for axis in "xyz"]))
            self.assertGreater(abs(starts[0]).max(), 1e-3)
            for other in starts[1:]:
                self.assertTrue(numpy.array_equal(starts[0], other))


if __name__ == "__main__":
    unittest.main()
