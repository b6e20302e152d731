"""The largest circular frequency of a mesh, and the stable time step that follows from it.

Bars: a free mesh of elements of length h has exactly 2 c / h, c = sqrt(E / rho); with N elements
2 c / h sin((2 N - 1) pi / (4 N)) if one end is fixed, 2 c / h sin((N - 1) pi / (2 N)) if both are.
Hexahedra with row-sum mass: one cube sqrt(12 K / rho) / h (uniform dilatation, K the bulk modulus);
meshes: independent code. Beam of Euler-Bernoulli: sqrt(48 + 6 / gamma) sqrt(E I / (rho A)) / L^2, with
the rotary inertia gamma rho A L^3 of a node, here gamma = 1 / 24 + I / (2 A L^2). Square shell:
(2 / h) sqrt(E / ((1 - nu) rho)) (uniform dilatation in its plane). Stable time step: Ambiel et al.,
Eng. Struct. 251 (2022) 113385, Eq. 12. omega_max adds the error bound of its eigenvalue, so that
values may be above by a few 1e-9, not below.
"""
import math
import unittest

import decks
import modal_run
import program

TOLERANCE = 1e-6
STEEL = (210e9, 0.3, 7800)
BAR_LENGTH, BAR_ELEMENTS, BAR_OMEGA = 10, 40, 41509.961733022

# Fully integrated: cells, size of one of them [m], Poisson's ratio, omega_max [rad/s]; E = 30 GPa.
HEXAHEDRA = [
    ((1, 1, 1), (1, 1, 1), 0.2, 9128.709291753), ((1, 1, 1), (1, 1, 1), 0.3, 11180.339887499),
    ((1, 1, 1), (0.12, 0.12, 0.22), 0.2, 70480.167842516),
    ((1, 1, 1), (1, 1, 0.05), 0.2, 149094.554718977),
    ((2, 2, 1), (0.12, 0.12, 0.22), 0.2, 63502.197706329),
    ((4, 4, 1), (0.12, 0.12, 0.22), 0.2, 62702.176653780),
    ((8, 8, 1), (0.12, 0.12, 0.22), 0.2, 62394.745558270),
    ((12, 8, 1), (0.12, 0.12, 0.22), 0.2, 62366.226168246),
    ((2, 2, 2), (1, 1, 1), 0.2, 7695.610221166), ((4, 4, 4), (1, 1, 1), 0.2, 7548.811580981),
    ((4, 4, 4), (1, 1, 1), 0.3, 8564.781227735),
    ((8, 8, 1), (0.25, 0.25, 0.22), 0.2, 34488.618267367),
    ((8, 8, 2), (0.12, 0.12, 0.11), 0.2, 68256.657931517)]


def stable_step(omega, alpha, beta):
    """Eq. 12 as it is printed."""
    ratio = alpha / (2 * omega) + beta * omega / 2
    return 2 / omega * (math.sqrt(1 + ratio**2) - ratio)


def bar(elements=BAR_ELEMENTS, clamp="", alpha=0, beta=0):
    words = modal_run.material(*STEEL) + modal_run.group("line", "bar", area=0.01)
    words += ["-@_damping_alpha", alpha, "-@_damping_beta", beta]
    words += ["-@_clamp", clamp] if clamp else []
    return modal_run.case("line", words, length=BAR_LENGTH, n=elements)


def hexahedra(cells, size, poisson, element="hex8_full"):
    words = modal_run.material(30e9, poisson, 2400) + modal_run.group("body", element)
    lengths = {f"l{axis}": round(n * h, 9) for axis, n, h in zip("xyz", cells, size)}
    return modal_run.case("box", words, nx=cells[0], ny=cells[1], nz=cells[2], **lengths)


class OmegaMax(unittest.TestCase):
    def check(self, cases, expected, tolerance=TOLERANCE, ranks=program.RANKS):
        results = modal_run.structures(self, cases, ranks=ranks)
        for number, (result, omega) in enumerate(zip(results, expected)):
            self.assertAlmostEqual(result["omega_max"] / omega, 1, delta=tolerance, msg=(number, omega))
            self.assertLessEqual(result["omega_max"], result["element_frequency_bound"] * (1 + 1e-9), number)
            self.assertAlmostEqual(result["stable_time_step_undamped"] * omega / 2, 1, delta=tolerance)

    def test_bars(self):
        n = BAR_ELEMENTS
        limit = 2 * math.sqrt(STEEL[0] / STEEL[2]) / (BAR_LENGTH / n)
        self.assertAlmostEqual(limit, BAR_OMEGA, delta=1e-6)
        self.check([bar(), bar(clamp="x_min"), bar(clamp="x_min,x_max")],
                   [limit, limit * math.sin((2 * n - 1) * math.pi / (4 * n)),
                    limit * math.sin((n - 1) * math.pi / (2 * n))], 1e-8)

    def test_hexahedra(self):
        self.check([hexahedra(*case[:3]) for case in HEXAHEDRA], [case[3] for case in HEXAHEDRA])

    def test_one_cube_dilates_whatever_its_element(self):
        ratios = (0, 0.2, 0.3, 0.45)
        expected = [math.sqrt(12 * 30e9 / (3 * (1 - 2 * poisson)) / 2400) for poisson in ratios]
        for element in ("hex8", "hex8_full"):
            self.check([hexahedra((1, 1, 1), (1, 1, 1), poisson, element) for poisson in ratios], expected)

    def test_meshes_stay_below_their_elements_and_above_the_plane_wave(self):
        """2 c_p / h is not safe for a free mesh; the value of one element is."""
        wave = 2 / 0.12 * math.sqrt(30e9 * 0.8 / (1.2 * 0.6) / 2400)
        for element in ("hex8", "hex8_full"):
            result, = modal_run.structures(self, [hexahedra((4, 4, 1), (0.12, 0.12, 0.22), 0.2, element)])
            self.assertGreater(result["omega_max"], 1.005 * wave)
            self.assertLess(result["omega_max"], 0.9 * 70480.167842516)
            self.assertAlmostEqual(result["element_frequency_bound"] / 70480.167842516, 1, delta=TOLERANCE)

    def test_one_square_shell_dilates_in_its_plane(self):
        words = modal_run.material(30e9, 0.2, 2400) + modal_run.group("plate", "shell", thickness=0.22)
        shell = modal_run.case("quadrilateral", words, nx=1, ny=1, length=0.12, width_0=0.12, width_1=0.12)
        self.check([shell], [2 / 0.12 * math.sqrt(30e9 / (0.8 * 2400))])

    def test_one_beam(self):
        """Stretching, 2 c / L, where the beam is short, else bending, which its shear holds back."""
        wave, radius, area, shear = math.sqrt(STEEL[0] / STEEL[2]), 0.05, 0.01, 0.006
        cases, expected = [], []
        for length, bends in ((0.05, False), (0.1, False), (1.0, True)):
            phi = 12 * radius**2 / length**2 * area / shear * 2 * (1 + STEEL[1])
            rigidity = 12 * (radius * wave)**2 / (length**3 * (1 + phi))  # over the mass per length
            bending = math.sqrt(rigidity * (4 / length + length / radius**2))
            self.assertEqual(bending > 2 * wave / length, bends)
            expected.append(max(bending, 2 * wave / length))
            words = modal_run.material(*STEEL) + modal_run.group("line", "beam", section="@")
            words += decks.section("@", area, area * radius**2, area * radius**2, area * radius**2)
            words += ["-section_@_shear_area", f"{shear},{shear}", "-spectra_frequencies", "1,1e5"]
            cases.append(modal_run.case("line", words, length=length, n=1))
        for case, omega in zip(cases, expected):
            self.check([case], [omega], 6e-4)  # a thousandth of inertia

    def test_one_euler_beam(self):
        """Bending governs where the beam is short, else stretching, 2 c / L."""
        wave, radius, area = math.sqrt(STEEL[0] / STEEL[2]), 0.05, 0.01
        cases, expected = [], []
        for length, bends in ((0.05, True), (0.1, True), (0.5, False)):
            gamma = 1 / 24 + radius**2 / (2 * length**2)
            bending, stretching = math.sqrt(48 + 6 / gamma) * radius * wave / length**2, 2 * wave / length
            self.assertEqual(bending > stretching, bends)
            expected.append(max(bending, stretching))
            words = modal_run.material(*STEEL) + modal_run.group("line", "euler_beam", section="@")
            words += decks.section("@", area, area * radius**2 / 4, area * radius**2, area * radius**2)
            cases.append(modal_run.case("line", words, length=length, n=1))
        self.check(cases, expected)

    def test_same_on_every_number_of_ranks(self):
        for ranks in (1, 3):
            self.check([bar(), hexahedra((4, 4, 1), (0.12, 0.12, 0.22), 0.2)],
                       [BAR_OMEGA, 62702.176653780], 1e-8, ranks)


class StableTimeStep(unittest.TestCase):
    def test_equation_12(self):
        dampings = ((0, 0), (0.1562, 1.2557e-5), (0, 1e-4), (1e5, 0), (0.2723, 2e-7))
        results = modal_run.structures(self, [bar(alpha=a, beta=b) for a, b in dampings])
        for (alpha, beta), result in zip(dampings, results):
            expected = stable_step(BAR_OMEGA, alpha, beta)
            self.assertAlmostEqual(result["stable_time_step"] / expected, 1, delta=1e-7, msg=(alpha, beta))

    def test_strong_damping_does_not_cancel(self):
        """xi = 2e6: Eq. 12 as printed has lost its digits; 2 / (omega (sqrt(1 + xi^2) + xi)) has not."""
        beta = 100.0
        result, = modal_run.structures(self, [bar(beta=beta)])
        self.assertAlmostEqual(result["stable_time_step"] * beta * BAR_OMEGA**2 / 2, 1, delta=1e-7)

    def test_the_run_takes_the_smallest_step_of_its_structures(self):
        words = ["-structures", "coarse,fine", "-end_time", 1e-4, "-modes", 1, "-courant", 0.75]
        for name, elements in (("coarse", BAR_ELEMENTS // 2), ("fine", BAR_ELEMENTS)):
            words += [str(word).replace("@", name) for word in bar(elements)]
        summary = program.must_run(self, words)[1]
        stable = 2 / BAR_OMEGA
        for name, step in (("coarse", 2 * stable), ("fine", stable)):
            self.assertAlmostEqual(summary["structures"][name]["stable_time_step"] / step, 1, delta=1e-8)
        self.assertAlmostEqual(summary["stable_time_step"] / stable, 1, delta=1e-8)
        self.assertLessEqual(summary["time_step"], 0.75 * stable)
        self.assertAlmostEqual(summary["time_step"] / (0.75 * stable), 1, delta=1e-5)
        self.assertEqual(summary["steps"], math.ceil(1e-4 / summary["time_step"]))


if __name__ == "__main__":
    unittest.main()
