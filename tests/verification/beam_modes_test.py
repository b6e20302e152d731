"""Frequencies of beams and frames with lumped mass: a cantilever, a portal frame, and eight arms
that meet in one point (NAFEMS FV2).

The beam is Euler-Bernoulli's; each node of an element of length L carries rho A L / 2 and, in
bending, the rotary inertia of its half chord, rho A L^3 / 24, and of the section, rho I L / 2.
References:
- cantilever: independent code with the rotary inertia rho A L^3 / 24 alone. E is multiplied and I
  divided by 10^4 here, so that the section's own rotary inertia vanishes;
- portal: exact Euler-Bernoulli frequencies, from which lumping and rotary inertia take away; to more
  digits, the plane frame assembled below (checked on figures of an independent code, whose rotary
  inertia is 2 / 78 of rho A L^3 / 2 as in the lumping of Hinton, Rock and Zienkiewicz);
- arms: all are pinned at their ends, the modes 1 and 9 are those of a pinned beam. Smeared out, the
  rotary inertia is rho A L^2 / 12 + rho I, and f = f_0 / sqrt(1 + k^2 (L^2 / 12 + I / A)).
Out of their plane portal and arms are so stiff that the lowest modes are plane.
"""
import math
import unittest

import numpy

import decks
import modal_run

CANTILEVER_EXACT = [9.088777, 56.958393, 159.485150, 312.527242]
CANTILEVER_LUMPED = {8: [8.997188402, 54.493662410, 146.648124689, 274.322968260],
                     16: [9.065679037, 56.313281798, 155.959603089, 301.369721357],
                     32: [9.082989870, 56.795247671, 158.583017092, 309.628118453]}
PORTAL_EXACT = [17.378000, 56.175963, 103.145309, 103.988567, 195.006208, 259.479313]
PORTAL_HRZ = [17.274099582, 55.701624742, 100.047672167, 102.837915972, 188.774722148,
              250.300058964]  # 4 elements a member
ARM_BENDING = [11.336246, 45.344984]
# What theory gives with flexible arms: modes 1, 2-3, 4-8, 9, 10-11, 12-16
CROSS = [11.33625] + 2 * [17.68081] + 5 * [17.70942] + [45.34573] + 2 * [57.07605] + 5 * [57.39124]


def plane_frame(elements_per_member, hrz=False):
    """Frequencies of the portal in its plane, (ux, uy, rz) per node, assembled and solved densely."""
    n, young, density = elements_per_member, 200e9, 7800
    members = [((0, 0), (0, 3), 5.38e-3, 1.673e-5), ((4, 0), (4, 3), 5.38e-3, 1.673e-5),
               ((0, 3), (4, 3), 2.85e-3, 1.943e-5)]
    nodes, elements = {}, []
    for start, end, area, inertia in members:
        points = [tuple(round(a + (b - a) * i / n, 9) for a, b in zip(start, end)) for i in range(n + 1)]
        numbers = [nodes.setdefault(point, len(nodes)) for point in points]
        elements += [(a, b, points[0], points[1], area, inertia) for a, b in zip(numbers, numbers[1:])]
    stiffness, mass = numpy.zeros((3 * len(nodes),) * 2), numpy.zeros(3 * len(nodes))
    for a, b, first, second, area, inertia in elements:
        length = math.dist(first, second)
        c, s = (second[0] - first[0]) / length, (second[1] - first[1]) / length
        turn = numpy.kron(numpy.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])
        axial, k = young * area / length, young * inertia / length**3
        local = numpy.zeros((6, 6))
        local[numpy.ix_([0, 3], [0, 3])] = [[axial, -axial], [-axial, axial]]
        h, q = 6 * length, length**2
        local[numpy.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = k * numpy.array(
            [[12, h, -12, h], [h, 4 * q, -h, 2 * q], [-12, -h, 12, -h], [h, 2 * q, -h, 4 * q]])
        dofs = [3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 1, 3 * b + 2]
        stiffness[numpy.ix_(dofs, dofs)] += turn.T @ local @ turn
        half = density * area * length / 2
        turning = half * (length**2 / 39 if hrz else length**2 / 12 + inertia / area)
        mass[dofs] += 2 * [half, half, turning]
    free = [3 * i + c for point, i in nodes.items() if point[1] > 0 for c in range(3)]
    scale = 1 / numpy.sqrt(mass[free])
    squares = numpy.linalg.eigvalsh(stiffness[numpy.ix_(free, free)] * numpy.outer(scale, scale))
    return list(numpy.sqrt(squares) / (2 * math.pi))


def cantilever(elements):
    factor, side = 1e4, 0.1
    area, inertia = side**2, side**4 / 12
    words = modal_run.material(200e9 * factor, 0.3, 7800) + ["-@_clamp", "x_min"]
    words += modal_run.group("line", "euler_beam", section="@")
    words += decks.section("@", area, inertia, inertia / factor, inertia)
    return modal_run.case("line", words, length=3, n=elements)


def portal(elements):
    words = modal_run.material(200e9, 0.3, 7800) + ["-@_clamp", "base"]
    words += modal_run.group("columns", "euler_beam", section="@c")
    words += modal_run.group("girder", "euler_beam", section="@g")
    words += decks.section("@c", 5.38e-3, 1e-2, 1.673e-5, 1e-2)
    words += decks.section("@g", 2.85e-3, 1e-2, 1.943e-5, 1e-2)
    return modal_run.case("portal", words, n=elements)


def cross(elements):
    words = modal_run.material(200e9, 0.3, 8000) + modal_run.group("arms", "euler_beam", section="@")
    words += decks.section("@", 0.125**2, 2, 0.125**4 / 12, 2)
    words += modal_run.group("ends", "grounded_spring", stiffness="1e14,1e14,1e14")
    return modal_run.case("double_cross", words, n=elements)


class Cantilever(unittest.TestCase):
    def test_frequencies(self):
        """Those of the lumped beam, on ranks that share it; from below at second order those of the exact one."""
        results = modal_run.structures(self, [cantilever(n) for n in CANTILEVER_LUMPED], 4, ranks=3)
        found = [modal_run.frequencies(result) for result in results]
        for (n, expected), frequencies in zip(CANTILEVER_LUMPED.items(), found):
            modal_run.assert_close(self, frequencies, expected, 1e-6, f"n = {n}")
        for f16, f32, exact in zip(*found[1:], CANTILEVER_EXACT):
            self.assertLess(f32, exact)
            self.assertAlmostEqual(math.log2((exact - f16) / (exact - f32)), 2, delta=0.06)


class Portal(unittest.TestCase):
    def test_plane_frame_of_this_test_agrees_with_an_independent_code(self):
        modal_run.assert_close(self, plane_frame(4, hrz=True), PORTAL_HRZ, 1e-8, "plane frame")

    def test_frequencies(self):
        results = modal_run.structures(self, [portal(4), portal(16)], modes=12)
        for n, result in zip((4, 16), results):
            found = modal_run.moving(result, (0, 1, 5))
            modal_run.assert_close(self, found, plane_frame(n)[:6], 1e-6, f"n = {n}")
        for value, exact in zip(found, PORTAL_EXACT):
            self.assertLess(value, exact)
        modal_run.assert_close(self, found, PORTAL_EXACT, 0.015, "exact")
        self.assertAlmostEqual(found[0] / PORTAL_EXACT[0], 1, delta=1e-3)


class DoubleCross(unittest.TestCase):
    def test_frequencies_and_lumping_error(self):
        results = modal_run.structures(self, [cross(4), cross(16)], modes=22, mechanisms=False)
        for n, tolerance, result in zip((4, 16), (5e-3, 1e-4), results):
            found = modal_run.frequencies(result)
            for number, (mode, exact) in enumerate(zip((found[0], found[8]), ARM_BENDING), start=1):
                k = number * math.pi / 5
                expected = exact / math.sqrt(1 + k**2 * ((5 / n)**2 + 0.125**2) / 12)
                self.assertAlmostEqual(mode / expected, 1, delta=tolerance, msg=(n, number))
        modal_run.assert_close(self, found, CROSS, 0.01, "FV2")
        for value, exact in zip(found, CROSS):
            self.assertLess(value, exact)

    def test_hinged_arms_are_mechanisms(self):
        """Also beside springs, which have stiffness and no mass: no element bounds their frequency."""
        words = modal_run.material(200e9, 0.3, 8000) + modal_run.group("arms", "bar", area=0.125**2)
        words += modal_run.group("ends", "grounded_spring", stiffness="1e14,1e14,1e14")
        modal_run.structures(self, [modal_run.case("double_cross", words, n=4)], 4, ranks=2, mechanisms=True)


if __name__ == "__main__":
    unittest.main()
