"""Damaged results and broken arguments: every command says one line and ends with status 1 or 2."""
import copy
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np
import program
import two_buildings

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.compare import page, runs, tables  # noqa: E402
from pounding.fragility import study  # noqa: E402
from pounding.sweep import members, table  # noqa: E402
from pounding.tradeoff.runs import Outcome  # noqa: E402
from pounding.study import understood  # noqa: E402
from pounding import UserError, results  # noqa: E402

WRONG = (None, 5, -1, "x", [], {}, [1, 2], {"a": 1}, True)
REFUSED = (results.ResultError, UserError)


def places_of(values, place=()):
    """Places of all values in nested mappings and lists, of a list the first."""
    inside = values.items() if isinstance(values, dict) else enumerate(values[:1]) if isinstance(values, list) else ()
    for key, value in inside:
        yield (*place, key)
        yield from places_of(value, (*place, key))


class Damaged(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        cls.sound = two_buildings.run(cls.place / "sound", 1, gap=0.01, probes="left_roof", end_time=0.05, modes=2,
                                      output_interval=1e-3)
        cls.summary = json.loads((cls.place / "sound" / "summary.json").read_text())

    def setUp(self):
        self.spoilt = self.place / "spoilt"
        shutil.rmtree(self.spoilt, ignore_errors=True)
        shutil.copytree(self.place / "sound", self.spoilt)

    def use(self):
        """What sweep, compare and tradeoff do with a folder."""
        with understood(self.spoilt):
            table.row_of([], members.Member("m", (), ()), results.load(self.spoilt), "")
            found = runs.read([self.place / "sound", self.spoilt])
            page.text(found)
            tables.spectra(found)
            Outcome(self.spoilt, ("x", "y", "z")).moving()
            repr(results.load(self.spoilt))

    def test_summaries_of_another_shape(self):
        for number, place in list(enumerate(places_of(self.summary)))[::2]:
            spoilt = copy.deepcopy(self.summary)
            inside = spoilt
            for key in place[:-1]:
                inside = inside[key]
            if number % (len(WRONG) + 1) == len(WRONG):
                del inside[place[-1]]
            else:
                inside[place[-1]] = WRONG[number % (len(WRONG) + 1)]
            (self.spoilt / "summary.json").write_text(json.dumps(spoilt))
            try:
                self.use()
            except REFUSED as error:
                self.assertEqual(len(str(error).splitlines()), 1)
        for text in ("[]", "5", "{", "", "\0", "[" * 5000, '{"structures": 5}', '{"probes": {"a": 3}}'):
            (self.spoilt / "summary.json").write_text(text)
            self.assertRaises(results.ResultError, results.load, self.spoilt)
        for make in (os.mkfifo, os.mkdir):
            (self.spoilt / "summary.json").unlink()
            make(self.spoilt / "summary.json")
            self.assertRaises(results.ResultError, results.load, self.spoilt)
        self.assertRaises(UserError, study.read, Path("/dev/zero"))

    def test_tables_that_are_cut_or_hold_no_numbers(self):
        for name in ("spectra.csv", "impacts.csv", "energy.csv"):
            whole = (self.place / "sound" / name).read_text()
            lines = whole.splitlines()
            for text in ("", whole[:len(whole) // 2] if name == "spectra.csv" else ",\n", "a,b\n1\n", "\0\n", "a\n\xff\n",
                         "\n".join([lines[0], "x," * lines[0].count(",") + "x"]),
                         *(["\n".join(lines[:len(lines) - 5])] if name == "spectra.csv" else [])):
                with self.subTest(name, text=text[:40]):
                    (self.spoilt / name).write_bytes(text.encode("latin-1"))
                    self.assertRaises(results.ResultError, results.load, self.spoilt)
            (self.spoilt / name).write_text(whole)
        self.use()

    def test_histories_that_are_damaged(self):
        def change(name, values):
            with h5py.File(self.spoilt / "history.h5", "r+", locking=False) as file:
                del file[name]
                if values is not None:
                    file[name] = values
        path = self.spoilt / "history.h5"
        whole = (self.place / "sound" / "history.h5").read_bytes()
        for size in (0, 100, 3000, len(whole) // 2):
            path.write_bytes(whole[:size])
            self.assertRaises(results.ResultError, results.load, self.spoilt)
        for name, values in (("time", None), ("time", 5.0), ("time", np.zeros((3, 2))), ("time", [b"a"]),
                             ("channels", 3), ("channels", [1.0, 2.0]), ("records", -5), ("records", 10**9),
                             ("records", [b"x"]), ("displacement", 1.0), ("gap", [b"a", b"b"]),
                             ("acceleration", np.zeros((2, 2)))):
            with self.subTest(name, values=str(values)[:20]):
                path.write_bytes(whole)
                change(name, values)
                self.assertRaises(results.ResultError, results.load, self.spoilt)

    def test_what_is_not_there_is_told_by_name(self):
        for call, words in ((lambda: self.sound.spectrum("cab", "z"), "left_roof"),
                            (lambda: self.sound.spectrum("left_roof", "x", 0.3), "0.05"),
                            (lambda: self.sound.series("displacement", "cab", "x"), "left_roof.x"),
                            (lambda: self.sound.force("base.Fx"), "none")):
            with self.assertRaisesRegex(results.ResultError, words):
                call()
        self.assertLess(len(repr(self.sound)), 300)
        self.assertIn("left_roof", repr(self.sound))


class Arguments(unittest.TestCase):
    """Commands as they are typed."""

    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        (cls.place / "odd").mkdir()
        (cls.place / "odd" / "summary.json").write_text('{"structures": 5}')
        (cls.place / "cut").mkdir()
        (cls.place / "cut" / "history.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))

    def refused(self, part, *words):
        done = program.command(*words)
        self.assertIn(done.returncode, (1, 2), done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        self.assertIn(part, done.stderr.splitlines()[-1])
        self.assertIn("run/", done.stderr.splitlines()[-1])

    def test_commands(self):
        scene = two_buildings.SCENE
        for part, words in (("no closing quotation", ("sweep", scene, "--set", "end_time=1", "--options", "-a '")),
                            ("no closing quotation", ("plant", "--options", '"')),
                            ("not finite", ("plant", "--seconds", "inf")),
                            ("is not above 0", ("tradeoff", "--scene", scene, "--estimate", 0)),
                            ("structures is not a mapping", ("plot", self.place / "odd")),
                            ("structures is not a mapping", ("compare", self.place / "odd", self.place / "cut")),
                            ("history.h5 cannot be read", ("plot", self.place / "cut")),
                            ("no study", ("fragility", self.place / "no study"))):
            with self.subTest(words[0], part=part):
                self.refused(part, *words)

    def test_interrupted_while_it_is_made_ready(self):
        for wait in (0.1, 0.3):
            job = subprocess.Popen([os.path.join(program.SOURCE, "run", "sweep"), "nothing", "--set", "a=1"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(wait)
            job.send_signal(signal.SIGINT)
            said = job.communicate(timeout=60)[1]
            if job.returncode != -signal.SIGINT:  # before Python itself was ready
                self.assertEqual((job.returncode, len(said.splitlines())), (1, 1), said)


class Studies(unittest.TestCase):
    SOUND = ("scene: {scene}\nmotions: {{x: {{target: {target}, seeds: [1, 2]}}}}\nlevels: [2, 5]\ngaps: [0.01]\n"
             "joints: {{floor1: {{}}}}\n")

    def read(self, *more, **changes):
        text = self.SOUND.format(scene=two_buildings.SCENE, target=two_buildings.FOLDER / "ground.csv")
        for key, value in changes.items():
            text = "".join(line for line in text.splitlines(True) if not line.startswith(f"{key}:"))
            text += f"{key}: {value}\n"
        with tempfile.TemporaryDirectory() as place:
            path = Path(place) / "study.yaml"
            path.write_text("\n".join([text, *more]))
            return study.read(path)

    def test_values_of_another_shape(self):
        self.read()
        for key in study.KEYS:
            for value in ("5", "abc", "[1, [2]]", "{a: 1}", "[]", "{}", "true", ".nan", ".inf", "-1", "2026-99-99", "''"):
                with self.subTest(key, value=value):
                    try:
                        self.read(**{key: value})
                    except UserError as error:
                        self.assertEqual(len(str(error).splitlines()), 1)
        for text in ("levels: [3]", "? [1]\n: 2", "a: &a [*a]", "\0", "x: !!python/object:os.system {}"):
            self.assertRaises(UserError, self.read, text)
        for key, value, part in (("capacities", "5", "no list"), ("show", "abc", "no list of keys"),
                                 ("show", "{gap: 3}", "none of the study's"), ("gaps", "[40]", "gaps are in m"),
                                 ("samples", "1000000000", "more than"), ("levels", "[.nan]", "levels")):
            with self.assertRaisesRegex(UserError, part):
                self.read(**{key: value})

    def test_what_may_be_meant_otherwise_is_doubted(self):
        self.assertEqual(study.doubts(self.read()), [])
        for key, value, part in (("levels", "[0.05, 0.1]", "0.1 g would be 0.981"), ("levels", "[100, 200]", "cm/s2"),
                                 ("gaps", "[0.01, 2]", "a joint of 2 m")):
            self.assertIn(part, " ".join(study.doubts(self.read(**{key: value}))))

    def test_names_that_the_scene_has_not(self):
        one = {"probe": "cab", "direction": "x", "band": "1,2", "acceleration": 1}
        for changes, part in (({}, "floor1 is no contact of the scene; it has roof"),
                              ({"joints": "{roof: {}}", "capacities": f"[{json.dumps(one)}]"}, "'cab' is no probe"),
                              ({"joints": "{roof: {}}", "show": "{channel: cab x}"}, "'cab x' is none of the scene's")):
            with self.assertRaisesRegex(UserError, part):
                study.check_names(self.read(**changes), ["top"], ["roof"])


if __name__ == "__main__":
    unittest.main()
