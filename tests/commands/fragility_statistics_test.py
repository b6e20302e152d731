"""Statistics of pounding.fragility: intervals that hold as often as they say, curves that are found again, samples."""
import functools
import os
import shutil
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import program
from scipy import stats

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.fragility import analysis, figures, outcomes, report, study  # noqa: E402
from pounding.plot import answer  # noqa: E402
from pounding import fragility  # noqa: E402

LEVELS = np.array([1.0, 1.5, 2.0, 3.0, 4.0, 6.0])
THETA, BETA = 2.5, 0.4


def counts(seed, trials):
    chance = stats.norm.cdf(np.log(LEVELS / THETA) / BETA)
    return np.random.default_rng(seed).binomial(trials, chance)


class PartsOfAScatter(unittest.TestCase):
    @staticmethod
    def drawn(seed, count, together=0.0):
        """y = m + 2 j + together m j of independent standard normals, with the own and with the next joint."""
        generator = np.random.default_rng(seed)
        motion, joint = generator.standard_normal((2, count, 1))
        both = [motion + 2 * one + together * motion * one for one in (joint, np.roll(joint, -1, 0))]
        return np.array(both)

    def test_parts_of_a_sum_are_those_of_theory(self):
        own, exchanged = self.drawn(1, 20000)
        found = fragility.scatter(own, exchanged)
        for value, expected in ((found.all, 5**0.5), (found.joint, 2), (found.motion, 1)):
            self.assertLess(abs(value[0] / expected - 1), 0.02)

    def test_what_they_do_together_counts_in_both(self):
        own, exchanged = self.drawn(2, 20000, together=1.5)
        found = fragility.scatter(own, exchanged)
        for value, expected in ((found.all, 7.25**0.5), (found.joint, 6.25**0.5), (found.motion, 3.25**0.5)):
            self.assertLess(abs(value[0] / expected - 1), 0.03)

    def test_small_samples_are_not_biased(self):
        squares = np.mean([[getattr(fragility.scatter(*self.drawn(seed, 6)), name)[0] ** 2
                            for name in ("all", "joint", "motion")] for seed in range(4000)], 0)
        for value, expected in zip(squares, (5, 4, 1)):
            self.assertLess(abs(value / expected - 1), 0.05)

    def test_the_interval_holds_the_share(self):
        held = 0
        for seed in range(200):
            share, low, high = fragility.joint_share(*self.drawn(seed, 35), repeats=200)
            self.assertLessEqual(low, high)
            held += low <= 0.8 <= high
        print(f"intervals of 95 % held the joint's share in {held} of 200 seeds")
        self.assertGreater(held, 176)  # a bootstrap of 35 holds a little less often than it says

    def test_nothing_that_varies_has_no_share(self):
        found = fragility.joint_share(np.ones((5, 2)), np.ones((5, 2)))
        self.assertTrue(all(np.isnan(one) for one in found))


class Curves(unittest.TestCase):
    def held(self, seeds, trials):
        """How often the intervals of theta and of beta hold the truth."""
        fits = [fragility.fit_fragility(LEVELS, counts(seed, trials), np.full(6, trials)) for seed in seeds]
        return (sum(one.theta_interval[0] <= THETA <= one.theta_interval[1] for one in fits),
                sum(one.beta_interval[0] <= BETA <= one.beta_interval[1] for one in fits))

    def test_a_curve_is_found_again_within_its_interval(self):
        theta, beta = self.held(range(100), 35)
        print(f"intervals of 95 % held theta in {theta} and beta in {beta} of 100 seeds")
        self.assertGreaterEqual(theta, 93)
        self.assertGreaterEqual(beta, 93)

    def test_intervals_hold_as_often_as_they_say(self):
        """Of 1,000 seeds within three standard deviations of 950, and of what Wald's approximation may miss."""
        for found in self.held(range(1000, 2000), 100):
            self.assertGreater(found, 925)
            self.assertLess(found, 972)

    def test_the_fit_is_the_largest_likelihood(self):
        hits = counts(3, 35)
        one = fragility.fit_fragility(LEVELS, hits, np.full(6, 35))

        def likelihood(theta, beta):
            return stats.binom.logpmf(hits, 35, stats.norm.cdf(np.log(LEVELS / theta) / beta)).sum()

        best = likelihood(one.theta, one.beta)
        for theta, beta in ((1.001, 1), (0.999, 1), (1, 1.001), (1, 0.999)):
            self.assertLess(likelihood(one.theta * theta, one.beta * beta), best)

    def test_counts_without_a_curve_are_refused_with_the_reason(self):
        trials = np.full(4, 10)
        for hits, words in (([0, 0, 0, 0], "no hit in 40"), ([10, 10, 10, 10], "a hit in each of 40"),
                            ([0, 0, 10, 10], "separated"), ([0, 4, 10, 10], "separated"),
                            ([0, 0, 0, 3], "separated"), ([8, 6, 5, 3], "not become more"),
                            ([5, 5, 5, 5], "not become more")):
            with self.assertRaisesRegex(fragility.FitRefused, words):
                fragility.fit_fragility([1, 2, 3, 4], hits, trials)
        self.assertAlmostEqual(fragility.fit_fragility([1, 2, 3, 4], [0, 3, 9, 10], trials).theta, 2.3, delta=0.1)

    def test_samples_that_go_through_all_levels(self):
        """The bootstrap over samples sees that their trials depend on each other: its interval of theta is wider than
        that for independent trials, and is that of the capacities' mean."""
        generator = np.random.default_rng(5)
        levels = np.array([1, 1.3, 1.6, 2, 2.5, 3, 3.6, 4.4, 5.5])
        capacities = THETA * np.exp(BETA * generator.standard_normal(60))
        hit = capacities[:, None] < levels
        one = fragility.fit_paired(levels, hit)
        naive = fragility.fit_fragility(levels, hit.sum(0), np.full(9, 60))
        self.assertEqual((one.theta, one.beta), (naive.theta, naive.beta))
        width = np.log(one.theta_interval[1] / one.theta_interval[0])
        self.assertAlmostEqual(width, 2 * 1.96 * np.log(capacities).std(ddof=1) / np.sqrt(60), delta=0.2 * width)
        self.assertGreater(width, 1.3 * np.log(naive.theta_interval[1] / naive.theta_interval[0]))
        self.assertEqual(one, fragility.fit_paired(levels, hit))  # the same again
        with self.assertRaisesRegex(fragility.FitRefused, "draws of the samples are separated"):
            fragility.fit_paired([1, 2, 3], [[0, 1, 1]] * 20 + [[1, 1, 1], [0, 0, 0]])

    def test_intervals_of_samples_hold_as_often_as_they_say(self):
        """Of 80 sets of 35 capacities: a fixed seed; quantiles of the draws hold beta in 69 of them."""
        generator, levels, held = np.random.default_rng(3), np.array([1, 1.5, 2, 2.5, 3, 4, 5.5]), np.zeros(2)
        for _ in range(80):
            capacities = THETA * np.exp(BETA * generator.standard_normal(35))
            one = fragility.fit_paired(levels, capacities[:, None] < levels, repeats=50)
            held += [one.theta_interval[0] < THETA < one.theta_interval[1], one.beta_interval[0] < BETA < one.beta_interval[1]]
        self.assertGreaterEqual(held.min(), 73)  # 95 % of 80 are 76, with a deviation of 2


class Counts(unittest.TestCase):
    def test_clopper_and_pearson(self):
        """Ends at which the binomial tails are 2.5 %, and the closed forms of none and of all."""
        low, high = fragility.binomial_interval([0, 7, 20], 20)
        self.assertAlmostEqual(high[0], 1 - 0.025 ** (1 / 20), places=12)
        self.assertAlmostEqual(low[2], 0.025 ** (1 / 20), places=12)
        self.assertEqual((low[0], high[2]), (0, 1))
        self.assertAlmostEqual(stats.binom.sf(6, 20, low[1]), 0.025, places=12)
        self.assertAlmostEqual(stats.binom.cdf(7, 20, high[1]), 0.025, places=12)

    def test_it_holds_at_least_as_often_as_it_says(self):
        for p in (0.02, 0.1, 0.5, 0.93):
            low, high = fragility.binomial_interval(np.arange(36), 35)
            chance = stats.binom.pmf(np.arange(36), 35, p)[(low <= p) & (p <= high)].sum()
            self.assertGreaterEqual(chance, 0.95)


class Spectra(unittest.TestCase):
    def test_moments(self):
        values = np.random.default_rng(1).lognormal(1.0, 0.3, (4000, 2))
        one = fragility.moments(values)
        for found, exact in ((one.median, np.e), (one.low, np.exp(1 - 0.3 * 0.9945)),
                             (one.high, np.exp(1 + 0.3 * 0.9945)), (one.mean, np.exp(1 + 0.045)),
                             (one.cov, np.sqrt(np.expm1(0.09))), (one.log_deviation, 0.3)):
            np.testing.assert_allclose(found, exact, rtol=0.04)
        np.testing.assert_allclose(one.half_width, 1.96 * one.cov / np.sqrt(4000), rtol=1e-3)

    def test_interval_of_the_mean_holds(self):
        held = 0
        for seed in range(1000):
            one = fragility.moments(np.random.default_rng(seed).normal(10, 3, 5))
            held += abs(one.mean - 10) <= one.half_width * one.mean
        self.assertAlmostEqual(held, 950, delta=21)

    def test_members_needed(self):
        """A coefficient of variation of 30 % and a mean within 10 %: 9 members at 68 %, 35 at 95 %."""
        self.assertEqual([int(fragility.members_needed(0.3, 0.1, one)) for one in (0.68, 0.95)], [9, 35])

    def test_widened_as_pounding_spectra_widens(self):
        """A peak stays what it is from f / 1.15 ... to f * 1.15: both ways of shifting by 15 %."""
        frequency = np.geomspace(1, 100, 2001)
        spectrum = 1 + 9 * np.exp(-(np.log(frequency / 10) / 0.01) ** 2)
        broad = fragility.widened(frequency, spectrum)
        flat = (frequency > 10 * 0.86) & (frequency < 10 * 1.14)
        np.testing.assert_allclose(broad[flat], 10, rtol=1e-3)
        np.testing.assert_allclose(broad[(frequency < 8.2) | (frequency > 12)], 1, rtol=1e-4)
        self.assertTrue((broad >= spectrum * (1 - 1e-12)).all())


class Samples(unittest.TestCase):
    VARIABLES = [fragility.Variable("a", "normal", 0.0, 0.002), fragility.Variable("b", "lognormal", 1.0, 0.3),
                 fragility.Variable("c", "uniform", 2.0, 0.5)]

    def test_every_stratum_once_and_the_same_again(self):
        drawn = fragility.latin_hypercube(self.VARIABLES, 50, 7)
        np.testing.assert_array_equal(drawn, fragility.latin_hypercube(self.VARIABLES, 50, 7))
        self.assertFalse((drawn == fragility.latin_hypercube(self.VARIABLES, 50, 8)).any())
        laws = (stats.norm(0, 0.002), stats.lognorm(np.sqrt(np.log1p(0.09))), stats.uniform(2 - 0.5 * 3**0.5, 3**0.5))
        for column, law in zip(drawn.T, laws):
            self.assertEqual(sorted(np.floor(50 * law.cdf(column)).astype(int)), list(range(50)))
        self.assertAlmostEqual(drawn[:, 1].std() / drawn[:, 1].mean(), 0.3, delta=0.03)
        self.assertAlmostEqual(drawn[:, 2].std(), 0.5, delta=0.01)

    def test_independent_signals(self):
        generator = np.random.default_rng(2)
        first, second = generator.standard_normal((2, 4000))
        mixed = 0.3 * first + second
        self.assertAlmostEqual(fragility.correlations([first, mixed])[0, 1], 0.3 / np.sqrt(1.09), delta=0.03)
        self.assertAlmostEqual(fragility.correlations([first, first[:2000]])[0, 1], np.sqrt(0.5), delta=0.03)


class FileOfAnEnsemble(unittest.TestCase):
    def test_members_whose_numbers_are_not_those_written_count_as_not_run(self):
        path, gaps = Path(tempfile.mkdtemp(prefix="pounding-")) / "ensemble.h5", np.array([[0.01], [0.02], [0.03]])
        with h5py.File(path, "w") as file:
            table = file.create_dataset("members/table", data=np.array([[b"1"], [b"2"], [b"3"]]))
            table.attrs["columns"] = "seed"
            file["done"], file["gaps/smallest"] = np.ones(3, "i4"), gaps
            sums = file.create_dataset("members/crc32", data=np.array([zlib.crc32(row.tobytes()) for row in gaps], np.uint32))
            sums.attrs["of"] = "gaps/smallest"
        self.assertEqual(outcomes.read_rows(path), (["seed"], {("1",): 0, ("2",): 1, ("3",): 2}))
        with h5py.File(path, "r+") as file:
            file["gaps/smallest"][1] = 0.021
        self.assertEqual(outcomes.read_rows(path), (["seed"], {("1",): 0, ("3",): 2}))


class OneLevel(unittest.TestCase):
    """A study of one level has a bar for each joint, and words that fit."""

    def setUp(self):
        hits = {0.01: 4, 0.02: 2, None: 0}
        self.study = SimpleNamespace(levels=[4.0], gaps=[0.01, 0.02], samples=4, confidence=0.95, scene=Path("none.yaml"), options={},
                                     joints={"roof": study.Joint((0.001, -0.001))}, is_surveyed=False)
        self.study.joint_named = functools.partial(study.Study.joint_named, self.study)
        self.study.width_title = study.Study.width_title.fget(self.study)
        self.analysis = SimpleNamespace(study=self.study, gaps_of=lambda event: list(hits),
                                        hits=lambda event, gap: np.arange(4)[:, None] < hits[gap])
        self.analysis.probability = functools.partial(analysis.Analysis.probability, self.analysis)

    def test_bars_by_joint(self):
        figure, axes = figures.plt.subplots()
        self.addCleanup(figures.plt.close, figure)
        figures.draw_bars(axes, self.analysis, "contact")
        self.assertEqual([bar.get_height() for bar in axes.patches], [1.0, 0.5, 0.0])
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()], ["10 mm", "20 mm", "apart"])
        low, high = fragility.binomial_interval(2, 4)
        ends = axes.collections[0].get_segments()[1][:, 1]
        np.testing.assert_allclose(ends, [low, high])

    def test_words(self):
        self.assertEqual(report.touching({}, self.analysis), ["Joint of 10 mm: touches in 100 % of the cases at 4 m/s2 (40 to 100).",
                                                              "Joint of 20 mm: touches in 50 % of the cases at 4 m/s2 (6.8 to 93)."])
        self.assertEqual([report.percent(part) for part in (0.0052, 0.74, 0.9949, 1)], ["0.52", "74", "99", "100"])
        self.assertEqual([answer.plural(1, "level"), answer.plural(2, "joint")], ["1 level", "2 joints"])

    def test_the_scene_s_own_joint_is_shown(self):
        folder = Path(tempfile.mkdtemp(prefix="pounding-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "walls.yaml").write_text('roof: {gap: "0.021,0.019"}\n')
        (folder / "scene.yaml").write_text("include: walls.yaml\nroof: {secondary: a}\n")
        self.study.scene = folder / "scene.yaml"
        self.assertEqual(study.own_gap(self.study), 0.02)
        self.study.options = {"roof_gap": "0.5"}
        self.assertIsNone(study.own_gap(self.study))


if __name__ == "__main__":
    unittest.main()
