"""-predict_ranks: loads are those that so many ranks have, and the step is that of the model of run/scaling."""
import math
import os
import sys
import tempfile
import unittest

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from parts.benchmark.scaling_model import CostCurve, Messages, Model  # noqa: E402

RUN = [*program.COARSE_PAIR, "-modes", 0, "-end_time", 0.001]
LOADS = ("imbalance", "mean_dofs", "largest_dofs", "largest_elements", "largest_halo_dofs", "largest_messages", "interface_ranks",
         "interface_dofs")


class Prediction(unittest.TestCase):
    def predict(self, ranks, *arguments):
        folder, summary = program.must_run(self, [*RUN, *arguments], ranks)
        return summary

    def test_loads_are_those_of_the_ranks_when_they_are_there(self):
        foreseen = self.predict(1, "-predict_ranks", 2, "-partition", "elements")["prediction"]
        there = self.predict(2, "-predict_ranks", 5)
        now = there["prediction"]["now"]
        self.assertEqual((foreseen["ranks"], now["ranks"], there["prediction"]["ranks"]), (2, 2, 5))
        for name in LOADS:
            self.assertEqual(foreseen[name], now[name], name)
        self.assertEqual(now["imbalance"], there["partition"]["imbalance"])
        self.assertEqual(now["interface_ranks"], there["partition"]["interface_ranks"])
        dofs = sum(structure["dofs"] for structure in there["structures"].values())
        self.assertAlmostEqual(2 * now["mean_dofs"], dofs)
        self.assertGreaterEqual(now["largest_dofs"], now["mean_dofs"])
        self.assertEqual(foreseen["now"]["largest_halo_dofs"], 0)

    def test_a_step_is_that_of_the_model_of_run_scaling(self):
        latency, bandwidth = 3e-6, 5e9
        found = self.predict(2, "-predict_ranks", 7, "-latency", latency, "-bandwidth", bandwidth)["prediction"]
        curve = CostCurve([1, 2], [1.0, 1.0])  # a second per dof
        model = Model(curve, curve, Messages([{"bytes": [8], "seconds": [1.0]}], latency, bandwidth))
        part = {"parts": 7, "elements_per_part": {"largest": found["largest_elements"]}, "dofs": 1, "elements": 1,
                "messages": {"largest": found["largest_messages"]}, "sent": {"largest": found["largest_halo_dofs"]},
                "received": {"largest": 0}, "contact_members": found["interface_ranks"], "contact_rows": 0,
                "contact_dofs_per_part": {"mean": found["interface_dofs"] / 7}}
        known = model.predict(part)
        self.assertGreater(found["largest_messages"], 0)
        self.assertGreater(found["interface_ranks"], 1)
        self.assertAlmostEqual(found["halo"] / known["halo"], 1, delta=1e-12)
        self.assertAlmostEqual(found["contact"] / known["gather"], 1, delta=1e-12)
        self.assertAlmostEqual(found["step"], found["elements"] + found["halo"] + found["contact"], delta=1e-15)
        self.assertLess(found["elements"], found["measured_step"])
        self.assertAlmostEqual(found["efficiency"], found["measured_step"] * 2 / (7 * found["step"]), delta=1e-12)
        self.assertGreater(found["memory_of_a_rank"], 1e7)
        self.assertGreater(found["start_up_memory_of_rank_0"], 1e7)

    def test_a_dry_run_prints_it(self):
        for ranks in (1, 2):
            result = program.must_end(self, [*RUN, "-dry_run", "-predict_ranks", 16], ranks)
            table = result.stdout.partition("foreseen, by latency 2e-06 s, bandwidth 1e+10 B/s")[2].splitlines()
            self.assertEqual(table[1].split()[-2:], [str(ranks), "16"])
            step = next(line for line in table if line.startswith("  step [microseconds]")).split()
            self.assertTrue(all(math.isfinite(float(number)) and float(number) > 0 for number in step[-2:]))

    def test_reduced_structures_stay_whole(self):
        reduced = ["-s1_model", "modal", "-s1_modal_vectors", 5, "-s2_model", "modal", "-s2_modal_vectors", 5]
        found = self.predict(2, *reduced, "-predict_ranks", 8)["prediction"]
        self.assertEqual((found["largest_elements"], found["largest_messages"], found["interface_ranks"]), (0, 0, 2))
        self.assertEqual(found["elements"], found["measured_step"])

    def test_it_needs_the_whole_meshes_of_one_run(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            program.must_refuse(self, [*RUN, "-predict_ranks", 4, "-mesh_pieces", folder], "-predict_ranks", "whole meshes")
        program.must_refuse(self, [*RUN, "-predict_ranks", 4, "-ensemble", "members.csv"], "-predict_ranks", "one run")
        program.must_refuse(self, [*RUN, "-predict_ranks", 4, "-latency", 0], "-latency", "> 0")


if __name__ == "__main__":
    unittest.main()
