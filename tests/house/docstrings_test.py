"""A docstring can be read alone: its first word is a verb or the noun defined, not a word that hangs on the
docstring before it or a question word, and "likewise" is none; no line is longer than the house allows. Comments,
texts of the program and pages name a thing by its noun and say is and says: "what", "who", "stands" and "tells" are
counted, and may only become fewer."""
import os
import re
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SOURCE = os.path.join(ROOT, "src")
HANGING = re.compile(r"(Of|The same|To|What|Who|Whom|Whose|Likewise|As|And|Or|But|Then|Else|With|Without|By|"
                     r"From|In|At|On|For|That of|Those of|Its|Same)\b")
COLUMNS = 100
LIKEWISE = re.compile(r"///?<?\s*likewise(?:\s*\[[^]]*\])?[.,;]?$", re.IGNORECASE)
LITERAL = re.compile(r'"(?:[^"\\]|\\.)*"')
# Words counted, and the most of them in sources and pages: as many as there are, to be lowered with them.
COUNTED = ((re.compile(r"\b(?:what|who)\b", re.IGNORECASE), 56, 2),
           (re.compile(r"\b(?:stands?|stood|tells?|told)\b", re.IGNORECASE), 29, 4))


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


def words_read(line):
    """Comment and literals of a line of C++, which people read; names of the code are none of them."""
    comment_of = re.search(r"//.*", LITERAL.sub("", line))
    return LITERAL.findall(line) + ([comment_of.group()] if comment_of else [])


def lines_of(path):
    """Place and text of every line of a file, by its path from the root."""
    with open(os.path.join(ROOT, path)) as file:
        for number, line in enumerate(file, 1):
            yield f"{path}:{number}", line.rstrip("\n")


def lines_below(folder, *endings):
    """Place and text of every line of the files below a folder of the root."""
    for place, _, files in os.walk(os.path.join(ROOT, folder)):
        for name in sorted(files):
            if name.endswith(endings):
                yield from lines_of(os.path.relpath(os.path.join(place, name), ROOT))


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
        for place, line in lines_below("src", ".h", ".cpp"):
            if line.strip().startswith("//"):
                self.assertLessEqual(len(line), COLUMNS, place)

    def test_likewise_is_no_docstring(self):
        self.assertEqual([place for place, line in lines_below("src", ".h", ".cpp") if LIKEWISE.search(line)], [])

    def test_words_for_want_of_a_better_one_do_not_grow(self):
        sources = [(place, text) for place, line in lines_below("src", ".h", ".cpp") if not line.startswith("#include")
                   for text in words_read(line)]
        written = [line for line in lines_below("docs", ".md") if not line[0].startswith("docs/reference/composition.md")]
        pages = [*written, *lines_of("README.md"), *lines_of("CONTRIBUTING.md")]
        for words, most_in_sources, most_in_pages in COUNTED:
            for lines, most in ((sources, most_in_sources), (pages, most_in_pages)):
                found = [place for place, text in lines for _ in words.findall(text)]
                self.assertLessEqual(len(found), most, "\n".join([words.pattern, *found]))

    def test_a_hanging_docstring_is_found(self):
        found = [line for _, line in first_lines("/// Of a node.\nint a;\n/// Place of a node.\n/// To q.\n")]
        self.assertEqual(found, ["Of a node.", "Place of a node."])
        self.assertEqual([bool(HANGING.match(line)) for line in found], [True, False])
        for line, alone in (("  double b;  ///< likewise [m]", True), ("/// Likewise.", True), ("// likewise, of x", False)):
            self.assertEqual(bool(LIKEWISE.search(line)), alone, line)

    def test_only_words_that_people_read_are_counted(self):
        for line, count in (("throw Error(error.what() + text);  // what it says", 1), ('char* what = "who is it";', 1),
                            ("int what(int who);", 0)):
            self.assertEqual(sum(len(COUNTED[0][0].findall(text)) for text in words_read(line)), count, line)


if __name__ == "__main__":
    unittest.main()
