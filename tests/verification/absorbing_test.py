"""Absorbing faces and a motion that enters from below: columns of soil against closed forms.

Waves go up a column of bricks whose cross-sections cannot deform (sides tied by height): u(z, t) of one
dimension. Closed forms, with the incident wave v_in at the base: below a free surface at height h of one
material v_top = 2 v_in(t - h / V); with a layer on top, per frequency,

    U_top / U_in = 2 exp(-i w h_rock / V_rock) / (cos kh + i Z sin kh),     Z = rho V / (rho_rock V_rock)

Independent of both: dense steps of the same scheme with the matrices that the program exports, for dashpots
of skew faces.
"""
import math
import os
import tempfile
import unittest

import h5py
import numpy
import scipy.io

import program
from decks import box_of, clock, contacts, material, probes
from recorded import Recorded, assert_continues, write_samples

DENSITY, SHEAR, POISSON = 2000.0, 200.0, 0.3  # kg/m3, m/s
PRESSURE = SHEAR * math.sqrt((2 - 2 * POISSON) / (1 - 2 * POISSON))
HEIGHT = 40.0
SPEED = {"x": SHEAR, "y": SHEAR, "z": PRESSURE}


def young(speed, density=DENSITY, nu=POISSON):
    return 2 * (1 + nu) * density * speed**2


def column(lower, upper, n_lower, n_upper, *more, rock=(SHEAR, DENSITY), soil=(SHEAR, DENSITY)):
    """A column of two layers (speed, density), its sides tied by height, absorbing below."""
    words = ["-structures", "site", "-site_mesh", "tests/meshes/column.geo", "-site_mesh_set",
             f"lower={lower},upper={upper},n_lower={n_lower},n_upper={n_upper}", "-site_levels", "all",
             "-site_absorbing_base", "bottom", "-motion_input", "below", "-energy_interval", 20, "-modes", 0]
    for group, (speed, density) in (("rock", rock), ("soil", soil)):
        words += [f"-site_{group}_element", "hex8", f"-site_{group}_material", group,
                  f"-material_{group}_young", repr(young(speed, density)), f"-material_{group}_poisson", POISSON,
                  f"-material_{group}_density", density]
    words += [*probes(base="site:bottom", top="site:top", all="site:all")]
    return words + list(more)


class Pulse:
    """Incident wave of one smooth pulse: displacement D exp(-((t - t0) / w)^2), its derivatives in closed form."""
    SIZE, WIDTH = 0.01, 0.08

    def __init__(self, width=WIDTH):
        self.width, self.start = width, 6 * width
        times = 1e-4 * numpy.arange(round(2 * self.start / 1e-4) + 1)
        self.file = write_samples(self.acceleration(times), 1e-4)

    def displacement(self, t):
        return self.SIZE * numpy.exp(-((t - self.start) / self.width)**2)

    def velocity(self, t):
        return -2 * (t - self.start) / self.width**2 * self.displacement(t)

    def acceleration(self, t):
        s = (t - self.start) / self.width
        return (4 * s**2 - 2) / self.width**2 * self.displacement(t)

    def along(self, *axes):
        return [word for axis in axes
                for word in (f"-motion_{axis}_record", self.file, f"-motion_{axis}_unit", "m/s2")]


class WithPulse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pulse = Pulse()


class OneMaterial(WithPulse):
    def run_column(self, cells):
        return Recorded(self, column(HEIGHT / 2, HEIGHT / 2, cells // 2, cells // 2, *self.pulse.along(*"xyz"),
                                     "-end_time", 1.7, "-output_interval", 1e-3))

    def error(self, run, axis):
        """Largest error of the surface's motion over the largest of 2 u_in."""
        exact = 2 * self.pulse.displacement(run.time - HEIGHT / SPEED[axis])
        return abs(run.displacement(f"top.{axis}") - exact).max() / (2 * self.pulse.SIZE)

    def test_the_surface_moves_twice_as_the_incident_wave(self):
        """All three directions at once, each with its own speed; second order in the mesh."""
        errors = {}
        for cells in (40, 80):
            run = self.run_column(cells)
            errors[cells] = {axis: self.error(run, axis) for axis in "xyz"}
            self.assertEqual(run.summary["structures"]["site"]["absorbing"]["nodes"], 4)
        for axis in "xyz":
            self.assertLess(errors[80][axis], 5e-4, "surface")
            self.assertGreater(errors[40][axis] / errors[80][axis], 3.5)

    def test_nothing_comes_back(self):
        """Once the wave has passed twice, what is left of the motion and of the energy was reflected."""
        for axis in "xz":
            folder, _ = program.must_run(
                self, column(HEIGHT / 2, HEIGHT / 2, 40, 40, *self.pulse.along(axis), "-end_time", 1.7,
                             "-output_interval", 1e-3))
            columns = program.read_csv(os.path.join(folder, "energy.csv"))
            time = numpy.array([float(t) for t in columns["time"]])
            energy = sum(numpy.array([float(e) for e in columns[name]]) for name in ("kinetic", "strain"))
            gone = time > 2 * self.pulse.start + 2 * HEIGHT / SPEED[axis]
            self.assertGreater(gone.sum(), 5)
            self.assertLess(energy[gone].max() / energy.max(), 1e-8, "energy that came back")


class TwoLayers(unittest.TestCase):
    """20 m of soil at 150 m/s over rock at 400 m/s: the first frequency is 1.875 Hz."""
    SOIL, ROCK = (150.0, 1800.0), (400.0, 2200.0)
    STEP = 1e-3

    def test_transfer_function(self):
        pulse = Pulse(0.02)
        soil, rock = 20.0, 8.0
        run = Recorded(self, column(rock, soil, 16, 100, *pulse.along("x"), *clock(self.STEP / 4, 6, self.STEP),
                                    rock=self.ROCK, soil=self.SOIL))
        times = run.time
        ratio = self.SOIL[0] * self.SOIL[1] / (self.ROCK[0] * self.ROCK[1])
        for frequency in (0.5, 1.0, 1.875, 3.0, 3.75, 5.625, 8.0):
            omega = 2 * math.pi * frequency
            turn = numpy.exp(-1j * omega * times)
            found = (turn @ run.displacement("top.x")) / (turn @ pulse.displacement(times))
            angle = omega * soil / self.SOIL[0]
            exact = 2 * numpy.exp(-1j * omega * rock / self.ROCK[0]) / (math.cos(angle) + 1j * ratio * math.sin(angle))
            self.assertLess(abs(found / exact - 1), 2e-3, "transfer function")


class FreeField(WithPulse):
    """What stands beside a column that is one element wide, or is built of several."""

    def test_a_wide_block_moves_as_a_column(self):
        """Its sides tied by height: every node of the surface moves as the free field does."""
        words = column(10, 10, 5, 5, *self.pulse.along("x", "z"), *clock(1e-3, 1.3, 5e-3), soil=(150.0, 1800.0))
        free = Recorded(self, words)
        wide = list(words)
        wide[wide.index("-site_levels") + 1] = "sides"
        wide[wide.index("-site_mesh_set") + 1] += ",lx=9,ly=6,nx=3,ny=2"
        run = Recorded(self, wide + ["-top_average", "false"])
        for _, name in zip(*run.nodes("top")):
            for axis in "xz":
                field = free.displacement(f"top.{axis}")
                self.assertLess(abs(run.displacement(f"{name}.{axis}") - field).max(), 1e-9 * abs(field).max())

    def test_outputs_are_absolute(self):
        """Accelerations of the surface are 2 a_in, those of the ground none."""
        folder, _ = program.must_run(
            self, column(8, 8, 16, 16, *self.pulse.along("z"), "-end_time", 1, "-output_interval", 1e-3,
                         "-spectra_frequencies", "10,400", "-spectra_damping", 0.05))
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            self.assertEqual(abs(file["ground_acceleration"][()]).max(), 0)
            names = [name.decode() for name in file["channels"]]
            found = file["acceleration"][()][:, names.index("top.z")]
            offset = file["acceleration"].attrs["time_offset"]
            times = file["time"][()] + offset
        exact = 2 * self.pulse.acceleration(times - 16 / PRESSURE)
        self.assertLess(abs(found - exact).max() / abs(exact).max(), 5e-3, "acceleration")
        rows = program.read_csv(os.path.join(folder, "spectra.csv"))
        stiff = [float(rows["pseudo_acceleration"][i]) for i in range(len(rows["probe"]))
                 if rows["probe"][i] == "top" and rows["direction"][i] == "z" and float(rows["frequency"][i]) == 400]
        self.assertAlmostEqual(stiff[0] / abs(exact).max(), 1, delta=1e-2)


def two_soils(pulse, end):
    """All directions at once, through two materials."""
    return column(10, 10, 8, 8, *pulse.along("x", "y", "z"), *clock(5e-4, end, 1e-3), soil=(150.0, 1800.0))


class SameRun(WithPulse):
    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, two_soils(self.pulse, 1.2), 0.6, 700, 2)


SLOPE = 0.4


class SkewFaces(unittest.TestCase):
    """Two bricks on each other that lean by 0.4, thrown with (1, 2, 3) m/s: dashpots of a leaning side and of the
    underside, whose edge belongs to both, against dense steps."""
    SPEEDS = ((200.0, 2000.0), (100.0, 1500.0))  # of the lower and the upper brick

    def words(self, *more):
        words = ["-structures", "site", "-site_mesh", "tests/meshes/column.geo", "-site_mesh_set",
                 f"lower=1,upper=2,n_lower=1,n_upper=1,slope={SLOPE}", "-site_initial_velocity", "1,2,3", "-modes", 0]
        for group, (speed, density) in zip(("rock", "soil"), self.SPEEDS):
            words += [f"-site_{group}_element", "hex8", f"-site_{group}_material", group,
                      f"-material_{group}_young", repr(young(speed, density)), f"-material_{group}_poisson", POISSON,
                      f"-material_{group}_density", density]
        return words + [*probes(p="site:all"), "-p_average", "false", *more]

    def faces(self):
        """Corners, outward normal, density, V_s of the three facets."""
        def at(x, y, z):
            return (x + SLOPE * z, y, z)
        lean = numpy.array([-1, 0, SLOPE]) / math.hypot(1, SLOPE)
        lower, upper = self.SPEEDS
        return (([at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)], lean, math.hypot(1, SLOPE), lower),
                ([at(0, 0, 1), at(0, 1, 1), at(0, 1, 3), at(0, 0, 3)], lean, 2 * math.hypot(1, SLOPE), upper),
                ([at(x, y, 0) for x in (0, 1) for y in (0, 1)], numpy.array([0, 0, -1]), 1, lower))

    def dashpots(self, dofs):
        """C over rows (position, component); shares of parallelograms are quarters."""
        result = numpy.zeros((len(dofs), len(dofs)))
        place = {dof: i for i, dof in enumerate(dofs)}
        for corners, normal, area, (speed, density) in self.faces():
            across = density * speed
            along = across * PRESSURE / SHEAR
            block = area / 4 * (across * numpy.eye(3) + (along - across) * numpy.outer(normal, normal))
            for x in corners:
                rows = [place.get((*(round(v, 9) for v in x), f"u{axis}")) for axis in "xyz"]
                for i, row in enumerate(rows):
                    for j, column_ in enumerate(rows):
                        if row is not None and column_ is not None:
                            result[row, column_] += block[i, j]
        return result

    def check(self, *more):
        with tempfile.TemporaryDirectory() as folder:
            program.must_run(self, self.words("-export_matrices", folder, "-end_time", 1e-3, *more))
            where = os.path.join(folder, "site")
            with open(os.path.join(where, "dofs.csv")) as file:
                rows = [line.strip().split(",") for line in file if line[0] not in "#x"]
            dofs = [(*(round(float(v), 9) for v in row[:3]), row[3]) for row in rows]
            stiffness = scipy.io.mmread(os.path.join(where, "stiffness.mtx")).toarray()
            mass = numpy.diag(scipy.io.mmread(os.path.join(where, "mass.mtx")).toarray().ravel())
        absorbing = ["-site_absorbing", "x_min,bottom", *clock(2e-4, 0.05), "-energy_interval", 1]
        run = Recorded(self, self.words(*absorbing, *more))
        dashpots, dt = self.dashpots(dofs), 2e-4
        v = numpy.array([{"ux": 1.0, "uy": 2.0, "uz": 3.0}[dof[3]] for dof in dofs])
        u = numpy.zeros(len(dofs))
        positions, names = run.nodes("p")
        channels = {(*(round(float(x), 9) for x in position), f"u{axis}"): f"{name}.{axis}"
                    for position, name in zip(positions, names) for axis in "xyz"}
        history = [run.displacement(channels[dof]) for dof in dofs]
        for n in range(len(run.time)):
            self.assertLess(max(abs(history[i][n] - u[i]) for i in range(len(dofs))), 1e-12, "dense steps")
            h = dt if n > 0 else dt / 2
            v = numpy.linalg.solve(mass + h / 2 * dashpots, (mass - h / 2 * dashpots) @ v - h * stiffness @ u)
            u = u + dt * v
        self.assertGreater(run.energy["devices"], 0.3 * run.energy["kinetic"])

    def test_against_dense_steps(self):
        self.check()

    def test_partly_clamped(self):
        """The clamped components drop out of dashpots that lie across them."""
        self.check("-site_clamp", "bottom:z")


class Limit(unittest.TestCase):
    """No dashpot moves the stable step: a cube that dashpots hold on all its sides, and one without."""

    def words(self, density, *more):
        return ["-structures", "cube", *box_of("cube", "nx=3,ny=3,nz=3", "soil"),
                *material("soil", "1e8", POISSON, density), "-energy_interval", 20, "-output_interval", 0.01, *more]

    FACES = ["-cube_absorbing", "x_min,x_max,y_min,z_min"]

    def limit(self, *more):
        _, summary = program.must_run(self, self.words(2000, "-end_time", 1e-3, *more))
        return summary["structures"]["cube"]["stable_time_step"]

    def test_is_that_without_them(self):
        self.assertEqual(self.limit(*self.FACES), self.limit())

    def test_bounded_below_and_growing_above(self):
        """3,000 steps from a throw that turns the fastest motions on."""
        limit = self.limit()
        start = ["-cube_clamp", "z_max:x+y+z", "-cube_initial_velocity", "1,2,3"]
        held = self.limit(*start)
        step = 0.9999 * held
        folder, summary = program.must_run(
            self, self.words(2000, "-time_step", repr(step), "-end_time", repr(3000 * step), *self.FACES, *start))
        columns = program.read_csv(os.path.join(folder, "energy.csv"))
        energy = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
        self.assertLess(energy[-1], energy[0])
        self.assertLessEqual(max(energy), energy[0] * (1 + 1e-9))
        self.assertLess(summary["energy"]["relative_residual"], 1e-12)
        self.assertGreaterEqual(held, limit * (1 - 1e-6))
        step = 1.01 * held
        result = program.run(self.words(2000, "-time_step", repr(step), "-end_time", repr(20000 * step),
                                        "-allow_unstable", "true", *start, "-cube_absorbing", "x_min"))
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("diverged", result.stderr)


RESTING = ["-gravity", 9.81, "-preload", "static", "-site_clamp", "bottom:z"]


class AtRest(WithPulse):
    """Under gravity with the base clamped along z: the weight rests, the waves along x come and go."""

    def words(self, *more):
        return column(10, 10, 8, 8, *self.pulse.along("x"), "-end_time", 1.2, "-output_interval", 1e-3, *more)

    def test_weight_and_wave(self):
        plain = Recorded(self, self.words("-site_clamp", "bottom:z"))
        run = Recorded(self, self.words(*RESTING), identity=1e-11)
        settlement = run.displacement("top.z")
        exact = -9.81 * 20**2 / (2 * PRESSURE**2)
        self.assertAlmostEqual(settlement[0] / exact, 1, delta=1e-9)
        self.assertLess(abs(settlement - settlement[0]).max(), 1e-9 * abs(exact))
        u = plain.displacement("top.x")
        self.assertLess(abs(run.displacement("top.x") - u).max(), 1e-9 * abs(u).max())


def two_columns(pulse, *more):
    """Two columns of unlike soil beside each other, moved by one wave, hit each other."""
    words = column(6, 6, 6, 6, *pulse.along("x"), "-end_time", 1.2, "-time_step", 5e-4, "-gap_interval", 0.01)
    left = [word.replace("site", "left") if isinstance(word, str) else word for word in words]
    left[left.index("-structures") + 1] = "left,right"
    right = []
    for option, value in zip(left[::2], left[1::2]):
        if option.startswith("-left_"):
            right += [option.replace("left", "right"), value]
    right[right.index("-right_mesh_set") + 1] += ",x0=1"
    right[right.index("-right_soil_material") + 1] = "soft"
    return left + right + [*material("soft", repr(young(80.0, 1500.0)), POISSON, 1500),
                           *contacts(joint=("left:x_max", "right:x_min", 0.002)), *more]


class Pounding(WithPulse):
    def test_no_impact_is_missed(self):
        seldom, always = (Recorded(self, two_columns(self.pulse, *more)) for more in ((), ("-gap_interval", 5e-4)))
        self.assertGreater(len(seldom.impacts["contact"]), 3)
        self.assertEqual(seldom.impacts, always.impacts)


ON_RANKS = {
    "a site moved from below": lambda: two_soils(Pulse(0.02), 0.5),
    "dashpots of skew faces, partly clamped": SkewFaces().words(
        "-site_absorbing", "x_min,bottom", "-site_clamp", "bottom:z", *clock(2e-4, 0.05)),
    "a site at rest that a wave moves": lambda: column(10, 10, 8, 8, *Pulse(0.02).along("x"), *clock(1e-3, 0.4), *RESTING),
    "two sites that pound": lambda: two_columns(Pulse())}


if __name__ == "__main__":
    unittest.main()
