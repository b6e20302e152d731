"""Stability of mats: the five worst instants and Newmark's block on histories made by hand; a rigid block under a known pulse, with
water and vertical motion, at full order and reduced, on one rank to three; slip of a block with friction and settlement of soil that
yields in closed form; rows of a study beside single runs; what is refused."""
import tempfile
import types
import unittest
from pathlib import Path

import numpy as np
import program
import two_buildings  # noqa: F401  (puts python on the path)
import yaml
from decks import box_of, clock, contacts, in_modes, material
from program import write_samples
from study_command import STUDY, StudyCommand

import pounding
from pounding import stability
from pounding.fragility import stability as in_study
from pounding.fragility.conditions import Condition
from pounding.fragility.study_file import ALONE, Reader

G = 9.81
MAT = stability.Mat("block", 0.5, 0.0, 0.0, (0.0, 2.0, 0.0, 1.0), 0.0, 1000.0, (1.0, 0.5), 1000.0 / G, 0.0)


class ByHand(unittest.TestCase):
    def test_five_instants_are_apart(self):
        time = np.arange(1001) * 1e-3
        values = 2 + np.zeros(1001)
        dips = {0.05: 1.0, 0.07: 0.9, 0.3: 0.8, 0.45: 1.5, 0.7: 1.2, 0.72: 1.3, 0.95: 1.4, 0.85: 1.6}
        for at, value in dips.items():
            values = np.minimum(values, value + 40 * abs(time - at))
        found = stability.worst(time, values)
        np.testing.assert_allclose(time[found], [0.3, 0.07, 0.7, 0.95, 0.45], atol=1e-9)  # not .05, .72; .85 is the sixth
        np.testing.assert_allclose(values[found], [0.8, 0.9, 1.2, 1.4, 1.5])
        self.assertEqual(len(stability.worst(time, np.full(1001, np.inf))), 0)
        self.assertEqual(list(stability.worst(time, 2 - time)), [1000])
        self.assertEqual(list(stability.worst(time[:3], np.array([1.0, 1.0, 2.0]))), [0])

    def test_factors_of_a_force_out_of_the_middle(self):
        """N = 900 with a weight at x = .8; H = (300, -400) at a height of 2 m, d'Alembert's load, buoyancy 100 in the middle."""
        mat = stability.Mat(**{**MAT.__dict__, "weight_at": (0.8, 0.5), "buoyancy": 100.0, "passive": 50.0})
        reaction = -np.array([300.0, -400.0, -900.0])
        moment = np.cross((0.8, 0.5, 2.0), reaction)
        factors, numbers = stability.factors(np.array([[*reaction, *moment]]), mat)
        found = dict(zip(stability.CRITERIA, factors[0]))
        self.assertAlmostEqual(found["sliding"], (0.5 * 800 + 50) / 500, places=12)
        self.assertAlmostEqual(found["overturning x+"], (900 * 1.2 - 100 * 1.0) / 600, places=12)
        self.assertAlmostEqual(found["overturning y-"], (900 * 0.5 - 100 * 0.5) / 800, places=12)
        self.assertEqual((found["overturning x-"], found["overturning y+"]), (np.inf, np.inf))
        self.assertAlmostEqual(found["flotation"], 9.0, places=12)
        np.testing.assert_allclose(numbers[0, 0], [450, 500])
        lifted = np.array([[*reaction[:2], 50.0, 0, 0, 0]])
        self.assertAlmostEqual(stability.factors(lifted, mat)[0][0, 0], 50 / 500)

    def test_block_slides_as_newmark_has_it(self):
        """A pulse of 8 m/s2 for .2 s on mu g = 4.905: (A - mu g) T^2 / 2 until its end, then v^2 / (2 mu g)."""
        step = 1e-4
        time = np.arange(round(1 / step) + 1) * step
        push = np.where((time > 0.1 - step / 2) & (time < 0.3 - step / 2), 8.0, 0.0)
        for direction in ((1.0, 0.0), (0.6, -0.8)):
            forces = np.zeros((len(time), 6))
            forces[:, :2] = -MAT.mass * push[:, None] * np.array(direction)
            forces[:, 2] = MAT.weight
            beyond, speed = 8.0 - 0.5 * G, (8.0 - 0.5 * G) * 0.2
            expected = beyond * 0.2**2 / 2 + speed**2 / (2 * 0.5 * G)
            self.assertAlmostEqual(stability.slid(time, forces, MAT) / expected, 1, delta=2e-3)
        twice = np.concatenate([forces, forces])
        self.assertAlmostEqual(stability.slid(np.arange(len(twice)) * step, twice, MAT) / (2 * expected), 1, delta=2e-3)
        self.assertEqual(stability.slid(time, np.where(np.arange(6) == 2, MAT.weight, 0.6 * forces), MAT), 0.0)


def plateau(amplitude, end=1.5, step=1e-3):
    """A record that rises in .8 s, with three derivatives that are none at both ends, and stays [m/s2]."""
    part = np.minimum(np.arange(round(end / step) + 1) * step / 0.8, 1)
    return write_samples(list(amplitude * part**4 * (35 - 84 * part + 70 * part**2 - 20 * part**3)), step)


class Block(unittest.TestCase):
    """14.4 t, 2 x 1 x 3 m, rigid, on four stiff corners with dashpots: m a under it once the pulse stays."""
    MASS, PUSH, LIFT = 2400.0 * 6, 3.0, -1.5
    CORNERS = ["-it_corners_element", "grounded_spring", "-it_corners_stiffness", "4e9,4e9,4e9", "-it_corners_dashpot", "6e6,6e6,6e6"]

    def words(self, *more, weight=("-gravity", G, "-preload", "static")):
        words = ["-structures", "it", *box_of("it", "lx=2,ly=1,lz=3", "stone"), *material("stone", 1e9, 0.2, 2400),
                 "-it_rigid", "body", *self.CORNERS, *clock(1e-4, 1.3, 1e-3), *weight, "-modes", 0, "-spectra_frequencies", 5,
                 "-probes", "top", "-top_structure", "it", "-top_at", "0,0,3", "-top_floor", "true",
                 "-forces", "base", "-base_structure", "it", "-base_kind", "reactions", "-base_about", "0.3,-1,0.2"]
        for axis, amplitude in (("x", self.PUSH), ("z", self.LIFT)):
            words += [f"-motion_{axis}_record", plateau(amplitude), f"-motion_{axis}_unit", "m/s2"]
        return [*words, *more]

    def told(self, mat, words, ranks=1, status=0, asked=0.1, **block):
        """Rows of run/stability by criterion, of a run."""
        folder, _ = program.must_run(self, words, ranks)
        return self.command(folder, {"asked": asked, "mats": {"it": mat}, **block}, status)

    def command(self, folder, block, status=0):
        place = Path(tempfile.mkdtemp(prefix="pounding-"))
        (place / "mats.yaml").write_text(yaml.safe_dump(block))
        done = program.command("stability", folder, place / "mats.yaml", "--out", place)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.said = done.stdout + done.stderr
        self.instants = program.rows_of(place / "stability_instants.csv") if status in (0, 3) else []
        return {row["criterion"]: row for row in program.rows_of(place / "stability.csv")} if status in (0, 3) else {}

    def check(self, rows, buoyancy=0.0, tolerance=1e-6):
        normal = self.MASS * (G + self.LIFT)
        floats = buoyancy * self.MASS * G
        expected = {"sliding": (0.5 * (normal - floats) + 1e3) / (self.MASS * self.PUSH),
                    "overturning x-": (normal - floats) * 1.0 / (self.MASS * self.PUSH * 1.5)}
        if buoyancy:
            expected["flotation"] = normal / floats
        for name, value in expected.items():
            self.assertAlmostEqual(float(rows[name]["least"]) / value, 1, delta=tolerance, msg=name)
        self.assertGreater(float(rows["sliding"]["time [s]"]), 0.75)

    def test_factors_by_hand(self):
        mat = {"friction": 0.5, "passive": "1e3", "edges": "0,2,0,1"}
        for ranks in (1, 2, 3):
            self.check(self.told(mat, self.words(), ranks))
        rows = self.told(mat | {"buoyancy": 0.3 * self.MASS * G}, self.words(), asked=1.3, status=3)
        self.check(rows, 0.3)
        self.assertEqual((rows["sliding"]["holds"], rows["flotation"]["holds"]), ("no", "yes"))
        first = next(row for row in self.instants if row["criterion"] == "overturning x-")
        for name, value in (("Fx [N]", self.MASS * self.PUSH), ("Fz [N]", self.MASS * (G + self.LIFT)),
                            ("My [N m]", self.MASS * self.PUSH * 1.5), ("buoyancy [N]", 0.3 * self.MASS * G)):
            self.assertAlmostEqual(float(first[name]) / value, 1, delta=1e-6, msg=name)

    def test_water_is_its_weight_over_the_mat(self):
        mat = {"friction": 0.5, "passive": 1000, "edges": [0, 2, 0, 1], "level": 0.0, "water": 2.0}
        self.check(self.told(mat, self.words()), 1000 * 9.81 * 2 * 2.0 / (self.MASS * G))

    def test_reduced(self):
        self.check(self.told({"friction": 0.5, "passive": 1000, "edges": [0, 2, 0, 1]}, self.words(*in_modes("it", 6))))

    def test_weight_that_the_scene_has_not(self):
        mat = {"friction": 0.5, "passive": 1000, "edges": [0, 2, 0, 1]}
        self.check(self.told(mat, self.words(weight=()), gravity=G))
        self.assertIn("the scene has no gravity", self.said)
        folder, _ = program.must_run(self, self.words(weight=()), 1)
        self.command(folder, {"asked": 1, "mats": {"it": mat}}, 1)
        self.assertIn("the scene has no gravity", self.said)
        self.assertIn("give gravity: 9.81", self.said)
        self.check(self.command(folder, {"asked": 0.1, "mats": {"it": mat | {"weight": self.MASS * G, "weight_at": [1, 0.5]}}}))
        self.assertNotIn("Doubt", self.said)

    def test_settlement_of_soil_that_yields(self):
        """Each corner pushes W/4 at rest, k until F, then .1 k; pressed by m (g + a) and let go it stays down by
        (P - F)/k (1/.1 - 1)."""
        stiffness, strength, lift = 4e8, 5e4, 5.0
        step, end = 1e-3, 5.5
        time = np.arange(round(end / step) + 1) * step
        record = write_samples(list(lift * np.sin(np.pi * np.minimum(time / 5.0, 1)) ** 2), step)
        words = self.words("-it_corners_stiffness", f"4e9,4e9,{stiffness}", "-it_corners_dashpot", "6e6,6e6,2e4", "-it_corners_yield_force", f"0,0,{strength}", "-it_corners_hardening", 0.1,
                           "-motion_x_record", "none", "-motion_z_record", record, "-end_time", end)
        rows = self.told({"friction": 0.5, "edges": [0, 2, 0, 1]}, words)
        load = self.MASS * (G + lift) / 4
        expected = (load - strength) / stiffness * (1 / 0.1 - 1)
        self.assertGreater(expected, 1e-5)
        self.assertAlmostEqual(float(rows["settlement"]["value [m]"]) / expected, 1, delta=5e-3)
        top = (strength - self.MASS * G / 4) / stiffness + (load - strength) / (0.1 * stiffness)
        self.assertAlmostEqual(float(rows["settlement at most"]["value [m]"]) / top, 1, delta=5e-3)

    def test_slip_of_a_block_with_friction(self):
        """Swings of .85, .65, .45, .25 and .05 mm on a spring: 3.6 mm of path (friction_test.py)."""
        words = ["-structures", "it", *box_of("it", "x0=-0.5,y0=-0.5,lz=0.1", "stone"), *material("stone", 1e3, 0.2, 10), "-gravity", 10,
                 *contacts(ground=("it:z_min", "wall", 0)), "-ground_friction", 0.1, *clock(1e-5, 0.16), "-energy_interval", 100,
                 "-probes", "one", "-one_structure", "it", "-one_at", "-0.5,0.5,0", "-it_rigid", "body", "-modes", 0,
                 "-it_initial_displacement", "0.85e-3,0,0", "-it_corners_element", "grounded_spring", "-it_corners_stiffness", "2500,0,0"]
        rows = self.told({"friction": 0.1, "contact": "ground"}, words)
        self.assertAlmostEqual(float(rows["slid"]["value [m]"]), 3.6e-3, delta=1e-8)

    def test_what_is_refused(self):
        folder, _ = program.must_run(self, self.words("-end_time", 0.01), 1)
        mat = {"friction": 0.5, "edges": [0, 2, 0, 1]}
        for block, words in (({"asked": 1.1, "mats": {"house": mat}}, ["house is no structure of the scene; it has it"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"friction": -0.5}}}, ["mats: it: friction: -0.5 is below 0"]),
                             ({"asked": 1.1, "mats": {"it": {"edges": [0, 2, 0, 1]}}}, ["mats: it: friction is missing"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"level": 1.5}}}, ["level 1.5 m is not that of an underside", "0 to 3 m"]),
                             ({"asked": 1.1, "mats": {"it": {"friction": 0.5}}}, ["nothing tells how large its mat is", "give edges"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"edges": [2, 0, 0, 1]}}}, ["edges", "x1 below x2"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"water": 1, "buoyancy": 1}}}, ["water", "give one of the two"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"weight": 1.0}}}, ["which has gravity", "leave weight"]),
                             ({"asked": 1.1, "mats": {"it": mat | {"mu": 1}}}, ["mats: it: mu is unknown", "friction"]),
                             ({"mats": {"it": mat}}, ["asked is missing"]), ({"asked": 1.1}, ["mats", "is no list of structures"])):
            self.command(folder, block, 1)
            for word in words:
                self.assertIn(word, self.said)
            self.assertEqual(len(self.said.strip().splitlines()), 1, self.said)
        folder, _ = program.must_run(self, self.words("-end_time", 0.01, weight=("-gravity", G)), 1)
        self.command(folder, {"asked": 1.1, "mats": {"it": mat}}, 1)
        self.assertIn("give preload: static", self.said)
        words = self.words("-end_time", 0.01, "-forces", "none")
        for key in ("structure", "kind", "about"):
            del words[words.index(f"-base_{key}"):words.index(f"-base_{key}") + 2]
        folder, _ = program.must_run(self, words, 1)
        self.command(folder, {"asked": 1.1, "mats": {"it": mat}}, 1)
        self.assertIn("the run recorded no force under it", self.said)
        free = [word for word in words if word not in self.CORNERS or word == "none"]
        folder, _ = program.must_run(self, [*free[:free.index("-gravity")], *free[free.index("-gravity") + 4:], "-it_ignore", "corners",
                                           "-it_allow_loose", "true"], 1)
        self.command(folder, {"asked": 1.1, "gravity": G, "mats": {"it": mat}}, 1)
        self.assertIn("nothing holds this structure", self.said)
        self.assertEqual(len(self.said.strip().splitlines()), 1, self.said)


class OfAFile(unittest.TestCase):
    def test_contact_keeps_its_name(self):
        for name in ("12", "1e3", "pads"):
            found = stability.read(Reader({"mats": {"it": {"friction": "5e-1", "contact": name}}}, Path("m.yaml"), "", ("mats",)))
            self.assertEqual((found["it"].friction, found["it"].contact), (0.5, name))


class InAStudy(StudyCommand):
    MATS = {"left": {"friction": 0.5, "water": 0.4}, "right": {"friction": 0.4, "passive": 2e4, "edges": [6, 9.1, 0, 4]}}
    OPTIONS = {**STUDY["options"], "left_roof_floor": True}

    def test_rows_are_those_of_single_runs(self):
        asked = {"asked": 1.1, "gravity": G, "mats": self.MATS}
        said = self.fragility(stability=asked, options=self.OPTIONS, states=None, submittal={"question": "Do they stand?"}).stdout
        self.assertIn("Doubt: mat left is below the factor of 1.1 that is asked: sliding", said)
        found = {(row["mat"], row["criterion"], row["runs"]): row for row in program.rows_of(self.place / "out" / "stability.csv")}
        instants = program.rows_of(self.place / "out" / "stability_instants.csv")
        singles, self.motions = {}, {}
        for soil, speed in (("best", 150), ("upper", 225)):
            for seed in (1, 2):
                singles[soil, seed], self.motions[soil, seed] = self.alone(seed, {"left_soil_vs": speed}, asked)
        for number, name in enumerate(self.MATS):
            for criterion in ("sliding", "overturning x+"):
                c = stability.CRITERIA.index(criterion)
                row = found[name, criterion, "joint of 10 mm"]
                least = {key: one[number].factor[c, 0] for key, one in singles.items()}
                soil, seed = min(least, key=least.get)
                self.assertAlmostEqual(float(row["least"]) / least[soil, seed], 1, delta=1e-7)
                self.assertEqual((row["soil"], row["motions"]), (soil, str(seed)))
                self.assertAlmostEqual(float(row["time [s]"]), singles[soil, seed][number].time[c, 0], delta=1e-9)
                mean = min(np.mean([least[one, seed] for seed in (1, 2)]) for one in ("best", "upper"))
                self.assertAlmostEqual(float(row["mean"]) / mean, 1, delta=1e-7)
                five = [row for row in instants if (row["mat"], row["criterion"], row["runs"]) == (name, criterion, "joint of 10 mm")]
                values = sorted(value for one in singles.values() for value in one[number].factor[c])[:5]
                np.testing.assert_allclose([float(row["factor"]) for row in five], values, rtol=1e-7)
        for motion in stability.MOTIONS:
            row = found["left", motion, "joint of 10 mm"]
            most = {key: motions[0][motion] for key, motions in self.motions.items()}
            soil, seed = max(most, key=most.get)
            self.assertAlmostEqual(float(row["largest [m]"]), most[soil, seed], delta=1e-7 * abs(most[soil, seed]))
            self.assertEqual((row["soil"], row["motions"]), (soil, str(seed)))
        self.assertGreater(float(found["left", "stays moved", "joint of 10 mm"]["largest [m]"]), 5e-5)
        self.assertNotIn(("right", "settlement", "joint of 10 mm"), found)  # it is clamped
        slid = max(one[0].slid for one in singles.values())
        self.assertAlmostEqual(float(found["left", "sliding", "joint of 10 mm"]["would slide at most [m]"]) / slid, 1, delta=1e-6)
        for page in ("fragility.html", "submittal.html"):
            self.assertIn("overturning about the worst edge", (self.place / "out" / page).read_text())
        text = (self.place / "out" / "submittal.html").read_text()
        self.assertLess(text.index("below the factor of 1.1"), text.index("<table"))

    def alone(self, seed, options, asked):
        """Worst instants of the mats in a run of its own, and their motions."""
        forces = {"forces": "a,b", "a_structure": "left", "a_kind": "reactions", "b_structure": "right", "b_kind": "reactions"}
        run = two_buildings.run(self.place / "run", **{
            **self.OPTIONS, "gap": 0.01, "motion_x_seed": seed, "motion_x_pga": 4.0, "motion_x_duration": 6, "motion_x_envelope": "0.3,4",
            **{f"{name}_{key}": value for name in ("left", "right") for key, value in STUDY["reduction"][name].items()},
            "spectra_frequencies": "1,100", "time_step": self.time_step(), **forces, **options})
        given = {name: stability.Given(name, **{key: tuple(v) if isinstance(v, list) else v for key, v in one.items()}) for name, one in self.MATS.items()}
        mats = stability.of_run(run, given, asked["gravity"], "test")
        return [one for _, one, _ in mats], [motion for *_, motion in mats]

    def time_step(self):
        import h5py
        steps = set()
        for path in (self.place / "out").glob("conditions/*/runs/*/ensemble*/ensemble.h5"):
            with h5py.File(path) as file:
                steps |= {line.split()[2] for line in np.char.decode(file["identity"][:]) if line.startswith("time step")}
        self.assertEqual(len(steps), 1)
        return steps.pop()

    def test_what_is_refused(self):
        for block, word in (({"asked": 1.1, "mats": self.MATS}, "the scene has no gravity"),
                            ({"asked": 1.1, "gravity": G, "mats": {"middle": {"friction": 1}}}, "middle is no structure of the scene; it has left, right")):
            said = self.fragility("--dry-run", stability=block, states=None, soils=None, status=1).stderr
            self.assertIn(word, said)
        said = self.fragility(stability={"asked": 1.1, "level": 3, "mats": self.MATS}, status=1).stderr
        self.assertIn("stability: level: 3 is none of the study's 4", said)
        said = self.fragility(stability={"asked": 1.1, "mats": {"left": {"friction": 1, "contact": "floor3"}}}, states=None, soils=None, status=1).stderr
        self.assertIn("mats: left: floor3 is no contact of the scene; it has floor1, floor2", said)

    def test_slip_on_contacts_and_settlement_by_hand(self):
        """Two soils of two samples in a joint and apart: of each motion the mean, 84 % and largest on the soil where they are largest."""
        def analysis(settled, slip):
            one = types.SimpleNamespace(bases=["b"], contacts=["top", "base"], settled=np.array(settled)[:, None, :] * [1, 2, 3],
                                        slip=np.array([[0, value] for value in slip]))
            mats = {"a": stability.Given("a", 0.3, contact="base"), "b": stability.Given("b", 0.3)}
            told = types.SimpleNamespace(stability=types.SimpleNamespace(mats=mats), levels=[2.0], joint_named=lambda gap: f"{gap:g} m", axes={})
            return types.SimpleNamespace(outcomes=one, study=told, of=lambda gap, level: [2, 3] if gap is None else [0, 1], design=types.SimpleNamespace(motions=["m"] * 4))

        soft = analysis([[1.0], [3], [0], [0]], [0.1, 0.2, 0.5, 0])
        stiff = analysis([[2.5], [2], [0], [1]], [0.1, 0.3, 0, 0])
        rows = {(row["mat"], row["criterion"], row["runs"]): row for row in in_study.moved_rows(
            {Condition(name, ALONE, None): one for name, one in (("soft", soft), ("stiff", stiff))}, 0.01)}
        self.assertEqual(len(rows), 2 + 2 * len(stability.MOTIONS))
        row = rows["b", "settlement at most", "0.01 m"]
        self.assertEqual([row[key] for key in ("mean [m]", "largest [m]", "sample", "soil")], [4.5, 6, 1, "soft"])
        self.assertAlmostEqual(row["84 % [m]"], 2 * 2.68)
        row = rows["a", "slid", "0.01 m"]
        self.assertEqual([row[key] for key in ("largest [m]", "sample", "soil")], [0.3, 1, "stiff"])
        self.assertEqual(rows["a", "slid", "apart"]["largest [m]"], 0.5)


if __name__ == "__main__":
    unittest.main()
