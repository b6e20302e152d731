"""Joints as they were built: gaps measured at points of a face, less a closing by elevation, against numbers by hand.

Two blocks of 2 x 4 x 8 m face each other over 50 mm; gaps come from the exported rows of the contact."""
import os
import shutil
import tempfile
import unittest

import h5py
import numpy

import program
from decks import SMALL_MODAL_PAIR, box_of, clock, contacts, material, probes
from program import write_samples
from recorded import Recorded, assert_continues

BLOCKS = ["-structures", "a,b", *contacts(joint=("a:x_max", "b:x_min")), *box_of("a", "x0=-2,lx=2,ly=4,lz=8,ny=4,nz=4", "c"),
          *box_of("b", "x0=0.05,lx=2,ly=4,lz=8,ny=4,nz=4", "d"), *material("c", 1e8, 0.2, 2500), *material("d", 3e10, 0.2, 2500), "-a_clamp", "z_min", "-b_clamp",
          "z_min", "-modes", 0, "-a_damping_alpha", 0, "-b_damping_alpha", 0]
CORNERS = [(0, 0, 0, .04), (0, 4, 0, .06), (0, 4, 8, .06), (0, 0, 8, .04)]
# Wide but for two places, one of them tighter.
TIGHT = [*[(0, y, z, .03) for y in (0, 2, 4) for z in (0, 2, 4, 6, 8) if (y, z) not in ((4, 8), (0, 6))], (0, 4, 8, 2e-4), (0, 0, 6, .004)]


def survey(points, head="x,y,z,gap"):
    path = os.path.join(tempfile.mkdtemp(prefix="pounding-survey-"), "survey.csv")
    with open(path, "w") as file:
        file.write("\n".join([head, *(",".join(v if isinstance(v, str) else repr(float(v)) for v in point) for point in points)]) + "\n")
    return path


class GapSurvey(unittest.TestCase):
    def gaps(self, *words, ranks=program.RANKS):
        """Places and gaps of the rows, and what was printed."""
        with tempfile.TemporaryDirectory() as folder:
            done = program.must_end(self, [*BLOCKS, *clock(1e-4, 1e-4), "-csv_digits", 17, "-output", folder, *words], ranks)
            rows = program.read_csv(os.path.join(folder, "joint_pairs.csv"))
        return numpy.array([[float(v) for v in rows[key]] for key in ("x", "y", "z", "initial_gap")]).T, done.stdout

    def test_four_corners_are_a_linear_gap(self):
        by_hand, _ = self.gaps("-joint_gap", ".04,.06")
        found, said = self.gaps("-joint_survey", survey(CORNERS))
        self.assertEqual(len(found), 25)
        numpy.testing.assert_allclose(found, by_hand, rtol=0, atol=1e-12)
        self.assertIn("surveyed at 4 points: as built at least 40 mm at (0, 0, 0) m, 50 mm in the mean; 0 pairs lie beyond", said)
        for ranks in (2, 3):
            numpy.testing.assert_array_equal(self.gaps("-joint_survey", survey(CORNERS), ranks=ranks)[0], found)

    def test_linear_over_the_triangles_of_delaunay(self):
        """A peak of 10 mm in the middle of the face is a pyramid; of a long rectangle the short diagonal of a kite counts."""
        found, _ = self.gaps("-joint_survey", survey([*[(*c[:3], .04) for c in CORNERS], (0, 2, 4, .05)]))
        for _, y, z, gap in found:
            self.assertAlmostEqual(gap, .05 - .01 * max(abs(y - 2) / 2, abs(z - 4) / 4), delta=1e-12)
        kite = [(0, 2, 0, .01), (0, 2, 8, .02), (0, 0, 4, .03), (0, 4, 4, .05)]
        found, _ = self.gaps("-joint_survey", survey(kite))
        middle = found[(abs(found[:, 1] - 2) < 1e-6) & (abs(found[:, 2] - 4) < 1e-6)]
        self.assertAlmostEqual(middle[0, 3], .04, delta=1e-12)  # of 0,4 and 4,4, not of 2,0 and 2,8

    def test_beyond_the_points_as_at_the_nearest_place(self):
        within = [(0, y, z, .04 + .005 * y) for y in (1, 3) for z in (2, 6)]
        found, said = self.gaps("-joint_survey", survey(within))
        for _, y, z, gap in found:
            self.assertAlmostEqual(gap, .04 + .005 * min(max(y, 1), 3), delta=1e-12)
        self.assertIn(f"16 pairs lie beyond the points, by at most {5 ** .5:.4g} m", said)

    def test_along_an_edge_of_a_slab(self):
        """A face that is a line takes points along it, in any order."""
        scene = os.path.join(program.SOURCE, "petsc-options", "new", "two-buildings", "two-buildings.yaml")
        words = ["-options_file", scene, "-floor1_gap", "geometry", "-floor1_survey", survey([(6, 3, 3, .02), (6, 0.5, 3, .01), (6, 2, 3, .04)]),
                 *clock(1e-5, 1e-5), "-modes", 0, "-csv_digits", 17]
        with tempfile.TemporaryDirectory() as folder:
            done = program.must_end(self, [*words, "-output", folder])
            rows = program.read_csv(os.path.join(folder, "joint_pairs.csv"))
        found = {round(float(y), 9): float(gap) for y, gap, of in zip(rows["y"], rows["initial_gap"], rows["contact"]) if of == "floor1"}
        self.assertEqual(sorted(found), [0, 1, 2, 3, 4])
        for y, gap in {0: .01, 1: .02, 2: .04, 3: .02, 4: .02}.items():
            self.assertAlmostEqual(found[y], gap, delta=1e-12)
        self.assertIn("2 pairs lie beyond the points, by at most 1 m", done.stdout)

    def test_one_file_for_several_contacts(self):
        """Rows go to the contact that they name, whatever lies between them; both joints are those of files of their own."""
        scene = os.path.join(program.SOURCE, "petsc-options", "new", "two-buildings", "two-buildings.yaml")
        first, second = ([(6, y, z, gap) for y, gap in zip((3, .5, 2), gaps)] for z, gaps in ((3, (.02, .01, .04)), (6, (.03, .015, .02))))
        mixed = survey([("floor1" if point in first else "floor2", *point) for pair in zip(second, first) for point in pair], "contact,x,y,z,gap")

        def gaps(*files):
            words = ["-options_file", scene, *(word for floor, file in zip(("floor1", "floor2"), files) for word in
                                               (f"-{floor}_gap", "geometry", f"-{floor}_survey", file)), *clock(1e-5, 1e-5), "-modes", 0, "-csv_digits", 17]
            with tempfile.TemporaryDirectory() as folder:
                program.must_end(self, [*words, "-output", folder])
                return program.read_csv(os.path.join(folder, "joint_pairs.csv"))["initial_gap"]

        self.assertEqual(gaps(mixed, mixed), gaps(survey(first), survey(second)))

    def test_less_a_closing_by_elevation(self):
        plain, _ = self.gaps("-joint_survey", survey(CORNERS))
        found, _ = self.gaps("-joint_survey", survey(CORNERS), "-joint_static_closing", "2:.001,6:.005")
        numpy.testing.assert_allclose(found[:, 3], plain[:, 3] - .001 - .001 * numpy.clip(plain[:, 2] - 2, 0, 4), rtol=0, atol=1e-12)
        of_meshes, _ = self.gaps("-joint_static_closing", "0:.01")
        numpy.testing.assert_allclose(of_meshes[:, 3], .04, rtol=0, atol=1e-12)

    def test_its_error_is_on_top(self):
        field = ["-joint_gap_deviation", .001, "-joint_gap_length", 2]
        plain = self.gaps("-joint_gap", .05)[0][:, 3]
        error = self.gaps("-joint_gap", .05, *field)[0][:, 3] - plain
        found = self.gaps("-joint_survey", survey(CORNERS), *field)[0][:, 3] - self.gaps("-joint_survey", survey(CORNERS))[0][:, 3]
        numpy.testing.assert_allclose(found, error, rtol=0, atol=1e-12)
        self.assertGreater(abs(error).max(), 1e-4)

    def run_words(self, *more):
        push = write_samples([-20.0] * 400, 1e-3)
        return [*BLOCKS, "-joint_survey", survey(TIGHT), *clock(1e-4, .04), *probes(top="a:z_max"), "-motion_x_record", push,
                "-motion_x_unit", "m/s2", "-motion_x_time_step", 1e-3, *more]

    def test_the_tight_place_touches_first(self):
        run = Recorded(self, self.run_words())
        self.assertGreater(len(run.impacts["start"]), 0)
        folder, _ = program.must_run(self, [*self.run_words(), "-end_time", float(run.impacts["start"][0]) + 2e-4])
        self.addCleanup(shutil.rmtree, folder)
        points = program.read_csv(os.path.join(folder, "contact_points.csv"))
        self.assertEqual([(float(y), float(z)) for y, z, push in zip(points["y"], points["z"], points["impulse"]) if float(push) > 0],
                         [(4, 8)])
        found = run.summary["contacts"]["joint"]["survey"]
        self.assertEqual((found["points"], found["smallest"], found["place_of_smallest"]), (15, 2e-4, [0, 4, 8]))
        self.assertEqual(found["largest"], .03)

    def test_continued_and_only_with_the_same_survey(self):
        words = self.run_words()
        assert_continues(self, words, .02, 150)

    def test_refused(self):
        for points, *parts in (([(x, y, z + 100, g) for x, y, z, g in CORNERS], "off the faces, which are 8 m long"),
                               ([(x * 1e3, y * 1e3, z * 1e3, g) for x, y, z, g in CORNERS], "off the faces"),
                               ([(x, y, z, 1e3 * g) for x, y, z, g in CORNERS], "half of its gaps are 60 m or more; gaps are in metres"),
                               (CORNERS[:2], "fewer than three points"),
                               ([(0, 0, z, .04) for z in (0, 3, 8)], "lie on one line"),
                               ([*CORNERS, CORNERS[1]], "lines 3 and 6 are the same place"),
                               ([*CORNERS[:3], (0, 0, 8, -.01)], "line 5", "a gap below 0")):
            program.must_refuse(self, [*BLOCKS, "-dry_run", "-end_time", 1e-4, "-joint_survey", survey(points)], "-joint_survey", *parts)
        words = [*BLOCKS, "-dry_run", "-end_time", 1e-4]
        program.must_refuse(self, [*words, "-joint_survey", survey(CORNERS, "x,y,z,gap_mm")], "no column 'gap'")
        for names, part in ((["joint", "joint", "joint", "joints"], "line 5: 'joints' is no contact of the scene"),
                            (["joint", "", "joint", "joint"], "line 3: '(no value)' is no contact of the scene")):
            mixed = survey([(name, *corner) for name, corner in zip(names, CORNERS)], "contact,x,y,z,gap")
            program.must_refuse(self, [*words, "-joint_survey", mixed], part)
        program.must_refuse(self, [*words, "-joint_survey", "nothing.csv"], "-joint_survey nothing.csv", "no such file")
        program.must_refuse(self, [*words, "-joint_survey", survey(CORNERS), "-joint_gap", .02], "-joint_survey", "not beside -joint_gap")
        program.must_refuse(self, [*words, "-joint_static_closing", "3:.1,2:.2"], "-joint_static_closing", "elevations must rise")
        program.must_refuse(self, [*words, "-joint_static_closing", ".01"], "-joint_static_closing", "'.01' is not elevation:closing")
        program.must_refuse(self, [*words, "-joint_survey", survey(CORNERS), "-joint_along", "1,0,0"], "makes it a stop")


class InEnsembles(unittest.TestCase):
    """Floors of the reduced pair: members share the survey, have closings and errors of their own, and are their single runs."""

    def test_members_are_their_single_runs(self):
        floor = survey([(3.36, y, z, g) for z in (5, 5.22) for y, g in ((0, 2e-4), (1.5, 5e-4), (2.28, 1e-4))])
        words = list(SMALL_MODAL_PAIR)
        at = words.index("-floor2_gap")
        del words[at:at + 2]
        words += ["-floor2_gap", "geometry", "-floor2_survey", floor, "-end_time", .3]
        closings = ("0:0", "0:5e-5")
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            table = os.path.join(folder, "members.csv")
            with open(table, "w") as file:
                file.write("\n".join(["floor2_static_closing", *closings]) + "\n")
            program.must_end(self, [*words, "-ensemble", table, "-output", os.path.join(folder, "results")])
            with h5py.File(os.path.join(folder, "results", "ensemble.h5")) as file:
                found = {name: values[()] for group in ("pairs", "peaks")
                         for name, values in ((f"{key}_of_pairs" if (group, key) == ("pairs", "displacement") else key, values)
                                              for key, values in file[group].items())}
        for member, closing in enumerate(closings):
            folder, summary = program.must_run(self, ["-csv_digits", 17, *words, "-floor2_static_closing", closing])
            self.addCleanup(shutil.rmtree, folder)
            peaks = [value for probe in summary["probes"].values() for value in probe["peak_displacement"]]
            numpy.testing.assert_allclose(found["displacement"][member], peaks, rtol=1e-9, atol=1e-15)
            pairs = {name: numpy.array(values) for name, values in program.read_csv(os.path.join(folder, "joint_pairs.csv")).items()}
            names = list(summary["contacts"])
            self.assertEqual([names[int(i)] for i in found["contact"]], pairs["contact"].tolist())
            for d, axis in enumerate("xyz"):
                numpy.testing.assert_array_equal(found["place"][:, d], pairs[axis].astype(float))
                numpy.testing.assert_allclose(found["displacement_of_pairs"][member, :, d], pairs["d" + axis].astype(float), rtol=1e-9,
                                              atol=1e-15)
            for name in ("initial_gap", "least_gap", "time"):
                numpy.testing.assert_allclose(found[name][member], pairs[name].astype(float), rtol=1e-9, atol=1e-15, err_msg=name)
            roof = pairs["contact"] == "floor2"
            least = pairs["initial_gap"][roof].astype(float).min()
            self.assertAlmostEqual(least, (1e-4, 5e-5)[member], delta=1e-12)
            self.assertGreater(summary["impacts"]["episodes"], 0)


if __name__ == "__main__":
    unittest.main()
