"""Starts that differ from node to node: by group, and by a table of nodes.

Closed form: a free bar that turns about its middle goes on as it began, u = t v, since nothing strains. Steps written
down here: a row of bricks, pulled out and let go, is a chain of masses and springs.
"""
import os
import tempfile
import unittest

import numpy

import program
from decks import box_of, clock, in_modes, material, probes
from recorded import Recorded, assert_follows, ensemble_of

YOUNG, DENSITY, AREA, LENGTH, CELLS, STEP = 2e9, 2500.0, 0.25, 2.0, 8, 2e-5


def bar(*more):
    return ["-structures", "bar", *box_of("bar", f"lx={LENGTH},ly=0.5,lz=0.5,nx={CELLS}", "stuff"),
            *material("stuff", YOUNG, 0, DENSITY), *clock(STEP, 200 * STEP), *probes(end="bar:x_max"), *more]


def places():
    return [(i * LENGTH / CELLS, y, z) for i in range(CELLS + 1) for y in (0, 0.5) for z in (0, 0.5)]


class Table:
    """A table of nodes in a file."""

    def __init__(self, test, names, rows):
        self.file = tempfile.NamedTemporaryFile("w", suffix=".csv")
        test.addCleanup(self.file.close)
        self.file.write("# a start\n" + names + "\n")
        self.file.writelines(",".join(repr(value) for value in row) + "\n" for row in rows)
        self.file.flush()
        self.words = ["-bar_initial_state", self.file.name]


class Starts(unittest.TestCase):
    def stretched(self):
        """Pulled out by a part of 1e-3 of its length along x."""
        return Table(self, "x,y,z,ux", [(*x, 1e-3 * x[0]) for x in places() if x[0] > 0]).words

    def test_a_group_starts_as_the_structure_would(self):
        whole = Recorded(self, bar("-bar_clamp", "x_min", "-bar_initial_velocity", "1,0.3,0"))
        group = Recorded(self, bar("-bar_clamp", "x_min", "-bar_body_initial_velocity", "1,0.3,0"))
        for axis in "xyz":
            numpy.testing.assert_array_equal(whole.displacement(f"end.{axis}"), group.displacement(f"end.{axis}"))

    def test_a_free_bar_turns_on(self):
        turn, middle = 0.7, (LENGTH / 2, 0.25)
        rows = [(*x, -turn * (x[1] - middle[1]), turn * (x[0] - middle[0])) for x in places()]
        table = Table(self, "x,y,z,vx,vy", rows)
        for ranks in (1, 2, 3):
            run = Recorded(self, bar(*table.words, "-bar_allow_loose", "true"), ranks)
            self.assertLess(abs(run.displacement("end.y") - turn * LENGTH / 2 * run.time).max(), 1e-14)
            self.assertLess(abs(run.displacement("end.x")).max(), 1e-14)

    def test_a_stretched_bar_is_a_chain(self):
        stiffness, mass = YOUNG * AREA * CELLS / LENGTH, DENSITY * AREA * LENGTH / CELLS
        masses = numpy.full(CELLS, mass)
        masses[-1] /= 2
        u, v, expected = 1e-3 * LENGTH * numpy.arange(1, CELLS + 1) / CELLS, numpy.zeros(CELLS), []
        for n in range(201):
            expected.append(u[-1])
            pull = stiffness * numpy.diff(u, prepend=0)
            force = numpy.append(pull[1:], 0) - pull
            v = v + (STEP / 2 if n == 0 else STEP) * force / masses
            u = u + STEP * v
        words = bar("-bar_clamp", "x_min", *self.stretched())
        assert_follows(self, Recorded(self, words).displacement("end.x"), numpy.array(expected), 1e-10, "chain")
        modal = [*in_modes("bar", 200)]
        assert_follows(self, Recorded(self, [*words, *modal]).displacement("end.x"), numpy.array(expected), 1e-9, "modes")

    def test_a_stored_basis_has_it(self):
        folder = tempfile.mkdtemp()
        words = bar("-bar_clamp", "x_min", *in_modes("bar", 12), "-bar_modal_basis", os.path.join(folder, "bar.h5"))
        first = Recorded(self, [*words, *self.stretched()])
        again = Recorded(self, [*words, *self.stretched()])
        self.assertGreater(abs(first.displacement("end.x")).max(), 1.5e-3)
        numpy.testing.assert_array_equal(first.displacement("end.x"), again.displacement("end.x"))
        other = Recorded(self, [*words, "-bar_body_initial_velocity", "0,1,0"])
        self.assertLess(abs(other.displacement("end.x")).max(), 1e-6)

    def test_members_of_an_ensemble(self):
        words = [*bar("-bar_clamp", "x_min", *in_modes("bar", 12)), *self.stretched(),
                 "-modes", 0, "-spectra_frequencies", "50,200"]
        peaks, _ = ensemble_of(self, words, "bar_stiffness_factor", (1, 1.3))
        for member, factor in enumerate((1, 1.3)):
            single = Recorded(self, [*words, "-bar_stiffness_factor", factor])
            self.assertAlmostEqual(peaks[member][0] / abs(single.displacement("end.x")).max(), 1, delta=1e-9)

    def test_a_static_start_takes_velocities(self):
        run = Recorded(self, bar("-bar_clamp", "x_min", "-gravity", 9.81, "-preload", "static",
                                 "-bar_body_initial_velocity", "1,0,0"))
        self.assertGreater(abs(run.displacement("end.x")).max(), 1e-4)


class Refused(unittest.TestCase):
    def refuse(self, names, rows, *parts, more=("-bar_clamp", "x_min")):
        program.must_refuse(self, bar(*Table(self, names, rows).words, *more), "initial_state", *parts)

    def test_tables(self):
        end = (LENGTH, 0, 0)
        self.refuse("x,y,z", [], "no node in it")
        self.refuse("a,y,z,ux", [(*end, 1)], "'a'", "line 2")
        self.refuse("x,y,ux", [(0, 0, 1)], "give node or x,y,z")
        self.refuse("x,y,z,ux", [(9, 0, 0, 1)], "no element in use has a node at (9, 0, 0)", "line 3")
        self.refuse("node,ux", [(0.5, 1)], "no element in use has a node of that number")
        self.refuse("x,y,z,ux", [(0, 0, 0, 1)], "clamped")
        self.refuse("x,y,z,rx", [(*end, 1)], "does not turn")
        self.refuse("x,y,z,ux", [end], "3 values for 4 columns")
        self.refuse("x,y,z,ux", [(*end, "one")], "is no number")
        program.must_refuse(self, bar("-bar_clamp", "x_min", "-bar_initial_state", "/nowhere.csv"), "/nowhere.csv")

    def test_with_others(self):
        self.refuse("x,y,z,ux", [(LENGTH, 0, 0, 1e-3)], "no displacements",
                    more=("-bar_clamp", "x_min", "-gravity", 9.81, "-preload", "static"))
        self.refuse("x,y,z,vx", [(LENGTH, 0, 0, 1e-3)], "rigid group",
                    more=("-bar_clamp", "x_min", "-bar_rigid", "x_max"))
        program.must_refuse(self, bar("-bar_clamp", "x_min", "-gravity", 9.81, "-preload", "static",
                                      "-bar_body_initial_displacement", "1,0,0"),
                            "-bar_body_initial_displacement", "static equilibrium")


if __name__ == "__main__":
    unittest.main()
