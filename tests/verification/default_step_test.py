"""The time step that is chosen where none is given: it resolves what vibrates, within 0.3 % of its frequency.

Masses on springs, one of 2 Hz along x, y and z: 7.96 mm and 20 cycles in 10 s from 0.1 m/s, and others with a fast
direction. The step is the shorter one of 0.9 of the stable one, 2 / omega_max, and of 0.268 / omega, omega that of the
highest mode not above the last frequency of the spectra, or of that frequency where the modes do not reach it.
"""
import math
import os
import re
import tempfile
import unittest

import h5py
import numpy

import program
from decks import box_of, in_modes, material, probes

MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
0 1 "m"
0 2 "k"
$EndPhysicalNames
$Nodes
1
1 0 0 0
$EndNodes
$Elements
2
1 15 2 1 1 1
2 15 2 2 2 1
$EndElements
"""
MASS, SPEED = 100.0, 0.1


def stiffness(*frequencies):
    return ",".join(repr(MASS * (2 * math.pi * f) ** 2) for f in frequencies)


class Oscillators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-step-")
        cls.mesh = os.path.join(cls.folder, "point.msh")
        with open(cls.mesh, "w") as file:
            file.write(MESH)

    def words(self, frequencies, *more, end_time=10):
        return ["-structures", "a", "-a_mesh", self.mesh, "-a_m_element", "point_mass", "-a_m_mass", MASS,
                "-a_k_element", "grounded_spring", "-a_k_stiffness", stiffness(*frequencies), "-a_initial_velocity",
                f"{SPEED},0,0", *probes(p="a@0,0,0"), "-modes", 3, "-end_time", end_time, *more]

    def step(self, frequencies, *more, said=None):
        """The step of a dry run, which also says whence it is."""
        done = program.must_end(self, self.words(frequencies, *more, "-dry_run"))
        if said:
            self.assertIn(said, done.stdout)
        return float(re.search(r"(?:^|; )time step (\S+) s", done.stdout, re.M).group(1))

    @staticmethod
    def doubts(summary):
        return [line for line in summary["warnings"] if line.startswith("the time step")]

    def test_two_hertz_swing_as_far_and_as_often_as_they_should(self):
        reduced = [*in_modes("a", 3), "-output_interval", 0.05]
        for more in ([], ["-modes", 0], reduced):
            folder, summary = program.must_run(self, self.words((2, 2, 2), *more))
            with h5py.File(os.path.join(folder, "history.h5")) as file:
                x = file["displacement"][:, 0]
            self.assertAlmostEqual(summary["time_step"] / (0.268 / (4 * math.pi)), 1, delta=1e-5)
            self.assertAlmostEqual(abs(x).max() / (SPEED / (4 * math.pi)), 1, delta=0.01)
            self.assertAlmostEqual(numpy.count_nonzero(numpy.diff(numpy.sign(x[x != 0]))), 40, delta=1)
            self.assertIn("2 Hz, the highest mode of a up to 400 Hz", summary["time_step_source"])
            self.assertEqual(self.doubts(summary), [])

    def test_what_bounds_it(self):
        stable = 0.9 / (math.pi * 500)
        self.assertAlmostEqual(self.step((2, 2, 500), said="set by the stable one, -courant 0.9") / stable, 1, delta=2e-3)
        # One mode of three: what lies between 2 and 400 Hz is not known.
        last = 0.268 / (2 * math.pi * 400)
        self.assertAlmostEqual(self.step((2, 2, 500), "-modes", 1, said="400 Hz, the last of -spectra_frequencies") / last,
                               1, delta=1e-5)
        ends = 0.268 / (2 * math.pi * 100)
        self.assertAlmostEqual(self.step((2, 2, 500), "-modes", 0, "-spectra_frequencies", "1,100") / min(stable, ends), 1,
                               delta=2e-3)
        self.assertAlmostEqual(self.step((2, 5, 500), "-spectra_frequencies", "1,4", "-courant", 0.99,
                                         said="-courant 0.99") / (stable * 1.1), 1, delta=2e-3)
        # Where every mode is faster than the spectra reach, these are resolved.
        self.assertAlmostEqual(self.step((500, 500, 500)) / last, 1, delta=1e-5)

    def test_histories_of_loads_bound_it(self):
        """One of 40 Hz on 2 Hz; a triangle of 10 ms, which is a quarter of the step for 2 Hz; a blast that is there at once."""
        push = ["-loads", "push", "-push_on", "a:m", "-push_force", "100,0,0"]
        for more, frequency in ((["-push_function", "harmonic", "-push_frequency", 40], 40),
                                (["-push_values", "0,0;0.1,0;0.105,1;0.11,0"], 100),
                                (["-push_values", "0,1;0.01,0"], 100),
                                # a plateau whose ends are all but steep; noise of digits; sets in too late
                                (["-push_values", "0,0;0.2,0;0.200001,1;0.249999,1;0.25,0"], 10),
                                (["-push_values", "0,0;0.05,1;0.0501,0.999;0.0502,1;0.1,0"], 10)):
            with self.subTest(more=more):
                expected = 0.268 / (2 * math.pi * frequency)
                step = self.step((2, 2, 2), *push, *more, said="Hz, the fastest part of load push")
                self.assertAlmostEqual(step / expected, 1, delta=5e-3)
        slow = 0.268 / (4 * math.pi)
        for more in (["-push_function", "ramp", "-push_rise", 1e-3], ["-push_values", "0,0;20,0;20.001,1;20.002,0"],
                     ["-push_function", "harmonic", "-push_frequency", 40, "-push_start", 20],
                     ["-push_values", "0,1;0.01,0", "-preload", "static"]):
            self.assertAlmostEqual(self.step((2, 2, 2), *push, *more) / slow, 1, delta=1e-5)
        # The largest of two equal kicks is 1 over the frequency beside a short blast: I / (m omega).
        run = program.must_run(self, self.words((2, 2, 2), *push, "-push_values", "0,0;0.1,0;0.105,1e3;0.11,0", "-a_initial_velocity",
                                                "0,0,0", end_time=1))[0]
        with h5py.File(os.path.join(run, "history.h5")) as file:
            x = abs(file["displacement"][:, 0]).max()
        self.assertAlmostEqual(x / (100 * 1e3 * 0.005 / (MASS * 4 * math.pi)), 1, delta=0.01)
        line, = self.doubts(program.must_run(self, self.words((2, 2, 2), *push, "-push_function", "harmonic", "-push_frequency", 40,
                                                              "-time_step", 0.02, end_time=1))[1])
        self.assertIn("makes 40 Hz, the fastest part of load push", line)

    def test_dashpots_in_series_with_springs_bound_it(self):
        """A mass on 2 Hz and, through a dashpot, on 16 Hz: with the dashpot stiff it swings at the two together."""
        k = MASS * (2 * math.pi * 16) ** 2
        words = self.words((2, 2, 2), "-a_k_dashpot", ",".join([repr(k / 10)] * 3), "-a_k_dashpot_stiffness",
                           ",".join([repr(k)] * 3), "-spectra_frequencies", "1,4", "-output_interval", 1e-3, end_time=1)
        found = []
        for more in ([], ["-time_step", 1e-4]):
            folder, summary = program.must_run(self, [*words, *more])
            with h5py.File(os.path.join(folder, "history.h5")) as file:
                found.append(abs(file["displacement"][:, 0]).max())
            if not more:
                self.assertAlmostEqual(summary["time_step"] * 2 * math.pi * 16.1 / 0.268, 1, delta=0.1)
        self.assertAlmostEqual(found[0] / found[1], 1, delta=0.02)

    def test_a_longer_step_is_doubted(self):
        folder, summary = program.must_run(self, self.words((2, 2, 2), "-time_step", 0.05, end_time=1))
        line, = self.doubts(summary)
        for part in ("the time step 0.05 s makes 2 Hz, the highest mode of a up to 400 Hz, 1.64 % too high",
                     "none up to 0.853 Hz by more than 0.3 %", "give -time_step 0.0213 or less"):
            self.assertIn(part, line)
        self.assertEqual(summary["time_step_source"], "as -time_step gives it")
        folder, summary = program.must_run(self, self.words((2, 2, 2), "-time_step", 0.0213, end_time=1))
        self.assertEqual(self.doubts(summary), [])

    def test_members_of_an_ensemble_take_the_step_of_the_fastest(self):
        table = os.path.join(self.folder, "members.csv")
        with open(table, "w") as file:
            file.write("a_stiffness_factor\n1\n4\n")
        reduced = [*in_modes("a", 3), "-output_interval", 0.05, "-ensemble", table]
        step = self.step((2, 2, 2), *reduced, said="4 Hz, the highest mode of a up to 400 Hz")
        self.assertAlmostEqual(step / (0.268 / (8 * math.pi)), 1, delta=1e-5)


THROWN = ["-structures", "bar", *box_of("bar", "x0=0", "soft"), "-bar_clamp", "x_min", *material("soft", 1e6, 0, 1000),
          "-bar_initial_velocity", "0.05,0,0", *probes(foot="bar:x_min", face="bar:x_max"), "-end_time", 0.01,
          "-output_interval", 5e-5]


class StartOfRecords(unittest.TestCase):
    """A structure that starts with a velocity: what is held there has none, so no acceleration either."""

    def test_held_nodes_do_not_stop(self):
        for more in ([], in_modes("bar", 12)):
            folder, summary = program.must_run(self, THROWN + more)
            with h5py.File(os.path.join(folder, "history.h5")) as file:
                names = [name.decode() for name in file["channels"]]
                first = file["acceleration"][0]
            self.assertEqual(abs(first[[names.index(f"foot.{d}") for d in "xyz"]]).max(), 0)
            # The other face is braked by its spring alone, from nothing on.
            self.assertLess(abs(first[names.index("face.x")]), 1)
            self.assertEqual(max(summary["probes"]["foot"]["sampled_peak_acceleration"]), 0)


ON_RANKS = {"a step that the program chooses": [*THROWN, "-end_time", 0.5]}


if __name__ == "__main__":
    unittest.main()
