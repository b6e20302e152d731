"""Faces of a contact: gaps between the surfaces of shells, the floor behind an edge that walls share, faces
that slide along each other, gaps and overlaps that may not be meant.

Free bodies fly at a known speed before they touch: the first impact begins at gap / speed.
"""
import os
import tempfile
import unittest

import numpy

import program
from decks import clock, contacts, SMALL_MODAL_PAIR as PAIR
from history import History, refused, scenes
from small_meshes import Mesh

THICKNESS, STEP = 0.2, 1e-4


def wall(x, y=(0, 1, 2)):
    """A wall in the plane x, 1 m high; group body."""
    nodes = [(x, place, z) for z in (0, 1) for place in y]
    count = len(y)
    return Mesh(nodes, {"body": ("quadrangle", [[i, i + 1, count + i + 1, count + i] for i in range(count - 1)])})


def storey(x, length):
    """A floor from x on (towards smaller x if `length` is negative) at z = 1 between two walls at x, above
    and below it; group edge is where they meet."""
    nodes = [(x, y, z) for z in (0, 1, 2) for y in (0, 1)] + [(x + length, y, 1) for y in (0, 1)]
    return Mesh(nodes, {"floor": ("quadrangle", [[2, 3, 7, 6]]), "wall": ("quadrangle", [[0, 1, 3, 2], [2, 3, 5, 4]]),
                        "edge": ("line", [[2, 3]])})


def pair(folder, one, two, sides, regions=("body",), speed="1,0,0", end_time=0.06):
    """Two free structures of shells, the first thrown at the second; the gap is that of the meshes."""
    words = ["-structures", "one,two", *contacts(joint=(f"one:{sides}", f"two:{sides}")),
             "-one_initial_velocity", speed, *clock(STEP, end_time, STEP / 2),
             *scenes.cheap(f"one:{sides}", f"two:{sides}"), *scenes.material("soft", 1e3, 0.0, 2400.0)]
    for name, mesh in (("one", one), ("two", two)):
        words += [f"-{name}_mesh", mesh.write(os.path.join(folder, f"{name}.msh"))]
        for region in regions:
            words += [f"-{name}_{region}_element", "shell", f"-{name}_{region}_material", "soft",
                      f"-{name}_{region}_thickness", THICKNESS]
    return words


def doubts(run):
    """The warnings of a run that are about contacts."""
    return [line for line in run.summary["warnings"] if line.startswith("contact")]


class Surfaces(unittest.TestCase):
    def meets_after(self, gap, make, *arguments):
        for ranks in (1, 2):
            with tempfile.TemporaryDirectory() as folder:
                run = History(self, pair(folder, *make, *arguments), ranks)
            contact = run.summary["contacts"]["joint"]
            self.assertAlmostEqual(contact["initial_gap"][0], gap, delta=1e-12)
            self.assertAlmostEqual(contact["initial_gap"][1], gap, delta=1e-12)
            self.assertAlmostEqual(run.column("start")[0], gap, delta=1.01 * STEP)
            self.assertEqual(doubts(run), [])
        return contact

    def test_walls_meet_with_their_surfaces(self):
        contact = self.meets_after(0.05, (wall(0), wall(0.25)), "body")
        self.assertEqual(contact["half_thickness"], [THICKNESS / 2] * 2)
        self.assertAlmostEqual(contact["geometric_gap"][0], 0.05, delta=1e-12)

    def test_an_overlap_by_thickness_is_said(self):
        """Meshes that are 0.05 m apart overlap by what their shells are thicker."""
        with tempfile.TemporaryDirectory() as folder:
            refused(self, pair(folder, wall(0), wall(0.05), "body"), "the meshes overlap by 0.15 m, their shells reaching 0.2 m "
                    "beyond their nodes")

    def test_report_tells_the_gap_of_the_meshes_beside_the_one_in_force(self):
        with tempfile.TemporaryDirectory() as folder:
            words = [*pair(folder, wall(0), wall(0.25), "body"), "-joint_gap", 0.03, "-dry_run"]
            result = program.run(words, 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("initial gap 30 to 30 mm", result.stdout)
        self.assertIn("of the meshes 50 to 50 mm between surfaces, half a thickness off: 100 and 100 mm",
                      result.stdout)

    def test_floors_that_end_at_walls_meet(self):
        self.meets_after(0.05, (storey(0, -3), storey(0.25, 3)), "edge", ("floor", "wall"))


class InOnePlane(unittest.TestCase):
    """Shells that are drawn in one plane, their gap given as a number: what else their structures have says
    which sides face each other, whatever the order of their nodes and the last digits of their place."""
    ORDERS = ((1, 1), (1, -1), (-1, 1), (-1, -1))

    def words(self, folder, meshes, orders, *arguments):
        for mesh, order in zip(meshes, orders):
            for group, (kind, cells) in mesh.groups.items():
                mesh.groups[group] = (kind, [cell[::order] for cell in cells])
        return [*pair(folder, *meshes, *arguments), "-joint_gap", 0.04]

    def test_bodies_say_which_sides_face_each_other(self):
        found = []
        for orders in self.ORDERS:
            for offset in (-2e-9, 2e-9):
                with tempfile.TemporaryDirectory() as folder:
                    run = History(self, self.words(folder, (storey(0, -3), storey(offset, 3)), orders, "wall",
                                                   ("floor", "wall")))
                self.assertAlmostEqual(run.column("start")[0], 0.04, delta=1.01 * STEP)
                found.append([run.column("impulse").sum(), *run.ledger["contact_work"][-1:]])
        found = numpy.array(found, dtype=float)
        self.assertGreater(found[0][0], 1)
        self.assertLess(abs(found / found[0] - 1).max(), 1e-12)

    def test_bare_walls_are_refused(self):
        for orders in self.ORDERS:
            for offset, ranks in ((-2e-9, 1), (2e-9, 2)):
                with tempfile.TemporaryDirectory() as folder:
                    refused(self, self.words(folder, (wall(0), wall(offset)), orders, "body"),
                            "-joint_secondary one:body", "lie in one plane", ranks=ranks)


def flight(velocity, gap=0.1, end_time=0.12, width=0.3):
    """Two bricks with faces 0.3 m wide (one facet); the first flies at `velocity`."""
    words = scenes.blocks((2.0, 2.0), gap=gap, time_step=5e-4, end_time=end_time)
    for name, start in (("one", -1), ("two", 0)):
        words[words.index(f"-{name}_mesh_set") + 1] = f"x0={start},ly={width},lz={width}"
    words[words.index("-one_initial_velocity") + 1] = velocity
    return words


class Slides(unittest.TestCase):
    def test_faces_that_slid_past_each_other_are_named(self):
        # They touch after 0.1 s, 0.8 m beside where they began, or never; both are seen.
        for velocity, touches in (("1,8,0", True), ("-1,0,8", False)):
            run = History(self, flight(velocity))
            self.assertEqual(run.summary["impacts"]["episodes"] > 0, touches)
            contact = run.summary["contacts"]["joint"]
            self.assertAlmostEqual(contact["largest_slide"], 0.96, delta=1e-9)
            self.assertAlmostEqual(contact["slide_facet_size"], 0.3, delta=1e-12)
            (warning,) = doubts(run)
            # Half of the facet is 0.15 m.
            self.assertIn("from t = 0.019 s on", warning)

    def test_motion_of_both_sides_together_and_along_the_normal_is_no_slide(self):
        run = History(self, [*flight("1,8,0", gap=0.15), "-two_initial_velocity", "0,8,0"])
        self.assertAlmostEqual(run.summary["contacts"]["joint"]["largest_slide"], 0, delta=1e-12)
        self.assertEqual(doubts(run), [])

    def test_oblique_faces(self):
        turn = numpy.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
        with tempfile.TemporaryDirectory() as folder:
            one, two = (wall(x).placed(lambda nodes: nodes @ turn.T) for x in (0, 0.25))
            velocity = ",".join(repr(float(v)) for v in turn @ (0.5, 3.0, 4.0))
            run = History(self, pair(folder, one, two, "body", speed=velocity, end_time=0.081), 2)
        contact = run.summary["contacts"]["joint"]
        self.assertAlmostEqual(contact["initial_gap"][0], 0.05, delta=1e-12)
        self.assertAlmostEqual(contact["largest_slide"], 5 * 0.081, delta=1e-6)
        self.assertAlmostEqual(contact["slide_facet_size"], 1, delta=1e-12)
        self.assertEqual(doubts(run), [])

    def test_a_run_that_is_continued_knows_what_slid_before(self):
        words = flight("1,8,0")
        half = list(words)
        half[half.index("-end_time") + 1] = 0.06
        _, whole = program.must_run(self, words, 2)
        cut, _ = program.must_run(self, [*half, "-checkpoint_steps", 100], 2)
        _, continued = program.must_run(self, [*words, "-restart", os.path.join(cut, "checkpoint.h5")], 2)
        self.assertEqual(continued["contacts"], whole["contacts"])
        slid = [[line for line in summary["warnings"] if "slid" in line] for summary in (whole, continued)]
        self.assertIn("from t = 0.019 s on", slid[0][0])
        self.assertEqual(slid[0], slid[1])

    def test_reduced_structures_slide_as_whole_ones(self):
        cut = PAIR.index("-s1_model")
        slides = []
        for words, ranks in ((PAIR, 1), (PAIR, 2), (PAIR[:cut] + ["-time_step", 2e-5], 2)):
            run = History(self, [*words, "-end_time", 0.1, "-s1_initial_velocity", "0,0.5,0"], ranks)
            slides.append([contact["largest_slide"] for contact in run.summary["contacts"].values()])
        self.assertEqual(slides[0], slides[1])
        for reduced, whole in zip(slides[0], slides[2]):
            self.assertGreater(whole, 5e-3)
            self.assertAlmostEqual(reduced / whole, 1, delta=2e-3)

    def test_a_wall_is_endless(self):
        words = flight("1,8,0")
        words[words.index("-joint_primary") + 1] = "wall"
        run = History(self, words)
        self.assertAlmostEqual(run.summary["contacts"]["joint"]["largest_slide"], 0.96, delta=1e-9)
        self.assertEqual(run.summary["contacts"]["joint"]["geometric_gap"], [None, None])
        self.assertEqual(doubts(run), [])


class Doubts(unittest.TestCase):
    def scene(self, **options):
        words = scenes.blocks((2.0, 2.0))
        for name, value in options.items():
            words[words.index(f"-{name}") + 1:words.index(f"-{name}") + 2] = [value]
        return words

    def doubt(self, words, *expected):
        """One warning about a contact that holds all the words."""
        run = History(self, words)
        self.assertEqual(len(doubts(run)), 1, run.summary["warnings"])
        for word in expected:
            self.assertIn(word, doubts(run)[0])
        return run

    def refuse(self, words, *expected):
        refused(self, words, *expected)

    def test_a_gap_in_metres_that_may_be_in_millimetres(self):
        self.doubt(self.scene(joint_gap=50), "contact joint", "gap given", "50 m", "metres")
        self.doubt(self.scene(joint_gap=50, joint_primary="wall"), "contact joint", "longer than the whole model")

    def test_overlap(self):
        # 0.002 of the model's 2 m.
        self.doubt(self.scene(joint_gap=-0.003), "contact joint", "overlap", "3 mm", "4 of 4 pairs")
        run = self.doubt(self.scene(joint_gap="geometry", two_mesh_set="x0=-0.003"), "overlap", "3 mm")
        self.assertEqual(run.summary["contacts"]["joint"]["overlapping_pairs"], 4)
        self.assertAlmostEqual(run.summary["contacts"]["joint"]["initial_gap"][0], -0.003, delta=1e-12)
        self.refuse(self.scene(joint_gap=-0.1), "-joint_gap", "-0.1 m", "cannot be meant")
        self.refuse(self.scene(joint_gap="geometry", two_mesh_set="x0=-0.1"), "contact joint", "overlap by 0.1 m")
        self.doubt(self.scene(joint_gap=0.01, two_mesh_set="x0=-0.1"), "overlap by up to 100 mm", "at least 10 mm")

    def test_faces_that_look_away(self):
        self.refuse(self.scene(joint_secondary="one:x_min", joint_primary="two:x_max", joint_gap="geometry"),
                    "-joint_secondary one:x_min", "behind it, by up to 2 m", "look away")

    def test_a_building_with_itself(self):
        self.refuse(self.scene(joint_primary="one:x_max"), "-joint_primary one:x_max", "4 nodes")
        self.refuse(self.scene(joint_primary="one:y_max"), "-joint_primary one:y_max", "2 nodes")

    def test_the_same_faces_twice(self):
        again = self.scene(contacts="joint,twin") + ["-twin_secondary", "two:x_min", "-twin_primary", "one:x_max",
                                                     "-twin_gap", 0.001]
        self.doubt(again, "contacts joint and twin", "same faces")

    def test_what_is_right_draws_no_word(self):
        run = History(self, self.scene(), 2)
        self.assertEqual(doubts(run), [])
        self.assertEqual((run.summary["contact_rows"], run.summary["coupled_rows"]), (4, 0))
        run = History(self, [*self.scene(), "-joint_passes", 2], 2)
        self.assertEqual((run.summary["contact_rows"], run.summary["coupled_rows"]), (4, 0))  # each pair once


if __name__ == "__main__":
    unittest.main()
