"""Water of any shape by cells of the mesh: a piston beside its closed solution, a basin that is weighed, shaken and hit.

The added mass itself, of a rigid tank and of coaxial cylinders, is beside closed forms in `unit/system/added_mass_test.cpp`.
"""
import math
import unittest

import program
from recorded import Recorded, assert_continues, write_sine

AREA, STIFFNESS, PISTON = .2, 1e5, 78.0
SIDE = math.sqrt(AREA)
BASIN = ["-structures", "t", "-t_mesh", "tests/meshes/basin.geo", "-t_body_element", "shell", "-t_body_material", "concrete",
         "-t_body_thickness", .2, "-material_concrete_young", 3e10, "-material_concrete_poisson", .2,
         "-material_concrete_density", 2400]
POOL = ["-pools", "pool", "-pool_structure", "t", "-pool_water", "water"]
LX, LY, HEIGHT = 6.0, 4.0, 3.0
SHELL, WATER = 2400 * .2 * (LX * LY + 2 * (LX + LY) * HEIGHT), 1000 * LX * LY * HEIGHT


class Piston(unittest.TestCase):
    """A piston of 78 kg under a column of water of .2 m2 x 1 m whose sides are held: it moves all of it."""

    def frequency(self, *words):
        def corners(heights):
            return ";".join(f"{x!r},{y!r},{z!r}" for z in heights for x in (0, SIDE) for y in (0, SIDE))

        film = ["-t_body_thickness", 1e-3, "-material_concrete_young", 1, "-material_concrete_density", 1e-3]
        held = ["-t_held_points", corners([k / 8 for k in range(1, 9)]), "-t_clamp", "held,feet:x+y+rx+ry+rz"]
        _, found = program.must_run(self, [
            *BASIN, *film, "-t_mesh_set", f"lx={SIDE!r},ly={SIDE!r},h=1,nx=1,ny=1,nz=8,water=1", *words, *held, "-t_feet_points", corners([0]),
            "-t_feet_element", "point_mass", "-t_feet_mass", PISTON / 4, "-t_springs_points", corners([0]), "-t_springs_element",
            "grounded_spring", "-t_springs_stiffness", f"0,0,{STIFFNESS / 4},0,0,0", "-modes", 1, "-end_time", 1e-3])
        return found["structures"]["t"]["frequencies"][0]["frequency"]

    def test_frequency(self):
        self.assertAlmostEqual(self.frequency("-t_ignore", "water"), math.sqrt(STIFFNESS / PISTON) / 2 / math.pi, delta=1e-4)
        wet = self.frequency(*POOL)
        self.assertAlmostEqual(wet, math.sqrt(STIFFNESS / (PISTON + 1000 * AREA)) / 2 / math.pi, delta=1e-4)
        self.assertAlmostEqual(wet, 3.019, delta=1e-3)


class Basin(unittest.TestCase):
    def test_weight(self):
        """Pressures of the water at rest add up to its weight."""
        words = [*BASIN, "-t_mesh_set", "water=1", *POOL, "-t_bed_element", "grounded_spring", "-t_bed_points", f"{LX / 2},{LY / 2},0",
                 "-t_bed_stiffness", "1e9,1e9,1e9,1e9,1e9,1e9", "-gravity", 9.81, "-preload", "static", "-forces", "all",
                 "-all_structure", "t", "-all_kind", "reactions", "-end_time", .01, "-output_interval", .005]
        run = Recorded(self, words)
        self.assertAlmostEqual(run.members("all")[0][2] / (9.81 * (SHELL + WATER)), 1, delta=1e-6)
        self.assertAlmostEqual(run.summary["structures"]["t"]["mass"] / (SHELL + WATER), 1, delta=1e-12)

    def test_rest(self):
        """On a floor that is held it bends both walls outwards, and stays at rest."""
        probes = [word for name, x in (("p", LX), ("q", 0)) for word in (f"-{name}_structure", "t", f"-{name}_at", f"{x},{LY / 2},1.5")]
        run = Recorded(self, [*BASIN, "-t_mesh_set", "water=1", *POOL, "-t_clamp", "floor", "-gravity", 9.81, "-preload", "static",
                              "-probes", "p,q", *probes, "-end_time", .02, "-output_interval", .005])
        out = run.displacement("p.x")
        self.assertGreater(out[0], 1e-4)
        self.assertLess(abs(out / out[0] - 1).max(), 1e-9)
        self.assertAlmostEqual(run.displacement("q.x")[0] / out[0], -1, delta=1e-6)

    def test_tetrahedra(self):
        """Other cells have the same mass, to the errors of their meshes."""
        first = []
        for mesh in ("", ",tets=1"):
            _, found = program.must_run(self, [*BASIN, "-t_mesh_set", "nx=9,ny=6,nz=6,water=1" + mesh, "-t_clamp", "floor", *POOL,
                                               "-modes", 1, "-end_time", 1e-3])
            first.append(found["structures"]["t"]["frequencies"][0]["frequency"])
            self.assertAlmostEqual(found["structures"]["t"]["pools"]["pool"]["mass"] / WATER, 1, delta=1e-12)
        self.assertAlmostEqual(first[0] / first[1], 1, delta=.05)


class HitBasin(unittest.TestCase):
    """A full basin, clamped at its floor, whose wetted wall strikes a rigid one."""
    HIT = [*BASIN, *POOL, "-t_mesh_set", "nx=3,ny=2,nz=4,water=1", "-t_clamp", "floor", "-contacts", "joint", "-joint_secondary",
           "t:high_x", "-joint_primary", "wall", "-joint_gap", 2e-4, "-probes", "p", "-p_structure", "t", "-p_group", "low_x",
           "-motion_x_record", write_sine(-30, 12, .2), "-motion_x_time_step", 1e-4, "-motion_x_unit", "m/s2",
           "-motion_z_record", write_sine(4, 9, .2), "-motion_z_time_step", 1e-4, "-motion_z_unit", "m/s2", "-gravity", 9.81,
           "-preload", "static", "-end_time", .1, "-time_step", 2e-5, "-output_interval", 2e-4, "-energy_interval", 100,
           "-spectra_frequencies", "10"]

    def hit(self, *words, ranks=1):
        run = Recorded(self, [*self.HIT, *words], ranks)
        self.assertGreater(run.summary["impacts"]["total_impulse"], 100)
        return run.displacement("p.x")

    def test_ranks_and_all_modes(self):
        motion = self.hit()
        for ranks in (2, 3):
            self.assertLess(abs(motion - self.hit(ranks=ranks)).max(), 1e-9 * abs(motion).max())
        all_modes = self.hit("-t_model", "modal", "-t_modal_vectors", 1000)
        self.assertLess(abs(motion - all_modes).max(), 1e-8 * abs(motion).max())

    def test_few_modes(self):
        """Their vectors of attachment and residual follow the water as well."""
        motion = self.hit()
        few = self.hit("-t_model", "modal", "-t_modal_vectors", 30)
        self.assertLess(abs(motion - few).max(), .02 * abs(motion).max())

    def test_continues(self):
        assert_continues(self, self.HIT, .05, 2000)


if __name__ == "__main__":
    unittest.main()
