"""A docstring stands alone: its first word is a verb or the noun defined, not a word that hangs on the
docstring before it or a question word; and no line is longer than the house allows."""
import os
import re
import unittest

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")
HANGING = re.compile(r"(Of|The same|To|What|Who|Whom|Whose|Likewise|As|And|Or|But|Then|Else|With|Without|By|"
                     r"From|In|At|On|For)\b")
COLUMNS = 100


def comment(line):
    """Text of a line that is nothing but a comment, else None."""
    found = re.match(r"\s*///? (?!<)(.*)", line)
    return found.group(1) if found else None


def first_lines(text):
    """Number and text of the line that begins each block of comment lines."""
    before = False
    for number, line in enumerate(text.split("\n"), 1):
        is_comment = line.strip().startswith("//")
        if is_comment and not before and comment(line):
            yield number, comment(line)
        before = is_comment


class Docstrings(unittest.TestCase):
    def test_every_docstring_stands_alone(self):
        blocks = 0
        for folder, _, files in os.walk(SOURCE):
            for name in files:
                with open(os.path.join(folder, name)) as file:
                    text = file.read()
                for number, line in first_lines(text):
                    blocks += 1
                    self.assertIsNone(HANGING.match(line), f"{name}:{number}: {line}")
        self.assertGreater(blocks, 500)

    def test_comments_keep_to_the_columns(self):
        for folder, _, files in os.walk(SOURCE):
            for name in files:
                with open(os.path.join(folder, name)) as file:
                    for number, line in enumerate(file, 1):
                        if line.strip().startswith("//"):
                            self.assertLessEqual(len(line.rstrip("\n")), COLUMNS, f"{name}:{number}")

    def test_a_hanging_docstring_is_found(self):
        found = [line for _, line in first_lines("/// Of a node.\nint a;\n/// Place of a node.\n/// To q.\n")]
        self.assertEqual(found, ["Of a node.", "Place of a node."])
        self.assertEqual([bool(HANGING.match(line)) for line in found], [True, False])


if __name__ == "__main__":
    unittest.main()
