"""Matrices written by one run and read back by another: the same building, to the last digits.

The two-storey pair on a coarse mesh, which hits within the window, with its own damping in one region
so that all three matrices are there. With the assembled product what differs is round-off. Without a
matrix, bricks that are equal to 1e-10 share one shape, which shows in the eleventh digit.
"""
import os
import shutil
import subprocess
import tempfile
import unittest

import numpy
import scipy.io
import scipy.sparse

import program
from recorded import Recorded, assert_follows

STEPS = ["-end_time", 0.1, "-s1_initial_velocity", "0.5,0,0", "-time_step", 1.5e-5,
         "-floor2_gap", "0.004,0.003"]
ONE_DAMPING = program.COARSE_PAIR + STEPS
PAIR = ONE_DAMPING + ["-s1_slab_damping_beta", 2e-5, "-s1_slab_damping_alpha", 0.1562]
IDENTITY = 1e-11  # with a region's own damping; measured: 2e-12


def written(place, ranks=program.RANKS):
    """A folder with the matrices of both buildings."""
    result = program.run(PAIR + ["-dry_run", "-export_matrices", place], ranks)
    assert result.returncode == 0, result.stderr
    return place


def from_files(place):
    return ONE_DAMPING + ["-s1_matrices", f"{place}/s1", "-s2_matrices", f"{place}/s2"]


class Matrices(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-matrices-")
        cls.own = Recorded(cls(), PAIR + ["-stiffness", "assembled"], identity=IDENTITY)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def export(self, ranks=1):
        place = os.path.join(self.folder, f"of-{ranks}")
        return place if os.path.exists(place) else written(place, ranks)

    def matrix(self, place, name):
        return scipy.sparse.csr_matrix(scipy.io.mmread(os.path.join(place, name)))

    def test_histories_from_the_files(self):
        own = self.own
        without = Recorded(self, PAIR, identity=IDENTITY)
        assert_follows(self, without.displacement("s2_floor2.x"), own.displacement("s2_floor2.x"),
                       1e-10, "without a matrix")
        self.assertGreater(own.summary["impacts"]["episodes"], 0)
        read = Recorded(self, from_files(self.export()), identity=IDENTITY)
        self.assertEqual(read.time_step, own.time_step)
        self.assertEqual(read.summary["impacts"]["episodes"], own.summary["impacts"]["episodes"])
        for channel in ("s1_floor2.x", "s2_floor2.x", "s2_floor1.x"):
            assert_follows(self, read.displacement(channel), own.displacement(channel), 1e-12, channel)
            assert_follows(self, read.velocity(channel), own.velocity(channel), 1e-11, channel)

    def test_files_do_not_depend_on_the_ranks(self):
        one, three = self.export(), self.export(3)
        for name in ("s1/dofs.csv", "s2/contact.mtx", "s2/gaps.csv", "s1/probes.mtx"):
            with open(os.path.join(one, name)) as a, open(os.path.join(three, name)) as b:
                self.assertEqual(a.read(), b.read(), name)
        for name in ("s1/stiffness.mtx", "s1/damping.mtx", "s2/stiffness.mtx"):
            a, b = self.matrix(one, name), self.matrix(three, name)
            self.assertLessEqual(float(abs(a - b).max() / abs(a).max()), 1e-13, name)

    def test_a_run_is_continued_with_the_same_matrices_only(self):
        place, results = os.path.join(self.folder, "changed"), os.path.join(self.folder, "stopped")
        shutil.copytree(self.export(), place)
        words = from_files(place) + ["-end_time", 2e-4, "-checkpoint_steps", 10]
        program.must_end(self, [*words, "-output", results])
        restart = ["-restart", os.path.join(results, "checkpoint.h5"), "-end_time", 3e-4, "-output",
                   os.path.join(self.folder, "continued")]
        program.must_end(self, [*words, *restart])
        path = os.path.join(place, "s2", "stiffness.mtx")
        with open(path) as file:
            *lines, last = file.read().splitlines()
        row, column, value = last.split()
        with open(path, "w") as file:
            file.write("\n".join([*lines, f"{row} {column} {float(value) * 1.001!r}"]) + "\n")
        program.must_refuse(self, [*words, *restart], "written with -s2_matrices (its stiffness)", "start anew")

    def script_of_the_docs(self, language, place, interpreter):
        """Frequencies and effective masses that a script on the page prints for the exported matrices."""
        with open(os.path.join(program.SOURCE, "docs", "manual", "matrices.md")) as file:
            script = file.read().split(f"```{language}\n")[1].split("```")[0]
        self.assertIn("results/matrices/s1/", script)
        result = subprocess.run([*interpreter, script.replace("results/matrices/", place + "/")],
                                capture_output=True, text=True, timeout=300, cwd=program.SOURCE)
        self.assertEqual(result.returncode, 0, result.stderr)
        return numpy.array([line.split() for line in result.stdout.splitlines()], dtype=float)

    def test_the_scripts_of_the_docs_find_the_modes(self):
        place = self.export()
        _, own = program.must_run(self, [*PAIR, "-modes", 6, "-end_time", 1e-4])
        octave = shutil.which("octave-cli")
        for language, interpreter in (("python", ["/usr/bin/python3", "-c"]),
                                      ("matlab", [octave, "--no-gui", "--no-init-file", "-q", "--eval"])):
            if interpreter[0] is None:
                continue  # tests/package/octave_test.py says so
            found = self.script_of_the_docs(language, place, interpreter)
            for mode, row in zip(own["structures"]["s1"]["frequencies"], found, strict=True):
                self.assertAlmostEqual(row[0] / mode["frequency"], 1, delta=1e-7)
                whole = own["structures"]["s1"]["mass"]
                numpy.testing.assert_allclose(row[1:], mode["effective_modal_mass"][:3], atol=1e-6 * whole)

    def test_labels_of_nodes_go_out_and_in(self):
        """An export has the numbers of the mesh file, one of imported matrices the labels that they came with."""
        place, again = os.path.join(self.folder, "labelled"), os.path.join(self.folder, "again")
        shutil.copytree(self.export(), place)
        path = os.path.join(place, "s1", "dofs.csv")
        with open(path) as file:
            head, names, *rows = file.read().splitlines()
        self.assertEqual(names, "x,y,z,component,node")
        places = {}
        for row in rows:
            *where, _, number = row.split(",")
            self.assertGreater(int(number), 0)
            self.assertEqual(places.setdefault(number, where), where)
        self.assertEqual(len({tuple(where) for where in places.values()}), len(places))
        with open(path, "w") as file:
            file.write("\n".join([head, names, *(f"{row.rsplit(',', 1)[0]},pier A {row.rsplit(',', 1)[1]}"
                                                  for row in rows)]) + "\n")
        program.must_end(self, [*from_files(place), "-dry_run", "-export_matrices", again], 2)
        with open(path) as before, open(os.path.join(again, "s1", "dofs.csv")) as after:
            self.assertEqual(before.read(), after.read())

    def test_a_rigid_motion_needs_no_force(self):
        """Beside the clamped feet: K times a translation is zero at every dof that no foot holds."""
        place = self.export()
        stiffness = self.matrix(place, "s2/stiffness.mtx")
        influence = self.matrix(place, "s2/influence.mtx")
        with open(os.path.join(place, "s2/dofs.csv")) as file:
            rows = [line.split(",") for line in file if line[0] not in "#x"]
        height = numpy.array([float(row[2]) for row in rows])
        force = abs(stiffness @ influence[:, 0]).toarray().ravel()
        above = height > 2.3
        self.assertLess(float(force[above].max() / abs(stiffness).max()), 1e-9)
        contact = self.matrix(place, "s2/contact.mtx")
        self.assertTrue(numpy.allclose((contact @ influence[:, 0]).toarray(), 1))  # all along +x
        probes = self.matrix(place, "s2/probes.mtx")
        self.assertTrue(numpy.allclose((probes @ influence).toarray(),
                                       numpy.tile(numpy.eye(3), (2, 1))))

    def test_a_clamped_group_that_no_element_uses(self):
        """The matrices leave the clamped node out, and the mesh has no element there: nothing is to be clamped."""
        masses = ["-structures", "chain", "-chain_mesh", "tests/meshes/chain.geo", "-chain_first_element", "point_mass",
                  "-chain_first_mass", 5, "-chain_second_element", "point_mass", "-chain_second_mass", 5,
                  "-chain_allow_loose", "true", "-end_time", 1e-3, "-modes", 6]
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        _, whole = program.must_run(self, [*masses, "-chain_support_element", "grounded_spring", "-chain_support_stiffness",
                                           "1e4,2e4,3e4", "-export_matrices", folder])
        read = [*masses, "-chain_matrices", os.path.join(folder, "chain")]
        _, same = program.must_run(self, [*read, "-chain_clamp", "ground"])
        self.assertEqual(*([mode["frequency"] for mode in run["structures"]["chain"]["frequencies"]]
                           for run in (whole, same)))
        program.must_refuse(self, [*read, "-chain_clamp", "grund"], "-chain_clamp", "grund")

    def test_gaps_are_those_of_the_rows(self):
        """One for each row of L, as given: linear across the face between its two numbers."""
        place = self.export()
        contact = self.matrix(place, "s1/contact.mtx")
        table = program.read_csv(os.path.join(place, "s1/gaps.csv"))
        gaps = numpy.array([float(gap) for gap in table["initial_gap"]])
        self.assertEqual(len(gaps), contact.shape[0])
        upper = gaps[numpy.array(table["contact"]) == "floor2"]
        self.assertAlmostEqual(upper.min(), 0.003, delta=1e-12)
        self.assertAlmostEqual(upper.max(), 0.004, delta=1e-12)
        self.assertGreater(gaps.min(), 0)

    def test_a_consistent_mass_is_lumped(self):
        place = os.path.join(self.folder, "consistent")
        shutil.copytree(self.export(), place)
        for name in ("s1", "s2"):
            path = os.path.join(place, name, "mass.mtx")
            lumped = numpy.asarray(scipy.io.mmread(path).todense()).ravel()
            scipy.io.mmwrite(path, scipy.sparse.diags(lumped), symmetry="symmetric", precision=17)
        read = Recorded(self, from_files(place) + ["-end_time", 0.02], identity=IDENTITY)
        assert_follows(self, self.own.displacement("s2_floor2.x"), read.displacement("s2_floor2.x"), 1e-12, "s2_floor2.x")

    def refused(self, change, ranks=1):
        """What the program says of files that `change` spoiled."""
        place = tempfile.mkdtemp(prefix="spoiled-", dir=self.folder)
        shutil.rmtree(place)
        shutil.copytree(self.export(), place)
        change(os.path.join(place, "s2"))
        return program.must_refuse(self, from_files(place) + ["-output", place], ranks=ranks)

    def test_spoiled_files_are_refused(self):
        def rewritten(name, change):
            def spoil(folder):
                path = os.path.join(folder, name)
                with open(path) as file:
                    lines = file.read().splitlines()
                with open(path, "w") as file:
                    file.write("\n".join(change(lines)) + "\n")
            return spoil

        def moved(lines):
            return lines[:2] + ["9,9,9,ux"] + lines[3:]

        def negative(lines):
            entries = [line.split() for line in lines[3:]]
            return lines[:3] + [f"{i} {j} -{v}".replace("--", "") for i, j, v in entries]

        def indefinite(lines):
            """Softer along the slab, by far more than the column below gives."""
            head, entries = lines[:3], [line.split() for line in lines[3:]]
            diagonal = max((e for e in entries if e[0] == e[1]), key=lambda e: float(e[2]))
            diagonal[2] = repr(0.8 * float(diagonal[2]))
            return head + [" ".join(entry) for entry in entries]

        def as_damping(make):
            def spoil(folder):
                stiffness = scipy.sparse.csr_matrix(
                    scipy.io.mmread(os.path.join(folder, "stiffness.mtx")))
                scipy.io.mmwrite(os.path.join(folder, "damping.mtx"), make(stiffness),
                                 symmetry="general", precision=17)
            return spoil

        cases = [
            (lambda folder: os.remove(os.path.join(folder, "mass.mtx")), "neither mass.mtx"),
            (lambda folder: os.remove(os.path.join(folder, "dofs.csv")), "dofs.csv: no such file"),
            (rewritten("dofs.csv", moved), "the mesh of s2 has no node at (9, 9, 9)"),
            (rewritten("dofs.csv", lambda lines: lines[:2] + lines[3:]), "no row for ux"),
            (rewritten("dofs.csv", lambda lines: lines + [lines[-1]]), "more than one row for uz"),
            (rewritten("stiffness.mtx", lambda lines: lines[:-1]), "the file ends too early"),
            (rewritten("stiffness.mtx", lambda lines: ["%%nothing"] + lines[1:]),
             "line 1: expected '%%MatrixMarket"),
            (rewritten("stiffness.mtx", lambda lines: lines[:4] + ["1 2 1e12"] + lines[5:]),
             "stiffness.mtx: row 1, column 2: "),
            (rewritten("stiffness.mtx", negative), "stiffness.mtx: row 1, column 1: -"),
            (rewritten("stiffness.mtx", indefinite), "stiffness.mtx: not positive semidefinite, 1 of"),
            (rewritten("stiffness.mtx",
                       lambda lines: [lines[0].replace("general", "symmetric")] + lines[1:]),
             "a symmetric file holds one triangle only"),
            (lambda folder: shutil.copy(os.path.join(folder, "../s1/damping.mtx"), folder),
             "damping.mtx: "),
            (as_damping(lambda k: -1e-5 * k), "damping.mtx: row 1, column 1: -"),
            (as_damping(lambda k: 1e-5 * (k + scipy.sparse.triu(k, 1))),
             "damping.mtx: row 1, column 2: "),
            (rewritten("stiffness.mtx", lambda lines: lines[:4] + ["1 2 nan"] + lines[5:]),
             "not finite"),
            (rewritten("mass.mtx", lambda lines: lines[:-1] + [lines[-1].split()[0] + " 1 0"]),
             "has no mass"),
        ]
        for change, expected in cases:
            with self.subTest(expected):
                self.assertIn(expected, self.refused(change))
        early = cases[5]
        self.assertIn(early[1], self.refused(early[0], ranks=3))

    def test_totals_of_modes_are_refused(self):
        """They would be those of the elements, whatever the matrices are."""
        place = os.path.join(self.folder, "undamped")
        shutil.copytree(f"{self.export()}/s1", place, ignore=shutil.ignore_patterns("damping*"))
        words = [*ONE_DAMPING, "-s1_matrices", place, "-forces", "base", "-base_structure", "s1", "-base_kind", "reactions",
                 "-end_time", 1e-4]
        program.must_refuse(self, [*words, "-s1_model", "modal", "-s1_modal_vectors", 10], "-base_kind",
                            "forces of modes come from elements", "-s1_model full", ranks=1)

    def test_options_that_do_not_go_together(self):
        for words, expected in (
                (["-s1_matrices", "here", "-s1_mass_scaling", 2e-5], "-s1_matrices"),
                (["-s1_matrices", "nowhere"], "nowhere/dofs.csv"),
                (["-s1_matrices", "x", "-s1_slab_damping_beta", 2e-5],
                 "option -s1_slab_damping_beta 2e-05: would be lost beside -s1_matrices"),
                (["-s1_matrices", "x", "-s1_here_element", "grounded_spring",
                  "-s1_here_stiffness", "0,0,0,0,0,0", "-s1_here_dashpot", "1e4,0,0,0,0,0"],
                 "option -s1_here_dashpot 1e4,0,0,0,0,0: would be lost beside -s1_matrices"),
                (["-s1_matrices", f"{self.export()}/s1", "-s1_model", "modal",
                  "-s1_modal_vectors", 10], "damping.mtx would be lost with -s1_model modal"),
                (["-s1_matrices", "x", "-s1_brace1_tension_only", "true"],
                 "tension_only")):
            with self.subTest(expected):
                program.must_refuse(self, ONE_DAMPING + words + ["-output", self.folder], expected)


ON_RANKS = {"matrices that are read": lambda: [*from_files(written(tempfile.mkdtemp())), "-end_time", 0.02]}


if __name__ == "__main__":
    unittest.main()
