"""Reactions, forces through a level, members and springs, beside the histories of the same run and hand calculations.

- A brick of eight-node elements, shaken and heavy: the ground's force and moment is the sum of m a of its nodes, less
  weight, plus what mass damping takes, at every sample; likewise what is above a level.
- A portal frame under its weight and a lateral body force: slope deflection, written out below.
- Springs: stiffness times what they are stretched by.
"""
import functools
import math
import os
import re
import tempfile
import unittest

import h5py
import numpy

import program
from decks import box_of, clock, in_modes, material
from nonlinear_springs_test import mass, spring
from recorded import all_nodes, assert_continues, lumped_fractions, write_sine

GRAVITY = 9.81
POINT = (0.3, -0.2, 0.1)


class Forces:
    """What a run records, and what its files say of it."""

    def __init__(self, test, words, ranks=program.RANKS):
        folder, self.summary = program.must_run(test, ["-modes", 1, "-spectra_frequencies", 10, *words], ranks)
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            names = [name.decode() for name in file["forces"]] if "forces" in file else []
            self.force = {name: file["force"][:, i] for i, name in enumerate(names)}
            self.unit = file["force"].attrs["unit"] if names else ""
            self.channels = [name.decode() for name in file["channels"]]
            self.data = {name: file[name][()] for name in
                         ("time", "displacement", "velocity", "acceleration", "ground_acceleration") if name in file}
        table = program.read_csv(os.path.join(folder, "forces.csv"))
        self.peaks = {(item, part, int(float(element))): (float(peak), float(time)) for item, part, element, peak, time
                      in zip(*(table[name] for name in ("item", "component", "element", "peak", "time")))}

    def total(self, item):
        """Force and moment, shape (samples, 6)."""
        return numpy.stack([self.force[f"{item}.{name}"] for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")], 1)


class Shaken:
    """2 x 2 x 3 elements of concrete, shaken along all axes."""
    DENSITY, SIZES, ALPHA, BETA = 2400.0, (2.0, 1.0, 3.0), 3.0, 2e-5
    MASS = DENSITY * math.prod(SIZES)
    STEP = 5e-5

    @staticmethod
    @functools.cache
    def records():
        return [write_sine(amplitude, frequency, 0.06) for amplitude, frequency in ((4.0, 40.0), (2.0, 25.0), (3.0, 60.0))]

    def words(self, *more):
        words = ["-structures", "it", *box_of("it", "lx=2,ly=1,lz=3,nx=2,ny=2,nz=3", "concrete"),
                 *material("concrete", 3e9, 0.2, self.DENSITY), "-gravity", GRAVITY, "-preload", "static",
                 *clock(self.STEP, 0.03), "-probes", "all", *all_nodes("all", "it"), "-forces", "base,upper",
                 "-base_structure", "it", "-base_kind", "reactions", "-base_about", ",".join(map(str, POINT)),
                 "-upper_structure", "it", "-upper_kind", "storey", "-upper_level", 1.5]
        for axis, record in zip("xyz", self.records()):
            words += [f"-motion_{axis}_record", record, f"-motion_{axis}_unit", "m/s2"]
        return [*words, *more]


SPRINGS = ["-it_corners_element", "grounded_spring", "-it_corners_stiffness", "4e7,4e7,4e7", "-it_corners_dashpot",
           "2e4,2e4,3e4"]


class Brick(Shaken, unittest.TestCase):
    clamped = True

    def expected(self, run, alpha, level=-1.0, point=POINT):
        """Change of momentum of what is above the level and free, and what gravity and mass damping do to it."""
        probes = run.summary["probes"]
        place = numpy.array([probe["position"] for probe in probes.values()])
        mass = self.MASS * lumped_fractions(place)
        mass[place[:, 2] <= max(level, 1e-9 if self.clamped else -1)] = 0
        count = len(place)
        acceleration = run.data["acceleration"].reshape(-1, count, 3)
        velocity = run.data["velocity"].reshape(-1, count, 3)
        before = numpy.concatenate((numpy.zeros((1, count, 3)), velocity[:-1]))
        force = mass[:, None] * (acceleration + alpha * before)
        force[:, :, 2] += mass * GRAVITY
        moment = numpy.cross(place - numpy.array(point), force)
        return numpy.concatenate((force.sum(axis=1), moment.sum(axis=1)), axis=1), mass.sum()

    def check(self, words, alpha, tolerance=1e-10):
        run = Forces(self, words)
        for item, level, point in (("base", -1.0, POINT), ("upper", 1.5, (0, 0, 1.5))):
            found = run.total(item)
            expected, mass = self.expected(run, alpha, level, point)
            scale = abs(expected).max()
            self.assertGreater(scale, 0.5 * mass * GRAVITY)
            # The first sample is half a step of velocity, which the record divides by a whole one.
            self.assertLess(abs(found[1:] - expected[1:]).max() / scale, tolerance, "change of momentum")
            self.assertAlmostEqual(found[0, 2] / (mass * GRAVITY), 1, delta=1e-10)   # at rest: the weight
            self.assertLess(abs(found[0, :2]).max() / scale, 1e-10)
        return run

    def test_reactions_are_the_change_of_momentum(self):
        damped = ["-it_clamp", "z_min", "-it_damping_alpha", self.ALPHA, "-it_damping_beta", self.BETA]
        run = self.check(self.words(*damped), self.ALPHA)
        self.assertEqual(run.unit, b"N, N m")
        for name in ("Fx", "Fz", "My"):
            history = run.force[f"base.{name}"]
            at = abs(history).argmax()
            said = run.summary["forces"]["base"][name]
            self.assertEqual((said["peak"], said["time"]), (history[at], run.data["time"][at]))
            self.assertEqual(run.peaks["base", name, 0], (history[at], run.data["time"][at]))

    def test_with_uniform_damping(self):
        self.check(self.words("-it_clamp", "z_min", "-it_damping_uniform", 0.05, "-it_damping_band", "5,500"), 0)

    def test_springs_and_dashpots_to_the_ground(self):
        self.clamped = False
        for more in ([], ["-it_corners_compression_only", "true"]):
            self.check(self.words(*SPRINGS, *more), 0, 1e-9)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        words = self.words("-it_clamp", "z_min", "-it_damping_beta", self.BETA, "-output_interval", 2e-4)
        assert_continues(self, words, 0.0152, 250, 2)

    def test_nothing_else_changes(self):
        """With and without forces the motions are the same to the bit."""
        words = self.words("-it_clamp", "z_min")
        without = words.copy()
        without[without.index("-forces"):] = ["-it_clamp", "z_min"] + words[words.index("-motion_x_record"):]
        folder, _ = program.must_run(self, without)
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            self.assertNotIn("force", file)
            plain = file["velocity"][()]
        self.assertFalse(os.path.exists(os.path.join(folder, "forces.csv")))
        self.assertTrue(numpy.array_equal(plain, Forces(self, words).data["velocity"]))


class Points(Shaken, unittest.TestCase):
    def test_point_of_the_moments_is_told(self):
        """Of reactions the origin and of a storey the origin at its level, where nothing else is given; of members none."""
        folder = tempfile.mkdtemp(prefix="pounding-")
        words = self.words("-it_clamp", "z_min", "-end_time", 1e-3, "-probes", "none", "-modes", 1, "-forces",
                           "base,upper,plain,held", "-plain_structure", "it", "-plain_kind", "reactions", "-held_structure",
                           "it", "-held_kind", "members", "-held_group", "corners", "-it_corners_element", "grounded_spring",
                           "-it_corners_stiffness", "1e4,1e4,1e4", "-output", folder)
        result = program.must_end(self, words)
        self.assertEqual(program.summary(folder)["moments_about"],
                         {"base": list(POINT), "upper": [0, 0, 1.5], "plain": [0, 0, 0]})
        printed = result.stdout[result.stdout.index("\nforce "):]
        for item, point in (("base", "(0.3, -0.2, 0.1)"), ("upper", "(0, 0, 1.5)"), ("plain", "(0, 0, 0)")):
            self.assertRegex(printed, rf"\n  {item}\.Mz .*\n    moments about {re.escape(point)} m\n")
        self.assertEqual(printed.count("moments about"), 3)


class Portal(unittest.TestCase):
    """Columns of height h without weight, a girder of span L and weight W, half of it at its middle; everything pulled
    sideways by a body force F as well. Slope deflection, moments anticlockwise on the ends of a member, nothing
    stretches: t turns the left corner, d is the drift.

        weight      (4 E Ic / h + 2 E Ig / L) t = P L / 8, P = W / 2; head 4 E Ic / h t, foot half of it
        sideways    head 4 E Ic / h t + 6 E Ic / h^2 d = -6 E Ig / L t,   foot 2 E Ic / h t + 6 E Ic / h^2 d,
                    head + foot = F h / 2
    """
    SPAN, HEIGHT, YOUNG, COLUMN, GIRDER, AREA, DENSITY, PULL = 4.0, 3.0, 2e11, 2e-4, 3e-4, 100.0, 20.0, 2.0

    def words(self, *more, elements=2, area=AREA, light=1e-9):
        words = ["-structures", "it", "-it_mesh", "tests/meshes/portal.geo", "-it_mesh_set", f"n={elements}",
                 "-it_clamp", "base", "-it_gravity", f"{self.PULL},{-GRAVITY},0", "-preload", "static", "-end_time",
                 2e-9, "-output_interval", 1e-9, "-forces", "base,beam,posts,head,foot",
                 "-base_structure", "it", "-base_kind", "reactions", "-beam_structure", "it", "-beam_kind", "members", "-beam_group", "girder",
                 "-posts_structure", "it", "-posts_kind", "members", "-posts_group", "columns",
                 "-head_structure", "it", "-head_kind", "members", "-head_group", "columns", "-head_at",
                 "0,2.25,0; 4,2.25,0", "-foot_structure", "it", "-foot_kind", "members", "-foot_group", "columns",
                 "-foot_at", "0,0.75,0; 4,0.75,0"]
        for name, group, inertia, density in (("light", "columns", self.COLUMN, light),
                                              ("heavy", "girder", self.GIRDER, self.DENSITY)):
            words += [f"-it_{group}_element", "beam", f"-it_{group}_material", name, f"-it_{group}_section", name,
                      f"-material_{name}_young", self.YOUNG, f"-material_{name}_poisson", 0.25,
                      f"-material_{name}_density", density, f"-section_{name}_area", area,
                      f"-section_{name}_inertia_y", 10 * inertia, f"-section_{name}_inertia_z", inertia,
                      f"-section_{name}_torsion", inertia, f"-section_{name}_z_axis", "0,0,1"]
        return [*words, *more]

    def hand(self):
        """Weight, force, and what acts on the heads and feet: of the left column under the weight, of both sideways."""
        h, span, column, girder = self.HEIGHT, self.SPAN, self.YOUNG * self.COLUMN, self.YOUNG * self.GIRDER
        weight = self.DENSITY * self.AREA * span * GRAVITY
        turn = weight / 2 * span / 8 / (4 * column / h + 2 * girder / span)
        force = self.DENSITY * self.AREA * span * self.PULL
        matrix = [[4 * column / h + 6 * girder / span, 6 * column / h**2], [6 * column / h, 12 * column / h**2]]
        sway, drift = numpy.linalg.solve(matrix, [0, force * h / 2])
        return (weight, force, 4 * column / h * turn, 2 * column / h * turn,
                4 * column / h * sway + 6 * column / h**2 * drift, 2 * column / h * sway + 6 * column / h**2 * drift)

    def check(self, run, tolerance):
        weight, force, head, foot, sway_head, sway_foot = self.hand()
        base = run.total("base")[0]
        self.assertLess(abs(base[:3] - [-force, weight, 0]).max() / weight, tolerance[0])
        # About the origin: the weight acts at L / 2, the force at h.
        self.assertAlmostEqual(base[5] / (weight * self.SPAN / 2 + force * self.HEIGHT), 1, delta=tolerance[0])

        def parts(item, which):
            own = {key.split(".", 1)[1]: value[0] for key, value in run.force.items() if key.startswith(item + ".")}
            element = list(dict.fromkeys(key.split(".")[0] for key in own))[which]
            return {key.split(".")[1]: value for key, value in own.items() if key.split(".")[0] == element}

        # Columns: local x up, y to the left. The left head is turned clockwise by the weight.
        for side, which in ((1, 0), (-1, 1)):
            on_head, on_foot = -side * head + sway_head, -side * foot + sway_foot
            axial = -weight / 2 + side * 2 * sway_head / self.SPAN
            upper, lower = parts("head", which), parts("foot", which)
            expected = {"N": axial, "Vy": -(on_head + on_foot) / self.HEIGHT}
            for name, value in (*expected.items(), ("Mz2", on_head), ("Mz1", (on_head - on_foot) / 2)):
                self.assertLess(abs(upper[name] / value - 1), tolerance[1], f"head {name}")
            for name, value in (*expected.items(), ("Mz1", -on_foot), ("Mz2", (on_head - on_foot) / 2)):
                self.assertLess(abs(lower[name] / value - 1), tolerance[1], f"foot {name}")
            for name in ("Vz", "T", "My1", "My2"):
                self.assertLess(abs(upper[name]), 1e-7 * weight, name)
        # The girder's left half: local x to the right, y up; its middle sags.
        left = min(element for item, _, element in run.peaks if item == "beam")
        for name, value in (("Mz1", -head + sway_head), ("Mz2", weight / 2 * self.SPAN / 4 - head),
                            ("N", -(head + foot) / self.HEIGHT + force / 4)):
            self.assertLess(abs(run.peaks["beam", name, left][0] / value - 1), tolerance[1], f"girder {name}")
        self.assertEqual(len({element for item, _, element in run.peaks if item == "posts"}), 4)
        said = run.summary["forces"]["posts"]["Mz2"]
        self.assertEqual(said["peak"], max((peak for (item, name, _), (peak, _) in run.peaks.items()
                                            if (item, name) == ("posts", "Mz2")), key=abs))

    def test_by_hand(self):
        self.check(Forces(self, self.words()), (1e-10, 1e-5))

    def test_rest_in_a_few_modes(self):
        """The basis holds the static response to the weight, so that the rest is that of the whole model."""
        ordinary = {"area": 0.1, "light": 20.0}
        whole = Forces(self, self.words(**ordinary))
        run = Forces(self, self.words(*in_modes("it", 3), **ordinary))
        self.assertLess(run.summary["structures"]["it"]["modal"]["coordinates"], 6)
        for name, history in whole.force.items():
            self.assertLess(abs(run.force[name][0] - history[0]), 1e-6 * abs(whole.total("base")[0]).max(), name)
        stiffer = Forces(self, self.words(*in_modes("it", 3), "-it_stiffness_factor", 2, **ordinary))
        for name, history in whole.force.items():  # at rest forces do not know the stiffness
            self.assertLess(abs(stiffer.force[name][0] - history[0]), 1e-6 * abs(whole.total("base")[0]).max(), name)

    def test_what_cannot_be_meant(self):
        for more, said in ((["-head_group", "nothing"], "has no elements in such a group"),
                           (["-head_kind", "storey"], "only with -head_kind members"),
                           (["-base_kind", "storey"], "give -base_level"),
                           (["-base_level", 1], "only with -base_kind storey"),
                           (["-base_structure", "its"], "did you mean"),
                           (["-head_at", "0,0,9"], "m away from the middle of the nearest element")):
            program.must_refuse(self, self.words(*more), said)


class Springs(unittest.TestCase):
    def test_force_is_stiffness_times_stretch(self):
        stiffness = (2e5, 1e5, 3e5)
        words = mass(1e-4, 0.05, "-chain_initial_velocity", "1,-2,0.5", *spring(",".join(map(str, stiffness))),
                     "-forces", "held", "-held_structure", "chain", "-held_kind", "members", "-held_group", "support",
                     "-held_at", "1,0,0")
        run = Forces(self, words)
        self.assertEqual(len(run.force), 3)
        for d, (name, history) in enumerate(run.force.items()):
            expected = stiffness[d] * run.data["displacement"][:, d]
            self.assertLess(abs(history - expected).max() / abs(expected).max(), 1e-13, name)

    def test_what_yields_is_for_loops(self):
        words = mass(1e-4, 0.05, *spring("2e5,0,0", yield_force="100,0,0"), "-forces", "held", "-held_structure",
                     "chain", "-held_kind", "members", "-held_group", "support")
        program.must_refuse(self, words, "-loops chain:support")


STIFFER = ("-it_stiffness_factor", 2)


class Reduced(Shaken, unittest.TestCase):
    """What a few vectors leave of the forces of a shaken brick; all of them leave everything."""

    def words(self, *more):
        return super().words("-it_clamp", "z_min", "-probes", "none", "-time_step", 2e-5, "-gravity", 0,
                             "-preload", "none", *more)

    def differs(self, vectors, full, *more):
        run = Forces(self, self.words(*in_modes("it", vectors), *more))
        return [abs(run.total(item) - full.total(item)).max() / abs(full.total(item)).max()
                for item in ("base", "upper")]

    def test_damping_is_in_them(self):
        for damping in (("-it_damping_alpha", self.ALPHA, "-it_damping_beta", self.BETA), ("-it_damping_uniform", 0.05, "-it_damping_band", "5,500")):
            full = Forces(self, self.words(*damping))
            self.assertLess(max(self.differs(1000, full, *damping)), 1e-8, damping[0])

    def test_truncation(self):
        full = Forces(self, self.words())
        self.assertLess(max(self.differs(1000, full)), 1e-8, "all modes")
        self.assertLess(max(self.differs(1000, Forces(self, self.words(*STIFFER)), *STIFFER)), 1e-8, "stiffer")
        few, more = self.differs(8, full), self.differs(30, full)
        self.assertLess(max(few), 0.01, "8 modes")
        self.assertLess(max(more), 0.01, "30 modes")
        self.assertGreater(min(self.differs(8, full, "-it_modal_residual", "false")), 2 * max(few), "without residual vectors")


class Floors(unittest.TestCase):
    """The coarse pair: four floors, and a probe on one of them that is none."""
    WORDS = program.COARSE_PAIR + ["-end_time", 0.3, "-motion_x_pga", 3, "-motion_x_envelope", "0.1,20",
                                   "-output_interval", 5e-4, "-probes", "s1_floor2,shelf,s1_floor1,s2_floor1,s2_floor2",
                                   "-shelf_structure", "s1", "-shelf_at", "1.44,0.912,2.72"]

    def test_drifts_are_those_between_floors(self):
        folder, summary = program.must_run(self, self.WORDS, 2)
        self.assertEqual([(storey["structure"], storey["upper"], storey["lower"]) for storey in summary["drifts"]],
                         [("s1", "s1_floor1", "base"), ("s1", "s1_floor2", "s1_floor1"),
                          ("s2", "s2_floor1", "base"), ("s2", "s2_floor2", "s2_floor1")])
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            time, moved = file["time"][()], file["displacement"][()]
            names = [name.decode() for name in file["channels"]]
        for storey in summary["drifts"]:
            at = [summary["probes"][name]["position"][2] if name != "base" else 0.0
                  for name in (storey["upper"], storey["lower"])]
            self.assertAlmostEqual(storey["height"], at[0] - at[1], delta=1e-12)
            for d, axis in enumerate("xy"):
                lower = (0 if storey["lower"] == "base" else moved[:, names.index(f"{storey['lower']}.{axis}")])
                drift = (moved[:, names.index(f"{storey['upper']}.{axis}")] - lower) / storey["height"]
                largest = abs(drift).argmax()
                self.assertGreater(abs(drift[largest]), 0)
                self.assertAlmostEqual(storey["peak"][d] / drift[largest], 1, delta=1e-12)
                self.assertAlmostEqual(storey["time"][d], time[largest], delta=1e-12)

    def test_two_floors_at_one_height_are_refused(self):
        program.must_refuse(self, self.WORDS + ["-shelf_floor", "true"], "is a floor at the same height")


# Accelerations are differences of velocities over a step of 5e-5 s.
ON_RANKS = {"reactions and forces through a level": (lambda: Brick().words(*SPRINGS, "-preload", "none"), {"tolerance": 1e-11}),
            "the same in modes": lambda: Reduced().words(*in_modes("it", 8)),
            "forces of members": lambda: Portal().words("-end_time", 2e-3, "-output_interval", 1e-5, area=0.1, light=20.0)}


if __name__ == "__main__":
    unittest.main()
