"""Frequencies of a concrete cantilever and of a free concrete slab, of hexahedra with and without
incompatible modes.

Cantilever 5 x 0.5 x 0.3 m, clamped at x = 0; slab 3.0 x 2.5 x 0.22 m, free (the size of the slabs
that pound). E = 30 GPa, nu = 0.2, rho = 2400 kg/m3, row-sum lumped mass. Reference: frequencies [Hz]
of the same discrete model by an independent code whose element matrices agree with a third one's;
and, for what the mesh converges to, quadratic hexahedra with 20 nodes.
"""
import unittest

import modal_run

CANTILEVER = {  # (cells along x, y, z): {element: lumped frequencies}
    (10, 1, 1): {
        "hex8_full": [10.168079117, 13.658708115, 58.626630755, 61.643810400, 79.936958195,
                      165.438523882, 174.738816081, 177.179951876],
        "hex8": [6.833705540, 11.304723871, 41.908348843, 58.626630755, 66.885334111,
                 114.426587099, 174.120444593, 174.738816081]},
    (20, 2, 1): {
        "hex8_full": [7.924477170, 12.021132451, 48.433703509, 71.983010999, 73.585584896,
                      130.887784555, 177.071239267, 189.402673614],
        "hex8": [6.838126039, 11.359062487, 41.929232131, 68.222138502, 73.534048005,
                 113.829682197, 177.013281712, 180.174831597]},
    (20, 2, 2): {
        "hex8_full": [7.834606820, 11.999733847, 48.180770143, 71.860895807, 82.749711121,
                      131.336832796, 177.070245592, 189.103935792],
        "hex8": [6.853236471, 11.359901626, 42.270662194, 68.226092171, 82.677955979,
                 115.739852129, 177.033708058, 180.185605299]},
    (40, 4, 2): {
        "hex8_full": [7.139076416, 11.530034844, 43.996530172, 69.269629138, 88.263304430,
                      120.155799219, 177.003976377, 182.837766179],
        "hex8": [6.850057840, 11.358889261, 42.250409499, 68.285976097, 88.226092362,
                 115.526697082, 176.982726830, 180.382486866]}}

SLAB = {  # the six lowest elastic modes
    (13, 10, 1): {
        "hex8_full": [66.710927924, 103.277599709, 151.635239680, 163.956898806, 192.677816186,
                      272.768955202],
        "hex8": [66.108874697, 83.778033350, 121.318333886, 152.284359575, 170.193038978,
                 224.637678357]},
    (25, 21, 1): {
        "hex8_full": [66.518042236, 91.511219036, 134.155179860, 158.116879731, 180.220654952,
                      246.450820255],
        "hex8": [66.250956587, 84.724154108, 123.424804634, 153.720383867, 173.084270831,
                 227.428575242]}}

# Bending of the cantilever by quadratic hexahedra: weak, strong, weak, strong, weak.
BENDING = [6.855149, 11.36477, 42.30935, 68.35523, 115.7508]
SLAB_QUADRATIC = [67.08868, 86.9394, 127.738, 158.2553, 179.792, 238.4523]
TOLERANCE = 1e-3


def box(size, cells, element, *words):
    return modal_run.case(
        "box", modal_run.material(**modal_run.CONCRETE) + modal_run.group("body", element) + list(words),
        lx=size[0], ly=size[1], lz=size[2], nx=cells[0], ny=cells[1], nz=cells[2])


def cantilever(cells, element):
    return box((5, 0.5, 0.3), cells, element, "-@_clamp", "x_min")


class Cantilever(unittest.TestCase):
    def test_frequencies(self):
        cases = [(cells, element) for cells in CANTILEVER for element in ("hex8", "hex8_full")]
        results = modal_run.structures(self, [cantilever(*case) for case in cases], modes=8)
        for (cells, element), result in zip(cases, results):
            modal_run.assert_close(self, modal_run.frequencies(result), CANTILEVER[cells][element],
                                   TOLERANCE, f"{element} {cells}")

    def test_incompatible_modes_bend_like_quadratic_elements(self):
        """Within 1.5 % with 20 x 2 x 2 cells, where full integration is 3 to 15 % too stiff."""
        limits = {"hex8": (-0.015, 0), "hex8_full": (0.03, 0.15)}
        results = modal_run.structures(self, [cantilever((20, 2, 2), element) for element in limits], modes=8)
        for (element, (least, most)), result in zip(limits.items(), results):
            bending = [mode["frequency"] for mode in result["frequencies"]
                       if sum(mode["effective_modal_mass"][1:3]) > 1]
            self.assertGreaterEqual(len(bending), 5, element)
            for found, expected in zip(bending, BENDING):
                self.assertTrue(least <= found / expected - 1 <= most, (element, found, expected))

    def test_mass_and_frequencies_on_one_two_and_three_ranks(self):
        expected = CANTILEVER[10, 1, 1]["hex8"]
        for ranks in (1, 2, 3):
            result, = modal_run.structures(self, [cantilever((10, 1, 1), "hex8")], 8, ranks)
            self.assertAlmostEqual(result["mass"], 5 * 0.5 * 0.3 * 2400, delta=1e-9)
            modal_run.assert_close(self, modal_run.frequencies(result), expected, 1e-8, f"{ranks} ranks")


class FreeSlab(unittest.TestCase):
    def test_frequencies(self):
        cases = [(cells, element) for cells in SLAB for element in ("hex8", "hex8_full")]
        results = modal_run.structures(self, [box((3, 2.5, 0.22), *case) for case in cases], modes=12)
        for (cells, element), result in zip(cases, results):
            found = modal_run.frequencies(result)
            self.assertLess(max(found[:6]), 1e-3, "six rigid-body modes")
            modal_run.assert_close(self, found[6:], SLAB[cells][element], TOLERANCE, f"{element} {cells}")
            if element == "hex8":  # the rotary inertia of one layer is three times too large
                modal_run.assert_close(self, found[6:], SLAB_QUADRATIC, 0.06, "quadratic")


if __name__ == "__main__":
    unittest.main()
