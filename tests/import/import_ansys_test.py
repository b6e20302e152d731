"""ANSYS archives become scenes whose modes are those of the same models written by hand."""
import math
import unittest

import imported
from imported import by_hand, close, said_mass, same, section

STEEL = "".join(f"MPTEMP,R5.0, 1, 1,  0.000000000000000E+00,\nMPDATA,R5.0, 1,{label},       1, 1,  {value:.12E},\n"
                for label, value in (("EX  ", 2.1e11), ("PRXY", 0.3), ("DENS", 7850)))


def nodes(places, angles=()):
    """Angles: node -> three about z, x, y."""
    rows = [f"{n:9d}{0:9d}{0:9d}" + "".join(f"{value:21.13E}" for value in (*x, *dict(angles).get(n, ())))
            for n, x in places.items()]
    return "\n".join([f"NBLOCK,6,SOLID,{max(places):10d},{len(places):10d}", "(3i9,6e21.13e3)", *rows,
                      "N,R5.3,LOC,       -1,", ""])


def elements(rows):
    """Rows of (number, type, material, real, section, nodes)."""
    lines = [f"EBLOCK,19,SOLID,{len(rows):10d},{len(rows):10d}", "(19i10)"]
    for number, type_, material, real, own_section, members in rows:
        values = [material, type_, real, own_section, 0, 0, 0, 0, len(members), 0, number, *members]
        lines.append("".join(f"{value:10d}" for value in values))
    return "\n".join([*lines, "        -1", ""])


def component(name, values):
    return f"CMBLOCK,{name:8},NODE,{len(values):8d}  ! users node component definition\n(8i10)\n" + "\n".join(
        "".join(f"{value:10d}" for value in values[at:at + 8]) for at in range(0, len(values), 8)) + "\n"


def reals(sets):
    lines = [f"RLBLOCK,{len(sets):8d},{max(sets):8d},{max(map(len, sets.values())):8d},       7", "(2i8,6g16.9)",
             "(7g16.9)"]
    for number, values in sets.items():
        lines.append(f"{number:8d}{len(values):8d}" + "".join(f"{value:16.9g}" for value in values[:6]))
        lines += ["".join(f"{value:16.9g}" for value in values[at:at + 7]) for at in range(6, len(values), 7)]
    return "\n".join([*lines, ""])


class Ansys(unittest.TestCase):
    def test_frame(self):
        """BEAM188 with a node for its direction and without, BEAM4 by its real constants, springs, masses, and
        couplings of nodes."""
        places = {1: (0, 0, 0), 2: (0, 0, 3), 3: (4, 0, 3), 4: (4, 0, 0), 5: (4, 2, 3), 6: (2, 0, 0), 7: (4, 2, 3),
                  8: (4, 4, 3), 9: (0, -1, 3)}
        deck = ("/COM,ANSYS RELEASE 2021 R1\n/PREP7\n*IF,_CDRDOFF,EQ,1,THEN     !if solid model was read "
                "in\n_CDRDOFF=\n*ENDIF\n"
                "NUMOFF,NODE,       9\nET,        1,188\nET,        2,4\nET,        3,14\nET,        4,14\nKEYOP,     "
                "  4,2,3\n"
                "ET,        5,21\nET,        6,184\nKEYOP,       6,1,1\nET, 7, 180\n"
                + reals({1: [0.01, 2e-5, 1e-5, 0.1, 0.2, 30, 0, 2.5e-5, 0, 0, 0, 15.0], 2: [5e6, 0], 3: [2e6, 1e3],
                         4: [400, 400, 400, 10, 20, 30], 5: [90, 90, 90], 6: [2e-4, 1.5]})
                + nodes(places, {4: (90, 0, 0)})
                + elements([(1, 1, 1, 1, 1, (1, 2, 6)), (2, 1, 1, 1, 1, (4, 3, 6)), (3, 1, 1, 1, 2, (2, 3)),
                            (4, 2, 1, 1, 0, (3, 5)), (5, 3, 1, 2, 0, (2, 4)), (6, 4, 1, 3, 0, (3, 0)), (7, 5, 1, 4, 0,
                                                                                                        (5,)),
                            (8, 5, 1, 5, 0, (8,)), (9, 1, 1, 1, 2, (7, 8)), (10, 6, 1, 1, 0, (2, 9)), (11, 5, 1, 5, 0,
                                                                                                       (9,)),
                            (12, 7, 1, 6, 0, (8, 2))])
                + component("FEET", [1]) + STEEL
                + "SECTYPE,       1,BEAM,RECT,COLUMN,0\nSECOFFSET,CENT\nSECDATA,   0.1000000    ,   0.2000000    ,0,0\n"
                "SECTYPE,       2,BEAM,CTUBE,TUBE,0\nSECOFFSET,CENT\nSECDATA,.08,.1\n"
                "D,FEET,ALL,0\nD,       4,UX  ,  0.000000000    ,  0.000000000\nD,       4,UZ  ,  0.000000000    ,  "
                "0.0\n"
                "D,       8,UX  \nD,       8,UZ  \nD,       8,ROTY\nCP,       1,UX  ,       5,       7\nCP,       "
                "2,UY  ,       5,       7\nCP,       3,UZ  ,       5,       7\n"
                "F,       5,FX  ,  1000.0,  0.0\nACEL,0,0,9.81\n/GO\nFINISH\n")
        scene, said = imported.imported(self, "frame.cdb", deck)
        area, inertia = math.pi * (0.1**2 - 0.08**2), math.pi / 4 * (0.1**4 - 0.08**4)
        m = 0.8**2
        shear = repr(6 * (1 + m)**2 / (7 * (1 + m)**2 + 20 * m) * area)
        series = sum(math.tanh(n * math.pi) / n**5 for n in range(1, 4001, 2))
        twist = 0.2 * 0.1**3 / 3 * (1 - 192 * 0.5 / math.pi**5 * series)
        # BEAM4 along y: its y axis is parallel to the x-y plane, -x, its z the global z, turned by 30
        # degrees towards -y.
        turned = (math.sin(math.radians(30)), 0, math.cos(math.radians(30)))
        words = by_hand({n: x for n, x in places.items() if n != 6}, {
            "columns": ("line", [(1, 2), (4, 3)]), "girder": ("line", [(2, 3), (7, 8)]), "old": ("line", [(3, 5)]),
            "stay": ("line", [(2, 4)]), "ground": ("point", [(3,)]), "machine": ("point", [(5,)]),
            "hung": ("point", [(8,), (9,)]),
            "rod": ("line", [(8, 2)]), "foot": ("point", [(1,)]), "pad": ("point", [(4,)]), "end": ("point", [(8,)]),
            "pin": ("point", [(5,), (7,)]),
            "arm": ("point", [(2,), (9,)])}, {
            "columns_element": "beam", "columns_material": "m", "columns_section": "c", "girder_element": "beam",
            "girder_material": "m", "girder_section": "g", "old_element": "beam", "old_material": "m",
            "old_section": "o",
            "old_mass_per_length": 15, "stay_element": "bar", "stay_material": "rope", "stay_area": 5e6 * 5 / 1e11,
            "ground_element": "grounded_spring", "ground_stiffness": "0,0,2e6", "ground_dashpot": "0,0,1e3",
            "machine_element": "point_mass", "machine_mass": 400, "machine_rotary_inertia": "10,20,30",
            "hung_element": "point_mass", "hung_mass": 90, "rod_element": "bar", "rod_material": "m", "rod_area": 2e-4,
            "rod_mass_per_length": 1.5, "clamp": "foot,pad:y+z,end:x+z+ry", "pin": "pin", "rigid": "arm",
            "-material_m_young": 2.1e11, "-material_m_poisson": 0.3, "-material_m_density": 7850,
            "-material_rope_young": 1e11, "-material_rope_poisson": 0, "-material_rope_density": 1e-9,
            **section("c", 0.02, 0.1 * 0.2**3 / 12, 0.2 * 0.1**3 / 12, twist, "1,0,0",
                      f"{0.02 * 5 / 6},{0.02 * 5 / 6}"),
            **section("g", area, inertia, inertia, 2 * inertia, "0,0,1", f"{shear},{shear}"),
            **section("o", 0.01, 1e-5, 2e-5, 2.5e-5, ",".join(map(repr, turned)))})
        same(self, scene, words, ranks=2)
        weights = [(157 * 3, (0, 0, 1.5)), (157 * 3, (4, 0, 1.5)), (7850 * area * 4, (2, 0, 3)), (7850 * area * 2,
                                                                                                  (4, 3, 3)),
                   (2 * (78.5 + 15), (4, 1, 3)), (400, places[5]), (90, places[8]), (90, places[9]),
                   (math.sqrt(32) * (1.57 + 1.5), (2, 2, 3))]
        total = sum(w for w, _ in weights)
        found, centre = said_mass(said)
        close(self, (found, *centre), (total, *(sum(w * x[k] for w, x in weights) / total for k in range(3))))
        self.assertIn("(loads and steps are not part of the model): ACEL 1, F 1", said)

    def test_bricks_wedges_and_shells(self):
        """SOLID185 with enhanced strains, a wedge of repeated nodes, shells with their nodes in the lower face;
        mm, t, s."""
        places = {1: (0, 0, 0), 2: (900, 0, 0), 3: (900, 800, 0), 4: (0, 800, 0), 5: (0, 0, 700), 6: (900, 0, 700),
                  7: (900, 800, 700), 8: (0, 800, 700), 9: (1500, 400, 0), 10: (1500, 400, 700)}
        deck = ("/PREP7\nETBLOCK,        2,        2\n(2i9,19a9)\n" + "".join(
            f"{n:9d}{kind:9d}" + "".join(f"{key:9d}" for key in (0, key_2, *[0] * 16)) + "\n"
            for n, kind, key_2 in ((1, 185, 2), (2, 181, 0))) + "       -1\n"
            + nodes(places) + elements([
                (1, 1, 1, 1, 1, (1, 2, 3, 4, 5, 6, 7, 8)), (2, 1, 1, 1, 1, (2, 9, 3, 3, 6, 10, 7, 7)),
                (3, 2, 1, 1, 7, (5, 6, 7, 8)), (4, 2, 1, 1, 7, (6, 10, 7, 7))])
            + component("BASE", [1, -4]) + "MP,EX,1,30000\nMP,NUXY,1,.2\nMP,DENS,1,2.4E-9\nMP,ALPX,1,1e-5\n"
            "SECTYPE,       7,SHEL,    ,ROOF\nSECOFFSET,BOT\nSECBLOCK,       1\n  100.000    ,         1,  0.0    ,   "
            "      3\n"
            "D,1,UX,0,,4,1,UY\nD,BASE,UZ\nALPHAD,.5\nFINISH\n")
        scene, said = imported.imported(self, "block.cdb", deck, "mm,t,s")
        metres = {n: tuple(value / 1000 for value in x) for n, x in places.items()}
        lifted = {5: 15, 6: 16, 7: 17, 8: 18, 10: 20}
        hand = {**metres, **{own: (*metres[n][:2], 0.75) for n, own in lifted.items()}}
        words = by_hand(hand, {
            "brick": ("brick", [range(1, 9)]), "wedge": ("wedge", [(2, 9, 3, 6, 10, 7)]), "roof": ("quadrangle",
                                                                                                   [(15, 16, 17, 18)]),
            "corner": ("triangle", [(16, 20, 17)]), "base": ("point", [(n,) for n in range(1, 5)]),
            "low": ("point", [(n,) for n in lifted]), "high": ("point", [(n,) for n in lifted.values()])},
            {"brick_element": "hex8", "brick_material": "m", "wedge_element": "wedge6", "wedge_material": "m",
             "roof_element": "shell", "roof_material": "m", "roof_thickness": 0.1, "corner_element": "shell",
             "corner_material": "m",
             "corner_thickness": 0.1, "clamp": "base", "join": "high:low", "damping_alpha": 0.5,
             "-material_m_young": 3e10,
             "-material_m_poisson": 0.2, "-material_m_density": 2400})
        same(self, scene, words)
        floor = 0.9 * 0.8 + 0.6 * 0.8 / 2
        close(self, said_mass(said)[:1], (2400 * floor * 0.8,))
        x = (0.72 * 0.45 + 0.24 * 1.1) / floor
        close(self, said_mass(said)[1], (x, 0.4, (0.7 * 0.35 + 0.1 * 0.75) / 0.8))


if __name__ == "__main__":
    unittest.main()
