"""Supports that take some components only: planes of symmetry, guides, pins.

Two decks on columns that pound, both and their motion symmetric about y = 0, against their halves
y >= 0 on that plane. A rod between smooth walls: with n cells of length h and
c^2 = E (1 - nu) / ((1 + nu) (1 - 2 nu) density), omega_k = 2 c / h sin((2 k - 1) pi / (4 n)).
A slender beam on two pins: omega_k = (k pi / L)^2 (E I / (density A))^(1/2).
"""
import math
import unittest

import program
from decks import box_of, contacts, material, probes, section
from recorded import Recorded, assert_follows, write_sine

AREA, INERTIA = 40e-4, 1500e-8


class HalvesOfSymmetricDecks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shaking = write_sine(3.0, 7.0, 0.3)

    def decks(self, whole, ranks=1, slab=0, more=()):
        words = ["-structures", "left,right", *contacts(joint=("left:face", "right:face", 0.002)), "-end_time", 0.1,
                 "-output_interval", 1e-4, "-motion_x_record", self.shaking, "-motion_z_record", self.shaking,
                 "-motion_x_unit", "m/s2", "-motion_z_unit", "m/s2",
                 *probes(one="left@1.2,0.75,1.5", two="right@2.1,0,1.5"), *material("concrete", 30e9, 0.2, 2400),
                 *material("steel", 200e9, 0.3, 7800), *section("profile", AREA, 600e-8, INERTIA, 12e-8, "1,0,0.2"),
                 "-left_initial_velocity", "0.3,0,0"]
        for name, x0, length, end in (("left", 0, 1.2, 1), ("right", 1.2, 0.9, 0)):
            words += [f"-{name}_mesh", "tests/meshes/deck.geo", f"-{name}_mesh_set",
                      f"whole={int(whole)},slab={slab},x0={x0},length={length},face_at_end={end}",
                      f"-{name}_clamp", "base" if whole else "base,plane:y+rx+rz",
                      f"-{name}_damping_alpha", 0.2, f"-{name}_damping_beta", 2e-5,
                      f"-{name}_body_element", "shell" if slab else "hex8", f"-{name}_body_material", "concrete"]
            words += [f"-{name}_body_thickness", 0.2] if slab else []
            for group in ("column", "beam"):
                words += [f"-{name}_{group}_element", "beam", f"-{name}_{group}_material", "steel",
                          f"-{name}_{group}_section", "profile"]
        return Recorded(self, words + list(more), ranks)

    def same(self, half, whole, tolerance, label):
        for probe, directions in (("one", "xyz"), ("two", "xz")):
            for direction in directions:
                channel = f"{probe}.{direction}"
                assert_follows(self, half.displacement(channel), whole.displacement(channel), tolerance,
                               (label, channel))
                assert_follows(self, half.velocity(channel), whole.velocity(channel), 10 * tolerance,
                               (label, channel))
        self.assertEqual(abs(half.displacement("two.y")).max(), 0, label)
        assert_follows(self, 2 * half.force("joint"), whole.force("joint"), 100 * tolerance, (label, "force"))
        scale = max(abs(value) for part, value in whole.energy.items() if part != "relative_residual")
        for part, value in whole.energy.items():
            if part != "relative_residual":
                self.assertAlmostEqual(2 * half.energy[part] / scale, value / scale, delta=1e-9, msg=(label, part))

    def half_of(self, whole, ranks, slab=0, more=()):
        """With its time step: what the half cannot do may limit the whole."""
        return self.decks(False, ranks, slab, [*more, "-time_step", repr(whole.time_step)])

    def test_move_as_the_whole_does(self):
        for slab in (0, 1):
            whole = self.decks(True, slab=slab)
            self.assertGreater(len(whole.impacts["start"]), 0)
            for ranks in (1, 2, 3):
                half = self.half_of(whole, ranks, slab)
                self.same(half, whole, 1e-9, (slab, ranks))
                self.assertAlmostEqual(2 * half.summary["structures"]["left"]["mass"],
                                       whole.summary["structures"]["left"]["mass"], delta=1e-9)

    def test_from_a_matrix_with_scaled_mass_and_by_modes(self):
        for more in (["-stiffness", "assembled"], ["-left_mass_scaling", 2e-5, "-right_mass_scaling", 2e-5]):
            whole = self.decks(True, more=more)
            self.same(self.half_of(whole, 2, more=more), whole, 1e-9, more)
        half = self.decks(False, 2)
        modes = [word for name in ("left", "right") for word in (
            f"-{name}_model", "modal", f"-{name}_modal_vectors", half.summary["structures"][name]["dofs"])]
        reduced = self.decks(False, 2, more=[*modes, "-time_step", half.time_step])
        for channel in ("one.x", "one.y", "one.z", "two.x", "two.z"):
            assert_follows(self, reduced.displacement(channel), half.displacement(channel), 1e-8, channel)


class RodsAndBeams(unittest.TestCase):
    def frequencies(self, name, words, ranks):
        folder, summary = program.must_run(self, ["-structures", name, "-end_time", 1e-6, *words], ranks)
        return [mode["frequency"] for mode in summary["structures"][name]["frequencies"]]

    def test_rod_between_smooth_walls(self):
        young, poisson, density, length, cells = 30e9, 0.3, 2400, 2.0, 10
        speed = math.sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson) * density))
        for element in ("hex8", "hex8_full"):
            for ranks in (1, 2, 3):
                found = self.frequencies("rod", ["-modes", 4,
                                                 *box_of("rod", f"lx={length},nx={cells},ly=0.05,lz=0.05,ny=2,nz=2",
                                                         "m", element),
                                                 "-rod_clamp", "x_min,body:y+z",
                                                 *material("m", young, poisson, density)], ranks)
                axial = [speed * cells / length / math.pi * math.sin((2 * k - 1) * math.pi / (4 * cells))
                         for k in range(1, 4)]
                for value in axial:
                    self.assertLess(min(abs(f / value - 1) for f in found), 1e-9, (element, ranks, found))

    def test_beam_on_pins(self):
        young, density, length, cells = 200e9, 7800, 6.0, 48
        for ranks in (1, 2):
            found = self.frequencies("beam", ["-modes", 4, "-beam_mesh", "tests/meshes/line.geo", "-beam_mesh_set",
                                              f"length={length},n={cells}", "-beam_clamp", "x_min:x+y+z+rx,x_max:y+z",
                                              "-beam_line_element", "beam", "-beam_line_material", "m",
                                              "-beam_line_section", "s", *material("m", young, 0.3, density),
                                              *section("s", AREA, INERTIA, INERTIA / 9, 1e-4, "0,0,1")], ranks)
            bending = [math.pi / (2 * length**2) * k**2 * math.sqrt(young * inertia / (density * AREA))
                       for k, inertia in ((1, INERTIA / 9), (2, INERTIA / 9), (1, INERTIA))]
            for value in bending:
                self.assertLess(min(abs(f / value - 1) for f in found), 2e-3, (found, bending))


if __name__ == "__main__":
    unittest.main()
