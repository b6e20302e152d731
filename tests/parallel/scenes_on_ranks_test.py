"""One motion on 1, 2 and 3 ranks, for every feature: the scenes are the dictionaries ON_RANKS of the other tests, beside
the problems that they are of. An entry is a name with the words of a run, or with a function that gives them; or with a
pair of it and options of `Alike`."""
import importlib
import pathlib
import shutil
import sys
import unittest

import h5py
import numpy

import program

TESTS = pathlib.Path(program.SOURCE, "tests")
TOLERANCE = 1e-12  # of the largest value of a record
LEDGER = 1e-10  # of the largest term of the ledger at the end, which sums all steps
CHEAP = ["-modes", 1, "-spectra_frequencies", 10]


def module_of(path):
    sys.path.insert(0, str(path.parent))
    return importlib.import_module(path.stem)


def scenes():
    """Name, words and options of every scene."""
    for path in sorted(TESTS.glob("*/*_test.py")):
        if "\nON_RANKS = {" not in path.read_text():
            continue
        for name, entry in module_of(path).ON_RANKS.items():
            words, options = entry if isinstance(entry, tuple) else (entry, {})
            yield f"{path.stem}: {name}", words() if callable(words) else words, Alike(**options)


class Alike:
    """How closely runs of a scene agree: `until` a time [s] where contact chatters behind it, whose closures then hang on
    round-off, with a `tolerance` of its own where round-off grows for a reason that the entry says, on `ranks`.
    Where they agree to the end, so do the ledger and the number of impacts."""

    def __init__(self, until=numpy.inf, tolerance=TOLERANCE, ranks=(1, 2, 3)):
        self.until, self.tolerance, self.ranks = until, tolerance, ranks

    def check(self, test, words):
        runs, summaries = {}, {}
        for ranks in self.ranks:
            folder, summaries[ranks] = program.must_run(test, [*CHEAP, *words], ranks)
            with h5py.File(pathlib.Path(folder, "history.h5")) as file:
                count = len(file["time"])
                runs[ranks] = {name: numpy.nan_to_num(file[name][()]) for name in file
                               if file[name].dtype.kind == "f" and file[name].size and len(file[name]) == count}
            shutil.rmtree(folder)
        one = runs[self.ranks[0]]
        rows = one["time"] <= self.until
        test.assertTrue(any(values[rows].any() for name, values in one.items() if name != "time"), "nothing moves")
        for ranks, records in runs.items():
            test.assertEqual(records.keys(), one.keys())
            numpy.testing.assert_array_equal(records["time"], one["time"])
            for name, values in one.items():
                apart = abs(records[name][rows] - values[rows]).max()
                scale = abs(values[rows]).max()
                test.assertLessEqual(apart, self.tolerance * scale, f"{name} on {ranks} ranks, of {scale:.3g}")
            if rows.all():
                self.check_end(test, summaries[self.ranks[0]], summaries[ranks])

    def check_end(self, test, one, other):
        terms = {name: value for name, value in one["energy"].items() if name != "relative_residual"}
        largest = max(map(abs, terms.values()))
        for name, value in terms.items():
            test.assertLessEqual(abs(other["energy"][name] - value), max(LEDGER, self.tolerance) * largest, f"{name} of the ledger")
        test.assertEqual(other["impacts"].get("episodes"), one["impacts"].get("episodes"))


class OnRanks(unittest.TestCase):
    def test_every_scene_moves_alike(self):
        count = 0
        for name, words, alike in scenes():
            count += 1
            with self.subTest(name):
                alike.check(self, words)
        self.assertGreater(count, 0)


if __name__ == "__main__":
    unittest.main()
