"""Universal files become meshes of scenes with all their groups."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import imported
from imported import by_hand, refused, same

CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
PLACES = (*CUBE, (0, 0, 2), (0, 0, 3))


def line(*values):
    """Numbers of ten columns."""
    return "".join(f"{value:10d}" for value in values) + "\n"


def dataset(number, content):
    return f"    -1\n{number:6d}\n{content}    -1\n"


def reals(values):
    """Numbers of 25 columns, with exponents as Fortran writes them."""
    return "".join(f"{x:25.16E}" for x in values).replace("E", "D") + "\n"


NODES = dataset(2411, "".join(line(n, 1, 1, 11) + reals(place) for n, place in enumerate(PLACES, 1)))
ELEMENTS = dataset(2412, line(7, 115, 3, 1, 7, 8) + line(*range(1, 9)) + line(8, 44, 4, 1, 7, 4) + line(1, 4, 3, 2)
                   + line(9, 21, 5, 1, 7, 2) + line(0, 1, 1) + line(9, 10))


def groups(*named):
    """Dataset of groups (name, pairs of kind and label), two entries in a line."""
    text = ""
    for number, (name, pairs) in enumerate(named, 1):
        text += line(number, 0, 0, 0, 0, 0, 0, len(pairs)) + name + "\n"
        for at in range(0, len(pairs), 2):
            text += line(*(value for kind, label in pairs[at:at + 2] for value in (kind, label, 0, 0)))
    return dataset(2467, text)


class Unv(unittest.TestCase):
    def hold(self, content, properties, units="m,kg,s"):
        """A cube on its lower face; returns the text of the mesh and what was said."""
        path = content if isinstance(content, Path) else imported.of_file("hall.unv", content)
        path.with_name("properties.yaml").write_text(f"hall: {properties}\n")
        done = imported.command(path, units, "--properties", path.with_name("properties.yaml"))
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        scene = path.parent / "out" / "hall.yaml"
        cells = {"body": ("brick", [range(1, 9)]), "base": ("quadrangle", [(1, 2, 3, 4)])}
        same(self, scene, by_hand(dict(enumerate(CUBE, 1)), cells,
                                  {"body_element": "hex8", "body_material": "C30", "clamp": "base"}))
        return scene.with_suffix(".msh").read_text(), done.stdout

    def test_groups_of_elements_and_of_nodes(self):
        named = groups(("body", [(8, 7)]), ("Base face", [(8, 8)]), ("all of it", [(8, 7), (8, 8), (8, 9)]),
                       ("mast", [(8, 9)]), ("feet", [(7, n) for n in (1, 2, 3, 4)]))
        system = dataset(2420, line(1) + "part\n" + line(1, 0, 8) + "global\n" + "".join(
            reals([float(row == d) for d in range(3)]) for row in range(4)))
        for clamp in ("base_face", "feet"):
            mesh, said = self.hold(named + system + NODES + ELEMENTS,
                                   "{body: {element: hex8, material: C30}, ignore: 'mast,all_of_it', "
                                   f"clamp: {clamp}}}")
            self.assertIn("ELEMENTS 115 1, ELEMENTS 21 1, ELEMENTS 44 1, GROUPS 5, NODES 10", said)
        names = {tuple(row.split(maxsplit=2)[::2]) for row in mesh.partition("$EndPhysicalNames")[0].splitlines()[5:]}
        self.assertEqual(names, {("3", '"body"'), ("2", '"base_face"'), ("3", '"all_of_it"'), ("2", '"all_of_it"'),
                                 ("1", '"all_of_it"'), ("1", '"mast"'), ("0", '"feet"')})
        numbers = {words[0]: words[1:] for words in (row.split() for row in mesh.partition("$Elements")[2].splitlines())
                   if len(words) in (9, 5, 3)}
        self.assertEqual((numbers["7"], numbers["8"], numbers["9"]),
                         ([str(n) for n in range(1, 9)], ["1", "4", "3", "2"], ["9", "10"]))

    def test_without_groups_properties_are_them(self):
        self.hold(NODES + ELEMENTS, "{g3: {element: hex8, material: C30}, clamp: g4, ignore: g5}")

    def test_units_are_those_that_are_stated(self):
        millimetres = dataset(164, line(5) + reals([1e3, 1, 1]) + reals([1, 0, 0]))
        nodes = dataset(2411, "".join(line(n, 1, 1, 11) + reals([1e3 * x for x in place])
                                      for n, place in enumerate(PLACES, 1)))
        _, said = self.hold(millimetres + nodes + ELEMENTS,
                            "{g3: {element: hex8, material: C30}, clamp: g4, ignore: g5}", "mm,t,s")
        self.assertIn("dataset 164 has 1000 for lengths", said)

    def test_a_file_of_gmsh(self):
        path = Path(tempfile.mkdtemp(prefix="pounding-import-"), "hall.geo")
        path.write_text('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};\nTransfinite Curve {:} = 2; '
                        "Transfinite Surface {:}; Recombine Surface {:}; Transfinite Volume {:};\n"
                        'Physical Volume("body", 3) = {1}; Physical Surface("base", 4) = {5};\n')
        script = ("import sys, ctypes\ng = ctypes.CDLL('libgmsh.so')\ne = ctypes.c_int()\n"
                  "g.gmshInitialize(0, None, 0, ctypes.byref(e))\ng.gmshOpen(sys.argv[1].encode(), ctypes.byref(e))\n"
                  "g.gmshModelMeshGenerate(3, ctypes.byref(e))\ng.gmshWrite(sys.argv[2].encode(), ctypes.byref(e))\n"
                  "sys.exit(e.value)\n")
        subprocess.run([sys.executable, "-c", script, path, path.with_suffix(".unv")], check=True, capture_output=True)
        self.hold(path.with_suffix(".unv"), "{body: {element: hex8, material: C30}, clamp: base}")

    def test_losses(self):
        quadratic = dataset(2412, line(9, 118, 3, 1, 7, 10) + line(*range(1, 9)) + line(9, 10))
        refused(self, "hall.unv", NODES + quadratic + groups(("body", [(8, 9)])), "ELEMENTS 118 OF 10 1 would be lost")

    def test_what_is_not_read_is_refused_with_its_line(self):
        whole = NODES + ELEMENTS
        for text, *parts in (
                (dataset(2417, ""), "dataset 2417 of groups is not known"), (dataset(15, ""), "dataset 15 of nodes"),
                (NODES + NODES, "line 26", "node 1 occurs twice"), (whole + ELEMENTS, "element 7 occurs twice"),
                (whole + groups(("g", [(8, 70)])), "has element 70, which is no cell or node"),
                (whole + groups(("g", [(7, 70)])), "has node 70, which is no cell or node"),
                (whole + groups(("g", [(3, 1)])), "something else (type 3)"),
                (NODES + dataset(2412, line(7, 115, 3, 1, 7, -8)), "an element of -8 nodes"),
                (NODES + dataset(2412, "     seven\n"), "'seven' is not a whole number"),
                (NODES + dataset(2412, line(7, 115, 3)), "3 numbers, and not 6"),
                (dataset(2411, line(1) + "  ten\n"), "'  ten' is not a number"),
                (dataset(2420, line(1) + "part\n" + line(1, 1, 8) + "round\n"), "not Cartesian"),
                (dataset(2420, line(1) + "part\n" + line(1, 0, 8) + "aslant\n" + reals([0, 1, 0])), "turned or moved")):
            refused(self, "hall.unv", text, "hall.unv line ", *parts)
        refused(self, "hall.unv", ELEMENTS, "node 1 is not in the file")
        for text in ("no mesh\n", NODES):
            refused(self, "hall.unv", text, "no element in it")

    def test_a_file_that_is_cut_off(self):
        whole = NODES + ELEMENTS
        for size in range(100, len(whole) - 8, 97):
            refused(self, "hall.unv", whole[:size])


if __name__ == "__main__":
    unittest.main()
