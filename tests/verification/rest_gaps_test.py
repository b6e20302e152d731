"""The joint under gravity: a gap given is that of the rest, whatever the weight makes of the unloaded one.

A bar hangs above a standing one, both of bricks without Poisson effect: the joint between them closes under the weight
by rho g (L^2 - l^2) / (2 E), and opens by as much where gravity points up. A given gap of the rest makes the unloaded
one wider, or narrower, by that; everything that is said of the joint is said of the rest.
"""
import os
import re
import tempfile
import unittest

import program
from decks import clock, contacts, material, probes
from recorded import Recorded

GRAVITY, YOUNG, DENSITY = 9.81, 30e9, 2400.0
HUNG, STANDING, SIDE = 5.0, 2.0, 0.5
SETTLED = DENSITY * GRAVITY * (HUNG**2 - STANDING**2) / (2 * YOUNG)  # by which the joint closes: 8.24 um
GAP = 5e-6
MODAL = [word for name in ("over", "under") for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 3)]


def scene(*more, gap=GAP, step=5e-5, steps=20):
    words = ["-structures", "over,under", *contacts(joint=("over:z_min", "under:z_max", gap)), "-gravity", GRAVITY,
             "-preload", "static", *clock(step, repr(steps * step)), *probes(foot="over:z_min"),
             *material("concrete", YOUNG, 0, DENSITY)]
    for name, start, length, clamp in (("over", 0, HUNG, "z_max"), ("under", -STANDING, STANDING, "z_min")):
        words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_mesh_set", f"lx={SIDE},ly={SIDE},lz={length},"
                  f"z0={start},nz=4", f"-{name}_clamp", clamp, f"-{name}_body_element", "hex8",
                  f"-{name}_body_material", "concrete"]
    return [*words, *more]


UPWARDS = [word for name in ("over", "under") for word in (f"-{name}_gravity", f"0,0,{GRAVITY}")]


class GivenGap(unittest.TestCase):
    def check(self, run, rest, unloaded, tolerance=1e-9):
        joint = run.summary["contacts"]["joint"]
        for side in (0, 1):
            self.assertAlmostEqual(joint["initial_gap"][side] / rest[side], 1, delta=tolerance)
            self.assertAlmostEqual(joint["unloaded_gap"][side] / unloaded[side], 1, delta=tolerance)
        self.assertLess(abs(run.gap("joint") / rest[0] - 1).max(), tolerance)
        self.assertEqual(run.summary["impacts"]["episodes"], 0)

    def test_is_that_of_the_rest(self):
        for ranks, more, settled in ((1, [], SETTLED), (2, [], SETTLED), (3, UPWARDS, -SETTLED), (2, MODAL, SETTLED),
                                     (2, ["-over_damping_uniform", 0.05], SETTLED)):
            with self.subTest(ranks=ranks, more=more):
                gap = GAP if settled > 0 else 4 * GAP
                run = Recorded(self, scene(*more, gap=gap), ranks)
                self.check(run, [gap] * 2, [gap + settled] * 2, 1e-6 if more == MODAL else 1e-9)
                self.assertEqual(run.summary["equilibrium"]["contacts"]["joint"], {"points": 0, "force": 0})

    def test_row_by_row(self):
        run = Recorded(self, scene(gap=f"{GAP!r},{3 * GAP!r}"))
        self.check(run, [GAP, 3 * GAP], [GAP + SETTLED, 3 * GAP + SETTLED])

    def test_unloaded_where_it_is_told_or_no_number(self):
        wide = 2 * SETTLED
        told = Recorded(self, scene("-joint_gap_at", "unloaded", gap=repr(wide)))
        self.check(told, [wide - SETTLED] * 2, [wide] * 2)
        apart = ["-under_mesh_set", f"lx={SIDE},ly={SIDE},lz={STANDING},z0={-STANDING - wide!r},nz=4"]
        meshed = Recorded(self, scene(*apart, gap="geometry"))
        self.check(meshed, [wide - SETTLED] * 2, [wide] * 2, 1e-6)
        rest = Recorded(self, scene(*apart, "-joint_gap_at", "rest", gap="geometry"))
        self.check(rest, [wide] * 2, [wide + SETTLED] * 2, 1e-6)
        # what the weight closes carries: the joint is too narrow for both to hang free
        closed = Recorded(self, scene("-joint_gap_at", "unloaded"))
        self.assertEqual(closed.summary["equilibrium"]["contacts"]["joint"]["points"], 4)
        self.assertGreater(closed.summary["equilibrium"]["contacts"]["joint"]["force"], 1)

    def test_said_of_every_contact_and_once_where_it_is_assumed(self):
        dry = program.must_end(self, scene("-dry_run"))
        rest, unloaded = re.search(r"gap at rest ([\d.e-]+) to [\d.e-]+ mm, unloaded ([\d.e-]+) to", dry.stdout).groups()
        self.assertAlmostEqual(float(rest) / (1e3 * GAP), 1, delta=1e-3)
        self.assertAlmostEqual(float(unloaded) / (1e3 * (GAP + SETTLED)), 1, delta=1e-3)
        self.assertEqual(dry.stdout.count("-joint_gap_at rest or unloaded tells which"), 1)
        for more in (["-joint_gap_at", "rest"], ["-preload", "none", "-gravity", 0], ["-joint_gap_at", "unloaded"]):
            self.assertNotIn("tells which", program.run(scene("-dry_run", *more)).stdout)

    def test_refused_and_doubted(self):
        program.must_refuse(self, scene("-joint_gap_at", "rest", gap="0.001,-0.001"), "-joint_gap_at", "0 or more")
        for gap in ("0.04,0", "0.04,-0.01"):
            program.must_refuse(self, scene(gap=gap), "-joint_gap " + gap, "open in one part", "-joint_gap_at rest or unloaded")
        program.must_run(self, scene("-joint_gap_at", "unloaded", gap="0.04,0"))
        program.must_refuse(self, scene("-joint_gap_at", "sometimes"), "-joint_gap_at", "auto")
        filler = ["-joint_filler", "0.2:1e5,0.8:1e6", "-joint_filler_unloading", 1e8]
        program.must_refuse(self, scene("-joint_gap_at", "unloaded", *filler, gap=0.01), "-joint_gap_at", "filler")
        program.must_refuse(self, scene("-over_clamp", "none", "-over_allow_loose", "true"), "finds no rest", "open at rest",
                            "_gap_at unloaded")
        narrow = Recorded(self, scene(*UPWARDS))
        self.assertEqual(len([line for line in narrow.summary["warnings"] if "opens the joint by more" in line]), 1)

    def test_continued_as_it_was(self):
        more = ["-over_initial_velocity", "0,0,-0.005", "-over_damping_uniform", 0.05]
        whole = Recorded(self, scene(*more, steps=200))
        folder = tempfile.mkdtemp()
        first = program.must_end(self, [*scene(*more, steps=200), "-checkpoint_steps", 100, "-output", folder])
        again = Recorded(self, scene(*more, "-restart", os.path.join(folder, "checkpoint.h5"), steps=200))
        self.assertGreater(whole.summary["impacts"]["episodes"], 0)
        self.assertEqual(whole.summary["impacts"], again.summary["impacts"])
        self.assertEqual(whole.summary["contacts"], again.summary["contacts"])

    def test_a_filler_and_the_faces_behind_it_count_from_one_rest(self):
        """Pressed by a velocity that closes the joint, first the filler, then the faces at its dense strain."""
        gap, dense = 1e-3, 0.5
        run = Recorded(self, scene("-joint_filler", f"{dense}:1e4", "-joint_filler_unloading", 1e8,
                                   "-over_initial_velocity", "0,0,-1", gap=gap, steps=40))
        joint = run.summary["contacts"]["joint"]
        self.assertAlmostEqual(joint["initial_gap"][0] / gap, 1, delta=1e-9)
        self.assertAlmostEqual(joint["unloaded_gap"][0] / (gap + SETTLED), 1, delta=1e-9)
        self.assertAlmostEqual(run.gap("joint")[0] / ((1 - dense) * gap), 1, delta=1e-9)


class Margin(unittest.TestCase):
    """A motion that is stronger by the factor told closes the joint, one that is weaker does not."""

    def test_closing_factor_is_the_one_that_closes(self):
        def moved(speed, *more):
            return Recorded(self, scene("-over_initial_velocity", f"0,0,{-speed!r}", *more, steps=150, gap="2e-5,4e-5"), 2)
        one = moved(1e-3)
        joint = one.summary["contacts"]["joint"]
        self.assertEqual(one.summary["impacts"]["episodes"], 0)
        factor = joint["closing_factor"]
        self.assertGreater(factor, 1.1)
        self.assertLess(factor, 100)
        self.assertAlmostEqual(joint["largest_closing"] * factor / 2e-5, 1, delta=1e-9)
        self.assertEqual(moved(0.99e-3 * factor).summary["impacts"]["episodes"], 0)
        self.assertGreater(moved(1.01e-3 * factor).summary["impacts"]["episodes"], 0)

    def test_a_joint_that_is_closed_at_the_start_has_none(self):
        """One end of the joint carries at rest, where round-off opens and closes it."""
        for ranks in (1, 2):
            run = Recorded(self, scene("-joint_gap_at", "unloaded", gap="0,4e-5"), ranks)
            self.assertGreater(run.summary["equilibrium"]["contacts"]["joint"]["force"], 0)
            self.assertEqual(run.summary["contacts"]["joint"]["closing_factor"], 0)

    def test_says_that_loads_are_scaled_as_well(self):
        """A load that sets in with the run is not in the rest; one that is constant is, unless the run starts without it."""
        def told(*more):
            push = ["-loads", "push", "-push_on", "over:z_min", "-push_force", "0,0,-1", "-over_initial_velocity", "0,0,-1e-3"]
            run = Recorded(self, scene(*push, *more, steps=150, gap=4e-5), identity=1)
            joint = run.summary["contacts"]["joint"]
            self.assertGreater(joint["closing_factor"], 1.1)
            doubts = [line for line in run.summary["warnings"] if line.startswith("closing factors are of")]
            self.assertEqual(len(doubts), joint["closing_factor_scales"] != "motion")
            return joint["closing_factor_scales"]
        self.assertEqual(told(), "motion")
        self.assertEqual(told("-push_function", "ramp", "-push_rise", 1e-3), "motion and loads")
        self.assertEqual(told("-preload", "none", "-joint_gap_at", "rest"), "motion and loads and weight")


class Sliding(unittest.TestCase):
    """Pairs that are found anew: nodes that face nothing yet are open, and gaps count from the rest."""

    def test_a_block_longer_than_what_it_rests_on(self):
        words = scene("-over_clamp", "none", "-over_allow_loose", "true", "-joint_sliding", 0.3, gap=0)
        words += ["-over_mesh_set", "lx=1.2,ly=1,lz=1,z0=0,nx=3,nz=2", "-under_mesh_set", f"ly=1,lz={STANDING},z0={-STANDING}"]
        for ranks in (1, 2):
            run = Recorded(self, words, ranks)
            weight = DENSITY * GRAVITY * 1.2
            self.assertAlmostEqual(run.summary["equilibrium"]["contacts"]["joint"]["force"] / weight, 1, delta=1e-9)
            self.assertLess(abs(run.force("joint")[1:] / weight - 1).max(), 1e-9)

    def test_the_gap_of_the_rest(self):
        run = Recorded(self, scene("-joint_sliding", 0.1))
        self.assertLess(abs(run.gap("joint") / GAP - 1).max(), 1e-9)


class Looks(unittest.TestCase):
    """Gaps beside uniform damping about a rest: looked at more rarely they change no bit, and no impact is missed."""

    def test_no_contact_is_missed_between_two_looks(self):
        for more in ([], MODAL):
            runs = []
            for interval in (5e-5, 1):
                words = scene("-over_damping_uniform", 0.05, "-under_damping_uniform", 0.02, "-over_initial_velocity",
                              "0,0,-0.08", "-gap_interval", interval, "-energy_interval", 10, *more, gap=4e-5, steps=400)
                runs.append(Recorded(self, words))
            often, rarely = runs
            self.assertGreater(often.summary["impacts"]["episodes"], 0)
            self.assertEqual(often.summary["impacts"], rarely.summary["impacts"])
            self.assertTrue((often.displacement("foot.z") == rarely.displacement("foot.z")).all())
            self.assertLess(rarely.summary["interface_looks"], often.summary["interface_looks"])


class Overlap(unittest.TestCase):
    """Bodies that overlap are held where they are: the weight goes through the contact, nothing is pushed out."""

    def test_is_not_pushed_out(self):
        overlap = 5e-4
        run = Recorded(self, scene("-over_clamp", "none", "-over_allow_loose", "true", gap=-overlap), 2)
        weight = DENSITY * GRAVITY * SIDE**2 * HUNG
        self.assertAlmostEqual(run.summary["equilibrium"]["contacts"]["joint"]["force"] / weight, 1, delta=1e-9)
        self.assertAlmostEqual(run.gap("joint")[0] / -overlap, 1, delta=1e-9)
        self.assertLess(abs(run.force("joint")[1:] / weight - 1).max(), 1e-9)
        apart = Recorded(self, scene(*UPWARDS, gap=-overlap / 100), 2)
        self.assertEqual(apart.summary["equilibrium"]["contacts"]["joint"]["force"], 0)


if __name__ == "__main__":
    unittest.main()
