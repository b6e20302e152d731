"""Spans: how the ends of what goes from one structure to another move and turn against each other.

Closed forms: two free blocks that drift and turn, u = t (v + w x r), so that the ends part by what is written down here, whether
an end is a node, a corner or a face; a stick in its first mode, whose top turns by 1.3764785 over its length times the way that
it goes; a clamped end, which goes with the ground in space. Members of an ensemble are single runs, on any ranks.
"""
import math
import os
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy

import program
import two_buildings
from decks import box_of, clock, in_modes, material, probes, section
from program import must_refuse, must_run
from recorded import write_sine
from two_buildings import pounding

STEP, STEPS = 2e-5, 100
WAYS = "xyz"


def of(test, words, ranks=1):
    """The result of a run, with its spans."""
    folder, _ = must_run(test, ["-modes", 0, "-spectra_frequencies", "10,30", *words], ranks)
    test.addCleanup(shutil.rmtree, folder)
    return pounding.load(folder)


class Blocks(unittest.TestCase):
    """Two bricks of 2 x 2 x 2 cells, free, each with a drift and a turn of its own about its middle."""
    DRIFT = {"one": numpy.array([.3, -.2, .1]), "other": numpy.array([-.1, .4, .2])}
    TURN = {"one": numpy.array([.5, -.7, .9]), "other": numpy.array([-.3, .2, .4])}
    MIDDLE = {"one": numpy.array([.5, .5, .5]), "other": numpy.array([2.5, .5, .5])}

    def words(self, *more):
        words = ["-structures", "one,other", *material("stuff", 2e9, .2, 2500), *clock(STEP, STEPS * STEP)]
        for name, middle in self.MIDDLE.items():
            start = tempfile.NamedTemporaryFile("w", suffix=".csv")
            self.addCleanup(start.close)
            start.write("x,y,z,vx,vy,vz\n")
            for corner in numpy.ndindex(3, 3, 3):
                place = middle - .5 + numpy.array(corner) / 2
                velocity = self.DRIFT[name] + numpy.cross(self.TURN[name], place - middle)
                start.write(",".join(repr(float(value)) for value in (*place, *velocity)) + "\n")
            start.flush()
            words += [*box_of(name, f"x0={middle[0] - .5},nx=2,ny=2,nz=2", "stuff"), f"-{name}_initial_state", start.name,
                      f"-{name}_allow_loose", "true"]
        return [*words, *probes(corner="one@1,0,1", face="other:x_min", node="other@2,.5,.5"), "-spans", "line,tray",
                "-line_from", "corner", "-line_to", "face", "-tray_from", "corner", "-tray_to", "node", *more]

    def way(self, name, place):
        return self.DRIFT[name] + numpy.cross(self.TURN[name], numpy.array(place) - self.MIDDLE[name])

    def test_ends_part_and_turn_as_the_blocks_do(self):
        turned = self.TURN["other"] - self.TURN["one"]
        parted = self.way("other", (2, .5, .5)) - self.way("one", (1, 0, 1))
        for ranks in (1, 2, 3):
            run = of(self, self.words(), ranks)
            for name, span in run.spans.items():
                expected = numpy.outer(span.time, numpy.concatenate([parted, turned]))
                self.assertLess(abs(span.relative - expected).max(), 1e-13, f"{name}, {ranks} ranks")
                largest, times = span.largest
                end = STEPS * STEP
                for found, value in zip(largest, [*abs(parted), numpy.linalg.norm(parted), *abs(turned), numpy.linalg.norm(turned)]):
                    self.assertAlmostEqual(found, end * value, delta=1e-13)
                numpy.testing.assert_allclose(times, end)

    def test_mistakes(self):
        for told, more in (("span line: both ends are on structure other", ["-line_from", "node"]),
                           ("span line: no probe nowhere with one record", ["-line_to", "nowhere"]),
                           ("span line: no probe face with one record", ["-face_average", "false"]),
                           ("span line: nodes at corner are on a line and do not turn", ["-corner_at", "1,0,1;1,1,1"]),
                           ("missing option -pipe_from", ["-spans", "line,pipe"]),
                           ("tray appears twice", ["-spans", "line,tray,tray"]),
                           ("'corner' names something else already", ["-spans", "corner"]),
                           ("is 1.41421 m away from the nearest node of structure other", ["-node_at", "4,.5,2"])):
            with self.subTest(told):
                must_refuse(self, self.words(*more), told)


class Sticks(unittest.TestCase):
    """Two cantilevers of Euler's beams, shaken."""
    LENGTH, CELLS = 3.0, 40

    def words(self, *more):
        sine = write_sine(3.0, 4.0, 0.2)
        self.addCleanup(os.remove, sine)
        words = ["-structures", "low,high", *material("steel", 2e10, .3, 7850), *section("rod", .01, 8e-6, 8e-6, 1e-5, "1,0,0"),
                 "-motion_x_record", sine, "-motion_x_unit", "m/s2", *clock(2e-5, .2, 1e-4)]
        for name, x0 in (("low", 0), ("high", 1)):
            words += [f"-{name}_mesh", "tests/meshes/cantilever.geo", f"-{name}_mesh_set", f"height={self.LENGTH},x0={x0},n={self.CELLS}",
                      f"-{name}_clamp", "base", f"-{name}_stem_element", "euler_beam", f"-{name}_stem_material", "steel",
                      f"-{name}_stem_section", "rod"]
        return [*words, *probes(top="low:top", foot="high:base"), "-spans", "cable", "-cable_from", "top", "-cable_to", "foot", *more]

    def test_a_top_turns_as_in_the_first_mode(self):
        run = of(self, self.words(*in_modes("low", 1), *in_modes("high", 1), "-low_modal_residual", "false"))
        span = run.spans["cable"]
        root = 1.8751040687119611
        sigma = (math.sinh(root) - math.sin(root)) / (math.cosh(root) + math.cos(root))
        top = math.cosh(root) - math.cos(root) - sigma * (math.sinh(root) - math.sin(root))
        slope = root * (math.sinh(root) + math.sin(root) - sigma * (math.cosh(root) - math.cos(root))) / self.LENGTH
        self.assertGreater(span.largest[0][0], 1e-3)
        way = span.relative[:, 0]
        self.assertLess(abs(span.relative[:, 4] / way.max() - slope / top * way / way.max()).max(), 1e-3 * abs(way).max() / way.max())
        self.assertLess(abs(span.relative[:, [1, 3, 5]]).max(), 1e-12)

    def test_a_foot_goes_with_the_ground(self):
        run = of(self, self.words())
        span = run.spans["cable"]
        self.assertEqual(abs(span.motion[1]).max(), 0)
        circle = 2 * math.pi * 4.0
        ground = 3.0 / circle * (span.time - numpy.sin(circle * span.time) / circle)
        self.assertLess(abs(span.ground[:, 0] - ground).max(), 1e-4 * ground.max())
        with tempfile.TemporaryDirectory() as folder:
            rows = pounding.spans.write(run, Path(folder), 2e-4)
            self.assertEqual([row["motion"] for row in rows], list(pounding.spans.MOTIONS))
            table = {name: numpy.array(values, float) for name, values in program.read_csv(f"{folder}/span_cable.csv").items()}
        numpy.testing.assert_allclose(table["time"], span.time[::2], atol=1e-12)
        numpy.testing.assert_allclose(table["relative_ry"], span.relative[::2, 4], rtol=1e-8, atol=1e-15)
        numpy.testing.assert_allclose(table["absolute_from_ux"] - table["absolute_to_ux"], table["from_ux"], rtol=1e-7, atol=1e-11)
        numpy.testing.assert_allclose(table["absolute_to_ux"], span.ground[::2, 0], rtol=1e-8, atol=1e-15)


class Members(unittest.TestCase):
    """The two small buildings in modes, with pounding: roofs of shells, whose nodes turn on their own, and a slab's strip, which
    turns as the rigid body nearest to it."""
    ROWS = ["3.5,0.01", "5,0.004", "2,1"]
    COLUMNS = ("motion_x_pga", "floor1_gap")

    def words(self, *more):
        return ["-options_file", str(two_buildings.SCENE), "-end_time", 1.2, "-modes", 0, "-output_interval", 2e-4, "-left_damping_reference", 3,
                "-right_damping_reference", 4, "-floor2_gap", .01, *in_modes("left", 12), *in_modes("right", 12),
                *probes(a="left:east_2", b="right@6.02,2,6", roof="left@3,0,6;3,4,6"), "-spans", "tray,bridge", "-tray_from", "a",
                "-tray_to", "b", "-bridge_from", "b", "-bridge_to", "roof", "-spectra_frequencies", "10,50", *more]

    def ensemble(self, ranks, *more):
        folder = tempfile.mkdtemp(prefix="pounding-spans-")
        self.addCleanup(shutil.rmtree, folder)
        with open(f"{folder}/members.csv", "w") as file:
            file.write("\n".join([",".join(self.COLUMNS), *self.ROWS]) + "\n")
        program.must_end(self, [*self.words(*more), "-ensemble", f"{folder}/members.csv", "-output", f"{folder}/out"], ranks)
        return f"{folder}/out"

    def test_members_are_single_runs_on_any_ranks(self):
        import h5py  # pylint: disable=import-outside-toplevel
        for more in ((), ("-spectra_start", .7)):
            kept = []
            for ranks in (1, 2, 3) if not more else (1,):
                with h5py.File(os.path.join(self.ensemble(ranks, *more), "ensemble.h5")) as file:
                    kept.append((file["spans/peak"][()], file["spans/time"][()]))
                    self.assertEqual([name.decode() for name in file["spans/names"]], ["tray", "bridge"])
                    step = next(line.split()[2] for line in numpy.char.decode(file["identity"][:]) if line.startswith("time step"))
            for peak, time in kept[1:]:
                numpy.testing.assert_array_equal(peak, kept[0][0])
                numpy.testing.assert_array_equal(time, kept[0][1])
            for row, peak, time in zip(self.ROWS, *kept[0]):
                own = [word for name, value in zip(self.COLUMNS, row.split(",")) for word in (f"-{name}", value)]
                run = of(self, [*self.words(*more), *own, "-time_step", step])
                self.assertGreater(run.spans["tray"].largest[0][4:7].max(), 1e-5)
                for number, span in enumerate(run.spans.values()):
                    for half in (slice(0, 4), slice(4, 8)):
                        self.assertLess(abs(peak[number, half] - span.largest[0][half]).max(), 1e-9 * span.largest[0][half].max())
                    main = span.largest[0] > 1e-6
                    numpy.testing.assert_allclose(time[number, main], span.largest[1][main], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
