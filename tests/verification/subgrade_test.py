"""Springs and dashpots spread over areas and along lines: a raft on a subgrade, a slab on a wall.

References: the weight over modulus times area; the square root of the modulus over the mass per area; the decay of one
oscillator; springs at corners with a quarter of the area each; the weight over modulus times length.
"""
import math
import os
import tempfile
import unittest

import numpy

import program
from recorded import Recorded, assert_continues

GRAVITY, THICKNESS, DENSITY, CARRIED = 9.81, 0.3, 2400.0, 130.0
MASS = THICKNESS * DENSITY + CARRIED  # kg/m2
MODULUS = 2e7  # N/m3


def raft(**sizes):
    return ["-structures", "t", "-t_mesh", "tests/meshes/raft.geo", "-t_mesh_set",
            ",".join(f"{name}={value}" for name, value in sizes.items()), "-t_raft_element", "shell",
            "-t_raft_material", "stone", "-t_raft_thickness", THICKNESS, "-t_raft_mass_per_area", CARRIED,
            "-material_stone_young", 30e9, "-material_stone_poisson", 0.2, "-material_stone_density", DENSITY,
            "-probes", "p", "-p_structure", "t", "-p_group", "corners", "-end_time", 1e-3, "-output_interval", 1e-3]


def ground(stiffness=MODULUS, dashpot=0.0, extent="area", group="ground"):
    return [f"-t_{group}_element", "grounded_spring", f"-t_{group}_stiffness_per_{extent}",
            f"{stiffness / 2!r},{stiffness / 2!r},{stiffness!r}", f"-t_{group}_dashpot_per_{extent}",
            f"{dashpot!r},{dashpot!r},{dashpot!r}"]


AT_REST = ["-gravity", GRAVITY, "-preload", "static"]
MESHES = ({"lx": 6, "ly": 4, "nx": 6, "ny": 5}, {"lx": 6, "ly": 4, "nx": 11, "free": 1})


class Raft(unittest.TestCase):
    def test_settles_and_bounces_as_one(self):
        """Mass and subgrade are shared out alike, so that a raft of any mesh moves as if it were rigid."""
        for sizes in MESHES:
            for ranks in (1, 2, 3):
                run = Recorded(self, [*raft(**sizes), *ground(), *AT_REST, "-modes", 6], ranks, identity=1e-9)
                settled = -MASS * GRAVITY / MODULUS
                self.assertAlmostEqual(run.displacement("p.z")[0] / settled, 1, delta=1e-9)
                frequencies = [mode["frequency"] for mode in run.summary["structures"]["t"]["frequencies"]]
                bounce = math.sqrt(MODULUS / MASS) / 2 / math.pi
                self.assertLess(min(abs(f / bounce - 1) for f in frequencies), 1e-9)
                self.assertLess(min(abs(f / bounce * math.sqrt(2) - 1) for f in frequencies), 1e-9)

    def test_corners_with_a_quarter_each(self):
        """One quadrangle: springs at its four corners, to the last bit but round-off, at rest, pressed and in motion."""
        area = 2.5 * 1.5
        points = ["-t_corners_element", "grounded_spring", "-t_corners_stiffness",
                  f"{MODULUS * area / 8!r},{MODULUS * area / 8!r},{MODULUS * area / 4!r}", "-t_corners_dashpot",
                  f"{5e4 * area / 4!r},{5e4 * area / 4!r},{5e4 * area / 4!r}"]
        scene = [*raft(lx=2.5, ly=1.5), *AT_REST, "-t_initial_velocity", "0.3,0,0.5", "-end_time", 0.2,
                 "-output_interval", 1e-3, "-time_step", 5e-6, "-energy_interval", 1000]
        for more in ([], ["compression_only"], ["modal"]):
            found = []
            for group, springs in (("ground", ground(dashpot=5e4)), ("corners", points)):
                words = [*scene, *springs]
                if more == ["compression_only"]:
                    words += [f"-t_{group}_compression_only"]
                if more == ["modal"]:
                    words += ["-t_model", "modal", "-t_modal_vectors", 24]
                run = Recorded(self, words, 2, identity=1e-10)
                found.append(numpy.array([run.displacement(f"p.{d}") for d in "xyz"]))
            self.assertGreater(abs(found[0]).max(), 1e-3)
            self.assertLess(abs(found[0] - found[1]).max(), 1e-10 * abs(found[0]).max(), more)

    def test_an_area_in_two_groups_counts_once(self):
        """Gmsh's format 2.2 writes an element once for each of its groups; a third copy is a mistake of the mesh."""
        nodes = ["1 0 0 0", "2 2.5 0 0", "3 2.5 1.5 0", "4 0 1.5 0"]
        for copies in (1, 2):
            elements = ["1 3 2 1 7 1 2 3 4", *(f"{2 + i} 3 2 2 7 1 2 3 4" for i in range(copies)), "5 15 2 3 1 1"]
            with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
                path = os.path.join(folder, "raft.msh")
                with open(path, "w") as file:
                    file.write("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 1 "raft"',
                                          '2 2 "ground"', '0 3 "corners"', "$EndPhysicalNames", "$Nodes", "4", *nodes,
                                          "$EndNodes", "$Elements", str(len(elements)), *elements, "$EndElements", ""]))
                words = [*raft(), *ground(), *AT_REST, "-t_mesh", path]
                at = words.index("-t_mesh_set")
                words = words[:at] + words[at + 2:]
                if copies == 2:
                    program.must_refuse(self, words, "it would count twice")
                    continue
                run = Recorded(self, words, 2, identity=1e-9)
                self.assertAlmostEqual(run.displacement("p.z")[0] / (-MASS * GRAVITY / MODULUS), 1, delta=1e-9)

    def test_what_lifts_off_is_told_by_its_area(self):
        """A heavy edge tips a rigid raft: the far edge, of half the area of a row inside, stands free."""
        run = Recorded(self, [*raft(lx=4, nx=4), *ground(), *AT_REST, "-t_rigid", "raft", "-t_ground_compression_only", "true",
                              "-t_x_min_element", "bar", "-t_x_min_material", "stone", "-t_x_min_area", 1e-4,
                              "-t_x_min_mass_per_length", 4e3, "-p_group", "raft", "-p_average", "false"], 2, identity=1e-9)
        positions, names = run.nodes("p")
        share = numpy.where((positions[:, 0] < 1e-9) | (positions[:, 0] > 4 - 1e-9), 0.5, 1.0)
        pressed = numpy.array([run.displacement(f"{name}.z")[-1] < 0 for name in names])
        self.assertTrue(0 < pressed.sum() < len(pressed))
        ratio = run.summary["contact_ratio"]["t"]["end"]
        self.assertAlmostEqual(ratio, share[pressed].sum() / share.sum(), delta=1e-9)
        self.assertGreater(abs(ratio - pressed.mean()), 0.01)

    def test_dashpots_damp_as_told(self):
        ratio, omega = 0.08, math.sqrt(MODULUS / MASS)
        scene = [*raft(**MESHES[1]), *ground(dashpot=2 * ratio * MASS * omega), "-t_initial_velocity", "0,0,1",
                 "-end_time", 0.5, "-output_interval", 1e-4, "-energy_interval", 500]
        for ranks in (1, 2, 3):
            run = Recorded(self, scene, ranks, identity=1e-10)
            moved = omega * math.sqrt(1 - ratio**2)
            expected = numpy.exp(-ratio * omega * run.time) * numpy.sin(moved * run.time) / moved
            self.assertLess(abs(run.displacement("p.z") - expected).max(), 2e-4 * abs(expected).max())

    def test_a_slab_on_a_wall(self):
        """Springs per length under one edge, which does not turn, carry all of the weight, each its share."""
        for ranks in (1, 2, 3):
            run = Recorded(self, [*raft(lx=2, ly=3, nx=4, ny=6), *ground(3e7, extent="length", group="strip"), *AT_REST,
                                  "-t_clamp", "x_min:ry", "-p_group", "x_min", "-p_average", "false"], ranks,
                           identity=1e-9)
            positions, names = run.nodes("p")
            weights = numpy.where(abs(positions[:, 1] % 3) < 1e-9, 0.25, 0.5)
            carried = -3e7 * sum(w * run.displacement(f"{name}.z")[0] for w, name in zip(weights, names))
            self.assertAlmostEqual(carried / (MASS * GRAVITY * 2 * 3), 1, delta=1e-9)

    def test_continued(self):
        assert_continues(self, [*raft(**MESHES[0]), *ground(dashpot=5e4), *AT_REST, "-t_ground_compression_only",
                                "-t_initial_velocity", "0,0,1", "-time_step", 2e-5, "-end_time", 0.12], 0.1, 2000)


class Refusals(unittest.TestCase):
    def refuse(self, springs, *parts):
        program.must_refuse(self, [*raft(**MESHES[0]), *springs], *parts)

    def test_one_line(self):
        self.refuse([*ground(), "-t_ground_stiffness", "1,1,1"], "-t_ground_stiffness", "not beside",
                    "stiffness_per_area")
        self.refuse([*ground(), "-t_ground_stiffness_per_length", "1,1,1"], "per_length", "lines or of surfaces")
        self.refuse([*ground(), "-t_ground_yield_force", "1,1,1"], "-t_ground_yield_force", "not beside")
        self.refuse(ground(extent="length"), "-t_ground_stiffness_per_length", "'ground'", "takes lines")
        self.refuse(ground(group="strip"), "-t_strip_stiffness_per_area", "takes triangles and quadrangles")
        self.refuse(ground(group="corners"), "-t_corners_stiffness_per_area", "takes triangles")
        self.refuse(ground(0.0), "-t_ground_stiffness_per_area", "all zero")
        self.refuse(["-t_ground_element", "grounded_spring", "-t_ground_stiffness", "1,1,1"], "spread it",
                    "-t_ground_stiffness_per_area")
        self.refuse(["-t_ground_element", "point_mass", "-t_ground_mass", 1, "-t_ground_stiffness_per_area", "1,1,1"],
                    "not for the element point_mass")


if __name__ == "__main__":
    unittest.main()
