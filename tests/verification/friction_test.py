"""Coulomb's friction in contacts: a mass on a spring that comes to rest, a block on a shaken ground, on a slope,
one that strikes the ground at an angle.

References: the turning points and the wear of Code_Aster's problems SDND100 and SDND104, in closed form where there
is one; g (sin - mu cos) on a slope; the least of mu times the normal impulse and the momentum across it.
"""
import math
import unittest

import numpy

from decks import box_of, clock, contacts, in_modes, material, probes, section
from recorded import Recorded, assert_continues, write_sine

GRAVITY = 10.0
LONG = 1e-11  # energy identity of runs of many steps


def block(time_step, end_time, friction, *more, name="block", sample=None, mesh=""):
    """A stiff brick of 1 kg that stands on the ground, free to slide."""
    return ["-structures", name, *box_of(name, f"x0=-0.5,y0=-0.5,lz=0.1{mesh}", "stone"),
            *material("stone", 1e6, 0.2, 10), "-gravity", GRAVITY, *contacts(ground=(f"{name}:z_min", "wall", 0)),
            "-ground_friction", friction, *clock(repr(time_step), repr(end_time), repr(sample or time_step)),
            "-energy_interval", 100, "-probes", "one", "-one_structure", name, "-one_at", "-0.5,0.5,0", *more]


RIGID = ["-block_rigid", "body", "-material_stone_young", 1e3]


class MassOnASpring(unittest.TestCase):
    """k / m = 1e4: half a period pi / 100 s lasts each swing, which friction shortens by 2 mu g / omega^2 = .2 mm."""
    START, STIFFNESS = 0.85e-3, 1e4

    def swings(self, *more):
        return Recorded(self, block(1e-5, 0.16, 0.1, *RIGID, "-block_initial_displacement",
                                    f"{self.START},0,0", "-block_corners_element", "grounded_spring",
                                    "-block_corners_stiffness", f"{self.STIFFNESS / 4},0,0", *more), identity=LONG)

    def test_turning_points_at_full_order_and_reduced(self):
        full = self.swings()
        x = full.displacement("one.x")
        for turn, expected in enumerate((0.85e-3, -0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3)):
            at = turn * math.pi / 100
            self.assertAlmostEqual(x[round(at / 1e-5)], expected, delta=1e-9)
        rest = x[full.time > 0.1257]
        self.assertLess(abs(rest - rest[0]).max(), 1e-15)
        self.assertLess(abs(full.velocity("one.x")[full.time > 0.1257]).max(), 1e-15)
        self.assertAlmostEqual(full.energy["friction"], 0.1 * GRAVITY * 3.6e-3, delta=1e-8)
        self.assertAlmostEqual(sum(full.column("slip")), 3.6e-3, delta=1e-8)
        self.assertAlmostEqual(sum(full.column("friction_loss")) / full.energy["friction"], 1, delta=1e-9)
        reduced = self.swings(*in_modes("block", 6))
        self.assertLess(abs(reduced.displacement("one.x") - full.displacement("one.x")).max(), 1e-10)


class ShakenBlock(unittest.TestCase):
    """Wear power N |v| of 1 kg on a ground shaken by A sin(2 pi t), mean of 4 to 12 s."""

    def wear(self, amplitude, time_step=5e-4):
        record = write_sine(amplitude, 1, 12)
        run = Recorded(self, block(time_step, 12, 0.1, *RIGID, "-motion_x_record", record, "-motion_x_unit", "m/s2",
                                   "-motion_y_record", "none", "-motion_z_record", "none"), identity=LONG)
        rate = abs(run.velocity("one.x")[(run.time >= 4) & (run.time < 12)])
        return GRAVITY * rate.mean()

    def test_wear(self):
        for amplitude, expected, time_step in ((15, 15.2671, 1e-4), (1.5, 0.409062, 5e-4), (1.01, 2.26164e-4, 5e-4)):
            self.assertAlmostEqual(self.wear(amplitude, time_step) / expected, 1, delta=5e-5)
        self.assertLess(self.wear(0.99), 1e-14)


class MatOfShells(unittest.TestCase):
    """A slab with four columns on it, or below it, beside a wall: that lies where the columns are not."""

    def table(self, up, push):
        return Recorded(self, ["-structures", "t", "-t_mesh", "tests/meshes/table.geo",
                               "-t_mesh_set", f"slab=1,unit={-up}", "-t_column_element", "beam",
                               "-t_column_material", "steel", "-t_column_section", "tube",
                               *section("tube", 0.01, 1e-4, 1e-4, 2e-4, "1,0,0"), "-t_slab_element", "shell",
                               "-t_slab_material", "steel", "-t_slab_thickness", 0.2,
                               *material("steel", 200e9, 0.3, 7800),
                               "-t_gravity", f"{push * GRAVITY},0,{-up * GRAVITY}",
                               *contacts(ground=("t:slab", "wall", 0)), "-ground_friction", 0.3, "-end_time", 0.2,
                               "-output_interval", 1e-4, "-probes", "one", "-one_structure", "t",
                               "-one_at", f"0,0,{-3 * up}"], identity=LONG)

    def test_stands_sticks_and_slides(self):
        weight = GRAVITY * 7800 * (4 * 0.2 + 4 * 3 * 0.01)
        for up in (1, -1):
            run = self.table(up, 0.2)
            self.assertAlmostEqual(run.column("impulse").sum() / (weight * 0.2), 1, delta=0.02)
            self.assertLess(abs(run.displacement("one.x")).max(), 1e-4)
            slides = self.table(up, 0.5)
            path = 0.2 * GRAVITY * 0.2**2 / 2
            self.assertAlmostEqual(slides.displacement("one.x")[-1] / path, 1, delta=0.05)


class Slope(unittest.TestCase):
    def test_acceleration_down_a_slope(self):
        angle = 0.4
        for friction in (0.2, 0.5):
            run = Recorded(self, block(1e-4, 0.3, friction, *RIGID, mesh=f",tilt={angle}"))
            expected = GRAVITY * max(0, math.sin(angle) - friction * math.cos(angle))
            path = numpy.hypot(run.displacement("one.x"), run.displacement("one.z"))
            self.assertAlmostEqual(path[-1], expected * run.time[-1]**2 / 2, delta=1e-9)
            round_off = 0 if expected > 0 else 1e-30  # at rest its sign means nothing
            self.assertLessEqual(run.displacement("one.x")[-1] * run.displacement("one.z")[-1], round_off)


class Impact(unittest.TestCase):
    """The four nodes of the base take an eighth of the mass each, to rest across the ground."""

    def test_first_step_of_an_oblique_impact(self):
        fall = 2.0
        for across, friction in ((0.3, 0.5), (3.0, 0.5), (3.0, 0)):
            run = Recorded(self, block(1e-12, 1e-12, friction, "-block_initial_velocity",
                                       f"{across * 0.6},{across * 0.8},{-fall}", "-gravity", 0))
            self.assertAlmostEqual(run.column("impulse")[0], fall / 2, delta=1e-12)
            self.assertAlmostEqual(run.column("tangential_impulse")[0], min(friction * fall, across) / 2,
                                   delta=1e-12)


class AtRest(unittest.TestCase):
    """A block that slides to rest: friction took its momentum, and what its points push against each other is none."""

    def test_tangential_impulse_ends_with_the_slide(self):
        for end_time in (0.1, 0.3):
            run = Recorded(self, block(1e-4, end_time, 0.3, *RIGID, "-block_initial_velocity", "0.06,0.08,0"))
            self.assertAlmostEqual(run.column("impulse")[0], GRAVITY * (end_time + 5e-5), delta=1e-9)
            self.assertAlmostEqual(run.column("tangential_impulse")[0], 0.1, delta=1e-9)


def on_a_deck(*more, cells=3, friction=0.4):
    record = write_sine(9.0, 3, 1)
    words = ["-structures", "deck,block", "-deck_mesh", "tests/meshes/box.geo",
             "-deck_mesh_set", "x0=-0.2,y0=-0.2,z0=-0.4,lz=0.4,nx=5,ny=5,nz=2", "-deck_clamp", "z_min",
             "-block_mesh", "tests/meshes/box.geo",
             "-block_mesh_set", f"lx=0.6,ly=0.6,lz=0.6,nx={cells},ny={cells},nz=3", "-gravity", GRAVITY,
             "-preload", "static", *contacts(joint=("block:z_min", "deck:z_max")), "-joint_friction", friction,
             "-motion_x_record", record, "-motion_x_unit", "m/s2", "-motion_y_record", record,
             "-motion_y_unit", "m/s2", "-motion_y_scale", 0.5, *clock(5e-4, 0.4), "-energy_interval", 10,
             *probes(top="block@0.6,0.6,0.6", seat="deck@0.4,0.4,0")]
    for name in ("deck", "block"):
        words += [f"-{name}_body_element", "hex8", f"-{name}_body_material", "rubber", f"-{name}_damping_alpha", 1]
    return [*words, *material("rubber", 5e6, 0.2, 1500), *more]


class Stack(unittest.TestCase):
    """A soft block on a soft deck, both of bricks, that slides, sticks and hops on it while the ground shakes."""

    @classmethod
    def setUpClass(cls):
        cls.matched = cls().stack()

    def stack(self, *more, identity=1e-12, **values):
        return Recorded(self, on_a_deck(*more, **values), identity=identity)

    @staticmethod
    def history(run):
        return numpy.array([run.displacement(f"{probe}.{d}") for probe in ("top", "seat") for d in "xyz"])

    def assert_alike(self, one, other, tolerance):
        a, b = self.history(one), self.history(other)
        self.assertLess(abs(a - b).max(), tolerance * abs(a).max())

    def test_what_slides(self):
        run = self.matched
        self.assertGreater(run.energy["friction"], 10)
        slip = run.column("slip").sum()
        self.assertGreater(slip, 5e-3)
        smooth = self.stack(friction=0)
        self.assertEqual(smooth.energy["friction"], 0)
        self.assertGreater(abs(self.history(smooth) - self.history(run)).max(), 1e-2)
        glued = self.stack(friction=5)
        self.assertLess(glued.column("slip").sum(), slip / 5)
        # The block weighs 324 kg: friction took mu N times the path, more or less as N hops.
        weight = 324 * GRAVITY
        self.assertAlmostEqual(run.energy["friction"] / (0.4 * weight * slip), 1, delta=0.5)

    def test_faces_that_do_not_match(self):
        unmatched = self.stack(cells=4)
        self.assertLess(unmatched.summary["impacts"]["complementarity_residual"], 1e-9)
        self.assertAlmostEqual(unmatched.energy["friction"] / self.matched.energy["friction"], 1, delta=0.1)

    def test_all_modes_are_the_finite_elements(self):
        words = []
        for name, dofs in (("block", 3 * 4**3), ("deck", 3 * 6 * 6 * 2)):
            words += [*in_modes(name, dofs)]
        self.assert_alike(self.matched, self.stack(*words, identity=1e-11), 1e-6)

    def test_few_modes_with_attachment_along_the_face(self):
        reduced = self.stack(*in_modes("block", 30), *in_modes("deck", 30))
        self.assertAlmostEqual(reduced.energy["friction"] / self.matched.energy["friction"], 1, delta=0.05)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        """Stopped while points of faces that do not match slide: Gauss-Seidel starts from the last impulses."""
        assert_continues(self, on_a_deck("-modes", 1, "-spectra_frequencies", 10, cells=4), 0.2, 317, 2)

    def test_rigid_block(self):
        self.assertGreater(self.stack("-block_rigid", "body").energy["friction"], 10)


# Gaps stay below 0.1 mm while the nodes beside them move by 57: their round-off is that of the nodes.
GAPS = {"tolerance": 1e-9}
ON_RANKS = {"a block that slides": (lambda: on_a_deck("-end_time", 0.2), GAPS),
            "a block that slides on other nodes": (lambda: on_a_deck("-end_time", 0.2, cells=4), GAPS),
            "a rigid block that slides": lambda: on_a_deck("-block_rigid", "body")}


if __name__ == "__main__":
    unittest.main()
