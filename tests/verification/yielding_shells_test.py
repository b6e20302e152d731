"""Shells that yield in shear in their plane: closed forms of one panel, walls against linear ones, ranks, rests, continued
runs, a cantilever wall pushed over.

A panel whose head only sways is a spring k = G t w / h that yields at the stress of its corner: a mass that is thrown at
it turns back where its energy is spent.
"""
import os
import shutil
import tempfile
import unittest

import numpy

import program
import vtkhdf_file
import xdmf_file
from loops_test import Loops
from recorded import Recorded, assert_continues

YOUNG, POISSON, THICKNESS = 30e9, 0.2, 0.2
SHEAR = YOUNG / (2 * (1 + POISSON))
STRESS = 1.5e6  # Pa, of the first corner


def pairs(*corners):
    """A skeleton whose first corner is given by its stress, the others by multiples of its strain and stress."""
    values = []
    for strain, stress in corners:
        values += [strain * STRESS / SHEAR, stress * STRESS]
    return ",".join(repr(value) for value in values)


TRILINEAR = pairs((1, 1), (3, 1.35), (20, 2))


def wall(*more, sizes="nx=4,nz=4", skeleton=TRILINEAR, time_step=2e-5, end=0.1, mass=2e4):
    """A wall with masses along its head."""
    words = ["-structures", "w", "-w_mesh", "tests/meshes/wall.geo", "-w_mesh_set", sizes, "-w_clamp", "foot",
             "-w_wall_element", "shell", "-w_wall_material", "concrete", "-w_wall_thickness", THICKNESS,
             "-material_concrete_young", YOUNG, "-material_concrete_poisson", POISSON,
             "-material_concrete_density", 2400,
             "-time_step", repr(time_step), "-end_time", end, "-output_interval", repr(5 * time_step),
             "-energy_interval", 10, "-probes", "head", "-head_structure", "w", "-head_at", "1.5,0,3"]
    if mass:
        words += ["-w_head_element", "point_mass", "-w_head_mass", mass]
    if skeleton:
        words += ["-w_wall_shear_skeleton", skeleton]
    return [*words, *more]


class OnePanel(unittest.TestCase):
    def swaying(self, *more, **values):
        """A panel of 3 x 3 m without mass but at its head, which sways only."""
        return wall("-w_clamp", "foot,head:y+z+rx+ry+rz", "-material_concrete_density", 1e-3, "-w_wall_drilling_factor",
                    1e-9, "-output_interval", "2e-5", *more, skeleton=pairs((1, 1)), **values)

    def test_thrown(self):
        width, height, mass, speed = 3.0, 3.0, 1e5, 0.2
        stiffness = SHEAR * THICKNESS * width / height
        force = STRESS * THICKNESS * width
        top = force / stiffness + (mass * speed**2 / 2 - force**2 / stiffness / 2) / force
        for sign, ranks in ((1, 1), (-1, 2)):
            run = Recorded(self, self.swaying("-w_initial_velocity", f"{sign * speed},0,0", sizes="nx=1,nz=1",
                                              mass=mass / 2, end=0.03), ranks)
            self.assertAlmostEqual((sign * run.displacement("head.x")).max() / top, 1, delta=1e-5)
            found = run.summary["yielding"]["w:wall:shear"]
            self.assertEqual((found["elements"], found["yielded"]), (1, 1))
            self.assertAlmostEqual(found["ductility"] / (top * stiffness / force), 1, delta=1e-5)
            self.assertAlmostEqual(found["energy_lost"] / run.energy["plastic"], 1, delta=1e-9)

    def test_triangles_and_quadrangle_pushed(self):
        """A head of great mass keeps its speed: all elements have one shear strain, and the stress of the skeleton."""
        speed, end = 0.1, 0.06
        words = self.swaying("-w_initial_velocity", f"{speed},0,0", "-loops", "w:wall", sizes="nx=2,nz=1,mixed=1,taper=0.8",
                             mass=1e13, end=end)
        run = Loops(self, [*words, "-head_at", "1.2,0,3"], 2)
        self.assertEqual(len(run.names), 3)
        for strain, stress in zip(run.elongation.T, run.force.T):
            self.assertLess(abs(strain * 3 - run.displacement[:, 0]).max(), 1e-8 * abs(run.displacement).max())
            self.assertLess(abs(stress - numpy.minimum(SHEAR * strain, STRESS)).max(), 1e-8 * STRESS)
        last = run.elongation[-1, 0]
        # The straight way to the first corner of the other side gives back a quarter of it.
        lost = 0.75 * STRESS * (last - STRESS / SHEAR) * THICKNESS * 3 * (3 + 2.4) / 2
        self.assertAlmostEqual(run.summary["yielding"]["w:wall:shear"]["energy_lost"] / lost, 1, delta=1e-3)


class Wall(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        time = numpy.arange(0, 0.3, 0.005)
        cls.record = program.write_samples(25 * numpy.sin(2 * numpy.pi * 8 * time) * numpy.sin(numpy.pi * time / 0.3), 0.005)
        cls.motion = ["-motion_x_record", cls.record, "-motion_x_unit", "m/s2", "-motion_y_record", cls.record,
                      "-motion_y_unit", "m/s2", "-motion_y_scale", 0.05]

    @classmethod
    def tearDownClass(cls):
        os.remove(cls.record)

    def test_elastic_it_is_the_linear_one(self):
        sizes = "nx=4,nz=4,mixed=1,taper=0.8"
        for damping in (["-w_damping_beta", 1e-5], ["-w_damping_uniform", 0.04]):
            words = [*self.motion, *damping, "-head_at", "1.2,0,3"]
            linear = Recorded(self, wall(*words, sizes=sizes, skeleton=None), 1)
            marked = Recorded(self, wall(*words, sizes=sizes, skeleton=pairs((1, 1), (1e4, 1e4))), 2)
            self.assertGreater(marked.summary["yielding"]["w:wall:shear"]["ductility"], 1)  # on the straight line
            for channel in ("head.x", "head.y", "head.z"):
                expected = linear.displacement(channel)
                self.assertGreater(abs(expected).max(), 1e-6)
                self.assertLess(abs(marked.displacement(channel) - expected).max(), 1e-11 * abs(expected).max())
            self.assertAlmostEqual(marked.summary["stable_time_step"] / linear.summary["stable_time_step"], 1, delta=1e-9)

    def test_yields_alike_on_any_ranks_and_continued(self):
        words = wall(*self.motion, "-w_damping_beta", 1e-5, "-w_gravity", "0,0,-9.81", "-head_at", "1.2,0,3",
                     sizes="nx=4,nz=4,mixed=1,taper=0.8", end=0.2)
        whole = Recorded(self, words, 1)
        yielding = whole.summary["yielding"]["w:wall:shear"]
        self.assertEqual(yielding["elements"], 24)
        self.assertEqual(sum("drilling_factor" in line for line in whole.summary["warnings"]), 1)
        self.assertGreater(yielding["ductility"], 2)
        self.assertGreater(yielding["energy_lost"], 1e3)
        for ranks in (2, 4):
            other = Recorded(self, words, ranks)
            self.assertLess(abs(other.displacement("head.x") - whole.displacement("head.x")).max(), 1e-10)
        assert_continues(self, [*words, "-modes", 1, "-spectra_frequencies", 10, "-loops", "w:wall"], 0.1, 3000)

    def test_loops_take_what_the_table_says(self):
        words = wall(*self.motion, "-output_interval", "2e-5", "-loops", "w:wall", end=0.2)
        run = Loops(self, words, 2)
        self.assertEqual(len(run.names), 16)
        self.assertTrue(run.names[0].endswith(".shear"), run.names[0])
        volume = THICKNESS * 3 * 3 / 16
        work = volume * ((run.force[1:] + run.force[:-1]) / 2 * numpy.diff(run.elongation, axis=0)).sum()
        self.assertAlmostEqual(work / run.summary["loops"]["w:wall"]["energy_taken"], 1, delta=1e-2)
        corners = [float(value) for value in TRILINEAR.split(",")]
        for name, e, f in zip(run.names, run.elongation.T, run.force.T):
            far = abs(e).argmax()
            on = numpy.interp(abs(e[far]), [0, *corners[::2]], [0, *corners[1::2]])
            self.assertAlmostEqual(abs(f[far]) / on, 1, delta=1e-9, msg=name)

    def test_rest_under_gravity(self):
        gravity = ["-w_gravity", "0.4,0,-9.81", "-preload", "static", "-end_time", 0.02]
        for damping in (["-w_damping_beta", 1e-5], ["-w_damping_uniform", 0.04]):
            x = Recorded(self, wall(*gravity, *damping), 2).displacement("head.x")
            self.assertGreater(abs(x[0]), 1e-6)
            self.assertLess(abs(x - x[0]).max(), 1e-10 * abs(x[0]))
        for damping in (["-w_damping_beta", 1e-5], ["-w_damping_uniform", 0.04]):
            run = Recorded(self, wall("-w_gravity", "40,0,-9.81", *gravity[2:], *damping), 2, identity=5e-12)
            x = run.displacement("head.x")
            self.assertGreater(run.summary["yielding"]["w:wall:shear"]["ductility"], 1.5)
            self.assertLess(abs(x - x[0]).max(), 1e-9 * x[0])

    def test_fields_have_what_the_table_says(self):
        words = wall(*self.motion, "-fields_interval", 0.1, "-csv_digits", 17, "-modes", 1, "-spectra_frequencies", 10, end=0.2)
        for ranks in (1, 2):
            folder, _ = program.must_run(self, words, ranks)
            self.addCleanup(shutil.rmtree, folder)
            table = program.read_csv(os.path.join(folder, "yielding.csv"))
            frames = xdmf_file.read(os.path.join(folder, "fields.xdmf"))
            steps = vtkhdf_file.read(os.path.join(folder, "fields.vtkhdf"))
            self.assertEqual(abs(frames[0][1]["w"].cell_data["lost_energy"]).max(), 0)
            for data in (frames[-1][1]["w"].cell_data, steps[-1][1][0].cell_data):
                place = {int(number): i for i, number in enumerate(data["element"])}
                cells = [place[int(float(number))] for number in table["element"]]
                self.assertEqual(data["ductility"][cells].tolist(), list(map(float, table["ductility"])))
                self.assertEqual(data["lost_energy"][cells].tolist(), list(map(float, table["lost_J"])))
                self.assertGreater(data["ductility"].max(), 1.5)
                self.assertEqual(sum(data["ductility"] > 0), len(cells))
                self.assertEqual(abs(data["damage"]).max(), 0)

    def test_laws_by_name(self):
        with tempfile.TemporaryDirectory() as folder:
            result = program.run([*wall(), "-law_cycles", "2,25", "-output", folder], 1)
            self.assertEqual(result.returncode, 0, result.stderr)
            laws = program.read_csv(os.path.join(folder, "laws.csv"))
        self.assertEqual(set(laws["law"]), {"w:wall:shear"})
        self.assertAlmostEqual(max(map(float, laws["force"])) / (2 * STRESS), 1, delta=1e-9)

    def test_refusals(self):
        for more, said in ((["-w_model", "modal"], "-w_model full"),
                           (["-w_wall_shear_skeleton", "1,5e6"], "not on the line of the stiffness"),
                           (["-w_wall_shear_skeleton_y", "1,5e6"], "not for the element shell"),
                           (["-export_matrices", "/tmp/nothing"], "elements that yield"),
                           (["-forces", "n", "-n_structure", "w", "-n_kind", "shells", "-n_group", "wall"], "follow a law"),
                           (["-w_wall_pinch", "0.2,0.5"], "goes with")):
            program.must_refuse(self, wall(*more), said, ranks=1)
        program.must_refuse(self, wall("-w_wall_shear_rule", "peak", skeleton=None), "-w_wall_shear_skeleton")


class Cantilever(unittest.TestCase):
    def pushed(self, cells, ranks=1):
        """Base shear [N] over drift of a wall whose head is carried to 1 % of drift by a great mass, free to turn."""
        speed, height, step = 0.1, 3.0, 1e-4 / cells
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
            table.write("x,y,z,vx\n")
            for node in range(cells + 1):
                table.write(f"{3 * (node / cells - 0.5)},0,{height},{speed}\n")
            table.flush()
            run = Recorded(self, wall(
                "-w_top_element", "point_mass", "-w_top_mass", 1e9, "-w_rigid", "head", "-w_initial_state", table.name,
                "-w_wall_rotary_inertia_factor", 0.125, "-w_wall_drilling_factor", 0.01, "-head_at", f"0,0,{height}", "-forces", "base", "-base_structure",
                "w", "-base_kind", "reactions", "-output_interval", repr(12 * step), sizes=f"nx={cells},nz={cells}",
                time_step=step, mass=0, end=0.01 * height / speed), ranks)
        self.assertFalse([line for line in run.summary["warnings"] if "drilling_factor" in line])
        return run.displacement("head.x") / height, -run.members("base")[:, 0]

    def test_skeleton_is_that_of_a_finer_mesh(self):
        drifts = numpy.linspace(1e-3, 9.5e-3, 18)
        found = []
        for cells, ranks in ((12, 2), (16, 1)):
            drift, force = self.pushed(cells, ranks)
            near = abs(drift[:, None] - drifts) < 2.5e-4
            found.append((force[:, None] * near).sum(0) / near.sum(0))
            self.assertAlmostEqual(found[-1][-1] / (2 * STRESS * THICKNESS * 3), 1, delta=0.02)
        self.assertLess(abs(found[0] / found[1] - 1).max(), 0.03)


if __name__ == "__main__":
    unittest.main()
