"""fields.vtkhdf: the frames of fields.h5 for ParaView without a second copy, the same as those of fields.xdmf, whole when
the run is killed, and read by VTK's own reader where one is installed that knows time."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

import program
import vtkhdf_file
import xdmf_file

PROCESSORS = 2  # killed runs

STRUCK = [*program.COARSE_PAIR, "-modes", 0, "-s1_floor2_at", "3.36,0,5.22", "-s1_initial_velocity", "1.5,0,0", "-end_time", 0.02,
          "-fields_interval", 0.002]
XDMF_TYPES = {2: 1, 4: 3}  # polyvertex and polyline


class Steps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.output = tempfile.mkdtemp(prefix="pounding-vtkhdf-")
        cls.addClassCleanup(shutil.rmtree, cls.output)
        result = program.run([*STRUCK, "-checkpoint_steps", 200, "-output", cls.output], 2)
        assert result.returncode == 0, result.stderr
        cls.path = os.path.join(cls.output, "fields.vtkhdf")
        cls.steps = vtkhdf_file.read(cls.path)

    def run_fresh(self, arguments, ranks=2):
        folder = tempfile.mkdtemp(prefix="pounding-vtkhdf-")
        self.addCleanup(shutil.rmtree, folder)
        result = program.run([*arguments, "-output", folder], ranks)
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        return folder

    def compare(self, one, other, but=(), tolerance=0.0):
        self.assertEqual([step for step, _ in one], [step for step, _ in other])
        for (_, parts), (_, others) in zip(one, other):
            for part, known in zip(parts, others, strict=True):
                np.testing.assert_array_equal(part.points, known.points)
                self.assertEqual(part.cells, known.cells)
                self.assertEqual(part.types, known.types)
                for own, theirs in ((part.point_data, known.point_data), (part.cell_data, known.cell_data)):
                    self.assertEqual(own.keys(), theirs.keys())
                    for name in own.keys() - set(but):
                        np.testing.assert_allclose(own[name], theirs[name], rtol=0, err_msg=name,
                                                   atol=tolerance * max(abs(theirs[name]).max(), 1e-6))

    def test_every_step_is_that_of_the_xdmf_file_to_the_bit(self):
        frames = xdmf_file.read(os.path.join(self.output, "fields.xdmf"))
        self.assertEqual(len(frames), 11)
        self.assertEqual([step for step, _ in self.steps], [frame for frame, _ in frames])
        for (_, parts), (_, grids) in zip(self.steps, frames):
            for part, name in zip(parts, ("s1", "s2"), strict=True):
                grid = grids[name]
                np.testing.assert_array_equal(part.points, grid.points)
                self.assertEqual(part.cells, grid.cells)
                self.assertEqual(part.types, [XDMF_TYPES.get(kind, kind) for kind in grid.types])
                self.assertEqual(part.cell_data.keys(), grid.cell_data.keys())
                self.assertLessEqual(grid.point_data.keys(), part.point_data.keys())
                for own, theirs in ((part.point_data, grid.point_data), (part.cell_data, grid.cell_data)):
                    for array, known in theirs.items():
                        np.testing.assert_array_equal(own[array], known, err_msg=array)
        self.assertGreater(abs(self.steps[-1][1][1].point_data["contact_impulse"]).max() +
                           abs(self.steps[3][1][1].point_data["contact_impulse"]).max(), 0)

    def test_no_number_of_the_motion_is_in_two_files(self):
        with h5py.File(self.path, "r") as file:
            root = file["VTKHDF"]
            for name in ("Points", "Connectivity", "Offsets", "Types"):
                self.assertTrue(root[name].is_virtual, name)
            for group in ("PointData", "CellData"):
                for name, array in root[group].items():
                    self.assertTrue(array.is_virtual, name)
                    self.assertEqual({source.file_name for source in array.virtual_sources()}, {"fields.h5"})
            self.assertEqual(root["PointData/displacement"].attrs["unit"], b"m")
            step = h5py.File(os.path.join(self.output, "fields.h5"), "r").attrs["time_step"]
            self.assertEqual(root["PointData/velocity"].attrs["time_offset"], step / 2)

    def test_one_and_three_ranks_write_the_same(self):
        for ranks in (1, 3):
            folder = self.run_fresh(STRUCK, ranks)
            self.compare(vtkhdf_file.read(os.path.join(folder, "fields.vtkhdf")), self.steps, but=("rank",), tolerance=1e-9)

    def test_a_structure_without_a_quantity_has_zeros(self):
        modal = ["-s1_model", "modal", "-s1_modal_vectors", 10, "-end_time", 0.004]
        folder = self.run_fresh([*STRUCK, *modal, "-fields_format", "vtkhdf"])
        self.assertFalse(os.path.exists(os.path.join(folder, "fields.xdmf")))
        for _, (reduced, full) in vtkhdf_file.read(os.path.join(folder, "fields.vtkhdf"))[1:]:
            self.assertEqual(abs(reduced.point_data["rotation"]).max(), 0)
            self.assertGreater(abs(reduced.point_data["displacement"]).max(), 0)
            self.assertEqual(full.point_data["rotation"].shape, full.points.shape)

    def test_a_continued_run_lists_all_steps_and_no_other_list_stays(self):
        folder = self.run_fresh([*STRUCK, "-end_time", 0.01, "-checkpoint_steps", 200])
        self.assertEqual(len(vtkhdf_file.read(os.path.join(folder, "fields.vtkhdf"))), 6)
        checkpoint = os.path.join(folder, "checkpoint.h5")
        other = self.run_fresh([*STRUCK, "-restart", checkpoint])
        self.compare(vtkhdf_file.read(os.path.join(other, "fields.vtkhdf")), self.steps)
        again = program.run([*STRUCK, "-restart", checkpoint, "-output", folder, "-fields_format", "xdmf"], 2)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(os.path.exists(os.path.join(folder, "fields.vtkhdf")))
        self.assertEqual(len(xdmf_file.read(os.path.join(folder, "fields.xdmf"))), 11)
        program.must_refuse(self, [*STRUCK, "-fields_format", "vtu"], "-fields_format", "vtu", "xdmf vtkhdf both")

    def test_a_killed_run_leaves_whole_steps(self):
        folder = tempfile.mkdtemp(prefix="pounding-vtkhdf-")
        self.addCleanup(shutil.rmtree, folder)
        arguments = [*STRUCK, "-end_time", 20, "-checkpoint_steps", 100, "-fields_interval", 0.001, "-output", folder]
        process = subprocess.Popen(program.words(arguments, 2), cwd=program.SOURCE, env=program.ENVIRONMENT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        path = os.path.join(folder, "fields.vtkhdf")
        seen = 0
        while process.poll() is None and seen < 10:
            if os.path.exists(path):
                seen = len(vtkhdf_file.read(path))  # whole while the run goes on, too
            time.sleep(0.02)
        self.assertIsNone(process.poll())
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        subprocess.run(["pkill", "-KILL", "-f", folder], check=False)  # ranks have groups of their own
        while subprocess.run(["pgrep", "-f", folder], stdout=subprocess.DEVNULL, check=False).returncode == 0:
            time.sleep(0.02)
        steps = vtkhdf_file.read(path)
        self.assertGreaterEqual(len(steps), seen)
        for _, parts in steps[1:]:
            for part in parts:
                self.assertTrue(np.all(np.isfinite(part.point_data["velocity"])))
            self.assertGreater(abs(parts[0].point_data["displacement"]).max(), 0)

    def test_the_reader_of_vtk_reads_the_same(self):
        reader = vtkhdf_file.vtk_reader()
        if reader is None:
            self.skipTest("no VTK 9.3 or later, whose reader knows time (Debian 13's python3-vtk9 has it)")
        reader.SetFileName(self.path)
        reader.UpdateInformation()
        for number in (0, 4, 10):
            moment, parts = self.steps[number]
            reader.UpdateTimeStep(moment)
            points, cells, types, point_data, cell_data = xdmf_file.vtk_grid(reader.GetOutputDataObject(0))
            np.testing.assert_array_equal(points, np.concatenate([part.points for part in parts]))
            first = np.cumsum([0, *(len(part.points) for part in parts)])
            self.assertEqual(cells, [[node + start for node in cell] for part, start in zip(parts, first) for cell in part.cells])
            self.assertEqual(types, [kind for part in parts for kind in part.types])
            for own, theirs in (([part.point_data for part in parts], point_data), ([part.cell_data for part in parts], cell_data)):
                for name in own[0]:
                    np.testing.assert_array_equal(theirs[name], np.concatenate([data[name] for data in own]), err_msg=name)


if __name__ == "__main__":
    unittest.main()
