"""Rules that accept and refuse motions: each kind on motions made for it, the targets' numbers, spectra and strong parts
beside computations of the test's own, and wrong use."""
import csv
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import scipy.linalg

import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.motion_kinds import KINDS  # noqa: E402
from pounding.motion_rules import MotionError, judge, main, motions_of, read_rules  # noqa: E402
from pounding.motion_signals import G, POWERS, Signal, Target, correlation, mean_around, read_target, response_spectra  # noqa: E402

STEP = 0.01  # [s]
GRID = "0.5:30:60log"
COLUMNS = ("name", "kind", "least", "most", "grid", "target", "pga", "damping", "directions", "from", "to", "window", "smoothing", "of",
           "shift")
RULES = Path(program.SOURCE, "petsc-options", "rules")

SPECTRA = os.path.abspath(os.path.join(program.BUILD, "pounding-spectra"))


def spectra(*words, folder=None):
    return subprocess.run([SPECTRA, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)


def noise(seed, length=25.0, strong=(2.0, 18.0), step=STEP):
    """A signal [m/s2] of random phases, of one strength between two times and a tenth of it outside."""
    time = np.arange(round(length / step) + 1) * step
    envelope = np.where((time > strong[0]) & (time < strong[1]), 1.0, 0.1)
    return Signal(f"noise{seed}", step, envelope * np.random.default_rng(seed).normal(size=len(time)))


def own_spectrum(signal, frequencies, damping, parts=10):
    """Peaks of oscillators from their exponential matrix over tenths of a step, over the motion and one more period."""
    found = []
    for f in frequencies:
        omega, dt = 2 * math.pi * f, signal.step / parts
        rest = int(1.1 / f / signal.step) + 1
        a = np.interp(np.arange((len(signal.values) - 1 + rest) * parts + 1) / parts, np.arange(len(signal.values) + 1),
                      np.append(signal.values, 0.0))
        a[(len(signal.values) - 1) * parts + 1:] = 0
        motion = np.zeros((4, 4))
        motion[:2, :2] = [[0, 1], [-omega**2, -2 * damping * omega]]
        motion[1, 2], motion[2, 3] = -1, 1  # the load and its slope
        advance = scipy.linalg.expm(motion * dt)
        state, largest = np.zeros(2), 0.0
        for first, second in zip(a[:-1], a[1:]):
            state = advance[:2, :2] @ state + advance[:2, 2] * first + advance[:2, 3] * (second - first) / dt
            largest = max(largest, abs(state[0]))
        found.append(omega**2 * largest)
    return np.array(found)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pounding-"))

    def table(self, *rows, name="rules.csv"):
        path = self.folder / name
        path.write_text("\n".join([",".join(COLUMNS), *(",".join(str(row.get(column, "")) for column in COLUMNS) for row in rows)])
                        + "\n")
        return path

    def target(self, points, name="target.csv"):
        (self.folder / name).write_text("frequency,ratio\n" + "".join(f"{f:.17g},{value:.17g}\n" for f, value in points))
        return name

    def verdict(self, rule, signals, directions="x", anchor=None):
        return judge(read_rules(self.table({"name": "it", **rule})), motions_of(signals, directions), anchor)[0]

    def holds_and_refuses(self, rule, column, number, good, bad, directions="x"):
        """A rule whose limit in a column lies between the numbers of two sets of signals holds for one only."""
        words = {column: number, **rule}
        kept, refused = self.verdict(words, good, directions), self.verdict(words, bad, directions)
        self.assertEqual((kept.word, refused.word), ("holds", "refused"), (kept.worst, refused.worst))
        return kept, refused


class Spectral(Case):
    @classmethod
    def setUpClass(cls):
        cls.signal = noise(1)
        cls.frequency, found = response_spectra([cls.signal], GRID, 0.05)
        cls.spectrum = found[0]

    def rule(self, kind, factors):
        """A rule of this kind on a target that is the motion's own spectrum times factors."""
        name = self.target(zip(self.frequency, self.spectrum * factors))
        return {"kind": kind, "grid": GRID, "target": name, "pga": "1m/s2", "directions": "x"}

    def judged(self, kind, most, factors):
        return self.verdict({**self.rule(kind, factors), "most": most}, [self.signal])

    def raised(self, places, by):
        factors = np.full(len(self.frequency), 0.99)
        factors[places] = by
        return factors

    def test_points_below(self):
        few, many = ([10, 20, 30, 40, 50], [10, 20, 30, 40, 50, 55])
        for places, word in ((few, "holds"), (many, "refused")):
            found = self.judged("points_below", 5, self.raised(places, 1.02))
            self.assertEqual((found.word, found.worst.number), (word, len(places)))

    def test_furthest_below_and_above(self):
        for kind, most, near, far in (("largest_below", 10, 1 / 0.91, 1 / 0.89), ("largest_above", 30, 1 / 1.29, 1 / 1.31)):
            for factor, word in ((near, "holds"), (far, "refused")):
                found = self.judged(kind, most, self.raised([33], factor))
                self.assertEqual(found.word, word)
                self.assertAlmostEqual(found.worst.number, 100 * abs(1 / factor - 1), delta=1e-6)
                self.assertAlmostEqual(found.worst.frequency, self.frequency[33])

    def test_neighbours_below(self):
        nine, ten = list(range(5, 14)) + list(range(20, 29)), list(range(5, 15))
        for places, word, number in ((nine, "holds", 9), (ten, "refused", 10)):
            found = self.judged("neighbours_below", 9, self.raised(places, 1.02))
            self.assertEqual((found.word, found.worst.number), (word, number))

    def test_mean_of_a_set(self):
        """The mean of a set may hold where one motion does not."""
        weak = Signal("weak", STEP, 0.8 * self.signal.values)
        strong = Signal("strong", STEP, 1.3 * self.signal.values)
        rule = {**self.rule("largest_below", np.ones(len(self.frequency))), "most": 10}
        self.assertEqual(self.verdict(rule, [weak, strong]).word, "refused")
        self.assertEqual(self.verdict({**rule, "of": "mean"}, [weak, strong]).word, "holds")
        self.assertEqual(self.verdict({**rule, "of": "mean"}, [weak, weak]).word, "refused")

    def test_from_and_to_cut_the_grid(self):
        rule = {**self.rule("largest_below", self.raised([0, 59], 1.5)), "most": 10}
        self.assertEqual(self.verdict(rule, [self.signal]).word, "refused")
        self.assertEqual(self.verdict({**rule, "from": 0.6, "to": 25}, [self.signal]).word, "holds")

    def test_points_per_decade(self):
        for points, word in ((61, "holds"), (60, "refused")):  # 60 and 59 steps over two decades
            rule = {"kind": "points_per_decade", "grid": f"0.3:30:{points}log", "least": 30}
            self.assertEqual(self.verdict(rule, [self.signal]).word, word)

    def test_spectrum_beside_one_of_the_test(self):
        short = noise(2, 6.0, (1.0, 5.0))
        frequencies = (0.7, 3.0, 11.0, 28.0)
        found = response_spectra([short], ",".join(map(str, frequencies)), 0.05)[1][0]
        error = abs(own_spectrum(short, frequencies, 0.05) / found - 1).max()
        print(f"spectra differ by {error:.1e}")
        self.assertLess(error, 1e-3)


class OfTheMotion(Case):
    def test_time_step_and_length(self):
        self.holds_and_refuses({"kind": "time_step"}, "most", 0.01, [noise(1)], [noise(1, step=0.02)])
        self.holds_and_refuses({"kind": "length"}, "least", 20, [noise(1, 20.0)], [noise(1, 19.99)])

    def test_strong_duration(self):
        good, bad = noise(1, strong=(2.0, 12.0)), noise(1, strong=(2.0, 9.5))  # 70 % of 10 and 7.5 s
        kept, refused = self.holds_and_refuses({"kind": "strong_duration"}, "least", 6, [good], [bad])
        for found, signal in ((kept, good), (refused, bad)):
            fine = np.arange((len(signal.values) - 1) * 50 + 1) / 50
            values = np.interp(fine, np.arange(len(signal.values)), signal.values)
            whole = np.concatenate([[0], np.cumsum((values[1:]**2 + values[:-1]**2) / 2)])
            ends = np.interp([0.05, 0.75], whole / whole[-1], fine * signal.step)
            self.assertAlmostEqual(found.worst.number, ends[1] - ends[0], delta=1e-3)
            self.assertAlmostEqual(found.worst.time, ends[0], delta=1e-3)
        wide = self.verdict({"kind": "strong_duration", "window": "5:95", "least": 6}, [bad])
        self.assertEqual(wide.word, "holds")

    def test_velocity_and_displacement(self):
        """One cycle of a sine: velocity 2 A / omega, displacement 2 pi A / omega^2 at its end."""
        def cycle(frequency, count=4000):
            return Signal("cycle", 1 / frequency / count, 3 * np.sin(2 * np.pi * np.arange(count + 1) / count))

        omega = 2 * math.pi * 2
        exact = {"v_over_a": 2 / omega, "ad_over_v2": math.pi / 2, "peak_acceleration": 3.0,
                 "final_displacement": 6 * math.pi / omega**2, "peak_displacement": 6 * math.pi / omega**2}
        for kind, number in exact.items():
            self.assertAlmostEqual(self.verdict({"kind": kind, "most": 1e3}, [cycle(2)]).worst.number / number, 1, delta=1e-6, msg=kind)
            self.assertEqual(self.verdict({"kind": kind, "most": 0.99 * number}, [cycle(2)]).word, "refused")
            self.assertEqual(self.verdict({"kind": kind, "most": 1.01 * number}, [cycle(2)]).word, "holds")
        half = Signal("half", 1e-3, 3 * np.sin(np.pi * np.arange(501) / 500))
        self.holds_and_refuses({"kind": "final_velocity"}, "most", 0.9, [cycle(2)], [half])  # 6 / pi * .5 s

    def test_correlation_of_components(self):
        one, other = noise(1).values, noise(2).values
        other = other - one * (one @ other) / (one @ one)
        mixed = {part: Signal("mixed", STEP, part * one / np.linalg.norm(one) + math.sqrt(1 - part**2) * other / np.linalg.norm(other))
                 for part in (0.15, -0.17)}
        kept, refused = self.holds_and_refuses({"kind": "correlation"}, "most", 0.16, [noise(1), mixed[0.15]],
                                               [noise(1), mixed[-0.17]], "xy")
        self.assertAlmostEqual(kept.worst.number, 0.15, delta=2e-3)
        self.assertAlmostEqual(refused.worst.number, 0.17, delta=2e-3)
        self.assertEqual(kept.worst.component, "x y")

    def test_a_shifted_start_is_not_another_motion(self):
        one = noise(1)
        later = Signal("later", STEP, np.concatenate([np.zeros(130), one.values]))
        rule = {"kind": "correlation", "of": "motions", "most": 0.5}
        self.assertEqual(self.verdict(rule, [one, later]).word, "holds")
        found = self.verdict({**rule, "shift": 5}, [one, later])
        self.assertEqual(found.word, "refused")
        self.assertAlmostEqual(abs(found.worst.time), 1.3)
        self.assertGreater(found.worst.number, 0.99)
        self.assertEqual(self.verdict({**rule, "shift": 5}, [one, noise(2)]).word, "holds")
        self.assertEqual(self.verdict({**rule, "shift": 1}, [one, later]).word, "holds")
        padded = np.pad(one.values, (0, 130))
        self.assertAlmostEqual(correlation(one, later)[0], np.corrcoef(padded, later.values)[0, 1])

    def test_number_of_motions(self):
        rule = {"kind": "motions", "least": 5}
        self.assertEqual(self.verdict(rule, [noise(k) for k in range(10)], "xy").word, "holds")
        self.assertEqual(self.verdict(rule, [noise(k) for k in range(8)], "xy").word, "refused")

    def test_the_worst_is_shown(self):
        short, long = noise(1, 19.0), noise(2, 30.0)
        for limits, number in (({"least": 20}, 19), ({"most": 25}, 30), ({"least": 25, "most": 35}, 19), ({"least": 1}, 19)):
            for signals in ([short, long], [long, short]):
                self.assertAlmostEqual(self.verdict({"kind": "length", **limits}, signals).worst.number, number)

    def test_nothing_to_look_at_is_said(self):
        rules = read_rules(self.table({"name": "pair", "kind": "correlation", "most": 0.16}, {"name": "long", "kind": "length", "least": 1},
                                      {"name": "told", "kind": "v_over_a"}))
        self.assertEqual([one.word for one in judge(rules, motions_of([noise(1)], "x"))], ["idle", "holds", "stated"])

    def test_every_kind_is_tried_here(self):
        text = Path(__file__).read_text()
        for kind in KINDS:
            self.assertIn(f'"{kind}"', text)


class Density(Case):
    def test_ratio_to_the_target(self):
        """Beside the formula written out: least mean over 20 % to both sides of the strong part's density, over the target."""
        signal = noise(3)
        a = signal.values
        first, last = (round(time / STEP) for time in signal.strong_part())
        part = a[first:last + 1]
        length = len(part) * STEP
        f = np.arange(len(part) // 2 + 1) / length
        transform = STEP * np.array([np.exp(-2j * np.pi * at * np.arange(len(part)) * STEP) @ part for at in f])
        density = 2 * abs(transform)**2 / (2 * np.pi * length)
        at = 10.0
        inside = np.linspace(0.8 * at, 1.2 * at, 20001)
        mean = np.interp(inside, f, density).mean()
        peak = G * math.sqrt(mean / 0.0418 / (9 / at)**3)  # the target's peak for a ratio of 1
        for share, word in ((1 / 0.82, "holds"), (1 / 0.78, "refused")):
            found = self.verdict({"kind": "psd_ratio", "least": 0.8, "grid": "10:10.0001:2log", "target": "rg160_psd",
                                  "pga": f"{peak * math.sqrt(share):.9f}m/s2"}, [signal])
            self.assertEqual(found.word, word)
            self.assertAlmostEqual(found.worst.number, 1 / share, delta=2e-4)

    def test_power_of_the_strong_part(self):
        """The density's integral over circular frequency is the mean square of the strong part."""
        signal = noise(4)
        f, density = signal.power()
        first, last = (round(time / STEP) for time in signal.strong_part())
        self.assertAlmostEqual(density.sum() * 2 * np.pi * f[1] / np.mean(signal.values[first:last + 1]**2), 1, delta=0.02)

    def test_gap(self):
        time = np.arange(2501) * STEP
        phases = np.random.default_rng(5).uniform(0, 2 * np.pi, 500)
        lines = np.arange(1, 501) / 25.0
        def motion(gap):
            return Signal("lines", STEP, sum(np.cos(2 * np.pi * f * time + phase) * (0.05 if gap and 4 < f < 8 else 1)
                                             for f, phase in zip(lines, phases)))

        _, refused = self.holds_and_refuses({"kind": "psd_gap", "grid": "1:15:100log"}, "least", 0.2, [motion(False)], [motion(True)])
        self.assertTrue(4 < refused.worst.frequency < 8)

    def test_mean_around(self):
        f = np.linspace(0, 10, 101)
        at = np.array([0.33, 2.0, 7.7])
        self.assertLess(abs(mean_around(f, f**2, at, 0.8, 1.2) / (at**2 * (1.2**3 - 0.8**3) / 1.2) - 1).max(), 0.02)


class Targets(unittest.TestCase):
    def test_regulatory_guide(self):
        for name, points in (("rg160_horizontal", {33: 1.0, 9: 2.61, 2.5: 3.13, 0.25: 0.4716, 50: 1.0}),
                             ("rg160_vertical", {33: 1.0, 9: 2.61, 3.5: 2.98, 0.25: 0.3152, 50: 1.0})):
            target = read_target(name, Path("."))
            found = target.at(np.array(list(points), float), 2.0)
            self.assertLess(abs(found / 2 / np.array(list(points.values())) - 1).max(), 1e-9)
        middle = math.sqrt(9 * 33)
        self.assertAlmostEqual(read_target("rg160_horizontal", Path(".")).at([middle], 1)[0], math.sqrt(2.61), delta=1e-9)

    def test_density_pieces_meet(self):
        target = Target("rg160_psd", (), True)
        at_1g = {2.5: 0.419, 9.0: 0.0418, 16.0: 0.00742, 1.25: 0.419 * 0.5**0.2, 5.0: 0.419 * 0.5**1.8, 12.0: 0.0418 * 0.75**3,
                 20.0: 0.00742 * 0.8**8}
        for f, value in at_1g.items():
            self.assertLess(abs(target.at([f], G)[0] / value - 1), 3.1e-3, f)
        for f in (row[0] for row in POWERS["rg160_psd"][:-1]):
            below, above = target.at([f * (1 - 1e-9), f * (1 + 1e-9)], G)
            print(f"pieces at {f:g} Hz differ by {abs(above / below - 1):.1e}")
            self.assertLess(abs(above / below - 1), 3.1e-3)
        self.assertAlmostEqual(target.at([5.0], 0.3 * G)[0] / target.at([5.0], G)[0], 0.09)


class Command(Case):
    def record(self, signal, name):
        path = self.folder / name
        path.write_text("".join(f"{k * signal.step:.6f} {value:.17g}\n" for k, value in enumerate(signal.values)))
        return path

    def setUp(self):
        super().setUp()
        self.files = [self.record(noise(seed), f"hill-{seed}.txt") for seed in (1, 2)]
        self.long = self.table({"name": "long", "kind": "length", "least": 20}, {"name": "pair", "kind": "correlation", "most": 0.16})

    def accept(self, rules, *words):
        return spectra("--accept", rules, "--unit", "m/s2", *words)

    def test_accepted_and_refused(self):
        table = self.folder / "verdicts.csv"
        done = self.accept(self.long, *self.files, "--output", table)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("accepted: 2 rules hold (the table names no source)", done.stdout)
        rows = program.read_csv(table)
        self.assertEqual((rows["rule"], rows["verdict"], rows["component"]), (["long", "pair"], ["holds", "holds"], ["x", "x y"]))
        self.assertEqual((float(rows["number"][0]), float(rows["least"][0])), (25.0, 20.0))
        done = self.accept(self.long, self.files[0], self.files[0], "--output", table)
        self.assertEqual((done.returncode, done.stderr), (3, ""))
        self.assertIn("refused by pair", done.stdout)
        self.assertEqual(program.read_csv(table)["verdict"], ["holds", "refused"])

    def test_names_with_quotation_marks_come_back(self):
        rules = self.folder / "quoted.csv"
        rules.write_text('name,kind,least\n"the ""long"" one, first",length,20\n')
        table = self.folder / "quoted-verdicts.csv"
        self.assertEqual(self.accept(rules, *self.files, "--output", table).returncode, 0)
        with open(table, newline="") as file:
            self.assertEqual([row["rule"] for row in csv.DictReader(file)], ['the "long" one, first'])

    def test_sets_and_directions(self):
        rules = self.table({"name": "two", "kind": "motions", "least": 2})
        for words, status in (([], 3), (["--directions", "z"], 0), (["--directions", "x,y"], 3)):
            self.assertEqual(self.accept(rules, *self.files, *words).returncode, status, words)

    def test_samples_come_back_to_the_bit(self):
        path = self.folder / "samples.csv"
        done = spectra("--unit", "m/s2", "--frequencies", 1, "--digits", 17, "--samples", path, self.files[0])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(np.array_equal(np.array(program.read_csv(path)["acceleration"], float), noise(1).values))

    def test_shipped_tables_are_read(self):
        tables = sorted(RULES.glob("*.csv"))
        self.assertEqual(len(tables), 4)
        for table in tables:
            self.assertGreater(len(read_rules(table)), 6)
            done = self.accept(table, *self.files, "--anchor", "4m/s2", "--directions", "x,y" if "set" not in table.name else "x")
            self.assertEqual((done.returncode, done.stderr), (3, ""), table.name)
            self.assertIn("revision 4", done.stdout)

    def test_wrong_use_is_one_line(self):
        """Each is refused in one line that says where and why, with exit status 1."""
        spectral = {"name": "it", "kind": "points_below", "most": 5, "grid": GRID, "target": "rg160_horizontal", "pga": "0.3g"}
        short = self.record(noise(1, 1.0, (0.1, 0.9)), "short.txt")
        still = self.folder / "still.txt"
        still.write_text("0 0\n0.01 0\n0.02 0\n")
        (self.folder / "empty.csv").write_text("# nothing\n")
        self.target([(1, 1), (10, 2)])
        cases = [
            ([{**spectral, "kind": "points_above"}], [], "line 2: kind 'points_above' is none of points_below"),
            ([{**spectral, "target": "target.csv"}], [], "target target.csv is stated from 1 to 10 Hz and asked for from 0.5 to 30 Hz"),
            ([{**spectral, "target": "no.csv"}], [], "target no.csv is none of rg160_horizontal"),
            ([{**spectral, "pga": "0.3"}], [], "'0.3' is not a number above 0 with its unit"),
            ([{**spectral, "pga": "300g"}], [], "'300g' is not a number above 0 with its unit"),
            ([{**spectral, "pga": "30g"}], [], "is the unit of the motion, or of pga, right?"),
            ([{**spectral, "pga": "anchor"}], [], "give --anchor"),
            ([{**spectral, "pga": ""}], [], "pga is empty; a rule of the kind points_below needs it"),
            ([{**spectral, "grid": "3:2:1log"}], [], "grid 3:2:1log, damping 0.05: option --frequencies"),
            ([{**spectral, "from": 40}], [], "no frequency of the grid is from 40 to inf Hz"),
            ([{**spectral, "window": "5:75"}], [], "has no window; leave it empty"),
            ([{**spectral, "damping": "five"}], [], "damping: 'five' is not a number"),
            ([{**spectral, "most": "few"}], [], "most: 'few' is not a number"),
            ([{**spectral, "least": 6}], [], "least 6 is above most 5"),
            ([{**spectral, "most": ""}], [], "nothing would ever be refused"),
            ([{**spectral, "of": "mean"}], [], "give the set of them"),
            ([{**spectral, "directions": "north"}], [], "is not some of x y z"),
            ([{**spectral, "directions": "z"}], [], "no rule has anything to look at"),
            ([spectral], [short], "lasts 1 s, less than a period of 0.5 Hz"),
            ([{"kind": "strong_duration", "least": 6}], [still], "the ground does not move"),
            ([spectral], [self.files[0], "--directions", "x,y"], "1 components are no motions of 2 each"),
            ([spectral], [self.files[0], "--directions", "up"], "not different ones of x, y and z"),
            ([spectral], [self.files[0], "--anchor", "3"], "peak acceleration '3' is not a number above 0"),
            ([spectral], [self.folder / "missing.txt"], "missing.txt"),
            ([spectral], [self.files[0], "--output", self.files[0]], "no table of verdicts"),
            ([{"kind": "correlation", "most": 0.1}], [self.files[0], self.record(noise(1, step=0.02), "other.txt")],
             "time steps of 0.01 and 0.02 s"),
        ]
        for rows, words, line in cases:
            with self.subTest(line):
                with self.assertRaises(MotionError) as caught:
                    main([SPECTRA, "--accept", str(self.table(*rows)), "--unit", "m/s2", *map(str, words or self.files)])
                self.assertIn(line, str(caught.exception))
                self.assertNotIn("\n", str(caught.exception))
        for table, line in (("empty.csv", "holds no rule"), ("none.csv", "no such table of rules"), ("target.csv", "column 'frequency'")):
            self.refused(self.accept(self.folder / table, *self.files), line)
        self.refused(self.accept(self.long, "--damping", "0.02", *self.files), "--damping has no effect with --accept")
        self.refused(spectra("--anchor", "1g", self.files[0]), "--anchor has no effect without --accept")

    def refused(self, done, line):
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("pounding-spectra: "))
        self.assertIn(line, done.stderr)

    def test_a_folder_called_pounding_is_not_taken_for_the_package(self):
        (self.folder / "pounding").mkdir()
        (self.folder / "pounding" / "__init__.py").write_text("raise SystemExit('wrong one')\n")
        done = spectra("--accept", self.long, "--unit", "m/s2", *self.files, folder=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class UnknownTarget(unittest.TestCase):
    def test_files_of_targets(self):
        folder = Path(tempfile.mkdtemp(prefix="pounding-"))
        for text, line in (("1 2\n0.5 3\n", "line 2"), ("1 2\n3 -1\n", "line 2"), ("f v\n1 2\n", "at least 2"), ("1 2\nx y\n", "line 2"),
                           ("1 2 3\n", "line 1")):
            (folder / "t.csv").write_text(text)
            with self.assertRaisesRegex(MotionError, line):
                read_target("t.csv", folder)


if __name__ == "__main__":
    unittest.main()
