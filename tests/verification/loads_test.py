"""Loads with a history of their own: forces and moments on nodes, forces per length, area and volume, pressures.

Closed forms: what central differences make of one mass and one spring, step by step; sags of a cantilever with
shear; a bar under a pressure, and under a force per volume that is its weight. Whatever model moves, the ledger
closes, and members, modes, ranks and restarts give one motion.
"""
import math
import os
import tempfile
import unittest

import numpy

import program
from decks import box_of, clock, in_modes, material, probes, section
from recorded import Recorded, assert_continues, assert_follows, ensemble_of

YOUNG, DENSITY, AREA, LENGTH = 2e9, 2500.0, 0.25, 2.0
STEP = 2e-5
LEDGER = 1e-11


def bar(*more, cells=1, probe="end"):
    """A bar of bricks along x, clamped at its start, without Poisson's effect."""
    return ["-structures", "bar", *box_of("bar", f"lx={LENGTH},ly=0.5,lz=0.5,nx={cells}", "stuff"), "-bar_clamp",
            "x_min", *material("stuff", YOUNG, 0, DENSITY), "-time_step", STEP, "-output_interval", STEP, "-probes",
            probe, f"-{probe}_structure", "bar", f"-{probe}_group", "x_max", "-loads", "push", "-push_on", "bar:x_max",
            *more]


def stepped(function, force, steps):
    """Displacements by central differences of the bar as one mass on a spring, which is pushed by f(t)."""
    stiffness, mass = YOUNG * AREA / LENGTH, DENSITY * AREA * LENGTH / 2
    displacement, velocity, history = 0.0, 0.0, []
    for n in range(steps + 1):
        history.append(displacement)
        duration = STEP / 2 if n == 0 else STEP
        velocity += duration * (force * function(n * STEP) - stiffness * displacement) / mass
        displacement += STEP * velocity
    return numpy.array(history)


class OneMass(unittest.TestCase):
    """One brick: four nodes of its free face that move as one."""
    FORCE, STEPS = 3e4, 400

    def push(self, *more):
        return Recorded(self, bar("-push_force", f"{self.FORCE / 4},0,0", "-end_time", self.STEPS * STEP, *more),
                        identity=LEDGER)

    def assert_moves(self, run, function):
        expected = stepped(function, self.FORCE, self.STEPS)
        assert_follows(self, run.displacement("end.x"), expected, 1e-10, "displacement")
        work = run.energy["loads"]
        self.assertAlmostEqual(work / run.energy["input"], 1, delta=1e-10)

    def test_a_constant_load_acts_at_once(self):
        run = self.push()
        self.assert_moves(run, lambda t: 1)
        period = 2 * math.pi / math.sqrt(2 * YOUNG / DENSITY / LENGTH**2)
        middle = run.displacement("end.x")[round(period / 2 / STEP)]
        self.assertAlmostEqual(middle / (2 * self.FORCE * LENGTH / (YOUNG * AREA)), 1, delta=1e-4)

    def test_step(self):
        self.assert_moves(self.push("-push_function", "step", "-push_start", 0.001), lambda t: float(t >= 0.001))

    def test_ramp(self):
        self.assert_moves(self.push("-push_function", "ramp", "-push_start", 0.001, "-push_rise", 0.002),
                          lambda t: min(1, max(0, (t - 0.001) / 0.002)))

    def test_harmonic(self):
        self.assert_moves(self.push("-push_function", "harmonic", "-push_frequency", 300, "-push_phase", 0.4),
                          lambda t: math.sin(2 * math.pi * 300 * t + 0.4))

    def test_values_and_factor(self):
        self.assert_moves(self.push("-push_values", "0.001,0.5; 0.002,-2; 0.004,1", "-push_factor", 0.5),
                          lambda t: 0.5 * numpy.interp(t, [0.001, 0.002, 0.004], [0.5, -2, 1]))

    def test_table_in_a_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("time,value\n# blast\n0.001, 0\n0.0011, 1\n0.005, -0.2\n")
            file.flush()
            self.assert_moves(self.push("-push_table", file.name),
                              lambda t: numpy.interp(t, [0.001, 0.0011, 0.005], [0, 1, -0.2]))

    def test_force_per_area_and_pressure_are_the_same_push(self):
        force = self.push("-push_force", "0,0,0", "-push_surface_force", f"{self.FORCE / AREA},0,0")
        pressure = self.push("-push_force", "0,0,0", "-push_pressure", -self.FORCE / AREA)
        self.assert_moves(force, lambda t: 1)
        self.assert_moves(pressure, lambda t: 1)
        self.assertAlmostEqual(pressure.summary["loads"][0]["extent"], AREA, delta=1e-12)

    def test_reduced(self):
        run = self.push(*in_modes("bar", 12))
        assert_follows(self, run.displacement("end.x"), stepped(lambda t: 1, self.FORCE, self.STEPS), 1e-9, "reduced")

    def test_ends_with_a_scaled_mass_and_uniform_damping(self):
        for more in (["-bar_mass_scaling", 8e-4, "-time_step", 5e-4, "-output_interval", 5e-4],
                     ["-bar_damping_uniform", 0.05], ["-bar_rigid", "x_max"], ["-bar_damping_beta", 1e-5]):
            with self.subTest(more=more):
                self.push(*more)  # its ledger closes


class AtRest(unittest.TestCase):
    """Constant loads under a static start."""

    def assert_stays(self, run, channel, expected, tolerance=1e-10):
        found = run.displacement(channel)
        self.assertLess(abs(found / expected - 1).max(), tolerance, channel)

    def rest(self, words, *more):
        run = Recorded(self, [*words, "-preload", "static", "-end_time", 20 * STEP, *more], identity=LEDGER)
        self.assertEqual([line for line in run.summary["warnings"] if "weight" in line], [])
        return run

    def test_pressure_on_a_bar(self):
        run = self.rest(bar("-push_pressure", 4e5, cells=3))
        self.assert_stays(run, "end.x", -4e5 * LENGTH / YOUNG)
        rest = run.summary["equilibrium"]["structures"]["bar"]
        self.assertAlmostEqual(rest["load"][0] / (-4e5 * AREA), 1, delta=1e-12)
        self.assertAlmostEqual(rest["support"][0] / (4e5 * AREA), 1, delta=1e-9)
        self.assertLess(rest["imbalance"], 1e-9)

    def test_body_force_is_a_weight(self):
        weight = DENSITY * 9.81
        words = bar("-push_body_force", f"{weight},0,0", "-push_on", "bar:body", cells=4)
        run = self.rest(words)
        self.assert_stays(run, "end.x", weight * LENGTH**2 / (2 * YOUNG))
        self.assertAlmostEqual(run.summary["loads"][0]["extent"], AREA * LENGTH, delta=1e-12)
        reduced = self.rest(words, *in_modes("bar", 3))
        self.assert_stays(reduced, "end.x", weight * LENGTH**2 / (2 * YOUNG), 1e-7)

    def test_loads_that_set_in_with_the_run_leave_the_rest_alone(self):
        run = self.rest(bar("-push_force", "1e3,0,0", "-push_function", "step", "-gravity", 9.81))
        self.assertEqual(run.summary["equilibrium"]["structures"]["bar"]["load"], [0, 0, 0])


class Cantilever(unittest.TestCase):
    """One beam, whose sag under a load at its end and along it is exact."""
    INERTIA, SHEAR, HEIGHT, POISSON = 3e-4, 0.02, 2.0, 0.25

    def mast(self, *more, elements=1):
        return ["-structures", "mast", "-mast_mesh", "tests/meshes/cantilever.geo", "-mast_mesh_set", f"n={elements}",
                "-mast_clamp", "base", "-mast_stem_element", "beam", "-mast_stem_material", "steel",
                "-mast_stem_section", "tube", *material("steel", YOUNG, self.POISSON, DENSITY),
                *section("tube", 0.04, self.INERTIA, self.INERTIA, 2 * self.INERTIA, "0,1,0"),
                "-section_tube_shear_area", f"{self.SHEAR},{self.SHEAR}", *probes(top="mast:top"),
                *clock(STEP, 10 * STEP), "-preload", "static", "-loads", "push", *more]

    def sag(self, *more, elements=1):
        run = Recorded(self, self.mast(*more, elements=elements), identity=LEDGER)
        return run.displacement("top.x").mean(), run

    def test_force_moment_and_force_per_length(self):
        bending, shear = YOUNG * self.INERTIA, YOUNG / (2 * (1 + self.POISSON)) * self.SHEAR
        height = self.HEIGHT
        for elements in (1, 3):
            tip, _ = self.sag("-push_on", "mast:top", "-push_force", "1e3,0,0", elements=elements)
            self.assertAlmostEqual(tip / (1e3 * height**3 / (3 * bending) + 1e3 * height / shear), 1, delta=1e-9)
            turned, _ = self.sag("-push_on", "mast:top", "-push_moment", "0,1e3,0", elements=elements)
            self.assertAlmostEqual(turned / (1e3 * height**2 / (2 * bending)), 1, delta=1e-9)
            spread, run = self.sag("-push_on", "mast:stem", "-push_line_force", "500,0,0", elements=elements)
            expected = 500 * height**4 / (8 * bending) + 500 * height**2 / (2 * shear)
            self.assertAlmostEqual(spread / expected, 1, delta=1e-9)
            rest = run.summary["equilibrium"]["structures"]["mast"]
            self.assertAlmostEqual(rest["support"][0] / (-500 * height), 1, delta=1e-9)
            self.assertAlmostEqual(run.summary["loads"][0]["moment"][1] / (500 * height**2 / 2), 1, delta=1e-12)


class EveryRoom(unittest.TestCase):
    """A longer bar under three loads."""
    LOADS = ["-loads", "push,shake,press", "-push_force", "100,40,-30", "-push_values", "0,0; 0.001,1; 0.003,-0.5",
             "-shake_on", "bar:body", "-shake_body_force", "0,2e4,1e4", "-shake_function", "harmonic",
             "-shake_frequency", 120, "-press_on", "bar:y_max", "-press_pressure", 3e3, "-press_function", "step",
             "-press_start", 5e-4]

    def words(self, *more):
        return bar(*self.LOADS, "-end_time", 200 * STEP, *more, cells=8)

    def test_all_modes_are_the_full_model(self):
        full = Recorded(self, self.words(), identity=LEDGER)
        modal = Recorded(self, self.words(*in_modes("bar", 200)), identity=LEDGER)
        for axis in "xyz":
            assert_follows(self, modal.displacement(f"end.{axis}"), full.displacement(f"end.{axis}"), 1e-8, axis)

    def test_a_stored_basis_has_them(self):
        with tempfile.TemporaryDirectory() as folder:
            modal = [*in_modes("bar", 9), "-bar_modal_basis", f"{folder}/bar.h5"]
            first = Recorded(self, self.words(*modal), identity=LEDGER)
            again = Recorded(self, self.words(*modal), identity=LEDGER)
            self.assertGreater(abs(first.displacement("end.y")).max(), 1e-6)
            for axis in "xyz":
                numpy.testing.assert_array_equal(first.displacement(f"end.{axis}"), again.displacement(f"end.{axis}"))
            other = Recorded(self, self.words(*modal, "-press_pressure", 6e3), identity=LEDGER)
            change = abs(other.displacement("end.y") - first.displacement("end.y")).max()
            self.assertGreater(change, 0.1 * abs(first.displacement("end.y")).max())

    def test_restart_to_the_bit(self):
        assert_continues(self, self.words("-modes", 0, "-end_time", 200 * STEP), 120 * STEP, 100, 2)

    def test_restart_with_another_table_is_refused(self):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            def write(last):
                file.seek(0)
                file.write(f"0 0\n0.001 1\n0.003 {last}\n")
                file.truncate()
                file.flush()
            words = [*bar("-push_force", "100,0,0", "-push_table", file.name, "-modes", 0)]
            write(1)
            folder, _ = program.must_run(self, [*words, "-end_time", 60 * STEP, "-checkpoint_steps", 40])
            write(2)
            program.must_refuse(self, [*words, "-end_time", 100 * STEP, "-restart",
                                       os.path.join(folder, "checkpoint.h5")], "motion")

    def test_members_of_an_ensemble(self):
        words = self.words(*in_modes("bar", 9), "-modes", 0, "-spectra_frequencies", "50,200")
        peaks, residual = ensemble_of(self, words, "bar_stiffness_factor", (1, 1.3))
        self.assertLess(abs(residual).max(), LEDGER)
        for member, factor in enumerate((1, 1.3)):
            single = Recorded(self, [*words, "-bar_stiffness_factor", factor], identity=LEDGER)
            expected = [abs(single.displacement(f"end.{axis}")).max() for axis in "xyz"]
            numpy.testing.assert_allclose(numpy.ravel(peaks[member])[:3], expected, rtol=1e-9)


class Refused(unittest.TestCase):
    def refuse(self, *more, parts=(), words=None):
        program.must_refuse(self, (words or bar)(*more, "-end_time", 0.001), *parts)

    def test_bad_loads(self):
        self.refuse(parts=["push_on", "the load is none"])
        self.refuse("-push_force", "0,0,0", parts=["the load is none"])
        self.refuse("-push_force", "1,0", parts=["push_force", "three numbers"])
        self.refuse("-push_force", "1,0,0", "-push_factor", 0, parts=["push_factor"])
        self.refuse("-push_force", "1,0,0", "-push_on", "barn:x_max", parts=["no structure 'barn'"])
        self.refuse("-push_force", "1,0,0", "-push_on", "bar:x_mex", parts=["push_on", "x_mex"])
        self.refuse("-push_force", "1,0,0", "-push_on", "x_max", parts=["push_on", "structure:group"])
        self.refuse("-push_moment", "1,0,0", parts=["push_moment", "no rotations"])
        self.refuse("-push_line_force", "1,0,0", parts=["push_line_force", "no lines"])
        self.refuse("-push_body_force", "1,0,0", parts=["push_body_force", "no elements with a volume"])
        self.refuse("-push_pressure", 1, "-push_on", "bar:corners", parts=["push_pressure", "no surfaces"])

    def test_bad_histories(self):
        force = ["-push_force", "1,0,0"]
        self.refuse(*force, "-push_function", "ramp", parts=["push_rise"])
        self.refuse(*force, "-push_function", "harmonic", parts=["push_frequency"])
        self.refuse(*force, "-push_rise", 0.1, parts=["push_rise"])
        self.refuse(*force, "-push_function", "step", "-push_values", "0,1", parts=["has a history already"])
        self.refuse(*force, "-push_values", "0,1; 0,2", parts=["times do not increase"])
        self.refuse(*force, "-push_values", "0,1,2", parts=["no pair"])
        self.refuse(*force, "-push_table", "/nowhere/f.csv", parts=["/nowhere/f.csv"])
        for text, part in (("0 1\n0 2\n", "line 2"), ("0 1 2\n", "3 numbers"), ("0 1\nx y\n", "line 2"),
                           ("words only\n", "no pair")):
            with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
                file.write(text)
                file.flush()
                self.refuse(*force, "-push_table", file.name, parts=[part])

    def test_doubts(self):
        _, summary = program.must_run(self, bar("-push_force", "1,0,0", "-push_on", "bar:x_min", "-end_time", 0.001))
        self.assertTrue(any("acts on clamped components" in line for line in summary["warnings"]))

    def test_times_beside_records_that_begin_late(self):
        """A record counts from its first time; a table does not, and both are told."""
        def doubts(first, values):
            with tempfile.NamedTemporaryFile("w", suffix=".txt") as record:
                record.write("".join(f"{first + 1e-4 * k} {k % 3}\n" for k in range(12)))
                record.flush()
                _, summary = program.must_run(self, bar(
                    "-push_force", "1,0,0", "-push_values", values, "-motion_x_record", record.name, "-motion_x_unit", "m/s2",
                    "-end_time", 0.001))
            return [line for line in summary["warnings"] if line.startswith("load push")]
        idle, late = doubts(100, "100,0;100.0005,1")
        self.assertIn("0 throughout the run", idle)
        self.assertIn("which is at 100 s in the times of the records", late)
        self.assertEqual(len(doubts(100, "0,0;0.0005,1")), 1)
        self.assertEqual(doubts(0, "0,0;0.0005,1"), [])


ON_RANKS = {"three loads on a bar": EveryRoom().words(),
            "a bar at rest under a pressure that is shaken": bar(
                "-loads", "push,shake", "-push_pressure", 4e5, "-shake_on", "bar:body", "-shake_body_force", "0,2e4,1e4",
                "-shake_function", "harmonic", "-shake_frequency", 120, "-preload", "static", "-end_time", 200 * STEP, cells=3)}


if __name__ == "__main__":
    unittest.main()
