"""Contacts of different levels: the edge of a slab meets a column between its nodes, columns meet girders and faces.

A slab of shells, 1 m square, moves along x alone; a column 5 cm beyond its edge is fixed at both ends.
References: rest and beam theory; the impulse that stops two lumped masses at a place between nodes.
"""
import unittest

import program
from decks import box_of, clock, contacts, material, section
from recorded import Recorded

YOUNG, DENSITY, THICKNESS, HEIGHT, INERTIA, AREA = 30e9, 2500.0, 0.2, 4.0, 2.1e-4, 0.05
COLUMN = ["-c_stem_element", "beam", "-c_stem_material", "concrete", "-c_stem_section", "square",
          *section("square", AREA, INERTIA, INERTIA, 2 * INERTIA, "1,0,0"), *material("concrete", YOUNG, 0.2, DENSITY)]


def scene(cells, level, elements, *more, y0=-0.5, gap=0.0):
    """A slab of cells x cells at a level of a column of so many elements."""
    return ["-structures", "s,c", "-s_mesh", "tests/meshes/floor.geo", "-s_mesh_set",
            f"z={level},n={cells},x0=-1.05,y0={y0}", "-s_plate_element", "shell", "-s_plate_material", "concrete",
            "-s_plate_thickness", THICKNESS, "-s_clamp", "plate:y+z+rx+ry+rz", "-c_mesh", "tests/meshes/cantilever.geo",
            "-c_mesh_set", f"height={HEIGHT},n={elements}", "-c_clamp", "base,top", *COLUMN,
            *contacts(joint=("s:edge", "c:stem", gap)), "-probes", "mid,edge", "-mid_structure", "c", "-mid_at",
            f"0,0,{HEIGHT * (elements // 2) / elements!r}", "-edge_structure", "s", "-edge_at", f"-0.05,{y0},{level}",
            *more]


PUSH = 50.0  # m/s2 along x


def pushed(cells, elements):
    return scene(cells, HEIGHT / 2, elements, "-s_gravity", f"{PUSH},0,0", "-preload", "static", *clock(1e-6, 2e-6))


class AtRest(unittest.TestCase):
    def deflection(self, cells, elements):
        """Of the column's middle over that of beam theory."""
        run = Recorded(self, pushed(cells, elements), identity=1e-9)
        weight = DENSITY * THICKNESS * PUSH
        force = run.force("joint")[run.time > 0]
        self.assertLess(abs(force / weight - 1).max(), 1e-6)
        return run.displacement("mid.x")[0] / (weight * HEIGHT**3 / (192 * YOUNG * INERTIA)), run

    def test_column_is_bent_as_by_a_force(self):
        for cells in (3, 4):  # mid-edge, and a node of both
            share, run = self.deflection(cells, 4)
            self.assertAlmostEqual(share, 1, delta=1e-6)
            self.assertEqual(run.summary["impacts"]["joint"]["episodes"], 1)

    def test_between_nodes_of_the_column(self):
        """Half of the force at each of the two nodes around: what beam theory says of two forces."""
        _, run = self.deflection(3, 5)
        a, b = 0.4 * HEIGHT, 0.6 * HEIGHT
        under = a**3 * b**3 / 3 + a**4 * (3 * b * HEIGHT - a * (3 * b + a)) / 6
        expected = DENSITY * THICKNESS * PUSH / 2 * under / (YOUNG * INERTIA * HEIGHT**3)
        self.assertAlmostEqual(run.displacement("mid.x")[0] / expected, 1, delta=1e-6)


SPEED = 1.0


def thrown(cells, elements, *more, **place):
    return scene(cells, HEIGHT / 2, elements, "-s_initial_velocity", f"{SPEED},0,0", "-time_step", 1e-5, "-output_interval",
                 1e-5, *more, **place)


# Off the middle, where it slides.
OFF = thrown(3, 7, "-end_time", 0.02, "-joint_friction", 0.3, y0=-0.37, gap=1e-3)


class Impacts(unittest.TestCase):
    def test_first_step_stops_the_places_that_meet(self):
        """Nodes of the edge carry h^2 t rho / 2, those of the column the mass of an element."""
        for cells, elements, edge, column in ((3, 4, (0.5, 0.5), (1,)), (4, 4, (1,), (1,)), (3, 5, (0.5, 0.5), (0.5, 0.5)),
                                              (4, 5, (1,), (0.5, 0.5))):
            run = Recorded(self, thrown(cells, elements, *clock(1e-9, 1e-9)), identity=1e-11)
            node = DENSITY * THICKNESS / cells**2 / 2
            bit = DENSITY * AREA * HEIGHT / elements
            compliance = sum(w**2 for w in edge) / node + sum(w**2 for w in column) / bit
            self.assertAlmostEqual(run.column("impulse")[0] * compliance / SPEED, 1, delta=1e-7)
            self.assertEqual(run.column("points")[0], 1)

    def test_off_the_middle(self):
        run = Recorded(self, OFF, identity=1e-11)
        self.assertGreater(run.column("impulse").sum(), 100)
        self.assertLess(max(run.column("max_penetration")), 1.1 * SPEED * 1e-5)

    def bricks(self, secondary, primary):
        return ["-structures", "b,c", *box_of("b", "x0=0.1,y0=-0.5,z0=0.9,lz=2.2,nz=2", "concrete"),
                "-b_initial_velocity", "-1,0,0", "-c_mesh", "tests/meshes/cantilever.geo", "-c_mesh_set",
                f"height={HEIGHT},n=8", "-c_clamp", "base,top", *COLUMN, *contacts(joint=(secondary, primary, 0.001)),
                *clock(1e-5, 0.02), "-probes", "mid", "-mid_structure", "c", "-mid_at", f"0,0,{HEIGHT / 2}"]

    def test_column_before_a_face_of_bricks(self):
        """Its nodes are kept out of the face, those that face it: between 1 and 3 m there are five of nine."""
        program.must_refuse(self, self.bricks("b:x_min", "c:stem"), "swap the two")
        run = Recorded(self, self.bricks("c:stem", "b:x_min"), identity=1e-10)
        self.assertEqual(run.column("points").max(), 5)
        self.assertGreater(run.column("impulse").sum(), 100)

    def test_girder_before_a_column(self):
        words = ["-structures", "g,c", "-g_mesh", "tests/meshes/cantilever.geo", "-g_mesh_set",
                 "height=0,run=3,x0=-0.2,y0=-1.2,z0=1.7,n=4", "-g_clamp", "base,top", "-g_initial_velocity", "2,0,0",
                 "-c_mesh", "tests/meshes/cantilever.geo", "-c_mesh_set", f"height={HEIGHT},n=7", "-c_clamp",
                 "base,top", *COLUMN, *[word.replace("-c_", "-g_") if isinstance(word, str) else word
                                        for word in COLUMN[:6]], "-section_square_z_axis", "1,0,0", "-contacts", "joint",
                 "-joint_secondary", "g:stem", "-joint_primary", "c:stem", "-joint_gap", 0.002, "-time_step", 1e-5,
                 "-output_interval", 1e-5, "-end_time", 0.02, "-probes", "mid", "-mid_structure", "c", "-mid_at",
                 f"0,0,{HEIGHT * 3 / 7!r}"]
        run = Recorded(self, words, identity=1e-11)
        self.assertEqual(run.column("points").max(), 1)
        self.assertGreater(run.displacement("mid.x").max(), 1e-4)


class Refused(unittest.TestCase):
    def test_what_cannot_be_meant(self):
        good = scene(3, HEIGHT / 2, 4, "-time_step", 1e-5, "-end_time", 1e-5)
        cases = ((["-joint_gap", "geometry"], "give the gap as a number"),
                 (["-joint_primary", "wall", "-joint_secondary", "c:stem"], "look in no direction"),
                 (["-s_mesh_set", "z=2,n=3,x0=-1.05,y0=0.5"], "face"),
                 (["-s_mesh_set", "z=5,n=3,x0=-1.05,y0=-0.5"], "face"))
        for words, text in cases:
            program.must_refuse(self, [*good, *words], text)


# Accelerations are differences of velocities over a step of 1e-5 s.
ROUGH = {"tolerance": 1e-11}
ON_RANKS = {"a slab that strikes a column between its nodes": (OFF, ROUGH),
            "a slab that rests on a column and is torn off": (
                [*pushed(3, 5), *clock(1e-5, 2e-3), "-c_initial_velocity", "2,0,0"], ROUGH),
            "a column before a face of bricks": (Impacts().bricks("c:stem", "b:x_min"), ROUGH)}


if __name__ == "__main__":
    unittest.main()
