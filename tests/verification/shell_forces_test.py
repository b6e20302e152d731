"""Forces in shells and what a group carries through a plane, beside hand calculations and sums of m a.

A sheet of concrete held at one edge, level or upright, at rest under its weight and a side force or shaken. What the
elements carry through a cut is exact; what stands at their centres is the mean of an element, and tends to the section
forces of a beam or a plate as the mesh gets finer.
"""
import math
import unittest

import numpy

import program
from forces_test import Forces
from recorded import all_nodes, assert_continues, lumped_fractions, write_sine

GRAVITY, DENSITY, YOUNG, POISSON, THICKNESS = 9.81, 2400.0, 3e10, 0.2, 0.2
LENGTH, WIDTH = 4.0, 1.0
WEIGHT = DENSITY * THICKNESS * LENGTH * WIDTH     # times an acceleration
NAMES = ("N11", "N22", "N12", "M11", "M22", "M12", "Q1", "Q2")


def sheet(nx=8, ny=4, poisson=POISSON, pull=(0, 0, -GRAVITY), width=WIDTH, **mesh):
    """A sheet at rest under a uniform acceleration."""
    sizes = ",".join(f"{name}={value}" for name, value in {"length": LENGTH, "width": width, "nx": nx, "ny": ny, **mesh}.items())
    return ["-structures", "it", "-it_mesh", "tests/meshes/sheet.geo", "-it_mesh_set", sizes, "-it_clamp", "held",
            "-it_sheet_element", "shell", "-it_sheet_thickness", THICKNESS, "-it_sheet_material", "concrete",
            "-material_concrete_young", YOUNG, "-material_concrete_poisson", poisson, "-material_concrete_density",
            DENSITY, "-it_gravity", ",".join(map(str, pull)), "-preload", "static", "-end_time", 2e-7,
            "-output_interval", 1e-7]


def item(name, kind, *more):
    words = [f"-{name}_structure", "it", f"-{name}_kind", kind]
    if kind in ("shells", "cut"):
        words += [f"-{name}_group", "sheet"]
    return [*words, *more]


def centres(nx, ny, along=None):
    """Middles of the elements in their rows, as an option: of all, or of those at one place along the sheet."""
    places = [(LENGTH * (i + 0.5) / nx, WIDTH * ((j + 0.5) / ny - 0.5)) for i in range(nx) for j in range(ny)]
    return [place for place in places if along is None or abs(place[0] - along) < 1e-9]


def at(places):
    """An option of a level sheet."""
    return "; ".join(f"{u},{v},0" for u, v in places)


def of_elements(run, name):
    """Component -> value at rest, in the order of the points."""
    return {part: numpy.array([history[0] for key, history in run.force.items()
                               if key.startswith(name + ".") and key.endswith("." + part)]) for part in NAMES}


class Strip(unittest.TestCase):
    """A level strip whose transverse contraction is none, so that it is a beam."""

    def run_strip(self, pull, nx, ranks, *more, ny=1, **mesh):
        places = centres(nx, ny)
        words = sheet(nx, ny, poisson=0, pull=pull, **mesh)
        run = Forces(self, [*words, "-forces", "here", *item("here", "shells", "-here_at", at(places)), *more], ranks)
        return numpy.array(places)[:, 0], of_elements(run, "here"), run

    def test_tension(self):
        """N11 is the force of what hangs beyond the centre, to the round-off."""
        for ranks, triangles in ((1, 0), (2, 0)):
            x, found, run = self.run_strip((GRAVITY, 0, 0), 8, ranks, triangles=triangles)
            expected = DENSITY * THICKNESS * GRAVITY * (LENGTH - x)
            self.assertLess(abs(found["N11"] / expected - 1).max(), 1e-9, "tension")
            for name in NAMES[1:]:
                self.assertLess(abs(found[name]).max(), 1e-9 * expected.max(), name)
            self.assertEqual(run.unit, b"N, N m; of shells N/m, N m/m")

    def test_bending(self):
        """A cantilever under its weight: the face above is stretched, and Q1 = d M11 / dx."""
        error = []
        for nx, ranks in ((8, 1), (16, 2)):
            x, found, _ = self.run_strip((0, 0, -GRAVITY), nx, ranks)
            load = DENSITY * THICKNESS * GRAVITY
            self.assertLess(abs(found["Q1"] / (-load * (LENGTH - x)) - 1).max(), 1e-5, "shear force")
            moment = load * (LENGTH - x)**2 / 2
            error.append(abs(found["M11"] - moment).max() / moment.max())
            for name in ("N11", "N22", "N12", "M22", "M12", "Q2"):
                self.assertLess(abs(found[name]).max(), 1e-7 * moment.max(), name)
        self.assertLess(error[1], 2e-3, "bending moment, 16 elements")
        self.assertGreater(math.log2(error[0] / error[1]), 1.9)

    def test_triangles(self):
        """Likewise of triangles, whose bending is coarser."""
        words = sheet(16, 4, poisson=0, triangles=1)
        for ranks in (1, 2):
            run = Forces(self, [*words, "-forces", "here", *item("here", "shells", "-here_at", "1.875,0.07,0; 2.125,-0.07,0")], ranks)
            found = of_elements(run, "here")
            load = DENSITY * THICKNESS * GRAVITY
            self.assertAlmostEqual(found["M11"].mean() / (load * 2**2 / 2), 1, delta=0.03)
            self.assertAlmostEqual(found["Q1"].mean() / (-load * 2), 1, delta=0.05)

    def test_torsion(self):
        """A mass on a corner twists the strip: the cut has the moment of statics. Half of it are twisting moments, the
        other half the shears near the edges: with l = sqrt(10) / t, of the shear stiffness 5/6 G t, M12 = T / (2 b)
        (1 - cosh(l y) / cosh(l b / 2)) / (1 - tanh(l b / 2) / (l b / 2))."""
        mass, nx, ny, middle = 5000.0, 40, 16, 1.95
        half = math.sqrt(10) / THICKNESS * WIDTH / 2
        for ranks in (1, 2):
            words = [*sheet(nx, ny, poisson=0), "-it_corner_element", "point_mass", "-it_corner_mass", mass,
                     "-forces", "through,here", *item("through", "cut", "-through_level", middle, "-through_normal", "2,0,0"),
                     *item("here", "shells", "-here_at", f"{middle},0.03125,0; {middle},-0.03125,0")]
            run = Forces(self, words, ranks)
            wrench = run.total("through")[0]
            beyond = WEIGHT * (LENGTH - middle) / LENGTH * GRAVITY + mass * GRAVITY
            torque = mass * GRAVITY * WIDTH / 2
            self.assertAlmostEqual(wrench[2] / beyond, 1, delta=1e-7)
            self.assertAlmostEqual(wrench[3] / torque, 1, delta=1e-7)   # it holds up what hangs at positive y
            twist = of_elements(run, "here")["M12"].mean()
            expected = (torque / 2 / WIDTH * (1 - math.cosh(half / 16) / math.cosh(half)) / (1 - math.tanh(half) / half))
            self.assertAlmostEqual(twist / expected, 1, delta=0.01)


class Wall(unittest.TestCase):
    """An upright wall under its weight and a force in its plane, at an angle to the axes as well."""
    PUSH = 4.0

    def run_wall(self, ranks, nx=8, ny=4, turn=0.0, more=(), level=1.75):
        across = numpy.array([math.cos(turn), math.sin(turn)])
        row = [(math.cos(turn) * v, math.sin(turn) * v, level) for _, v in centres(nx, ny, level)]
        words = [*sheet(nx, ny, pull=(*(self.PUSH * across), -GRAVITY), upright=1, turn=turn),
                 "-forces", "level,cut,row,base",
                 *item("level", "storey", "-level_level", level), *item("cut", "cut", "-cut_level", level),
                 *item("row", "shells", "-row_at", "; ".join(",".join(map(str, place)) for place in row)),
                 *item("base", "reactions"), *more]
        run = Forces(self, words, ranks)
        return run, of_elements(run, "row"), across

    def test_cut_is_the_storey(self):
        """All that passes a level of a wall alone is in its cut: weight, shear and moment of what is above, whose lumped
        nodes count from half an element on."""
        for ranks in (1, 2, 3):
            run, found, _ = self.run_wall(ranks)
            cut, storey = run.total("cut")[0], run.total("level")[0]
            scale = abs(storey).max()
            self.assertLess(abs(cut - storey).max() / scale, 1e-10, "cut and storey")
            above = WEIGHT * (LENGTH - 1.75) / LENGTH
            for d, acceleration in ((0, -self.PUSH), (2, GRAVITY)):
                self.assertAlmostEqual(cut[d] / (above * acceleration), 1, delta=1e-10)
            rows = numpy.arange(2.0, 4.1, 0.5)      # of nodes, the uppermost of half the weight
            moment = (WEIGHT / 8 * numpy.array([1, 1, 1, 1, 0.5]) * (rows - 1.75)).sum() * self.PUSH
            self.assertLess(abs(cut[4] / -moment - 1), 1e-10, "moment of a cut")
            self.assertLess(abs(cut[0] / (-above * self.PUSH) - 1), 1e-10, "shear of a cut")

    def sums(self, run, found, width, ny):
        part = width / ny
        return part * found["N12"].sum(), part * found["N22"].sum()

    def test_row_adds_up_to_the_storey(self):
        """The means of the elements of a row: N22 adds up to the weight above the row, N12 to the storey shear less what
        the drilling rotations carry, which the mesh takes away. Turned, upside down or not, signs stay."""
        for ranks, turn in ((1, 0.0), (2, 0.7)):
            error = []
            for nx, ny in ((8, 4), (16, 8)):
                level = LENGTH * (nx // 2 - 0.5) / nx
                run, found, across = self.run_wall(ranks, nx, ny, turn, level=level)
                above = WEIGHT * (LENGTH - level) / LENGTH
                shear, weight = self.sums(run, found, WIDTH, ny)
                self.assertAlmostEqual(weight / (-above * GRAVITY), 1, delta=1e-8)
                error.append(abs(shear / (above * self.PUSH) - 1))
                for name in ("M11", "M22", "M12", "Q1", "Q2"):
                    self.assertLess(abs(found[name]).max(), 1e-6 * above * GRAVITY, name)
            self.assertLess(error[0], 5e-3, "storey shear of 8 x 4")
            self.assertLess(error[1], 0.5 * error[0])

    def test_peaks_of_all_elements(self):
        """Without points every element has its peaks and none a history; the largest is at the base."""
        for ranks in (1, 2):
            run = Forces(self, [*sheet(upright=1), "-forces", "all", *item("all", "shells")], ranks)
            self.assertEqual(run.force, {})
            elements = {element for name, _, element in run.peaks if name == "all"}
            self.assertEqual(len(elements), 32)
            said = run.summary["forces"]["all"]["N22"]
            self.assertEqual(said["peak"], min(peak for (_, part, _), (peak, _) in run.peaks.items() if part == "N22"))

    def test_what_cannot_be_meant(self):
        base = [*sheet(upright=1), "-forces", "row,cut", *item("row", "shells"), *item("cut", "cut", "-cut_level", 1)]
        for more, said in ((["-row_kind", "members"], "its elements are neither beams nor bars nor springs"),
                           (["-row_level", 1], "only with -row_kind storey or cut"),
                           (["-row_normal", "1,0,0"], "only with -row_kind cut"),
                           (["-cut_at", "0,0,1"], "only with -cut_kind members or shells"),
                           (["-cut_normal", "0,0,0"], "no direction"),
                           (["-cut_level", 4], "reaches from 0 to 4 m"),
                           (["-cut_level", "nan"], "cut_level"),
                           (["-row_at", "0,0.4,1"], "m away from the middle of the nearest element"),
                           (["-cut_group", "corner", "-it_corner_element", "point_mass", "-it_corner_mass", 1],
                            "pass no force")):
            program.must_refuse(self, [*base, *more], said, ranks=2)
        program.must_refuse(self, [*base, "-cut_level", 4], "reaches from 0 to 4 m", ranks=1)


class Shaken(unittest.TestCase):
    """The wall shaken in its plane and across it."""
    STEP = 4e-6

    @classmethod
    def setUpClass(cls):
        cls.records = [write_sine(amplitude, frequency, 0.06) for amplitude, frequency in ((4.0, 40.0), (2.0, 25.0))]

    def words(self, *more, interval=STEP, end=4e-3):
        words = [*sheet(6, 3, pull=(0, 0, 0), upright=1), "-preload", "none", "-time_step", self.STEP,
                 "-output_interval", interval, "-end_time", end, "-it_sheet_rotary_inertia_factor", 0.125,
                 "-forces", "cut,level,here", *item("cut", "cut", "-cut_level", 1.9, "-cut_about", "0.1,0.2,0.3"),
                 *item("level", "storey", "-level_level", 1.9, "-level_about", "0.1,0.2,0.3"),
                 *item("here", "shells", "-here_at", "0.3,0,0.3; -0.3,0,2.3")]
        for axis, record in zip("xy", self.records):
            words += [f"-motion_{axis}_record", record, f"-motion_{axis}_unit", "m/s2"]
        return [*words, *more]

    def test_cut_is_the_sum_of_mass_times_acceleration(self):
        for ranks in (1, 2):
            run = Forces(self, [*self.words(), "-probes", "all", *all_nodes("all", "it", "sheet")], ranks)
            place = numpy.array([probe["position"] for probe in run.summary["probes"].values()])
            mass = WEIGHT * lumped_fractions(place)
            mass[place[:, 2] <= 1.9] = 0
            acceleration = run.data["acceleration"].reshape(-1, len(place), 3)
            expected = numpy.einsum("n,tnd->td", mass, acceleration)
            cut = run.total("cut")
            scale = abs(expected).max()
            self.assertGreater(scale, 0.02 * mass.sum())
            self.assertLess(abs(cut[1:, :3] - expected[1:]).max() / scale, 1e-9, "sum of m a")
            self.assertLess(abs(cut - run.total("level")).max() / abs(cut).max(), 1e-9, "the storey without damping")

    def test_ranks_agree_and_a_continued_run_is_the_uninterrupted_one(self):
        words = self.words("-it_damping_beta", 1e-6, interval=4e-5)
        one, *others = [Forces(self, words, ranks) for ranks in (1, 2, 3)]
        scale = {name.split(".")[0]: max(abs(history).max() for key, history in one.force.items()
                                         if key.split(".")[0] == name.split(".")[0]) for name in one.force}
        self.assertEqual(len(one.force), 6 + 6 + 16)
        for other in others:
            for name, history in one.force.items():
                self.assertLess(abs(other.force[name] - history).max() / scale[name.split(".")[0]], 1e-11, name)
        assert_continues(self, words, 2.004e-3, 50)

    def test_all_modes_have_the_same_forces(self):
        full = Forces(self, self.words(interval=4e-5), 1)
        for ranks in (1, 2):
            run = Forces(self, self.words("-it_model", "modal", "-it_modal_vectors", 1000, interval=4e-5), ranks)
            for name in ("cut", "level", "here"):
                keys = [key for key in full.force if key.startswith(name + ".")]
                scale = max(abs(full.force[key]).max() for key in keys)
                worst = max(abs(run.force[key] - full.force[key]).max() for key in keys) / scale
                self.assertLess(worst, 1e-6, f"{name} in all modes")


if __name__ == "__main__":
    unittest.main()
