"""Stops between nodes: hard ones and ones that give way, one way and both ways, beside closed forms, an integration that is
not this program's, and themselves on other ranks, in modes and in a continued run."""
import math
import os
import tempfile
import unittest

import numpy
import scipy.integrate

import program
from nonlinear_springs_test import mass
from recorded import Recorded, assert_continues, write_sine


def stop(name, secondary, primary, along, gap, **more):
    words = [f"-{name}_secondary", secondary, f"-{name}_primary", primary, f"-{name}_along", along, f"-{name}_gap", gap]
    for option, value in more.items():
        words += [f"-{name}_{option}", value]
    return words


class BouncingMass(unittest.TestCase):
    """SDND108A of Code_Aster's manual of verification: 1 kg falls by 2 m on a spring of 100 N/m; g 10, v0 -1."""
    TOUCH, SPEED, LEAVE = .54031242374329, 6.4031242, .88545615307643

    def fall(self, ranks, *more, step=1e-5, end=1.101, **options):
        words = mass(step, end, "-chain_first_mass", 1, "-gravity", 10, "-chain_initial_velocity", "0,0,-1",
                     "-chain_allow_loose", "true", "-contacts", "floor", "-output_interval", 1e-3, *more,
                     *stop("floor", "chain:first", "wall", "0,0,-1", 2, **options))
        return Recorded(self, words, ranks, identity=1e-11)  # weight over a hundred thousand steps

    def test_on_a_spring(self):
        run = self.fall(2, stiffness=100)
        for time, expected in ((1.0, -1.332162981855), (1.1, -.856394405035)):
            self.assertAlmostEqual(numpy.interp(time, run.time, run.displacement("one.z")), expected, delta=1e-7)
        self.assertAlmostEqual(run.column("start")[0], self.TOUCH, delta=1.1e-5)
        self.assertAlmostEqual(run.column("end")[0], self.LEAVE, delta=1.1e-5)
        before = run.velocity("one.z")[run.time + 5e-6 < self.TOUCH][-1]
        last = run.time[run.time + 5e-6 < self.TOUCH][-1] + 5e-6
        self.assertAlmostEqual(before - 10 * (self.TOUCH - last), -self.SPEED, delta=1e-6)
        impulse = 2 * self.SPEED + 10 * (self.LEAVE - self.TOUCH)
        self.assertAlmostEqual(run.column("impulse")[0] / impulse, 1, delta=1e-6)
        self.assertLess(abs(run.column("energy_lost")[0]), 1e-9)
        depth = (10 + math.sqrt(100 + 100 * self.SPEED**2)) / 100  # k d^2 / 2 = m (v^2 / 2 + g d)
        self.assertAlmostEqual(run.column("max_penetration")[0] / depth, 1, delta=1e-6)
        self.assertAlmostEqual(-run.gap("floor").min() / depth, 1, delta=1e-4)

    def test_second_order(self):
        errors = [abs(numpy.interp(1.0, run.time, run.displacement("one.z")) + 1.332162981855)
                  for run in (self.fall(1, step=step, stiffness=100) for step in (1e-3, 5e-4, 2.5e-4))]
        self.assertLess(errors[2], errors[0] / 6)

    def test_beside_a_dashpot(self):
        """Spring and dashpot press while they push: the integration stops where they would pull."""
        run = self.fall(2, stiffness=100, dashpot=5)
        pushes = lambda t, y: 100 * max(-2 - y[0], 0) - 5 * y[1]  # noqa: E731
        pushes.terminal, pushes.direction = True, -1
        hit = scipy.integrate.solve_ivp(lambda t, y: (y[1], -10 + pushes(t, y)), (self.TOUCH, 3), [-2, -self.SPEED],
                                        events=pushes, rtol=1e-11, atol=1e-12)
        left, (place, speed) = hit.t_events[0][0], hit.y_events[0][0]
        flight = 1.1 - left
        self.assertAlmostEqual(numpy.interp(1.1, run.time, run.displacement("one.z")),
                               place + speed * flight - 5 * flight**2, delta=2e-5)
        self.assertAlmostEqual(run.column("end")[0], left, delta=2e-5)
        lost = (self.SPEED**2 - speed**2) / 2 + 10 * (-2 - place)
        self.assertAlmostEqual(run.column("energy_lost")[0] / lost, 1, delta=2e-4)
        self.assertAlmostEqual(run.energy["devices"] / lost, 1, delta=2e-4)

    def test_on_a_hard_stop(self):
        """The mass of a node stays on what stops it: m v of impulse, m v^2 / 2 lost, and it lies there by its weight."""
        run = self.fall(2, step=1e-4)
        self.assertAlmostEqual(run.column("start")[0], self.TOUCH, delta=1.1e-4)
        self.assertAlmostEqual(run.column("impulse")[0] / (self.SPEED + 10 * (1.1 - self.TOUCH)), 1, delta=1e-3)
        self.assertAlmostEqual(run.column("energy_lost")[0] / (self.SPEED**2 / 2), 1, delta=1e-3)
        self.assertAlmostEqual(run.displacement("one.z")[-1], -2, delta=7e-4)
        self.assertAlmostEqual(run.force("floor")[-5:-1].mean(), 10, delta=1e-6)


class DeadBand(unittest.TestCase):
    """50 kg thrown at 20 kg within a stop that stops both ways, .03 m closing and .05 m opening."""
    SPEED, STIFFNESS = 1.0, 1e6

    def thrown(self, ranks, step, end, *more):
        words = ["-structures", "a,b", "-time_step", repr(step), "-end_time", repr(end), "-output_interval", 2e-4,
                 "-energy_interval", 10, "-probes", "a1,b1", "-contacts", "post", "-impact_merge_time", 1e-4,
                 *stop("post", "a:first", "b:1,0,0", "1,0,0", ".03,.05"), *more]
        for name, weight in (("a", 50), ("b", 20)):
            words += [f"-{name}_mesh", "tests/meshes/chain.geo", f"-{name}_first_element", "point_mass",
                      f"-{name}_first_mass", weight, f"-{name}_second_element", "point_mass", f"-{name}_second_mass", 100,
                      f"-{name}_allow_loose", "true", f"-{name}1_structure", name, f"-{name}1_at", "1,0,0"]
        return Recorded(self, words + ["-a_initial_velocity", f"{self.SPEED},0,0"], ranks)

    def test_swings_between_springs(self):
        """The way between them: free, half a period of both masses on the spring, free, and back."""
        turn = math.pi * math.sqrt(50 * 20 / 70 / self.STIFFNESS)
        period = 2 * (.08 / self.SPEED + turn)
        for ranks in (1, 2):
            run = self.thrown(ranks, 1e-5, .39, "-post_stiffness", self.STIFFNESS)
            way = run.displacement("a1.x") - run.displacement("b1.x")  # positive: they come together
            deepest = self.SPEED * turn / math.pi
            self.assertAlmostEqual(way.max() / (.03 + deepest), 1, delta=5e-5)  # at a sample
            self.assertAlmostEqual(-way.min() / (.05 + deepest), 1, delta=5e-5)
            time = run.time % period
            free = (time < .0299) | ((time > .0301 + turn) & (time < .1099 + turn)) | (time > .1101 + 2 * turn)
            expected = numpy.where(time < .03 + turn / 2, time, numpy.where(
                time < .11 + turn * 1.5, .06 + turn - time, time - period))
            self.assertGreater(free.sum(), 1000)
            self.assertLess(abs(way - self.SPEED * expected)[free].max(), 1e-5)
            self.assertEqual(run.summary["impacts"]["post"]["episodes"], 4)
            limit = 2 / math.sqrt(self.STIFFNESS * (1 / 50 + 1 / 20))  # one spring presses at a time
            self.assertAlmostEqual(run.summary["filler_time_step"] / limit, 1, delta=1e-9)
            momentum = 2 * self.SPEED * 50 * 20 / 70
            self.assertLess(abs(run.column("impulse") / momentum - 1).max(), 1e-6)

    def test_hard_they_go_on_together(self):
        run = self.thrown(2, 1e-4, .2)
        self.assertAlmostEqual(run.column("impulse")[0] / (self.SPEED * 50 * 20 / 70), 1, delta=1e-12)
        self.assertAlmostEqual(run.column("start")[0], .03, delta=1.1e-4)
        for channel in ("a1.x", "b1.x"):
            self.assertAlmostEqual(run.velocity(channel)[-1], self.SPEED * 50 / 70, delta=1e-12)


def yard(*more):
    """Two structures of beams and masses, side by side: one gives way to the other, both ways, hard one way, and by friction."""
    words = ["-structures", "left,right", "-probes", "a,b", "-end_time", .4, "-output_interval", 1e-3,
             "-energy_interval", 5, "-material_steel_young", 2e11, "-material_steel_poisson", .3, "-material_steel_density",
             7800, "-section_rod_area", 4e-3, "-section_rod_inertia_y", 8e-6, "-section_rod_inertia_z", 8e-6,
             "-section_rod_torsion", 1.6e-5, "-section_rod_z_axis", "0,1,0"]
    for name, probe, x0, top in (("left", "a", 0, 300), ("right", "b", 1, 120)):
        words += [f"-{name}_mesh", "tests/meshes/cantilever.geo", f"-{name}_mesh_set", f"y0={x0},n=2,height=3",
                  f"-{name}_clamp", "base", f"-{name}_stem_element", "beam", f"-{name}_stem_material", "steel",
                  f"-{name}_stem_section", "rod", f"-{name}_top_element", "point_mass", f"-{name}_top_mass", top,
                  f"-{name}_top_rotary_inertia", "5,5,5", f"-{probe}_structure", name, f"-{probe}_at", f"0,{x0},3"]
    return words + ["-motion_y_record", write_sine(6, 3, .4), "-motion_y_unit", "m/s2", "-contacts", "post,hook",
                    *stop("post", "left:top", "right:top", "line", ".004,.006", stiffness=4e5, dashpot=200),
                    *stop("hook", "left:0,0,1.5", "right:0,1,1.5", "0,1,0", .002), *more]


class Yard(unittest.TestCase):
    def same(self, one, other, tolerance):
        for channel in ("a.y", "b.y"):
            u, v = one.displacement(channel), other.displacement(channel)
            self.assertLess(abs(u - v).max(), tolerance * abs(u).max())
        self.assertLess(abs(one.force("post") - other.force("post")).max(), tolerance * one.force("post").max())

    def test_on_any_ranks_and_in_modes(self):
        one = Recorded(self, yard("-loops", "post"), 1)
        struck = one.summary["impacts"]
        self.assertGreater(struck["post"]["episodes"], 2)
        self.assertGreater(struck["hook"]["episodes"], 0)
        self.assertGreater(struck["post"]["energy_lost"], 0)
        self.assertAlmostEqual(one.energy["devices"] / struck["post"]["energy_lost"], 1, delta=1e-9)
        loop = one.summary["loops"]["post"]
        self.assertAlmostEqual(loop["largest_elongation"] / struck["post"]["max_penetration"], 1, delta=1e-12)
        for ranks in (2, 3, 4):
            self.same(one, Recorded(self, yard(), ranks), 1e-8)
        modal = [word for name in ("left", "right") for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 24,
                                                                f"-{name}_modal_attachment", "false")]
        step = ("-time_step", repr(one.time_step))
        self.same(one, Recorded(self, yard(*modal, *step), 2), 1e-6)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, yard(), .2, 200)

    def test_friction_of_a_hard_stop(self):
        run = Recorded(self, yard("-hook_friction", .3, "-motion_z_record", write_sine(4, 5, .5), "-motion_z_unit", "m/s2"))
        self.assertGreater(run.summary["impacts"]["hook"]["friction_loss"], 0)


class BeamOnAStop(unittest.TestCase):
    """SDNL32A (SDLX400A) of Code_Aster's manual of verification: a pinned beam, at first turning, strikes an elastic stop at
    its tip. 60 elements of lumped mass, 1 % in each of ten modes: turning, eight of bending, one of stretching."""
    TIP = [-2.66, -4.33, -4.92, -4.78, -3.82, -2.87, -2.71, -3.09, -3.41, -3.36, -2.64, -.742]  # mm, at 1 ... 12 ms
    LENGTH, COUNT, TURNING = .783, 60, -3.8  # m, elements, rad/s

    def largest_errors(self, element):
        """Rows, the third and the last of the table: the largest relative errors on 1 and 2 ranks."""
        with tempfile.TemporaryDirectory() as folder:
            start = os.path.join(folder, "turning.csv")
            with open(start, "w") as file:
                file.write("x,y,z,vy,wz\n")
                for x in numpy.linspace(0, self.LENGTH, self.COUNT + 1):
                    file.write(f"{float(x)!r},0,0,{float(self.TURNING * x)!r},{self.TURNING}\n")
            words = ["-structures", "b", "-b_mesh", "tests/meshes/line.geo", "-b_mesh_set",
                     f"length={self.LENGTH},n={self.COUNT}", "-b_clamp", "x_min:x+y,line:z+rx+ry", "-b_line_element", element,
                     "-b_line_material", "alloy", "-material_alloy_young", 6.7e10, "-material_alloy_poisson", .3,
                     "-material_alloy_density", 2400, "-b_line_section", "RECT14x14", "-section_RECT14x14_z_axis", "0,0,1",
                     "-b_allow_loose", "true", "-b_initial_state", start, "-b_model", "modal", "-b_modal_vectors", 10,
                     "-b_modal_attachment", "false", "-b_modal_damping", .01, "-time_step", 2e-6, "-end_time", .0121,
                     "-output_interval", 1e-5, "-probes", "tip", "-tip_structure", "b", "-tip_group", "x_max", "-contacts",
                     "stop", *stop("stop", "b:x_max", "wall", "0,-1,0", 0, stiffness=18000)]
            errors = []
            for ranks in (1, 2):
                run = Recorded(self, words, ranks, identity=1e-11)
                found = 1e3 * numpy.interp(numpy.arange(1, 13) * 1e-3, run.time, run.displacement("tip.y"))
                errors.append(abs(found / self.TIP - 1))
                self.assertAlmostEqual(found[2] / -4.952, 1, delta=2e-3)
            errors = numpy.max(errors, axis=0)
            return errors[[0, 1, 3, 4, 5, 6, 7, 8, 9, 10]].max(), errors[2], errors[11]

    def test_tip(self):
        for element in ("beam", "euler_beam"):
            with self.subTest(element):
                rows, third, last = self.largest_errors(element)
                self.assertLess(rows, 3e-3)
                self.assertLess(third, 1e-2)
                self.assertLess(last, 1.5e-2)


class Refused(unittest.TestCase):
    def test_by_name(self):
        for more, words in (
                (("-post_passes", 2), ("-post_passes", "-post_along", "no faces")),
                (("-post_gap", "geometry"), ("-post_gap", "one number, or two")),
                (("-post_gap", "-.1"), ("-post_gap", "0 or more")),
                (("-post_along", "0,0,0"), ("-post_along",)),
                (("-post_primary", "wall"), ("-post_along", "no line to a wall")),
                (("-post_friction", .2), ("-post_friction", "only a hard stop")),
                (("-hook_dashpot", 5), ("-hook_dashpot", "-hook_stiffness")),
                (("-export_matrices", "/tmp/none"), ("export_matrices", "-post_stiffness")),
                (("-post_primary", "left:top"), ("-post_primary", "the same node")),
                (("-post_secondary", "left:none"), ("-post_secondary", "is not in the mesh of left", "x,y,z")),
                (("-hook_secondary", "left:base", "-hook_primary", "right:base"), ("-hook_secondary", "can move"))):
            program.must_refuse(self, yard(*more), *words)


if __name__ == "__main__":
    unittest.main()
