"""One definition of a type: no two files of src or of the tests' helpers define a class, struct, union or enum of one
qualified name outside unnamed namespaces, which no compiler or linker tells and which is undefined behaviour. Files of a
room that are compiled together share one unnamed namespace as well. With run/test --all the programs are linked from their
types as the compiler knows them, which tells a type that differs with the vector unit or a macro."""
import collections
import os
import re
import subprocess
import tempfile
import unittest

import program

PROCESSORS = 2  # builds with both of them
TIMEOUT = 7200
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
WORDLESS = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^\s*#[^\n]*',
                      re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"template\s*<[^{};]*?>")
TYPE = re.compile(r"\b(?:enum\s+(?:class|struct)|enum|class|struct|union)\s+(?:alignas\s*\([^)]*\)\s*|\[\[[^\]]*\]\]\s*)*"
                  r"([\w:]+(?:<[^{};]*?>)?)\s*(?:final\s*)?(?::(?!:)[^{};()]*)?$")
NAMESPACE = re.compile(r"\bnamespace\s*([\w:]*)\s*$")


VARIABLE = re.compile(r"<[^(){};]*>|\[\[.*?\]\]|\balignas\s*\([^)]*\)|__attribute__\s*\(\(.*?\)\)|\[[^\]]*\]")
DIFFERS = re.compile("-Wodr|-Wlto-type-mismatch")
COMPILED_ALONE = re.compile(r'room MATCHES "(\^\(.*\)\$)"')


def heads(text):
    """What stands before each opening brace or semicolon, with the scopes around it: names of namespaces (empty where
    unnamed) and types, or None where what is inside belongs to a function or an initialiser."""
    text = WORDLESS.sub(" ", text)
    scopes, head = [], 0
    for found in re.finditer("[{};]", text):
        at, mark = found.start(), found.group()
        if mark == "}":
            scopes.pop()
        else:
            before = TEMPLATE.sub(" ", text[head:at]).strip()
            yield before, mark, scopes
        if mark == "{":
            namespace, kind = NAMESPACE.search(before), TYPE.search(before)
            scopes.append(namespace.group(1) if namespace else kind.group(1) if kind else None)
        head = at + 1


def types(text):
    """Qualified names of the types that a file defines with external linkage."""
    for before, mark, scopes in heads(text):
        kind = TYPE.search(before)
        if mark == "{" and kind and not NAMESPACE.search(before) and "" not in scopes and None not in scopes:
            yield "::".join([*scopes, kind.group(1)])


def hidden_names(text):
    """Names of types, functions and variables that a file defines right inside an unnamed namespace; other names of a type
    or of a namespace may be repeated."""
    for before, _, scopes in heads(text):
        if not before or not scopes or scopes[-1] != "" or None in scopes or NAMESPACE.search(before):
            continue
        kind = TYPE.search(before)
        name = re.search(r"\w+$", re.split(r"[(=]", VARIABLE.sub(" ", before), maxsplit=1)[0].strip())
        if kind:
            yield kind.group(1)
        elif name and not before.startswith(("using ", "namespace ")):
            yield name.group()


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

    def test_headers_of_src_share_no_name_across_namespaces(self):
        """`using namespace`, or a file of the inner one, would take the other for it."""
        places = collections.defaultdict(set)
        for folder, _, names in os.walk(os.path.join(ROOT, "src")):
            for name in names:
                if name.endswith(".h"):
                    with open(os.path.join(folder, name)) as file:
                        for before, mark, scopes in heads(file.read()):
                            kind = TYPE.search(before)
                            if mark == "{" and kind and not NAMESPACE.search(before) and all(one and one.islower() for one in scopes):
                                places[kind.group(1)].add(os.path.join(folder, name))
        self.assertGreater(len(places), 300)
        self.assertEqual({name: files for name, files in places.items() if len(files) > 1}, {})

    def test_files_that_are_compiled_together_hide_no_name_twice(self):
        with open(os.path.join(ROOT, "CMakeLists.txt")) as file:
            alone = re.compile(COMPILED_ALONE.search(file.read()).group(1))
        rooms = 0
        for folder, _, names in os.walk(os.path.join(ROOT, "src")):
            if alone.search(os.path.relpath(folder, os.path.join(ROOT, "src"))):
                continue
            rooms += 1
            files = collections.defaultdict(set)
            for name in names:
                if name.endswith(".cpp"):
                    with open(os.path.join(folder, name)) as file:
                        for found in hidden_names(file.read()):
                            files[found].add(name)
            self.assertEqual({name: sorted(of) for name, of in files.items() if len(of) > 1}, {}, folder)
        self.assertGreater(rooms, 10)

    def test_tests_that_are_compiled_together_have_namespaces_of_their_own(self):
        for program in ("unit", "parallel"):
            seen = collections.Counter()
            for folder, _, names in os.walk(os.path.join(ROOT, "tests", program)):
                for name in names:
                    if name.endswith("_test.cpp"):
                        seen[name] += 1
                        with open(os.path.join(folder, name)) as file:
                            text = file.read()
                        self.assertIn(f"\nnamespace {name[:-4]} {{\n", text, name)
                        self.assertNotIn("\nnamespace {\n", text, name)
            self.assertGreater(len(seen), 20)
            self.assertEqual({name: times for name, times in seen.items() if times > 1}, {})

    def test_a_hidden_name_is_found(self):
        text = """namespace pounding {
        int seen(double x) { return 0; }
        namespace {
        constexpr std::array<double, 3> weights{1, 2, 3};
        constexpr double limit = 2;
        using Row = std::vector<double>;
        struct Place : Base { int node = 0; };
        template <typename T> std::optional<T> half(const T& value, double by = 2) { int local; return value; }
        }  // namespace
        }"""
        self.assertEqual(list(hidden_names(text)), ["weights", "limit", "Place", "half"])

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

    def test_a_type_that_differs_is_told_by_the_linker(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(f"{folder}/both.cpp", "w") as file:
                file.write("struct Both { double held[COUNT]; double first() const { return held[0]; } };\n#if COUNT == 1\n"
                           "double taken(const Both& both) { return both.first(); }\nint main() {}\n#else\n"
                           "double taken(const Both&);\ndouble g() { Both both{}; return taken(both) + both.first(); }\n#endif\n")
            for count in (1, 2):
                subprocess.run(["c++", "-flto", f"-DCOUNT={count}", "-c", "both.cpp", "-o", f"{count}.o"], cwd=folder, check=True)
            done = subprocess.run(["c++", "-flto", "1.o", "2.o", "-o", "both"], cwd=folder, capture_output=True, text=True)
            self.assertRegex(done.stderr, DIFFERS)


@program.long
class Linked(unittest.TestCase):
    """Without the optimiser, which changes no type."""

    def test_programs_have_every_type_once(self):
        folder = os.path.abspath(program.BUILD) + "-linked"
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0",
                        "-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON", "-DPOUNDING_VECTOR_UNITS=v3"], check=True, capture_output=True)
        for name in ("pounding", "pounding-mesh", "pounding-spectra", "job_server", "unit_tests", "parallel_tests"):
            with self.subTest(name):
                done = subprocess.run(["cmake", "--build", folder, "--target", name], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout[-2000:])
                self.assertNotRegex(done.stdout, DIFFERS)


if __name__ == "__main__":
    unittest.main()
