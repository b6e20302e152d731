"""Gaps from an overlap to a thousand kilometres, contacts twice over, ties on the step.

The law is one of velocities: it takes away what closes and pushes nothing out. Two free masses of 1 kg
that overlap by 1 mm and close at 0.1 m/s go on together at 0.05 m/s, still 1 mm inside each other.
"""
import os
import tempfile
import unittest

import numpy

from history import History, scenes
from houses import Pair, Run
from small_meshes import brick
from decks import box_of, clock, contacts

SOFT = 1e-30
GRAVITY, YOUNG, DENSITY = 9.81, 30e9, 2400.0


class Wide(unittest.TestCase):
    def test_too_wide_a_gap_changes_no_bit(self):
        # On one rank: on several the contact has its say in who owns what.
        far, alone = Run(self, Pair(gap=1e6)), Run(self, Pair(contacts=False))
        self.assertEqual(far.summary["impacts"]["episodes"], 0)
        for name in ("time", "displacement", "velocity", "acceleration", "ground_acceleration"):
            self.assertTrue(numpy.array_equal(far.data[name], alone.data[name]), name)
        self.assertGreater(abs(far.data["velocity"]).max(), 0)
        spread = Run(self, Pair(gap=1e6), ranks=2)
        for name, values in alone.vectors.items():
            self.assertLess(abs(spread.vectors[name] - values).max(), 1e-11 * abs(values).max())


class Interval(unittest.TestCase):
    def test_gaps_looked_at_more_rarely_change_no_bit(self):
        for ranks in (1, 2):
            often, rarely = (Run(self, Pair(), ranks, more=["-gap_interval", interval]) for interval in (0, 4e-3))
            self.assertGreater(often.summary["impacts"]["episodes"], 0)
            self.assertEqual(rarely.summary["impacts"], often.summary["impacts"])
            self.assertLess(rarely.summary["interface_looks"], often.summary["interface_looks"])
            for name in ("displacement", "velocity", "acceleration", "contact_force"):
                self.assertTrue(numpy.array_equal(rarely.data[name], often.data[name]), name)
            known = numpy.isfinite(rarely.data["gap"][:, 0])
            self.assertTrue(known[0])
            self.assertTrue((~known).any())
            self.assertTrue(known[often.data["contact_force"][:, 0] > 0].all())
            self.assertTrue(numpy.array_equal(rarely.data["gap"][known], often.data["gap"][known]))
            self.assertTrue(numpy.isfinite(often.data["gap"]).all())


class FarFromItsPlace(unittest.TestCase):
    def test_slow_body_is_not_missed_where_its_energy_is_round_off(self):
        """100 km from its mesh the parts of u^T K u cancel to some joules of either sign, a hundred times
        what the block has at 1 cm/s. No step may carry it further into the wall than one step's way."""
        speed, time_step = 0.01, 1e-6
        run = History(self, ["-structures", "one", *box_of("one", "x0=100000", "c", "hex8_full"),
                             *scenes.material("c", YOUNG, 0.2, DENSITY), "-stiffness", "assembled",
                             "-one_initial_displacement", "-99999.9995,0,0", "-one_initial_velocity", f"{-speed},0,0",
                             *contacts(stop=("one:x_min", "wall", 100000)), *clock(time_step, 0.06, 0.01),
                             *scenes.cheap("one:x_min")], 1)
        self.assertEqual(run.summary["impacts"]["episodes"], 1)
        self.assertLess(run.summary["impacts"]["max_penetration"], 1.05 * speed * time_step)


class TouchingAtTheStart(unittest.TestCase):
    def test_the_ledger_knows_what_the_first_impulse_took(self):
        """Faces of 1 kg each, one at 2 m/s, in contact from the first: of 4 J of the cubes 1 J is lost."""
        run = History(self, scenes.blocks((2.0, 2.0), speed=2.0, gap=0.0, young=SOFT, end_time=0.005))
        energy = run.summary["energy"]
        self.assertAlmostEqual(run.summary["impacts"]["energy_lost"], 1, delta=1e-12)
        self.assertAlmostEqual(energy["contact"], -1, delta=1e-12)
        self.assertAlmostEqual(energy["kinetic"], 3, delta=1e-12)
        self.assertLess(energy["relative_residual"], 1e-14)


class Overlap(unittest.TestCase):
    def masses(self, speed):
        return History(self, scenes.blocks((2.0, 2.0), speed=speed, gap=-1e-3, young=SOFT, end_time=0.005), 2)

    def test_closing_masses_stay_where_they_are_in_each_other(self):
        run = self.masses(0.1)
        one, two = (run.channel("velocity", f"probe{i}.x") for i in (0, 1))
        self.assertLess(abs(one - 0.05).max(), 1e-16)
        self.assertLess(abs(two - 0.05).max(), 1e-16)
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 0.05, delta=1e-16)
        self.assertLess(abs(run.data["gap"] + 1e-3).max(), 1e-17)
        self.assertEqual(run.summary["impacts"]["max_penetration"], 1e-3)
        # No energy comes out of the overlap.
        self.assertAlmostEqual(run.energy["kinetic"], 2 * 0.05**2 / 2 + 0.1**2 / 2, delta=1e-15)

    def test_separating_masses_fly_freely(self):
        run = self.masses(-0.1)
        self.assertTrue((run.channel("velocity", "probe0.x") == -0.1).all())
        self.assertTrue((run.channel("velocity", "probe1.x") == 0).all())
        self.assertEqual(run.summary["impacts"]["episodes"], 0)
        self.assertTrue((run.data["contact_force"] == 0).all())

    def test_buildings_that_overlap_are_not_thrown_apart(self):
        run = Run(self, Pair(gap=-1e-3), ranks=2)
        self.assertGreater(run.summary["impacts"]["episodes"], 0)
        self.assertLessEqual(run.summary["energy"]["contact"], 1e-12 * run.summary["energy"]["kinetic"])
        closing = abs(run.vectors["velocity"]).max() * 1.6e-5
        self.assertGreaterEqual(run.gap.min(), -1e-3 - 2 * closing)


class ContactsTwiceOver(unittest.TestCase):
    """The same rows again, or from both sides: H is singular, velocities are not."""

    def test_redundant_rows_change_neither_velocities_nor_impulse(self):
        words = scenes.blocks((2.0, 3.0), young=1e7, time_step=3e-4, end_time=0.03)
        single = History(self, words)
        again = list(words)
        again[again.index("-contacts") + 1] = "joint,twin,turned"
        for name, secondary, primary in (("twin", "one:x_max", "two:x_min"), ("turned", "two:x_min", "one:x_max")):
            again += [f"-{name}_secondary", secondary, f"-{name}_primary", primary, f"-{name}_gap", 0.001]
        for redundant in (again, [*words, "-joint_passes", 2]):
            run = History(self, redundant, 2)
            self.assertLess(abs(run.data["velocity"] - single.data["velocity"]).max(), 1e-12)
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"],
                                   single.summary["impacts"]["total_impulse"], delta=1e-12)
            self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-12)
            self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_residual_is_the_largest_of_the_run(self):
        # Of longer and longer pieces of one run: it cannot become smaller.
        residuals = []
        for steps in range(20, 120, 12):
            words = scenes.blocks((2.0, 3.0), young=1e6, time_step=1e-4, end_time=steps * 1e-4)
            words[words.index("-one_mesh_set") + 1] = "x0=-1,ny=2,nz=2"
            residuals.append(History(self, words).summary["impacts"]["complementarity_residual"])
        self.assertGreater(residuals[-1], 0)
        self.assertEqual(residuals, sorted(residuals))

    def test_three_nodes_on_an_edge_of_two(self):
        # 3 x 3 nodes of the secondary face on 2 x 2 of the primary: nine rows, at most four motions.
        for passes in (1, 2):
            words = scenes.blocks((2.0, 3.0), young=1e6, time_step=1e-4, end_time=0.02)
            words[words.index("-one_mesh_set") + 1] = "x0=-1,ny=2,nz=2"
            run = History(self, [*words, "-joint_passes", passes], 2)
            self.assertTrue(numpy.isfinite(run.data["velocity"]).all())
            self.assertLess(run.summary["impacts"]["complementarity_residual"], 1e-12)
            self.assertLess(run.energy["relative_residual"], 1e-12)
            self.assertLess(run.summary["impacts"]["max_penetration"], 1.01e-4)  # 1 m/s, one step
            closed = run.data["contact_force"][:-1, 0] > 0
            self.assertTrue(closed.any())
            # While they touch, the smallest gap does not shrink any more.
            self.assertGreaterEqual(numpy.diff(run.data["gap"][:, 0])[closed].min(), -1e-12)


class AllAtOnce(unittest.TestCase):
    def test_every_node_of_two_faces_closes_in_one_step(self):
        # 81 pairs, each a plastic impact of its own, in whatever order they are listed.
        masses = (2.0, 3.0)
        for seed in (None, 1, 2):
            with tempfile.TemporaryDirectory() as folder:
                words = scenes.blocks([2 * mass for mass in masses], young=SOFT)
                for name, start in (("one", -1), ("two", 0)):
                    mesh = brick((start, 0, 0), (start + 1, 1, 1), (1, 8, 8))
                    words[words.index(f"-{name}_mesh") + 1] = mesh.write(os.path.join(folder, f"{name}.msh"), seed)
                    words[words.index(f"-{name}_mesh_set") + 1] = "none"
                run = History(self, words, 2)
            self.assertEqual(run.impacts["points"], ["81"])
            self.assertLess(run.column("duration")[0], 2.5e-4)  # one step, and perhaps round-off in the next
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], masses[0] * masses[1] / sum(masses),
                                   delta=1e-14)
            for i in (0, 1):
                self.assertAlmostEqual(run.channel("velocity", f"probe{i}.x")[-1], masses[0] / sum(masses), delta=1e-15)


class Ties(unittest.TestCase):
    def bar(self, height):
        dt = 10 / 100 / 30
        return History(self, ["-structures", "bar", *box_of("bar", "lz=10,nz=100", "soft", "hex8_full"),
                              *scenes.material("soft", 900.0, 0, 1.0),
                              *contacts(stop=("bar:z_min", "wall", repr(height))), "-allow_unstable", "true",
                              "-time_step", repr(dt), "-end_time", 1.9, "-bar_initial_velocity", "0,0,-10",
                              *scenes.cheap("bar:z_max")], 2)

    def test_impact_exactly_on_a_step(self):
        # At Courant number one the bar is exact; the first contact may be seen a step later.
        tie, generic = self.bar(5.0), self.bar(5.00137)
        dt = tie.summary["time_step"]
        for run in (tie, generic):
            self.assertAlmostEqual(run.column("start")[0], 0.5, delta=1.01 * dt)
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 10 * (20 - 0.05), delta=1e-9)
            self.assertAlmostEqual(run.summary["impacts"]["energy_lost"], 2.5, delta=1e-11)
            self.assertAlmostEqual(run.column("peak_force")[0], 300, delta=1e-8)
            self.assertAlmostEqual(run.column("duration")[0], 2 / 3, delta=1.01 * dt)
            self.assertEqual(run.summary["impacts"]["episodes"], 1)


class Rest(unittest.TestCase):
    def column(self, tolerance):
        alpha = numpy.pi * numpy.sqrt(YOUNG / DENSITY) / 1.2  # critical at the first frequency
        return History(self, ["-structures", "body",
                              *box_of("body", "lx=0.4,ly=0.4,lz=1.2,nx=2,ny=2,nz=6", "concrete", "hex8_full"),
                              *scenes.material("concrete", YOUNG, 0, DENSITY), "-body_gravity", f"0,0,{-GRAVITY}",
                              "-body_damping_alpha", repr(float(alpha)), *contacts(stop=("body:z_min", "wall", 0)),
                              "-gap_tolerance", tolerance, "-time_step", 4.5e-5, "-end_time", 0.02,
                              *scenes.cheap("body:z_min")])

    def test_tolerance_of_the_gap_keeps_nodes_on_the_ground(self):
        settled = DENSITY * GRAVITY * 1.2**2 / (2 * YOUNG)
        for tolerance in (1e-15, 1e-12, 1e-9):
            self.assertLess(abs(self.column(tolerance).channel("displacement", "probe0.z")).max(), 1e-12 * settled)
        # A literal gap <= 0 lets go of nodes that round-off lifted by 1e-23 m.
        self.assertGreater(abs(self.column(0).channel("displacement", "probe0.z")).max(), 1e-2 * settled)


if __name__ == "__main__":
    unittest.main()
