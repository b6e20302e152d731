"""Braces in src: a statement without them stands on the line of its condition or loop, every other one has them."""
import os
import re
import unittest

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")
HEAD = re.compile(r"\s*(\} )?(else )?(if|for|while)\b.*")
ELSE = re.compile(r"\s*(\} )?else")


def bare_heads(text):
    """Numbers of the lines that begin a condition or loop whose statement follows on another line without braces."""
    lines = text.split("\n")
    found = []
    for number, line in enumerate(lines):
        whole, last = line, number
        if HEAD.fullmatch(line):
            while whole.count("(") > whole.count(")") and last + 1 < len(lines):
                last += 1
                whole += lines[last]
        elif not ELSE.fullmatch(line):
            continue
        if whole.rstrip().endswith((")", "else")):
            found.append(number + 1)
    return found


class Braces(unittest.TestCase):
    def test_statements_of_other_lines_have_braces(self):
        files = 0
        for folder, _, names in os.walk(SOURCE):
            for name in names:
                with open(os.path.join(folder, name)) as file:
                    self.assertEqual(bare_heads(file.read()), [], name)
                files += 1
        self.assertGreater(files, 300)

    def test_a_bare_statement_is_found(self):
        self.assertEqual(bare_heads("if (a)\n  b();\n"), [1])
        self.assertEqual(bare_heads("for (int i = 0; i < n;\n     ++i)\n  b();\n"), [1])
        self.assertEqual(bare_heads("if (a) {\n  b();\n} else\n  c();\n"), [3])
        self.assertEqual(bare_heads("if (a) b();\nwhile (c) {\n  d();\n}\n// if (only said)\n"), [])


if __name__ == "__main__":
    unittest.main()
