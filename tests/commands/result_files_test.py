"""Result files that commands write: whole or not at all, never through a link, and nothing of a user's is lost."""
import csv
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding import tables  # noqa: E402
from pounding.plot import markup, style  # noqa: E402
from pounding import files, runs, scenes  # noqa: E402


class InFolder(unittest.TestCase):
    def setUp(self):
        self.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        self.precious = self.place / "precious.txt"
        self.precious.write_text("precious")
        self.out = self.place / "out"
        self.out.mkdir()


class Links(InFolder):
    def test_a_link_is_replaced_and_not_followed(self):
        def figure(path):
            style.save(style.plt.figure(), path.parent, path.name, "", "")

        def log(path):
            with unittest.mock.patch.object(runs, "command", lambda words, ranks: ["true"]):
                runs.Job([], path.parent, 1, path.parent, dict(os.environ)).outcome()

        for name, write in (("table.csv", lambda path: tables.write_csv(path, [{"a": 1}])),
                            ("report.html", lambda path: markup.write_page(path, "title", [("part", "content")])),
                            ("figure.png", figure), (runs.LOG, log),
                            ("scene.yaml", lambda path: pounding.write_scene(path, {"end_time": 1})),
                            ("text.md", lambda path: files.write_text(path, "text"))):
            with self.subTest(name):
                path = self.out / name
                path.symlink_to(self.precious)
                write(path)
                self.assertEqual(self.precious.read_text(), "precious")
                self.assertFalse(path.is_symlink())
                self.assertTrue(path.is_file())
        self.assertEqual([path for path in self.out.iterdir() if path.name.startswith(".")], [])

    def test_through_a_command(self):
        run = two_buildings.run(self.place / "a", 1, probes="left_roof", end_time=0.02)
        shutil.copytree(run.folder, self.place / "b")
        names = ("comparison.html", "spectra.csv", "impacts.csv", "peaks.csv", "options.csv", "spectra_left_roof.png")
        for name in names:
            (self.out / name).symlink_to(self.precious)
        done = program.must_do(self, "compare", self.place / "a", self.place / "b", "--out", self.out)
        self.assertEqual(self.precious.read_text(), "precious")
        self.assertEqual([name for name in names if (self.out / name).is_symlink()], [])


class Formulas(InFolder):
    def test_texts_that_a_spreadsheet_would_run_are_texts(self):
        """In every table of the commands; numbers and lists of them stay, and so does a table that the program reads."""
        cells = ["=1+1", "+a", "-x", "@sum", "\t=1", "-1.5", "-0.02,0.03", -2e-5, "a=b", ""]
        for exact in (False, True):
            tables.write_rows(self.out / "table.csv", ["=head", *"abcdefghi"], [cells], exact=exact)
            with open(self.out / "table.csv", newline="") as file:
                head, row = csv.reader(file)
            mark = "" if exact else "'"
            self.assertEqual(head[0], mark + "=head")
            self.assertEqual(row, [*(mark + cell for cell in cells[:5]), *map(str, cells[5:])])
        tables.write_csv(self.out / "table.csv", [{"title": "=cmd|' /C calc'!A0"}])
        self.assertEqual((self.out / "table.csv").read_text(), "title\n'=cmd|' /C calc'!A0\n")


class Names(InFolder):
    def test_names_of_users_stay_in_the_folder(self):
        told = {files.file_name(name) for name in ("a/../../x", "a-..-..-x", "../x", "..", "a b", "a\0b", "é", "a" * 300)}
        self.assertEqual(len(told), 8)
        for name in told:
            self.assertEqual((self.out / name).resolve().parent, self.out.resolve())
        self.assertEqual(files.file_name("spectra_left_roof.png"), "spectra_left_roof.png")

    def test_a_figure_of_a_probe_that_climbs_out(self):
        page, = style.save(style.plt.figure(), self.out, "spectra_a/../../x.png", "title", "")
        self.assertEqual([path.name for path in self.out.iterdir()], [page["file"]])
        self.assertIn("data:image/png", markup.html_figures(self.out, [page]))
        self.assertFalse((self.place / "x.png").exists())


class Kept(InFolder):
    def test_a_scene_that_cannot_be_encoded_leaves_the_old_one(self):
        path = pounding.write_scene(self.place / "scene.yaml", {"title": "old é"})
        for title in ("\ud800", "a\0b", "a\u2028b"):
            with self.assertRaises(scenes.SceneError):
                pounding.write_scene(path, {"title": title})
        self.assertEqual(pounding.read_scene(path), {"title": "old é"})

    def test_what_fails_half_way_leaves_the_old_file(self):
        path = self.out / "table.csv"
        path.write_text("old")
        with self.assertRaises(TypeError):
            with files.written_beside(path) as draft:
                draft.write_text("half")
                raise TypeError
        self.assertEqual([one.name for one in self.out.iterdir()], ["table.csv"])
        self.assertEqual(path.read_text(), "old")

    def test_a_full_disk_leaves_no_half_of_a_new_scene(self):
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        line = [os.path.join(program.SOURCE, "run", "new"), "two-buildings", str(self.place / "deep" / "mine")]
        done = subprocess.run(line, capture_output=True, text=True, preexec_fn=small, timeout=60, check=False)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        self.assertFalse((self.place / "deep").exists())
        done = subprocess.run(line, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path.name for path in (self.place / "deep" / "mine").iterdir()},
                         {path.name for path in two_buildings.FOLDER.iterdir()})

    def test_only_what_a_run_wrote_is_cleared(self):
        for name in ("summary.json", "history.h5", "log.txt", "notes.txt"):
            (self.out / name).write_text("")
        (self.out / "figures").mkdir()
        (self.out / "resolved.yaml").write_text("end_time: 1\n# Files of results: resolved.yaml summary.json history.h5 own.csv\n")
        runs.clear(self.out)
        self.assertEqual({path.name for path in self.out.iterdir()}, {"notes.txt", "figures"})

    def test_tables_that_no_reader_knows_are_read(self):
        (self.out / "resolved.yaml").write_text("end_time: 1\n# Files of results: own.csv impacts.csv\n")
        (self.out / "own.csv").write_text("time,momentum\n0,1.5\n1,2.5\n")
        result = pounding.load(self.out)
        self.assertEqual(list(result.table("own")["momentum"]), [1.5, 2.5])
        self.assertEqual(result.table("impacts"), {})


if __name__ == "__main__":
    unittest.main()
