"""Tables of the pages that are measured: each stands below one line with machine, date and version and is written by
run/tables; the page of performance has no others and stays short."""
import os
import sys
import unittest
from pathlib import Path

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts import measured  # noqa: E402

DOCS = Path(program.SOURCE, "docs")
MOST_LINES = 199


class MeasuredTables(unittest.TestCase):
    def test_each_has_its_line_and_its_measurement(self):
        self.assertEqual(set(measured.pages_of(DOCS)), set(measured.TABLES))
        for page in sorted(DOCS.rglob("*.md")):
            text = page.read_text(encoding="utf-8")
            marked = list(measured.MARKED.finditer(text))
            self.assertEqual(text.count("<!-- table "), len(marked), f"{page}: a mark without its end")
            for found in marked:
                line, empty, *table, last = found[3].split("\n")[:-1]
                match = measured.LINE.match(line)
                self.assertTrue(match, f"{page}: {line}")
                self.assertEqual(match[1], found[2], page)
                self.assertEqual((empty, last), ("", ""), page)
                self.assertGreater(len(table), 2, page)
                self.assertTrue(all(row.startswith("|") for row in table), page)

    def test_the_page_of_performance_has_no_others_and_stays_short(self):
        text = (DOCS / "measurements" / "performance.md").read_text(encoding="utf-8")
        self.assertLessEqual(text.count("\n"), MOST_LINES)
        self.assertEqual([line for line in measured.MARKED.sub("", text).splitlines() if line.startswith("|")], [])

    def test_a_new_table_takes_the_place_of_the_old_one(self):
        page = "before\n\n<!-- table a -->\nold\n\n| x |\n\n<!-- end -->\n\n<!-- table b -->\nkept\n\n<!-- end -->\nbehind\n"
        self.assertEqual(measured.replaced(page, "a", "new \\1\n\n| y |\n"),
                         "before\n\n<!-- table a -->\nnew \\1\n\n| y |\n\n<!-- end -->\n\n<!-- table b -->\nkept\n\n<!-- end -->"
                         "\nbehind\n")


if __name__ == "__main__":
    unittest.main()
