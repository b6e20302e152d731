"""What goes with what: every pair of features is what docs/reference/composition.md tells, and a pair that runs is right.

Without --all a fixed list: each feature with a few others, and every pair that once was wrong."""
import unittest
from concurrent.futures import ThreadPoolExecutor

import program
import table
from cells import PROPERTIES, Cell, Refused, pair
from features import FEATURES

PROCESSORS = 2
TIMEOUT = 7200  # s, with --all
NAMED = {f.name: f for f in FEATURES}
MENDED = [("bar with a rule", "uniform damping"), ("stiffness damping", "reactions"), ("uniform damping", "reactions"),
          ("uniform damping", "storey force"), ("friction pendulum", "wall of shells"), ("friction pendulum", "constant force"),
          ("ensemble", "supports"), ("feet that lift off", "rocking support"), ("lead-rubber bearings", "embedded support")]


def ring(*steps):
    """Each feature with those so many places further on."""
    count = len(FEATURES)
    return {tuple(sorted((i, (i + step) % count))) for step in steps for i in range(count)}


def listed(*steps):
    chosen = ring(*steps) | {tuple(FEATURES.index(NAMED[name]) for name in cell) for cell in MENDED}
    return [cell for k, cell in enumerate(table.CELLS) if program.ALL or (FEATURES.index(cell[0]), FEATURES.index(cell[1])) in chosen]


def faults(cell):
    """Properties that a pair of features has not, with what is wrong; how many it was asked for."""
    spared = {name for one, other in (cell, cell[::-1]) for name in one.spared if one.beside in ("", other.kind)}
    found, asked = {}, 0
    held = Cell(pair(*cell))
    try:
        for name, holds in PROPERTIES.items():
            if name in spared:
                continue
            asked += 1
            try:
                wrong = holds(held)
            except Refused:
                continue  # another cell of the table
            if wrong:
                found[name] = wrong
    finally:
        held.close()
    return found, asked


class Composition(unittest.TestCase):
    def test_the_page_has_every_feature(self):
        self.assertEqual(set(table.told()), {(f.name, g.name) for f, g in table.CELLS})

    def test_cells_are_as_told(self):
        cells = listed(1, 5, 23)
        told, found = table.told(), table.outcomes(cells)
        for names, (sign, reason) in found.items():
            with self.subTest(names):
                self.assertEqual(sign, told[names], reason)
                self.assertNotIn("ended with", reason)

    def test_cells_hold(self):
        told = table.told()
        cells = [cell for cell in listed(7) if told[cell[0].name, cell[1].name] == "+"]
        with ThreadPoolExecutor(program.JOBS) as pool:
            for (first, second), (found, asked) in zip(cells, pool.map(faults, cells)):
                with self.subTest(f"{first.name} with {second.name}"):
                    self.assertEqual(found, {})
                    self.assertGreater(asked, 0)


if __name__ == "__main__":
    unittest.main()
