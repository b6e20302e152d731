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

import modal_run
import program

TOLERANCE = 1e-6
STEEL = (210e9, 0.3, 7800)
BAR_LENGTH, BAR_ELEMENTS = 10, 40

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


class OmegaMax(unittest.TestCase):
    def check(self, result, omega, case, tolerance=TOLERANCE):
        self.assertAlmostEqual(result["omega_max"] / omega, 1, delta=tolerance, msg=case)
        self.assertLessEqual(result["omega_max"], result["element_frequency_bound"] * (1 + 1e-9), case)
        self.assertAlmostEqual(result["stable_time_step_undamped"] * omega / 2, 1, delta=tolerance, msg=case)

    def bar(self, clamp="", extra=(), ranks=2):
        words = modal_run.material(*STEEL) + modal_run.group("line", "bar", area=0.01)
        words += (["-b_clamp", clamp] if clamp else []) + list(extra)
        return modal_run.structure(self, "line", words, 1, ranks, length=BAR_LENGTH, n=BAR_ELEMENTS)

    def test_bars(self):
        n = BAR_ELEMENTS
        limit = 2 * math.sqrt(STEEL[0] / STEEL[2]) / (BAR_LENGTH / n)
        self.assertAlmostEqual(limit, 41509.961733, delta=1e-6)
        for clamp, omega in (("", limit), ("x_min", limit * math.sin((2 * n - 1) * math.pi / (4 * n))),
                             ("x_min,x_max", limit * math.sin((n - 1) * math.pi / (2 * n)))):
            self.check(self.bar(clamp), omega, f"clamped: {clamp or 'nothing'}", 1e-8)

    def hexahedra(self, cells, size, poisson, element="hex8_full", ranks=2):
        return modal_run.structure(
            self, "box", modal_run.material(30e9, poisson, 2400) + modal_run.group("body", element), 1, ranks,
            nx=cells[0], ny=cells[1], nz=cells[2],
            **{f"l{axis}": round(n * h, 9) for axis, n, h in zip("xyz", cells, size)})

    def test_hexahedra(self):
        for cells, size, poisson, omega in HEXAHEDRA:
            self.check(self.hexahedra(cells, size, poisson), omega, f"{cells} of {size}, nu = {poisson}")

    def test_one_cube_dilates_whatever_its_element(self):
        for poisson in (0, 0.2, 0.3, 0.45):
            omega = math.sqrt(12 * 30e9 / (3 * (1 - 2 * poisson)) / 2400)
            for element in ("hex8", "hex8_full"):
                self.check(self.hexahedra((1, 1, 1), (1, 1, 1), poisson, element), omega, (element, poisson))

    def test_one_square_shell_dilates_in_its_plane(self):
        words = modal_run.material(30e9, 0.2, 2400) + modal_run.group("plate", "shell", thickness=0.22)
        result = modal_run.structure(self, "quadrilateral", words, nx=1, ny=1, length=0.12, width_0=0.12,
                                     width_1=0.12)
        self.check(result, 2 / 0.12 * math.sqrt(30e9 / (0.8 * 2400)), "shell")

    def test_one_beam(self):
        """Bending governs where L < 5.5 radii of gyration, else stretching, 2 c / L."""
        young, poisson, density = STEEL
        radius = 0.05
        area, inertia = 0.01, 0.01 * radius**2
        stretching = math.sqrt(young / density)
        for length, bends in ((0.15, True), (0.25, True), (0.5, False)):
            gamma = 1 / 24 + inertia / (2 * area * length**2)
            omega = math.sqrt(48 + 6 / gamma) * radius * stretching / length**2
            if not bends:
                omega = 2 * stretching / length
            words = modal_run.material(*STEEL) + modal_run.group("line", "beam", section="s")
            words += modal_run.section("s", area, inertia / 4, inertia, inertia)
            result = modal_run.structure(self, "line", words, length=length, n=1)
            self.check(result, omega, f"beam of {length} m")

    def test_same_on_every_number_of_ranks(self):
        for ranks in (1, 3):
            self.check(self.hexahedra((4, 4, 1), (0.12, 0.12, 0.22), 0.2, ranks=ranks), 62702.176653780,
                       f"{ranks} ranks", 1e-8)
            self.check(self.bar(ranks=ranks), 41509.961733022, f"{ranks} ranks", 1e-8)


class StableTimeStep(unittest.TestCase):
    def test_equation_12(self):
        for alpha, beta in ((0, 0), (0.1562, 1.2557e-5), (0, 1e-4), (1e5, 0), (0.2723, 2e-7)):
            result = OmegaMax.bar(self, extra=["-b_damping_alpha", alpha, "-b_damping_beta", beta])
            expected = stable_step(41509.961733022, alpha, beta)
            self.assertAlmostEqual(result["stable_time_step"] / expected, 1, delta=1e-7, msg=(alpha, beta))

    def test_strong_damping_does_not_cancel(self):
        """xi = 2e6: Eq. 12 as printed has lost its digits; 2 / (omega (sqrt(1 + xi^2) + xi)) has not."""
        omega, beta = 41509.961733022, 100.0
        result = OmegaMax.bar(self, extra=["-b_damping_beta", beta])
        self.assertAlmostEqual(result["stable_time_step"] * beta * omega**2 / 2, 1, delta=1e-7)

    def test_the_run_takes_the_smallest_step_of_its_structures(self):
        words = ["-structures", "coarse,fine", "-end_time", 1e-4, "-modes", 1, "-courant", 0.75]
        words += modal_run.material(*STEEL)
        for name, elements in (("coarse", 20), ("fine", 40)):
            words += [f"-{name}_mesh", "tests/meshes/line.geo", f"-{name}_mesh_set", f"length=10,n={elements}",
                      f"-{name}_line_element", "bar", f"-{name}_line_material", "m", f"-{name}_line_area", 0.01]
        summary = program.must_run(self, words)[1]
        steps = [2 / 20754.980866511, 2 / 41509.961733022]
        for name, step in zip(("coarse", "fine"), steps):
            self.assertAlmostEqual(summary["structures"][name]["stable_time_step"] / step, 1, delta=1e-8)
        self.assertAlmostEqual(summary["stable_time_step"] / steps[1], 1, delta=1e-8)
        self.assertLessEqual(summary["time_step"], 0.75 * steps[1])
        self.assertAlmostEqual(summary["time_step"] / (0.75 * steps[1]), 1, delta=1e-5)
        self.assertEqual(summary["steps"], math.ceil(1e-4 / summary["time_step"]))


if __name__ == "__main__":
    unittest.main()
