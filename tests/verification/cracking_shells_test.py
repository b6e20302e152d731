"""Shells that crack by damage, through the program: one element thrown in tension, bending and shear against its closed
form, published values of Code_Aster, walls against linear ones, ranks, rests, continued runs.

Slopes are those of a strip that may contract across. Without lateral contraction its force in tension has two slopes over
its strain, as the moment has when it is bent to a cylinder; in shear the tensioned diagonal softens and the other one does not.
"""
import os
import tempfile
import unittest

import numpy

import decks
import program
from input.corpus.meshes import document
from loops_test import Loops
from recorded import Recorded, assert_continues
from yielding_shells_test import THICKNESS, YOUNG, wall

CRACKS = {"force": 3e5, "tension": 0.1, "moment": 1e4, "bending": 0.3}


def cracking(force=CRACKS["force"], moment=CRACKS["moment"], tension=CRACKS["tension"], bending=CRACKS["bending"]):
    return ["-w_wall_cracking_force", force, "-w_wall_cracking_moment", moment, "-w_wall_cracked_tension", tension,
            "-w_wall_cracked_bending", bending]


def panel(*more, poisson=0.0, velocity="1,0,0", **values):
    """One square element of 3 m, without mass but at its head."""
    return wall("-material_concrete_density", 1e-3, "-w_wall_drilling_factor", 1e-9,
                "-material_concrete_poisson", poisson, "-w_initial_velocity", velocity, "-output_interval", "1e-5",
                *cracking(**values), *more, sizes="nx=1,nz=1", skeleton=None, time_step=1e-5, mass=5e4, end=0.06)


def turn_of(mass, speed, stiffness, first, ratio):
    """Where a mass turns on a spring of two slopes, the second one `ratio` times the first."""
    force = stiffness * first
    left = mass * speed**2 / 2 - force * first / 2
    slope = ratio * stiffness
    return first + (-force + (force**2 + 2 * slope * left)**0.5) / slope


def ratios(poisson):
    """What stays of membrane and bending energy, with which a strip that is free across has the slopes of CRACKS: the roots
    of s (1 + nu) (1 + 2 p g) = g (1 + p + 2 p g), p = nu / (1 - 2 nu), and s (1 + nu) (1 - nu + nu g) = g (1 + nu g)."""
    p, pulled, bent = poisson / (1 - 2 * poisson), CRACKS["tension"] * (1 + poisson), CRACKS["bending"] * (1 + poisson)
    return (max(numpy.roots([2 * p, 1 + p - 2 * p * pulled, -pulled])),
            max(numpy.roots([poisson, 1 - bent * poisson, -bent * (1 - poisson)])))


class Strip(unittest.TestCase):
    """A square element, held along one edge and free to contract and to curve along it, at rest under loads on the other."""

    @classmethod
    def setUpClass(cls):
        cls.mesh = os.path.join(tempfile.mkdtemp(), "strip.msh")
        with open(cls.mesh, "w") as file:
            file.write(document({1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0)},
                                [(1, 3, 1, (1, 2, 3, 4)), (2, 1, 2, (1, 4)), (3, 15, 3, (1,)), (4, 1, 4, (2, 3))],
                                {1: (2, "slab"), 2: (1, "root"), 3: (0, "pin"), 4: (1, "tip")}))

    def at_rest(self, poisson, what, value):
        words = ["-structures", "w", "-w_mesh", self.mesh, "-w_slab_element", "shell", "-w_slab_material", "concrete",
                 "-w_slab_thickness", THICKNESS, "-material_concrete_young", YOUNG, "-material_concrete_poisson", poisson,
                 "-material_concrete_density", 2400, "-w_clamp", "root:x+z+ry,pin:y+rz", "-preload", "static", "-loads", "pull",
                 "-pull_on", "w:tip", f"-pull_{what}", value, "-probes", "tip", "-tip_structure", "w", "-tip_group", "tip",
                 "-end_time", 1e-5]
        return Recorded(self, [str(word).replace("w_wall", "w_slab") for word in [*words, *cracking()]], identity=1)

    def test_slopes_at_any_poisson_ratio(self):
        pulled, bent = CRACKS["force"] / (YOUNG * THICKNESS), 6 * CRACKS["moment"] / (YOUNG * THICKNESS**3)
        for poisson in (0, 0.2, 0.3):
            x = [self.at_rest(poisson, "force", f"{n * CRACKS['force'] / 2!r},0,0").displacement("tip.x")[0] for n in (2, 3)]
            self.assertAlmostEqual(pulled / (x[1] - x[0]) / CRACKS["tension"], 1, delta=2e-3)
            z = [self.at_rest(poisson, "moment", f"0,{-n * CRACKS['moment'] / 2!r},0").displacement("tip.z")[0] for n in (2, 3)]
            self.assertAlmostEqual(bent / (z[1] - z[0]) / CRACKS["bending"], 1, delta=2e-2)

    def test_finds_a_rest_at_every_load(self):
        """On the second slope, which it is on from 1.4 times the cracking force within some of its width."""
        loads = [1.4, 1.5, 1.6, 1.7, 1.8, 2, 2.5, 3]
        x = [self.at_rest(0.3, "force", f"{n * CRACKS['force'] / 2!r},0,0").displacement("tip.x")[0] for n in loads]
        slope = CRACKS["force"] / (YOUNG * THICKNESS) / CRACKS["tension"]
        for load, found in zip(loads[:-1], x):
            self.assertAlmostEqual((x[-1] - found) / (3 - load) / slope, 1, delta=1e-2)

    def test_more_than_pressure_leaves_is_refused(self):
        program.must_refuse(self, wall(*cracking(tension=0.99), "-w_wall_cracked_compression", 0.2, skeleton=None),
                            "-w_wall_cracked_tension", "beside its cracked_compression")


class OneElement(unittest.TestCase):
    def test_in_tension(self):
        speed = 0.2
        run = Recorded(self, panel("-w_clamp", "foot,head:x+y+rx+ry+rz", velocity=f"0,0,{speed}"))
        first = CRACKS["force"] / (YOUNG * THICKNESS) * 3
        top = turn_of(1e5, speed, YOUNG * THICKNESS, first, CRACKS["tension"])
        z = run.displacement("head.z")
        self.assertGreater(top, 4 * first)
        self.assertAlmostEqual(z.max() / top, 1, delta=1e-5)
        # Back to the origin, and there into sound concrete.
        force = CRACKS["force"] * 3 * (1 + CRACKS["tension"] * (top / first - 1))
        lost = 1e5 * speed**2 / 2 - force * top / 2
        self.assertAlmostEqual(run.energy["plastic"] / lost, 1, delta=1e-4)
        bottom = ((force * top) / (YOUNG * THICKNESS))**0.5
        self.assertAlmostEqual(-z.min() / bottom, 1, delta=1e-4)
        found = run.summary["yielding"]["w:wall:cracking"]
        self.assertAlmostEqual(found["ductility"] / (top / first), 1, delta=1e-5)

    def test_in_shear(self):
        """A head of great mass keeps its speed: stress over strain is that of the closed form at every step."""
        poisson = 0.2
        run = Loops(self, panel("-w_clamp", "foot,head:y+z+rx+ry+rz", "-loops", "w:wall", "-w_head_mass", 1e17,
                                poisson=poisson, velocity="0.1,0,0"))
        strain, stress = run.elongation[:, 0], run.force[:, 0]
        mu = YOUNG / (2 * (1 + poisson)) * THICKNESS
        lame = YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson)) * THICKNESS
        tension, _ = ratios(poisson)
        kept = 1 - tension
        threshold = kept / 4 * (CRACKS["force"] / (YOUNG * THICKNESS))**2 * (lame * (1 - 2 * poisson)**2 + 2 * mu)
        damage = numpy.maximum(0, (mu * kept * strain**2 / 8 / threshold)**0.5 - 1)
        self.assertGreater(damage.max(), 10)
        left = (1 + tension * damage) / (1 + damage)
        expected = mu / THICKNESS * strain * (left + 1) / 2
        self.assertLess(abs(stress - expected).max(), 1e-10 * abs(expected).max())

    def test_in_bending(self):
        """Both ends turn about the level axis against each other, and take the element into a cylinder."""
        poisson, density, rate = 0.2, 2400.0, 6.0
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
            table.write("x,y,z,wx\n")
            for x in (-1.5, 1.5):
                table.write(f"{x},0,0,{-rate}\n{x},0,3,{rate}\n")
            table.flush()
            run = Recorded(self, wall(
                "-w_clamp", "foot:x+y+z+ry+rz,head:x+y+z+ry+rz", "-w_initial_state", table.name, "-output_interval", "1e-5",
                *cracking(), sizes="nx=1,nz=1", skeleton=None, time_step=1e-5, end=0.02))
        inertia = density * THICKNESS * 9 / 4 * THICKNESS**2 / 12  # of each of four nodes
        part = THICKNESS**3 / 12
        mu, lame = YOUNG / (2 * (1 + poisson)) * part, YOUNG * poisson / (1 - poisson**2) * part
        first = CRACKS["moment"] / (lame * (1 - poisson) + 2 * mu) * (
            (lame / 2 * (1 - poisson)**2 + mu) / (lame / 2 + mu))**0.5
        top = turn_of(4 * inertia * rate**2 / 9, 1, lame + 2 * mu, first, ratios(poisson)[1])
        self.assertGreater(top, 3 * first)
        self.assertAlmostEqual(run.summary["yielding"]["w:wall:cracking"]["ductility"] / (top / first), 1, delta=1e-4)


SIZES = "nx=4,nz=4,mixed=1,taper=0.8"


def shaking():
    time = numpy.arange(0, 0.3, 0.005)
    record = program.write_samples(25 * numpy.sin(2 * numpy.pi * 8 * time) * numpy.sin(numpy.pi * time / 0.3), 0.005)
    return ["-motion_x_record", record, "-motion_x_unit", "m/s2", "-motion_y_record", record, "-motion_y_unit", "m/s2",
            "-motion_y_scale", 0.05]


def shaken():
    return wall(*shaking(), *cracking(), "-w_damping_beta", 1e-5, "-w_gravity", "0,0,-9.81", "-head_at", "1.2,0,3", "-loops",
                "w:wall", sizes=SIZES, skeleton=None, end=0.2)


def cracked_at_rest(*more):
    return wall("-w_gravity", "40,0,-9.81", "-preload", "static", "-end_time", 0.02, *cracking(), *more, skeleton=None)


def beside_another():
    """Words of such a wall and a block that meets the ground, each on a rank of its own."""
    return cracked_at_rest(*shaking(), "-end_time", 0.04, "-partition", "structures", "-structures", "w,block",
                           *decks.box_of("block", "x0=9", "concrete"), "-block_clamp", "x_max",
                           *decks.contacts(joint=("block:x_min", "wall", 1e-9)))


class Wall(unittest.TestCase):
    def test_sound_it_is_the_linear_one(self):
        motion = shaking()
        for damping in (["-w_damping_beta", 1e-5], ["-w_damping_uniform", 0.04]):
            words = [*motion, *damping, "-head_at", "1.2,0,3"]
            linear = Recorded(self, wall(*words, sizes=SIZES, skeleton=None))
            marked = Recorded(self, wall(*words, *cracking(force=1e9, moment=1e8), sizes=SIZES, skeleton=None))
            for channel in ("head.x", "head.y", "head.z"):
                expected = linear.displacement(channel)
                self.assertGreater(abs(expected).max(), 1e-6)
                self.assertLess(abs(marked.displacement(channel) - expected).max(), 1e-11 * abs(expected).max())
            self.assertAlmostEqual(marked.summary["stable_time_step"] / linear.summary["stable_time_step"], 1, delta=1e-9)

    def test_cracks_and_is_continued(self):
        words = shaken()
        found = Recorded(self, words).summary["yielding"]["w:wall:cracking"]
        self.assertEqual(found["elements"], 24)
        self.assertGreater(found["ductility"], 2)
        self.assertGreater(found["energy_lost"], 10)
        assert_continues(self, [*words, "-modes", 1, "-spectra_frequencies", 10], 0.1, 3000, 2)

    def test_rest_under_gravity(self):
        x = Recorded(self, cracked_at_rest("-w_gravity", "0.1,0,-9.81")).displacement("head.x")
        self.assertGreater(abs(x[0]), 1e-7)
        self.assertLess(abs(x - x[0]).max(), 1e-10 * abs(x[0]))
        run = Recorded(self, cracked_at_rest())
        self.assertGreater(run.summary["yielding"]["w:wall:cracking"]["ductility"], 1.5)
        self.assertLess(run.energy["plastic"], 1e-9 * run.energy["strain"])
        x = run.displacement("head.x")
        self.assertLess(abs(x - x[0]).max(), 1e-9 * x[0])

    def test_refusals(self):
        for more, said in ((["-w_model", "modal"], "-w_model full"),
                           (["-w_wall_cracked_tension", 1], "[0, 1)"),
                           (["-material_concrete_poisson", -0.1], "whose energy wants"),
                           (["-w_wall_shear_skeleton", "1.2e-4,1.5e6"], "one law or the other"),
                           (["-export_matrices", "/tmp/nothing"], "elements that yield")):
            program.must_refuse(self, wall(*cracking(), *more, skeleton=None), said)
        program.must_refuse(self, wall("-w_wall_cracked_tension", 0.1, skeleton=None), "-w_wall_cracking_force")


# Accelerations are differences of velocities over a step of 2e-5 s.
ON_RANKS = {"a wall that cracks": (lambda: [*shaken(), "-end_time", 0.06], {"tolerance": 1e-11}),
            "a wall at rest that has cracked": (lambda: cracked_at_rest(*shaking(), "-end_time", 0.04), {"tolerance": 1e-11}),
            "one beside ranks that have no part of it": (beside_another, {"tolerance": 1e-11})}


if __name__ == "__main__":
    unittest.main()
