"""Frequencies of plates and of a membrane, of shells with lumped mass: the plates FV12, FV13, FV16,
FV21 and the tapered membrane FV32 of NAFEMS.

E = 200 GPa, nu = 0.3, rho = 8000 kg/m3. Plates 10 x 10 m; membrane 10 m long, clamped at its 5 m
wide end, 1 m wide at the other. Reference: Ritz series (plates: Kirchhoff, thick: closed form of
Mindlin with kappa = 5/6; membrane: plane stress), independent of finite elements; the NAFEMS values
are within 1 % of them. Simple supports are very stiff springs on the nodes of the edges: deflection
and rotation about the normal of the edge, and for the thick plate the displacements in its plane.
The modes of the membrane are those that take part in x, in y or about z: bending has no part there.
"""
import math
import unittest

import modal_run

FREE = [1.621654, 2.359496, 2.922282, 4.190243, 4.190243, 7.356004, 7.356004, 7.668205]
SUPPORTED = [2.376723, 5.941807, 5.941807, 9.506892, 11.883615, 11.883615]
CANTILEVER = [0.417931, 1.024215, 2.562747, 3.274899, 3.727147, 6.524172]
THICK_SUPPORTED = [45.910802, 109.527926, 109.527926, 168.073474, 204.782067, 204.782067]
MEMBRANE = [44.617467, 130.010860, 162.689336, 245.987579, 379.718441, 391.405761]


def springs(stiffness, in_plane):
    """Simple support of the four edges: deflection, and rotation about the edge's normal."""
    plane = [stiffness if in_plane else 0] * 2
    words = []
    for name, rotations in (("corners", (1, 1, 0)), ("x_edges", (1, 0, 0)), ("y_edges", (0, 1, 0))):
        values = plane + [stiffness] + [stiffness * r for r in rotations]
        words += modal_run.group(name, "grounded_spring", stiffness=",".join(map(str, values)))
    return words


def plate(cells, thickness, supports, **shape):
    words = modal_run.material(200e9, 0.3, 8000) + list(supports)
    words += modal_run.group("plate", "shell", thickness=thickness)
    return modal_run.case("quadrilateral", words, **{"nx": cells, "ny": cells, **shape})


def elastic(result):
    return [frequency for frequency in modal_run.frequencies(result) if frequency > 1e-3]


class Plates(unittest.TestCase):
    def check(self, case, expected, make, modes=20, pick=elastic):
        """Within 2 % on 16 x 16 cells, and closing in from 8 x 8."""
        errors = []
        for result in modal_run.structures(self, [make(8), make(16)], modes):
            found = pick(result)
            errors.append(sum(abs(f / e - 1) for f, e in zip(found, expected)) / len(expected))
        modal_run.assert_close(self, found, expected, 0.02, case)
        self.assertLess(errors[1], errors[0] / 2.5, f"{case}: mean errors {errors}")

    def test_free_plate(self):
        self.check("FV12", FREE, lambda cells: plate(cells, 0.05, ()))

    def test_free_plate_has_six_rigid_body_modes_on_every_number_of_ranks(self):
        lists = []
        for ranks in (1, 2, 3):
            result, = modal_run.structures(self, [plate(8, 0.05, ())], 20, ranks)
            found = modal_run.frequencies(result)
            self.assertLess(found[5], 1e-4)
            self.assertGreater(found[6], 1)
            lists.append(found[6:])
        for other in lists[1:]:
            modal_run.assert_close(self, other, lists[0], 1e-7, "ranks")

    def test_simply_supported_plate(self):
        supports = springs(1e12, in_plane=False)
        self.check("FV13", SUPPORTED, lambda cells: plate(cells, 0.05, supports))

    def test_simply_supported_thick_plate(self):
        supports = springs(1e14, in_plane=True)
        self.check("FV21", THICK_SUPPORTED, lambda cells: plate(cells, 1, supports))

    def test_cantilever_plate(self):
        self.check("FV16", CANTILEVER, lambda cells: plate(cells, 0.05, ("-@_clamp", "x_min")))

    def test_waves_that_a_mesh_carries(self):
        """Modes below the frequency that is told err by 5.5 % at most, one below twice it errs by more."""
        result, = modal_run.structures(self, [plate(16, 0.05, springs(1e12, in_plane=False))], 90)
        carried, found = result["mesh_waves"]["frequency"], elastic(result)
        strip = (200e9 * 0.05**3 / 12 / (1 - 0.3**2) / (8000 * 0.05))**0.5  # (E I / m)^1/2, thin
        self.assertAlmostEqual(carried / (strip * (2 * math.pi / 3.75)**2 / (2 * math.pi)), 1, delta=0.005)
        self.assertEqual(result["mesh_waves"]["group"], "plate")
        exact = sorted(strip * math.pi / 200 * (m * m + n * n) for m in range(1, 15) for n in range(1, 15))
        errors = [(f, abs(f / e - 1)) for f, e in zip(found, exact)]
        self.assertLess(max(error for f, error in errors if f < carried), 0.055)
        self.assertGreater(max(error for f, error in errors if f < 2 * carried), 0.055)

    def test_waves_that_bricks_carry(self):
        """Bricks alone between two free faces bend as a plate does, two layers of them carry shear."""
        material = modal_run.material(30e9, 0.2, 2400)
        bricks = [modal_run.case("box", material + modal_run.group("body", "hex8"), lx=3, ly=3, lz=lz, nx=10, ny=10, nz=nz)
                  for lz, nz in ((0.06, 1), (0.6, 2))]
        thin, thick = (result["mesh_waves"]["frequency"] for result in modal_run.structures(self, bricks))
        strip = (30e9 * 0.06**2 / 12 / (1 - 0.2**2) / 2400)**0.5
        self.assertAlmostEqual(thin / (strip * (2 * math.pi / 1.8)**2 / (2 * math.pi)), 1, delta=0.01)
        self.assertAlmostEqual(thick / ((30e9 / 2.4 / 2400)**0.5 / 1.8), 1, delta=1e-9)

    def test_tapered_membrane(self):
        self.check("FV32", MEMBRANE, lambda cells: plate(
            cells, 0.05, ("-@_clamp", "x_min"), ny=cells // 2, width_0=5, width_1=1),
            modes=110, pick=lambda result: modal_run.moving(result, (0, 1, 5)))


if __name__ == "__main__":
    unittest.main()
