"""LS-DYNA decks become scenes whose modes are those of the same models written by hand."""
import math
import unittest

import imported
from imported import by_hand, close, frequencies, said_mass, same, section, structure


def ten(*fields):
    assert max(len(str(word)) for word in fields) <= 10
    return "".join(f"{word!s:>10}" for word in fields) + "\n"


def eight(*fields):
    return "".join(f"{word!s:>8}" for word in fields) + "\n"


def nodes(places, codes=()):
    codes = dict(codes)
    return "*NODE\n" + "".join(f"{n:8d}" + "".join(f"{value:16.9g}" for value in map(float, x))
                               + "".join(f"{code:8d}" for code in codes.get(n, (0, 0))) + "\n" for n,
                               x in places.items())


def part(number, title, own_section, material):
    return f"*PART\n{title}\n" + ten(number, own_section, material)


# The public stick: levels, areas, inertias, shear areas and masses in ft and kip s2/ft.
LEVELS = (0, 8, 13, 22, 33.5, 49, 61, 93)
AREAS = (2000, 2560, 2210, 1960, 1740, 780, 190)
INERTIAS = (1.1e6, 1.2e6, 1.2e6, 1.3e6, 9e5, 2e5, 4e3)
SHEAR = (1320, 1560, 1460, 730, 600, 360, 70)
MASSES = (85.52, 76.32, 193.22, 114.29, 263.40, 37.12, 25.17)


class Dyna(unittest.TestCase):
    def test_the_stick_of_a_reactor_building(self):
        """Resultant beams with shear areas in ft, kip, s: its published first modes are 8.455, 12.367 and 32.89 Hz."""
        deck = "*KEYWORD\n*TITLE\nInternal structure\n*CONTROL_TERMINATION\n" + ten(20.0)
        deck += nodes({n: (0, 0, z) for n, z in enumerate(LEVELS, 1)} | {100: (5, 0, 0)}, {1: (7, 7)})
        deck += "*MAT_ELASTIC_TITLE\nconcrete\n" + ten(1, 1e-4, 3.45e5, 0.278)
        for n, (area, inertia, shear, mass) in enumerate(zip(AREAS, INERTIAS, SHEAR, MASSES), 1):
            deck += part(n, f"storey {n}", n, 1) + "*SECTION_BEAM\n" + ten(n, 2, 1.0, 1, 0) + ten(
                area, inertia, inertia, 2 * inertia, shear)
            deck += "*ELEMENT_BEAM\n" + eight(n, n, n, n + 1, 100)
            deck += "*ELEMENT_MASS\n" + f"{100 + n:8d}{n + 1:8d}{mass:16.6f}\n"
        deck += "*DAMPING_GLOBAL\n" + ten(0, 3.266) + "*DATABASE_NODOUT\n" + ten(0.005) + "*END\n"
        scene, said = imported.imported(self, "stick.k", deck, "ft,kip,s")
        found = frequencies(structure(self, scene))
        for value, reference in zip(found[::2], (8.455, 12.367, 27.83, 32.89)):
            self.assertLess(abs(value / reference - 1), 2e-3, found)
        kip = 4448.2216152605
        heights = [b - a for a, b in zip(LEVELS, LEVELS[1:])]
        close(self, said_mass(said)[:1], ((sum(MASSES) + 1e-4 * sum(a * h for a, h in zip(AREAS,
                                                                                          heights))) * kip / 0.3048,))
        self.assertIn("(titles, output and control): CONTROL_TERMINATION 1, DATABASE_NODOUT 1", said)

    def test_bricks_shells_beams_and_joints(self):
        """Solids with a wedge, shells on one side of their nodes, beams by a third node with sections off them,
        springs, discrete beams, inertia, a rigid part with extra nodes, a nodal rigid body."""
        places = {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0), 5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1),
                  8: (0, 1, 1),
                  9: (2, 0.5, 0), 10: (2, 0.5, 1), 11: (0, 0, 3), 12: (2, 0, 3), 13: (9, 0, 3), 14: (0, 9, 3),
                  15: (0, 0, 3),
                  16: (3, 0, 3), 17: (3, 0.5, 3), 18: (3, 0, 3.5)}
        deck = ("*KEYWORD\n$ a comment\n" + nodes(places, {n: (7, 0) for n in (1, 2, 3, 4)})
                + "*MAT_ELASTIC\n" + ten(1, 7850.0, "2.1e11", 0.3) + "*MAT_RIGID\n" + ten(2, 7850.0, "2.1e11",
                                                                                          0.3) + ten(0, 0, 0)
                + "*MAT_SPRING_ELASTIC\n" + ten(3, 4e6) + "*MAT_DAMPER_VISCOUS\n" + ten(4, 2e3)
                + "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n" + ten(5, 1000.0, 1e7, 2e7, 3e7, 1e4, 1e4, 1e4) + ten(100.0, 0,
                                                                                                             0)
                + part(1, "body", 1, 1) + part(2, "roof", 2, 1) + part(3, "mast", 3, 1) + part(4, "stay", 4, 3)
                + part(5, "oil", 4, 4) + part(6, "pad", 5, 5) + part(7, "cap", 2, 2)
                + "*SECTION_SOLID\n" + ten(1, 1) + "*SECTION_SHELL\n" + ten(2, 16, 0.833) + ten(0.1, 0.1, 0.1, 0.1,
                                                                                                -1.0, 25.0)
                + "*SECTION_BEAM\n" + ten(3, 1, 0.8333, 2, 0) + ten(0.1, 0.1, 0.2, 0.2, 0.0, 1.0)
                + "*SECTION_DISCRETE\n" + ten(4, 0) + ten(0) + "*SECTION_BEAM\n" + ten(5, 6) + ten(0.05, 0.002, 0)
                + "*DEFINE_SD_ORIENTATION\n" + ten(8, 0, 0.0, 1.0, 0.0)
                + "*ELEMENT_SOLID\n" + eight(1, 1, *range(1, 9)) + eight(2, 1) + eight(2, 9, 3, 3, 6, 10, 7, 7)
                + "*ELEMENT_SHELL\n" + eight(3, 2, 5, 6, 7, 8) + eight(4, 7, 6, 10, 7, 7)
                + "*ELEMENT_BEAM\n" + eight(5, 3, 5, 11, 14) + eight(6, 3, 11, 12, 14) + eight(7, 3, 12, 16, 14)
                + eight(8, 6, 11, 15) + "*ELEMENT_DISCRETE\n" + eight(9, 4, 12, 3, 0) + eight(10, 5, 12, 0, 8)
                + "*ELEMENT_INERTIA\n" + eight(11, 15, 0) + ten(3.0, 0, 0, 4.0, 0, 5.0, 60.0)
                + "*ELEMENT_MASS\n" + f"{12:8d}{17:8d}{30.0:16.6f}\n{13:8d}{18:8d}{20.0:16.6f}\n"
                + "*SET_NODE_LIST\n" + ten(1) + ten(16, 17, 18) + "*CONSTRAINED_NODAL_RIGID_BODY\n" + ten(20, 0, 1)
                + "*BOUNDARY_SPC_SET\n" + ten(2, 0, 1, 1, 1, 0, 0, 0) + "*SET_NODE\n" + ten(2) + ten(9)
                + "*BOUNDARY_SPC_NODE\n" + ten(15, 0, 0, 1, 0, 0, 0, 0) + "*LOAD_BODY_Z\n" + ten(1, 9.81) + "*END\n")
        scene, said = imported.imported(self, "model.k", deck)
        # NLOC -1: nodes in the lower face, the middle half a thickness above.
        lifted = {5: 25, 6: 26, 7: 27, 8: 28, 10: 40}
        hand = {n: x for n, x in places.items() if n not in (13, 14)}
        hand |= {own: (*places[n][:2], 1.05) for n, own in lifted.items()}
        # s towards node 14, t = r x s; ntloc 1: nodes on the side of t, sections 0.1 against it.
        s5 = unit_across((0, 9, 2), (0, 0, 2))
        t5 = cross((0, 0, 1), s5)
        hand |= {45: offset(places[5], t5, -0.1), 51: offset(places[11], t5, -0.1)}
        s6 = unit_across((0, 9, 0), (1, 0, 0))
        t6 = cross((1, 0, 0), s6)
        hand |= {61: offset(places[11], t6, -0.1), 62: offset(places[12], t6, -0.1)}
        s7 = unit_across((-2, 9, 0), (1, 0, 0))
        t7 = cross((1, 0, 0), s7)
        hand |= {76: offset(places[16], t7, -0.1)}
        twist = 0.2 * 0.1**3 / 3 * (1 - 96 / math.pi**5 * sum(math.tanh(n * math.pi) / n**5 for n in range(1, 4001, 2)))
        stay = math.dist(places[12], places[3])
        shear = f"{0.8333 * 0.02},{0.8333 * 0.02}"
        # I about s with 0.2 along t is that about z of the program.
        wide, flat = 0.1 * 0.2**3 / 12, 0.2 * 0.1**3 / 12
        words = by_hand(hand, {
            "body": ("brick", [range(1, 9)]), "wedge": ("wedge", [(2, 9, 3, 6, 10, 7)]), "roof": ("quadrangle",
                                                                                                  [(25, 26, 27, 28)]),
            "cap": ("triangle", [(26, 40, 27)]), "masta": ("line", [(45, 51)]), "mastb": ("line", [(61, 62), (62, 76)]),
            "stay": ("line", [(12, 3)]), "oil": ("point", [(12,)]), "pad": ("line", [(11, 15)]), "padmass": ("point",
                                                                                                             [(11,)]),
            "inertia": ("point", [(15,)]), "side": ("point", [(17,)]), "up": ("point", [(18,)]),
            "base": ("point", [(n,) for n in (1, 2, 3, 4, 9)]), "guide": ("point", [(15,)]),
            "r1": ("point", [(n,) for n in (5, 25, 45)]), "r2": ("point", [(n,) for n in (6, 7, 10, 26, 27, 40)]),
            "r3": ("point", [(8,), (28,)]), "r4": ("point", [(n,) for n in (11, 51, 61)]), "r5": ("point", [(12,),
                                                                                                            (62,)]),
            "r6": ("point", [(n,) for n in (16, 17, 18, 76)])}, {
            "body_element": "hex8", "wedge_element": "wedge6", "roof_element": "shell", "cap_element": "shell",
            **{f"{name}_material": "m" for name in ("body", "wedge", "roof", "cap", "masta", "mastb")},
            "roof_thickness": 0.1, "roof_mass_per_area": 25, "cap_thickness": 0.1, "cap_mass_per_area": 25,
            "masta_element": "beam", "masta_section": "a", "mastb_element": "beam", "mastb_section": "b",
            "stay_element": "bar",
            "stay_material": "rope", "stay_area": 4e6 * stay / 1e11, "oil_element": "grounded_spring",
            "oil_stiffness": "0,0,0",
            "oil_dashpot": "0,2e3,0", "pad_element": "spring", "pad_stiffness": "1e7,2e7,3e7,1e4,1e4,1e4",
            "pad_dashpot": "100,0,0,0,0,0", "padmass_element": "point_mass", "padmass_mass": 25,
            "padmass_rotary_inertia": "1,1,1", "inertia_element": "point_mass", "inertia_mass": 85,
            "inertia_rotary_inertia": "4,5,6", "side_element": "point_mass", "side_mass": 30,
            "up_element": "point_mass",
            "up_mass": 20, "clamp": "base,guide:y", "rigid": "r1,r2,r3,r4,r5,r6", "-material_m_young": 2.1e11,
            "-material_m_poisson": 0.3, "-material_m_density": 7850, "-material_rope_young": 1e11,
            "-material_rope_poisson": 0,
            "-material_rope_density": 1e-9, **section("a", 0.02, flat, wide, twist, ",".join(map(str, s5)), shear),
            **section("b", 0.02, flat, wide, twist, ",".join(map(str, s6)), shear)})
        same(self, scene, words)
        self.assertIn("rigid bodies 2", said)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit_across(way, axis):
    size = math.dist(axis, (0, 0, 0))
    axis = [value / size for value in axis]
    along = sum(a * b for a, b in zip(way, axis))
    part_ = [a - along * b for a, b in zip(way, axis)]
    size = math.dist(part_, (0, 0, 0))
    return tuple(value / size for value in part_)


def offset(place, direction, by):
    return tuple(a + by * b for a, b in zip(place, direction))


if __name__ == "__main__":
    unittest.main()
