"""A run of the program with all that it recorded."""
import os
import shutil
import tempfile

import h5py
import numpy

import program
import scenes  # noqa: F401  (for the tests of this folder)


class History:
    """`data`: the data sets of history.h5 by name; `summary`; `impacts`: columns of impacts.csv."""

    def __init__(self, test, words, ranks=1, timeout=900):
        folder, self.summary = program.must_run(test, words, ranks, timeout)
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            self.data = {name: file[name][()] for name in file}
        self.impacts = program.read_csv(os.path.join(folder, "impacts.csv"))
        self.ledger = program.read_csv(os.path.join(folder, "energy.csv"))
        self.spectra = program.read_csv(os.path.join(folder, "spectra.csv"))
        shutil.rmtree(folder)
        self.time = self.data["time"]
        self.energy = self.summary["energy"]
        self._place = {name.decode(): i for i, name in enumerate(self.data["channels"])}

    def channel(self, quantity, name):
        """A column of displacement, velocity or acceleration: "probe.x"."""
        return self.data[quantity][:, self._place[name]]

    def column(self, name):
        """A column of impacts.csv as numbers."""
        return numpy.array([float(value) for value in self.impacts[name]])


def refused(test, words, *expected, ranks=1):
    """A refused run that leaves neither a summary nor a number that is not finite; returns its line."""
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "results")
        line = program.must_refuse(test, [*words, "-output", output], *expected, ranks=ranks, timeout=300)
        test.assertFalse(os.path.exists(os.path.join(output, "summary.json")))
        assert_finite(test, output)
        return line


def assert_finite(test, folder):
    """No file that a stopped run left holds a value that is not a number."""
    for name in os.listdir(folder) if os.path.isdir(folder) else ():
        path = os.path.join(folder, name)
        if name.endswith(".csv"):
            with open(path) as file:
                words = file.read().replace(",", " ").lower().split()
            for word in ("nan", "-nan", "inf", "-inf"):
                test.assertNotIn(word, words, name)
        elif name.endswith(".h5") and h5py.is_hdf5(path):
            with h5py.File(path, "r") as file:
                for key in file:
                    if file[key].dtype.kind == "f":
                        test.assertTrue(numpy.isfinite(file[key][()]).all(), key)
