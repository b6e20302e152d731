"""Code lines are a price that every capability pays: those of src, of each of its rooms, of run and of python are held by the numbers of
code_lines.csv. A number is only lowered; where one is raised, its row gives the reason. Numbers that the code has left
behind are to be lowered in the same commit: `code_lines_test.py --write` does so."""
import csv
import os
import pathlib
import re
import sys
import tempfile
import unittest

HERE = pathlib.Path(os.path.abspath(__file__)).parent
SOURCE = HERE.parents[1]
TABLE = HERE / "code_lines.csv"
SLACK = 30  # lines that a number may be above its count, so that not every small cut changes the table


def code_lines(path):
    """Lines of a source without blank ones and comments, those of templates as well; of Python without docstrings too."""
    text = path.read_text(errors="replace")
    if path.suffix in (".cpp", ".h"):
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
        return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("//"))
    text = re.sub(r"{#.*?#}", "", text, flags=re.DOTALL) if path.suffix == ".html" else text
    text = re.sub(r'^[ \t]*"""(?:.*?)"""[ \t]*\n', "", text, flags=re.DOTALL | re.MULTILINE)
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("#"))


def counted():
    """Code lines by place: `src`, each of its rooms, `run`, `python` (its package with templates of pages), and these two together."""
    found = {"src": 0, "run": 0, "python": 0}
    for path in sorted((SOURCE / "src").rglob("*")):
        if path.suffix in (".cpp", ".h"):
            room = path.relative_to(SOURCE).parts[:2]
            place = "/".join(room) if len(path.relative_to(SOURCE).parts) > 2 else "src/ (programs)"
            lines = code_lines(path)
            found[place] = found.get(place, 0) + lines
            found["src"] += lines
    for path in sorted((SOURCE / "run").rglob("*")):
        if path.is_file() and path.suffix in ("", ".py") and "__pycache__" not in path.parts:
            found["run"] += code_lines(path)
    for path in sorted((SOURCE / "python" / "pounding").rglob("*")):
        if path.suffix in (".py", ".html"):
            found["python"] += code_lines(path)
    found["run + python"] = found["run"] + found["python"]
    return found


def allowed():
    with open(TABLE) as file:
        return {row["place"]: (int(row["lines"]), row["reason"]) for row in csv.DictReader(file)}


def write():
    """Lowers the numbers to what is there, and leaves those that the code is above."""
    before = allowed() if TABLE.exists() else {}
    with open(TABLE, "w") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["place", "lines", "reason"])
        for place, lines in sorted(counted().items()):
            number, reason = before.get(place, (lines, ""))
            rows.writerow([place, min(number, lines), reason])


class CodeLines(unittest.TestCase):
    def test_no_place_grows(self):
        numbers = allowed()
        for place, lines in counted().items():
            self.assertIn(place, numbers, f"{place} has no row in code_lines.csv")
            self.assertLessEqual(lines, numbers[place][0], f"{place}: cut lines, or raise its number with a reason")

    def test_numbers_follow_the_code_down(self):
        found = counted()
        for place, (number, _) in allowed().items():
            self.assertLessEqual(number - found.get(place, 0), SLACK, f"{place}: lower its number (--write)")

    def test_comments_and_blanks_are_no_code(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "a.cpp").write_text("// words\n\n/* more\n of them */\nint a;  // here\n/// b\nint b;\n")
        (folder / "a.py").write_text('"""Words.\n\nMore."""\nimport a\n\n\ndef f():\n    """Of f."""\n    return 1  # one\n# end\n')
        self.assertEqual([code_lines(folder / name) for name in ("a.cpp", "a.py")], [2, 3])


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write()
    else:
        unittest.main()
