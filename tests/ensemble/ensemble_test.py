"""Many runs at once are what single runs are: every member of an ensemble beside the run of its own, on one rank and
two, interrupted and continued; and what an ensemble refuses."""
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
import two_buildings  # noqa: F401  (puts python on the path)
from soil_tables import coupled, two_mats, write_parts, write_soil

import pounding

SCENE = ["-options_file", str(two_buildings.SCENE), "-end_time", "1.2", "-modes", "0", "-csv_digits", "17",
         "-left_damping_reference", "3", "-right_damping_reference", "4", "-spectra_damping", "0.02,0.05",
         "-gap_interval", "0.01"]
MODAL = [word for name in ("left", "right")
         for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", "12", f"-{name}_mass_scaling", "5e-5")]
COLUMNS = "motion_x_seed,motion_x_pga,motion_level,floor1_gap,floor2_gap,left_damping_factor,right_stiffness_factor"
ROWS = ["1,3.5,1,0.01,0.01,1,1", "2,3.5,1,0.01,0.012,1,1", "3,3.5,1.4,\"0.008,0.011\",0.01,1,1",
        "1,2,1,0.01,0.01,1,1", "1,3.5,1,0.005,0.004,0.5,1.2", "4,6,0.7,0.02,0.015,2,0.9", "2,0.1,1,0.01,0.01,1,1",
        "5,4,1,0.003,0.003,1,1", "6,3.5,1,0.01,0.01,1,0.8", "7,5,1,,0.01,1,1"]


def table(rows, columns=COLUMNS):
    handle, path = tempfile.mkstemp(suffix=".csv")
    with os.fdopen(handle, "w") as file:
        file.write("\n".join([columns, *rows]) + "\n")
    return path


def overrides(row, columns=COLUMNS):
    """The words of a single run of a row."""
    fields, quoted = [""], False
    for c in row:
        if c == '"':
            quoted = not quoted
        elif c == "," and not quoted:
            fields.append("")
        else:
            fields[-1] += c
    return [word for name, value in zip(columns.split(","), fields) if value for word in (f"-{name}", value)]


def time_step(folder):
    with h5py.File(os.path.join(folder, "ensemble.h5")) as file:
        return next(line.split()[2] for line in np.char.decode(file["identity"][:]) if line.startswith("time step"))


def compare(test, result, member, words):
    """Holds a member against the single run of these words; returns the number of its impacts."""
    folder, _ = program.must_run(test, words, 1)
    single = pounding.load(folder)
    spectra = np.array([single.spectrum(*channel.split(), damping)[1]
                        for channel in result.channels for damping in result.damping])
    own = result.pseudo_acceleration[member].reshape(spectra.shape)
    test.assertLess(np.abs(own / spectra - 1).max(), 1e-9)
    impulses = {}
    for name, impulse in zip(single.impacts["contact"], single.impacts["impulse"]):
        impulses.setdefault(str(name), []).append(impulse)
    for c, contact in enumerate(result.contacts):
        found = impulses.get(contact, [])
        test.assertEqual(result.impacts["episodes"][member, c], len(found))
        test.assertAlmostEqual(result.impacts["impulse_sum"][member, c], sum(found), delta=1e-9 * max(sum(found), 1e-9))
        test.assertEqual(np.isnan(result.impacts["first_time"][member, c]), not found)
        test.assertAlmostEqual(result.smallest_gap[member, c], np.nanmin(single.history["gap"][:, c]), delta=1e-11)
    for c, channel in enumerate(result.channels):
        peak = np.abs(single.series("displacement", *channel.split())[1]).max()
        test.assertAlmostEqual(result.displacement[member, c], peak, delta=1e-9 * peak)
    return sum(len(found) for found in impulses.values())


class Members(unittest.TestCase):
    """One ensemble of ten members, of two groups."""

    @classmethod
    def setUpClass(cls):
        cls.table = table(ROWS)
        cls.folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        meshes = tempfile.mkdtemp(prefix="pounding-ensemble-")
        cls.inner = shutil.copy(two_buildings.SCENE.parent / "building.geo", meshes)
        with open(f"{meshes}/left.geo", "w") as file:
            file.write('Include "building.geo";\n')
        cls.scene = [*SCENE, *MODAL, "-left_mesh", f"{meshes}/left.geo"]
        cls.words = [*cls.scene, "-ensemble", cls.table]
        cls.job = program.run([*cls.words, "-output", cls.folder], 1)
        cls.result = pounding.load_ensemble(cls.folder) if cls.job.returncode == 0 else None

    def setUp(self):
        self.assertEqual(self.job.returncode, 0, self.job.stdout[-2000:] + self.job.stderr[-2000:])

    def test_each_is_its_single_run(self):
        words = [*SCENE, *MODAL, "-time_step", time_step(self.folder)]
        struck = [compare(self, self.result, member, [*words, *overrides(ROWS[member])]) for member in (0, 2, 4, 7, 9)]
        self.assertGreater(sum(struck), 5)

    def test_ledgers_close(self):
        self.assertTrue(self.result.done.all())
        self.assertLess(np.abs(self.result.residual).max(), 1e-9)

    def test_summary_for_a_spreadsheet(self):
        with open(os.path.join(self.folder, "ensemble.csv")) as file:
            rows = file.read().splitlines()
        self.assertEqual(len(rows), 1 + len(ROWS))
        self.assertTrue(rows[0].startswith("member,done,motion_x_seed"))

    def same_as(self, folder):
        with h5py.File(os.path.join(self.folder, "ensemble.h5")) as one, \
                h5py.File(os.path.join(folder, "ensemble.h5")) as other:
            for name in ("spectra/pseudo_acceleration", "impacts/impulse_sum", "peaks/displacement", "energy/residual",
                         "peaks/acceleration", "impacts/first_time", "gaps/smallest", "done"):
                np.testing.assert_array_equal(one[name][:], other[name][:], name)

    def test_two_ranks_and_another_order_of_groups(self):
        folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        run = program.must_end(self, [*self.words, "-output", folder], 2)
        self.same_as(folder)
        with h5py.File(os.path.join(folder, "ensemble.h5"), "r+") as file:  # as if killed
            for member in (1, 4, 9):
                file["done"][member] = 0
                file["spectra/pseudo_acceleration"][member] = np.nan
        run = program.must_end(self, [*self.words, "-output", folder], 1)
        self.assertIn("7 of 10 members are done already", run.stdout)
        self.same_as(folder)

    def copied(self):
        folder = os.path.join(tempfile.mkdtemp(prefix="pounding-ensemble-"), "run")
        shutil.copytree(self.folder, folder)
        return folder

    def test_numbers_of_a_done_member_that_are_not_what_was_written(self):
        folder = self.copied()
        with h5py.File(os.path.join(folder, "ensemble.h5"), "r+") as file:
            file["spectra/pseudo_acceleration"][1] = np.nan
            file["gaps/smallest"][4, 0] *= 1.001
            file["done"][9] = 7
        with self.assertRaisesRegex(pounding.ResultError, "member 2 are not those written"):
            pounding.load_ensemble(folder)
        run = program.must_end(self, [*self.words, "-output", folder], 2)
        self.assertIn("the numbers of 3 members that are said to be done are not those written", run.stdout)
        self.same_as(folder)

    def test_a_damaged_file_is_refused(self):
        """Every kind of change outside of the members' numbers, before HDF5 sees it."""
        folder = self.copied()
        path = os.path.join(folder, "ensemble.h5")
        with open(path, "rb") as file:
            sound = file.read()
        self.assertEqual(program.command("seal", path).returncode, 0)
        with open(path, "rb") as file:
            self.assertEqual(file.read(), sound)
        for change in (lambda text: text[:-9], lambda text: text[:2000], lambda text: text + b"more", lambda _: b"",
                       lambda text: text[:530] + bytes([text[530] ^ 1]) + text[531:], lambda text: text.replace(b"motion_x_seed", b"motion_x_Seed")):
            with open(path, "wb") as file:
                file.write(change(sound))
            line = program.must_refuse(self, [*self.words, "-output", folder], "ensemble.h5", "begin anew", ranks=1)
            self.assertRegex(line, "damaged")
        shutil.move(path, path + "-elsewhere")
        os.symlink(path + "-elsewhere", path)
        program.must_refuse(self, [*self.words, "-output", folder], "ensemble.h5: a symbolic link")

    def test_a_signal_stops_it_and_the_same_command_goes_on(self):
        folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = [*self.words, "-output", folder]
        job = subprocess.Popen([program.PROGRAM, *words], cwd=program.SOURCE, env=program.ENVIRONMENT,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in job.stdout:
            if "about 8 of 10" in line or "histories in memory" in line:
                break
        time.sleep(0.2)
        job.send_signal(signal.SIGTERM)
        _, errors = job.communicate(timeout=600)
        self.assertIn(job.returncode, (0, 2), errors)
        if job.returncode == 2:
            self.assertIn("stopped by SIGTERM", errors)
            self.assertFalse(pounding.load_ensemble(folder).done.all())
        run = program.must_end(self, words, 1)
        self.same_as(folder)

    def test_another_table_or_scene_is_refused(self):
        program.must_refuse(self, [*self.scene, "-ensemble", table(ROWS[:9]), "-output", self.folder],
                            "holds another ensemble", "member 10", "give another -output", ranks=1)
        program.must_refuse(self, [*self.words, "-end_time", "1.1", "-output", self.folder],
                            "holds another ensemble", "end_time", ranks=3)

    def test_another_file_within_a_geometry_is_refused(self):
        with open(self.inner) as file:
            text = file.read()
        try:
            with open(self.inner, "a") as file:
                file.write("// another\n")
            program.must_refuse(self, [*self.words, "-output", self.folder], "holds another ensemble", self.inner, ranks=1)
        finally:
            with open(self.inner, "w") as file:
                file.write(text)

    def test_another_schema_is_refused(self):
        place = tempfile.mkdtemp(prefix="pounding-ensemble-")
        shutil.copy(os.path.join(self.folder, "ensemble.h5"), place)
        with h5py.File(os.path.join(place, "ensemble.h5"), "r+") as file:
            file.attrs["schema"] = 99.0
        self.assertEqual(program.command("seal", os.path.join(place, "ensemble.h5")).returncode, 0)
        program.must_refuse(self, [*self.words, "-output", place], "an ensemble of schema 99", "reads schema 1",
                            "give another -output")
        with self.assertRaisesRegex(pounding.ResultError, "schema 99"):
            pounding.load_ensemble(place)


class Kinds(unittest.TestCase):
    """What a step has beside free structures and smooth contact, member by member as in single runs."""
    COLUMNS = "motion_x_seed,motion_x_pga,floor1_gap,floor2_gap,left_damping_factor"
    ROWS = ["1,3.5,0.01,0.01,1", "2,5,,\"0.008,0.012\",0.5", "3,4,0.012,0.009,2"]
    WEIGHT = ["-gravity", "9.81", "-preload", "static"]
    FEET = ["-left_clamp", "none", "-left_base_element", "grounded_spring", "-left_base_stiffness",
            "2e7,2e7,6e7,2e7,2e7,2e7"]
    RAYLEIGH = ["-left_damping_uniform", "0", "-left_damping_reference", "", "-left_damping_alpha", "0.5",
                "-left_damping_beta", "1e-5"]

    def check(self, *words, struck=True, rows=ROWS, columns=COLUMNS):
        folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = [*SCENE, *MODAL, "-end_time", "0.9", "-spectra_damping", "0.05", "-csv_digits", "17", *words]
        job = program.must_end(self, [*words, "-ensemble", table(rows, columns), "-output", folder], program.RANKS)
        result = pounding.load_ensemble(folder)
        self.assertTrue(result.done.all())
        self.assertLess(np.abs(result.residual).max(), 1e-9)
        words += ["-time_step", time_step(folder)]
        impacts = [compare(self, result, m, [*words, *overrides(rows[m], columns)]) for m in (1, 2)]
        self.assertEqual(sum(impacts) > 0, struck)

    def test_at_rest_under_the_weight(self):
        self.check(*self.WEIGHT)

    def test_gravity_that_sets_in(self):
        self.check("-gravity", "9.81")

    def test_weight_on_columns_that_lean(self):
        self.check(*self.WEIGHT, "-left_mass_scaling", "0", "-left_p_delta", "true")

    def test_friction(self):
        self.check("-floor1_friction", "0.4", "-floor2_friction", "0.4")

    def test_dashpots(self):
        self.check(*self.FEET, "-left_base_dashpot", "2e5,2e5,4e5,0,0,0")

    def test_dashpots_beside_members_of_other_masses(self):
        """The same numbers to the bit whatever the masses of its companions."""
        words = [*SCENE, *MODAL, "-end_time", "0.5", "-spectra_damping", "0.05", *self.FEET, "-left_base_dashpot",
                 "2e5,2e5,4e5,0,0,0", "-left_mass_scaling", "2e-3"]
        columns = "motion_x_seed,motion_x_pga,left_stiffness_factor"
        rows, found = ["1,3.5,1", "2,5,1.3", "3,4,1"], []
        for some in (rows, rows[:1], rows[1:2]):
            folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
            program.must_end(self, [*words, "-time_step", "1e-4", "-ensemble", table(some, columns), "-output", folder], 1)
            found.append(pounding.load_ensemble(folder))
            self.assertLess(np.abs(found[-1].residual).max(), 1e-9)
        together, first, second = found
        np.testing.assert_array_equal(together.pseudo_acceleration[0], first.pseudo_acceleration[0])
        np.testing.assert_array_equal(together.pseudo_acceleration[1], second.pseudo_acceleration[0])

    def test_dashpots_in_series_with_springs_and_stops_between_nodes(self):
        words = [*self.FEET, "-left_base_dashpot", "2e5,2e5,4e5,0,0,0", "-left_base_dashpot_stiffness", "4e7,4e7,0,0,0,0",
                 "-floor1_along", "1,0,0", "-floor1_stiffness", "2e6", "-floor1_dashpot", "1e4", "-floor1_gap", ".01,.03",
                 "-floor2_along", "line", "-floor2_gap", ".01"]
        columns = "motion_x_seed,motion_x_pga,floor1_gap,floor2_gap"
        self.check(*words, rows=["1,3.5,,0.01", "2,5,\"0.008,0.012\",0.009", "3,4,\"0.012,0.01\",0.02"], columns=columns)
        program.must_refuse(self, [*SCENE, *MODAL, *words, "-ensemble", table(["1,3.5,0.01,0.01"], columns)],
                            "line 2 (member 1)", "-floor1_gap", "two numbers")

    def test_feet_that_lift_off(self):
        self.check(*self.FEET, *self.RAYLEIGH, "-gravity", "2", "-preload", "static", "-left_base_compression_only",
                   "true")

    def test_feet_that_yield(self):
        self.check(*self.FEET, *self.RAYLEIGH, "-left_base_yield_force", "4e3,4e3,0", "-left_base_hardening", "0.1")

    def test_soil_under_a_mat(self):
        self.check("-left_clamp", "none", "-left_rigid", "base", "-left_soil_mat", "base", "-left_soil_size", "6,4",
                   "-left_soil_vs", "200", "-left_soil_density", "1900", "-left_soil_poisson", "0.35")

    def test_soil_that_mats_share(self):
        table = write_parts(two_mats())
        self.check(*(word for mat, name in enumerate(("left", "right"), 1) for word in (
            f"-{name}_clamp", "none", f"-{name}_rigid", "base", f"-{name}_soil_mat", "base", f"-{name}_soil_table", table,
            f"-{name}_soil_table_mat", mat)))

    def test_soil_from_a_table(self):
        self.check("-left_clamp", "none", "-left_rigid", "base", "-left_soil_mat", "base", "-left_soil_table",
                   write_soil(coupled))

    def test_filled_joints(self):
        words = [word for floor in ("floor1", "floor2") for word in (
            f"-{floor}_filler", "0.3:2e4,0.6:2e5", f"-{floor}_filler_unloading", "1e6", f"-{floor}_filler_area", "1.5")]
        self.check(*words, struck=False)
        self.refuse_thick(words)

    def test_joints_of_random_width(self):
        self.check("-floor1_gap", ".007", "-floor2_gap", ".007", "-floor1_gap_length", "2", "-floor2_gap_length", "1",
                   "-floor2_gap_deviation", ".001", columns="motion_x_seed,motion_x_pga,floor1_gap_deviation,floor2_gap_seed",
                   rows=["1,3.5,0,1", "2,6,0.001,2", "3,6,0.002,3"])

    def test_joints_bridged_in_places(self):
        self.check(columns="motion_x_seed,motion_x_pga,floor1_gap_patches,floor2_gap_patches",
                   rows=["1,3.5,none,none", '2,6,"2,3,0.5,0","0,5.9,1.1,6.1,0.001"', '3,6,none,"2,6,0.5,0.002"'])

    def refuse_thick(self, words):
        """Before any basis is computed, as a single run does."""
        output = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = [*SCENE, *MODAL, *words, "-floor1_filler_thickness", "0.009", "-output", output, "-ensemble",
                 table(["0.01", "0.005"], "floor1_gap")]
        program.must_refuse(self, words, "line 3 (member 2)", "less than its filler of 0.009 m")
        self.assertEqual(os.listdir(output), [])

    def test_a_stiffness_of_their_own_at_rest(self):
        self.check(*self.WEIGHT, columns="motion_x_pga,right_stiffness_factor,floor1_gap,floor2_gap",
                   rows=["4,1,0.01,0.01", "8,0.8,0.004,0.005", "6,1.3,0.004,0.005"])


class Refusals(unittest.TestCase):
    def refuse(self, words, *parts, rows=("1",), columns="motion_x_seed"):
        output = tempfile.mkdtemp(prefix="pounding-ensemble-")
        program.must_refuse(self, [*SCENE, *words, "-ensemble", table(rows, columns), "-output", output], *parts)

    def test_what_it_cannot_do(self):
        self.refuse([*MODAL, "-floor1_sliding", "0.05"], "floor1_sliding out")
        self.refuse([*MODAL, "-fields_interval", "0.1"], "fields are written")

    def test_mistakes_in_the_table(self):
        self.refuse(MODAL, "column 'end_time'", "no option that may differ", columns="end_time", rows=["2"])
        self.refuse(MODAL, "did you mean floor1_gap", columns="floor_gap", rows=["2"])
        self.refuse(MODAL, "line 3 (member 2)", "motion_x_pga", columns="motion_x_pga", rows=["2", "-1"])
        self.refuse(MODAL, "line 2", "2 values, 1 columns", rows=["1,2"])
        self.refuse(MODAL, "no runs in it", rows=[])
        self.refuse(MODAL, "line 2 (member 1)", "nowhere.txt", columns="motion_x_record", rows=["nowhere.txt"])
        self.refuse(MODAL, "line 3", "quote is opened and not closed", columns="floor1_gap", rows=["0.1", "\"0.1,0.2"])
        self.refuse(MODAL, "line 1", "quote is opened and not closed", columns="\"floor1_gap", rows=["0.1"])
        self.refuse(MODAL, "line 3 (member 2)", "motion x: pga 1e+", "10000 g", columns="motion_x_pga", rows=["1", "1e9"])
        self.refuse(MODAL, "line 2 (member 1)", "envelope", columns="motion_x_envelope", rows=["\"30,40\""])

    def test_a_table_that_is_none(self):
        folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = [*SCENE, *MODAL, "-output", os.path.join(folder, "run"), "-ensemble"]
        program.must_refuse(self, [*words, folder], f"-ensemble {folder}: is a folder")
        program.must_refuse(self, [*words, "/dev/zero"], "-ensemble /dev/zero: is a device", ranks=1)
        with open(os.path.join(folder, "zeros.csv"), "wb") as file:
            file.write(b"motion_x_seed\n1\0\n")
        program.must_refuse(self, [*words, file.name], "not a text", ranks=1)

    def test_gaps_that_a_single_run_refuses(self):
        """Before any basis is computed."""
        output = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = [*SCENE, *MODAL, "-output", output, "-ensemble", table(["0.01,0.01", "0.01,-5"], "floor1_gap,floor2_gap")]
        program.must_refuse(self, words, "line 3 (member 2)", "-floor2_gap: a gap of -5 m", "cannot be meant")
        self.assertEqual(os.listdir(output), [])

    def test_members_that_are_the_same(self):
        words = [*SCENE, *MODAL, "-dry_run", "-ensemble", table(["0.01", "0.02", "0.01", "0.01"], "floor1_gap")]
        self.assertIn("line 4 (member 3): the same run as line 2; so are 1 more", program.must_end(self, words).stdout)

    def test_doubts_of_single_runs(self):
        rows = ["0.01,3.5,1", "20,3.5,1", "20,0.3,1", "0.01,0.3,1e-9"]
        words = [*SCENE, *MODAL, "-dry_run", "-ensemble", table(rows, "floor1_gap,motion_x_pga,right_damping_factor")]
        for ranks in (1, 2):
            run = program.must_end(self, words, ranks)
            warnings = [line for line in run.stdout.splitlines() if line.startswith("warning: ")]
            gaps = [line for line in warnings if "contact floor1: the gap given, up to 20 m" in line]
            self.assertEqual(len(gaps), 1, run.stdout)
            self.assertIn("(2 members, the first is member 2, line 3)", gaps[0])
            peaks = [line for line in warnings if "motion x: pga 0.3 m/s2 is 0.03" in line]
            self.assertEqual(len(peaks), 1, run.stdout)
            self.assertIn("(2 members, the first is member 3, line 4)", peaks[0])


if __name__ == "__main__":
    unittest.main()
