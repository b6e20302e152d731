"""Decks of Abaqus and CalculiX become scenes whose modes are those of the same models written by hand."""
import math
import os
import re
import shutil
import subprocess
import unittest

import imported
from imported import by_hand, close, frequencies, refused, said_mass, same, section, steel, structure

MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, .3\n*DENSITY\n7850.\n"


def nodes(places):
    return "*NODE\n" + "".join(f"{number}, {', '.join(map(repr, map(float, x)))}\n" for number, x in places.items())


def elements(kind, name, cells):
    return f"*ELEMENT, TYPE={kind}, ELSET={name}\n" + "".join(
        f"{number}, {', '.join(map(str, cell))}\n" for number, cell in cells.items())


def block(nx, ny, nz, size):
    """Nodes and bricks of a block, by number."""
    def number(i, j, k):
        return 1 + i + (nx + 1) * (j + (ny + 1) * k)

    places = {number(i, j, k): (size[0] * i / nx, size[1] * j / ny, size[2] * k / nz)
              for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)}
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[number(i + a, j + b, k + c) for a, b,
              c in corners] for k in range(nz) for j in range(ny) for i in range(nx)]
    return places, dict(enumerate(cells, 1))


FRAME = {1: (0, 0, 0), 2: (0, 0, 3), 3: (4, 0, 3), 4: (4, 0, 0), 5: (4, 2, 3), 6: (0, 0.5, 3)}
COLUMNS, GIRDERS = {1: (1, 2), 2: (4, 3)}, {3: (2, 3), 4: (3, 5)}
# 0.2 along direction 1, 0.1 along direction 2; shear areas of 0.85 of it.
RECT = (0.02, 0.2 * 0.1**3 / 12, 0.1 * 0.2**3 / 12)


def torsion(a, b):
    """Of a rectangle, the longer side first (Timoshenko and Goodier, 109)."""
    return a * b**3 / 3 * (1 - 192 * b / (math.pi**5 * a) * sum(
        math.tanh(n * math.pi * a / 2 / b) / n**5 for n in range(1, 4001, 2)))


class Abaqus(unittest.TestCase):
    def test_frame_with_masses_springs_hinges_and_supports(self):
        """Columns with the long side of their section along x, by n1 of the section; girders by n1 and by a node."""
        deck = ("*HEADING\nA frame\n" + nodes(FRAME) + elements("B31", "COLUMNS", COLUMNS) + elements("B31", "GIRDER",
                                                                                                      {3: (2, 3)})
                + elements("B31", "CROSS", {4: (3, 5)}) + elements("MASS", "MACHINE", {11: (5,)})
                + elements("ROTARYI", "TURNING", {12: (5,)}) + elements("SPRING1", "SOIL", {13: (5,)})
                + elements("SPRING2", "LINK", {14: (2, 6)}) + elements("MASS", "HUNG", {15: (6,)})
                + elements("SPRINGA", "STAY", {16: (5, 1)}) + elements("DASHPOT1", "OIL", {17: (5,)}) + MATERIAL
                + "*MASS, ELSET=MACHINE\n500.\n*ROTARY INERTIA, ELSET=TURNING\n20., 30., 40.\n*MASS, ELSET=HUNG\n80.\n"
                "*SPRING, ELSET=SOIL\n3\n2e6\n*SPRING, ELSET=LINK\n1, 1\n4e5\n*SPRING, ELSET=STAY\n\n7e6\n"
                "*DASHPOT, ELSET=OIL\n3\n1e3\n"
                "*BEAM SECTION, SECTION=RECT, ELSET=COLUMNS, MATERIAL=STEEL\n.2, .1\n1., 0., 0.\n"
                "*BEAM SECTION, SECTION=RECT, ELSET=GIRDER, MATERIAL=STEEL\n.2, .1\n0., 0., 1.\n"
                "*BEAM SECTION, SECTION=RECT, ELSET=CROSS, MATERIAL=STEEL\n.2, .1\n0., 0., -1.\n"
                "*RELEASE\n3, S2, ALLM\n*BOUNDARY\n1, ENCASTRE\n4, 1, 3\n6, 2, 3\n*STEP\n*FREQUENCY\n10\n*END STEP\n")
        scene, said = imported.imported(self, "frame.inp", deck)
        hand = {**FRAME, 7: FRAME[3]}  # the hinge
        stay = math.dist(FRAME[5], FRAME[1])
        words = by_hand(hand, {
            "columns": ("line", COLUMNS.values()), "girders": ("line", [(2, 7), (3, 5)]), "machine": ("point", [(5,)]),
            "hung": ("point", [(6,)]), "soil": ("point", [(5,)]), "link": ("line", [(2, 6)]), "stay": ("line", [(5,
                                                                                                                 1)]),
            "foot": ("point", [(1,)]), "pad": ("point", [(4,)]), "guide": ("point", [(6,)]), "hinge": ("point",
                                                                                                       [(3,), (7,)])},
            {"columns_element": "beam", "columns_material": "steel", "columns_section": "c", "girders_element": "beam",
             "girders_material": "steel", "girders_section": "g", "machine_element": "point_mass", "machine_mass": 500,
             "machine_rotary_inertia": "20,30,40", "hung_element": "point_mass", "hung_mass": 80,
             "soil_element": "grounded_spring", "soil_stiffness": "0,0,2e6", "soil_dashpot": "0,0,1e3",
             "link_element": "spring", "link_stiffness": "4e5,0,0", "stay_element": "bar", "stay_material": "rope",
             "stay_area": 7e6 * stay / 1e11, "clamp": "foot,pad:x+y+z,guide:y+z", "pin": "hinge", **steel(),
             "-material_rope_young": 1e11, "-material_rope_poisson": 0, "-material_rope_density": 1e-9,
             **section("c", RECT[0], RECT[2], RECT[1], torsion(0.2, 0.1), "1,0,0", "0.017,0.017"),
             **section("g", RECT[0], RECT[2], RECT[1], torsion(0.2, 0.1), "0,0,1", "0.017,0.017")})
        self.flip(words)
        same(self, scene, words)
        mass, centre = said_mass(said)
        weights = [(7850 * 0.02 * 3, (0, 0, 1.5)), (7850 * 0.02 * 3, (4, 0, 1.5)), (7850 * 0.02 * 4, (2, 0, 3)),
                   (7850 * 0.02 * 2, (4, 1, 3)), (500, FRAME[5]), (80, FRAME[6])]
        total = sum(weight for weight, _ in weights)
        close(self, (mass, *centre), (total, *(sum(w * x[k] for w, x in weights) / total for k in range(3))))
        self.assertIn("supported nodes 3: x 2, y 3, z 3, rx 1, ry 1, rz 1", said)
        self.assertIn("passed over (titles and output): HEADING 1", said)

    def test_a_stick_of_beams_without_mass(self):
        """Its mass is that of points, and the scaled mass for it moves no mode below 33 Hz by more than .1 %: in the
        first, by the axial mode just below, in the second only by the bending modes, up to where the axial one above 33 Hz
        would come below it."""
        inertia, area, length, mass = 6.75e-4, 0.09, 4.0, 20000.0
        deck = (nodes({1: (0, 0, 0), 2: (0, 0, length)}) + elements("B33", "STICK", {1: (1, 2)})
                + elements("MASS", "TOP", {2: (2,)}) + "*MATERIAL, NAME=C\n*ELASTIC\n{young}, .2\n*BEAM GENERAL "
                f"SECTION, ELSET=STICK, SECTION=GENERAL, DENSITY=0.\n{area}, {inertia}, 0., {inertia}, 1.14e-3\n"
                "1., 0., 0.\n{young}, {shear}\n*MASS, ELSET=TOP\n20000.\n*BOUNDARY\n1, ENCASTRE\n")
        for young, below, least in ((3e10, 3, 4.8e-4), (5e10, 2, 4.8e-4)):
            with self.subTest(young):
                scene, said = imported.imported(self, "stick.inp", deck.format(young=young, shear=young / 2.4))
                bending = math.sqrt(3 * young * inertia / mass / length**3) / 2 / math.pi
                axial = math.sqrt(young * area / length / mass) / 2 / math.pi
                found = frequencies(structure(self, scene))
                for value, reference in zip(found[:below], (bending, bending, axial)):
                    self.assertLess(abs(value / reference - 1), 1e-3)
                self.assertEqual(sum(value < 33 for value in found), below)
                self.assertIn("its beams and bars weigh nothing", said)
                step = float(re.search(r'mass_scaling: "(.*)"', scene.read_text())[1])
                self.assertGreater(step, least)
                self.assertIn(f"({below} modes, the highest {(bending, axial)[below > 2]:.4g} Hz", said)
        refused(self, "stick.inp", deck.format(young=3e10, shear=1e10).replace("\n20000.", "\n0."),
                "--density STICK material=2500")

    @staticmethod
    def flip(words):
        """The section has 0.2 along its first direction, so its inertia about that one is the smaller: I about z."""
        for name in ("c", "g"):
            at, to = (words.index(f"-section_{name}_inertia_{axis}") + 1 for axis in "yz")
            assert words[at] > words[to]

    def test_bricks_under_shells_off_their_nodes(self):
        """In mm, t, s; a block of bricks under a plate that has its nodes in its lower face."""
        places, cells = block(3, 2, 2, (900, 400, 600))
        plates = [tuple(n for n in cell[4:]) for cell in list(cells.values())[6:]]
        deck = (nodes(places) + elements("C3D8I", "BODY", cells)
                + elements("S4", "PLATE", dict(enumerate(plates, 200)))
                + "*NSET, NSET=BASE, GENERATE\n1, 12, 1\n*ELSET, ELSET=ALL\nBODY\nPLATE\n"
                "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., .3\n*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=BODY, "
                "MATERIAL=STEEL\n"
                "*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL, OFFSET=-0.5\n20.\n"
                "*NONSTRUCTURAL MASS, ELSET=PLATE, UNITS=MASS PER AREA\n1.5e-7\n*BOUNDARY\nBASE, 1, 3\n")
        scene, said = imported.imported(self, "body.inp", deck, "mm,t,s")
        metres = {n: tuple(value / 1000 for value in x) for n, x in places.items()}
        roof = sorted({n for plate in plates for n in plate})
        lifted = {n: 1000 + n for n in roof}
        hand = {**metres, **{lifted[n]: (*metres[n][:2], 0.61) for n in roof}}
        words = by_hand(hand, {
            "body": ("brick", cells.values()), "plate": ("quadrangle",
                                                         [tuple(lifted[n] for n in plate) for plate in plates]),
            "base": ("point", [(n,) for n in range(1, 13)]), "up": ("point", [(n,) for n in lifted.values()]),
            "down": ("point", [(n,) for n in roof])},
            {"body_element": "hex8", "body_material": "steel", "plate_element": "shell", "plate_material": "steel",
             "plate_thickness": 0.02, "plate_mass_per_area": 150, "clamp": "base", "join": "up:down", **steel()})
        same(self, scene, words)
        brick, plate = 7850 * 0.9 * 0.4 * 0.6, (7850 * 0.02 + 150) * 0.9 * 0.4
        close(self, said_mass(said)[0:1], (brick + plate,))
        close(self, said_mass(said)[1], (0.45, 0.2, (brick * 0.3 + plate * 0.61) / (brick + plate)))
        self.assertIn("C3D8I 12", said)
        self.assertIn("arms 12", said)

    def test_parts_and_instances(self):
        """One part twice, moved and turned about z, joined by a spring of the assembly."""
        part = ("*PART, NAME=POST\n" + nodes({1: (0, 0, 0), 2: (0, 0, 2), 3: (1, 0, 2)}) + elements("B31", "BEAMS", {
            1: (1, 2), 2: (2, 3)}) + "*NSET, NSET=FOOT\n1\n*BEAM SECTION, SECTION=CIRC, ELSET=BEAMS, "
                                     "MATERIAL=STEEL\n.05\n"
            "0., 1., 0.\n*END PART\n")
        deck = ("*HEADING\n" + part + "*ASSEMBLY, NAME=ALL\n*INSTANCE, NAME=A, PART=POST\n*END INSTANCE\n"
                "*INSTANCE, NAME=B, PART=POST\n5., 0., 0.\n5., 0., 0., 5., 0., 1., 90.\n*END INSTANCE\n"
                "*ELEMENT, TYPE=SPRING2, ELSET=LINK\n1, A.3, B.3\n*SPRING, ELSET=LINK\n2, 2\n3e4\n"
                "*NSET, NSET=FEET\nA.FOOT, B.FOOT\n*END ASSEMBLY\n" + MATERIAL + "*BOUNDARY\nFEET, ENCASTRE\n")
        scene, _ = imported.imported(self, "posts.inp", deck)
        hand = {1: (0, 0, 0), 2: (0, 0, 2), 3: (1, 0, 2), 4: (5, 0, 0), 5: (5, 0, 2), 6: (5, 1, 2)}
        area, inertia = math.pi * 0.05**2, math.pi * 0.05**4 / 4
        words = by_hand(hand, {"b": ("line", [(1, 2), (2, 3), (4, 5)]), "d": ("line", [(5, 6)]),
                               "link": ("line", [(3, 6)]), "feet": ("point", [(1,), (4,)])}, {
            "b_element": "beam", "b_material": "steel", "b_section": "s", "d_element": "beam", "d_material": "steel",
            "d_section": "d", "link_element": "spring", "link_stiffness": "0,3e4,0",
            "clamp": "feet", **steel(), **section("s", area, inertia, inertia, 2 * inertia, "0,1,0",
                                                  f"{0.89 * area},{0.89 * area}"),
            **section("d", area, inertia, inertia, 2 * inertia, "1,0,0", f"{0.89 * area},{0.89 * area}")})
        same(self, scene, words)

    def test_rigid_sets_couplings_and_ties_of_nodes(self):
        """A mass on a reference node over the roof of a block; a beam whose foot is coupled with a face."""
        places, cells = block(2, 2, 2, (1, 1, 1))
        roof = [n for n, x in places.items() if x[2] == 1]
        more = {90: (0.5, 0.5, 1.5), 91: (0.5, 0.5, 2.5)}
        deck = (nodes({**places, **more}) + elements("C3D8", "BODY", cells) + elements("B33", "MAST", {50: (90, 91)})
                + elements("MASS", "TOP", {60: (91,)}) + "*NSET, NSET=ROOF\n" + "".join(f"{n},\n" for n in roof)
                + "*NSET, NSET=BASE, GENERATE\n1, 9\n*SURFACE, NAME=UP, TYPE=NODE\nROOF\n" + MATERIAL
                + "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n*MASS, ELSET=TOP\n900.\n"
                "*BEAM GENERAL SECTION, SECTION=GENERAL, ELSET=MAST, DENSITY=7850.\n.01, 2e-5, 0., 1e-5, 3e-5\n1., "
                "0., 0.\n"
                "2.1e11, 8e10\n*COUPLING, CONSTRAINT NAME=FOOT, REF NODE=90, SURFACE=UP\n*KINEMATIC\n1, 6\n"
                "*BOUNDARY\nBASE, 1, 3\n")
        scene, said = imported.imported(self, "mast.inp", deck)
        words = by_hand({**places, **more}, {
            "body": ("brick", cells.values()), "mast": ("line", [(90, 91)]), "top": ("point", [(91,)]),
            "base": ("point", [(n,) for n in range(1, 10)]), "foot": ("point", [(n,) for n in (*roof, 90)])},
            {"body_element": "hex8_full", "body_material": "steel", "mast_element": "euler_beam",
             "mast_material": "steel",
             "mast_section": "m", "top_element": "point_mass", "top_mass": 900, "clamp": "base", "rigid": "foot",
             **steel(),
             **section("m", 0.01, 1e-5, 2e-5, 3e-5 * 8e10 / (2.1e11 / 2.6), "1,0,0")})
        same(self, scene, words)
        self.assertIn("rigid bodies 1", said)

    def test_couplings_of_some_components(self):
        """Heads of masts on a reference node: as wholes, by their displacements, or by one of them."""
        heads = {4: (0, 0, 3), 14: (2, 0, 3), 24: (2, 2, 3), 34: (0, 2, 3)}
        places = {n - 3 + k: (*x[:2], k) for n, x in heads.items() for k in range(4)}
        lines = {100 + n + k: (n - 3 + k, n - 2 + k) for n in heads for k in range(3)}
        start = (nodes(places) + elements("B33", "MAST", lines) + MATERIAL + "*BEAM GENERAL SECTION, SECTION=GENERAL, ELSET=MAST, "
                 "DENSITY=7850.\n.01, 2e-5, 0., 1e-5, 3e-5\n1., 0., 0.\n2.1e11, 8e10\n*BOUNDARY\n1, 1, 6\n11, 1, 6\n21, 1, 6\n"
                 "31, 1, 6\n*NSET, NSET=A\n14, 24\n*NSET, NSET=B\n34,\n*SURFACE, NAME=UP, TYPE=NODE\nA\n")
        groups = {"mast": ("line", lines.values()), "feet": ("point", [(n - 3,) for n in heads]), "hub": ("point", [(4,)]),
                  "whole": ("point", [(4,), (34,)]), "a": ("point", [(14,), (24,)]), "both": ("point", [(14,), (24,), (34,)])}
        for cards, rigid in (("*COUPLING, CONSTRAINT NAME=C, REF NODE=4, SURFACE=UP\n*KINEMATIC\n1, 3\n", "hub:a:x+y+z"),
                             ("*COUPLING, CONSTRAINT NAME=C, REF NODE=4, SURFACE=UP\n*KINEMATIC\n3, 3\n", "hub:a:z"),
                             ("*KINEMATIC COUPLING, REF NODE=4\nA, 2, 3\nB, 1, 6\n", "whole:a:y+z"),
                             ("*KINEMATIC COUPLING, REF NODE=4\nA, 2\nA, 1\nB, 1, 2\n", "hub:both:x+y"),
                             ("*RIGID BODY, REF NODE=4, PIN NSET=A, TIE NSET=B\n", "whole:a:x+y+z")):
            scene, said = imported.imported(self, "masts.inp", start + cards)
            words = by_hand(places, groups, {
                "mast_element": "euler_beam", "mast_material": "steel", "mast_section": "m", "clamp": "feet", "rigid": rigid,
                **steel(), **section("m", 0.01, 1e-5, 2e-5, 3e-5 * 8e10 / (2.1e11 / 2.6), "1,0,0")})
            same(self, scene, words)
            self.assertIn("rigid bodies 1", said)
        imported.refused(self, "masts.inp", start + "*KINEMATIC COUPLING, REF NODE=4\nA, 1, 2\nB, 3\n", "KINEMATIC COUPLING")

    def test_bricks_beside_calculix(self):
        """Modes of a cantilever of C3D8I, extrapolated from two meshes: there masses are consistent, here lumped,
        and both err by h^2 with opposite signs. Bending and stretching agree to 1e-3 on the finer mesh or extrapolated,
        torsion, whose inertia lumps worst, to 2e-3 extrapolated."""
        if not shutil.which("ccx"):
            self.skipTest("CalculiX (ccx) is not there")
        found = {"ccx": [], "pounding": []}
        for fine in (1, 2):
            places, cells = block(16 * fine, 3 * fine, 4 * fine, (3, 0.4, 0.6))
            deck = (nodes(places) + elements("C3D8I", "BODY", cells) + "*NSET, NSET=BASE\n"
                    + "".join(f"{n},\n" for n, x in places.items() if x[0] == 0)
                    + "*MATERIAL, NAME=CONCRETE\n*ELASTIC\n30e9, .2\n*DENSITY\n2400.\n*SOLID SECTION, ELSET=BODY, "
                      "MATERIAL=CONCRETE\n"
                    "*BOUNDARY\nBASE, 1, 3\n*STEP\n*FREQUENCY\n6\n*END STEP\n")
            scene, _ = imported.imported(self, "cantilever.inp", deck)
            found["pounding"].append(frequencies(structure(self, scene, modes=6)))
            path = imported.of_file("cantilever.inp", deck)
            subprocess.run(["ccx", "cantilever"], cwd=path.parent, env={**os.environ, "OMP_NUM_THREADS": "1"},
                           capture_output=True, timeout=300, check=True)
            rows = re.findall(r"^ +\d+ +\S+ +\S+ +(\S+) +\S+$", (path.parent / "cantilever.dat").read_text(),
                              re.MULTILINE)
            found["ccx"].append([float(text) for text in rows[:6]])
        limits = {name: [(4 * b - a) / 3 for a, b in zip(*pair)] for name, pair in found.items()}
        for number, tolerance in enumerate((1e-3, 1e-3, 1e-3, 2e-3, 1e-3, 1e-3)):
            self.assertLess(abs(limits["pounding"][number] / limits["ccx"][number] - 1), tolerance, (number, limits))
        for number in (0, 1, 5):
            self.assertLess(abs(found["pounding"][1][number] / found["ccx"][1][number] - 1), 1e-3, (number, found))


if __name__ == "__main__":
    unittest.main()
