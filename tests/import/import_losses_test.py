"""Cards that have no place in a scene are named with their counts: refused where stiffness, mass or support would be
lost, noted where none would; and files that are none end with one line."""
import random
import unittest

import imported
import program
from imported import imported as import_deck
from imported import refused

ABAQUS = """*NODE
1, 0., 0., 0.
2, 0., 0., 3.
3, 0., 0., 6.
*ELEMENT, TYPE=B31, ELSET=ALL
1, 1, 2
2, 2, 3
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, .3
*DENSITY
7850.
*BEAM SECTION, SECTION=CIRC, ELSET=ALL, MATERIAL=STEEL
.1
1., 0., 0.
*BOUNDARY
1, 1, 6
"""
# Lines added -> the card and how often it is lost.
ABAQUS_LOST = {
    "*ELEMENT, TYPE=C3D20R, ELSET=Q\n9, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3,\n1, 2, 3, 1, 2\n":
        "ELEMENT TYPE=C3D20R 1",
    "*ELEMENT, TYPE=B32\n9, 1, 2, 3\n10, 3, 2, 1\n": "ELEMENT TYPE=B32 2, MID-SIDE NODES THAT OTHERS USE 1",
    "*ELEMENT, TYPE=SPRING1, ELSET=S\n9, 3\n*SPRING, ELSET=S, NONLINEAR\n1\n0., 0.\n1e3, .1\n": "SPRING 1",
    "*ELEMENT, TYPE=SPRING1, ELSET=S\n9, 3\n10, 2\n": "ELEMENT TYPE=SPRING1 2",
    "*ELEMENT, TYPE=SPRING2, ELSET=S\n9, 2, 3\n*SPRING, ELSET=S\n1, 2\n1e5\n": "SPRING 1",
    "*MATERIAL, NAME=SOFT\n*HYPERELASTIC\n1., 2.\n*PLASTIC\n2e8\n": "HYPERELASTIC 1, PLASTIC 1",
    "*CONTACT PAIR, INTERACTION=I\nA, B\n*CONTACT PAIR, INTERACTION=I\nC, D\n": "CONTACT PAIR 2",
    "*MPC\nLINK, 2, 3\n": "MPC LINK 1",
    "*EQUATION\n3\n1, 1, 1., 2, 1, -2., 3, 1, 1.\n": "EQUATION 1",
    "*SURFACE, NAME=S, TYPE=NODE\n2\n*COUPLING, REF NODE=3, SURFACE=S\n*DISTRIBUTING\n1, 3\n": "COUPLING DISTRIBUTING "
                                                                                               "1",
    "*RELEASE\n2, S1, M1\n": "RELEASE M1 1",
    "*TRANSFORM, NSET=ROOF\n1., 1., 0., -1., 1., 0.\n*NSET, NSET=ROOF\n3\n*BOUNDARY\nROOF, 1\n": "BOUNDARY 1",
    "*ELEMENT, TYPE=MASS, ELSET=M\n9, 3\n*MASS, ELSET=M, TYPE=ANISOTROPIC\n1., 2., 3.\n": "MASS 1",
    "*ELSET, ELSET=TOP\n2\n*BEAM SECTION, SECTION=CIRC, ELSET=TOP, MATERIAL=STEEL, OFFSET1=.5\n.1\n1., 0., 0.\n":
        "BEAM SECTION OFFSET1 1",
    "*NODE, NSET=MORE, INPUT=nodes.txt\n": "NODE INPUT 1",
    "*USER ELEMENT, NODES=2, TYPE=U1\n1, 2\n": "USER ELEMENT 1",
}
ABAQUS_NOTED = {
    "*STEP\n*STATIC\n1., 1.\n*CLOAD\n3, 1, 5.\n*DLOAD\nALL, GRAV, 9.81, 0., 0., -1.\n*NODE PRINT\nU\n*END STEP\n":
        ("CLOAD 1", "DLOAD 1", "NODE PRINT 1", "loads and steps"),
    "*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n*BOUNDARY, TYPE=ACCELERATION, AMPLITUDE=A\n1, 1, 1, 1.\n": ("BOUNDARY 1",),
}

NASTRAN = """SOL 103
CEND
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,0.,0.,3.
GRID,3,,0.,0.,6.
CBAR,1,1,1,2,1.,0.,0.
CBAR,2,1,2,3,1.,0.,0.
PBARL,1,1,,ROD
,.1
MAT1,1,2.1+11,,.3,7850.
SPC1,1,123456,1
"""
NASTRAN_LOST = {
    "CHEXA,9,1,1,2,3,1,2,3,\n,1,2,3,1,2,3,1,2,\n,3,1,2,3,1,2\n": "CHEXA of second order 1",
    "RBE3,9,,3,123456,1.,123,1,2\nRBE3,10,,3,123456,1.,123,1,2\n": "RBE3 2",
    "CBUSH,9,9,2,3,1.,1.,0.\nPBUSH,9,K,1.+6,1.+6,2.+6\n": "CBUSH 1",
    "PCOMP,9,,,,,,,,\n,1,.01,0.\n": "PCOMP 1",
    "MAT9,9,1.+11,1.+10\nMATS1,1,,PLASTIC,1.+9\n": "MAT9 1, MATS1 1",
    "MPC,1,1,1,1.,2,1,-2.\n": "MPC 1",
    "TF,9,2,1,1.,0.,0.\n,3,1,-1.,0.,0.\n": "TF 1",
    "CBAR,9,1,1,3,0.,1.,0.,,\n,,56\n": "PINS 56 OF CBAR 1",
    "CBAR,9,8,1,3,0.,1.,0.\nPBARL,8,1,,T\n,.1,.1,.01,.01\n": "PBARL T 1",
    "CONM2,9,3,,5.,,,,,\n,1.,.5,1.\n": "I OF CONM2 1",
    "SPOINT,9\nCELAS1,10,10,9,0\nPELAS,10,1.+5\n": "CELAS1 1",
    "CORD2R,5,,0.,0.,0.,1.,1.,0.,\n,0.,0.,1.\nGRID,9,,1.,0.,0.,5\nSPC1,1,1,9\n": "SPC1 1",
    "CSHEAR,9,1,1,2,3,1\nACMODL\n": "ACMODL 1, CSHEAR 1",
    "CROD,9,9,1,3\nPROD,9,1,.01,1.-5\n": "J OF PROD 1",
}
NASTRAN_NOTED = {
    "FORCE,1,3,,5.,1.,0.,0.\nGRAV,2,,9.81,0.,0.,-1.\nEIGRL,1,,,10\nPARAM,POST,-1\n": (
        "FORCE 1, GRAV 1", "EIGRL 1, PARAM 1"),
}
NASTRAN_NONE = {
    NASTRAN + "GRID,1,,0.,0.,1.\n": "line 13: GRID 1 is given twice, in another way at model.bdf line 4",
    NASTRAN + "CBAR,9,1,1,7,1.,0.,0.\n": "line 13: node 7 is not in the file",
    NASTRAN + "GRID,9,,0.,o.,0.\n": "line 13: GRID: 'o.' is not a number",
    NASTRAN + "CBAR,9,3,1,3,0.,1.,0.\n": "line 13: element 9 has no section or property",
    NASTRAN + "GRID,9,8,0.,0.,0.\n": "coordinate system 8 is not in the deck",
    NASTRAN + "SPC1,2,123,3\n": "say SPC = one of them",
    NASTRAN.replace("CEND", "CEND\nSPC = 4"): "SET 4 OF SPC 1 would be lost",
    NASTRAN.replace("1.,0.,0.", "0.,0.,1."): "lies along its axis",
    NASTRAN.replace("7850.", ""): "--density 1=2500",
    NASTRAN.replace("2.1+11,", "0.,8.+10"): "material 1 has Young's modulus 0 Pa",
    "+,1,2\n": "line 1: a continuation of no card",
    "*NODE\n1, 0., 0., 0.\n": "line 1: a continuation of no card",
    "12,1,2\n": "line 1: '12' is no card",
    "$ nothing\n": "no element in it",
}

ANSYS = """/PREP7
ET,1,188
NBLOCK,6,SOLID,         3,         3
(3i9,6e21.13e3)
        1        0        0
        2        0        0 0.0000000000000E+000 0.0000000000000E+000 3.0000000000000E+000
        3        0        0 0.0000000000000E+000 0.0000000000000E+000 6.0000000000000E+000
N,R5.3,LOC,       -1,
EBLOCK,19,SOLID,         2,         2
(19i9)
        1        1        0        1        0        0        0        0        2        0        1        1        2
        1        1        0        1        0        0        0        0        2        0        2        2        3
       -1
MP,EX,1,2.1e11
MP,PRXY,1,.3
MP,DENS,1,7850
SECTYPE,1,BEAM,CSOLID
SECDATA,.1
D,1,ALL
"""


def ansys_elements(type_, *nodes):
    row = [1, 2, 0, 0, 0, 0, 0, 0, len(nodes), 0, 9, *nodes]
    return f"ET,2,{type_}\nEBLOCK,19,SOLID,1,1\n(19i9)\n" + "".join(f"{value:9d}" for value in row) + "\n       -1\n"


ANSYS_LOST = {
    ansys_elements(186, *[1, 2, 3, 1] * 5): "ELEMENT SOLID186 1",
    ansys_elements(174, 1, 2, 3, 1): "ELEMENT 174 1",
    "CE,R5.0,1,0.0\nCE,R5.0,1,2,UX,1.0\n": "CE 2",
    "CP,1,UX,2,3\n": "CP 1",
    "TB,BISO,1\n": "TB 1",
    "MP,EY,1,1e10\n": "MP OF OTHER AXES 1",
    "SECTYPE,2,BEAM,Z\nSECDATA,1,1,1,1,1,1\n" + ansys_elements(188, 1, 3).replace(
        "        0        0        0        0        0        0        2", "        0        2        0        0      "
                                                                           "  0        0        2"):
        "SECTYPE BEAM Z 1",
    ansys_elements(21, 3).replace("        2        0", "        2        5",
                                  1) + "KEYOPT,2,3,0\nR,5,1,2,3\n": "ELEMENT 21 OF DIRECTIONS 1",
    ansys_elements(185, 1, 1, 2, 2, 3, 3, 3, 1): "ELEMENT 185 PYRAMID 1",
    "RBE3,1,ALL\nCERIG,1,2\n": "CERIG 1, RBE3 1",
    "NSEL,S,LOC,Z,6\nD,ALL,UX\n": "D OF SELECTED NODES 1",
    "CP,R5.0,UX,2,3\nD,3,UXX\n": "CP 1, D UXX 1",
}
ANSYS_NOTED = {
    "F,3,FX,5.\nSFE,1,1,PRES,,1.\nACEL,0,0,9.81\nD,3,TEMP,5\nANTYPE,2\n/GO\nFINISH\n": (
        "ACEL 1, F 1, SFE 1", "ANTYPE 1, FINISH 1", "D TEMP 1"),
}
ANSYS_NONE = {
    ANSYS.replace("N,R5.3,LOC,       -1,\n", ""): "line 8: 'EBLOCK,19' is not a whole number",
    ANSYS.replace("(19i9)", "19i9"): "line 10: '19i9' is no format",
    ANSYS[:ANSYS.index("       -1\nMP")]: "the file ends within a block",
    ANSYS + "D,7,ALL\n": "line 20: node 7 is not in the file",
    ANSYS.replace("DENS,1,7850", "DENS,1,heavy"): "line 16: MP: 'heavy' is not a number",
    ANSYS.replace("MP,DENS,1,7850\n", ""): "--density 1=2500",
    ANSYS.replace("MP,EX,1,2.1e11\n", ""): "material 1 is not in the file",
    ANSYS.replace("CSOLID\nSECDATA,.1", "RECT\nSECDATA,.1"): "line 17: a section RECT has 2 dimensions",
    ANSYS.replace("ET,1,188", "ET,4,188"): "element type 1 is not in the file",
    "/PREP7\n": "no element in it",
}

DYNA = """*KEYWORD
*NODE
       1             0.0             0.0             0.0       7       7
       2             0.0             0.0             3.0
       3             0.0             0.0             6.0
*MAT_ELASTIC
         1    7850.0    2.1e11       0.3
*SECTION_BEAM
         1         2       1.0
      0.01      1e-5      1e-5      2e-5
*PART
mast
         1         1         1
*ELEMENT_BEAM
       1       1       1       2
       2       1       2       3
"""
DYNA_LOST = {
    "*ELEMENT_SEATBELT\n       9       1       2       3\n      10       1       2       3\n": "ELEMENT_SEATBELT 2",
    "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n         1         2\n": "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE 1",
    "*CONSTRAINED_INTERPOLATION\n         1         2\n*CONSTRAINED_SPOTWELD\n         1         2\n":
        "CONSTRAINED_INTERPOLATION 1, CONSTRAINED_SPOTWELD 1",
    "*MAT_PIECEWISE_LINEAR_PLASTICITY\n         2    7850.0    2.1e11       0.3\n*PART\nother\n         2         1   "
    "      2\n":
        "MAT_PIECEWISE_LINEAR_PLASTICITY 1",
    "*ELEMENT_BEAM\n       9       1       1       3       0       0       4\n":
        "RELEASES OF ELEMENT_BEAM 1",
    "*BOUNDARY_SPC_NODE\n         3         7         1         0         0         0         0         0\n":
        "BOUNDARY_SPC 1",
    "*ELEMENT_INERTIA\n       9       3       0\n       1.0       0.5       0.0       1.0       0.0       1.0       "
    "5.0\n": "ELEMENT_INERTIA 1",
    "*PART\nspring\n         3         3         3\n*SECTION_DISCRETE\n         3         0\n       "
    "0.0\n*MAT_SPRING_NONLINEAR_ELASTIC\n"
    "         3         5\n*ELEMENT_DISCRETE\n       9       3       1       3       0\n":
        "ELEMENT_DISCRETE 1, MAT_SPRING_NONLINEAR_ELASTIC 1",
    "*SECTION_BEAM\n         4         6\n      0.01      1e-5         2\n*PART\npad\n         4         4         4\n"
    "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n         4    1000.0       1e6       1e6       1e6\n       0.0\n"
    "*ELEMENT_BEAM\n       9       4       2       3\n": "SECTION_BEAM ELFORM 6 1",
}
DYNA_NOTED = {
    "*LOAD_BODY_Z\n         1      9.81\n*CONTROL_TERMINATION\n       1.0\n*DATABASE_GLSTAT\n     0.001\n*END\n": (
        "LOAD_BODY_Z 1", "CONTROL_TERMINATION 1, DATABASE_GLSTAT 1, END 1, KEYWORD 1"),
}
DYNA_NONE = {
    DYNA + "*NODE\n       3             0.0             0.0             7.0\n":
        "line 18: node 3 is there already, at model.k line 5",
    DYNA + "*ELEMENT_BEAM\n       9       1       3       7\n": "line 18: node 7 is not in the file",
    DYNA + "*ELEMENT_BEAM\n       9       6       1       3\n": "line 18: part 6 is not in the deck",
    DYNA + "*ELEMENT_SHELL\n       9       1       1       2       3\n": "part 1 has no *SECTION_SHELL 1",
    DYNA.replace("    2.1e11", "      hard"): "line 7: 'hard' is not a number",
    DYNA.replace("    7850.0", "       0.0"): "--density 1=2500",
    DYNA + "*BOUNDARY_SPC_SET\n         5         0         1         1         1         0         0         0\n":
        "line 18: node set 5 is not",
    DYNA.replace("1e-5      1e-5", "1e-5      2e-5"): "has no third node",
    DYNA.replace("*KEYWORD", "*KEYWORD LONG=Y"): "line 1: long formats",
    "       1     2\n": "line 1: a card before the first keyword",
    "*KEYWORD\n*END\n": "no element in it",
}


class Losses(unittest.TestCase):
    def hold(self, name, deck, lost, noted):
        """Each is refused with its count, and goes by the names that the refusal gives; or it is noted."""
        for more, cards in lost.items():
            with self.subTest(cards):
                said = refused(self, name, deck(more), f"{cards} would be lost")
                for card in cards.split(", "):
                    self.assertIn(f"LOST: {card}, first at {name} line ", said)
        for more, parts in noted.items():
            with self.subTest(parts):
                _, said = import_deck(self, name, deck(more))
                for part in parts:
                    self.assertRegex(said, rf"(?m)^passed over.*{part}")

    def test_abaqus(self):
        self.hold("model.inp", lambda more: ABAQUS + more, ABAQUS_LOST, ABAQUS_NOTED)

    def test_nastran(self):
        self.hold("model.bdf", lambda more: NASTRAN + more, NASTRAN_LOST, NASTRAN_NOTED)
        for text, part in NASTRAN_NONE.items():
            with self.subTest(part):
                refused(self, "model.bdf", text, part, "model.bdf")

    def test_ansys(self):
        self.hold("model.cdb", lambda more: ANSYS + more, ANSYS_LOST, ANSYS_NOTED)
        for text, part in ANSYS_NONE.items():
            with self.subTest(part):
                refused(self, "model.cdb", text, part, "model.cdb")

    def test_dyna(self):
        self.hold("model.k", lambda more: DYNA + more, DYNA_LOST, DYNA_NOTED)
        for text, part in DYNA_NONE.items():
            with self.subTest(part):
                refused(self, "model.k", text, part, "model.k")

    def test_damaged_decks(self):
        """One line, or a model: never more, and in no time."""
        rng = random.Random(3)
        for name, deck, lost in (("model.inp", ABAQUS, ABAQUS_LOST), ("model.bdf", NASTRAN, NASTRAN_LOST),
                                 ("model.cdb", ANSYS, ANSYS_LOST), ("model.k", DYNA, DYNA_LOST)):
            texts = [imported.damaged(deck + rng.choice(["", *lost]), rng) for _ in range(400)]
            self.assertEqual(imported.survives(name, texts), [], name)

    def test_modes_of_the_program(self):
        """The command as a user calls it prints mass and modes that the program finds, and a refusal of the program."""
        path = imported.of_file("model.inp", ABAQUS)
        done = program.command("import", path, path.parent / "out", "--units", "m,kg,s", "--modes", 3)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"structure model: 3 nodes, 12 dofs \(18 before clamping\), mass 1480 kg")
        self.assertEqual(len([line for line in done.stdout.splitlines() if line[:7].strip().isdigit()]), 3)
        path = imported.of_file("motion.inp", ABAQUS)
        done = program.command("import", path, path.parent / "out", "--units", "m,kg,s", "--modes", 1)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        self.assertIn("is written, and the program refuses it: pounding: ", done.stderr)

    def test_losses_go_by_their_names_alone(self):
        more = "*MPC\nLINK, 2, 3\n*PLASTIC\n2e8\n"
        refused(self, "model.inp", ABAQUS + more, "PLASTIC 1 would be lost", words=("--allow-losses", "mpc link"))
        _, said = import_deck(self, "model.inp", ABAQUS + more, "m,kg,s", "--allow-losses", "MPC LINK,*PLASTIC")
        self.assertIn("lost, as allowed: MPC LINK 1", said)

    def test_nothing_is_written_over(self):
        path = imported.of_file("model.inp", ABAQUS)
        self.assertEqual(imported.command(path, "m,kg,s").returncode, 0)
        again = imported.command(path, "m,kg,s")
        self.assertEqual(again.returncode, 1)
        self.assertIn("model.yaml is there already", again.stderr)

    def test_units_are_stated_and_known(self):
        path = imported.of_file("model.inp", ABAQUS)
        for units, part in (("mm,lb,s", "say lbm or lbf"), ("furlong,kg,s", "no unit of length"), ("m,kg",
                                                                                                   "three units"),
                            ("m,kg,d", "no unit of time")):
            done = imported.command(path, units)
            self.assertEqual(done.returncode, 2)
            self.assertIn(part, done.stderr)

    def test_masses_of_all_units(self):
        """The same steel mast in other units weighs the same."""
        rows = {"m,kg,s": (1, 2.1e11, 7850), "mm,t,s": (1e-3, 2.1e5, 7.85e-9), "mm,kg,ms": (1e-3, 210, 7.85e-6),
                "ft,kip,s": (0.3048, 2.1e11 / (4448.2216152605 / 0.3048**2), 7850 * 0.3048**4 / 4448.2216152605),
                "in,lbf,s": (0.0254, 2.1e11 / (4.4482216152605 / 0.0254**2), 7850 * 0.0254**4 / 4.4482216152605),
                "m,kN,s": (1, 2.1e8, 7.85)}
        for units, (length, young, density) in rows.items():
            deck = ABAQUS.replace("3.\n", f"{3 / length!r}\n").replace("6.\n", f"{6 / length!r}\n").replace(
                "2.1e11", repr(young)).replace("7850.", repr(density)).replace("\n.1\n", f"\n{0.1 / length!r}\n")
            scene, said = import_deck(self, "model.inp", deck, units)
            imported.close(self, imported.said_mass(said)[:1], (7850 * 6 * 3.14159265358979 * 0.01,), 1e-8)
            first = imported.frequencies(imported.structure(self, scene, modes=1))[0]
            reference = first if units == "m,kg,s" else reference
            self.assertLess(abs(first / reference - 1), 1e-9, units)

    def test_files_that_are_none(self):
        cases = {"*NODE\n1, 0., zero, 0.\n": "line 2: 'zero' is not a number",
                 "1, 2, 3\n": "line 1: data before the first keyword",
                 ABAQUS + "*NODE\n1, 0., 0., 1.\n": "line 19: node 1 is there already, at model.inp line 2",
                 ABAQUS + "*ELEMENT, TYPE=B31, ELSET=ALL\n7, 1, 99\n": "line 19: node 99 is not in the deck",
                 ABAQUS + "*ELEMENT, TYPE=B31, ELSET=ALL\n7, 1\n": "line 19: element 7 of type B31 has 1 nodes in "
                                                                   "place of 2",
                 ABAQUS + "*ELEMENT, TYPE=B31, ELSET=OTHER\n7, 1, 3\n": "line 19: element 7 has no section",
                 ABAQUS.replace("7850.", "0."): "--density STEEL=2500",
                 ABAQUS.replace("1., 0., 0.", "0., 0., 1."): "lies along its axis",
                 ABAQUS.replace("STEEL\n.1", "GLASS\n.1"): "material GLASS is not in the file",
                 ABAQUS + "*INCLUDE, INPUT=none.inp\n": "none.inp: no such file",
                 ABAQUS + "*BOUNDARY\nROOF, 1\n": "line 19: node set ROOF is not in the deck",
                 "": "no element in it", "\0\1\2": "not a text"}
        for text, part in cases.items():
            with self.subTest(part):
                refused(self, "model.inp", text, part, "model.inp" if "include" not in text.lower() else "none.inp")
        refused(self, "model.xyz", ABAQUS, "'.xyz' are not known")
        path = imported.of_file("model.inp", ABAQUS)
        done = imported.command(path.with_name("other.inp"), "m,kg,s")
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        _, said = import_deck(self, "model.inp", ABAQUS.replace("7850.", "0."), "m,kg,s", "--density", "steel=7850",
                              "--expect-mass", "1479.7")
        self.assertIn("expected 1479.7 kg: -0.000", said)


if __name__ == "__main__":
    unittest.main()
