"""Things that a deck gives twice are refused with both places, unless they are the same; then they count once."""
import unittest

import imported
from import_losses_test import ABAQUS, ANSYS, DYNA
from imported import refused

BEAM = "*BEAM SECTION, SECTION=CIRC, ELSET=ALL, MATERIAL=STEEL\n{}\n1., 0., 0.\n"
MASS = "*ELEMENT, TYPE=MASS, ELSET=M\n9, 3\n*MASS, ELSET=M\n5.\n*MASS, ELSET=M\n{}\n"
SPRING = "*ELEMENT, TYPE=SPRING1, ELSET=S\n9, 3\n*SPRING, ELSET=S\n1\n5e3\n*SPRING, ELSET=S\n1\n{}\n"
PART = "*PART\n{}\n         1         1         1\n"
# What follows a deck, what replaces {} there: the same again, and another one; what is said of the latter.
ABAQUS_TWICE = (
    ("*NODE\n3, 0., 0., {}\n", "6.", "7.", "node 3 is there already, at model.inp line 4"),
    ("*ELEMENT, TYPE=B31, ELSET=ALL\n2, {}\n", "2, 3", "1, 3", "element 2 is there already, at model.inp line 7"),
    ("*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, .3\n*DENSITY\n{}\n", "7850.", "7800.",
     "this material is there already, at model.inp line 8"),
    (BEAM, ".1", ".2", "element 1 has a section already, of model.inp line 13"),
    (MASS, "5.", "6.", "*MASS of element 9 is there already, at model.inp line 20"),
    (SPRING, "5e3", "6e3", "*SPRING of element 9 is there already, at model.inp line 20"))
ANSYS_TWICE = (
    ("NBLOCK,6,SOLID,3,1\n(3i9,6e21.13e3)\n        2        0        0 0.0000000000000E+000 0.0000000000000E+000 "
     "{}000\nN,R5.3,LOC,       -1,\n", "3.0000000000000E+", "4.0000000000000E+", "node 2 is there already, at model.cdb line 6"),
    ("MP,EX,1,{}\n", "2.1e11", "2e11", "EX of material 1 is there already, at model.cdb line"),
    ("SECTYPE,1,BEAM,CSOLID\nSECDATA,{}\n", ".1", ".2", "section 1 is there already, at model.cdb line"),
    ("ET,1,{}\n", "188", "189", "ET 1 is there already, at model.cdb line 2"),
    ("R,5,1.\nR,5,{}\n", "1.", "2.", "set of real constants 5 is there already, at model.cdb line"))
DYNA_TWICE = (
    ("*NODE\n       3             0.0             0.0             {}\n", "6.0", "7.0", "node 3 is there already, at model.k "
     "line 5"),
    ("*MAT_ELASTIC\n         1    {}    2.1e11       0.3\n", "7850.0", "7800.0", "material 1 is there already, at model.k"),
    ("*SECTION_BEAM\n         1         2       1.0\n      {}      1e-5      1e-5      2e-5\n", "0.01", "0.02",
     "section 1 is there already, at model.k line"),
    ("*PART\nmast\n         1         1         {}\n", "1", "2", "part 1 is there already, at model.k line"),
    ("*ELEMENT_BEAM\n       2       1       {}\n", "2       3", "1       3", "beam element 2 is there already, at model.k "
     "line"))


class Twice(unittest.TestCase):
    def hold(self, name, deck, rows):
        plain = imported.imported(self, name, deck)[1]
        for more, same, other, part in rows:
            with self.subTest(part):
                refused(self, name, deck + more.format(other), part, "is another one" if "section already" not in part else
                        "and another one")
                said = imported.imported(self, name, deck + more.format(same))[1]
                if not more.startswith(("*ELEMENT, TYPE=MASS", "*ELEMENT, TYPE=SPRING")):
                    self.assertEqual(self.counted(said), self.counted(plain))

    @staticmethod
    def counted(said):
        return [line for line in said.split("\n") if line.startswith(("nodes", "supported", "mass"))]

    def test_abaqus(self):
        self.hold("model.inp", ABAQUS, ABAQUS_TWICE)
        said = imported.imported(self, "model.inp", ABAQUS + MASS.format("5."))[1]
        self.assertRegex(said, r"mass 1484\.\d+ kg")
        part = "*PART, NAME=P\n*END PART\n"
        refused(self, "model.inp", ABAQUS + part * 2, "part P is there already")

    def test_ansys(self):
        self.hold("model.cdb", ANSYS, ANSYS_TWICE)

    def test_dyna(self):
        self.hold("model.k", DYNA, DYNA_TWICE)

    def test_a_set_that_has_itself(self):
        deck = ABAQUS + "*NSET, NSET=A\n1, 2, 3\n" + "*NSET, NSET=A\nA, A\n" * 40 + "*BOUNDARY\nA, 1, 6\n"
        self.assertIn("supported nodes 3", imported.imported(self, "model.inp", deck)[1])

    def test_an_equation_of_no_component(self):
        refused(self, "model.inp", ABAQUS + "*EQUATION\n2\n2, 0, 1., 3, 0, -1.\n", "components of an equation")

    def test_groups_are_numbered_alike(self):
        """In the order of their names: of several groups of a cell too, whatever a process hashes."""
        deck = ABAQUS + "".join(f"*ELSET, ELSET={name}\n2\n" for name in ("B", "A", "D", "C"))
        mesh = imported.imported(self, "model.inp", deck)[0].with_suffix(".msh").read_text()
        self.assertIn('1 2 "a"\n1 3 "b"\n1 4 "c"\n1 5 "d"\n', mesh)

    def test_ansys_files_that_take_more_from_others(self):
        for line, card in (("/INPUT,more,inp", "/INPUT"), ("/inp,more", "/INP"), ("*USE,more.mac", "*USE"),
                           ("CDREAD,DB,more,cdb", "CDREAD")):
            refused(self, "model.cdb", ANSYS + line + "\n", f"{card} 1 would be lost")


if __name__ == "__main__":
    unittest.main()
