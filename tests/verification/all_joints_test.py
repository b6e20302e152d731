"""Everything that lies between buildings in one scene: a block that slides with friction over many facets of a deck,
held by springs that yield and by a dashpot, meets a post behind a filler that locks; deck and post stand on supports
that move apart. Reference: the energy identity, the same scene in all of its modes, and on other ranks."""
import unittest

import numpy

from decks import box_of, clock, contacts, in_modes, material, probes
from program import write_samples
from recorded import Recorded, assert_continues

IDENTITY = 1e-11
MASS = 2400 * 0.3**3


def box(name, start, sides, cells, *more):
    (x, y, z), (lx, ly, lz), (nx, ny, nz) = start, sides, cells
    return [*box_of(name, f"x0={x},y0={y},z0={z},lx={lx},ly={ly},lz={lz},nx={nx},ny={ny},nz={nz}", "concrete"), *more]


class AllJoints(unittest.TestCase):
    def words(self, *more):
        time = numpy.arange(0, 0.4, 1e-3)
        record = write_samples(6 * numpy.sin(2 * numpy.pi * 4 * time) * numpy.sin(numpy.pi * time / 0.4)**2, 1e-3)
        words = ["-structures", "deck,block,post",
                 *box("deck", (0, -0.3, -0.3), (2, 0.6, 0.3), (16, 3, 1), "-deck_clamp", "z_min"),
                 *box("block", (0.2, -0.15, 0), (0.3, 0.3, 0.3), (2, 2, 2)),
                 *box("post", (0.9, -0.2, -0.3), (0.3, 0.4, 1.2), (1, 2, 6), "-post_clamp", "z_min"),
                 *material("concrete", 3e8, 0.2, 2400), "-deck_gravity", "0,0,0", "-post_gravity", "0,0,0",
                 "-block_gravity", "0,0,-9.81", "-block_initial_velocity", "3,0.2,0",
                 "-block_corners_element", "grounded_spring", "-block_corners_stiffness", "2e3,2e3,0",
                 "-block_corners_yield_force", "20,20,0", "-block_corners_hardening", 0.05,
                 "-block_corners_dashpot", "50,50,0", "-block_damping_beta", 2e-6, "-post_damping_uniform", 0.03,
                 *contacts(floor=("block:z_min", "deck:z_max", 0), joint=("block:x_max", "post:x_min", 0.35)),
                 "-floor_friction", 0.2, "-floor_sliding", 1.5, "-joint_friction", 0.2,
                 "-joint_filler", "0.1:8e3,0.6:2e4", "-joint_filler_unloading", 1e6, "-joint_filler_thickness", 0.1,
                 "-supports", "west,east", "-west_groups", "deck:z_min", "-east_groups", "post:z_min",
                 "-motion_x_record", record, "-motion_x_unit", "m/s2", "-east_delay", 0.03,
                 *probes(middle="block:body", top="post:z_max"), *clock(1e-5, 0.35, 1e-3), "-energy_interval", 50]
        return [*words, *more]

    def test_ledger(self):
        one = Recorded(self, self.words(), identity=IDENTITY)
        self.assertGreater(one.energy["friction"], 5)
        self.assertGreater(sum(impulse for impulse, name in zip(one.column("impulse"), one.impacts["contact"])
                               if name == "joint"), 1, "the filler locks")
        self.assertGreater(one.summary["contacts"]["joint"]["filler"]["crushed_strain"], 0.5)
        self.assertGreater(one.summary["contacts"]["floor"]["largest_slide"], 0.25)

    def test_all_modes(self):
        full = Recorded(self, self.words("-end_time", 0.2), identity=IDENTITY)
        reduced = Recorded(self, self.words("-end_time", 0.2, *in_modes("post", 108)), identity=IDENTITY)
        for channel in ("middle.x", "top.x"):
            difference = abs(full.displacement(channel) - reduced.displacement(channel)).max()
            self.assertLess(difference, 1e-8 * abs(full.displacement(channel)).max(), channel)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, self.words("-end_time", 0.2, "-modes", 0), 0.15, 13000, 2)


# Accelerations are differences of up to 3 m/s over 5e-5 s: round-off is 1e-12 of the largest.
ON_RANKS = {"all joints together": (lambda: AllJoints().words("-time_step", 5e-5, "-end_time", 0.2), {"tolerance": 1e-11})}


if __name__ == "__main__":
    unittest.main()
