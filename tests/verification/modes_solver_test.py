"""Modes without a factorisation (-modes_solver iterative): those of the factorisation, on solids and thin
shells, clamped, free, on stiff springs, with a rigid end and with scaled mass, on any number of ranks.
"""
import unittest

import modal_run
import program
from plate_modes_test import plate, springs
from solid_modes_test import box, cantilever

CASES = {
    "clamped bricks": cantilever((10, 1, 1), "hex8"),
    "free bricks": box((3, 2.5, 0.22), (6, 5, 1), "hex8"),
    "free thin plate": plate(4, 0.05, ()),
    "thin plate on springs": plate(4, 0.05, springs(1e10, True)),
    "rigid end": box((5, 0.5, 0.3), (10, 1, 1), "hex8", "-@_rigid", "x_max", "-@_clamp", "x_min"),
    "scaled mass": box((5, 0.5, 0.3), (10, 1, 1), "hex8", "-@_clamp", "x_min", "-@_mass_scaling", 1e-4),
}


def find(test, solver, ranks):
    cases = [[*words, "-modes_solver", solver, "-time_step", 1e-7] for words in CASES.values()]
    return modal_run.structures(test, cases, 10, ranks)


class WithoutAFactor(unittest.TestCase):
    def test_modes_are_those_of_the_factorisation_on_one_two_and_three_ranks(self):
        expected = find(self, "direct", 2)
        for ranks in (1, 2, 3):
            for name, direct, found in zip(CASES, expected, find(self, "iterative", ranks)):
                self.assertNotIn("modes_by", direct)
                self.assertIn("generalised Davidson", found["modes_by"], name)
                for one, other in zip(direct["frequencies"], found["frequencies"]):
                    close = 1e-7 * one["frequency"] if one["frequency"] > 0.01 else 0.01  # a motion without strain
                    self.assertAlmostEqual(one["frequency"], other["frequency"], delta=close, msg=(name, ranks))

    def test_refusals(self):
        scene = [*program.COARSE_PAIR, "-modes_solver", "iterative", "-dry_run"]
        program.must_refuse(self, [*scene, "-lowest_eps_max_it", 1], "modes converged", "-lowest_eps_max_it")
        program.must_refuse(self, [*program.COARSE_PAIR, "-modes_solver", "cg"], "-modes_solver", "auto direct iterative")


if __name__ == "__main__":
    unittest.main()
