"""One definition of a type: no two files of src or of the tests' helpers define a class, struct, union or enum of one
qualified name outside unnamed namespaces, which no compiler or linker tells and which is undefined behaviour."""
import collections
import os
import re
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
WORDLESS = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^\s*#[^\n]*',
                      re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"template\s*<[^{};]*?>")
TYPE = re.compile(r"\b(?:enum\s+(?:class|struct)|enum|class|struct|union)\s+(?:alignas\s*\([^)]*\)\s*|\[\[[^\]]*\]\]\s*)*"
                  r"([\w:]+(?:<[^{};]*?>)?)\s*(?:final\s*)?(?::(?!:)[^{};()]*)?$")
NAMESPACE = re.compile(r"\bnamespace\s*([\w:]*)\s*$")


def types(text):
    """Qualified names of the types that a file defines with external linkage. A scope is the name of a namespace or type,
    or None where what is inside belongs to a function, an initialiser or an unnamed namespace."""
    text = WORDLESS.sub(" ", text)
    scopes, head = [], 0
    for found in re.finditer("[{};]", text):
        at, mark = found.start(), found.group()
        if mark == "{":
            before = text[head:at]
            bare = TEMPLATE.sub(" ", before).rstrip()
            namespace, kind = NAMESPACE.search(bare), TYPE.search(bare)
            if namespace:
                scopes.append(namespace.group(1) or None)
            elif kind:
                scopes.append(kind.group(1))
                if None not in scopes:
                    yield "::".join(scopes)
            else:
                scopes.append(None)
        elif mark == "}":
            scopes.pop()
        head = at + 1


class OneDefinition(unittest.TestCase):
    def test_no_two_types_of_a_program_have_one_name(self):
        for program in ("unit", "parallel", "fuzz"):
            places = collections.defaultdict(list)
            for root in ("src", "tests/support", f"tests/{program}"):
                for folder, _, names in os.walk(os.path.join(ROOT, root)):
                    for name in names:
                        if name.endswith((".h", ".cpp")):
                            with open(os.path.join(folder, name)) as file:
                                for found in types(file.read()):
                                    places[found].append(os.path.relpath(os.path.join(folder, name), ROOT))
            self.assertGreater(len(places), 400)
            for type_name in ("pounding::interactions::SparseRows", "pounding::stiffness::AssembledRows::Pattern",
                              "pounding::ElementType"):
                self.assertEqual(len(places[type_name]), 1, f"{type_name}: {places[type_name]}")
            self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})

    def test_a_second_type_is_found(self):
        text = """namespace pounding {  // struct Said {
        class Before;
        namespace { struct Hidden { int a; }; }
        struct Held : Base<int> { enum class Kind { a, b }; int f() { struct Local { int a; }; return 0; } };
        template <typename T> class Box final { };
        template <> struct Box<int> { };
        constexpr Held made{1};
        const char* text = "struct Quoted {";
        }"""
        self.assertEqual(list(types(text)), ["pounding::Held", "pounding::Held::Kind", "pounding::Box",
                                             "pounding::Box<int>"])


if __name__ == "__main__":
    unittest.main()
