"""Joints that are filled or bridged in places: the rows within a patch have its gap, on every number of ranks.

Two walls of shells face each other at 3 m along edges of 4 m; gaps come from the exported rows of the contact."""
import os
import tempfile
import unittest

import numpy

import program
import two_buildings
from decks import in_modes
from recorded import Recorded

SCENE = ["-options_file", str(two_buildings.SCENE), "-modes", 0, "-dry_run", "-floor1_gap", .05, "-left_damping_reference", 3,
         "-right_damping_reference", 4]


class GapPatches(unittest.TestCase):
    def gaps(self, *words, ranks=program.RANKS):
        """Gaps of floor1's rows, in the order of their places along y, and what was printed."""
        with tempfile.TemporaryDirectory() as folder:
            result = program.must_end(self, [*SCENE, "-export_matrices", folder, *words], ranks)
            columns = program.read_csv(os.path.join(folder, "left", "gaps.csv"))
        rows = [float(gap) for name, gap in zip(columns["contact"], columns["initial_gap"]) if name == "floor1"]
        return numpy.array(rows), result.stdout

    def test_pairs_within_a_patch_have_its_gap(self):
        uniform, _ = self.gaps()
        numpy.testing.assert_array_equal(uniform, .05)
        disc, said = self.gaps("-floor1_gap_patches", "2,3,0.5,0")
        self.assertEqual(sorted(disc), [0, *[.05] * (len(uniform) - 1)])
        self.assertIn("patch 1: 1 pairs with a gap of 0 mm", said)
        both, said = self.gaps("-floor1_gap_patches", "-0.1,2.9,1.1,3.1,0.01; 1,3,0.5,0.02")
        self.assertEqual(sorted(both), [.01, .02, *[.05] * (len(uniform) - 2)])  # of two the last counts
        self.assertIn("patch 2: 1 pairs with a gap of 20 mm", said)
        numpy.testing.assert_array_equal(self.gaps("-floor1_gap_patches", "2,3,0.5,0", ranks=3)[0], disc)

    def test_a_patch_replaces_a_random_width(self):
        field = ["-floor1_gap_deviation", .008, "-floor1_gap_length", 1.5]
        random, _ = self.gaps(*field)
        patched, _ = self.gaps(*field, "-floor1_gap_patches", "2,3,0.5,0.001")
        changed = patched != random
        self.assertEqual(changed.sum(), 1)
        self.assertEqual(patched[changed], .001)

    def test_a_filled_patch_is_struck_at_once(self):
        """At full order and reduced: the first impact comes while the joint elsewhere is wide open."""
        words = [word for word in SCENE if word != "-dry_run"] + ["-floor1_gap", 0.06, "-floor2_gap", 0.06, "-end_time", 0.6,
                                                                  "-probes", "left_roof"]
        for more in ([], [*in_modes("left", 12), *in_modes("right", 12)]):
            alone = Recorded(self, [*words, *more])
            bridged = Recorded(self, [*words, *more, "-floor2_gap_patches", "2,6,0.5,0"])
            self.assertEqual(len(alone.impacts["start"]), 0)
            self.assertGreater(len(bridged.impacts["start"]), 0)
            self.assertEqual(set(bridged.impacts["contact"]), {"floor2"})
            self.assertEqual(bridged.summary["contacts"]["floor2"]["gap_patches"], [{"gap": 0, "pairs": 1}])

    def test_refused(self):
        for value, part in (("2,3,0.5", "neither four numbers nor five"), ("2,3,0.5,-0.01", "has a gap below 0"),
                            ("2,3,0,0.01", "has no radius above 0"), ("1,3,0,4,0.01", "not in the order"),
                            ("9,3,0.5,0.01", "holds no pair"), ("2,3,0.5,0; 2,3,0.6,0.01", "patch 1 holds no pair")):
            program.must_refuse(self, [*SCENE, "-floor1_gap_patches", value], "-floor1_gap_patches", part)
        program.must_refuse(self, [*SCENE, "-floor1_gap_patches", "2,3,0.5,0", "-floor1_along", "1,0,0"], "-floor1_gap_patches",
                            "makes it a stop")


if __name__ == "__main__":
    unittest.main()
