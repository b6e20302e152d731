"""Frequencies of plates and of a membrane, of shells with lumped mass: the plates FV12, FV13, FV16,
FV21 and the tapered membrane FV32 of NAFEMS.

E = 200 GPa, nu = 0.3, rho = 8000 kg/m3. Plates 10 x 10 m; membrane 10 m long, clamped at its 5 m
wide end, 1 m wide at the other. Reference: Ritz series (plates: Kirchhoff, thick: closed form of
Mindlin with kappa = 5/6; membrane: plane stress), independent of finite elements; the NAFEMS values
are within 1 % of them. Simple supports are very stiff springs on the nodes of the edges: deflection
and rotation about the normal of the edge, and for the thick plate the displacements in its plane.
The modes of the membrane are those that take part in x, in y or about z: bending has no part there.
"""
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


class Plates(unittest.TestCase):
    def modes(self, cells, thickness, supports, modes=20, ranks=2, **shape):
        words = modal_run.material(200e9, 0.3, 8000) + list(supports)
        words += modal_run.group("plate", "shell", thickness=thickness)
        return modal_run.structure(self, "quadrilateral", words, modes, ranks,
                                   **{"nx": cells, "ny": cells, **shape})["frequencies"]

    def check(self, case, expected, frequencies):
        """Within 2 % on 16 x 16 cells, and closing in from 8 x 8."""
        errors = []
        for cells in (8, 16):
            found = frequencies(cells)
            if cells == 16:
                modal_run.assert_close(self, found, expected, 0.02, case)
            errors.append(sum(abs(f / e - 1) for f, e in zip(found, expected)) / len(expected))
        self.assertLess(errors[1], errors[0] / 2.5, f"{case}: mean errors {errors}")

    def elastic(self, thickness, supports):
        return lambda cells: [mode["frequency"] for mode in self.modes(cells, thickness, supports)
                              if mode["frequency"] > 1e-3]

    def test_free_plate(self):
        self.check("FV12", FREE, self.elastic(0.05, ()))

    def test_free_plate_has_six_rigid_body_modes_and_its_mass_on_every_rank_count(self):
        lists = []
        for ranks in (1, 2, 3):
            found = [mode["frequency"] for mode in self.modes(8, 0.05, (), ranks=ranks)]
            self.assertLess(found[5], 1e-4)
            self.assertGreater(found[6], 1)
            lists.append(found[6:])
        for other in lists[1:]:
            modal_run.assert_close(self, other, lists[0], 1e-7, "ranks")

    def test_simply_supported_plate(self):
        self.check("FV13", SUPPORTED, self.elastic(0.05, springs(1e12, in_plane=False)))

    def test_simply_supported_thick_plate(self):
        self.check("FV21", THICK_SUPPORTED, self.elastic(1, springs(1e14, in_plane=True)))

    def test_cantilever_plate(self):
        self.check("FV16", CANTILEVER, self.elastic(0.05, ("-b_clamp", "x_min")))

    def test_tapered_membrane(self):
        def in_plane(cells):
            modes = self.modes(cells, 0.05, ("-b_clamp", "x_min"), modes=110, ny=cells // 2,
                               width_0=5, width_1=1)
            masses = [mode["effective_modal_mass"] for mode in modes]
            return [mode["frequency"] for mode, m in zip(modes, masses)
                    if m[0] + m[1] + m[5] > 1e3 * (m[2] + m[3] + m[4])]
        self.check("FV32", MEMBRANE, in_plane)


if __name__ == "__main__":
    unittest.main()
