"""One run of the program with all that it recorded, for the verification problems."""
import csv
import json
import os
import shutil
import unittest

import h5py
import numpy

import program

FIXTURES = os.path.join(program.SHARED, "fixtures")
needs_fixtures = unittest.skipUnless(os.path.isdir(FIXTURES), "the reference data are not here")


def fixture(name):
    """A JSON file of the reference data."""
    with open(os.path.join(FIXTURES, name)) as file:
        return json.load(file)


def golden(name):
    """Columns of a CSV file of the reference data."""
    with open(os.path.join(FIXTURES, name)) as file:
        rows = list(csv.DictReader(file))
    return {key: numpy.array([float(row[key]) for row in rows]) for key in rows[0]}


def lumped_fractions(positions):
    """Share of each node in the lumped mass of a brick meshed with equal hexahedra."""
    share = numpy.ones(len(positions))
    for axis in range(3):
        x = positions[:, axis]
        share[(x < x.min() + 1e-9) | (x > x.max() - 1e-9)] /= 2
    return share / share.sum()


class Recorded:
    """Histories at every sample: time, displacement, velocity half a step later, contact force."""

    def __init__(self, test, arguments, ranks=2):
        cheap = ["-modes", 1, "-spectra_frequencies", 10]
        folder, self.summary = program.must_run(test, list(arguments) + cheap, ranks)
        self.time_step = self.summary["time_step"]
        self.energy = self.summary["energy"]
        self.impacts = program.read_csv(os.path.join(folder, "impacts.csv"))
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            data = {name: file[name][()] for name in file}
        shutil.rmtree(folder)
        self.time = data["time"]
        self.contacts = [name.decode() for name in data["contacts"]]
        self._force = data.get("contact_force")
        self._place = {name.decode(): i for i, name in enumerate(data["channels"])}
        self._displacement = data.get("displacement")
        self._velocity = data.get("velocity")

    def force(self, contact):
        return self._force[:, self.contacts.index(contact)]

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

    def plateau(self, contact, start, end):
        """Mean force between two times."""
        inside = (self.time > start) & (self.time < end)
        return self.force(contact)[inside].mean()


def all_nodes(probe, structure, group="body"):
    """Options that record every node of a group on its own."""
    return [f"-{probe}_structure", structure, f"-{probe}_group", group, f"-{probe}_average", "false"]


def assert_follows(test, found, reference, tolerance, label):
    """Two histories differ by at most `tolerance` times the largest reference value."""
    test.assertGreaterEqual(len(found), len(reference), label)
    scale = abs(reference).max()
    test.assertGreater(scale, 0, label)
    test.assertLessEqual(abs(found[:len(reference)] - reference).max(), tolerance * scale, label)
