"""A wave from below that does not move all nodes of absorbing faces alike: columns of soil against what their bases get, and
what is refused.

Columns whose cross-sections cannot deform stand apart on one ground. Each is moved by the mean of its own four nodes, so that
its surface, at height h, moves as 2 u_in(t - h / V) with u_in = the record and the sum of shapes times histories there."""
import functools
import os
import tempfile
import unittest

import h5py
import numpy

import program
from decks import clock, contacts, material, probes
from recorded import Recorded, assert_continues, assert_follows, write_samples

STEP, SPEED, DENSITY, POISSON, HEIGHT = 0.01, 400.0, 2000.0, 0.3, 16.0
YOUNG = 2 * (1 + POISSON) * DENSITY * SPEED**2
PLACES = {"near": 0, "next": 20, "far": 100}
SOIL = [*material("ground", repr(YOUNG), POISSON, DENSITY), "-motion_input", "below", "-modes", 0, "-energy_interval", 50]


def record(seed):
    """Filtered noise from 0.5 s to 4 s, 1 to 8 Hz, that ends at rest."""
    random, time = numpy.random.default_rng(seed), numpy.arange(0, 4.5, STEP)
    frequency = numpy.fft.rfftfreq(len(time), STEP)
    band = numpy.exp(-((frequency - 4) / 2)**4)
    motion = numpy.fft.irfft(numpy.fft.rfft(random.standard_normal(len(time))) * band, len(time))
    inside = (time > 0.5) & (time < 4)
    window = numpy.where(inside, numpy.sin(numpy.pi * (time - 0.5) / 3.5)**2, 0)
    return 10 * motion * window


RECORDS = {axis: record(seed) for axis, seed in zip("xz", (3, 5))}


def along(*axes):
    return [word for axis in axes for word in (f"-motion_{axis}_record", write_samples(RECORDS[axis], STEP), f"-motion_{axis}_unit", "m/s2")]


def block(name, sizes, *more):
    """A block of soil of tests/meshes/column.geo."""
    return [f"-{name}_mesh", "tests/meshes/column.geo", f"-{name}_mesh_set", sizes, f"-{name}_absorbing_base", "bottom",
            *(word for group in ("rock", "soil") for word in (f"-{name}_{group}_element", "hex8", f"-{name}_{group}_material", "ground")),
            *more]


def columns(*more, axes="xz", end=5.0):
    words = ["-structures", ",".join(PLACES), *SOIL, *along(*axes), *clock(5e-4, end, STEP), *probes(**{f"{n}_top": f"{n}:top" for n in PLACES})]
    for name, x in PLACES.items():
        words += block(name, f"x0={x},lower=8,upper=8,n_lower=8,n_upper=8", f"-{name}_levels", "all")
    return [*words, *more]


def site(*more, sizes="lx=40,ly=20,nx=4,ny=2,lower=8,upper=8,n_lower=2,n_upper=2", end=1.5):
    """A block of soil with waves leaving through its sides, beside a column that it may hit."""
    return ["-structures", "site,near", *SOIL, *along("x", "z"), *clock(2e-3, end), *probes(top="site:top"), "-top_average", "false",
            *block("site", sizes, "-site_absorbing", "sides"), *block("near", "x0=40,lower=8,upper=8,n_lower=2,n_upper=2", "-near_levels", "all"),
            *contacts(joint=("near:x_min", "site:x_max", 1e-4)), *more]


def wave_of(words, model="abrahamson_2007_hard_rock"):
    """The file of run/incoherent for the faces of a scene, whose motion is along x and z; ends of the program and the command."""
    folder = tempfile.mkdtemp()
    made = program.run([*words, "-dry_run", "true", "-write_model", "true", "-output", folder])
    with open(os.path.join(folder, "faces.yaml"), "w") as file:
        file.write(f"faces: model.h5\nmodel: {model}\nmotion:\n")
        for axis in "xz":
            if f"-motion_{axis}_record" in words:
                path = words[words.index(f"-motion_{axis}_record") + 1]
                file.write(f"  {axis}: {{record: {path}, unit: m/s2}}\n")
    result = program.command("incoherent", os.path.join(folder, "faces.yaml"), "--out", folder)
    return os.path.join(folder, "wave.h5"), made, result


def with_wave(words):
    return [*words, "-motion_incoherent", wave_of(words)[0]]


def way_of(signal):
    """Displacement of straight lines between the samples."""
    velocity = numpy.concatenate([[0], numpy.cumsum(STEP * (signal[1:] + signal[:-1]) / 2)])
    return numpy.cumsum(STEP * (velocity[1:] + velocity[:-1]) / 2 - STEP**2 / 12 * (signal[1:] - signal[:-1]))


@functools.cache
def of_columns():
    """Words of the columns, the file of their wave, the end of the command."""
    words = columns()
    file, made, result = wave_of(words)
    assert made.returncode == 0, made.stderr
    assert result.returncode == 0, result.stderr
    return words, file, result


class Columns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.words, cls.file, cls.result = of_columns()

    def incident(self, name, axis):
        """Acceleration at the base of a column, mean of its nodes, that its file tells."""
        with h5py.File(self.file) as file:
            at = abs(file["nodes"][:, 0] - PLACES[name] - 0.5) < 1
            self.assertEqual(at.sum(), 4)
            found = file[f"{axis}/shapes"][at].mean(0) @ file[f"{axis}/histories"][()]
            found[:len(RECORDS[axis])] += file[f"{axis}/record"][()]
        return found

    def test_surfaces_move_as_their_own_bases_tell(self):
        run = Recorded(self, [*self.words, "-motion_incoherent", self.file])
        tops = {}
        for axis, speed in (("x", SPEED), ("z", SPEED * numpy.sqrt((2 - 2 * POISSON) / (1 - 2 * POISSON)))):
            for name in PLACES:
                base = way_of(self.incident(name, axis))
                exact = 2 * numpy.interp(run.time - HEIGHT / speed, STEP * numpy.arange(1, len(base) + 1), base, left=0)
                tops[name, axis] = run.displacement(f"{name}_top.{axis}")
                assert_follows(self, tops[name, axis], exact, 1e-2, f"{name} {axis}")
            apart = [numpy.std(tops[name, axis] - tops["near", axis]) for name in ("next", "far")]
            self.assertGreater(apart[0], 1e-3 * numpy.std(tops["near", axis]))
            self.assertGreater(apart[1], 1.5 * apart[0], "points farther apart part more")

    def test_a_coherent_wave_through_the_same_path_is_the_coherent_run(self):
        words = columns(end=1.5)
        plain = Recorded(self, words)
        file, _, result = wave_of(words, model="coherent")
        program.well_ended(self, result)
        same = Recorded(self, [*words, "-motion_incoherent", file])
        for name in PLACES:
            for axis in "xz":
                assert_follows(self, same.displacement(f"{name}_top.{axis}"), plain.displacement(f"{name}_top.{axis}"), 1e-12, name)

    def test_the_command_tells_what_shapes_hold(self):
        self.assertRegex(self.result.stdout, r"z: \d+ shapes hold 0\.999\d+ of the trace.*left out .* at 10 Hz")
        self.assertIn("12 nodes", self.result.stdout)

    def test_a_factor_on_the_motion_is_one_on_all_of_it(self):
        words = [*columns(end=0.8), "-motion_incoherent", self.file]
        once, twice = Recorded(self, words), Recorded(self, [*words, "-motion_level", 2])
        assert_follows(self, twice.displacement("far_top.x"), 2 * once.displacement("far_top.x"), 1e-12, "level")

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, [*columns(end=0.9), "-motion_incoherent", self.file], 0.7, 1300, 2)

    def test_meshes_in_pieces_are_the_same(self):
        words = [*columns(end=0.4), "-partition", "elements", "-motion_incoherent", self.file]
        with tempfile.TemporaryDirectory() as folder:
            pieces = ["-mesh_pieces", os.path.join(folder, "pieces")]
            program.must_end(self, [*words, *pieces, "-write_mesh_pieces", 2, "-output", os.path.join(folder, "cut")], 1)
            whole, cut = Recorded(self, words, 2), Recorded(self, [*words, *pieces], 2)
        numpy.testing.assert_array_equal(whole.displacement("far_top.x"), cut.displacement("far_top.x"))


class Refused(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.words, cls.file, _ = of_columns()

    def refused(self, words, *parts):
        program.must_refuse(self, [*words, "-dry_run"], "-motion_incoherent", *parts)

    def test_of_a_scene(self):
        own = ["-motion_incoherent", self.file]
        at_base = ["base" if word == "below" else word.replace("_absorbing_base", "_absorbing") if isinstance(word, str) else word
                   for word in self.words]
        self.refused([*at_base, *own], "goes with -motion_input below")
        self.refused([*self.words, "-far_mesh_set", "x0=101,lower=8,upper=8", *own], "it has no node at (10", "structure far",
                     "makes of this mesh")
        other = write_samples(record(7), STEP)
        self.refused([*self.words, "-motion_x_record", other, *own], "is of another record than -motion_x")
        self.refused([*columns(axes="x"), *own], "a part along z", "there is no -motion_z")
        self.refused([*self.words, "-motion_y_record", other, "-motion_y_unit", "m/s2", *own], "no part along y")
        self.refused([*self.words, "-motion_incoherent", other], "give a file that run/incoherent makes")
        self.refused([*self.words, "-motion_incoherent", "nowhere.h5"], "nowhere.h5")

    def test_of_the_command(self):
        def told(words, *parts):
            _, _, result = wave_of(words)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            for part in parts:
                self.assertIn(part, result.stderr)
        far = ["x0=160,lower=8,upper=8" if isinstance(word, str) and word.startswith("x0=100") else word for word in self.words]
        told(far, "nodes of the faces are 161 m apart", "150 m")
        still = ["base" if word == "below" else word.replace("_absorbing_base", "_absorbing") if isinstance(word, str) else word
                 for word in self.words]
        told(still, "no structure in it has faces of absorbing_base")


ON_RANKS = {"a site on incoherent ground that hits another": lambda: with_wave(site())}


if __name__ == "__main__":
    unittest.main()
