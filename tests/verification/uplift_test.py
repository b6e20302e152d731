"""Springs that a mat may lift off from: they push up and never pull down.

A mass on one of them, thrown up from its rest under gravity: half a vibration, a flight, and so on,
in closed form. A stiff beam with a mast on a row of them under an inclined gravity: which springs
carry, and how much, by the equilibrium of a rigid body.
"""
import math
import os
import tempfile
import unittest

import numpy

import program
from decks import in_modes, material, probes, section
from recorded import Recorded

GRAVITY = 9.81


class Thrown(unittest.TestCase):
    MASS, STIFFNESS = 100.0, 4e4
    OMEGA = math.sqrt(STIFFNESS / MASS)
    SAG = GRAVITY / OMEGA**2
    SPEED = 2.5 * SAG * OMEGA

    def scene(self, *more):
        return ["-structures", "body", "-body_mesh", "tests/meshes/braces.geo", "-body_ignore", "anchors,left,right",
                "-body_mass_element", "point_mass", "-body_mass_mass", self.MASS, "-body_support_element",
                "grounded_spring", "-body_support_stiffness", f"1e4,1e4,{self.STIFFNESS}",
                "-body_support_compression_only", "true", *probes(body_at="body@0,0,0"), "-time_step", 1e-5,
                "-output_interval", 1e-5, "-gravity", GRAVITY, "-preload", "static", *more]

    def test_flies_and_comes_back_as_it_must(self):
        lift_off = math.asin(1 / 2.5) / self.OMEGA
        speed = self.SPEED * math.cos(lift_off * self.OMEGA)
        flight = 2 * speed / GRAVITY
        period = flight + (math.pi + 2 * lift_off * self.OMEGA) / self.OMEGA
        for more in ([], [*in_modes("body", 3)]):
            run = Recorded(self, self.scene("-end_time", 2 * period + lift_off / 2, "-body_initial_velocity", f"0,0,{self.SPEED}",
                                            "-energy_interval", 1, *more))
            u, time = run.displacement("body_at.z"), run.time
            self.assertAlmostEqual(u[0] / -self.SAG, 1, delta=1e-12)
            self.assertAlmostEqual(u.max() / (speed**2 / (2 * GRAVITY)), 1, delta=1e-5)
            self.assertAlmostEqual(u.min() / (-self.SAG - self.SPEED / self.OMEGA), 1, delta=1e-5)
            level = u - u[0]
            up = numpy.nonzero((level[1:-1] <= 0) & (level[2:] > 0))[0] + 1
            passes = time[up] - level[up] / (level[up + 1] - level[up]) * (time[up + 1] - time[up])
            self.assertGreaterEqual(len(passes), 2)
            self.assertAlmostEqual(passes[-1] / ((len(passes)) * period), 1, delta=1e-5)
            ratio = run.summary["contact_ratio"]["body"]
            self.assertEqual(ratio["smallest"], 0)
            self.assertAlmostEqual(ratio["time_below_80_percent"] / (2 * flight), 1, delta=1e-3)
            self.assertAlmostEqual(ratio["time_of_smallest"], lift_off, delta=1e-4)

    def test_dashpot_acts_while_pressed_and_never_pulls(self):
        run = Recorded(self, self.scene("-end_time", 6, "-body_initial_velocity", f"0,0,{self.SPEED}",
                                        "-body_support_dashpot", "0,0,400"))
        u = run.displacement("body_at.z")
        self.assertAlmostEqual(u[-1] / -self.SAG, 1, delta=1e-3)
        # In flight nothing acts: the height is that of the speed at which it left.
        flying = u > 1e-5
        acceleration = numpy.diff(run.velocity("body_at.z"))[flying[1:]] / run.time_step
        self.assertLess(abs(acceleration / -GRAVITY - 1).max(), 1e-6)
        self.assertGreater(run.energy["devices"], 0)

    def test_what_cannot_be_meant_is_refused(self):
        for more, why in ((["-body_support_stiffness", "1e4,1e4,0"], "its stiffness along z is 0"),
                          (["-body_support_element", "point_mass"], "not for the element point_mass of this group"),
                          ([*in_modes("body", 3), "-body_damping_uniform", 0.02],
                           "leave one of the three out"),
                          (["-body_support_damping_beta", 1e-4], "take the damping of their structure"),
                          (["-export_matrices", tempfile.gettempdir() + "/none", "-dry_run"], "no matrix holds")):
            program.must_refuse(self, [*self.scene("-end_time", 0.01, *more), "-output", tempfile.mkdtemp()], why,
                                ranks=2)


GEOMETRY = """
// A beam of 8 m on nine points, with a mast of 4 m on its middle.
For i In {0:8}
  Point(i + 1) = {i - 4, 0, 0};
EndFor
For i In {1:8}
  Line(i) = {i, i + 1};
EndFor
Point(10) = {0, 0, 4};
Line(9) = {5, 10};
Transfinite Curve {1:9} = 2;
Physical Curve("beams") = {1:9};
Physical Point("bed") = {1:9};
Physical Point("load") = {10};
Physical Point("foot") = {1:9};
"""


class Overturned(unittest.TestCase):
    STIFFNESS, LOAD = 1e6, 1e4

    def rest(self, slope):
        """Settlement and rotation of a rigid beam, and the forces of the springs."""
        x = numpy.arange(9) - 4.0
        closed = numpy.ones(9, dtype=bool)
        for _ in range(50):
            k = self.STIFFNESS * closed
            matrix = numpy.array([[k.sum(), (k * x).sum()], [(k * x).sum(), (k * x * x).sum()]])
            down = numpy.linalg.solve(matrix, [self.LOAD * GRAVITY, self.LOAD * slope * GRAVITY * 4])
            pressed = down[0] + down[1] * x
            if ((pressed > 0) == closed).all():
                return k * pressed
            closed = pressed > 0
        self.fail("no rest found")

    def test_springs_that_carry_are_those_of_a_rigid_body(self):
        handle, mesh = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write(GEOMETRY)
        for slope, carrying, ranks in ((0.3, 9, 1), (0.55, None, 2), (0.7, None, 3)):
            force = self.rest(slope)
            words = ["-structures", "mat", "-mat_mesh", mesh, "-mat_ignore", "foot", "-mat_beams_element", "beam",
                     "-mat_beams_material", "stiff", "-mat_beams_section", "s", *material("stiff", 1e12, 0.3, 100),
                     *section("s", 1e-3, 1, 1, 1, "0,1,0"), "-mat_load_element", "point_mass", "-mat_load_mass",
                     self.LOAD, "-mat_load_rotary_inertia", "1e4,1e4,1e4", "-mat_bed_element", "grounded_spring",
                     "-mat_bed_stiffness", f"1e5,1e5,{self.STIFFNESS},1e3,0,1e3", "-mat_bed_compression_only", "true",
                     "-mat_gravity", f"{slope * GRAVITY},0,{-GRAVITY}", "-preload", "static", "-end_time", 1e-6,
                     "-energy_interval", 1]
            run = Recorded(self, words, ranks, identity=1e-6)
            rest = run.summary["equilibrium"]
            self.assertEqual(rest["acting_links"], (force > 0).sum())
            self.assertEqual(rest["idle_links"], (force == 0).sum())
            if carrying:
                self.assertEqual(rest["acting_links"], carrying)
            else:
                self.assertLess(rest["acting_links"], 9)
            self.assertAlmostEqual(run.summary["contact_ratio"]["mat"]["end"], (force > 0).mean(), delta=1e-12)
            of = rest["structures"]["mat"]
            self.assertAlmostEqual(of["support"][2] / -of["weight"][2], 1, delta=1e-7)
            self.assertAlmostEqual(of["weight"][2] / -(self.LOAD * GRAVITY), 1, delta=0.01)


class SlabOnSprings(unittest.TestCase):
    """Code_Aster's SSNL130A (V6.02.130): a stiff slab of 1 x 2 m, .3 m thick, on a carpet of unilateral springs, 1e4 N/m
    in all, below a pressure 5 (y - 2)^2 N/m2. The pressure is the weight of masses on the nodes, shared out as an element
    shares a pressure. The second load of that problem lifts what the springs stand on by 5 mm, which is no other state
    here, where displacements are relative to it."""
    ACROSS, ALONG, CARPET, PULL = 4, 16, 1e4, 0.1
    CELL = 2 / ALONG

    def loads(self):
        """Force on each row of nodes [N]: integral of the pressure times the hat function of the row."""
        points, weights = numpy.polynomial.legendre.leggauss(4)
        force = numpy.zeros(self.ALONG + 1)
        for row in range(self.ALONG):
            y = (row + (1 + points) / 2) * self.CELL
            pressure = 5 * (y - 2)**2 * weights / 2 * self.CELL
            force[row] += (pressure * (1 - points) / 2).sum()
            force[row + 1] += (pressure * (1 + points) / 2).sum()
        return force

    def scene(self):
        """Text of the geometry and options of its groups: masses by row, springs by the area of the node."""
        i, j = numpy.meshgrid(numpy.arange(self.ACROSS + 1), numpy.arange(self.ALONG + 1), indexing="ij")
        on_side = (i == 0) | (i == self.ACROSS)
        at_end = (j == 0) | (j == self.ALONG)
        tags = 1 + i + (self.ACROSS + 1) * j
        text = [f"Point({1 + a + (self.ACROSS + 1) * b}) = {{{a / self.ACROSS}, {b * self.CELL}, 0}};"
                for b in range(self.ALONG + 1) for a in range(self.ACROSS + 1)]
        text += [f"Line({1000 + tags[a, b]}) = {{{tags[a, b]}, {tags[a + 1, b]}}};"
                 for b in range(self.ALONG + 1) for a in range(self.ACROSS)]
        text += [f"Line({2000 + tags[a, b]}) = {{{tags[a, b]}, {tags[a, b + 1]}}};"
                 for b in range(self.ALONG) for a in range(self.ACROSS + 1)]
        cells = [(a, b) for b in range(self.ALONG) for a in range(self.ACROSS)]
        for a, b in cells:
            text += [f"Curve Loop({tags[a, b]}) = {{{1000 + tags[a, b]}, {2000 + tags[a + 1, b]}, {-1000 - tags[a, b + 1]}, "
                     f"{-2000 - tags[a, b]}}};", f"Plane Surface({tags[a, b]}) = {{{tags[a, b]}}};"]
        made = ", ".join(str(tags[a, b]) for a, b in cells)
        text += ["Transfinite Curve {:} = 2;", "Transfinite Surface {:};", "Recombine Surface {:};",
                 f'Physical Surface("plate") = {{{made}}};']
        words = ["-slab_plate_element", "shell", "-slab_plate_material", "stiff", "-slab_plate_thickness", 0.3]

        def group(name, chosen, *options):
            nonlocal words
            text.append(f'Physical Point("{name}") = {{{", ".join(map(str, tags[chosen]))}}};')
            words += [f"-slab_{name}_{key}" if n % 2 == 0 else key for n, key in enumerate(options)]

        for row, force in enumerate(self.loads()):
            mass = force / self.PULL / self.ACROSS
            for name, chosen, share in (("side", on_side, 0.5), ("inner", ~on_side, 1)):
                group(f"{name}{row}", chosen & (j == row), "element", "point_mass", "mass", repr(share * mass),
                      "rotary_inertia", ",".join(3 * [repr(share * mass)]))
        for name, chosen, share in (("corners", on_side & at_end, 0.25), ("sides", on_side & ~at_end, 0.5),
                                    ("ends", ~on_side & at_end, 0.5), ("middle", ~on_side & ~at_end, 1)):
            stiffness = repr(share * self.CARPET / (self.ACROSS * self.ALONG))
            group(name, chosen, "element", "grounded_spring", "stiffness", ",".join(3 * [stiffness]), "compression_only",
                  "true")
        return "\n".join(text) + "\n", words

    def test_settles_and_lifts_off_as_published(self):
        text, words = self.scene()
        handle, mesh = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write(text)
        corners = [f"{x},{y},0" for y in (0, 2) for x in (0, 1)]
        for ranks in (1, 2, 3):
            run = Recorded(self, ["-structures", "slab", "-slab_mesh", mesh, *words,
                                  *material("stiff", 2e11, 0.3, 1e-6), "-gravity", self.PULL, "-preload", "static",
                                  "-end_time", 1e-6, "-probes", "at", "-at_structure", "slab", "-at_at",
                                  "; ".join(corners), "-at_average", "false"], ranks)
            for corner, published in ((1, -3.532908705e-3), (2, -3.532908705e-3), (3, 1.149763188e-3), (4, 1.149763188e-3)):
                self.assertAlmostEqual(run.displacement(f"at.{corner}.z")[0] / published, 1, delta=1e-6, msg="corners")
            rest = run.summary["equilibrium"]
            self.assertEqual(rest["idle_links"], 4 * (self.ACROSS + 1))  # rows beyond y = 1.5 m
            of = rest["structures"]["slab"]
            self.assertAlmostEqual(of["weight"][2] / (-40 / 3), 1, delta=1e-7)  # and of the slab, next to nothing
            self.assertAlmostEqual(of["support"][2] / -of["weight"][2], 1, delta=1e-10)
            self.assertLess(of["imbalance"], 1e-10)


class PlantPair(unittest.TestCase):
    def test_stands_on_all_of_its_springs(self):
        run = Recorded(self, ["-options_file", "petsc-options/plant/standing.yaml", "-block_mesh_set", "m=1",
                              "-frame_mesh_set", "m=1,x0=24.801", "-end_time", 0.01])
        rest = run.summary["equilibrium"]
        self.assertEqual((rest["acting_links"], rest["idle_links"]), (116, 0))
        for name, weight, settlement in (("block", 160.3e6, 3e-3), ("frame", 15.58e6, 1.3e-3)):
            of = rest["structures"][name]
            self.assertAlmostEqual(of["weight"][2] / -weight, 1, delta=2e-3)
            self.assertLess(of["imbalance"], 1e-10)
            self.assertAlmostEqual(of["settlement"][2] / -settlement, 1, delta=0.35)
            self.assertEqual(run.summary["contact_ratio"][name]["smallest"], 1)


if __name__ == "__main__":
    unittest.main()
