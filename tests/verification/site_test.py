"""A rigid structure on soil, petsc-options/plant/site.yaml: the free field against waves in a layer, sides that are
held against periodic ones, the roof against a body on published springs.

Closed forms of a layer of height H on a base with the acceleration a(t). Without damping the surface has the sum of
what comes up and goes down,

    2 sum (-1)^n a(t - (2n + 1) H / V)

With C = alpha M + beta K, which brake the motion relative to the base, the surface over the base is per frequency

    1 + A (1 / cos kH - 1),    A = w^2 / (w^2 - i w alpha),    k^2 = (w^2 - i w alpha) / (V^2 (1 + i w beta))
"""
import csv
import math
import os
import sys
import tempfile
import unittest

import numpy
import scipy.io
import scipy.sparse

import program
from recorded import Recorded, write_samples

sys.path.insert(0, os.path.join(program.SOURCE, "python", "examples"))
from ormsby import ormsby  # noqa: E402

SCENE = ["-options_file", "petsc-options/plant/site.yaml", "-modes", 0]
SHEAR, DENSITY, POISSON, HEIGHT, SIDE = 46.2825e6, 1700.0, 0.3, 29.47, 75.0
SPEED = math.sqrt(SHEAR / DENSITY)
MAT, THICK, TALL = 13.8, 1.4, 10.0
MASS, ROOF = 2700 * MAT**2 * THICK, 166e3


class Layer(unittest.TestCase):
    """No structure: soil where the mat is, the roof apart."""
    ALONE = ["-site_rigid", "none", "-site_mat_material", "soil", "-site_allow_loose", "true"]
    SLOW = (0.0, 0.2, 4.0, 6.0)  # Hz: V / f is 27 m and more

    def error(self, h, ranks):
        """Largest error of the surface's motion in 3 s over the largest motion."""
        step = 1e-3
        times = step * numpy.arange(3001)
        record = write_samples(ormsby(times, self.SLOW), step)
        run = Recorded(self, [*SCENE, *self.ALONE, "-site_mesh_set", f"h={h}", "-time_step", step,
                              "-motion_x_record", record, "-motion_x_unit", "m/s2", "-free_field_at",
                              "-37.5,-37.5,0; 0,0,0", "-free_field_average", "false"], ranks)
        waves = sum((-1)**n * 2 * self.displacement(run.time - (2 * n + 1) * HEIGHT / SPEED) for n in range(9))
        exact = waves - self.displacement(run.time)
        corner, middle = (run.displacement(f"free_field.{n}.x") for n in (1, 2))
        scale = abs(exact).max()
        self.assertLess(abs(corner - middle).max() / scale, 1e-9, "a column")
        return abs(corner - exact).max() / scale

    def displacement(self, times):
        """Displacement of the wavelet from rest at t = 0, by the trapezoidal rule twice."""
        step = 1e-4
        fine = step * numpy.arange(30001)
        motion = ormsby(fine, self.SLOW)
        velocity = numpy.concatenate([[0], numpy.cumsum((motion[1:] + motion[:-1]) / 2)]) * step
        moved = numpy.concatenate([[0], numpy.cumsum((velocity[1:] + velocity[:-1]) / 2)]) * step
        return numpy.interp(times, fine, moved, left=0)

    def test_surface_is_the_sum_of_the_waves(self):
        """Order 2 in the mesh; the row beside the mat stays one brick."""
        coarse, fine = self.error(4, 1), self.error(2, 2)
        self.assertLess(fine, 0.03, "surface")
        self.assertGreater(coarse / fine, 3.7)


class FreeField(unittest.TestCase):
    """The scene as it is shipped, 8 % of Rayleigh damping at 1.4 and 8 Hz beside it, until it is at rest again."""
    RATIO, LOW, HIGH = 0.08, 2 * math.pi * 1.4, 2 * math.pi * 8
    ALPHA, BETA = 2 * RATIO * LOW * HIGH / (LOW + HIGH), 2 * RATIO / (LOW + HIGH)
    STEP = 0.002

    @classmethod
    def setUpClass(cls):
        cls.runs = {}

    def run_on(self, ranks):
        if ranks not in self.runs:
            self.runs[ranks] = Recorded(self, [*SCENE, "-site_damping_alpha", repr(self.ALPHA), "-site_damping_beta",
                                               repr(self.BETA), "-end_time", 9], ranks)
        return self.runs[ranks]

    def transfer(self, run, probe, frequency):
        """Absolute acceleration of a probe over that of the base."""
        omega = 2 * math.pi * frequency
        times = self.STEP * numpy.arange(1501)
        base = numpy.exp(-1j * omega * times) @ ormsby(times)
        return 1 - omega**2 * (numpy.exp(-1j * omega * run.time) @ run.displacement(f"{probe}.x")) / base

    def layer(self, frequency):
        omega = 2 * math.pi * frequency
        wave = omega / SPEED * numpy.sqrt((1 - 1j * self.ALPHA / omega) / (1 + 1j * omega * self.BETA))
        return 1 + (1 / numpy.cos(wave * HEIGHT) - 1) / (1 - 1j * self.ALPHA / omega)

    def test_transfer_function_of_the_layer(self):
        """Corner of the block, 53 m from the structure; at 1.4 Hz it moves six times as the base."""
        run = self.run_on(2)
        self.assertEqual(run.summary["structures"]["site"]["nodes"], 24337)
        self.assertGreater(abs(self.layer(1.4)), 6)
        for frequency in (0.5, 0.8, 1.0, 1.2, 1.4, 1.7, 2.0):
            found = self.transfer(run, "free_field", frequency)
            self.assertLess(abs(found / self.layer(frequency) - 1), 0.02, "transfer function")

    def test_structure_is_a_rigid_body_on_published_springs(self):
        """Roof over free field up to 2 Hz, where the block's sides do not matter yet."""
        run = self.run_on(2)
        for frequency in (0.5, 1.0, 1.4, 1.7, 2.0):
            found = self.transfer(run, "roof", frequency) / self.transfer(run, "free_field", frequency)
            self.assertLess(abs(found - self.roof_on_springs(frequency)), 0.01, "roof")
        self.assertGreater(abs(found), 1.05)

    def roof_on_springs(self, frequency):
        """Motion of the roof in a free field of 1: springs of an embedded square (Pais and Kausel 1988), stiffened by
        rock at the depth H as those of a disk (Kausel 1974), dashpots of plane waves under the mat and at its sides.
        The soil that the mat displaces is missing in what they hold."""
        omega, half, radius = 2 * math.pi * frequency, MAT / 2, MAT / math.sqrt(math.pi)
        turning = (MAT**4 / (3 * math.pi))**0.25
        deep = THICK / half
        sway = SHEAR * half / (2 - POISSON) * 9.2 * (1 + deep**0.8) * (1 + radius / (2 * HEIGHT))
        rock = SHEAR * half**3 / (1 - POISSON) * 4 * (1 + deep + 1.6 / 1.35 * deep**2) * (1 + turning / (6 * HEIGHT))
        press = 3.4 * SPEED / (math.pi * (1 - POISSON))  # speed of Lysmer's analogue
        a0 = omega * half / SPEED
        sway_dashpot = DENSITY * (SPEED * MAT * (MAT + 2 * THICK) + press * 2 * MAT * THICK)
        rock_dashpot = DENSITY * (press * MAT**4 / 12 * a0**2 / (2.2 + a0**2)
                                  + SPEED * THICK * (2 * MAT * half**2 + MAT**3 / 6))
        hysteresis = 1 + 1j * omega * self.BETA
        springs = numpy.diag([sway * hysteresis + 1j * omega * sway_dashpot,
                              rock * hysteresis + 1j * omega * rock_dashpot])

        def inertia(mass, top):
            arm = TALL + THICK
            turn = mass * (THICK**2 / 4 + (THICK**2 + MAT**2) / 12) + top * arm**2
            return numpy.array([[mass + top, mass * THICK / 2 + top * arm], [mass * THICK / 2 + top * arm, turn]])

        soil = inertia(DENSITY * MAT**2 * THICK, 0)
        motion = numpy.linalg.solve(springs - omega**2 * inertia(MASS, ROOF), (springs - omega**2 * soil) @ [1, 0])
        return motion[0] + motion[1] * (TALL + THICK)

    def test_on_any_ranks(self):
        """Ranks 1 and 2 agree to round-off; what is odd over a plane of symmetry is zero on it."""
        one, two = self.run_on(1), self.run_on(2)
        for probe in ("free_field", "mat", "roof"):
            motion = one.displacement(f"{probe}.x")
            self.assertLess(abs(two.displacement(f"{probe}.x") - motion).max() / abs(motion).max(), 1e-11, "ranks")
            for axis in "yz":
                self.assertLess(abs(one.displacement(f"{probe}.{axis}")).max() / abs(motion).max(), 1e-9)


class Sides(unittest.TestCase):
    """Bricks of 8 m, thrown along x: central differences with the exported matrices of soil that nothing holds on its
    sides, with opposite sides moving alike and the mat rigid by elimination."""
    STEP, COUNT = 0.005, 400
    SCENE = [*SCENE, "-site_mesh_set", "h=8", "-motion_x_record", "none", "-site_initial_velocity", "1,0,0"]

    def matrices(self):
        """Places, components, K and diagonal M of the dofs."""
        with tempfile.TemporaryDirectory() as folder:
            program.must_run(self, [*self.SCENE, "-site_clamp", "base", "-site_rigid", "none", "-site_allow_loose",
                                    "true", "-time_step", 0, "-end_time", 1e-4, "-export_matrices", folder], 1)
            where = os.path.join(folder, "site")
            stiffness = scipy.sparse.csr_matrix(scipy.io.mmread(os.path.join(where, "stiffness.mtx")))
            mass = scipy.io.mmread(os.path.join(where, "mass.mtx")).toarray().ravel()
            with open(os.path.join(where, "dofs.csv")) as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        places = numpy.array([[float(row[axis]) for axis in "xyz"] for row in rows])
        return places, numpy.array(["xyz".index(row["component"][-1]) for row in rows]), stiffness, mass

    def motions(self, places, components):
        """T: a column for each motion of the mat and for each dof of the soil, those of opposite sides being one."""
        body = (abs(places[:, :2]) < MAT / 2 + 1e-6).all(axis=1) & (places[:, 2] > -THICK - 1e-6)
        entries, column = [], {}
        for dof, (x, c) in enumerate(zip(places, components)):
            if body[dof]:
                rigid = [float(c == axis) for axis in range(3)] + [numpy.cross(turn, x)[c] for turn in numpy.eye(3)]
                entries += [(dof, n, value) for n, value in enumerate(rigid)]
            else:
                wrapped = [-SIDE / 2 if abs(value - SIDE / 2) < 1e-6 else value for value in x[:2]]
                key = (*numpy.round([*wrapped, x[2]], 6), c)
                entries.append((dof, column.setdefault(key, 6 + len(column)), 1.0))
        dofs, columns, values = zip(*entries)
        return scipy.sparse.csr_matrix((values, (dofs, columns)))

    def test_held_sides_move_as_periodic_ones(self):
        places, components, stiffness, mass = self.matrices()
        motions = self.motions(places, components)
        left = (motions.T @ scipy.sparse.diags(mass) @ motions).toarray()
        right = (motions.T @ stiffness @ motions).toarray()
        thrown = numpy.linalg.solve(left, motions.T @ (mass * (components == 0)))
        tangent = numpy.linalg.solve(left, right)
        followed = {"free_field": (-SIDE / 2, -SIDE / 2, 0), "roof": (0, 0, TALL), "mat": (0, 0, 0)}
        rows = [motions[int(((abs(places - at) < 1e-6).all(axis=1) & (components == 0)).argmax())].toarray().ravel()
                for at in followed.values()]
        u, v, history = numpy.zeros_like(thrown), thrown, []
        for n in range(self.COUNT):
            history.append([row @ u for row in rows])
            v = v - (self.STEP if n > 0 else self.STEP / 2) * (tangent @ u)
            u = u + self.STEP * v
        for ranks in (1, 2):
            run = Recorded(self, [*self.SCENE, "-time_step", self.STEP, "-output_interval", self.STEP, "-end_time",
                                  self.STEP * self.COUNT], ranks)
            for probe, exact in zip(followed, numpy.array(history).T):
                found = run.displacement(f"{probe}.x")[:self.COUNT]
                self.assertLess(abs(found - exact).max() / abs(exact).max(), 1e-9, "periodic sides")


if __name__ == "__main__":
    unittest.main()
