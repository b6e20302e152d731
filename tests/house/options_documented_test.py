"""docs/reference/scene lists every option of the option table, with its unit, default and range, and no other."""
import json
import os
import pathlib
import re
import subprocess
import unittest

import program

CHAPTERS = sorted(pathlib.Path(program.SOURCE, "docs", "reference", "scene").glob("*.md"))

PETSC_ROW = re.compile(r'\{"([a-z][a-z0-9_]*\*?)", Value::\w+\}')
NAME = r"[A-Za-z]\w*"


def source(name):
    """The text of a file of src, in whatever folder it stands."""
    found = [os.path.join(folder, name) for folder, _, files in os.walk(os.path.join(program.SOURCE, "src"))
             if name in files]
    if len(found) != 1:
        raise LookupError(f"{len(found)} files {name} in src")
    with open(found[0]) as file:
        return file.read()


def shown(option):
    """A preset as the page shows it."""
    if option["default"] is None:
        return option["absent"]
    return f"`{option['default']}`" if option["default"] else "empty"


def option_rows():
    """Pattern -> (block, kind, unit, default, range, words) of every option, as the program says them."""
    text = subprocess.run([program.PROGRAM, "-help_json"], env=program.ENVIRONMENT, capture_output=True, text=True,
                          timeout=60, check=True).stdout
    return {option["name"]: (option["block"], option["kind"], option["unit"], shown(option),
                             option["range"].replace("any", ""), option["form"]) for option in json.loads(text)}


def tables(text):
    """Tables of the page whose first column is 'option', as lists of rows of cells."""
    found, inside = [], False
    for line in text.splitlines():
        if not line.startswith("|"):
            inside = False
            continue
        cells = [cell.strip().replace(r"\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if cells[0] == "option":
            found.append([cells])
            inside = True
        elif inside and set(cells[0]) != {"-"}:
            found[-1].append(cells)
    return found


def documented(text):
    """Name -> cells of its row, for the scene's own options (five columns) and PETSc's (three)."""
    own, petsc, twice = {}, {}, []
    for header, *rows in tables(text):
        for cells in rows:
            for name in re.findall(r"`([^`]+)`", cells[0]):
                place = own if len(header) == 5 else petsc
                if name in own or name in petsc:
                    twice.append(name)
                place[name] = cells
    return own, petsc, twice


def as_expression(pattern):
    """What a pattern matches once its placeholders are names."""
    parts = re.split(r"(<[^>]+>)", pattern.replace("*", "<number>"))
    return "".join((r"[xyz]" if part == "<x|y|z>" else r"\d+" if part == "<number>" else NAME)
                   if part.startswith("<") else re.escape(part) for part in parts)


class OptionsDocumented(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not os.path.exists(program.PROGRAM):
            raise unittest.SkipTest("the program is not built")
        cls.rows = option_rows()
        cls.petsc_source = source("unknown_options.cpp")
        cls.petsc_rows = PETSC_ROW.findall(cls.petsc_source)
        cls.page = "\n".join(chapter.read_text() for chapter in CHAPTERS)
        cls.own, cls.petsc, cls.twice = documented(cls.page)

    def test_every_row_of_the_table_is_read(self):
        self.assertGreaterEqual(len(self.rows), 260)
        enum = re.search(r"enum class OptionBlock \{([^}]*)\}", source("option_row.h"))[1]
        self.assertEqual(list(dict.fromkeys(row[0] for row in self.rows.values())), re.findall(r"\w+", enum))
        self.assertEqual(len(self.petsc_rows), len(re.findall(r"Value::\w+\}", self.petsc_source)))
        self.assertGreaterEqual(len(self.petsc_rows), 15)

    def test_rows_are_those_of_the_help(self):
        text = subprocess.run([program.PROGRAM, "-help"], env=program.ENVIRONMENT, capture_output=True, text=True,
                              timeout=60, check=True).stdout
        scene, petsc = text.split("Options of PETSc and SLEPc that pass through:")
        self.assertEqual(re.findall(r"^  -(\S+) +\[", scene, re.MULTILINE), list(self.rows))
        self.assertEqual(re.findall(r"-(\S+)", petsc), self.petsc_rows)

    def test_every_option_is_on_the_page(self):
        self.assertEqual(sorted(set(self.rows) - set(self.own)), [])
        self.assertEqual(sorted(set(self.petsc_rows) - set(self.petsc)), [])

    def test_every_option_of_the_page_exists_and_stands_there_once(self):
        self.assertEqual(sorted(set(self.own) - set(self.rows)), [])
        self.assertEqual(sorted(set(self.petsc) - set(self.petsc_rows)), [])
        self.assertEqual(self.twice, [])

    def test_unit_default_and_range_are_those_of_the_table(self):
        for name, (_, kind, unit, default, bounds, form) in self.rows.items():
            _, unit_shown, default_shown, allowed, meaning = self.own[name]
            self.assertEqual((unit_shown, default_shown), (unit, default), name)
            if kind == "choice":
                self.assertEqual(re.findall(r"`([^`]+)`", allowed), form.split("|"), name)
            else:
                self.assertTrue(allowed.endswith(bounds), f"{name}: {allowed} does not say {bounds}")
                self.assertTrue(bounds or not re.search(r"[<>]=? \d", allowed), f"{name}: {allowed}")
            self.assertTrue(meaning, name)

    def test_options_named_in_the_text_exist(self):
        known = [as_expression(name) for name in [*self.rows, *self.petsc_rows, "options_file", "include", "help", "help_json",
                                                  "h", "version"]]
        named = re.findall(r"`-([a-z]\w*)[ `]", self.page)
        self.assertGreater(len(named), 5)
        for name in named:
            self.assertTrue(any(re.fullmatch(expression, name) for expression in known), name)

    def test_the_first_chapter_needs_a_tenth_of_the_options(self):
        first = next(chapter for chapter in CHAPTERS if chapter.name == "first.md").read_text()
        rows = first.partition("| to begin with |")[2].partition("\n\n")[0].replace(r"\|", "|").splitlines()
        named = re.findall(r"`([^`]+)`", " ".join(row.split(" | ")[0] for row in rows))
        self.assertEqual(sorted(set(named) - set(self.rows)), [])
        self.assertTrue(20 < len(named) <= len(self.rows) / 10, len(named))

    def test_what_is_missing_or_invented_is_seen(self):
        line = next(line for line in self.page.splitlines() if line.startswith("| `end_time` | s |"))
        own, _, _ = documented(self.page.replace(line + "\n", ""))
        self.assertEqual(set(self.rows) - set(own), {"end_time"})
        own, _, _ = documented(self.page.replace(line, line + "\n" + line.replace("end_time", "last_time")))
        self.assertEqual(set(own) - set(self.rows), {"last_time"})
        _, _, twice = documented(self.page.replace(line, line + "\n" + line))
        self.assertEqual(twice, ["end_time"])


if __name__ == "__main__":
    unittest.main()
