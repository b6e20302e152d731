"""Force over elongation of recorded links: the area of a loop is the energy that the ledger says it took.

A mass on a spring that yields, on a brace, on a dashpot, at full order and in modes, and a block on the filler of a
joint; the reference is the ledger of the same run and the displacement of the same mass.
"""
import os
import shutil
import tempfile
import unittest

import h5py
import numpy

import program
from filler_test import dropped
from nonlinear_springs_test import STIFFNESS, mass, spring
from recorded import assert_continues

STEP = 2e-4
YIELD = ["-chain_initial_velocity", "1,0.5,0",
         *spring(f"{STIFFNESS},{STIFFNESS},0", yield_force="1000,1000,0", hardening=0.1, yield_circle="x+y",
                 dashpot="300,0,0")]
BRACE = ["-chain_clamp", "ground", "-chain_link1_element", "bar", "-chain_link1_area", 1e-3,
         "-chain_link1_material", "steel", "-material_steel_young", STIFFNESS / 1e-3, "-material_steel_poisson", 0.3,
         "-material_steel_density", 1e-6, "-chain_link1_yield_force", 1000, "-chain_initial_velocity", "1,0,0"]


class Loops:
    """Recorded links of a run, with the ledger line by line."""

    def __init__(self, test, words, ranks=program.RANKS):
        folder, self.summary = program.must_run(test, [*words, "-modes", 0, "-spectra_frequencies", 10], ranks)
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            self.names = [name.decode() for name in file["links"]]
            self.elongation, self.force = file["link_elongation"][()], file["link_force"][()]
            self.units = [file[name].attrs["unit"] for name in ("link_elongation", "link_force")]
            self.displacement = file["displacement"][()]
        self.energy = {name: numpy.array(values, dtype=float)
                       for name, values in program.read_csv(os.path.join(folder, "energy.csv")).items()}
        shutil.rmtree(folder)

    def taken(self):
        """Trapezoids under the loops of all links together until half a step after each sample but the last."""
        change = numpy.diff(self.elongation, axis=0)
        under = numpy.cumsum(((self.force[1:] + self.force[:-1]) / 2 * change).sum(axis=1))
        first = (self.force[0] * change[0]).sum() / 2  # the ledger begins half a step later
        return under - first - (self.force[1:] * change).sum(axis=1) / 2  # the force after it has not acted yet

    def ledger(self):
        """Energy that links hold and have lost, where nothing else holds or loses any."""
        return self.energy["strain"] + self.energy["device_work"] + self.energy["plastic_loss"]


def check_area(test, run, tolerance=1e-12):
    area, ledger = run.taken(), run.ledger()
    count = min(len(area), len(ledger)) - 1
    test.assertGreater(count, 100)
    test.assertLess(abs(area[:count] - ledger[:count]).max(), tolerance * ledger.max())


class Area(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.yielding = Loops(cls(), cls().words(*YIELD, "-loops", "chain:support"))

    def words(self, *more, links=0):
        return mass(STEP, 0.3, "-energy_interval", 1, *more, links=links)

    def test_spring_and_dashpot(self):
        run = self.yielding
        self.assertEqual([name.partition(".")[0] for name in run.names], ["chain:support"] * 3)
        self.assertEqual([name.split(".", 2)[2] for name in run.names], ["x", "x.dashpot", "y"])
        check_area(self, run)
        for k, d in enumerate((0, 0, 1)):
            self.assertTrue(numpy.array_equal(run.elongation[:, k], run.displacement[:, d]))
        loops = run.summary["loops"]["chain:support"]
        self.assertEqual(loops["links"], 3)
        self.assertEqual(loops["yielded"], [run.names[0], run.names[2]])
        self.assertEqual(loops["largest_elongation"], abs(run.elongation).max())
        self.assertAlmostEqual(loops["largest_force"] / abs(run.force).max(), 1, delta=1e-12)
        self.assertAlmostEqual(loops["energy_taken"] / run.ledger()[-1], 1, delta=1e-2)
        # On the circle of 1 kN, but for the tenth of the stiffness that stays.
        q = run.force[:, [0, 2]] - 0.1 * STIFFNESS * run.elongation[:, [0, 2]]
        self.assertAlmostEqual(numpy.hypot(*q.T).max() / 900, 1, delta=1e-12)

    def test_brace(self):
        run = Loops(self, self.words(*BRACE, "-loops", "chain:link1", links=1))
        self.assertEqual([name.split(".", 2)[2] for name in run.names], ["axial"])
        check_area(self, run)
        self.assertAlmostEqual(abs(run.force).max() / 1000, 1, delta=1e-12)

    def test_in_modes(self):
        full = self.yielding
        reduced = Loops(self, self.words(*YIELD, "-loops", "chain:support", "-chain_model", "modal",
                                         "-chain_modal_vectors", 6))
        self.assertEqual(full.names, reduced.names)
        for name in ("elongation", "force"):
            whole = getattr(full, name)
            self.assertLess(abs(getattr(reduced, name) - whole).max(), 1e-9 * abs(whole).max())
        self.assertEqual(full.summary["loops"]["chain:support"]["yielded"],
                         reduced.summary["loops"]["chain:support"]["yielded"])

    def test_filler(self):
        run = Loops(self, [*dropped(1.0, 0.1, step=1e-4), "-loops", "joint"])
        self.assertEqual(run.names, [f"joint.{i}" for i in (1, 2, 3, 4)])
        # Gravity pushes the block as well, but holds no energy.
        check_area(self, run)
        self.assertEqual(len(run.summary["loops"]["joint"]["yielded"]), 4)
        self.assertEqual(run.summary["loops"]["joint"]["largest_elongation"], run.elongation.max())

    def test_nearest_element(self):
        words = [*mass(STEP, 0.01, links=3), "-chain_clamp", "ground", "-chain_initial_velocity", "1,0,0"]
        for link in ("link1", "link2"):
            words += [f"-chain_{link}_element", "spring", f"-chain_{link}_stiffness", "1e4,0,0",
                      f"-chain_{link}_dashpot", "10,0,0"]
        both = Loops(self, [*words, "-loops", "chain:link1,chain:link2"])
        self.assertEqual(len(both.names), 2)
        near = Loops(self, [*words, "-loops", "chain:link2", "-loops_at", "0,0,0; 5,0,0"])
        self.assertEqual(near.names, both.names[1:])
        self.assertTrue(numpy.array_equal(near.force[:, 0], both.force[:, 1]))

    def test_recording_changes_no_bit(self):
        folder, _ = program.must_run(self, [*self.words(*YIELD), "-modes", 0, "-spectra_frequencies", 10])
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            self.assertNotIn("links", file)
            self.assertTrue(numpy.array_equal(file["displacement"][()], self.yielding.displacement))
        shutil.rmtree(folder)

    def test_continued(self):
        words = [*self.words(*YIELD, "-loops", "chain:support"), "-modes", 0, "-spectra_frequencies", 10]
        whole, continued = assert_continues(self, words, 0.1, 333, 2)
        self.assertEqual(continued["loops"], whole["loops"])

    def test_refused(self):
        words = self.words(*YIELD)
        for loops, *parts in (("chain", "neither structure:group nor a contact"), ("other:support", "no structure"),
                              ("chain:first", "yields"), ("chain:nothing", "yields")):
            program.must_refuse(self, [*words, "-loops", loops], "-loops", *parts)
        program.must_refuse(self, [*words, "-loops", "chain:support", "-loops_at", "1,2"], "-loops_at", "not a point")


class Moat(unittest.TestCase):
    def test_worked_scene(self):
        """The isolated frame of the plant until it has struck one wall of its moat, and the figure of its loops; with scaled
        mass, which strikes at the same time in a sixth of the steps."""
        with tempfile.TemporaryDirectory() as folder:
            result = program.run(["-options_file", "petsc-options/plant/moat.yaml", "-end_time", 6, "-modes", 0, "-loops_at",
                                  "0,6.096,0; 9.144,12.192,0", "-frame_mass_scaling", 3e-4,
                                  "-time_step", 2.5e-4, "-output", folder])
            self.assertEqual(result.returncode, 0, result.stderr)
            summary = program.summary(folder)
            self.assertLess(summary["energy"]["relative_residual"], 1e-12)
            self.assertGreaterEqual(summary["impacts"]["episodes"], 1)
            loops = summary["loops"]["frame:soil"]
            self.assertEqual([name.split(".", 2)[2] for name in loops["yielded"]], ["x", "y", "x", "y"])
            with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
                names = [name.decode() for name in file["links"]]
                elongation, force = file["link_elongation"][()], file["link_force"][()]
            along = [k for k, name in enumerate(names) if name.endswith(".x")]
            # The mat bends by millimetres between the wall and an isolator.
            self.assertLess(abs(elongation[:, along]).max(), 0.105)
            self.assertGreater(abs(elongation[:, along]).max(), 0.095)
            # The yielded branch: 19.8 kN of the lead and the rubber's 4e5 N/m, along and across together.
            across = [k for k, name in enumerate(names) if name.endswith(".y")]
            q = [force[:, k] - 4e5 * elongation[:, k] for k in (along[0], across[0])]
            self.assertAlmostEqual(numpy.hypot(*q).max() / 19.8e3, 1, delta=1e-9)
            drawn = program.command("plot", folder)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            self.assertGreater(os.path.getsize(os.path.join(folder, "loops.png")), 20000)


ON_RANKS = {"loops of a spring that yields": [*Area().words(*YIELD), "-loops", "chain:support"],
            "loops of a filler": [*dropped(1.0, 0.1, step=1e-4), "-loops", "joint"]}


if __name__ == "__main__":
    unittest.main()
