"""A run that was stopped and continued leaves what the uninterrupted run leaves, to the last bit."""
import os
import shutil
import tempfile
import unittest
import zlib

import h5py
import numpy

import program
from decks import box_of, contacts, material

# A damped bar falls on a wall again and again: long impacts, short ones, rest.
BAR = ["-structures", "bar", "-bar_mesh", "tests/meshes/box.geo", "-bar_mesh_set", "lz=10,nz=20",
       "-bar_body_element", "hex8_full", "-bar_body_material", "soft", "-material_soft_young", 900,
       "-material_soft_poisson", 0.2, "-material_soft_density", 1, "-bar_damping_beta", 1e-4,
       "-bar_gravity", "0.1,0,-10", "-contacts", "stop", "-stop_secondary", "bar:z_min",
       "-stop_primary", "wall", "-stop_gap", 0.5, "-output_interval", 0.05, "-energy_interval", 7,
       "-probes", "ends,top", "-top_structure", "bar", "-top_group", "z_max", "-ends_structure", "bar",
       "-ends_at", "0,0,0; 1,1,10", "-ends_average", "false", "-modes", 1,
       "-spectra_frequencies", "1:20:5lin"]

# Two storeys, beams and bricks, with coupled contact rows (nodes on faces, both sides).
PAIR = program.COARSE_PAIR + ["-s2_mesh_set", "cells_x=5,cells_y=4,column_elements=2",
                              "-floor2_passes", 2, "-floor2_gap", "4e-4,2e-4", "-floor1_gap", 0.02,
                              "-motion_x_pga", 20, "-motion_x_envelope", "0.02,20", "-modes", 1,
                              "-output_interval", 2e-4]

# Bricks whose faces do not match and close one edge first: 625 coupled rows, which the ranks solve together.
FACE = [*contacts(joint=("one:x_max", "two:x_min", "1e-5,3e-5,2e-5,4e-5")), "-structures", "one,two",
        *box_of("one", "x0=-1,nx=4,ny=24,nz=24", "stone"), *box_of("two", "x0=0,nx=4,ny=17,nz=17", "stone"),
        *material("stone", 30e9, 0.2, 2400), "-one_initial_velocity", "1,0.2,0.1", "-time_step", 3e-6, "-probes",
        "ends", "-ends_structure", "two", "-ends_group", "x_max", "-modes", 0, "-output_interval", 3e-6,
        "-spectra_frequencies", "100:2000:5lin", "-end_time", 4.5e-4]

TABLES = ("impacts.csv", "contact_points.csv", "energy.csv", "spectra.csv")


def history(folder):
    with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
        return {name: file[name][()] for name in file}


def checkpoint(folder):
    return os.path.join(folder, "checkpoint.h5")


def content(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def checkpoint_step(folder):
    with h5py.File(checkpoint(folder), "r") as file:
        return int(file["tables/step"][0])


class RestartCase(unittest.TestCase):
    def folder(self):
        folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, folder)
        return folder

    def complete(self, arguments, ranks=1, folder=None):
        """Runs to the end; the folder of the results."""
        folder = folder or self.folder()
        result = program.run(list(arguments) + ["-output", folder], ranks)
        self.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr[-2000:])
        return folder

    def cut(self, arguments, step, time_step, ranks=1):
        """A run whose only checkpoint stands at a step, and which goes on a little."""
        end_time = (step + step // 20) * time_step
        folder = self.complete([*arguments, "-checkpoint_steps", step, "-end_time", end_time], ranks)
        self.assertEqual(checkpoint_step(folder), step)
        return folder

    def assert_same_motion(self, one, other, tables=("impacts.csv", "contact_points.csv", "spectra.csv")):
        first, second = history(one), history(other)
        self.assertEqual(set(first), set(second))
        for name, values in first.items():
            self.assertTrue(numpy.array_equal(values, second[name]), name)
        for name in tables:
            self.assertEqual(content(one, name), content(other, name), name)

    def assert_same_results(self, one, other):
        self.assert_same_motion(one, other, TABLES)
        one, other = program.summary(one), program.summary(other)
        for part in ("energy", "impacts", "probes", "steps"):
            self.assertEqual(one[part], other[part], part)

    def middle_of_an_impact(self, folder, number):
        """A step inside an episode, with an impulse before and after it, and the time step."""
        impacts = program.read_csv(os.path.join(folder, "impacts.csv"))
        time_step = program.summary(folder)["time_step"]
        start, end = float(impacts["start"][number]), float(impacts["end"][number])
        self.assertGreater(end - start, 10 * time_step)
        return round((start + end) / 2 / time_step), time_step


class BitIdentity(RestartCase):
    def test_bar_in_the_middle_of_an_impact_and_between_two(self):
        case = BAR + ["-end_time", 6]
        for ranks in (1, 2, 3):
            whole = self.complete(case, ranks)
            inside, time_step = self.middle_of_an_impact(whole, 1)
            impacts = program.read_csv(os.path.join(whole, "impacts.csv"))
            between = round((float(impacts["end"][4]) + float(impacts["start"][5])) / 2 / time_step)
            for step in (inside, between) if ranks == 1 else (inside,):
                cut = self.cut(case, step, time_step, ranks)
                if ranks == 1:
                    with self.subTest(step=step, into="another folder"):
                        other = self.complete([*case, "-restart", checkpoint(cut)])
                        self.assert_same_results(whole, other)
                with self.subTest(ranks=ranks, step=step, into="the same folder"):
                    self.complete([*case, "-restart", checkpoint(cut)], ranks, cut)
                    self.assert_same_results(whole, cut)

    def test_pair_with_coupled_contact_rows(self):
        case = PAIR + ["-end_time", 0.3]
        whole = self.complete(case, 2)
        step, time_step = self.middle_of_an_impact(whole, 1)
        cut = self.cut(case, step, time_step, 2)
        with h5py.File(checkpoint(cut), "r") as file:
            self.assertEqual(file["tables/impacts_is_open"][()].sum(), 1)
            self.assertGreater(file["tables/contact_impulse"][()].max(), 0)
        self.complete([*case, "-restart", checkpoint(cut)], 2, cut)
        self.assert_same_results(whole, cut)

    def test_face_that_ranks_solve_together(self):
        for ranks in (2, 3):
            whole = self.complete(FACE, ranks)
            step, time_step = self.middle_of_an_impact(whole, 0)
            cut = self.cut(FACE, step, time_step, ranks)
            self.complete([*FACE, "-restart", checkpoint(cut)], ranks, cut)
            self.assert_same_results(whole, cut)
            self.assertLess(program.summary(whole)["impacts"]["complementarity_residual"], 2e-15)

    def test_start_at_rest(self):
        for more in ([], ["-bar_rigid", "z_min"]):
            case = BAR + ["-bar_gravity", "0,0,-10", "-preload", "static", "-bar_initial_velocity", "0,0,4",
                          "-end_time", 2, *more]
            whole = self.complete(case)
            step, time_step = self.middle_of_an_impact(whole, 1)
            cut = self.cut(case, step, time_step)
            self.complete([*case, "-restart", checkpoint(cut)], folder=cut)
            self.assert_same_results(whole, cut)

    def test_memories_of_uniform_damping(self):
        uniform = [f"-{name}_damping_{word}" for name in ("s1", "s2") for word in ("alpha", "beta", "uniform")]
        values = [0, 0, 0.02, 0, 0, 0.05]
        pair = PAIR + [word for both in zip(uniform, values) for word in both] + ["-end_time", 0.3]
        reduced = [word for name in ("s1", "s2")
                   for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 20)]
        scaled = ["-s2_mass_scaling", 1e-4]
        for more in ([], reduced, scaled):
            case, ranks = pair + more, 2 if more is scaled else 1
            whole = self.complete(case, ranks)
            step, time_step = self.middle_of_an_impact(whole, 0)
            cut = self.cut(case, step, time_step, ranks)
            with h5py.File(checkpoint(cut), "r") as file:
                names = []
                file.visit(names.append)
                self.assertEqual(sum(name.endswith("filter_3") for name in names), 2, names)
            self.complete([*case, "-restart", checkpoint(cut)], ranks, cut)
            self.assert_same_results(whole, cut)

    def test_checkpoints_change_nothing(self):
        case = BAR + ["-end_time", 3]
        whole = self.complete(case)
        self.assert_same_results(whole, self.complete([*case, "-checkpoint_steps", 1]))

    def test_restart_of_a_restart_and_at_the_end(self):
        case = BAR + ["-end_time", 6]
        whole = self.complete(case)
        steps = program.summary(whole)["steps"]
        folder = self.folder()
        for part in (3, 2):
            restart = [] if part == 3 else ["-restart", checkpoint(folder)]
            self.complete([*case, *restart, "-end_time", 6 / part, "-checkpoint_steps", steps // 10],
                          folder=folder)
        self.complete([*case, "-restart", checkpoint(folder), "-checkpoint_steps", steps],
                      folder=folder)
        self.assert_same_results(whole, folder)
        self.assertEqual(checkpoint_step(folder), steps)
        self.complete([*case, "-restart", checkpoint(folder)], folder=folder)
        self.assert_same_results(whole, folder)


class OtherNumberOfRanks(RestartCase):
    def follow(self, case, number, tolerance):
        whole = self.complete(case, 2)
        step, time_step = self.middle_of_an_impact(whole, number)
        cut = self.cut(case, step, time_step, 2)
        reference = history(whole)
        for ranks in (1, 3):
            other = history(self.complete([*case, "-restart", checkpoint(cut)], ranks))
            self.assertTrue(numpy.array_equal(other["time"], reference["time"]))
            for name in ("displacement", "velocity", "gap", "contact_force"):
                scale = abs(reference[name]).max()
                self.assertGreater(scale, 0)
                self.assertLessEqual(abs(other[name] - reference[name]).max(), tolerance * scale,
                                     (name, ranks))
        return whole

    def test_bar_follows_to_round_off(self):
        whole = self.follow(BAR + ["-end_time", 6], 1, 1e-10)
        self.assertLess(program.summary(whole)["energy"]["relative_residual"], 1e-11)

    def test_pair_follows_to_round_off(self):
        self.follow(PAIR + ["-end_time", 0.265], 0, 1e-9)

    def test_face_follows_to_round_off(self):
        self.follow(FACE, 0, 1e-11)

    def test_energies_add_up(self):
        case = BAR + ["-end_time", 6]
        whole = program.summary(self.complete(case, 2))
        cut = self.cut(case, whole["steps"] // 2, whole["time_step"], 2)
        for ranks in (1, 3):
            other = program.summary(self.complete([*case, "-restart", checkpoint(cut)], ranks))
            self.assertLess(other["energy"]["relative_residual"], 1e-11)
            for term in ("kinetic", "strain", "damping", "contact", "input"):
                self.assertAlmostEqual(other["energy"][term], whole["energy"][term], delta=1e-8)


class Divergence(RestartCase):
    def test_last_good_checkpoint_stays(self):
        folder = self.folder()
        result = program.run(BAR + ["-time_step", 0.025, "-allow_unstable", "-end_time", 1000,
                                    "-energy_interval", 1000000, "-checkpoint_steps", 10,
                                    "-output", folder])
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(program.error_lines(result)), 1, result.stderr)
        self.assertIn("diverged", program.error_lines(result)[0])
        with h5py.File(checkpoint(folder), "r") as file:
            self.assertTrue(numpy.isfinite(file["structures/bar/velocity"][()]).all())


class Refusals(RestartCase):
    CASE = BAR + ["-end_time", 2]

    @classmethod
    def setUpClass(cls):
        cls.origin = tempfile.mkdtemp(prefix="pounding-")
        result = program.run(cls.CASE + ["-end_time", 1, "-checkpoint_steps", 10,
                                         "-output", cls.origin])
        assert result.returncode == 0, result.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.origin)

    def copy(self, change=None, seal=True):
        """A copy of the results, its checkpoint changed in Python and sealed anew."""
        folder = self.folder()
        for name in ("checkpoint.h5", "history.h5"):
            shutil.copy(os.path.join(self.origin, name), folder)
        if change:
            with h5py.File(checkpoint(folder), "r+") as file:
                change(file)
            if seal:
                self.assertEqual(program.command("seal", checkpoint(folder)).returncode, 0)
        return folder

    def refuse(self, folder, words, more=(), case=None, name="checkpoint.h5", ranks=1):
        before = {file: content(folder, file) for file in os.listdir(folder)}
        path = os.path.join(folder, name)
        result = program.run([*(case or self.CASE), "-restart", path, "-output", folder, *more], ranks, timeout=120)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        lines = program.error_lines(result)
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertNotIn("HDF5-DIAG", result.stderr)
        for word in (path, *words):
            self.assertIn(word, lines[0])
        for file, bytes_before in before.items():
            self.assertEqual(content(folder, file), bytes_before, file)

    def write(self, folder, name, data):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)

    def test_the_original_is_accepted(self):
        self.complete([*self.CASE, "-restart", checkpoint(self.copy())])

    def test_sealed_but_of_more_rows_than_the_file_has_bytes(self):
        def claim(group):
            def change(file):
                name, data = next(iter(file[group].items()))
                del file[group][name]
                file[group].create_dataset(name, (10**10, *data.shape[1:]), "f8", chunks=(1000, *data.shape[1:]))
            return change

        for group in ("tables", "sums"):
            folder = self.copy(claim(group), seal=False)
            data = content(folder, "checkpoint.h5")[512:]
            seal = f"pounding seal 1\nbytes {len(data)}\ncrc32 {zlib.crc32(data):08x}\n".encode().ljust(512, b"\0")
            self.write(folder, "checkpoint.h5", seal + data)
            self.refuse(folder, ["claims more values than the file has bytes"])

    def test_no_such_file(self):
        self.refuse(self.copy(), ["no such file"], name="nothing.h5")

    def test_no_hdf5(self):
        folder = self.copy()
        self.write(folder, "checkpoint.h5", b"this is no checkpoint\n" * 100)
        self.refuse(folder, ["not a checkpoint"], ranks=3)

    def test_history_is_no_checkpoint(self):
        self.refuse(self.copy(), ["not a checkpoint"], name="history.h5")

    def test_truncated(self):
        folder = self.copy()
        data = content(folder, "checkpoint.h5")
        for size in (len(data) // 4, len(data) // 2, len(data) - 1):
            self.write(folder, "checkpoint.h5", data[:size])
            self.refuse(folder, ["is not the sealed one"])

    def test_flipped_bits(self):
        """HDF5 does not see the file: it ends the program on some of these."""
        folder = self.copy()
        data = content(folder, "checkpoint.h5")
        for place in (3, 40, 520, 600, len(data) // 3, len(data) // 2, len(data) - 1):
            bad = bytearray(data)
            bad[place] ^= 4
            self.write(folder, "checkpoint.h5", bytes(bad))
            self.refuse(folder, ["damaged"])

    def test_a_damaged_file_is_not_sealed_anew(self):
        folder = self.copy()
        data = content(folder, "checkpoint.h5")
        superblock, header = data.index(b"\x89HDF"), data.index(b"OHDR")
        for place in (superblock + 8, superblock + 13, header, header + 5):
            bad = bytearray(data)
            bad[place] ^= 64
            self.write(folder, "checkpoint.h5", bytes(bad))
            result = program.command("seal", checkpoint(folder))
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), result.stderr)
            self.assertIn("cannot read it whole", result.stderr)
            self.assertEqual(content(folder, "checkpoint.h5"), bytes(bad))

    def test_changed_but_not_sealed(self):
        def push(file):
            file["structures/bar/velocity"][0, 2] += 1e-9  # no energy to speak of

        self.refuse(self.copy(push, seal=False), ["run/seal"])
        self.complete([*self.CASE, "-restart", checkpoint(self.copy(push))])

    def test_values_that_cannot_be(self):
        def put(name, *place, value):
            def change(file):
                file[name][place or ...] = value
            return change

        for value in (float("nan"), 1e300, -1e300, 1.5, -7):
            self.refuse(self.copy(put("tables/step", value=value)), ["step'"])
        self.refuse(self.copy(put("structures/bar/velocity", 3, 1, value=float("nan"))),
                    ["structures/bar/velocity' holds nan in row 4"])
        self.refuse(self.copy(put("tables/ledger", 0, 2, value=float("inf"))),
                    ["tables/ledger' holds inf in row 1"])
        for contact in (-1, 1, 0.5, 1e300):
            self.refuse(self.copy(put("tables/impacts_open", 0, 0, value=contact)), ["impacts_open"])
        self.refuse(self.copy(put("tables/recorder_records", value=-1)), ["recorder_records"])
        self.refuse(self.copy(put("tables/gap_watch_steps", 0, value=1e300)), ["gap_watch_steps"])

    def test_other_schema(self):
        def of_version_3(file):
            del file.attrs["schema"]
            file.attrs["version"] = 3.0

        self.refuse(self.copy(lambda file: file.attrs.modify("schema", 99.0)), ["schema 99", "written by pounding "])
        self.refuse(self.copy(of_version_3), ["of schema 3, written by pounding ", "reads schema 15", "start anew"])

    def test_missing_part(self):
        def remove(file):
            del file["tables/contact_impulse"]

        self.refuse(self.copy(remove), ["contact_impulse"])

    def test_other_options(self):
        self.refuse(self.copy(), ["-bar_damping_beta 0.0001", "2e-4"], ["-bar_damping_beta", "2e-4"])
        self.refuse(self.copy(), ["-contacts stop", "stop,spare"], ["-contacts", "stop,spare", "-spare_secondary",
                                                     "bar:z_max", "-spare_primary", "wall",
                                                     "-spare_gap", 9])

    def test_other_time_step(self):
        self.refuse(self.copy(), ["time step", "give -time_step"], ["-time_step", 1e-7])

    def test_end_time_before_the_checkpoint(self):
        folder = self.copy()
        result = program.run([*self.CASE, "-restart", checkpoint(folder), "-end_time", 0.1,
                              "-output", folder])
        self.assertEqual(result.returncode, 1)
        self.assertIn("-end_time", program.error_lines(result)[0])

    def test_other_mesh_of_the_same_name(self):
        folder = self.folder()
        mesh = os.path.join(folder, "bar.geo")
        with open(os.path.join(program.SOURCE, "tests/meshes/box.geo")) as file:
            text = file.read()
        case = self.CASE + ["-bar_mesh", mesh]

        def write_mesh(more):
            self.write(folder, "bar.geo", (text + more).encode())

        write_mesh("")
        self.complete([*case, "-checkpoint_steps", 10], folder=folder)
        write_mesh("Translate {0.25, 0, 0} { Volume{1}; }\n")
        self.refuse(folder, ["structure bar", "another mesh"], case=case)

    def test_other_record_of_the_same_name(self):
        folder = self.folder()
        record = os.path.join(folder, "record.txt")
        case = self.CASE + ["-motion_x_record", record, "-motion_x_unit", "m/s2"]
        self.write(folder, "record.txt", b"0.0 0.0\n0.05 0.1\n0.1 0.0\n")
        self.complete([*case, "-checkpoint_steps", 10], folder=folder)
        self.write(folder, "record.txt", b"0.0 0.0\n0.05 0.2\n0.1 0.0\n")
        self.refuse(folder, ["ground motion"], case=case)

    def test_history_beside_it(self):
        folder = self.copy()
        os.remove(os.path.join(folder, "history.h5"))
        self.refuse(folder, ["history.h5: no such file"])
        folder = self.copy()
        with h5py.File(os.path.join(folder, "history.h5"), "r+") as file:
            file["velocity"][:] += 1
        self.refuse(folder, ["history.h5", "another run"])
        folder = self.copy()
        with h5py.File(os.path.join(folder, "history.h5"), "r+") as file:
            file["records"][0] = 3
        self.refuse(folder, ["history.h5: 3 of its records are whole"])

    def test_what_may_change(self):
        other = self.complete([*self.CASE, "-restart", checkpoint(self.copy()), "-title", "another",
                               "-end_time", 3, "-spectra_damping", "0.02", "-modes", 2,
                               "-time_step", repr(program.summary(self.origin)["time_step"])])
        self.assertGreater(program.summary(other)["end_time"], 2)


if __name__ == "__main__":
    unittest.main()
