"""-fidelity_target through the program: the fastest setting of the shipped table within the error that is
accepted, said aloud, and never against what the user asked for himself."""
import csv
import os
import unittest

import program

TABLE = os.path.join(program.SOURCE, "petsc-options", "fidelity.csv")


def settings():
    with open(TABLE, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def fastest(target):
    return min((row for row in settings() if float(row["rms"]) <= target), key=lambda row: float(row["cost"]))


class FidelityTarget(unittest.TestCase):
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
                    self, program.COARSE_PAIR + ["-end_time", 0.02, "-modes", 1, "-fidelity_target", target], ranks)
                for word in chosen["options"].split():
                    name, value = word.split("=")
                    names = [name[1:]] if name.startswith("-") else [f"s1_{name}", f"s2_{name}"]
                    for option in names:
                        found = summary["options"][option]
                        self.assertTrue(found == value or float(found) == float(value), (option, found))

    def test_says_what_it_took_and_why(self):
        result = program.run(program.COARSE_PAIR + ["-dry_run", "-fidelity_target", 0.05], 2)
        self.assertEqual(result.returncode, 0, result.stderr)
        line, = [line for line in result.stdout.splitlines() if line.startswith("fidelity target")]
        self.assertIn(f"'{fastest(0.05)['setting']}'", line)
        plain = program.run(program.COARSE_PAIR + ["-dry_run"], 2)
        self.assertNotIn("fidelity target", plain.stdout)

    def test_what_the_user_gave_wins(self):
        result = program.run(program.COARSE_PAIR + ["-dry_run", "-fidelity_target", 0.05, "-s1_model", "full"], 2)
        self.assertEqual(result.returncode, 0, result.stderr)
        line, = [line for line in result.stdout.splitlines() if line.startswith("fidelity target")]
        self.assertNotIn("modal", line)
        self.assertIn("mass_scaling", line)

    def test_wrong_words_are_one_line(self):
        for words in (["-fidelity_target", -1], ["-fidelity_target", 0.05, "-fidelity_table", "nowhere.csv"]):
            result = program.run(program.COARSE_PAIR + ["-dry_run"] + words, 2)
            self.assertEqual(result.returncode, 1)
            self.assertEqual(len(program.error_lines(result)), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
