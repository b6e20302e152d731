"""Faces that are crushed where they strike: a strip that is elastic, keeps its strength, and is hard at its end.

References: the motion of one mass in closed form, with the numbers of SDND105A of Code_Aster's manual of verification (mass,
speed, stiffness, strength) without the fall of its force; piece by piece with several strikes, and with a strip that is
crushed to the last, after which contact is hard; two blocks by their reduced mass; and the program itself on other ranks, in
modes, in an ensemble and continued.
"""
import math
import unittest

import numpy

import program
from filler_test import Exact, block, common
from recorded import Recorded, assert_continues, ensemble_of

MASS, GAP, PUSH = 1000.0, 0.01, 2.0  # kg, m, m/s2
STRENGTH, STIFFNESS, DEPTH = 2e5, 1e8, 0.05  # Pa, N/m3, m
STEP = 1e-4


def crushing(strength=STRENGTH, stiffness=STIFFNESS, depth=DEPTH):
    return ["-contacts", "joint", "-joint_crushing", strength, "-joint_crushing_stiffness", stiffness,
            "-joint_crushing_depth", depth]


def thrown(speed, end, *more, step=STEP, gap=GAP, push=PUSH, strip=None):
    """A rigid block of 1 m2 against a wall."""
    return ["-structures", "block", *block("block", 0), *common(end, step), "-block_initial_velocity", f"{speed},0,0",
            "-block_gravity", f"{push},0,0", *(strip or crushing()), "-joint_secondary", "block:x_max", "-joint_primary", "wall",
            "-joint_gap", gap, "-probes", "one", "-one_structure", "block", "-one_at", "0,-0.5,0", *more]


def exact_of(mass, push, speed):
    """d(t) from the touch on: the strip is a filler of its own depth that is dense at its end."""
    return Exact(mass, push, speed, DEPTH, 1.0, ((STRENGTH / STIFFNESS / DEPTH, STRENGTH), (1.0, STRENGTH)), STIFFNESS * DEPTH)


def colliding(*more, cells=(1, 1), speed=1.5, end=0.05, step=STEP, young=1e3, rigid=True):
    words = ["-structures", "left,right"]
    for name, x0, count in (("left", 0, cells[0]), ("right", 1 + GAP, cells[1])):
        scene = block(name, x0, cells=count)
        words += scene if rigid else [word for word in scene if word not in (f"-{name}_rigid", "body")]
    return [*words, *common(end, step, young), "-left_initial_velocity", f"{speed},0,0", *crushing(),
            "-joint_secondary", "left:x_max", "-joint_primary", "right:x_min", "-probes", "l,r",
            "-l_structure", "left", "-l_at", "0,-0.5,0", "-r_structure", "right", "-r_at", f"{2 + GAP},-0.5,0", *more]


class OneMass(unittest.TestCase):
    def test_with_the_numbers_of_sdnd105a(self):
        """1 kg at 2 m/s, 1 N/m up to 1 N: crushed from pi/6 on for 3^1/2 s, by 1.5 m; back at -1 m/s a quarter of a turn later."""
        touch, step = 0.5, 1e-3
        run = Recorded(self, ["-material_stone_density", 1, *thrown(2.0, 6.0, step=step, gap=2 * touch, push=0,
                                                                     strip=crushing(1, 1, 4)), "-material_stone_density", 1])
        x, v = run.displacement("one.x"), run.velocity("one.x")
        t = run.time - touch
        crushed, back = math.pi / 6, math.pi / 6 + math.sqrt(3)
        leaves = back + math.pi / 2
        for span, expected in (((0, crushed), 2 * numpy.sin(t)),
                               ((crushed, back), 1 + math.sqrt(3) * (t - crushed) - (t - crushed)**2 / 2),
                               ((back, leaves), 1.5 + numpy.cos(t - back)),
                               ((leaves, 6), 1.5 - (t - leaves))):
            inside = (t >= span[0]) & (t <= span[1])
            self.assertGreater(inside.sum(), 500)
            self.assertLess(abs(x - 2 * touch - expected)[inside].max(), 2e-6, span)
        self.assertAlmostEqual(v[-1], -1, delta=1e-6)
        found = run.summary["contacts"]["joint"]["crushing"]
        self.assertAlmostEqual(found["crushed_depth"], 1.5, delta=1e-6)
        self.assertAlmostEqual(found["peak_force"], 1, delta=1e-9)
        self.assertAlmostEqual(found["energy_lost"], 1.5, delta=2e-6)
        self.assertAlmostEqual(run.column("impulse")[0], 3, delta=1e-6)
        self.assertAlmostEqual(run.column("max_penetration")[0], 2.5, delta=1e-6)
        self.assertAlmostEqual(-run.gap("joint").min(), 2.5, delta=1e-6)

    def test_strikes_again(self):
        """What is crushed stays so: the next strike begins where the last one ended, and takes its share of the loss."""
        run = Recorded(self, thrown(1.0, 0.9))
        speed = math.sqrt(1 + 2 * PUSH * GAP)
        touch = (speed - 1) / PUSH
        exact = exact_of(MASS, PUSH, speed)
        after = run.time > touch
        d, _ = exact.run(run.time[after] - touch)
        x = run.displacement("one.x")
        first = run.time[after] < 0.05
        self.assertLess(abs(x[after] - GAP - d)[first].max(), 1e-3 * d.max())
        self.assertLess(abs(x[after] - GAP - d).max(), 1e-3 * (x.max() - x.min()))
        self.assertGreaterEqual(len(run.impacts["contact"]), 2)
        found = run.summary["contacts"]["joint"]["crushing"]
        self.assertAlmostEqual(found["crushed_depth"] / exact.crushed, 1, delta=1e-3)
        self.assertAlmostEqual(found["energy_lost"] / (STRENGTH * exact.crushed), 1, delta=1e-3)
        self.assertAlmostEqual(run.column("energy_lost").sum() / found["energy_lost"], 1, delta=1e-9)
        self.assertAlmostEqual(run.summary["impacts"]["joint"]["max_penetration"] / d.max(), 1, delta=1e-3)

    def test_crushed_to_the_last(self):
        """The rest of the speed is lost in hard contact; the elastic part of the strip throws the block back."""
        speed = 5.0
        run = Recorded(self, thrown(speed, 0.05, push=0))
        elastic = STRENGTH / STIFFNESS
        lock = math.sqrt(speed**2 - 2 * STRENGTH * (DEPTH - elastic / 2) / MASS)
        back = STRENGTH / math.sqrt(STIFFNESS * MASS)
        self.assertAlmostEqual(-run.velocity("one.x")[-1] / back, 1, delta=1e-3)
        self.assertAlmostEqual(run.column("impulse")[0] / (MASS * (speed + back)), 1, delta=1e-3)
        self.assertAlmostEqual(run.column("energy_lost")[0] / (MASS * (speed**2 - back**2) / 2), 1, delta=1e-3)
        found = run.summary["contacts"]["joint"]["crushing"]
        self.assertAlmostEqual(found["crushed_depth"] / (DEPTH - elastic), 1, delta=STEP * lock / DEPTH)
        self.assertLess(run.displacement("one.x").max(), GAP + DEPTH + 1.01 * STEP * lock)
        # The part of hard contact is apart from that of the strip.
        self.assertAlmostEqual(-run.energy["contact"] / (MASS * lock**2 / 2), 1, delta=1e-2)
        self.assertAlmostEqual(run.energy["plastic"] / found["energy_lost"], 1, delta=1e-9)

    def test_second_order(self):
        speed = math.sqrt(1 + 2 * PUSH * GAP)
        touch = (speed - 1) / PUSH
        errors = []
        for step in (4e-4, 4e-5):
            run = Recorded(self, thrown(1.0, 0.04, step=step))
            after = run.time > touch
            d, _ = exact_of(MASS, PUSH, speed).run(run.time[after] - touch)
            errors.append(abs(run.displacement("one.x")[after] - GAP - d).max())
        self.assertGreater(errors[0] / errors[1], 30, errors)  # 100 in second order, 10 in first


def elastic(*more):
    return colliding(*more, rigid=False, young=2e8, cells=(2, 3), speed=4.0, end=0.03)


class TwoBlocks(unittest.TestCase):
    def test_matched_and_not(self):
        speed = 1.5
        for cells in ((1, 1), (2, 3)):
            run = Recorded(self, colliding(cells=cells), identity=1e-11)
            exact = exact_of(MASS / 2, 0.0, speed)
            after = run.time > GAP / speed
            d, _ = exact.run(run.time[after] - GAP / speed)
            way = run.displacement("l.x") - run.displacement("r.x")
            self.assertLess(abs(way[after] - GAP - d).max(), 1e-3 * (way.max() - way.min()))
            self.assertAlmostEqual(run.summary["contacts"]["joint"]["crushing"]["crushed_depth"] / exact.crushed, 1, delta=1e-3)

    def test_elastic_blocks(self):
        """The catalogue and the summary as well are alike on ranks that share the faces."""
        one, other = (Recorded(self, elastic("-joint_passes", 2), ranks, 1e-11) for ranks in (1, 3))
        found, shared = (run.summary["contacts"]["joint"]["crushing"] for run in (one, other))
        self.assertGreater(found["crushed_depth"], 0.1 * DEPTH)
        self.assertAlmostEqual(found["area"], 1, delta=1e-12)
        self.assertGreater(one.column("energy_lost").sum(), 0.1 * MASS / 4 * 4.0**2)
        self.assertAlmostEqual(shared["energy_lost"] / found["energy_lost"], 1, delta=1e-9)

    def test_reduced_is_full(self):
        full = Recorded(self, elastic())
        modal = [word for name in ("left", "right") for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 300,
                                                                "-time_step", repr(full.time_step))]
        reduced = Recorded(self, elastic(*modal))
        for channel in ("l.x", "r.x"):
            u = full.displacement(channel)
            self.assertLess(abs(reduced.displacement(channel) - u).max(), 1e-8 * abs(u).max())

    def test_members_are_single_runs(self):
        words = colliding("-left_model", "modal", "-left_modal_vectors", 20, "-right_model", "modal", "-right_modal_vectors", 20, rigid=False,
                          young=2e8)
        values = ("0.01", "0.006", "0.002")
        peaks, residual = ensemble_of(self, [*words, "-modes", 1], "joint_gap", values)
        self.assertLess(residual.max(), 1e-11)
        for k, value in enumerate(values):
            run = Recorded(self, [*words, "-joint_gap", value])
            largest = max(abs(peaks[k]).ravel())
            self.assertAlmostEqual(max(abs(run.displacement(c)).max() for c in ("l.x", "r.x")) / largest, 1, delta=1e-9)
        self.assertGreater(abs(numpy.diff([abs(peaks[k]).max() for k in range(3)])).min(), 1e-6)

    def test_continued(self):
        assert_continues(self, elastic("-spectra_frequencies", 10), 0.015, 77, 2)

    def test_at_rest_it_is_not_pressed(self):
        """Blocks on clamped feet that lean towards each other under their weight, just closed as they are at rest."""
        words = colliding("-left_clamp", "z_min", "-right_clamp", "z_min", "-left_initial_velocity", "0,0,0", "-left_gravity",
                          "2,0,0", "-right_gravity", "-2,0,0", "-preload", "static", "-joint_gap", 0, rigid=False, young=1e6,
                          step=1e-4)
        run = Recorded(self, words)
        u = run.displacement("l.x")
        self.assertLess(abs(u - u[0]).max(), 1e-12)
        self.assertEqual(run.summary["contacts"]["joint"]["crushing"]["peak_force"], 0)
        self.assertLess(numpy.abs(run.summary["contacts"]["joint"]["initial_gap"]).max(), 1e-12)


class Refused(unittest.TestCase):
    def test_by_name(self):
        for more, words in (
                (("-joint_crushing_depth", 1e-3), ("-joint_crushing_depth", "elastic for 0.002 m")),
                (("-joint_filler", "0.5:1e4", "-joint_filler_unloading", 1e6), ("-joint_crushing", "not beside -joint_filler")),
                (("-joint_friction", .3), ("-joint_friction", "-joint_crushing", "hard contact only")),
                (("-joint_gap", -1e-3), ("contact joint", "overlap by 0.001 m", "-joint_gap")),
                (("-joint_sliding", .1), ("-joint_sliding", "strip that is crushed")),
                (("-export_matrices", "/tmp/none"), ("export_matrices", "-joint_crushing")),
                (("-joint_along", "1,0,0"), ("-joint_crushing", "-joint_along", "no faces")),
                (("-joint_gap_at", "unloaded", "-preload", "static"), ("-joint_gap_at", "strip that is crushed"))):
            program.must_refuse(self, colliding(*more), *words)
        words = colliding()
        for option in ("-joint_crushing", "-joint_crushing_stiffness", "-joint_crushing_depth"):
            at = words.index(option)
            program.must_refuse(self, words[:at] + words[at + 2:], "joint_crushing", "which is not given"
                                if option == "-joint_crushing" else option[1:])


ON_RANKS = {"faces that are crushed": elastic("-joint_passes", 2), "rigid blocks that crush a strip": colliding(cells=(2, 3))}


if __name__ == "__main__":
    unittest.main()
