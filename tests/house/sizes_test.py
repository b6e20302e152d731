"""A file of src has at most 400 lines, a function at most 60: what is longer holds a second concept, which has a name of
its own and a place of its own."""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.path.abspath(__file__)).parents[2] / "src"
LONGEST_FILE = 400
LONGEST_FUNCTION = 60
RAW_TEXT = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)
COMMENT_OR_TEXT = re.compile(r"//.*|\"(?:\\.|[^\"\\])*\"|(?<![0-9A-Za-z])'(?:\\.|[^'\\])'")
FUNCTION = re.compile(r"\)\s*(?:const|noexcept|override|final|requires\b.*|->.*|:.*|__attribute__.*)*\s*$", re.DOTALL)


def functions(text):
    """Lines and beginning of each function, those within others as part of them."""
    text = RAW_TEXT.sub(lambda found: '""' + "\n" * found.group().count("\n"), text)
    text = COMMENT_OR_TEXT.sub("", text)
    blocks, head, line = [], "", 1  # of a block: whether it is a function, its first line
    for letter in text:
        if letter == "{":
            inside = any(is_function for is_function, _ in blocks)
            blocks.append((not inside and FUNCTION.search(head) is not None, line))
        elif letter == "}":
            is_function, first = blocks.pop()
            if is_function:
                yield line - first + 1, first
        head = "" if letter in "{};" else head + letter
        line += letter == "\n"


class Sizes(unittest.TestCase):
    def sources(self):
        return [path for path in sorted(SOURCE.rglob("*")) if path.suffix in (".cpp", ".h")]

    def test_files(self):
        lengths = {str(path.relative_to(SOURCE)): len(path.read_text().splitlines()) for path in self.sources()}
        self.assertGreater(len(lengths), 400)
        self.assertEqual({name: lines for name, lines in lengths.items() if lines > LONGEST_FILE}, {})

    def test_functions(self):
        lengths = {f"{path.relative_to(SOURCE)}:{first}": lines for path in self.sources()
                   for lines, first in functions(path.read_text())}
        self.assertGreater(len(lengths), 3000)
        self.assertEqual({place: lines for place, lines in lengths.items() if lines > LONGEST_FUNCTION}, {})

    def test_functions_are_found(self):
        text = ('namespace a {\nclass B {\n  B() : x_("{") {\n    if (x) {\n    }\n  }\n};\n'
                "int f(int a) const {\n  const auto g = [&](char c) {\n    return c == '{';\n  };\n  return 1'000;\n}\n}\n")
        self.assertEqual(list(functions(text)), [(4, 3), (6, 8)])


if __name__ == "__main__":
    unittest.main()
