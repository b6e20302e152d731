"""Contact that is closed at the start or for long: impacts on a stop that stay, part and come again.

A mass on a spring leaves a stop that it touches and comes back to it, where it must stay without
force; the same pressed against the stop at the end; a plastic ball on a shaken table; a damped
oscillator beside a stop under harmonic ground motion. References: closed forms, event times by
bisection to 1e-12 s, and the same scheme in an independent implementation where it is said.

The oscillators are hexahedra of unit section and length, clamped at one face: the other carries
half of the mass on the stiffness E A / L. The balls are squares of shell.
"""
import math
import unittest

import numpy

from decks import clock, contacts, material, probes
from recorded import Recorded, assert_follows, write_sine
from references import oscillators

GRAVITY = 9.81


def oscillator(mass, frequency, time_step, end, gap, *more):
    stiffness = mass * (2 * math.pi * frequency)**2
    return ["-structures", "mass", "-mass_mesh", "tests/meshes/box.geo", "-mass_clamp", "x_min",
            "-mass_body_element", "hex8_full", "-mass_body_material", "spring",
            *material("spring", repr(stiffness), 0, repr(2 * mass)), *contacts(stop=("mass:x_max", "wall", gap)),
            *clock(repr(time_step), repr(end), repr(time_step / 2)), "-impact_merge_time", 1e-9,
            *probes(face="mass:x_max"), *more]


def landings(impulse):
    """Steps with impulse after a step without."""
    return numpy.nonzero((impulse > 0) & (numpy.append(1, impulse[:-1]) == 0))[0]


class MassOnASpring(unittest.TestCase):
    MASS, FREQUENCY = 1000.0, 5.0
    OMEGA = 2 * math.pi * FREQUENCY

    def test_comes_back_and_stays_without_force(self):
        for time_step, impulse, largest in ((1e-4, 1000.0012919280966, 0.031831027888353236),
                                            (1e-5, 1000.000012919281, 0.03183098901107811)):
            run = Recorded(self, oscillator(self.MASS, self.FREQUENCY, time_step, 0.3, 0,
                                            "-mass_initial_velocity", "-1,0,0"))
            u = -run.displacement("face.x")
            self.assertAlmostEqual(u.max() / largest, 1, delta=1e-9)
            self.assertAlmostEqual(u.max(), 1 / self.OMEGA, delta=1e-2 * time_step)
            hits = run.force("stop") * time_step
            self.assertAlmostEqual(run.time[(hits > 1).argmax()], 0.1, delta=1.01 * time_step)
            self.assertAlmostEqual(hits.sum() / impulse, 1, delta=1e-8)
            self.assertAlmostEqual(hits.sum(), 1000, delta=20 * time_step)
            # What is left is the depth behind the stop at which a step found it.
            hit = int((hits > 1).argmax())
            depth = abs(u[hit])
            self.assertLess(depth, 1e-3 * time_step)
            self.assertLessEqual(abs(u[hit:]).max(), 1.001 * depth)
            self.assertLessEqual(abs(run.velocity("face.x")[hit:]).max(), 1.01 * self.OMEGA * depth)
            self.assertLess(hits[hit + 1:].sum(), 1.01 * self.MASS * self.OMEGA * depth)

    def test_is_pressed_against_the_stop(self):
        # The spring would rest 2 mm behind the stop, and is let go 10 mm before it: drawn back by
        # that much, or undeformed under the body force that would bring it there.
        behind, before = 0.002, 0.010
        stiffness = self.MASS * self.OMEGA**2
        time = math.acos(behind / (before + behind)) / self.OMEGA
        speed = (before + behind) * self.OMEGA * math.sin(self.OMEGA * time)
        self.assertAlmostEqual(time, 0.0446699620962, delta=1e-12)
        self.assertAlmostEqual(self.MASS * speed, 371.718255693, delta=1e-9)
        # time step: first impulse [N s] and force at rest [N] of the discrete solution
        for time_step, impulse, force in ((1e-4, 371.8751047007731, 1962.8932157827971),
                                          (1e-5, 371.7281958228448, 1973.9069070056682)):
            drawn = (-behind, ["-mass_initial_displacement", f"{-(before + behind)!r},0,0"])
            loaded = (before, ["-mass_gravity", f"{(before + behind) * self.OMEGA**2!r},0,0"])
            for gap, load in (drawn, loaded):
                run = Recorded(self, oscillator(self.MASS, self.FREQUENCY, time_step, 0.5, gap, *load))
                hits = run.force("stop") * time_step
                first = landings(hits)[0]
                self.assertAlmostEqual(run.time[first], time, delta=time_step)
                self.assertAlmostEqual(hits[first] / impulse, 1, delta=1e-8)
                self.assertAlmostEqual(hits[first] / (self.MASS * speed), 1, delta=10 * time_step)
                self.assertLess(abs(run.force("stop")[-1000:] / force - 1).max(), 1e-8)
                self.assertAlmostEqual(force / (stiffness * behind), 1, delta=100 * time_step)
                self.assertEqual(len(landings(hits)), 1)
                self.assertLess(run.displacement("face.x").max() - gap, speed * time_step)


class BallOnAShakenTable(unittest.TestCase):
    """Acceleration A omega^2 sin(omega t) of the table, of Gamma times gravity."""

    FREQUENCY, ACCELERATION, TIME_STEP, END = 10.0, 20.0, 1e-5, 1.0
    # Gamma: first take-off and landing [s], speed of landing [m/s] under 9.81 m/s2, period [s]
    CASES = {1.2: (0.015678525066133136, 0.053912395421116706, 0.08978393283492841, 0.1),
             2.0: (0.008333333333333335, 0.08248125748237993, 0.5984005469313616, 0.1),
             3.0: (0.005408672398469636, 0.10038610368618617, 0.9583786207799878, 0.1),
             5.0: (0.003204710842448747, 0.17660034059918364, 1.0144930620173238, 0.2)}
    MASS = 3.0

    def scene(self, record):
        names = [f"ball{k}" for k in range(len(self.CASES))]
        words = ["-structures", ",".join(names), "-motion_z_record", record,
                 "-motion_z_unit", "m/s2", "-time_step", self.TIME_STEP, "-end_time", self.END,
                 "-output_interval", self.TIME_STEP / 2,
                 "-energy_interval", 10000,  # before the first flight there is no energy
                 "-contacts", ",".join(f"table{k}" for k in range(len(names)))]
        # One ground for all: gravity differs, and times depend on Gamma only. The wall is where
        # the normals of the shells point: up, so everything is upside down.
        for k, (name, gamma) in enumerate(zip(names, self.CASES)):
            words += [f"-{name}_mesh", "tests/meshes/floor.geo", f"-{name}_plate_element", "shell",
                      f"-{name}_plate_material", "skin", f"-{name}_plate_thickness", 0.1,
                      f"-{name}_gravity", f"0,0,{self.ACCELERATION / gamma!r}",
                      f"-table{k}_secondary", f"{name}:plate", f"-table{k}_primary", "wall",
                      f"-table{k}_gap", 0]
        return words + [*material("skin", 1e3, 0, self.MASS / 0.1)]

    def test_takes_off_and_lands(self):
        record = write_sine(self.ACCELERATION, self.FREQUENCY, self.END, 5e-5)
        run = Recorded(self, self.scene(record))
        for k, (gamma, case) in enumerate(self.CASES.items()):
            takeoff, landing, speed, period = case
            impulse = run.force(f"table{k}") * self.TIME_STEP
            lands = landings(impulse)
            leaves = numpy.nonzero((impulse[:-1] > 0) & (impulse[1:] == 0))[0]
            count = math.ceil((self.END - landing) / period)
            with self.subTest(gamma=gamma):
                self.assertGreaterEqual(count, 5)
                self.assertEqual(len(lands), count)
                gravity = self.ACCELERATION / gamma
                for turn in range(count):
                    self.assertAlmostEqual(run.time[leaves[turn]], takeoff + turn * period,
                                           delta=1.5 * self.TIME_STEP)
                    self.assertAlmostEqual(run.time[lands[turn]], landing + turn * period,
                                           delta=1.2 * self.TIME_STEP)
                    self.assertAlmostEqual(impulse[lands[turn]] / self.MASS,
                                           speed * gravity / GRAVITY,
                                           delta=2 * gravity * self.TIME_STEP * (1 + gamma))


class OscillatorBesideAStop(unittest.TestCase):
    MASS, FREQUENCY, RATIO, ACCELERATION, END = 9200.0, 2.1, 0.015, 0.15 * GRAVITY, 5.0
    GROUNDS = (1.0, 2.1, 4.7)  # frequencies [Hz]

    def shake(self, record, time_step):
        alpha = 2 * self.RATIO * 2 * math.pi * self.FREQUENCY
        return Recorded(self, oscillator(self.MASS, self.FREQUENCY, time_step, self.END, 0,
                                         "-mass_damping_alpha", repr(alpha), "-motion_x_record",
                                         record, "-motion_x_unit", "m/s2"))

    def test_impacts_and_motion(self):
        stiffness = self.MASS * (2 * math.pi * self.FREQUENCY)**2
        body = oscillators.Oscillator(self.MASS, stiffness, 2 * self.RATIO * 2 * math.pi * self.FREQUENCY)
        for frequency in self.GROUNDS:
            record = write_sine(self.ACCELERATION, frequency, self.END)
            ground = self.ACCELERATION * numpy.sin(
                2 * math.pi * frequency * numpy.arange(round(self.END / 1e-4) + 1) * 1e-4)
            exact = oscillators.events(body, None, 0.0, ground, 1e-4)
            for time_step in (1e-3, 1e-4, 1e-5):
                run = self.shake(record, time_step)
                impulse = run.force("stop") * time_step
                hits = landings(impulse)
                moved, _, pushed = oscillators.scheme(body, None, 0.0, ground, 1e-4, time_step, self.END)
                with self.subTest(frequency=frequency, time_step=time_step):
                    for time, expected, _ in exact.impacts[:3]:
                        nearest = hits[abs(run.time[hits] - time).argmin()]
                        if expected > 100:  # not a touch at a millimetre per second
                            self.assertAlmostEqual(run.time[nearest], time, delta=3 * time_step)
                            self.assertAlmostEqual(impulse[nearest] / expected, 1,
                                                   delta=30 * time_step)
                    self.assertAlmostEqual(impulse.sum() / pushed.sum(), 1, delta=2e-6)
                    assert_follows(self, run.displacement("face.x"), moved, 1e-7, "face")
                    expected = exact.u1[::50]
                    found = run.displacement("face.x")[::round(5e-3 / time_step)]
                    error = numpy.linalg.norm(found - expected) / numpy.linalg.norm(expected)
                    self.assertLess(error, 25 * time_step)


if __name__ == "__main__":
    unittest.main()
