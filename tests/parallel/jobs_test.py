"""Ranks that run one job after the other (tests/jobs) leave no trace of it in the next: a run among others has the bits of
one in processes of its own; output, status, folder and variables are those of the job; a crash costs nobody else."""
import json
import os
import shutil
import socket
import subprocess
import tempfile
import threading
import time
import unittest

import h5py

import program

PROCESSORS = 2  # some runs are started in processes of their own

POUNDING = program.COARSE_PAIR + ["-motion_x_pga", 6, "-motion_x_envelope", "0.2,20", "-floor2_gap", "0.004,0.002", "-floor1_gap", 0.02,
                                  "-end_time", 0.1, "-modes", 3, "-spectra_frequencies", 10]


def records(folder):
    with h5py.File(os.path.join(folder, "history.h5")) as file:
        return {name: file[name][()].tobytes() for name in file if file[name].dtype.kind == "f"}


@unittest.skipIf(program.ALL, "all runs are started in processes of their own")
class Jobs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, self.folder, True)

    def run_by(self, start, name, ranks, *more):
        folder = os.path.join(self.folder, name)
        result = start([*POUNDING, *more, "-output", folder], ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result, folder

    def test_a_job_among_others_has_the_bits_of_a_launch(self):
        disturbances = (["-s1_rigid", "nothing"], ["-allow_unstable", "-time_step", 0.01], ["-dry_run", "-log_view"],
                        ["-end_time", 0.01, "-s1_fidelity", "modal", "-s1_modal_modes", 5, "-s2_mass_scaling", 4e-5],
                        ["-end_time", 0.01, "-vector_unit", "auto"])
        for ranks in (1, 2, 3):
            for at, words in enumerate(disturbances):
                program.run([*POUNDING, *words, "-output", os.path.join(self.folder, f"other{at}")], ranks)
            said, among = self.run_by(program.run, f"among{ranks}", ranks)
            alone_said, alone = self.run_by(program.launch, f"alone{ranks}", ranks)
            self.assertEqual(records(among), records(alone), ranks)
            # Lines without times and memory, which no two runs share.
            self.assertEqual([line for line in said.stdout.splitlines() if "penetration" in line],
                             [line for line in alone_said.stdout.splitlines() if "penetration" in line])
            self.assertEqual(sorted(os.listdir(among)), sorted(os.listdir(alone)))

    def test_status_and_words_are_those_of_the_job(self):
        refused = program.run(["-options_file", "nothing.yaml"], 2)
        self.assertEqual((refused.returncode, refused.stdout, len(program.error_lines(refused))), (1, "", 1))
        told = program.run(["-version"], 3)
        self.assertEqual((told.returncode, told.stderr, told.stdout.count("pounding ")), (0, "", 1))

    def test_folder_and_variables_are_those_of_the_job(self):
        with_variable = {**program.ENVIRONMENT, "PETSC_OPTIONS": "-malloc_dump"}
        file, *words = POUNDING[1:]
        words = ["-options_file", os.path.join(program.SOURCE, file), *words, "-end_time", 1e-3]
        for variables, name in ((with_variable, "with"), (None, "without")):
            result = program.run([*words, "-output", name], folder=self.folder, environment=variables)
            self.assertEqual("variable PETSC_OPTIONS" in result.stdout + result.stderr, variables is not None, result.stderr)
            self.assertTrue(os.path.exists(os.path.join(self.folder, name, "summary.json")))

    def test_a_crash_and_a_late_job_cost_nobody_else(self):
        ended = {}

        def run_beside():
            ended["beside"] = self.run_by(program.run, "beside", 1)

        beside = threading.Thread(target=run_beside)
        beside.start()
        with self.assertRaises(subprocess.TimeoutExpired):
            program.run([*POUNDING, "-end_time", 1000, "-output", os.path.join(self.folder, "late")], 1, timeout=3)
        beside.join()
        again = self.run_by(program.run, "again", 1)
        self.assertEqual(records(ended["beside"][1]), records(again[1]))

    def test_a_job_that_nobody_waits_for_ends(self):
        job = {"ranks": 1, "words": [str(word) for word in [*POUNDING, "-end_time", 1000, "-output", os.path.join(self.folder, "left")]],
               "folder": program.SOURCE, "environment": {}, "timeout": 900}
        with socket.socket(socket.AF_UNIX) as asked:
            asked.connect(os.path.join(program.jobs_place(), "jobs"))
            asked.sendall(json.dumps(job).encode() + b"\n")
            while not os.path.exists(os.path.join(self.folder, "left", "history.h5")):
                time.sleep(0.05)
        self.assertEqual(program.run(["-version"], 3, timeout=60).returncode, 0)  # it has all ranks


if __name__ == "__main__":
    unittest.main()
