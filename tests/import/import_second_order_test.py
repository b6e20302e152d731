"""Cells of second order are read by their corners as a loss: the scene is that of the same cells of first order."""
import unittest

import imported
from imported import refused

CORNERS = {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0), 5: (0, 0, 2), 6: (1, 0, 2), 7: (1, 1, 2), 8: (0, 1, 2)}
EDGES = ((1, 2), (2, 3), (3, 4), (4, 1), (5, 6), (6, 7), (7, 8), (8, 5), (1, 5), (2, 6), (3, 7), (4, 8))
MIDDLE = {100 + k: tuple((a + b) / 2 for a, b in zip(CORNERS[i], CORNERS[j])) for k, (i, j) in enumerate(EDGES, 1)}
BRICK, MIDS = list(CORNERS), list(MIDDLE)
TET, TET_MIDS = [1, 2, 4, 5], [101, 113, 104, 109, 114, 115]  # edges 12, 24, 41, 15, 25, 45
MIDDLE[113] = (0.5, 0.5, 0)
MIDDLE[114] = (0.5, 0, 1)
MIDDLE[115] = (0, 0.5, 1)
ALL = {**CORNERS, **MIDDLE}


def abaqus(kind, members, places=ALL, section="*SOLID SECTION, ELSET=BODY, MATERIAL=M\n", more=""):
    """A deck with one element."""
    rows = "".join(f"{n}, {x[0]}, {x[1]}, {x[2]}\n" for n, x in places.items())
    words = [str(value) for value in (1, *members)]
    element = ", ".join(words) if len(words) < 16 else ", ".join(words[:16]) + ",\n" + ", ".join(words[16:])
    return (f"*NODE\n{rows}*ELEMENT, TYPE={kind}, ELSET=BODY\n{element}\n*MATERIAL, NAME=M\n*ELASTIC\n3e10, .2\n"
            f"*DENSITY\n2500.\n{section}*NSET, NSET=FOOT\n1, 2, 3, 4\n*BOUNDARY\nFOOT, 1, 6\n{more}")


def nastran(card, members, places=ALL):
    """A deck with one element in fields of eight."""
    words = [card, "1", "1", *map(str, members)]
    lines, rest = ["".join(word.ljust(8) for word in words[:9])], words[9:]
    while rest:
        lines.append(" " * 8 + "".join(word.ljust(8) for word in rest[:8]))
        rest = rest[8:]
    grids = "".join(f"GRID,{n},,{float(x[0])},{float(x[1])},{float(x[2])}\n" for n, x in places.items())
    return ("BEGIN BULK\n" + grids + "\n".join(lines) + "\nPSOLID,1,1\nMAT1,1,3.+10,,.2,2500.\n"
            "SPC1,1,123,1,2,3,4\nENDDATA\n")


def ansys(type_, members, places=ALL, more=""):
    """An archive with one element."""
    rows = [f"{n:9d}{0:9d}{0:9d}" + "".join(f"{value:21.13E}" for value in x) for n, x in places.items()]
    values = [1, 1, 1, 1, 0, 0, 0, 0, len(members), 0, 1, *members]
    lines = ["".join(f"{value:9d}" for value in part) for part in (values[:19], values[19:]) if part]
    return "\n".join([f"/PREP7\nET,1,{type_}", f"NBLOCK,6,SOLID,{max(places):9d},{len(places):9d}", "(3i9,6e21.13e3)", *rows,
                      "N,R5.3,LOC,       -1,", "EBLOCK,19,SOLID,1,1", "(19i9)", *lines, "       -1", "MP,EX,1,3e10",
                      "MP,PRXY,1,.2", "MP,DENS,1,2500", f"{more}D,1,ALL,0,,4,1", ""])


def dyna(keyword, cards, form, places=ALL, family="SOLID", second=""):
    """A deck with one element."""
    rows = "".join(f"{n:8d}" + "".join(f"{value:16.8f}" for value in x) + "\n" for n, x in places.items())
    spc = "".join(f"{n:10d}{0:10d}" + "".join(f"{1:10d}" for _ in range(6)) + "\n" for n in (1, 2, 3, 4))
    lines = "".join("".join(f"{value:8d}" for value in card) + "\n" for card in cards)
    return (f"*KEYWORD\n*NODE\n{rows}*MAT_ELASTIC\n         1    2500.0      3e10       0.2\n"
            f"*SECTION_{family}\n         1{form:10d}\n{second}*PART\nbody\n         1         1         1\n"
            f"*{keyword}\n{lines}*BOUNDARY_SPC_NODE\n{spc}*END\n")


def unv(kind, members, places=ALL):
    """A universal file with one cell."""
    rows = "".join(f"{n:10d}{1:10d}{1:10d}{11:10d}\n" + "".join(f"{value:25.16E}" for value in x) + "\n"
                   for n, x in places.items())
    ids = "".join("".join(f"{n:10d}" for n in members[at:at + 8]) + "\n" for at in range(0, len(members), 8))
    return (f"    -1\n  2411\n{rows}    -1\n    -1\n  2412\n"
            f"{1:10d}{kind:10d}{1:10d}{1:10d}{7:10d}{len(members):10d}\n{ids}    -1\n")


NASTRAN_MIDS = MIDS[:4] + MIDS[8:] + MIDS[4:8]
SHELL = "*SHELL SECTION, ELSET=BODY, MATERIAL=M\n.2\n"
BEAM = "*BEAM SECTION, ELSET=BODY, MATERIAL=M, SECTION=RECT\n.2, .1\n0., 0., 1.\n"
ANSYS_SHELL = "SECTYPE,1,SHELL\nSECDATA,.2,1,0.0,3\n"
ANSYS_BEAM = "SECTYPE,1,BEAM,RECT,B\nSECDATA,.2,.1\n"
# Name of the file, its second order and card, and what it has to be equal to.
CASES = {
    "C3D20R": ("m.inp", abaqus("C3D20R", BRICK + MIDS), "ELEMENT TYPE=C3D20R", abaqus("C3D8R", BRICK)),
    "C3D10": ("m.inp", abaqus("C3D10", TET + TET_MIDS), "ELEMENT TYPE=C3D10", abaqus("C3D4", TET)),
    "S8R": ("m.inp", abaqus("S8R", BRICK[:4] + MIDS[:4], section=SHELL), "ELEMENT TYPE=S8R",
            abaqus("S4", BRICK[:4], section=SHELL)),
    "B32": ("m.inp", abaqus("B32", [1, 101, 2], section=BEAM), "ELEMENT TYPE=B32", abaqus("B31", [1, 2], section=BEAM)),
    "CHEXA": ("m.bdf", nastran("CHEXA", BRICK + NASTRAN_MIDS), "CHEXA of second order", nastran("CHEXA", BRICK)),
    "CTETRA": ("m.bdf", nastran("CTETRA", TET + TET_MIDS), "CTETRA of second order", nastran("CTETRA", TET)),
    "SOLID186": ("m.cdb", ansys(186, BRICK + MIDS), "ELEMENT SOLID186", ansys(45, BRICK)),
    "SOLID187": ("m.cdb", ansys(187, TET + TET_MIDS), "ELEMENT SOLID187", ansys(45, [*TET[:3], TET[2], *[TET[3]] * 4])),
    "SHELL281": ("m.cdb", ansys(281, BRICK[:4] + MIDS[:4], more=ANSYS_SHELL), "ELEMENT SHELL281",
                 ansys(181, BRICK[:4], more=ANSYS_SHELL)),
    "BEAM189": ("m.cdb", ansys(189, [1, 2, 101, 4], more=ANSYS_BEAM), "ELEMENT BEAM189",
                ansys(188, [1, 2, 4], more=ANSYS_BEAM)),
    "TET10": ("m.k", dyna("ELEMENT_SOLID", [(1, 1), TET + TET_MIDS], 16), "ELEMENT_SOLID of second order",
              dyna("ELEMENT_SOLID", [(1, 1, *TET, *TET[3:] * 4)], 10)),
    "H20": ("m.k", dyna("ELEMENT_SOLID_H20", [(1, 1), BRICK + MIDS[:2], MIDS[2:]], 23), "ELEMENT_SOLID_H20",
            dyna("ELEMENT_SOLID", [(1, 1, *BRICK)], 1)),
    "SHELL8": ("m.k", dyna("ELEMENT_SHELL", [(1, 1, *BRICK[:4], *MIDS[:4])], 23, family="SHELL", second="       0.2\n"),
               "ELEMENT_SHELL of second order",
               dyna("ELEMENT_SHELL", [(1, 1, *BRICK[:4])], 16, family="SHELL", second="       0.2\n")),
    "116": ("m.unv", unv(116, [1, 101, 2, 102, 3, 103, 4, 104, 109, 110, 111, 112, 5, 105, 6, 106, 7, 107, 8, 108]),
            "ELEMENTS 116 OF 20", unv(115, BRICK)),
    "118": ("m.unv", unv(118, [1, 101, 2, 113, 4, 104, 109, 114, 115, 5]), "ELEMENTS 118 OF 10", unv(111, TET)),
}


class SecondOrder(unittest.TestCase):
    def written(self, name, deck, *words):
        scene, said = imported.imported(self, name, deck, "m,kg,s", *words)
        return scene.read_text(), scene.with_suffix(".msh").read_text(), said

    def test_the_scene_is_that_of_the_corners(self):
        for what, (name, deck, card, first) in CASES.items():
            with self.subTest(what):
                refused(self, name, deck, f"{card} 1 would be lost")
                scene, mesh, said = self.written(name, deck, "--allow-losses", card)
                self.assertEqual((scene, mesh), self.written(name, first)[:2])
                self.assertRegex(said, f"lost, as allowed: {card} 1, first at m.*(mid-side nodes go|mid-side node goes)")

    def test_what_lies_on_mid_side_nodes(self):
        """Masses and springs go to the corners beside by halves, supports count where both are held; what hangs on
        nothing is named."""
        card = "ELEMENT TYPE=C3D20"
        point = ("*ELEMENT, TYPE=MASS, ELSET=P\n2, 106\n*MASS, ELSET=P\n500.\n*ELEMENT, TYPE=SPRING1, ELSET=S\n3, 106\n"
                 "*SPRING, ELSET=S\n1\n4e5\n*BOUNDARY\n101, 1, 3\n*NSET, NSET=EDGE\n106\n")
        scene, _, said = self.written("m.inp", abaqus("C3D20", BRICK + MIDS, more=point), "--allow-losses", card)
        halves = ("*ELEMENT, TYPE=MASS, ELSET=P\n2, 6\n3, 7\n*MASS, ELSET=P\n250.\n"
                  "*ELEMENT, TYPE=SPRING1, ELSET=S\n4, 6\n5, 7\n*SPRING, ELSET=S\n1\n2e5\n")
        self.assertEqual(scene, self.written("m.inp", abaqus("C3D8R", BRICK, more=halves))[0])
        self.assertIn("masses and springs of 1 mid-side nodes: half to each corner beside", said)
        self.assertIn("sets of mid-side nodes alone are no groups: EDGE", said)
        faces = "*SURFACE, NAME=TOP\nBODY, S2\n*NSET, NSET=EDGE\n106\n*TIE, NAME=T\nEDGE, TOP\n"
        for more, lost in (("*BOUNDARY\n106, 1, 1\n", "SUPPORTS OF MID-SIDE NODES 1"),
                           ("*NODE\n200, 2., .5, 2.\n*ELEMENT, TYPE=T3D2, ELSET=R\n9, 106, 200\n"
                            "*SOLID SECTION, ELSET=R, MATERIAL=M\n.01\n", "MID-SIDE NODES THAT OTHERS USE 1"),
                           ("*NSET, NSET=E\n106\n*RIGID BODY, REF NODE=105, TIE NSET=E\n",
                            "RIGID BODIES OF MID-SIDE NODES 1"),
                           (faces, "TIES OF MID-SIDE NODES 1")):
            with self.subTest(lost):
                refused(self, "m.inp", abaqus("C3D20", BRICK + MIDS, more=more), f"{lost} would be lost",
                        words=("--allow-losses", card))


if __name__ == "__main__":
    unittest.main()
