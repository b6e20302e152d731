"""-fidelity_target through the program: the fastest setting of the shipped table within the error that is
accepted, said aloud, and never against what the user asked for himself."""
import csv
import os
import tempfile
import unittest

import program

TABLE = os.path.join(program.SOURCE, "petsc-options", "azalee", "fidelity.csv")


def settings():
    with open(TABLE, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def fastest(target):
    return min((row for row in settings() if float(row["rms"]) <= target), key=lambda row: float(row["cost"]))


class FidelityTarget(unittest.TestCase):
    """On a coarse mesh, with the shipped table as if it had been measured there."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        result = program.run(program.COARSE_PAIR + ["-end_time", 1e-4, "-modes", 0, "-output", cls.folder], 1)
        assert result.returncode == 0, result.stderr
        key = program.summary(cls.folder)["structures_key"]
        path = os.path.join(cls.folder, "table.csv")
        with open(TABLE) as file, open(path, "w") as copy:
            for line in file:
                copy.write(f"# structures: {key} coarse pair\n" if line.startswith("# structures: ") else line)
        cls.coarse = program.COARSE_PAIR + ["-fidelity_table", path]

    def test_table_has_full_order_and_faster_settings_for_every_class(self):
        rows = {row["setting"]: row for row in settings()}
        self.assertEqual(float(rows["full"]["rms"]), 0)
        for target in (0.01, 0.03, 0.05, 0.1):
            self.assertLess(float(fastest(target)["cost"]), float(rows["full"]["cost"]) / 2)

    def test_takes_the_fastest_within_the_target(self):
        for target in (0.003, 0.05):
            chosen = fastest(target)
            for ranks in (1, 2):
                folder, summary = program.must_run(
                    self, self.coarse + ["-end_time", 0.02, "-modes", 1, "-fidelity_target", target], ranks)
                for word in chosen["options"].split():
                    name, value = word.split("=")
                    names = [name[1:]] if name.startswith("-") else [f"s1_{name}", f"s2_{name}"]
                    for option in names:
                        found = summary["options"][option]
                        self.assertTrue(found == value or float(found) == float(value), (option, found))

    def test_probes_and_forces_are_no_part_of_the_key(self):
        """Those of the pair have names that begin as the structures' do."""
        base = ["-forces", "s1_base", "-s1_base_structure", "s1", "-s1_base_kind", "reactions"]
        keys = {program.must_run(self, program.COARSE_PAIR + ["-end_time", 1e-4, "-modes", 0, *words], 1)[1]["structures_key"]
                for words in ([], ["-probes", "none"], ["-s1_floor2_at", "0,0,5.22"], ["-s1_floor2_floor", "false"], base)}
        self.assertEqual(len(keys), 1)

    def test_says_what_it_took_and_why(self):
        result = program.must_end(self, self.coarse + ["-dry_run", "-fidelity_target", 0.05], 2)
        line, = [line for line in result.stdout.splitlines() if line.startswith("fidelity target")]
        self.assertIn(f"'{fastest(0.05)['setting']}'", line)
        plain = program.run(self.coarse + ["-dry_run"], 2)
        self.assertNotIn("fidelity target", plain.stdout)

    def test_what_the_user_gave_wins(self):
        result = program.must_end(self, self.coarse + ["-dry_run", "-fidelity_target", 0.05, "-s1_model", "full"], 2)
        line, = [line for line in result.stdout.splitlines() if line.startswith("fidelity target")]
        self.assertNotIn("modal", line)
        self.assertIn("mass_scaling", line)

    def test_other_structures_than_those_measured_are_refused(self):
        pair = ["-options_file", "petsc-options/azalee/gap2.yaml"]
        for words in (program.COARSE_PAIR, ["-options_file", "petsc-options/azalee/b-gap2.yaml"],
                      pair + ["-s1_brace1_area", 130e-6], pair + ["-material_concrete_young", 28e9]):
            for ranks in (1, 2):
                program.must_refuse(self, [*words, "-dry_run", "-fidelity_target", 0.05],
                                    "measured on other structures", "pair.yaml", "docs/fidelity.md", ranks=ranks)

    def test_shipped_cases_of_the_pair_are_those_measured(self):
        for case in ("gap2", "demo"):
            result = program.must_end(self, ["-options_file", f"petsc-options/azalee/{case}.yaml", "-dry_run",
                                             "-fidelity_target", 0.0005, "-modes", 1], 2)
            self.assertIn("'intervals'", result.stdout)

    def test_wrong_words_are_one_line(self):
        for words in (["-fidelity_target", -1], ["-fidelity_target", 0.05, "-fidelity_table", "nowhere.csv"]):
            result = program.run(self.coarse + ["-dry_run"] + words, 2)
            self.assertEqual(result.returncode, 1)
            self.assertEqual(len(program.error_lines(result)), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
