"""One run of the program with all that it recorded, for the verification problems."""
import csv
import math
import os
import shutil
import tempfile

import h5py
import numpy

import program
from program import write_samples


def reference(name):
    """Columns of a CSV file of tests/references: numbers where every value is one, else text."""
    with open(os.path.join(program.SOURCE, "tests", "references", name)) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    columns = {}
    for key in rows[0]:
        try:
            columns[key] = numpy.array([float(row[key]) for row in rows])
        except ValueError:
            columns[key] = numpy.array([row[key] for row in rows])
    return columns


def write_sine(amplitude, frequency, end, step=1e-4):
    """A record amplitude sin(2 pi frequency t) [m/s2] in a file of its own, which is returned."""
    count = round(end / step) + 1
    return write_samples([amplitude * math.sin(2 * math.pi * frequency * i * step) for i in range(count)], step)


def lumped_fractions(positions):
    """Share of each node in the lumped mass of a brick meshed with equal hexahedra."""
    share = numpy.ones(len(positions))
    for axis in range(3):
        x = positions[:, axis]
        share[(x < x.min() + 1e-9) | (x > x.max() - 1e-9)] /= 2
    return share / share.sum()


# The energy identity of the scheme is exact: what is left is round-off, over the largest term.
IDENTITY = 1e-12
NOTHING = 1e-15  # J: a body at rest has no energy to compare with
# Where a fine bar moves as a whole by far more than it deforms, K times that motion is zero but for
# round-off, which does work over the flight. Measured: 1e-11 with 400 elements.
IDENTITY_OF_A_FLIGHT = 2e-11


class Recorded:
    """Histories at every sample: time, displacement, velocity half a step later, contact force.

    Every run must close the energy identity. Arguments win over the cheap settings made here.
    """

    def __init__(self, test, arguments, ranks=program.RANKS, identity=IDENTITY):
        cheap = ["-modes", 1, "-spectra_frequencies", 10]
        folder, self.summary = program.must_run(test, cheap + list(arguments), ranks)
        self.time_step = self.summary["time_step"]
        self.energy = self.summary["energy"]
        if max(abs(value) for name, value in self.energy.items()
               if name != "relative_residual") > NOTHING:
            test.assertLessEqual(self.energy["relative_residual"], identity, "energy identity")
        self.impacts = program.read_csv(os.path.join(folder, "impacts.csv"))
        self._spectra = program.read_csv(os.path.join(folder, "spectra.csv"))
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            data = {name: file[name][()] for name in file}
        shutil.rmtree(folder)
        self.time = data["time"]
        self.contacts = [name.decode() for name in data["contacts"]]
        self._force = data.get("contact_force")
        self._gap = data.get("gap")
        self._place = {name.decode(): i for i, name in enumerate(data["channels"])}
        self._displacement = data.get("displacement")
        self._velocity = data.get("velocity")
        self._members = {name.decode(): data["force"][:, i] for i, name in enumerate(data.get("forces", []))}

    def members(self, item):
        """What `forces` records of an item, shape (samples, columns)."""
        return numpy.stack([values for name, values in self._members.items() if name.split(".")[0] == item], 1)

    def force(self, contact):
        return self._force[:, self.contacts.index(contact)]

    def gap(self, contact):
        """The smallest gap of a contact [m]."""
        return self._gap[:, self.contacts.index(contact)]

    def displacement(self, channel):
        return self._displacement[:, self._place[channel]]

    def velocity(self, channel):
        return self._velocity[:, self._place[channel]]

    def column(self, name):
        """A column of impacts.csv as numbers."""
        return numpy.array([float(value) for value in self.impacts[name]])

    def nodes(self, probe):
        """Positions of the nodes of a probe that is not averaged, and its channels' stems."""
        names = [f"{probe}.{i + 1}" for i in range(len(self.summary["probes"]))]
        names = [name for name in names if name in self.summary["probes"]]
        positions = [self.summary["probes"][name]["position"] for name in names]
        return numpy.array(positions), names

    def mean_velocity(self, probe, direction):
        """Velocity of the centre of mass of a brick, all of whose nodes a probe records."""
        positions, names = self.nodes(probe)
        columns = [self._place[f"{name}.{direction}"] for name in names]
        return self._velocity[:, columns] @ lumped_fractions(positions)

    def bar_velocity(self, whole, ends, cells, direction):
        """Velocity of the centre of mass of a bar of equal cells along it, of one motion per
        section: from averaged probes, of all of its nodes and of its two ends of half the mass."""
        end = sum(self.velocity(f"{probe}.{direction}") for probe in ends) / 2
        return ((cells + 1) * self.velocity(f"{whole}.{direction}") - end) / cells

    def spectrum(self, probe, direction, damping=0.05):
        """Frequencies [Hz] and pseudo-accelerations [m/s2] of the program's own spectrum."""
        table = self._spectra
        rows = [i for i, name in enumerate(table["probe"]) if name == probe and
                table["direction"][i] == direction and float(table["damping"][i]) == damping]
        return tuple(numpy.array([float(table[column][i]) for i in rows])
                     for column in ("frequency", "pseudo_acceleration"))

    def plateau(self, contact, start, end):
        """Mean force between two times."""
        inside = (self.time > start) & (self.time < end)
        return self.force(contact)[inside].mean()


def ensemble_of(test, words, column, values):
    """Peaks of displacement of the members that differ in one option, and residuals of their ledgers."""
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        table = os.path.join(folder, "members.csv")
        with open(table, "w") as file:
            file.write("\n".join([column, *map(str, values)]) + "\n")
        result = program.must_end(test, [*words, "-ensemble", table, "-output", os.path.join(folder, "results")])
        with h5py.File(os.path.join(folder, "results", "ensemble.h5")) as file:
            return file["peaks/displacement"][()], file["energy/residual"][()]


def all_nodes(probe, structure, group="body"):
    """Options that record every node of a group on its own."""
    return [f"-{probe}_structure", structure, f"-{probe}_group", group, f"-{probe}_average", "false"]


def assert_follows(test, found, reference, tolerance, label):
    """Two histories differ by at most `tolerance` times the largest reference value."""
    test.assertGreaterEqual(len(found), len(reference), label)
    scale = abs(reference).max()
    test.assertGreater(scale, 0, label)
    test.assertLessEqual(abs(found[:len(reference)] - reference).max() / scale, tolerance, label)


def assert_continues(test, arguments, stop, checkpoint, ranks=program.RANKS):
    """A run that stops at a time, with its last checkpoint at a step, and is continued from there leaves what the
    uninterrupted one leaves: every field of the history to the last bit, impacts and the end of the ledger. Returns the
    summaries of both."""
    folder, whole_summary = program.must_run(test, arguments, ranks)
    test.addCleanup(shutil.rmtree, folder)
    with tempfile.TemporaryDirectory() as cut:
        for more in (["-end_time", stop, "-checkpoint_steps", checkpoint],
                     ["-restart", os.path.join(cut, "checkpoint.h5")]):
            result = program.must_end(test, ["-csv_digits", 17, *arguments, *more, "-output", cut], ranks)
        with h5py.File(os.path.join(folder, "history.h5")) as whole, \
                h5py.File(os.path.join(cut, "history.h5")) as continued:
            for name in ("displacement", "velocity", "acceleration", "contact_force", "link_elongation", "link_force",
                         "force"):
                if name in whole:
                    test.assertTrue(numpy.array_equal(whole[name][()], continued[name][()]), name)
        lines = {}
        for name in ("impacts.csv", "energy.csv"):
            for place in (folder, cut):
                with open(os.path.join(place, name)) as file:
                    lines[place, name] = [line for line in file if not line.startswith("#")]
        test.assertEqual(lines[folder, "impacts.csv"], lines[cut, "impacts.csv"])
        test.assertEqual(lines[folder, "energy.csv"][-3:], lines[cut, "energy.csv"][-3:])
        return whole_summary, program.summary(cut)
