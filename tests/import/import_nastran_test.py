"""Nastran bulk data become scenes whose modes are those of the same models written by hand."""
import math
import unittest

import imported
from imported import by_hand, close, said_mass, same, section, steel


def small(*fields):
    """A card in fields of 8, with its continuations."""
    lines = []
    for at in range(1, max(2, len(fields)), 8):
        head = fields[0] if at == 1 else "+"
        lines.append("".join(f"{word!s:8}" for word in (head, *fields[at:at + 8])).rstrip())
    return "\n".join(lines) + "\n"


def large(*fields):
    lines = []
    for at in range(1, len(fields), 4):
        head = fields[0] + "*" if at == 1 else "*"
        lines.append(f"{head:8}" + "".join(f"{word!s:16}" for word in fields[at:at + 4]))
    return "\n".join(lines) + "\n"


def free(*fields):
    return ",".join(map(str, fields)) + "\n"


STEEL = small("MAT1", 1, "2.1+11", "", ".3", "7850.")
HEAD = "SOL 103\nCEND\nTITLE = A MODEL\nSPC = 1\nMETHOD = 5\nBEGIN BULK\n" + small("EIGRL", 5, "", "", 10)


class Nastran(unittest.TestCase):
    def test_frame(self):
        """Bars and beams by vectors and by a point, with offsets, hinges, a product of inertia, masses on arms,
        springs, bushings, a rigid element, and grid points of a round system; fields of all three kinds."""
        deck = (HEAD + STEEL + small("CORD2C", 3, 0, 0., 0., 0., 0., 0., 1., 1., 0., 0.)
                + large("GRID", 1, "", 0., 0., 0., 3) + small("GRID", 2, "", 0., 0., 3.)
                + small("GRID", 3, 3, 5., 0., 3.) + free("GRID", 4, 3, "5.", "0.", "0.") + small("GRID", 5, 3, 5., 90.,
                                                                                                 3.)
                + small("GRID", 6, "", 0., 2., 3., "", 456) + small("GRID", 7, "", 5., 0.5, 3.)
                + small("CBAR", 1, 10, 1, 2, 1., 0., 0.) + small("CBAR", 2, 10, 4, 3, 2)
                + small("CBAR", 3, 11, 2, 3, 0., 0., 1., "", "", "", 0., 0., .2, 0., 0., .2)
                + small("CBEAM", 4, 12, 2, 5, 0., 0., 1.)
                + small("PBAR", 10, 1, ".02", "6.-5", "2.-5", "3.-5", "12.", "", *[""] * 8, "", "", "1.-5")
                + small("PBARL", 11, 1, "", "BAR", "", "", "", "", ".1", ".2", "5.")
                + small("PBEAM", 12, 1, ".01", "8.-5", "1.-5", "", "2.-5", "", *[""] * 8, "YESA", 1., *[""] * 6, ".5",
                        ".4")
                + small("CONM2", 20, 5, 0, 300., .1, 0., .5, "", 10., "", 12., "", "", 14.)
                + small("CELAS2", 21, "3.+6", 5, 3) + small("CDAMP2", 22, "4.+3", 5, 3)
                + small("CONROD", 23, 5, 6, 1, ".001") + small("CONM2", 24, 6, "", 40.) + small("CBUSH", 25, 30, 6, "",
                                                                                                "", "", "", 0)
                + small("PBUSH", 30, "K", "1.+6", "2.+6", "3.+6") + small("RBE2", 26, 3, 123456,
                                                                          7) + small("CONM2", 27, 7, "", 60.)
                + small("SPC1", 1, 123456, 1) + small("SPC", 1, 4, 123, 0.) + "ENDDATA\n")
        scene, said = imported.imported(self, "frame.bdf", deck)
        nodes = {1: (0, 0, 0), 2: (0, 0, 3), 3: (5, 0, 3), 4: (5, 0, 0), 5: (0, 5, 3), 6: (0, 2, 3), 7: (5, 0.5, 3),
                 8: (0, 0, 3.2), 9: (5, 0, 3.2), 10: (0.1, 5, 3.5)}
        self.assertIn("SPC1 1", said)
        words = self.words(nodes, 6e-5, 2e-5, 1e-5)
        same(self, scene, words, ranks=2)
        weights = [(3 * (7850 * 0.02 + 12), (0, 0, 1.5)), (3 * (7850 * 0.02 + 12), (5, 0, 1.5)),
                   (5 * (7850 * 0.02 + 5), (2.5, 0, 3.2)), (5 * 7850 * 0.01, (0, 2.5, 3)), (300, (0.1, 5, 3.5)),
                   (3 * 7850 * 0.001, (0, 3.5, 3)), (40, nodes[6]), (60, nodes[7])]
        total = sum(weight for weight, _ in weights)
        mass, centre = said_mass(said)
        close(self, (mass, *centre), (total, *(sum(w * x[k] for w, x in weights) / total for k in range(3))))

    @staticmethod
    def words(nodes, i1, i2, i12):
        """The frame by hand. With y and z of Nastran the tensor of y y, y z, z z is [[I1, I12], [I12, I2]], and its
        greatest direction is where the section is longest. Of the column from 1 to 2 they are the global x and y, of
        the other one, whose v is towards node 2, -x and -y."""
        strong = (i1 + i2) / 2 + math.hypot((i1 - i2) / 2, i12)
        weak = i1 + i2 - strong
        angle = 0.5 * math.atan2(2 * i12, i1 - i2)
        one = (math.cos(angle), math.sin(angle), 0)
        area, height, width = 0.02, 0.2, 0.1
        twist = height * width**3 / 3 * (1 - 192 * width / (math.pi**5 * height) * sum(
            math.tanh(n * math.pi * height / 2 / width) / n**5 for n in range(1, 4001, 2)))
        groups = {"columns": ("line", [(1, 2), (4, 3)]), "girder": ("line", [(8, 9)]), "cross": ("line", [(2, 5)]),
                  "rod": ("line", [(5, 6)]), "machine": ("point", [(10,)]), "hung": ("point", [(6,)]),
                  "side": ("point", [(7,)]), "soil": ("point", [(5,)]), "pad": ("point", [(6,)]),
                  "foot": ("point", [(1,)]), "hinged": ("point", [(4,)]), "arm": ("point", [(5,), (10,)]),
                  "up": ("point", [(2,), (8,)]), "hand": ("point", [(3,), (7,), (9,)])}
        return by_hand(nodes, groups, {
            "columns_element": "beam", "columns_material": "steel", "columns_section": "c",
            "columns_mass_per_length": 12,
            "girder_element": "beam", "girder_material": "steel", "girder_section": "g", "girder_mass_per_length": 5,
            "cross_element": "beam", "cross_material": "steel", "cross_section": "k", "rod_element": "bar",
            "rod_material": "steel",
            "rod_area": 0.001, "machine_element": "point_mass", "machine_mass": 300,
            "machine_rotary_inertia": "10,12,14",
            "hung_element": "point_mass", "hung_mass": 40, "side_element": "point_mass", "side_mass": 60,
            "soil_element": "grounded_spring", "soil_stiffness": "0,0,3e6", "soil_dashpot": "0,0,4e3",
            "pad_element": "grounded_spring", "pad_stiffness": "1e6,2e6,3e6", "clamp": "foot,hinged:x+y+z",
            "rigid": "arm,up,hand", **steel(),
            # z of the program along the direction in which the section is longest.
            **section("c", area, strong, weak, 3e-5, ",".join(map(repr, one))),
            **section("g", area, 0.1 * 0.2**3 / 12, 0.2 * 0.1**3 / 12, twist, "0,0,1",
                      f"{area * 5 / 6},{area * 5 / 6}"),
            **section("k", 0.01, 8e-5, 1e-5, 2e-5, "0,0,1", "0.004,0.005")})

    def test_bricks_plates_and_turned_grid_points(self):
        """In inches with a weight density and WTMASS: a brick with a wedge beside it, plates off their grid points on
        top, a post that is hinged at a plate's corner, and supports in a turned system."""
        inch, pound = 0.0254, 4.4482216152605
        points = {1: (0, 0, 0), 2: (40, 0, 0), 3: (40, 40, 0), 4: (0, 40, 0), 5: (0, 0, 40), 6: (40, 0, 40),
                  7: (40, 40, 40),
                  8: (0, 40, 40), 9: (70, 0, 0), 10: (70, 0, 40), 11: (0, 0, 100), 12: (20, 20, 120)}
        weight, gravity = 0.1, 386.0886
        deck = ("SOL 103\nCEND\nSPC = 7\nBEGIN BULK\n" + small("PARAM", "WTMASS", f"{1 / gravity:.6f}")
                + small("CORD2R", 4, 0, 0., 0., 0., 0., 1., 0., 0., 0., 1.)
                + "".join(small("GRID", n, "", *map(float, x), 4 if n in (2, 3, 9) else "") for n, x in points.items())
                + small("CHEXA", 1, 1, 1, 2, 3, 4, 5, 6, 7, 8) + small("CPENTA", 2, 1, 2, 9, 3, 6, 10, 7)
                + small("CQUAD4", 3, 2, 5, 6, 7, 8, "", 0.5) + small("CTRIA3", 4, 2, 6, 10, 7, "", 0.5)
                + small("CBAR", 5, 3, 5, 11, 1., 0., 0., "", "", 456) + small("CBAR", 6, 3, 11, 12, 0., 0., 1.)
                + small("PSOLID", 1, 1) + small("PSHELL", 2, 1, 1., 1, "", 1, "", ".02")
                + small("PBARL", 3, 1, "", "TUBE", "", "", "", "", 2., 1.5)
                + small("MAT1", 1, "3.+7", "", ".3", weight) + small("RBAR", 7, 8, 12, 123456)
                + small("SPC1", 7, 123, 1, "THRU", 4) + small("SPC1", 7, 2, 9) + small("SPC1", 8, 3, 9))
        factor = float(f"{1 / gravity:.6f}")
        scene, said = imported.imported(self, "model.nas", deck, "in,lbf,s")
        mass = pound / inch  # of lbf s2/in
        density = weight * factor * mass / inch**3
        nodes = {n: tuple(value * inch for value in x) for n, x in points.items()}
        lifted = {5: 15, 6: 16, 7: 17, 8: 18, 10: 20}
        nodes.update({own: (*nodes[n][:2], nodes[n][2] + 0.5 * inch) for n, own in lifted.items()})
        nodes[21] = nodes[11]
        area, inertia = math.pi * (4 - 2.25) * inch**2, math.pi / 4 * (2**4 - 1.5**4) * inch**4
        m = (1.5 / 2)**2
        shear = repr(6 * (1 + m)**2 / (7 * (1 + m)**2 + 20 * m) * area)
        # z of the turned system is the global y, its x the global z, so its y the global x.
        words = by_hand(nodes, {
            "brick": ("brick", [range(1, 9)]), "wedge": ("wedge", [(2, 9, 3, 6, 10, 7)]),
            "plate": ("quadrangle", [(15, 16, 17, 18)]), "corner": ("triangle", [(16, 20, 17)]),
            "post": ("line", [(5, 21), ]), "top": ("line", [(11, 12)]), "base": ("point", [(n,) for n in range(1, 5)]),
            "guide": ("point", [(9,)]), "a": ("point", [(5,), (15,)]), "b": ("point", [(6,), (16,)]),
            "c": ("point", [(7,), (17,)]), "d": ("point", [(8,), (18,), (12,)]), "e": ("point", [(10,), (20,)]),
            "hinge": ("point", [(11,), (21,)])},
            {"brick_element": "hex8", "brick_material": "m", "wedge_element": "wedge6", "wedge_material": "m",
             "plate_element": "shell", "plate_material": "m", "plate_thickness": inch,
             "plate_mass_per_area": 0.02 * factor * mass / inch**2, "corner_element": "shell", "corner_material": "m",
             "corner_thickness": inch, "corner_mass_per_area": 0.02 * factor * mass / inch**2, "post_element": "beam",
             "post_material": "m", "post_section": "p", "top_element": "beam", "top_material": "m", "top_section": "q",
             "clamp": "base,guide:x", "rigid": "a,b,c,d,e", "pin": "hinge", "-material_m_young": 3e7 * pound / inch**2,
             "-material_m_poisson": 0.3, "-material_m_density": density,
             **section("p", area, inertia, inertia, 2 * inertia, "1,0,0", f"{shear},{shear}"),
             **section("q", area, inertia, inertia, 2 * inertia, "0,0,1", f"{shear},{shear}")})
        same(self, scene, words)
        self.assertIn("sets 8 of SPC are not named by case control", said)
        self.assertIn("hinges and pins 1", said)
        plate = (0.1 + 0.02) * (40 * 40 + 600)
        weights = [(6400, (20, 20, 20)), (2400, (50, 40 / 3, 20)), (plate / (2200) * 1600, (20, 20, 40.5)),
                   (plate / 2200 * 600, (50, 40 / 3, 40.5)), (0.1 * math.pi * 1.75 * 60, (0, 0, 70)),
                   (0.1 * math.pi * 1.75 * math.dist(points[11], points[12]), (10, 10, 110))]
        total = sum(w for w, _ in weights)
        found, centre = said_mass(said)
        close(self, (found,), (total * factor * mass,))
        close(self, centre, [inch * sum(w * x[k] for w, x in weights) / total for k in range(3)])


if __name__ == "__main__":
    unittest.main()
