"""Contact at rest under gravity: a body on a rigid wall presses with its weight, and stays.

Constant reactions m g from the first step; a bar on which gravity acts at once, whose reaction
rises as rho c g A t to twice the weight W = rho g L A at t = 2 L/c and is back at zero at 4 L/c,
top displacement up to twice the static rho g L^2 / (2 E); with damping proportional to mass both
settle at the static values. A column of 2 x 2 x 6 hexahedra settles with nodal reactions in the
ratio 1 : 2 : 4 of corner, edge and centre: the tributary areas. The program starts undeformed, so
the static state is reached by damping. Figures of the discrete solution: an independent code.
"""
import math
import unittest

import program
from decks import box_of, clock, contacts, material, probes
from recorded import Recorded

GRAVITY, YOUNG, DENSITY = 9.81, 30e9, 2400.0
SOUND = math.sqrt(YOUNG / DENSITY)


def scene(box, time_step, end_time, *more):
    return ["-structures", "body", *box_of("body", box, "concrete", "hex8_full"),
            *material("concrete", YOUNG, 0, DENSITY), "-body_gravity", f"0,0,{-GRAVITY}",
            *contacts(stop=("body:z_min", "wall", 0)), *clock(repr(time_step), repr(end_time), repr(time_step / 2)),
            "-energy_interval", 1, *probes(top="body:z_max", bottom="body:z_min"), *more]


class RestingBlock(unittest.TestCase):
    def test_reaction_is_the_weight_from_the_first_step(self):
        # Its upper half hangs from the clamp: the lower nodes carry half of the mass.
        for side in (1.0, 0.7):
            run = Recorded(self, scene(f"lx={side},ly={side},lz={side}", 1e-4, 0.02,
                                       "-body_clamp", "z_max"))
            impulse = run.force("stop") * run.time_step
            mass = DENSITY * side**3 / 2
            self.assertAlmostEqual(impulse[0] / (mass * GRAVITY * run.time_step / 2), 1, delta=1e-12)
            self.assertLess(abs(impulse[1:] / (mass * GRAVITY * run.time_step) - 1).max(), 1e-12)
            self.assertLess(abs(run.displacement("bottom.z")).max(), 1e-12)
            self.assertEqual(len(run.column("start")), 1)


class RestingBar(unittest.TestCase):
    LENGTH, ELEMENTS = 5.0, 40
    WEIGHT = DENSITY * GRAVITY * LENGTH
    STATIC = -DENSITY * GRAVITY * LENGTH**2 / (2 * YOUNG)
    TIME_STEP = 0.9 * LENGTH / ELEMENTS / SOUND

    def stand(self, end_time, *more, ranks=program.RANKS):
        return Recorded(self, scene(f"lz={self.LENGTH},nz={self.ELEMENTS}", self.TIME_STEP,
                                    end_time, *more), ranks)

    def test_reaction_rises_to_twice_the_weight(self):
        period = 4 * self.LENGTH / SOUND
        run = self.stand(1.9 * period)
        force = run.force("stop")
        for k in range(len(run.time)):
            phase = (run.time[k] / period) % 1
            exact = 4 * min(phase, 1 - phase)
            self.assertAlmostEqual(force[k] / self.WEIGHT, exact, delta=0.06)
        self.assertAlmostEqual(force.max() / self.WEIGHT, 1.9818062043627513, delta=1e-3)
        self.assertAlmostEqual(run.displacement("top.z").min() / self.STATIC, 2, delta=1e-3)
        self.assertLess(abs(run.displacement("bottom.z")).max(), 1e-12 * self.LENGTH)
        self.assertAlmostEqual(run.energy["contact"], 0, delta=1e-12)

    def test_settled_it_stays_at_rest(self):
        # The program starts undeformed: strong damping brings the bar to its static state.
        alpha = math.pi * SOUND / self.LENGTH  # critical at the first frequency
        for ranks in (1, 2):
            run = self.stand(0.06, "-body_damping_alpha", repr(alpha), ranks=ranks)
            late = run.time > 0.045
            self.assertGreater(late.sum(), 400)
            self.assertLess(abs(run.force("stop")[late] / self.WEIGHT - 1).max(), 1e-11)
            top = run.displacement("top.z")[late]
            self.assertLess(abs(top / self.STATIC - 1).max(), 1e-11)
            self.assertLess(abs(top - top[0]).max(), 1e-18)
            self.assertEqual(len(run.column("start")), 1)

    def test_settles_under_its_weight(self):
        alpha = 444.2882938158366  # 20 % of critical at the first frequency c/(4 L)
        self.assertAlmostEqual(alpha / (0.4 * math.pi * SOUND / (2 * self.LENGTH)), 1, delta=1e-12)
        run = self.stand(0.13, "-body_damping_alpha", repr(alpha))
        force = run.force("stop")
        top = run.displacement("top.z")
        self.assertAlmostEqual(force[-1] / self.WEIGHT, 1, delta=1e-10)
        self.assertAlmostEqual(top[-1] / self.STATIC, 1, delta=1e-10)
        self.assertAlmostEqual(force.max() / self.WEIGHT, 1.5169467098718583, delta=1e-9)
        self.assertAlmostEqual(top.min() / -1.4964108976729424e-05, 1, delta=1e-9)
        self.assertEqual(len(run.column("start")), 1)


class RestingColumn(unittest.TestCase):
    BOX = "lx=0.4,ly=0.4,lz=1.2,nx=2,ny=2,nz=6"
    WEIGHT = DENSITY * GRAVITY * 0.4 * 0.4 * 1.2
    STATIC = -DENSITY * GRAVITY * 1.2**2 / (2 * YOUNG)
    ALPHA = math.pi * SOUND / 1.2  # critical at the first frequency
    TIME_STEP = 4.5e-5
    END = 0.02

    def settle(self, ranks, *more):
        return Recorded(self, scene(self.BOX, self.TIME_STEP, self.END, "-body_damping_alpha",
                                    repr(self.ALPHA), *more), ranks)

    def test_weight_on_a_wall(self):
        for ranks in (1, 2, 3):
            run = self.settle(ranks)
            late = run.force("stop")[run.time > 0.8 * self.END]
            self.assertLess(abs(late / self.WEIGHT - 1).max(), 1e-9)
            self.assertAlmostEqual(run.displacement("top.z")[-1] / self.STATIC, 1, delta=1e-9)
            self.assertEqual(len(run.column("start")), 1)
            self.assertAlmostEqual(run.column("lateral")[0], 0.2, delta=1e-9)
            self.assertAlmostEqual(run.column("vertical")[0], 0.2, delta=1e-9)

    def test_no_flicker_for_any_gap_tolerance(self):
        for tolerance in (1e-15, 1e-9):
            run = self.settle(2, "-gap_tolerance", tolerance)
            late = run.force("stop")[run.time > 0.8 * self.END]
            self.assertLess(abs(late / self.WEIGHT - 1).max(), 1e-9)
            self.assertEqual(len(run.column("start")), 1)

    def test_nodal_reactions(self):
        # Instead of the wall a pad under each node, stiff enough to be rigid to twelve digits.
        pads = ["-structures", "body,pads", "-contacts", "corner,edge,centre", "-pads_mesh", "tests/meshes/pads.geo",
                "-pads_clamp", "base", "-pads_body_element", "hex8_full", "-pads_body_material", "rigid",
                *material("rigid", 1e22, 0, 5e15)]
        for name in ("corner", "edge", "centre"):
            pads += [f"-{name}_secondary", "body:z_min", f"-{name}_primary", f"pads:{name}",
                     f"-{name}_gap", 0, f"-{name}_passes", 1]  # under the nodes of the column alone
        standing = scene(self.BOX, self.TIME_STEP / 2, self.END, "-body_damping_alpha",
                         repr(self.ALPHA))
        at = standing.index("-contacts")
        run = Recorded(self, pads + standing[2:at] + standing[at + 8:])
        late = run.time > 0.8 * self.END
        for name, share in (("corner", 4 * 282.528), ("edge", 4 * 565.056), ("centre", 1130.112)):
            self.assertLess(abs(run.force(name)[late] / share - 1).max(), 1e-9, name)
        self.assertAlmostEqual(run.displacement("top.z")[-1] / self.STATIC, 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
