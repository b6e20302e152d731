"""Groups that a mesh does not have, given by points: loads, stops, clamps, masses, springs, rigid bodies and supports at
points are those of a group of the mesh that has these nodes, to the bit, in every room of the program."""
import os
import tempfile
import unittest

import program
from decks import in_modes
from recorded import Recorded, assert_continues, ensemble_of
from stops_test import stop, yard

LOAD = ["-loads", "blast", "-blast_moment", "0,0,40", "-blast_force", "0,900,100", "-blast_values", "0,0; .1,1; .2,0"]
FEET = ["-supports", "feet", "-feet_groups", "left:base", "-feet_delay", ".01"]


def by_groups(*more):
    """The yard of the stops, where a load acts and a foot moves on its own."""
    return yard(*LOAD, "-blast_on", "right:top", *FEET, *more)


def by_points(*more):
    """The same without a group of the mesh but its lines: named sets of points, and points in place of groups."""
    words = yard(*LOAD, "-blast_on", "right: 0,1,3", *FEET)
    for name, x0, top in (("left", 0, 300), ("right", 1, 120)):
        for option in ("element", "mass", "rotary_inertia"):
            at = words.index(f"-{name}_top_{option}")
            words[at] = f"-{name}_head_{option}"
        words += [f"-{name}_head_points", f"0,{x0},3", f"-{name}_foot_points", f"0,{x0},0", f"-{name}_clamp", "foot"]
    return [*words, "-feet_groups", "left:foot", "-post_secondary", "left:head", "-post_primary", "right:0,1,3", *more]


class SameAsGroups(unittest.TestCase):
    def same(self, more=(), ranks=1):
        groups, points = (Recorded(self, words(*more), ranks) for words in (by_groups, by_points))
        for channel in ("a.y", "b.y", "b.z"):
            self.assertGreater(abs(groups.displacement(channel)).max(), 1e-8)
            self.assertEqual(groups.displacement(channel).tolist(), points.displacement(channel).tolist())
        self.assertEqual(groups.force("post").tolist(), points.force("post").tolist())
        self.assertGreater(points.summary["impacts"]["post"]["episodes"], 2)
        self.assertEqual(groups.summary["impacts"]["post"], points.summary["impacts"]["post"])
        return points

    def test_on_any_ranks(self):
        for ranks in (1, 2, 3):
            self.same(ranks=ranks)

    def test_in_modes(self):
        self.same([word for name in ("left", "right") for word in in_modes(name, 24)], 2)

    def test_in_an_ensemble(self):
        modal = [word for name in ("left", "right") for word in in_modes(name, 24)]
        of = [ensemble_of(self, words(*modal, "-supports", "none", "-time_step", 1e-5), "motion_level", [1, 2])[0]
              for words in (by_groups, by_points)]
        self.assertGreater(of[0].min(), 0)
        self.assertEqual(of[0].tolist(), of[1].tolist())

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, by_points(), .2, 200)

    def test_from_pieces(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            pair = [["-partition", "elements"], ["-partition", "elements", "-mesh_pieces", os.path.join(folder, "pieces")]]
            cheap = ["-modes", 1, "-spectra_frequencies", 10]
            program.must_end(self, [*cheap, *by_points(*pair[1]), "-write_mesh_pieces", 2], ranks=1)
            whole, cut = (Recorded(self, by_points(*more), 2) for more in pair)
            self.assertEqual(whole.displacement("b.y").tolist(), cut.displacement("b.y").tolist())
            program.must_refuse(self, [*cheap, *by_points(*pair[1], "-right_head_points", "0,1,1.5")], "right_head_points", ranks=2)

    def test_springs_and_rigid_bodies(self):
        free = ["-left_clamp", "none", "-supports", "none"]
        for rigid in (False, True):
            words = []
            for name in ("base", "bed"):
                words.append([f"-left_{name}_element", "grounded_spring", f"-left_{name}_stiffness",
                              "1e6,2e6,3e6,4e6,4e6,4e6", *free, *(["-left_rigid", "stem"] if rigid else [])])
            of_mesh = Recorded(self, by_groups(*words[0]), 1)
            rod = ["-left_rigid", "rod", "-left_rod_points", "0,0,0; 0,0,3;0,0,1.5"] if rigid else []
            at_points = Recorded(self, by_points(*words[1], "-left_bed_points", "0,0,0", *rod), 1)
            self.assertGreater(abs(of_mesh.displacement("a.y")).max(), 1e-3)
            self.assertEqual(of_mesh.displacement("a.y").tolist(), at_points.displacement("a.y").tolist())


class Doubted(unittest.TestCase):
    def lines(self, *more):
        return program.must_end(self, [*by_points(*more), "-dry_run"], ranks=1).stdout.splitlines()

    def test_a_point_that_is_far_from_its_node_is_doubted(self):
        fine = [word for name, y0 in (("left", 0), ("right", 1)) for word in (f"-{name}_mesh_set", f"y0={y0},n=12,height=3")]
        for option, value in (("left_head_points", "0,0.1,3"), ("post_primary", "right:0,1.1,3"),
                              ("blast_on", "right:0,1.1,3")):
            doubt = f"warning: option -{option}: its node is 0.1 m away from the point asked for, where elements measure 0.25 m"
            self.assertTrue(any(line.startswith(doubt) for line in self.lines(*fine, "-" + option, value)), option)
        self.assertFalse(any("away from the point" in line for line in self.lines(*fine, "-blast_on", "right:0,1.04,3")))

    def test_points_that_nothing_uses(self):
        self.assertTrue(any("groups without a use: idle" in line for line in self.lines("-right_idle_points", "0,1,1.5")))
        self.assertFalse(any("without a use" in line for line in self.lines()))


class Refused(unittest.TestCase):
    def test_by_name(self):
        for more, words in (
                (("-post_primary", "right:0,3,3"), ("-post_primary", "2 m away", "structure right")),
                (("-blast_on", "right:0,1,9"), ("-blast_on", "6 m away")),
                (("-blast_on", "right:0,1"), ("-blast_on", "a point is right:x,y,z")),
                (("-left_head_points", "0,0,3; 0,.01,3"), ("-left_head_points", "two of the points", "(0, 0, 3)")),
                (("-left_head_points", "0,0"), ("-left_head_points", "'0,0' is not a point", "x,y,z; x,y,z")),
                (("-left_top_points", "0,0,3"), ("-left_top_points", "has a group 'top'")),
                (("-left_stem_points", "0,0,3"), ("-left_stem_points", "not for the element beam")),
                (("-left_bed_points", "0,0,0", "-left_bed_mass", 5), ("-left_bed_element", "missing")),
                (("-left_bed_points", "0,0,0", "-left_bed_element", "grounded_spring", "-left_bed_stiffness_per_area",
                  "1,1,1"), ("-left_bed_points", "no lines or surfaces")),
                (("-left_stem_element", "point_mass", "-left_stem_mass", 1), ("-left_stem_material", "point_mass"))):
            program.must_refuse(self, by_points(*more), *words, ranks=1)
        program.must_refuse(self, ["-structures", "m", "-m_mesh", "tests/meshes/cantilever.geo", "-m_head_element", "point_mass",
                                   "-m_head_mass", 5, "-m_head_points", "0,0,3", "-end_time", 1], "-m_head_points",
                            "no element of its mesh", ranks=1)
        program.must_refuse(self, [*by_points(), "-contacts", "face", "-face_secondary", "left:0,0,3", "-face_primary",
                                   "right:head", "-face_gap", .1], "-face_secondary", "can be a stop: give -face_along", ranks=1)


if __name__ == "__main__":
    unittest.main()
