"""Meshes of Salome and Code_Aster become meshes of scenes with all their groups."""
import tempfile
import unittest
from pathlib import Path

import h5py
import imported
import numpy as np
from imported import by_hand, refused, same

try:
    import meshio
except ModuleNotFoundError:
    meshio = None

PLACES = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0, 0, 2), (1, 0, 2),
          (1, 1, 2),
          (0, 1, 2), (0.5, 0.5, 3), (2, 0, 0), (2, 0, 1), (0, 0, 3)]
BRICK = (1, 2, 3, 4, 5, 6, 7, 8)
# Each type with its cells (of solids in the order of MED: base and top turn the other way) and their families.
CELLS = {"HE8": ([(1, 4, 3, 2, 5, 8, 7, 6), (5, 8, 7, 6, 9, 12, 11, 10)], [-1, -1]),
         "PE6": ([(2, 3, 14, 6, 7, 15)], [-1]), "TE4": ([(9, 11, 10, 13)], [-4]),
         "QU4": ([(1, 2, 3, 4), (9, 10, 11, 12)], [-2, -3]), "SE2": ([(9, 16)], [-5]), "PO1": ([(16,)], [-6])}
FAMILIES = {-1: ["BODY", "ALL"], -2: ["BASE"], -3: ["ROOF"], -4: ["TIP", "ALL"], -5: ["MAST"], -6: ["TOP"]}
PROPERTIES = """hall:
  body: {element: hex8, material: concrete}
  tip: {element: tet4, material: concrete}
  roof: {element: shell, material: concrete, thickness: 0.2}
  mast: {element: beam, material: concrete, section: mast}
  top: {element: point_mass, mass: 120}
  clamp: base
material: {concrete: {young: 30e9, poisson: 0.2, density: 2400}}
section: {mast: {area: 0.04, inertia_y: 1e-4, inertia_z: 2e-4, torsion: 2e-4, z_axis: "1,0,0"}}
"""


def med_file(cells, scale=1000.0, meshes=1):
    """A file as Salome writes it, coordinates times a scale."""
    path = Path(tempfile.mkdtemp(prefix="pounding-import-"), "hall.med")
    with h5py.File(path, "w") as file:
        for number in range(meshes):
            mesh = file.create_group(f"ENS_MAA/Mesh_{number + 1}")
            mesh.attrs["ESP"] = mesh.attrs["DIM"] = 3
            step = mesh.create_group("-0000000000000000001-0000000000000000001")
            nodes = step.create_group("NOE")
            nodes["COO"] = scale * np.array(PLACES, dtype=float).T.reshape(-1)
            nodes["COO"].attrs["NBR"] = len(PLACES)
            family = np.zeros(len(PLACES), dtype=int)
            family[12] = 1
            nodes["FAM"] = family
            for kind, (members, families) in cells.items():
                group = step.create_group(f"MAI/{kind}")
                group["NOD"] = np.array(members).T.reshape(-1)
                group["NOD"].attrs["NBR"] = len(members)
                group["FAM"] = np.array(families)
            names = file.create_group(f"FAS/Mesh_{number + 1}")
            for kind, families in (("ELEME", FAMILIES), ("NOEUD", {1: ["SUMMIT"]})):
                for place, groups in families.items():
                    one = names.create_group(f"{kind}/FAM_{place}_{'_'.join(groups)}")
                    one.attrs["NUM"] = place
                    one.create_group("GRO").attrs["NBR"] = len(groups)
                    one["GRO"]["NOM"] = np.array([list(name.ljust(80, "\0").encode()) for name in groups],
                                                 dtype=np.int8)
    return path


class Med(unittest.TestCase):
    def test_a_mesh_with_its_groups(self):
        path = med_file(CELLS)
        properties = path.with_name("properties.yaml")
        properties.write_text(PROPERTIES)
        done = imported.command(path, "mm,t,s", "--properties", properties)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("CELLS HE8 2", done.stdout)
        scene = path.parent / "out" / "hall.yaml"
        words = by_hand(dict(enumerate(PLACES, 1)), {
            "body": ("brick", [BRICK, (5, 6, 7, 8, 9, 10, 11, 12)]), "side": ("wedge", [(2, 14, 3, 6, 15, 7)]),
            "tip": ("tetrahedron", [(9, 10, 11, 13)]), "roof": ("quadrangle", [(9, 10, 11, 12)]), "mast": ("line",
                                                                                                           [(9, 16)]),
            "top": ("point", [(16,)]), "base": ("quadrangle", [(1, 2, 3, 4)])},
            {"body_element": "hex8", "side_element": "wedge6", "tip_element": "tet4", "roof_element": "shell",
             "mast_element": "beam",
             **{f"{name}_material": "m" for name in ("body", "side", "tip", "roof", "mast")}, "roof_thickness": 0.2,
             "mast_section": "s", "top_element": "point_mass", "top_mass": 120, "clamp": "base",
             "-material_m_young": 30e9,
             "-material_m_poisson": 0.2, "-material_m_density": 2400, **imported.section("s", 0.04, 1e-4, 2e-4, 2e-4,
                                                                                         "1,0,0")})
        same(self, scene, words)
        for name in ("summit", "all"):
            self.assertIn(f'"{name}"', scene.with_suffix(".msh").read_text())

    def test_without_properties_it_says_so(self):
        done = imported.command(med_file(CELLS), "mm,t,s")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("a mesh and groups alone", done.stdout)

    def test_files_that_do_not_fit_themselves(self):
        """Families, counts and types that are not those of the cells, and data that lie in other files."""
        def changed(change):
            path = med_file(CELLS)
            with h5py.File(path, "r+") as file:
                mesh = file["ENS_MAA/Mesh_1"]
                change(mesh[next(iter(mesh))], path)
            return imported.command(path, "mm,t,s")

        def put(group, name, data, **attributes):
            del group[name]
            group[name] = data
            group[name].attrs.update(attributes)

        def linked(step, path):
            with h5py.File(path.with_name("other.med"), "w") as other:
                other["NOD"] = np.arange(1, 9)
            del step["MAI/HE8/NOD"]
            step["MAI/HE8/NOD"] = h5py.ExternalLink("other.med", "/NOD")

        def stored(step, path):
            path.with_name("raw").write_bytes(np.arange(1, 17, dtype="<i8").tobytes())
            del step["MAI/HE8/NOD"]
            step["MAI/HE8"].create_dataset("NOD", (16,), "<i8", external=[(str(path.with_name("raw")), 0, 128)])

        def virtual(step, path):
            del step["MAI/HE8/NOD"]
            layout = h5py.VirtualLayout(shape=(16,), dtype="<i8")
            layout[:] = h5py.VirtualSource(str(path.with_name("other.med")), "NOD", shape=(16,))
            step["MAI/HE8"].create_virtual_dataset("NOD", layout)

        for change, part in (
                (lambda step, _: put(step["MAI/HE8"], "FAM", [-1]), "has 2 nodes or cells, and families of 1"),
                (lambda step, _: put(step["MAI/HE8"], "FAM", [-1, -77]), "has family -77, which is not in the file"),
                (lambda step, _: put(step["NOE"], "FAM", [0] * 5), "and families of 5"),
                (lambda step, _: put(step["MAI/HE8"], "NOD", list(range(1, 9)), NBR=2), "2 cells HE8 have 8 nodes"),
                (lambda step, _: put(step["MAI/HE8"], "NOD", np.arange(1, 17) + 0.5), "has no whole numbers"),
                (linked, "NOD lies in another file"), (stored, "NOD lie in another file"),
                (virtual, "NOD lie in another file")):
            with self.subTest(part):
                done = changed(change)
                self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stdout + done.stderr)
                self.assertIn(part, done.stderr)

    def test_losses_and_files_that_are_none(self):
        quadratic = med_file({**CELLS, "H20": ([list(range(1, 17)) + [1, 2, 3, 4]], [-1])})
        done = imported.command(quadratic, "mm,t,s")
        self.assertEqual(done.returncode, 1)
        self.assertIn("CELLS H20 1, MID-SIDE NODES THAT OTHERS USE 8 would be lost", done.stderr)
        done = imported.command(med_file(CELLS, meshes=2), "mm,t,s")
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        self.assertIn("2 meshes (Mesh_1, Mesh_2)", done.stderr)
        done = imported.command(med_file({"HE8": ([(1, 2, 3, 4, 5, 6, 7, 99)], [-1])}), "mm,t,s")
        self.assertIn("nodes that are not there", done.stderr)
        refused(self, "hall.med", "*NODE\n", "not a mesh of MED")
        refused(self, "hall.med", med_file(CELLS).read_bytes()[:3000], "not a mesh of MED")

    @unittest.skipUnless(meshio, "python3-meshio is not there")
    def test_a_file_that_meshio_writes(self):
        path = Path(tempfile.mkdtemp(prefix="pounding-import-"), "hall.med")
        mesh = meshio.Mesh(np.array(PLACES, dtype=float), [("hexahedron", [[n - 1 for n in BRICK]]), ("quad",
                                                                                                      [[0, 1, 2, 3]])],
                           cell_data={"cell_tags": [np.array([-1]), np.array([-2])]})
        mesh.cell_tags = {-1: ["BODY"], -2: ["BASE"]}
        meshio.write(path, mesh)
        properties = path.with_name("properties.yaml")
        properties.write_text("hall: {body: {element: hex8, material: C30}, clamp: base}\n")
        done = imported.command(path, "m,kg,s", "--properties", properties)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        words = by_hand(dict(enumerate(PLACES[:8], 1)), {"body": ("brick", [BRICK]), "base": ("quadrangle", [(1, 2, 3,
                                                                                                              4)])},
                        {"body_element": "hex8", "body_material": "C30", "clamp": "base"})
        same(self, path.parent / "out" / "hall.yaml", words)


if __name__ == "__main__":
    unittest.main()
