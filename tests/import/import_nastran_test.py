"""Nastran bulk data become scenes whose modes are those of the same models written by hand."""
import math
import os
import time
import unittest

import h5py

import imported
import program
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

    def test_rigid_elements_of_some_components(self):
        """Heads of columns on a rigid element that ties displacements, or two components, and leaves the others alone; of
        one whose first node has no element; a clamped first node."""
        heads = {4: (0, 0, 3), 14: (2, 0, 3), 24: (2, 2, 3), 34: (0, 2, 3)}
        columns = "".join(small("GRID", n - 3 + k, "", *map(float, (x, y, k))) for n, (x, y, _) in heads.items() for k in range(4))
        columns += "".join(small("CBAR", n - 3 + k, 10, n - 3 + k, n - 2 + k, 1., 0., 0.) for n in heads for k in range(3))
        columns += "".join(small("SPC1", 1, 123456, n - 3) for n in heads) + small("PBAR", 10, 1, ".02", "6.-5", "6.-5", "3.-5")
        nodes = {n - 3 + k: (*x[:2], k) for n, x in heads.items() for k in range(4)}
        groups = {"column": ("line", [(n - 3 + k, n - 2 + k) for n in heads for k in range(3)]),
                  "feet": ("point", [(n - 3,) for n in heads]), "hub": ("point", [(4,)]),
                  "spokes": ("point", [(n,) for n in heads if n > 4]), "heads": ("point", [(n,) for n in heads])}
        for card, option, clamp in (
                (small("RBE2", 90, 4, 123, 14, 24, 34), "hub:spokes:x+y+z", ""),
                (small("RBE2", 90, 4, 12, 14, 24) + small("RBE2", 91, 4, 12, 34), "hub:spokes:x+y", ""),
                (small("RBAR", 90, 4, 14, 123456, "", "", 26), "hub:spoke:y+rz", ""),
                (small("GRID", 50, "", 1., 1., 4.) + small("RBE2", 90, 50, 123, 4, 14, 24, 34), "heads:x+y+z", ""),
                (small("GRID", 50, "", 1., 1., 4., "", 123456) + small("RBE2", 90, 50, 13, 4, 14, 24, 34), "", ",heads:x+z")):
            deck = HEAD + STEEL + columns + card + "ENDDATA\n"
            scene, said = imported.imported(self, "heads.bdf", deck)
            words = by_hand(nodes, {**groups, "spoke": ("point", [(14,)])}, {
                "column_element": "beam", "column_material": "steel", "column_section": "s", "clamp": "feet" + clamp,
                **({"rigid": option} if option else {}), **steel(), **section("s", .02, 6e-5, 6e-5, 3e-5, "0,1,0")})
            same(self, scene, words)
            self.assertEqual("rigid bodies 1" in said, bool(option))
        for more in (small("SPC1", 1, 2, 14), small("SPC1", 1, 3, 4), small("RBE2", 91, 24, 123, 14)):
            imported.refused(self, "heads.bdf", HEAD + STEEL + columns + small("RBE2", 90, 4, 123, 14) + more + "ENDDATA\n",
                             "RBE2")

    def test_a_deck_without_sets_is_loaded_stopped_and_recorded_at_points(self):
        """Two columns, one of which a force presses against the other: at rest they share it beyond the gap."""
        deck = HEAD + small("MAT1", 1, "2.1+5", "", ".3", "7.85-9") + small("PBAR", 10, 1, "2.+4", "6.+7", "6.+7", "3.+7")
        for first, x in ((1, 0.), (11, 500.)):
            for k in range(4):
                deck += small("GRID", first + k, "", x, 0., 1000. * k)
            for k in range(3):
                deck += small("CBAR", first + k, 10, first + k, first + k + 1, 1., 0., 0.)
            deck += small("SPC1", 1, 123456, first)
        scene, _ = imported.imported(self, "columns.bdf", deck + "ENDDATA\n", "mm,t,s")
        force, gap, give = 5e4, 0.01, 3**3 / (3 * 2.1e11 * 6e-5)  # N, m, m/N
        folder, _ = program.must_run(self, [
            "-options_file", scene, "-preload", "static", "-end_time", 1e-3, "-spectra_frequencies", 10, "-loads", "push",
            "-push_on", "columns:0,0,3", "-push_force", f"{force},0,0", "-contacts", "stop", "-stop_secondary",
            "columns:0,0,3", "-stop_primary", "columns:.5,0,3", "-stop_along", "1,0,0", "-stop_gap", gap, "-stop_gap_at",
            "unloaded", "-probes", "one,two", "-one_structure", "columns", "-one_at", "0,0,3", "-two_structure", "columns",
            "-two_at", ".5,0,3"], 2)
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            channels = [name.decode() for name in file["channels"]]
            one, two = (file["displacement"][0, channels.index(name)] for name in ("one.x", "two.x"))
        self.assertAlmostEqual(one / ((force * give + gap) / 2), 1, delta=1e-9)
        self.assertAlmostEqual(two / ((force * give - gap) / 2), 1, delta=1e-9)

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

    POST = {1: (0, 0, 0), 2: (0, 0, 1.5), 3: (0, 0, 3)}
    REST = ("".join(small("GRID", n, "", *map(float, x)) for n, x in POST.items()) + small("MAT1", 1, "2.1+11", "", .3, 7850.)
            + small("PBAR", 1, 1, .01, "8.33-6", "8.33-6", "1.4-5") + small("SPC1", 1, 123456, 1))

    @staticmethod
    def marked(number, nodes, mark):
        return small("CBAR", number, 1, *nodes, 1., 0., 0.).rstrip().ljust(72) + mark + "\n"

    def test_continuations_belong_to_the_line_that_has_their_mark(self):
        """Element 1 is 0.5 m and element 2 0.1 m beside its grid points, in whatever order the lines are."""
        bars = self.marked(1, (1, 2), "+C1"), self.marked(2, (2, 3), "+C2")
        offsets = "+C1     " + " " * 16 + small("0.", .5, 0., 0., .5, 0.), "+C2     " + " " * 16 + small("0.", .1, 0., 0., .1, 0.)
        for lines in ((bars[0], offsets[0], bars[1], offsets[1]), (*bars, *offsets), (offsets[1], offsets[0], *bars)):
            deck = "SOL 103\nCEND\nBEGIN BULK\n" + "".join(lines) + self.REST
            _, said = imported.imported(self, "post.bdf", deck)
            close(self, said_mass(said)[1], (0, .3, 1.5))
        for lines, part in (((bars[0], offsets[1]), "line 5: no line has the mark 'C2'"),
                            ((bars[0], bars[0].replace("  1  ", "  2  ", 1), bars[1], offsets[0]), "line 7: more than one line has the mark 'C1'"),
                            ((bars[0], offsets[0], offsets[0]), "line 6: no line has the mark 'C1'"),
                            ((bars[0], bars[1], "+       " + offsets[0][8:], offsets[1]), "line 6: a continuation without a mark")):
            imported.refused(self, "model.bdf", "SOL 103\nCEND\nBEGIN BULK\n" + "".join(lines) + self.REST, part)

    def test_fields_past_the_eighth_of_a_free_line(self):
        """Go on as if in a next line; a tenth field that is a mark is one, and one that could be either is refused."""
        feet = "".join(small("GRID", n, "", float(n), 0., 0.) + small("GRID", n + 10, "", float(n), 0., 3.)
                       + small("CBAR", n, 1, n, n + 10, 1., 0., 0.) for n in range(1, 9)) + small("PBAR", 1, 1, .01, "8.-6", "8.-6", "1.-5")
        for line in ("SPC1,1,123456,1,2,3,4,5,6,7,8\n", "SPC1,1,123456,1,2,3,4,5,6,+A\n+A,7,8\n", "SPC1,1,123456,1,THRU,8\n",
                     "SPC1,1,123456,1,2,3,4,5,6,THRU,8\n", "SPC1,1,123456,1,2,3,4,5,6,7\nSPC1,1,123456,8\n"):
            _, said = imported.imported(self, "feet.bdf", "BEGIN BULK\n" + feet + STEEL + line)
            self.assertIn("supported nodes 8:", said)
        _, said = imported.imported(self, "feet.bdf", "BEGIN BULK\n" + feet + STEEL + "SPC1, 1  123456,1 THRU 8\n")  # blanks as commas
        self.assertIn("supported nodes 8:", said)
        imported.refused(self, "feet.bdf", "BEGIN BULK\n" + feet + STEEL + "GRID,30,,10.6 +6,0.,0.\n", "'10.6 +6' could be one number or two")
        for line, part in (("SPC1,1,123456,1,2,3,4,5,6,,7\n", "behind a tenth field that is a mark or empty"),
                           ("SPC1,1,123456,1,2,3,4,5,6,+A,7\n", "behind a tenth field that is a mark or empty"),
                           ("SPC1,1,123456,1,2,3,4,5,6,17\n+7,7,8\n", "the ninth field of data, 17, could be the mark")):
            imported.refused(self, "feet.bdf", "BEGIN BULK\n" + feet + STEEL + line, f"feet.bdf line 28: ", part)

    def test_replication_and_numbers_with_blanks(self):
        """A mast of five bars by replication is the one that is written out."""
        deck = ("BEGIN BULK\nGRID,1,,0.,0.,0.\n=,*1,=,=,=,*(1.5)\n=(4)\nCBAR,1,1,1,2,1.,0.,0.\n=,*(1),=,*1,*1,==\n=3\n"
                "PBAR,1,1,.01,8.33-6,8.33-6,1.4-5\nSPC1,1,123456,1\n" + small("MAT1", 1, "2.1 +11", "", .3, "78.5 E2"))
        scene, said = imported.imported(self, "mast.bdf", deck)
        plain = ("BEGIN BULK\n" + "".join(small("GRID", n, "", 0., 0., 1.5 * (n - 1)) for n in range(1, 7))
                 + "".join(small("CBAR", n, 1, n, n + 1, 1., 0., 0.) for n in range(1, 6)) + small("PBAR", 1, 1, .01, "8.33-6", "8.33-6", "1.4-5")
                 + STEEL + small("SPC1", 1, 123456, 1))
        other, told = imported.imported(self, "mast.bdf", plain)
        self.assertEqual((scene.read_text(), scene.with_suffix(".msh").read_text()), (other.read_text(), other.with_suffix(".msh").read_text()))
        close(self, (*said_mass(said)[1], *said_mass(told)[1]), (0, 0, 3.75, 0, 0, 3.75))
        for line, part in (("=,*1\n", "line 2: a replication of no card"), ("GRID,1,,0.,0.,0.\n=(3)\n", "line 3: =(3) repeats no replication"),
                           ("GRID,1,,0.,0.,0.\n=x,*1\n", "line 3: '=x' is no replication"),
                           ("GRID,1,,0.,0.,0.\n=(9999999),*1\n", "line 3: a replication of 9999999 cards")):
            imported.refused(self, "mast.bdf", "BEGIN BULK\n" + line, part)

    def test_thickness_of_a_plate_by_parts_of_its_property(self):
        """TFLAG 1: T1 to T4 are parts of 0.2 m; the first plate has 0.2 m, the second 0.1 m of it."""
        points = {1: (0, 0, 0), 2: (2, 0, 0), 3: (4, 0, 0), 4: (0, 1, 0), 5: (2, 1, 0), 6: (4, 1, 0)}
        deck = ("".join(small("GRID", n, "", *map(float, x)) for n, x in points.items()) + small("CQUAD4", 1, 1, 1, 2, 5, 4)
                + small("CQUAD4", 2, 1, 2, 3, 6, 5, "", "", "", "{flag}", .5, .5, .5, .5)
                + small("PSHELL", 1, 1, .2, 1, "", 1) + small("MAT1", 1, "3.+10", "", .2, 2500.) + small("SPC1", 1, 123456, 1, 4))
        for flag, mass in ((1, 1500), (0, 3500), ("", 3500)):
            _, said = imported.imported(self, "plate.bdf", deck.replace("{flag}", f"{flag!s:6}"))
            close(self, said_mass(said)[:1], (mass,))
        imported.refused(self, "plate.bdf", deck.replace("{flag}", "2     "), "CQUAD4 2 has TFLAG 2; it is 0 or 1")

    def test_rotary_inertia_of_bars_is_said(self):
        bars = self.REST + small("CBAR", 1, 1, 1, 2, 1., 0., 0.) + small("CBAR", 2, 1, 2, 3, 1., 0., 0.)
        _, said = imported.imported(self, "post.bdf", "BEGIN BULK\n" + bars)
        self.assertIn("\nbeams have the rotary inertia of their sections here", said)
        _, said = imported.imported(self, "post.bdf", "BEGIN BULK\nPARAM,COUPMASS,1\n" + bars)
        self.assertNotIn("rotary inertia", said)

    def test_numbers_given_twice(self):
        """The same again counts once; another card of the number is refused with both places."""
        bars = self.REST + small("CBAR", 1, 1, 1, 2, 1., 0., 0.) + small("CBAR", 2, 1, 2, 3, 1., 0., 0.) + small("CONM2", 3, 3, "", 10.)
        cards = {"GRID": small("GRID", 3, "", 0., 0., 3.1), "MAT1": small("MAT1", 1, "2.1+11", "", .3, 7000.),
                 "PBAR": small("PBAR", 1, 1, .02, "8.33-6", "8.33-6", "1.4-5"), "CBAR": small("CBAR", 2, 1, 2, 3, 0., 1., 0.),
                 "CONM2": small("CONM2", 3, 3, "", 20.), "PBARL": small("PBARL", 1, 1, "", "ROD") + small("+", .1),
                 "CROD": small("CROD", 2, 1, 2, 3), "PARAM": "PARAM,WTMASS,1.\nPARAM,WTMASS,2.\n"}
        _, alone = imported.imported(self, "post.bdf", "BEGIN BULK\n" + bars)
        for name, card in cards.items():
            with self.subTest(name):
                imported.refused(self, "post.bdf", "BEGIN BULK\n" + bars + card, f"{name} ", "is given twice, in another way at post.bdf "
                                                                                     "line ")
        _, again = imported.imported(self, "post.bdf", "BEGIN BULK\n" + bars + bars.replace("10.", "10.0"))
        self.assertEqual(said_mass(again), said_mass(alone))

    def test_texts_that_no_deck_has(self):
        """One line in no time: files that are none or include each other again and again, ranges of a hundred million, long
        words, digits of other alphabets, numbers of thousands of digits."""
        bars = self.REST + small("CBAR", 1, 1, 1, 2, 1., 0., 0.)
        many, letters = "9" * 5000, "A" * 9000
        cases = {"INCLUDE '/dev/zero'": "no file with contents", "INCLUDE 'pipe'": "no file with contents", "INCLUDE 'c0'": "more than 1000 files",
                 "INCLUDE 'x": "an INCLUDE whose name does not end", "RBE2,9,1,123456,2,THRU,99999999": "a list of 99999998 numbers",
                 "SPOINT,5,THRU,99999999": "a list of 99999995 numbers", f"GRID,{letters}": "is not a whole number",
                 f"GRID,9,,{many},0.,0.": "is not a number", f"SPC1,1,{many},2": "are not components", f"=({many}),*1": "is no replication",
                 "SPC1,1,\xb2,2": "are not components", "GRID,\xb2,,0.,0.,0.": "is not a whole number", "CBAR,7,1,1,2,\xb2": "is not a whole number",
                 "PCOMP,5\n,1,1.+200": "'1.+200' is beyond 1e+60", "MPC,1,\xb2,1,1.,2,1,-1.": "MPC 1 would be lost"}
        for line, part in cases.items():
            path = imported.of_file("deck.bdf", ("BEGIN BULK\n" + bars + line + "\n").encode("latin-1"))
            if "pipe" in line:
                os.mkfifo(path.with_name("pipe"))
            for k in range(22 if "c0" in line else 0):
                path.with_name(f"c{k}").write_text(f"INCLUDE 'c{k + 1}'\n" * 2 if k < 21 else "$\n")
            begin = time.monotonic()
            done = imported.command(path, "m,kg,s")
            self.assertLess(time.monotonic() - begin, 5, line[:40])
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
            self.assertIn(part, done.stderr)
            self.assertLess(len(done.stderr), 300)
        imported.refused(self, "deck.bdf", f"CEND\nSPC = {many}\nBEGIN BULK\n" + bars, "line 2: SPC: '999", "is not a whole number")
        _, said = imported.imported(self, "deck.bdf", "BEGIN BULK\n" + bars + "SPC1,1,3,1,THRU,99999999\n")
        self.assertIn("supported nodes 2:", said)


if __name__ == "__main__":
    unittest.main()
