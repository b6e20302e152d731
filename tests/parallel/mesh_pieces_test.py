"""Runs on meshes that were cut before are those on whole meshes, to the bit; pieces of anything else are refused."""
import json
import os
import pathlib
import shutil
import tempfile
import unittest

import h5py
import numpy

import program

PLANT = "petsc-options/plant/"
SHORT = ["-modes", 0, "-spectra_frequencies", "1:100:10log", "-energy_interval", 7]


def plant(name, *more):
    return ["-options_file", PLANT + name, *more]


def column(*more):
    return ["-structures", "s", "-s_mesh", "tests/meshes/column.geo", "-s_rock_element", "hex8", "-s_rock_material",
            "g", "-s_soil_element", "hex8", "-s_soil_material", "g", "-material_g_young", 2e8, "-material_g_poisson",
            0.3, "-material_g_density", 2000, "-s_initial_velocity", "1,0,0", *more]


def tied(*more):
    return ["-structures", "t", "-t_mesh", "tests/meshes/tied_blocks.geo", "-t_first_element", "hex8",
            "-t_first_material", "c", "-t_second_element", "hex8", "-t_second_material", "c", "-material_c_young", 3e10,
            "-material_c_poisson", 0.2, "-material_c_density", 2500, "-t_clamp", "x_min", "-t_tie", "edge:face", *more]


SCENES = {
    # Shells, beams, bars, cabinets, springs spread over areas; contacts that close.
    "pair": plant("small.yaml", "-end_time", 0.3, "-floor1_gap", 0, "-floor2_gap", 1e-6),
    "bricks and openings": plant("shaft.yaml", "-end_time", 0.1, "-joint_gap", 1e-7),
    "soil under a mat, supports": plant("layered_soil.yaml", "-block_mesh_set", "m=1", "-frame_mesh_set",
                                        "m=1,x0=24.801", "-end_time", 0.05),
    "yielding, wall, at rest": plant("moat.yaml", "-end_time", 0.05),
    "lifting off": plant("standing.yaml", "-block_mesh_set", "m=1", "-frame_mesh_set", "m=1,x0=24.801", "-end_time", 0.05),
    "sliding, filler, friction": program.COARSE_PAIR + [
        "-motion_x_pga", 6, "-motion_x_envelope", "0.2,20", "-end_time", 0.3, "-floor2_sliding", 0.5, "-floor2_friction",
        0.3, "-floor1_filler", "0.3:1e4,0.8:5e4", "-floor1_filler_unloading", 5e5, "-gravity", 9.81],
    "absorbing": column("-s_absorbing", "bottom,sides", "-end_time", 0.05),
    "tied": tied("-t_initial_velocity", "1,0,0", "-end_time", 1e-3, "-forces", "f", "-f_structure", "t", "-f_kind",
                 "reactions"),
}


def cut(test, scene, ranks, folder, on=1):
    result = program.must_end(test, [*scene, "-mesh_pieces", folder, "-write_mesh_pieces", ranks], on)
    return result.stdout


def contents(folder):
    """All that a run left, but what tells of times and places."""
    found = {}
    for name in ("impacts.csv", "energy.csv", "spectra.csv", "forces.csv"):
        path = pathlib.Path(folder, name)
        if path.is_file():
            found[name] = path.read_text()
    with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
        file.visititems(lambda name, item: found.__setitem__(name, item[()]) if isinstance(item, h5py.Dataset) else None)
    return found


def same(one, other):
    """To the bit, with numbers that are none."""
    if isinstance(one, numpy.ndarray) and one.dtype.kind == "f":
        return one.shape == other.shape and one.tobytes() == other.tobytes()
    return numpy.array_equal(one, other)


def report(text):
    """Lines of the printed report that say what the model is."""
    lines = text.splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith("structure "))
    end = next(i for i, line in enumerate(lines) if line.startswith("expected wall time"))
    return lines[begin:end]


class Same(unittest.TestCase):
    def compare(self, name, ranks):
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            scene = [*SCENES[name], *SHORT, "-csv_digits", 17]
            scene += ["-partition", "elements"] if ranks > 1 else []
            cut(self, scene, ranks, f"{place}/pieces")
            runs = []
            for folder, more in (("whole", []), ("pieces", ["-mesh_pieces", f"{place}/pieces"])):
                result = program.must_end(self, [*scene, *more, "-output", f"{place}/{folder}-results"], ranks)
                left = contents(f"{place}/{folder}-results")
                runs.append((report(result.stdout), left, program.summary(f"{place}/{folder}-results")))
        (said, whole, whole_summary), (said_in_pieces, pieces, summary) = runs
        self.assertEqual(said, said_in_pieces, (name, ranks))
        self.assertEqual(sorted(whole), sorted(pieces))
        for item, values in whole.items():
            self.assertTrue(same(values, pieces[item]), (name, ranks, item))
        for item in ("partition", "structures", "impacts", "warnings", "time_step", "energy"):
            self.assertEqual(json.dumps(whole_summary.get(item)), json.dumps(summary.get(item)), (name, ranks, item))
        return summary

    def test_gmsh_has_no_work(self):
        """By the memory of all processes that a rank has started."""
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            scene = [*SCENES["pair"], *SHORT, "-partition", "elements"]
            scene += ["-mesh_pieces", f"{place}/pieces"]
            program.well_ended(self, program.launch([*scene, "-write_mesh_pieces", 2], 1))
            for more, works in ((["-mesh_pieces", "none"], True), ([], False)):
                program.well_ended(self, program.launch([*scene, *more, "-output", f"{place}/results"], 2))
                self.assertEqual(program.summary(f"{place}/results")["memory"]["mesher"] > 0, works)

    def test_every_scene_on_two_ranks(self):
        touched = 0
        for name in SCENES:
            with self.subTest(name):
                impacts = self.compare(name, 2)["impacts"]
                touched += sum(contact.get("episodes", 0) for contact in impacts.values() if isinstance(contact, dict))
        self.assertGreater(touched, 3)

    def test_on_one_and_three_ranks(self):
        for name, ranks in (("pair", 1), ("pair", 3), ("tied", 3), ("soil under a mat, supports", 3)):
            with self.subTest(name, ranks=ranks):
                self.compare(name, ranks)


class Refused(unittest.TestCase):
    SCENE = [*plant("small.yaml", "-end_time", 1e-3, *SHORT), "-partition", "elements"]

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.mkdtemp(prefix="pounding-")
        cls.pieces = cls.place + "/pieces"
        cls.said = cut(unittest.TestCase(), [*cls.SCENE, "-output", cls.place + "/nothing"], 2, cls.pieces)

    def run_on(self, folder, *more, ranks=2):
        words = [*self.SCENE, "-mesh_pieces", folder, "-output", self.place + "/out", *more]
        return program.run(words, ranks)

    def refuse(self, folder, *parts, more=(), ranks=2):
        program.must_refuse(self, [*self.SCENE, "-mesh_pieces", folder, "-output", self.place + "/out", *more],
                            "-mesh_pieces", *parts, ranks=ranks)

    def copy(self):
        folder = tempfile.mkdtemp(dir=self.place)
        return shutil.copytree(self.pieces, folder, dirs_exist_ok=True)

    def test_it_says_what_it_wrote(self):
        self.assertIn("pieces: 2 in ", self.said)
        self.assertEqual(sorted(os.listdir(self.pieces)), ["common.piece", "piece-00000.bin", "piece-00001.bin"])
        self.assertFalse(os.path.exists(self.place + "/nothing"), "a run's results")

    def test_the_same_pieces_however_many_ranks_cut(self):
        other = self.place + "/by_two"
        cut(self, self.SCENE, 2, other, on=2)
        for name in ("piece-00000.bin", "piece-00001.bin"):
            self.assertEqual(pathlib.Path(self.pieces, name).read_bytes(), pathlib.Path(other, name).read_bytes(), name)

    def test_what_leaves_the_meshes_alone_may_change(self):
        for more in (["-motion_level", 2], ["-motion_x_seed", 7], ["-courant", 0.5], ["-end_time", 2e-3],
                     ["-spectra_frequencies", "1:50:5log"], ["-fields_interval", 1e-3], ["-write_model", "true"]):
            self.assertEqual(self.run_on(self.pieces, *more).returncode, 0, more)

    def test_another_model_is_refused(self):
        for option, value in (("block_mesh_set", "m=2"), ("floor1_gap", 0.01), ("floor1_friction", 0.2),
                              ("gravity", 9.81), ("frame_roof_thickness", 0.3), ("block_damping_uniform", 0.05),
                              ("partition", "structures"), ("frame_mass_scaling", 1e-4)):
            with self.subTest(option):
                self.refuse(self.pieces, f"another model (option {option})", more=[f"-{option}", value])
        self.refuse(self.pieces, "another model (option motion_z)", more=["-motion_z_target", "", "-motion_z_record", "none"])
        self.refuse(self.pieces, "another model (option structures)", more=["-structures", "block", "-contacts", "none", "-probes", "none"])

    def test_another_geometry_under_the_same_name_is_refused(self):
        folder = tempfile.mkdtemp(dir=self.place)
        geometry = shutil.copy(os.path.join(program.SOURCE, "tests/meshes/column.geo"), folder)
        scene = [*column("-end_time", 1e-3, "-modes", 0), "-s_mesh", geometry, "-partition", "elements"]
        cut(self, scene, 2, f"{folder}/pieces")
        words = [*scene, "-mesh_pieces", f"{folder}/pieces", "-output", f"{folder}/out"]
        self.assertEqual(program.run(words, 2).returncode, 0)
        moved = shutil.move(geometry, f"{folder}/moved.geo")
        self.assertEqual(program.run([*words, "-s_mesh", moved], 2).returncode, 0, "its name says nothing")
        with open(moved, "a") as file:
            file.write("// another\n")
        program.must_refuse(self, [*words, "-s_mesh", moved], "another model (mesh of s)")

    def test_another_file_that_the_geometry_takes_in_is_refused(self):
        """Whatever its name is made of; also where geometry and pieces were moved together."""
        folder = tempfile.mkdtemp(dir=self.place)
        shutil.copy(os.path.join(program.SOURCE, "tests/meshes/column.geo"), f"{folder}/inner.geo")
        pathlib.Path(folder, "outer.geo").write_text('name = "inn";\nInclude StrCat(name, "er.geo");\n')
        scene = [*column("-end_time", 1e-3, "-modes", 0), "-partition", "elements"]
        cut(self, [*scene, "-s_mesh", f"{folder}/outer.geo"], 2, f"{folder}/pieces")
        moved = shutil.copytree(folder, f"{folder}-moved")
        words = [*scene, "-s_mesh", f"{moved}/outer.geo", "-mesh_pieces", f"{moved}/pieces"]
        self.assertEqual(program.run([*words, "-output", f"{moved}/out"], 2).returncode, 0)
        with open(f"{moved}/inner.geo", "a") as file:
            file.write("// another\n")
        program.must_refuse(self, words, "another model (inner.geo, of which the mesh of s is made)")

    def test_another_number_of_ranks_is_refused(self):
        for ranks in (1, 3):
            self.refuse(self.pieces, "cut for 2 ranks, and this run has", f"-write_mesh_pieces {ranks}", ranks=ranks)

    def test_no_half_of_a_cut_is_taken_for_a_whole(self):
        for name in ("common.piece", "piece-00001.bin"):
            folder = self.copy()
            os.remove(os.path.join(folder, name))
            self.refuse(folder, name, "is not there")
        self.refuse(self.place + "/none", "is not there", "-write_mesh_pieces")

    def test_damage_is_refused(self):
        for name in ("common.piece", "piece-00000.bin", "piece-00001.bin"):
            for change in (lambda data: data[:-9], lambda data: data[:900] + b"\x55" + data[901:], lambda data: b"",
                           lambda data: data + b"\0"):
                folder = self.copy()
                path = pathlib.Path(folder, name)
                data = path.read_bytes()
                path.write_bytes(change(data))
                if path.read_bytes() != data:
                    self.refuse(folder, name)

    def test_pieces_of_two_cuts_are_not_mixed(self):
        other = self.place + "/other"
        cut(self, [*self.SCENE, "-floor1_gap", 0.01], 2, other)
        folder = self.copy()
        shutil.copy(f"{other}/piece-00001.bin", folder)
        self.refuse(folder, "piece-00001.bin", "of another cut")

    def test_an_earlier_cut_is_removed_and_nothing_else(self):
        folder = self.copy()
        notes = pathlib.Path(folder, "notes.bin")
        notes.write_text("mine")
        cut(self, self.SCENE, 1, folder)
        self.assertEqual(sorted(os.listdir(folder)), ["common.piece", "notes.bin", "piece-00000.bin"])

    def test_words_that_do_not_go_together(self):
        program.must_refuse(self, [*self.SCENE, "-write_mesh_pieces", 2], "-write_mesh_pieces", "-mesh_pieces")
        program.must_refuse(self, [*self.SCENE, "-mesh_pieces", self.pieces, "-write_mesh_pieces", 2, "-dry_run"],
                            "not with -dry_run")
        program.must_refuse(self, [*self.SCENE, "-mesh_pieces", self.place + "/many", "-write_mesh_pieces", 99999],
                            "-write_mesh_pieces 99999: more than the meshes have elements")
        self.refuse(self.pieces, "a structure is reduced", more=["-frame_model", "modal", "-frame_modal_vectors", 5])

    def test_a_run_on_pieces_continues_one_on_whole_meshes(self):
        folder = self.place + "/continued"
        first = program.must_end(self, [*self.SCENE, "-checkpoint_steps", 5, "-output", folder], 2)
        result = program.must_end(self, [*self.SCENE, "-mesh_pieces", self.pieces, "-end_time", 3e-3, "-restart",
                                         f"{folder}/checkpoint.h5", "-output", folder], 2)
        through = program.must_run(self, [*self.SCENE, "-end_time", 3e-3], 2)[0]
        for name, values in contents(through).items():
            if not isinstance(values, str):
                self.assertTrue(same(values, contents(folder)[name]), name)


if __name__ == "__main__":
    unittest.main()
