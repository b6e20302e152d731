"""Every promise of docs/measurements/promises.md names tests that exist, and what a test is called is read from the
sources: methods of unittest classes, TEST macros, and tests that CMake adds for a program."""
import ast
import functools
import os
import re
import unittest

import program

PAGE = os.path.join(program.SOURCE, "docs", "measurements", "promises.md")
TESTS = os.path.join(program.SOURCE, "tests")


def python_tests(text):
    """Names Class.test of a source in Python, those that a class takes from others in it included."""
    classes = {node.name: node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)}

    def methods(node):
        found = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        for base in node.bases:
            if isinstance(base, ast.Name) and base.id in classes:
                found |= methods(classes[base.id])
        return found

    return {f"{name}.{method}" for name, node in classes.items() for method in methods(node)
            if method.startswith("test_")}


def cpp_tests(text):
    """Names Suite.Test of a source with GoogleTest."""
    return {".".join(pair) for pair in re.findall(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)", text, re.MULTILINE)}


def program_tests():
    """Names that CMake gives to runs of programs."""
    with open(os.path.join(TESTS, "CMakeLists.txt")) as file:
        return set(re.findall(r"add_test\(NAME (\w+)", file.read()))


def promised(text):
    """Lines of the tables as (promise, [names of tests])."""
    rows = [line.strip("|").split("|") for line in text.splitlines() if line.startswith("| ")]
    return [(row[0].strip(), re.findall(r"`([^`]+)`", row[1])) for row in rows if row[0].strip() != "promise"]


@functools.lru_cache(maxsize=None)
def tests_of(path):
    """Names of the tests of a file; none of one that is not there."""
    full = os.path.join(TESTS, path)
    if not os.path.isfile(full):
        return frozenset()
    with open(full) as file:
        text = file.read()
    if path.endswith("_test.py"):
        return python_tests(text)
    return cpp_tests(text) if path.endswith("_test.cpp") else program_tests()


def exists(name):
    path, _, test = name.partition("::")
    return test in tests_of(path)


class Promises(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(PAGE) as file:
            cls.rows = promised(file.read())

    def test_every_promise_names_a_test(self):
        self.assertGreater(len(self.rows), 50)
        for promise, names in self.rows:
            self.assertTrue(names, promise)

    def test_every_named_test_exists(self):
        gone = [name for _, names in self.rows for name in names if not exists(name)]
        self.assertEqual(gone, [])

    def test_a_test_that_is_gone_is_seen(self):
        for name in ("input/corpus_test.py::Corpus.test_nothing", "input/none_test.py::Corpus.test_options",
                     "unit/solvers/lcp_test.cpp::Lcp.Nothing", "fuzz/main.cpp::nothing"):
            self.assertFalse(exists(name), name)


if __name__ == "__main__":
    unittest.main()
