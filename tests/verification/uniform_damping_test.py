"""Uniform damping over a band: one ratio at every frequency, exact limits, and a ledger that closes.

K u_n goes through filters, Q_n = K u_n, W_i <- ((1 - c_i) W_i + c_i (Q_n + Q_{n-1})) / (1 + c_i) with
c_i = omega_i dt / 2, and the force is s (Q_n + sum a_i (Q_n - W_i)). A mode at omega
decays as exp(z t), z^2 = -omega^2 s G(z), G = 1 + sum a_i z / (omega_i + z); the step is stable if and
only if omega dt < 2 / sqrt(s (1 + sum a_i)). The recurrences below are written from these lines alone, with the
filters that summary.json lists.
"""
import cmath
import math
import os
import tempfile
import unittest

import numpy

import program
from decks import clock, in_modes, material, probes, section
from recorded import IDENTITY_OF_A_FLIGHT, Recorded
from bar_on_wall_test import LENGTH, MASS, SPEED, SPEED_OF_SOUND, scene as bar_scene, velocity

FREQUENCIES = (1, 3, 10, 30, 100, 300)  # Hz
RATIO = 0.04
OSCILLATOR_MASS = 2.0


def oscillator(name, frequency, *more):
    stiffness = OSCILLATOR_MASS * (2 * math.pi * frequency)**2
    return [f"-{name}_mesh", "tests/meshes/chain.geo", f"-{name}_initial_velocity", "0.1,0,0",
            f"-{name}_first_element", "point_mass", f"-{name}_first_mass", OSCILLATOR_MASS,
            f"-{name}_second_element", "point_mass", f"-{name}_second_mass", 1,
            f"-{name}_support_element", "grounded_spring",
            f"-{name}_support_stiffness", f"{stiffness!r},{stiffness!r},{stiffness!r}",
            f"-{name}_clamp", "second", f"-at_{name}_structure", name, f"-at_{name}_at", "1,0,0", *more]


def oscillators(ratio=RATIO, *more):
    names = [f"f{frequency}" for frequency in FREQUENCIES]
    words = ["-structures", ",".join(names), "-probes", ",".join(f"at_{name}" for name in names)]
    for name, frequency in zip(names, FREQUENCIES):
        words += oscillator(name, frequency, f"-{name}_damping_uniform", ratio, *more)
    return words


class Filters:
    """The law as summary.json tells it, and the scheme for one degree of freedom of unit mass."""

    def __init__(self, damping):
        self.weights = numpy.array([row["weight"] for row in damping["filters"]])
        self.rates = numpy.array([row["rate"] for row in damping["filters"]])
        self.at_rest = damping["stiffness_at_rest"]
        self.at_once = self.at_rest * (1 + self.weights.sum())

    def modulus(self, s):
        return self.at_rest * (1 + (self.weights * s / (self.rates + s)).sum())

    def root(self, omega):
        """s^2 + omega^2 s G(s) = 0 near i omega, by iteration."""
        s = 1j * omega
        for _ in range(200):
            s = 1j * omega * cmath.sqrt(self.modulus(s))
        return s

    def recurrence(self, omega, step, count, speed=0.1, load=0.0):
        u, v, memory, before = 0.0, speed, numpy.zeros(len(self.rates)), 0.0
        c = self.rates * step / 2
        result = numpy.zeros(count + 1)
        for n in range(count):
            q = omega**2 * u
            memory = ((1 - c) * memory + c * (q + before)) / (1 + c)
            force = self.at_rest * (q + (self.weights * (q - memory)).sum())
            v += (step if n > 0 else step / 2) * (load - force)
            before = q
            u += step * v
            result[n + 1] = u
        return result


def decay(time, values):
    """Damping ratio from the peaks of |u|: the logarithms of their heights over the phase."""
    inside = numpy.arange(1, len(values) - 1)
    size = abs(values)
    peaks = inside[(size[inside] >= size[inside - 1]) & (size[inside] > size[inside + 1])]
    peaks = peaks[size[peaks] > 1e-2 * size.max()][1:-1]
    slope = numpy.polyfit(numpy.arange(len(peaks)) * math.pi, numpy.log(size[peaks]), 1)[0]
    return math.sin(math.atan(-slope))


class Oscillators(unittest.TestCase):
    def test_histories_are_those_of_the_scheme(self):
        for filters in (3, 4, 1):
            step = 1e-4
            words = oscillators() + [w for f in FREQUENCIES for w in (f"-f{f}_damping_filters", filters)]
            run = Recorded(self, [*words, *clock(step, 1.2, step / 2)])
            for frequency in FREQUENCIES:
                law = Filters(run.summary["structures"][f"f{frequency}"]["damping"])
                self.assertEqual(len(law.rates), filters)
                u = run.displacement(f"at_f{frequency}.x")
                exact = law.recurrence(2 * math.pi * frequency, step, len(u) - 1)
                self.assertLess(abs(u - exact).max(), 1e-10 * abs(exact).max())

    def test_every_mode_decays_with_the_same_ratio(self):
        for filters, ripple in ((3, 0.0788), (4, 0.0212)):
            words = oscillators() + [w for f in FREQUENCIES for w in (f"-f{f}_damping_filters", filters)]
            run = Recorded(self, [*words, *clock(2e-5, 6, 1e-5), "-energy_interval", 1000])
            for frequency in FREQUENCIES:
                damping = run.summary["structures"][f"f{frequency}"]["damping"]
                self.assertAlmostEqual(damping["ripple"], ripple, delta=1e-4)
                u = run.displacement(f"at_f{frequency}.x")
                cycles = int(min(len(u) - 1, 30 / frequency / 2e-5))
                found = decay(run.time, u[:cycles])
                root = Filters(damping).root(2 * math.pi * frequency)
                with self.subTest(frequency=frequency, filters=filters):
                    self.assertAlmostEqual(found / RATIO, 1, delta=ripple + 0.005)
                    self.assertAlmostEqual(found / (-root.real / abs(root)), 1, delta=0.005)
                    # at its reference, the first mode, the frequency stays
                    self.assertAlmostEqual(abs(root) / (2 * math.pi * frequency), 1, delta=1e-6)

    def test_stable_up_to_the_limit_and_not_beyond(self):
        omega = 2 * math.pi * 30
        for ratio in (0.001, 0.04, 0.3):
            for filters in (1, 3, 8):
                words = ["-structures", "f", "-probes", "at_f", "-modes", 1, "-energy_interval", 1,
                         *oscillator("f", 30, "-f_damping_uniform", ratio, "-f_damping_filters", filters)]
                probe = Recorded(self, [*words, "-end_time", 0.01])
                found = probe.summary["structures"]["f"]
                law = Filters(found["damping"])
                limit = 2 / (omega * math.sqrt(law.at_once))
                self.assertAlmostEqual(found["stable_time_step"] / limit, 1, delta=1e-9)
                for part, count in ((0.9999, 20000), (1.001, 3000)):
                    step = part * limit
                    exact = law.recurrence(omega, step, count)
                    late, early = abs(exact[-1000:]).max(), abs(exact[-2500:-1500]).max()
                    with self.subTest(ratio=ratio, filters=filters, part=part):
                        if part > 1:
                            self.assertGreater(late, early)
                            program.must_refuse(self, [*words, "-time_step", repr(step), "-end_time",
                                                repr(count * step), "-allow_unstable"], "diverged")
                        else:
                            self.assertLess(late, early)
                            run = Recorded(self, [*words, *clock(repr(step), repr(count * step), repr(step / 2))])
                            u = run.displacement("at_f.x")
                            self.assertLess(abs(u - exact[:len(u)]).max(), 1e-8 * abs(exact).max())

    def test_stands_on_the_stiffness_at_rest(self):
        step, weight = 1e-3, 10.0
        run = Recorded(self, ["-structures", "f", "-probes", "at_f", *oscillator(
            "f", 2, "-f_damping_uniform", 0.1, "-f_gravity", f"{weight},0,0", "-f_initial_velocity", "0,0,0"),
            "-time_step", step, "-end_time", 30, "-output_interval", step / 2])
        law = Filters(run.summary["structures"]["f"]["damping"])
        omega = 4 * math.pi
        u = run.displacement("at_f.x")
        self.assertLess(law.at_rest, 0.97)
        self.assertAlmostEqual(u[-1] / (weight / (law.at_rest * omega**2)), 1, delta=1e-8)
        exact = law.recurrence(omega, step, len(u) - 1, speed=0, load=weight)
        self.assertLess(abs(u - exact).max(), 1e-10 * abs(exact).max())

    def test_none_is_none(self):
        step = 1e-4
        words = [*clock(step, 0.2, step / 2)]
        none = Recorded(self, oscillators(0) + words)
        names = ["-structures", "f10", "-probes", "at_f10"]
        plain = Recorded(self, names + oscillator("f10", 10) + words)
        self.assertTrue(numpy.array_equal(none.displacement("at_f10.x"), plain.displacement("at_f10.x")))


def bar_on_wall(law, elements, step, count, gap):
    """Bar of unit section on a wall, lumped masses, one unilateral contact: velocities at the end."""
    h = LENGTH / elements
    stiffness = 900 / h
    mass = numpy.full(elements + 1, h)
    mass[0] = mass[-1] = h / 2
    u = numpy.zeros(elements + 1)
    v = numpy.full(elements + 1, -SPEED)
    before = numpy.zeros(elements + 1)
    memory = numpy.zeros((len(law.rates), elements + 1))
    c = (law.rates * step / 2)[:, None]
    impulse = 0.0
    for n in range(count):
        strain = stiffness * numpy.diff(u)
        q = numpy.zeros(elements + 1)
        q[:-1] -= strain
        q[1:] += strain
        memory = ((1 - c) * memory + c * (q + before)) / (1 + c)
        force = law.at_rest * (q + (law.weights[:, None] * (q - memory)).sum(0))
        before = q
        v -= (step if n > 0 else step / 2) * force / mass
        if gap + u[0] <= 1e-12 and v[0] < 0:
            impulse -= mass[0] * v[0]
            v[0] = 0
        u += step * v
    return v @ mass / mass.sum(), impulse


class BarOnWall(unittest.TestCase):
    ELEMENTS = 50

    def words(self, *more):
        step = 0.9 * LENGTH / self.ELEMENTS / SPEED_OF_SOUND / 1.3
        return step, [*bar_scene(self.ELEMENTS, step, 1.25, 5.00137, "-bar_initial_velocity", f"0,0,-{SPEED}"),
                      "-bar_damping_uniform", RATIO, "-bar_damping_band", "0.3,100", "-bar_damping_reference", 1.5,
                      *more]

    def test_rebound_is_that_of_an_independent_code(self):
        step, words = self.words()
        run = Recorded(self, words, identity=IDENTITY_OF_A_FLIGHT)
        law = Filters(run.summary["structures"]["bar"]["damping"])
        found = velocity(run, self.ELEMENTS)
        rebound, impulse = bar_on_wall(law, self.ELEMENTS, step, len(found) - 1, 5.00137)
        self.assertAlmostEqual(found[-1], rebound, delta=1e-9 * SPEED)
        self.assertAlmostEqual(run.column("impulse").sum(), impulse, delta=1e-9 * impulse)
        self.assertLess(rebound, 0.95 * SPEED)
        self.assertGreater(rebound, 0.7 * SPEED)

    def test_restitution_by_ratio(self):
        """Less is lost than with stiffness damping of the same ratio at c / 4L, half a period of which is contact."""
        for ratio, expected in ((0.01, 0.938), (0.02, 0.897), (0.07, 0.749)):
            _, words = self.words("-bar_damping_uniform", ratio)
            run = Recorded(self, words, identity=IDENTITY_OF_A_FLIGHT)
            found = velocity(run, self.ELEMENTS)[-1] / SPEED
            self.assertAlmostEqual(found, expected, delta=5e-4)
            beta = 2 * ratio / (2 * math.pi * SPEED_OF_SOUND / (4 * LENGTH))
            self.assertGreater(found, 1 - 2 / math.sqrt(math.pi) * math.sqrt(beta * SPEED_OF_SOUND / LENGTH))

    def test_energy_that_is_lost_is_the_loss(self):
        _, words = self.words()
        run = Recorded(self, words, identity=IDENTITY_OF_A_FLIGHT)
        end = run.energy
        start = MASS * SPEED**2 / 2
        self.assertAlmostEqual(end["kinetic"] + end["strain"] + end["damping"] - end["contact"], start,
                               delta=1e-9 * start)
        self.assertGreater(end["damping"], 0.05 * start)

    def test_a_free_body_has_no_mode_to_refer_to(self):
        _, words = self.words()
        place = words.index("-bar_damping_reference")
        program.must_refuse(self, words[:place] + words[place + 2:] + ["-modes", 1], "-bar_damping_reference")


SECTION = [*section("tube", 34e-4, 3e-6, 8e-6, 1e-7, "0,0,1")]
# Mesh, its numbers, what is clamped, the group and its element.
KINDS = {
    "bars": ("line.geo", "length=3,n=12", "x_min", "line", "bar", "-kind_line_area", 1e-3),
    "beams": ("line.geo", "length=3,n=12", "x_min", "line", "beam", "-kind_line_section", "tube", *SECTION),
    "bricks": ("box.geo", "lx=2,ly=1,lz=0.4,nx=5,ny=3,nz=2", "x_min", "body", "hex8"),
    "shells": ("quadrilateral.geo", "length=4,width_0=3,width_1=2,nx=8,ny=6", "x_min", "plate", "shell",
               "-kind_plate_thickness", 0.2)}


class Elements(unittest.TestCase):
    """The limit of structures of every kind of element, with the fastest motions that they have."""

    def words(self, kind, *more):
        mesh, numbers, clamp, group, element, *properties = KINDS[kind]
        return ["-structures", "kind", "-kind_mesh", f"tests/meshes/{mesh}", "-kind_mesh_set", numbers,
                "-kind_clamp", clamp, f"-kind_{group}_element", element, f"-kind_{group}_material", "steel",
                *material("steel", 2e11, 0.3, 7800), *properties, "-kind_initial_velocity", "1,0.5,0.25",
                "-kind_damping_uniform", RATIO, "-kind_damping_reference", 50, "-modes", 0, "-energy_interval", 50,
                *more]

    def test_bounded_below_and_growing_above(self):
        for kind in KINDS:
            _, summary = program.must_run(self, self.words(kind, "-end_time", 1e-6))
            limit = summary["structures"]["kind"]["stable_time_step"]
            with self.subTest(kind):
                folder, summary = program.must_run(self, self.words(
                    kind, "-time_step", repr(0.9999 * limit), "-end_time", repr(8000 * limit)))
                self.assertLess(summary["energy"]["relative_residual"], 1e-11)
                columns = program.read_csv(os.path.join(folder, "energy.csv"))
                total = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
                self.assertGreater(len(total), 100)
                self.assertLess(max(total), 1.02 * total[0])
                self.assertLess(total[-1], 0.9 * total[0])
                program.must_refuse(self, self.words(kind, "-time_step", repr(1.001 * limit), "-end_time",
                                    repr(8000 * limit), "-allow_unstable"), "diverged")


UNIFORM_PAIR = program.COARSE_PAIR + [
    "-s1_damping_alpha", 0, "-s1_damping_beta", 0, "-s1_damping_uniform", 0.02,
    "-s2_damping_alpha", 0, "-s2_damping_beta", 0, "-s2_damping_uniform", 0.05,
    "-floor1_gap", 0.02, "-floor2_gap", "4e-4,2e-4", "-motion_x_pga", 20, "-motion_x_envelope", "0.02,20",
    "-end_time", 0.3, "-output_interval", 2e-4]
REDUCED = [word for name in ("s1", "s2") for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 20)]
CHANNELS = ("s1_floor2.x", "s2_floor2.x", "s2_floor1.z")


class Pair(unittest.TestCase):
    def check_same(self, one, other, tolerance):
        self.assertGreater(one.summary["impacts"]["episodes"], 0)
        self.assertEqual(one.summary["impacts"]["episodes"], other.summary["impacts"]["episodes"])
        for channel in CHANNELS:
            found, expected = other.displacement(channel), one.displacement(channel)
            self.assertLessEqual(abs(found - expected).max(), tolerance * abs(expected).max(), channel)

    def test_a_second_run_repeats_and_no_contact_is_missed_between_two_looks(self):
        for more in ([], REDUCED):
            # Round-off of 8964 steps: 8e-13 and 1.1e-12 were seen, by the last bits of the motion.
            often, again, rarely = (Recorded(self, UNIFORM_PAIR + more + ["-gap_interval", interval], identity=1e-11)
                                    for interval in (2e-4, 2e-4, 0.05))
            self.check_same(often, again, 0)
            self.check_same(often, rarely, 0)
            self.assertEqual(often.summary["impacts"], rarely.summary["impacts"])
            self.assertLess(rarely.summary["interface_looks"], often.summary["interface_looks"])

    def test_matrices_hold_the_stiffness_of_the_materials(self):
        with tempfile.TemporaryDirectory() as folder:
            result = program.must_end(self, UNIFORM_PAIR + ["-dry_run", "-export_matrices", folder])
            written = program.read_csv(os.path.join(folder, "s1", "uniform_damping.csv"))
            own = Recorded(self, UNIFORM_PAIR + ["-time_step", 3.2e-5])
            law = Filters(own.summary["structures"]["s1"]["damping"])
            self.assertEqual([float(rate) for rate in written["rate"]], list(law.rates))
            self.assertEqual([float(weight) for weight in written["weight"]], list(law.weights))
            # Of round-off in K times the motion of the whole, one rank leaves 1.02e-11, two 4.6e-12, three 7.6e-12.
            identity = 1e-11 if program.RANKS > 1 else IDENTITY_OF_A_FLIGHT
            read = Recorded(self, UNIFORM_PAIR + ["-time_step", 3.2e-5, "-s1_matrices", f"{folder}/s1",
                                                  "-s2_matrices", f"{folder}/s2"], identity=identity)
            self.check_same(own, read, 1e-8)

    def test_all_modes_are_the_structure(self):
        words = ["-structures", "box", *probes(top="box:z_max"), "-box_mesh", "tests/meshes/box.geo",
                 "-box_clamp", "z_min", "-box_body_element", "hex8", "-box_body_material", "soft",
                 *material("soft", 3e9, 0.2, 2400), "-box_initial_velocity", "1,2,0", "-box_damping_uniform", 0.1,
                 *clock(1e-5, 0.02)]
        full = Recorded(self, words)
        dofs = full.summary["structures"]["box"]["dofs"]
        modal = Recorded(self, words + [*in_modes("box", dofs)])
        largest = abs(full.displacement("top.y")).max()
        for channel in ("top.x", "top.y", "top.z"):
            error = abs(modal.displacement(channel) - full.displacement(channel)).max()
            self.assertLess(error, 1e-8 * largest)


class WrongInput(unittest.TestCase):
    def check_refused(self, words, *said):
        program.must_refuse(self, ["-structures", "f", "-end_time", 0.01, *oscillator("f", 3), *words], *said)

    def test_refused(self):
        uniform = ["-f_damping_uniform", 0.05]
        self.check_refused(uniform + ["-f_damping_alpha", 1], "-f_damping_alpha", "-f_damping_uniform")
        self.check_refused(uniform + ["-f_damping_ratio", 0.1, "-f_damping_frequencies", "1,2"], "not both")
        self.check_refused(uniform + ["-f_first_damping_beta", 1e-4], "-f_first_damping_beta")
        self.check_refused(uniform + ["-f_damping_band", "400,1"], "-f_damping_band", "lower")
        self.check_refused(uniform + ["-f_damping_band", "0,400"], "-f_damping_band")
        self.check_refused(uniform + ["-f_damping_filters", 9], "-f_damping_filters", "8")
        self.check_refused(["-f_damping_uniform", 5], "-f_damping_uniform", "0.3")
        self.check_refused(["-f_damping_band", "1,40"], "-f_damping_band", "-f_damping_uniform")
        self.check_refused(uniform + [*in_modes("f", 1), "-f_modal_damping", 0.02],
                           "-f_modal_damping")

    def test_doubts(self):
        def warnings(*words):
            run = Recorded(self, ["-structures", "f", "-end_time", 0.01, *oscillator("f", 0.3), *words])
            return [line for line in run.summary["warnings"] if "damping" in line]
        self.assertEqual(warnings("-f_damping_uniform", 0.05, "-f_damping_band", "0.2,100"), [])
        self.assertIn("outside of the band", warnings("-f_damping_uniform", 0.05)[0])
        moved = warnings("-f_damping_uniform", 0.1, "-f_damping_band", "0.2,100", "-f_damping_reference", 30)
        self.assertRegex(moved[0], r"moves its mode of 0.3 Hz by -2\d.* % .*since modes keep their place at 30 Hz")
        self.assertIn("filters hold", warnings("-f_damping_uniform", 0.05, "-f_damping_band", "0.2,1000",
                                               "-f_damping_filters", 2)[0])


# Accelerations are differences of velocities over a step of 3e-5 s.
ON_RANKS = {"a pair with uniform damping": (UNIFORM_PAIR, {"tolerance": 1e-10}),
            "a pair with uniform damping in modes": (UNIFORM_PAIR + REDUCED, {"tolerance": 1e-10}),
            "a pair with uniform damping and scaled mass": (UNIFORM_PAIR + ["-s2_mass_scaling", 1e-4], {"tolerance": 1e-10})}


if __name__ == "__main__":
    unittest.main()
