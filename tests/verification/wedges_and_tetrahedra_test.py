"""Wedges and tetrahedra: first frequency of a cantilever, and a bar that hits a rigid wall.

Cantilever 6 x 0.5 x 1 m without Poisson effect, clamped at z = 0, its first bending f = 7.932 Hz by
Euler and Bernoulli, 0.5 % less by hexahedra, which know shear. Bar of bar_on_wall_test.py: 10 m long,
impedance 30 N s/m, at -10 m/s. A bar of wedges extruded along its axis is the chain of masses that
hexahedra are, so it has their discrete solution (50 elements, half the stable step of the chain). Along
the triangles, and cut into tetrahedra, it comes near it.
"""
import unittest

import modal_run
from decks import clock, contacts, material
from recorded import IDENTITY_OF_A_FLIGHT, Recorded

BEAM = 7.932
# element, mesh, its parameters: first frequency over that of the beam, of 2 x 4 x 24 cells and of twice as many
# along each edge; what was measured, to 1 %
CANTILEVERS = {
    ("hex8", "box", ()): (0.995, 0.995),
    ("wedge6", "prisms", ()): (1.055, 1.011),
    ("hex8", "prisms", ("mixed",)): (1.025, 1.003),
    ("tet4", "prisms", ("tetrahedra",)): (1.466, 1.145)}
# first contact [s], duration [s], impulse [N s], peak force [N], energy lost [J]
CHAIN = {"start": 0.5033333333333334, "duration": 0.6733333333333333, "impulse": 197.98761966225067,
         "peak_force": 325.78125, "energy_lost": 5.0}
ELEMENTS = 50
STEP = 10 / ELEMENTS / 30 / 2


def cantilever(element, mesh, switches, refined):
    words = modal_run.material(30e9, 0, 2400) + modal_run.group("body", element) + ["-@_clamp", "z_min"]
    return modal_run.case(mesh, words, lx=0.5, ly=1, lz=6, nx=2 * refined, ny=4 * refined, nz=24 * refined,
                          **{name: 1 for name in switches})


def bar(element, axis, **mesh):
    sizes = {f"l{axis}": 10, f"n{axis}": ELEMENTS, **mesh}
    pairs = ",".join(f"{name}={value}" for name, value in sizes.items())
    velocity = "-10,0,0" if axis == "x" else "0,0,-10"
    return ["-structures", "bar", "-bar_mesh", "tests/meshes/prisms.geo", "-bar_mesh_set", pairs,
            "-bar_body_element", element, "-bar_body_material", "soft", *material("soft", 900, 0, 1),
            *contacts(stop=(f"bar:{axis}_min", "wall", 5 + 1e-10)), "-bar_initial_velocity", velocity,
            *clock(repr(STEP), 1.9), "-energy_interval", 1, "-probes", "bottom,top", "-bottom_structure", "bar",
            "-bottom_group", f"{axis}_min", "-bottom_average", "true", "-top_structure", "bar",
            "-top_group", f"{axis}_max", "-top_average", "true"]


class Cantilever(unittest.TestCase):
    def test_first_frequency(self):
        for refined in (1, 2):
            found = modal_run.structures(self, [cantilever(*case, refined) for case in CANTILEVERS])
            for (case, ratios), result in zip(CANTILEVERS.items(), found):
                self.assertAlmostEqual(result["mass"] / 7200, 1, delta=1e-12)
                ratio = modal_run.frequencies(result)[0] / BEAM
                self.assertAlmostEqual(ratio / ratios[refined - 1], 1, delta=0.01, msg=str(case))

    def test_one_rank_and_two(self):
        cases = [cantilever(*case, 1) for case in CANTILEVERS]
        one, two = (modal_run.structures(self, cases, ranks=ranks) for ranks in (1, 2))
        for a, b in zip(one, two):
            self.assertAlmostEqual(modal_run.frequencies(a)[0] / modal_run.frequencies(b)[0], 1, delta=1e-8)
            self.assertAlmostEqual(a["omega_max"] / b["omega_max"], 1, delta=1e-8)


class Impact(unittest.TestCase):
    def compare(self, tolerance, element, axis, names=tuple(CHAIN), **mesh):
        """On one rank against the chain; on two ranks against the run on one."""
        one, two = (Recorded(self, bar(element, axis, **mesh), ranks, IDENTITY_OF_A_FLIGHT) for ranks in (1, 2))
        for channel in (f"bottom.{axis}", f"top.{axis}"):
            motion = one.displacement(channel)
            self.assertLessEqual(abs(two.displacement(channel) - motion).max(), 1e-9 * abs(motion).max())
        self.assertEqual(len(one.column("start")), 1)
        for name in names:
            self.assertAlmostEqual(one.column(name)[0] / CHAIN[name], 1, delta=tolerance, msg=name)

    def test_triangles_of_wedges_as_the_face(self):
        self.compare(1e-6, "wedge6", "z")

    def test_quadrangles_of_wedges_as_the_face(self):
        self.compare(1e-3, "wedge6", "x")

    def test_wedges_beside_hexahedra(self):
        self.compare(1e-3, "hex8", "x", mixed=1)

    def test_tetrahedra(self):
        self.compare(1e-3, "tet4", "z", ("start", "duration", "impulse"), tetrahedra=1)


if __name__ == "__main__":
    unittest.main()
