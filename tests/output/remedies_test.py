"""Remedies that the report offers beside the time step: they give what they promise.

The two-storey pair on a coarse mesh has both causes: stiffness damping, and short stiff pieces of the frames.
"""
import re
import unittest

import program

DAMPING = re.compile(r"Rayleigh damping costs ([\d.]+) times .*\(-(\w+)_damping_uniform ([\d.]+)\) would cost ([\d.]+)")
SCALING = re.compile(r"(\d+) elements of (.+) hold the step: -(\w+)_mass_scaling (\S+) would allow at least ([\d.]+) times it")


class Remedies(unittest.TestCase):
    def dry_run(self, *words, ranks=program.RANKS):
        result = program.must_end(self, program.COARSE_PAIR + ["-dry_run", *words], ranks)
        steps = re.findall(r"stable time step (\S+) s \(bound.*without damping (\S+) s", result.stdout)
        self.assertEqual(len(steps), 2)
        return result.stdout, [(float(stable), float(undamped)) for stable, undamped in steps]

    def test_uniform_damping_costs_what_is_said(self):
        text, steps = self.dry_run()
        offers = DAMPING.findall(text)
        self.assertGreater(len(offers), 0)
        words = [word for _, name, ratio, _ in offers
                 for word in (f"-{name}_damping_alpha", 0, f"-{name}_damping_beta", 0, f"-{name}_damping_uniform", ratio)]
        after, uniform = self.dry_run(*words)
        for cost, name, _, promised in offers:
            (stable, undamped), (longer, _) = steps[name == "s2"], uniform[name == "s2"]
            self.assertAlmostEqual(float(cost), undamped / stable, delta=0.01 * float(cost))
            self.assertAlmostEqual(float(promised), undamped / longer, delta=0.01)
            self.assertGreater(longer, 1.2 * stable)
        self.assertEqual(DAMPING.findall(after), [])

    def test_scaled_mass_allows_what_is_said(self):
        finer = [word for name in ("s1", "s2") for word in (f"-{name}_mesh_set", "cells_x=14,cells_y=10,column_elements=2")]
        for ranks in (1, 2, 3):
            text, steps = self.dry_run(*finer, ranks=ranks)
            offers = SCALING.findall(text)
            self.assertGreater(len(offers), 0)
            words = [word for _, _, name, step, _ in offers for word in (f"-{name}_mass_scaling", step)]
            after, scaled = self.dry_run(*finer, *words, ranks=ranks)
            for count, groups, name, step, gain in offers:
                before, longer = steps[name == "s2"][0], scaled[name == "s2"][0]
                self.assertGreaterEqual(longer / before, 0.98 * float(gain), name)
                self.assertGreater(int(count), 0)
                self.assertIn("joint", groups)
            self.assertEqual(SCALING.findall(after), [])
            self.assertNotIn("not reached", after)

    def test_a_step_that_scaled_mass_does_not_reach_names_what_holds_it(self):
        text, steps = self.dry_run("-s1_rigid", "joint_beam", "-s1_mass_scaling", 1e-4, "-s2_mass_scaling", 1e-5)
        (element, part), = re.findall(r"not reached: (element \d+ of group '\w+' at .*) allows less, its mass is not "
                                      r"scaled; the stable step is (\S+) of the wanted one", text)
        self.assertIn("joint_column", element)
        self.assertAlmostEqual(float(part) * 1e-4 / steps[0][0], 1, delta=1e-3)

    def test_slivers_of_a_shell(self):
        plant = ["-options_file", "petsc-options/plant/small.yaml", "-block_mesh_set", "m=1,pipe=0.3,finer=12",
                 "-dry_run", "-modes", 0]
        text = program.must_end(self, plant).stdout
        (_, groups, name, step, gain), = SCALING.findall(text)
        self.assertEqual((groups, name), ("slabs", "block"))
        stable = re.compile(r"stable time step (\S+) s")
        before = float(stable.findall(text)[0])
        after = program.must_end(self, [*plant, "-block_mass_scaling", step]).stdout
        longer = float(stable.findall(after)[0])
        self.assertGreaterEqual(longer / before, 0.98 * float(gain))
        self.assertGreater(float(gain), 2.5)
        self.assertEqual(SCALING.findall(after), [])


if __name__ == "__main__":
    unittest.main()
