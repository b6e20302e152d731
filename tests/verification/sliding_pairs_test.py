"""Faces that slide along each other over many facets: pairs are found anew.

A block slides on a long deck. References: the load that crosses a simply supported beam (L. Fryba, Vibration of
Solids and Structures under Moving Loads (1972), chapter 1, by its modes); Coulomb's v0^2 / (2 mu g) on a fixed deck;
free fall beyond its end; the same deck with other facets; weight on a block that slides onto it.
"""
import math
import unittest

import numpy

from decks import box_of, clock, contacts, in_modes, material
from program import must_refuse
from recorded import IDENTITY_OF_A_FLIGHT, Recorded, assert_continues

GRAVITY = 9.81
LONG = 1e-11  # energy identity of runs of many steps
YOUNG, DENSITY = 30e9, 2400.0
LENGTH, WIDTH, HEIGHT, BLOCK = 4.0, 0.4, 0.2, 0.2
MASS = DENSITY * BLOCK**3
FIXED = ["-deck_clamp", "z_min"]


def scene(start, speed, end_time, *more, sliding=4.5, cells=20, across=1):
    """A block whose hind end is at x = start, on a deck from x = 0 to 4 m."""
    words = ["-structures", "deck,block", *contacts(joint=("block:z_min", "deck:z_max", 0)),
             *box_of("deck", f"x0=0,y0={-WIDTH / 2},z0={-HEIGHT},lx={LENGTH},ly={WIDTH},lz={HEIGHT},nx={cells},ny={across}", "concrete"),
             *box_of("block", f"x0={start},y0={-BLOCK / 2},z0=0,lx={BLOCK},ly={BLOCK},lz={BLOCK}", "concrete"),
             *material("concrete", YOUNG, 0.0, DENSITY), "-deck_gravity", "0,0,0", "-block_gravity", f"0,0,{-GRAVITY}",
             "-block_initial_velocity", f"{speed},0,0", *clock(1.5e-5, end_time, 1e-3), "-energy_interval", 100,
             "-impact_merge_time", 1e-3, "-probes", "middle,load", "-middle_structure", "deck",
             "-middle_at", f"{LENGTH / 2},{-WIDTH / 2},{-HEIGHT}", "-load_structure", "block", "-load_group", "body",
             *more]
    return words + (["-joint_sliding", sliding] if sliding else [])


def crossed_beam(time, start, speed, alpha):
    """Deflection at the middle of a simply supported beam under a force that crosses it, by its modes."""
    weight, line = MASS * GRAVITY, DENSITY * WIDTH * HEIGHT
    stiffness = YOUNG * WIDTH * HEIGHT**3 / 12
    n = numpy.arange(1, 12)
    squared = stiffness / line * (n * math.pi / LENGTH)**4
    q, rate, dt = numpy.zeros(len(n)), numpy.zeros(len(n)), 2e-6 * 5
    out, next_sample = [], 0
    for step in range(round(time[-1] / dt) + 1):
        if step * dt >= time[next_sample] - dt / 2:
            out.append(-(q * numpy.sin(n * math.pi / 2)).sum())
            next_sample = min(next_sample + 1, len(time) - 1)
        force = 2 * weight / (line * LENGTH) * numpy.sin(n * math.pi * (start + speed * step * dt) / LENGTH)
        rate += dt * (force - alpha * rate - squared * q)
        q += dt * rate
    return numpy.array(out[:len(time)])


class MovingLoad(unittest.TestCase):
    SPEED, START, ALPHA = 4.0, 0.05, 12.0

    def run_(self, sliding):
        return Recorded(self, scene(self.START, self.SPEED, 0.9, "-deck_clamp", "corners:z", "-deck_damping_alpha",
                                    self.ALPHA, sliding=sliding), identity=LONG)

    def test_deflection_is_that_under_a_load_that_crosses(self):
        run = self.run_(4.5)
        found = run.displacement("middle.z")
        expected = crossed_beam(run.time, self.START + BLOCK / 2, self.SPEED, self.ALPHA)
        largest = abs(expected).max()
        self.assertAlmostEqual(largest / (MASS * GRAVITY * LENGTH**3 / (4 * YOUNG * WIDTH * HEIGHT**3)), 1, delta=0.1)
        self.assertLess(abs(found - expected).max() / largest, 0.04)
        self.assertFalse(any("slid" in text for text in run.summary["warnings"]))
        stays = self.run_(0)  # the load stays with the facets that it began on
        self.assertLess(abs(stays.displacement("middle.z")).max() / largest, 0.5)
        self.assertTrue(any("-joint_sliding" in text for text in stays.summary["warnings"]))


class OnAFixedDeck(unittest.TestCase):
    def test_coulomb_stops_it_where_it_should(self):
        speed, friction = 1.5, 0.3
        distance = speed**2 / (2 * friction * GRAVITY)
        runs = [Recorded(self, scene(0.3, speed, 0.56, "-joint_friction", friction, *FIXED, cells=cells), ranks, LONG)
                for cells, ranks in ((20, 1), (20, 3), (32, 1))]
        for run in runs:
            x = run.displacement("load.x")
            self.assertAlmostEqual(x[-1] / distance, 1, delta=2e-3)
            self.assertLess(abs(run.velocity("load.x")[-1]), 2e-2)  # it trembles to a halt, with or without new pairs
            self.assertAlmostEqual(run.energy["friction"] / (MASS * speed**2 / 2), 1, delta=2e-3)
            self.assertLess(run.summary["impacts"]["max_penetration"], 1e-6)
        self.assertLess(abs(runs[1].displacement("load.x") - runs[0].displacement("load.x")).max(), 1e-9)
        self.assertLess(abs(runs[2].displacement("load.x")[-1] - runs[0].displacement("load.x")[-1]), 1e-3 * distance)

    def test_it_falls_beyond_the_end(self):
        speed, start = 5.0, 3.5
        leaves = (LENGTH - start + 0.1 * math.sqrt(WIDTH * LENGTH / 20)) / speed  # a tenth of a facet late
        soft = ["-material_concrete_young", YOUNG / 10]  # less round-off of K u in a flight of .75 m
        run = Recorded(self, scene(start, speed, 0.15, *FIXED, *soft), identity=IDENTITY_OF_A_FLIGHT)
        falling = run.time > leaves + 1e-3
        slope = numpy.polyfit(run.time[falling], run.velocity("load.z")[falling], 1)[0]
        self.assertAlmostEqual(slope / -GRAVITY, 1, delta=1e-6)
        self.assertLess(max(run.column("end")), leaves + 1e-3)
        stays = Recorded(self, scene(start, speed, 0.15, *FIXED, *soft, sliding=0), identity=LONG)
        self.assertGreater(max(stays.column("end")), 0.14)

    def test_long_steps_look_as_often(self):
        """16 steps are 16 ms here: the hind end, beyond the deck at 0.1 s, would be held until 0.112 s."""
        speed, start, step = 5.0, 3.5, 1e-3
        beyond = (LENGTH - start) / speed
        run = Recorded(self, scene(start, speed, 0.15, *FIXED, "-material_concrete_young", 1e7, "-time_step", step),
                       identity=IDENTITY_OF_A_FLIGHT)
        last = max(run.column("end"))
        self.assertGreater(last, beyond)
        self.assertLess(last, beyond + 0.1 * math.sqrt(WIDTH * LENGTH / 20) / speed + 2 * step)

    def test_it_comes_onto_the_deck(self):
        run = Recorded(self, scene(-0.1, 5.0, 0.1, *FIXED, "-joint_passes", 2, across=4), identity=LONG)
        settled = run.time > 0.05
        self.assertLess(abs(run.displacement("load.z")[settled]).max(), 1e-6)
        self.assertLess(abs(run.velocity("load.z")[-1]), 1e-3)
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / (MASS * GRAVITY * 0.1), 1, delta=1e-2)
        self.assertLess(run.summary["impacts"]["max_penetration"], 1e-6)

    def test_reduced_is_the_same(self):
        words = scene(0.3, 1.5, 0.1, "-joint_friction", 0.3, *FIXED)
        full = Recorded(self, words, identity=LONG)
        reduced = Recorded(self, [*words, *in_modes("block", 24)], identity=LONG)
        for channel in ("load.x", "load.z"):
            self.assertLess(abs(reduced.displacement(channel) - full.displacement(channel)).max(), 1e-9, channel)

    def test_it_changes_no_bit_where_little_slides(self):
        runs = [Recorded(self, scene(0.3, 0.3, 0.05, "-joint_friction", 0.3, *FIXED, sliding=sliding), identity=LONG)
                for sliding in (0, 1.0)]
        for channel in ("load.x", "load.z"):
            self.assertTrue(numpy.array_equal(*(run.displacement(channel) for run in runs)), channel)
        self.assertEqual(*(run.column("impulse") for run in runs))

    def test_a_continued_run_is_the_uninterrupted_one(self):
        words = scene(0.3, 1.5, 0.12, "-joint_friction", 0.3, *FIXED, "-modes", 0)
        assert_continues(self, words, 0.07, 4000)

    def test_what_slides_farther_is_told(self):
        run = Recorded(self, scene(0.3, 1.5, 0.2, *FIXED, sliding=0.1), identity=LONG)
        text, = (text for text in run.summary["warnings"] if "slid" in text)
        self.assertIn("more than -joint_sliding 0.1 m, from t = 0.067", text)


class Refused(unittest.TestCase):
    def test_where_pairs_cannot_be_found_anew(self):
        words = scene(0.3, 1.5, 0.1, *FIXED)
        must_refuse(self, [*words, "-joint_primary", "wall"], "-joint_sliding")
        must_refuse(self, [*words, "-joint_filler", "0.5:1e5", "-joint_filler_unloading", 1e6, "-joint_gap", 0.01],
                    "joint has a filler")
        must_refuse(self, [*words, "-joint_sliding", -1], "-joint_sliding")


# Faces touch all the way: their gaps are round-off of the nodes beside them.
ON_RANKS = {"a block that slides over facets": (scene(0.3, 1.5, 0.08, "-joint_friction", 0.3, *FIXED), {"tolerance": 1e-6})}


if __name__ == "__main__":
    unittest.main()
