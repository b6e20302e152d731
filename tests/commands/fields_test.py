"""model.xdmf, modes.xdmf and fields.xdmf: what ParaView is shown is the model and its motion, the same on
any number of ranks and after a restart."""
import os
import shutil
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

import program
import xdmf_file

PROCESSORS = 2  # killed runs

PAIR = [*program.COARSE_PAIR, "-modes", 3]
# The first structure hits the second at once, in both floors; a probe on one node of it.
STRUCK = [*program.COARSE_PAIR, "-modes", 0, "-s1_floor2_at", "3.36,0,5.22", "-s1_initial_velocity", "1.5,0,0", "-end_time", 0.04, "-fields_interval", 0.002]
OWN = {"s1": 7, "s2": 7}  # groups of the structures


def arrays(path):
    """All datasets of a file by name."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def frames_in(path):
    """Whole frames of a file, which may not be there yet."""
    try:
        with h5py.File(path, "r") as file:
            return int(file["frames"][0])
    except OSError:
        return 0


def exactly(test, one, other, but=()):
    test.assertEqual(one.keys(), other.keys())
    for name, values in one.items():
        if name.rpartition("/")[2] not in but:
            np.testing.assert_array_equal(values, other[name], err_msg=name)


class Pictures(unittest.TestCase):
    def folder(self):
        path = tempfile.mkdtemp(prefix="pounding-fields-")
        self.addCleanup(shutil.rmtree, path)
        return path

    def run_in(self, folder, arguments, ranks=2, status=0):
        result = program.run([*arguments, "-output", folder], ranks)
        self.assertEqual(result.returncode, status, result.stdout[-2000:] + result.stderr[-2000:])
        return result

    def run_fresh(self, arguments, ranks=2):
        folder = self.folder()
        self.run_in(folder, arguments, ranks)
        return folder

    def read_as_paraview(self, path, time=None):
        """The grids of both of VTK's readers; skips where no package brings them."""
        readers = xdmf_file.vtk_readers()
        if not readers:
            self.skipTest("no VTK with readers of XDMF (Debian's python3-paraview has them)")
        self.readers = [reader() for reader in readers]  # they own the arrays
        return [xdmf_file.vtk_blocks(reader, path, time) for reader in self.readers]

    def compare_with_vtk(self, grid, block):
        points, cells, types, point_data, cell_data = xdmf_file.vtk_grid(block)
        np.testing.assert_array_equal(points, grid.points)
        self.assertEqual(cells, grid.cells)
        self.assertEqual(types, grid.types)
        for own, theirs in ((grid.point_data, point_data), (grid.cell_data, cell_data)):
            self.assertLessEqual(own.keys(), theirs.keys())
            for name, values in own.items():
                np.testing.assert_array_equal(theirs[name], values, err_msg=name)


class Model(Pictures):
    WHOLE = [*PAIR, "-dry_run", "-write_model", "-write_modes"]

    @classmethod
    def setUpClass(cls):
        cls.output = tempfile.mkdtemp(prefix="pounding-model-")
        cls.addClassCleanup(shutil.rmtree, cls.output)
        result = program.run([*cls.WHOLE, "-output", cls.output], 2)
        assert result.returncode == 0, result.stderr
        cls.printed = result.stdout
        (_, cls.grids), = xdmf_file.read(os.path.join(cls.output, "model.xdmf"))

    def test_it_comes_before_anything_is_computed(self):
        self.assertLess(self.printed.index("model.xdmf"), self.printed.index("omega_max"))
        self.assertEqual(sorted(os.listdir(self.output)), ["model.h5", "model.xdmf", "modes.h5", "modes.xdmf"])

    def test_cells_are_those_of_the_groups(self):
        numbers = dict(reversed(note.split()) for note in self.grids["s1"].notes["groups"].split(", "))
        self.assertEqual(len(numbers), sum(OWN.values()))
        for name, faces in (("s1", 35), ("s2", 25)):
            grid = self.grids[name]
            group, types = grid.cell_data["group"], np.array(grid.types)
            np.testing.assert_array_equal(types == 12, group == int(numbers[name + ":slab"]))
            self.assertEqual((types == 12).sum(), 2 * faces)
            np.testing.assert_array_equal(types == 4, group != int(numbers[name + ":slab"]))
            beams = group == int(numbers[name + ":column"])
            self.assertAlmostEqual(max(grid.cell_data["area"][beams]), {"s1": 34.01e-4, "s2": 38.77e-4}[name])
            self.assertEqual(set(grid.cell_data["young"][types == 12]), {30e9})
            self.assertEqual(set(grid.cell_data["rank"]), {0, 1})
            # A hexahedron's volume from its corners: nodes go round the lower face, then the upper one.
            x = grid.points[np.array([cell for cell, kind in zip(grid.cells, grid.types) if kind == 12])]
            edges = x[:, [1, 3, 4]] - x[:, :1]
            volumes = np.linalg.det(edges)
            sides = {"s1": (3.36, 2.28), "s2": (2.16, 2.28)}[name]
            self.assertGreater(min(volumes), 0)
            self.assertAlmostEqual(sum(volumes), 2 * np.prod(sides) * (max(x[0, :, 2]) - min(x[0, :, 2])), places=2)

    def test_supports_contacts_and_probes_are_where_they_are(self):
        for name in ("s1", "s2"):
            grid = self.grids[name]
            np.testing.assert_array_equal(grid.point_data["clamped"] == 7, grid.points[:, 2] < 1e-9)
        pairs = self.grids["contacts"]
        self.assertEqual(pairs.notes["contacts"], "1 floor1, 2 floor2")
        self.assertEqual(set(pairs.types), {4})
        ends = pairs.points[np.array(pairs.cells)]
        along = ends[:, 1] - ends[:, 0]
        np.testing.assert_allclose(along[:, 1:], 0, atol=1e-9)
        self.assertEqual(len(set(np.round(along[:, 0], 9))), 1)  # as the meshes stand; the gap is another
        floor2 = pairs.cell_data["contact"] == 2
        y = ends[floor2, 0, 1]
        np.testing.assert_allclose(pairs.cell_data["initial_gap"][floor2], 0.025 - 0.005 * y / 2.28, atol=1e-9)
        touched = self.grids["s1"].point_data["contact_floor2"] == 1
        self.assertEqual(sorted(map(tuple, self.grids["s1"].points[touched])), sorted(map(tuple, ends[floor2, 0])))
        probes = self.grids["probes"]
        self.assertEqual(probes.notes["probes"], "1 s1_floor1, 2 s1_floor2, 3 s2_floor1, 4 s2_floor2")
        np.testing.assert_array_equal(np.bincount(probes.cell_data["probe"]), [0, 4, 4, 4, 4])

    def test_it_is_the_same_on_any_number_of_ranks_and_in_a_run(self):
        known = arrays(os.path.join(self.output, "model.h5"))
        for ranks in (1, 3):
            folder = self.run_fresh([*PAIR, "-dry_run", "-write_model"], ranks)
            exactly(self, known, arrays(os.path.join(folder, "model.h5")), but=("rank",))
            self.assertEqual(sorted(os.listdir(folder)), ["model.h5", "model.xdmf"])
        folder = self.run_fresh([*PAIR, "-write_model", "-end_time", 1e-4])
        exactly(self, known, arrays(os.path.join(folder, "model.h5")))

    def test_modes_are_the_shapes_on_the_mesh(self):
        (_, grids), = xdmf_file.read(os.path.join(self.output, "modes.xdmf"))
        with h5py.File(os.path.join(self.output, "modes.h5"), "r") as file:
            for name in ("s1", "s2"):
                self.assertEqual(grids[name].cells, self.grids[name].cells)
                self.assertEqual(grids[name].notes["frequencies [Hz]"],
                                 " ".join(f"{value:.4g}" for value in file[name]["frequencies"]))
                for mode in (1, 2, 3):
                    np.testing.assert_array_equal(grids[name].point_data[f"mode_{mode:04d}"],
                                                  file[name][f"shapes/{mode:04d}"][:, :3])

    def test_paraview_reads_the_same(self):
        for file in ("model", "modes"):
            path = os.path.join(self.output, file + ".xdmf")
            (_, grids), = xdmf_file.read(path)
            for blocks, times in self.read_as_paraview(path):
                self.assertEqual(blocks.keys(), grids.keys())
                self.assertEqual(times, [])
                for name, grid in grids.items():
                    self.compare_with_vtk(grid, blocks[name])


class Fields(Pictures):
    @classmethod
    def setUpClass(cls):
        cls.output = tempfile.mkdtemp(prefix="pounding-fields-")
        cls.addClassCleanup(shutil.rmtree, cls.output)
        result = program.run([*STRUCK, "-output", cls.output], 2)
        assert result.returncode == 0, result.stderr
        cls.printed = result.stdout
        cls.path = os.path.join(cls.output, "fields.xdmf")
        cls.frames = xdmf_file.read(cls.path)

    def test_frames_hold_what_the_history_holds_to_the_bit(self):
        self.assertEqual(len(self.frames), 21)
        self.assertIn("fields for ParaView: 21 frames", self.printed)
        with h5py.File(os.path.join(self.output, "history.h5"), "r") as file:
            column = [name.decode().strip("\0 ") for name in file["channels"]].index("s1_floor2.x")
            times = file["time"][()]
            for quantity in ("displacement", "velocity"):
                recorded = file[quantity][:, column:column + 3]
                self.assertGreater(abs(recorded).max(), 0)
                for time, grids in self.frames:
                    row, = np.flatnonzero(times == time)
                    grid = grids["s1"]
                    node = np.linalg.norm(grid.points - (3.36, 0, 5.22), axis=1).argmin()
                    np.testing.assert_array_equal(grid.point_data[quantity][node], recorded[row])

    def test_impulses_are_those_of_the_impacts(self):
        total = program.summary(self.output)["impacts"]["total_impulse"]
        self.assertGreater(total, 100)
        sums = {name: sum(grids[name].point_data["contact_impulse"].sum(axis=0) for _, grids in self.frames)
                for name in ("s1", "s2")}
        self.assertAlmostEqual(sums["s2"][0] / total, 1, delta=1e-12)
        self.assertAlmostEqual(sums["s1"][0] / total, -1, delta=1e-12)
        for _, grids in self.frames:
            for name in ("s1", "s2"):
                data = grids[name].point_data
                struck = abs(data["contact_impulse"]).max(axis=1) > 0
                self.assertTrue(np.all((data["contact_floor1"] + data["contact_floor2"])[struck] == 1))

    def test_clamped_nodes_stand_and_rotations_are_those_of_the_beams(self):
        for _, grids in self.frames:
            for grid in grids.values():
                self.assertEqual(abs(grid.point_data["displacement"][grid.point_data["clamped"] == 7]).max(), 0)
        grid = self.frames[-1][1]["s1"]
        of_beams = {node for cell, kind in zip(grid.cells, grid.types) if kind == 4 for node in cell}
        turning = set(np.flatnonzero(abs(grid.point_data["rotation"]).max(axis=1)))
        self.assertTrue(turning and turning <= of_beams)

    def test_one_two_and_three_ranks_write_the_same_file(self):
        known = arrays(os.path.join(self.output, "fields.h5"))
        frames = [f"{number:06d}" for number in range(len(self.frames))]
        for ranks in (1, 3):
            other = arrays(os.path.join(self.run_fresh(STRUCK, ranks), "fields.h5"))
            exactly(self, known, other, but=("rank", *frames))
            for name, values in known.items():
                if name.rpartition("/")[2] in frames:
                    np.testing.assert_allclose(other[name], values, atol=1e-9 * abs(values).max(), rtol=0)

    def test_the_run_is_the_same_without_them(self):
        folder = self.run_fresh(STRUCK[:-2])
        for name in ("fields.h5", "fields.xdmf"):
            self.assertFalse(os.path.exists(os.path.join(folder, name)))
        exactly(self, arrays(os.path.join(self.output, "history.h5")), arrays(os.path.join(folder, "history.h5")))

    def test_a_part_of_the_run(self):
        folder = self.run_fresh([*STRUCK, "-fields_start", 0.01, "-fields_end", 0.02])
        frames = xdmf_file.read(os.path.join(folder, "fields.xdmf"))
        self.assertEqual(len(frames), 6)
        time = frames[0][0]
        self.assertGreaterEqual(time, 0.01 - 1e-9)
        self.assertLess(time, 0.01 + 6e-5)
        self.assertLessEqual(frames[-1][0], 0.02 + 1e-9)
        program.must_refuse(self, [*STRUCK, "-fields_start", 0.05], "-fields_start", "end of the run")

    def test_a_continued_run_has_the_frames_of_an_uninterrupted_one(self):
        folder = self.run_fresh([*STRUCK, "-checkpoint_steps", 700])
        known = arrays(os.path.join(self.output, "fields.h5"))
        exactly(self, known, arrays(os.path.join(folder, "fields.h5")))
        checkpoint = os.path.join(folder, "checkpoint.h5")
        elsewhere = self.folder()
        self.run_in(elsewhere, [*STRUCK, "-restart", checkpoint])
        self.run_in(folder, [*STRUCK, "-restart", checkpoint])
        for path in (folder, elsewhere):
            exactly(self, known, arrays(os.path.join(path, "fields.h5")))
            with open(os.path.join(path, "fields.xdmf")) as one, open(self.path) as other:
                self.assertEqual(one.read(), other.read())
        lost = next(name for name in known if name.endswith("velocity/000001"))
        with h5py.File(os.path.join(elsewhere, "fields.h5"), "r+") as file:
            del file[lost]
        for name in ("checkpoint.h5", "history.h5"):
            shutil.copy(os.path.join(folder, name), elsewhere)
        program.must_refuse(self, [*STRUCK, "-restart", os.path.join(elsewhere, "checkpoint.h5"), "-output", elsewhere],
                            "the fields cannot be continued", lost)
        os.remove(os.path.join(folder, "fields.h5"))
        before = arrays(os.path.join(folder, "history.h5"))
        line = program.must_refuse(self, [*STRUCK, "-restart", checkpoint, "-output", folder], "fields.h5", "no such file")
        self.assertIn("cannot be continued", line)
        exactly(self, before, arrays(os.path.join(folder, "history.h5")))

    def test_a_longer_run_goes_on_from_a_shorter_one(self):
        half = [*STRUCK, "-end_time", 0.02, "-checkpoint_steps", 700]
        folder = self.run_fresh(half)
        self.run_in(folder, [*STRUCK, "-restart", os.path.join(folder, "checkpoint.h5")])
        exactly(self, arrays(os.path.join(self.output, "fields.h5")), arrays(os.path.join(folder, "fields.h5")))

    def small_disk(self, size):
        folder = self.folder()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=" + size, "none", folder], capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small file system")
        self.addCleanup(subprocess.run, ["umount", "--lazy", folder], check=True)
        return folder

    def test_what_the_disk_has_no_room_for_is_refused(self):
        folder = self.small_disk("400k")
        program.must_refuse(self, [*STRUCK, "-output", folder], "-fields_interval: 21 frames take up to", "left")
        self.assertNotIn("fields.h5", os.listdir(folder))

    def test_a_disk_that_fills_up_leaves_whole_frames(self):
        folder = self.small_disk("8m")
        arguments = [*STRUCK, "-end_time", 30, "-fields_interval", 0.3, "-output_interval", 1e-2, "-output", folder]
        process = subprocess.Popen(program.words(arguments, 2), cwd=program.SOURCE, env=program.ENVIRONMENT, text=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        path = os.path.join(folder, "fields.h5")
        while process.poll() is None and frames_in(path) < 2:
            time.sleep(0.01)
        with open(os.path.join(folder, "filler"), "wb", buffering=0) as file:
            try:
                while process.poll() is None:
                    file.write(bytes(1 << 16))
            except OSError:
                pass
        _, said = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0, said)
        lines = [line for line in said.splitlines() if line.startswith("pounding: ")]
        self.assertEqual(len(lines), 1, said)
        self.assertIn("is the disk full?", lines[0])
        os.remove(os.path.join(folder, "filler"))
        with h5py.File(path, "r") as file:
            frames = int(file["frames"][0])
            self.assertGreaterEqual(frames, 2)
            self.assertLess(frames, 101)
            for frame in range(1, frames):
                self.assertGreater(abs(file["s1/displacement"][f"{frame:06d}"][()]).max(), 0)

    def test_reduced_structures_are_shown_at_every_node(self):
        # One basis for all: that of two ranks may have other last digits the next time.
        basis = os.path.join(self.enterContext(tempfile.TemporaryDirectory()), "basis.h5")
        modal = ["-s1_model", "modal", "-s1_modal_vectors", 30, "-s1_modal_candidates", 60, "-s1_modal_basis", basis]
        folders = [self.run_fresh([*STRUCK, *modal], ranks) for ranks in (2, 1)]
        frames, alone = [xdmf_file.read(os.path.join(folder, "fields.xdmf")) for folder in folders]
        with h5py.File(os.path.join(folders[0], "history.h5"), "r") as file:
            column = [name.decode().strip("\0 ") for name in file["channels"]].index("s1_floor2.x")
            rows = np.flatnonzero(np.isin(file["time"][()], [time for time, _ in frames]))
            recorded = {name: file[name][()][rows, column:column + 3] for name in ("displacement", "velocity")}
        for number, (_, grids) in enumerate(frames):
            grid = grids["s1"]
            self.assertNotIn("rotation", grid.point_data)
            self.assertIn("rotation", grids["s2"].point_data)
            node = np.linalg.norm(grid.points - (3.36, 0, 5.22), axis=1).argmin()
            for name, values in recorded.items():
                np.testing.assert_array_equal(grid.point_data[name][node], values[number])
            whole = grid.point_data["displacement"]
            np.testing.assert_allclose(alone[number][1]["s1"].point_data["displacement"], whole,
                                       atol=1e-8 * max(abs(whole).max(), 1e-6), rtol=0)
            self.assertEqual(abs(whole[grid.point_data["clamped"] == 7]).max(), 0)
        # In its modes the structure moves as it does at full order, to what thirty of them leave out.
        full = self.frames[10][1]["s1"].point_data["displacement"]
        reduced = frames[10][1]["s1"].point_data["displacement"]
        self.assertLess(np.linalg.norm(reduced - full), 0.02 * np.linalg.norm(full))
        without = self.run_fresh([*STRUCK[:-2], *modal])
        shown, hidden = [arrays(os.path.join(folder, "history.h5")) for folder in (folders[0], without)]
        # A recorded velocity of a reduced structure may have another last digit beside frames, one of 10,716 here.
        for name in ("velocity", "acceleration"):
            values = shown.pop(name)
            np.testing.assert_allclose(hidden.pop(name), values, rtol=0, atol=1e-15 * abs(values).max(), err_msg=name)
        exactly(self, shown, hidden)

    def test_paraview_reads_the_same(self):
        for number in (0, 7, 20):
            time, grids = self.frames[number]
            for blocks, times in self.read_as_paraview(self.path, time):
                self.assertEqual(times, [frame for frame, _ in self.frames])
                self.assertEqual(blocks.keys(), grids.keys())
                for name, grid in grids.items():
                    self.compare_with_vtk(grid, blocks[name])


if __name__ == "__main__":
    unittest.main()
