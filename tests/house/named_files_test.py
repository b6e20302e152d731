"""Files, commands, functions and types that the pages name exist, and their links lead to files and headings."""
import os
import re
import unittest

import program

CODE = re.compile(r"`([\w./-]+\.(?:h|cpp|py|md|yaml|yml|csv|txt|geo))(?::[\w:]+)?`")
COMMAND = re.compile(r"(?:^|[\s`(])(run/\w+)", re.MULTILINE)
IDENTIFIER = re.compile(r"`(\w+(?:::\w+)?)`")
# Words in code type that are none of the code.
OF_NO_CODE = {"snake_case", "PascalCase", "member_", "POUNDING_BUILD"}
LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")
# Results of runs and studies, and examples of scenes; tables are results unless their folder is named.
OF_A_RUN = re.compile(r"\w+\.csv|spectra/gap-G_pga-L\.csv|resolved\.yaml|case\.yaml|soils\.yaml")


def files():
    """Paths below the source folder, without what is built or computed."""
    for folder, folders, names in os.walk(program.SOURCE):
        folders[:] = [name for name in folders if name not in (".git", "results", "__pycache__")
                      and not (folder == program.SOURCE and name.startswith("build"))]
        for name in names:
            yield os.path.relpath(os.path.join(folder, name), program.SOURCE)


def pages():
    found = [name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
             if os.path.exists(os.path.join(program.SOURCE, name))]
    return found + sorted(name for name in files() if name.startswith("docs" + os.sep) and name.endswith(".md"))


def text_of(page):
    with open(os.path.join(program.SOURCE, page)) as file:
        return file.read()


def anchors(text):
    """Headings as links name them: small letters, hyphens for spaces, without marks."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


class NamedFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files = set(files())

    def is_there(self, name):
        return any(path == name or path.endswith("/" + name) for path in self.files)

    def test_files_named_in_code_type_exist(self):
        seen = 0
        for page in pages():
            for name in CODE.findall(text_of(page)):
                seen += 1
                self.assertTrue(OF_A_RUN.fullmatch(name) or self.is_there(name), f"{page} names {name}")
        self.assertGreater(seen, 300)

    def test_functions_and_types_named_in_the_walk_throughs_exist(self):
        code = ""
        for name in self.files:
            if name.startswith("src") and name.endswith((".h", ".cpp")):
                code += text_of(name)
        seen = 0
        for name in set(IDENTIFIER.findall(text_of("CONTRIBUTING.md"))) - OF_NO_CODE:
            if "_" not in name and name == name.lower():
                continue  # a word, or a function too short to be told from one
            seen += 1
            for part in name.split("::"):
                self.assertRegex(code, rf"\b{part}\b", f"CONTRIBUTING.md names {name}")
        self.assertGreater(seen, 30)

    def test_schema_numbers_are_those_of_the_code(self):
        """The page of files tells the number of every layout."""
        numbers = re.findall(r"constexpr int (\w+) = (\d+);", text_of("src/io/schema.h"))
        told = re.search(r"Today they are (.*?`checkpoint\.h5`)", text_of("docs/reference/files.md"),
                         re.DOTALL).group(1)
        parts = re.split(r"(\d+) for ", told)
        of_file = {name: number for number, names in zip(parts[1::2], parts[2::2])
                   for name in re.findall(r"\w+(?=\.json|\.h5)|basis", names)}
        self.assertEqual(of_file, dict(numbers))

    def test_commands_exist(self):
        seen = 0
        for page in pages():
            for name in COMMAND.findall(text_of(page)):
                seen += 1
                self.assertTrue(os.access(os.path.join(program.SOURCE, name), os.R_OK), f"{page} names {name}")
        self.assertGreater(seen, 20)

    def test_links_lead_to_files(self):
        seen = 0
        for page in pages():
            for target, heading in LINK.findall(text_of(page)):
                if "://" not in target:
                    seen += 1
                    path = os.path.normpath(os.path.join(os.path.dirname(page), target)) if target else page
                    self.assertTrue(os.path.exists(os.path.join(program.SOURCE, path)), f"{page} links to {target}")
                    if heading:
                        self.assertIn(heading, anchors(text_of(path)), f"{page} links to {target}#{heading}")
        self.assertGreater(seen, 10)


if __name__ == "__main__":
    unittest.main()
