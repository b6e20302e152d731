"""-write_modes, and the antisymmetric slab mode near 200 Hz that it shows: upper faces of bricks move
along x, mid-planes of shells do not."""
import os
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts.campaign import slab_mode  # noqa: E402


def modes(test, arguments, ranks):
    """Folder and summary of a few steps with mode shapes."""
    folder, summary = program.must_run(test, [*arguments, "-write_modes", "-end_time", 2e-5], ranks)
    return Path(folder), summary


class Shapes(unittest.TestCase):
    def test_shapes_are_those_of_the_frequencies_on_any_number_of_ranks(self):
        shapes = []
        for ranks in (1, 2):
            folder, summary = modes(self, program.COARSE_PAIR, ranks)
            with h5py.File(folder / "modes.h5", "r") as file:
                for name in ("s1", "s2"):
                    group, structure = file[name], summary["structures"][name]
                    self.assertEqual(group["coordinates"].shape, (structure["nodes"], 3))
                    np.testing.assert_allclose(group["frequencies"][()],
                                               [mode["frequency"] for mode in structure["frequencies"]], rtol=1e-12)
                group = file["s1"]
                coordinates = group["coordinates"][()]
                shapes.append([group[f"shapes/{i:04d}"][()] for i in range(1, 13)])
        clamped = coordinates[:, 2] < 1e-9
        self.assertEqual(clamped.sum(), 4)
        for one, other in zip(*shapes):
            self.assertEqual(one.shape, (len(coordinates), 6))
            self.assertEqual(abs(one[clamped]).max(), 0)
            sign = np.sign((one * other).sum())
            self.assertLess(abs(one - sign * other).max(), 1e-6 * abs(one).max())
        # Sway along x: floors in phase in the first mode; phi^T M phi = 1 with slabs that move alike.
        floors = [shapes[0][0][np.isclose(coordinates[:, 2], z), 0].mean() for z in (2.72, 5.22)]
        self.assertGreater(floors[0] * floors[1], 0)
        self.assertGreater(abs(floors[1]), abs(floors[0]))
        mass = summary["structures"]["s1"]["mass"] / 2
        self.assertAlmostEqual(mass * (floors[0]**2 + floors[1]**2), 1, delta=0.1)

    def test_no_file_unless_asked(self):
        folder, _ = program.must_run(self, [*program.COARSE_PAIR, "-end_time", 2e-5])
        self.assertFalse(os.path.exists(os.path.join(folder, "modes.h5")))


class SlabMode(unittest.TestCase):
    def find(self, scene, model):
        folder, _ = modes(self, ["-options_file", f"petsc-options/azalee/{scene}.yaml", "-modes", 120], 1)
        return slab_mode.find(folder / "modes.h5", model)

    def test_upper_faces_move_along_x_and_mid_planes_do_not(self):
        bricks, shells = self.find("pair", "A"), self.find("pair-b", "B")
        for mode in (bricks, shells):
            self.assertAlmostEqual(mode.frequency, 200, delta=15)
            self.assertEqual(abs(mode.shape).max(), 1)
        self.assertGreater(abs(bricks.at_dots), 0.1)
        self.assertGreater(abs(bricks.at_dots), 3 * abs(bricks.at_middle))
        self.assertLess(abs(shells.at_dots), 0.005)
        self.assertEqual((len(bricks.faces), len(shells.faces)), (4, 2))


if __name__ == "__main__":
    unittest.main()
