"""A folder of results holds one run's files: a lock while it is written, old ones gone at the start, and
marks that tell a whole history from one that was cut."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import h5py

import program
from decks import box_of, material, probes

PROCESSORS = 2  # runs beside each other, and killed ones

BAR = ["-structures", "bar", *box_of("bar", "lz=4,nz=4", "soft", "hex8_full"), *material("soft", 900, 0.2, 1),
       "-bar_gravity", "0,0,-10", "-bar_clamp", "z_min", "-output_interval", 0.05, *probes(top="bar:z_max"),
       "-modes", 1, "-spectra_frequencies", "1:20:5lin", "-end_time", 2]
LONG = BAR + ["-end_time", 1e6, "-output_interval", 0.5]


class ResultFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, ranks, *words):
        process = subprocess.Popen(program.words([*LONG, "-output", self.folder, *words], ranks),
                                   cwd=program.SOURCE, env=program.ENVIRONMENT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        deadline = time.time() + 120
        while not os.path.exists(self.path("history.h5")):
            self.assertIsNone(process.poll())
            self.assertLess(time.time(), deadline)
            time.sleep(0.02)
        return process

    def test_two_runs_do_not_share_it(self):
        for ranks in (1, 2):
            first = self.start(ranks)
            for others in (1, 2):
                program.must_refuse(self, [*BAR, "-output", self.folder],
                                    f"option -output {self.folder}: another run writes there (process ", ranks=others,
                                    timeout=120)
            dry = program.must_end(self, [*BAR, "-output", self.folder, "-dry_run"], 1)
            with open(self.path("running.lock")) as file:
                os.kill(int(file.read().split()[1]), signal.SIGTERM)
            self.assertEqual(first.wait(120), 2)
            os.remove(self.path("history.h5"))

    def test_what_an_earlier_run_left_goes(self):
        for ranks in (1, 2):
            result = program.must_end(self, [*BAR, "-output", self.folder], ranks)
            with open(self.path("notes.txt"), "w") as file:
                file.write("mine")
            again = program.run([*BAR, "-output", self.folder], ranks)
            self.assertIn(f"removed from {self.folder}, left by an earlier run: resolved.yaml summary.json",
                          again.stdout)
            self.assertTrue(os.path.exists(self.path("summary.json")))
            os.remove(self.path("history.h5"))
            killed = self.start(ranks)
            killed.kill()
            killed.wait()
            time.sleep(1)  # ranks notice the end of mpirun
            self.assertFalse(os.path.exists(self.path("summary.json")))
            self.assertTrue(os.path.exists(self.path("notes.txt")))
            for name in os.listdir(self.folder):
                os.remove(self.path(name))

    def test_marks_of_the_history(self):
        result = program.must_end(self, [*BAR, "-output", self.folder], 2)
        with h5py.File(self.path("history.h5"), "r") as file:
            self.assertEqual(file.attrs["complete"], 1)
            self.assertEqual(file["records"][0], len(file["time"]))
            self.assertEqual(file["acceleration"].shape[0], len(file["time"]))
        os.remove(self.path("history.h5"))
        for ranks in (1, 2):
            running = self.start(ranks)
            with open(self.path("running.lock")) as file:
                os.kill(int(file.read().split()[1]), signal.SIGTERM)
            self.assertEqual(running.wait(120), 2)
            with h5py.File(self.path("history.h5"), "r") as file:
                self.assertEqual(file.attrs["complete"], 0)
                self.assertEqual(file["records"][0], len(file["time"]))
                self.assertGreater(len(file["time"]), 0)
            os.remove(self.path("history.h5"))

    def test_a_few_records_are_there_after_some_seconds(self):
        """Far fewer than a buffer holds: they do not wait for the end."""
        running = self.start(2, "-output_interval", 1000)
        deadline = time.time() + 60
        rows = 0
        while rows == 0 and time.time() < deadline:
            time.sleep(0.5)
            with h5py.File(self.path("history.h5"), "r", swmr=True, libver="latest") as file:
                rows = int(file["records"][0])
        running.kill()
        self.assertGreater(rows, 0)
        self.assertLess(rows, 4096)

    def test_no_link_is_followed(self):
        """Links of every name that a run writes: what they point to stays as it is, and the results are files."""
        words = [*BAR, "-end_time", 0.2, "-fields_interval", 0.1, "-write_modes", "-write_model", "-checkpoint_steps", 50,
                 "-forces", "base", "-base_kind", "reactions", "-base_structure", "bar", "-output", self.folder]
        result = program.must_end(self, words, 2)
        names = os.listdir(self.folder)
        self.assertGreater(len(names), 10)
        elsewhere = tempfile.mkdtemp(prefix="pounding-elsewhere-")
        drafts = [name + ".new" for name in names]
        for name in [*names, *drafts, "running.lock"]:
            with open(os.path.join(elsewhere, name), "w") as file:
                file.write("mine")
            if name in names:
                os.remove(self.path(name))
            os.symlink(os.path.join(elsewhere, name), self.path(name))
        result = program.must_end(self, words, 2)
        for name in os.listdir(elsewhere):
            with open(os.path.join(elsewhere, name)) as file:
                self.assertEqual(file.read(), "mine", name)
        for name in names:
            self.assertTrue(os.path.isfile(self.path(name)) and not os.path.islink(self.path(name)), name)

    def test_exported_matrices_go_through_no_link(self):
        words = [*BAR, "-export_matrices", self.folder, "-dry_run"]
        self.assertEqual(program.run(words, 1).returncode, 0)
        target = self.path("target")
        for name in os.listdir(self.path("bar")):
            os.remove(os.path.join(self.path("bar"), name))
            os.symlink(target, os.path.join(self.path("bar"), name))
        with open(target, "w") as file:
            file.write("mine")
        self.assertEqual(program.run(words, 2).returncode, 0)
        with open(target) as file:
            self.assertEqual(file.read(), "mine")
        shutil.move(self.path("bar"), self.path("elsewhere"))
        os.symlink(self.path("elsewhere"), self.path("bar"))
        program.must_refuse(self, words, "bar: a symbolic link")

    def test_seal_leaves_alone_what_is_not_sealed(self):
        path = self.path("notes.txt")
        text = b"pounding seal 1\nbytes 9\ncrc32 00000000\nis how a checkpoint begins\n" + b"notes\n" * 200
        for content in (text, text[:100], b"pounding seal 1\n", b"pounding seal 1\nbytes 1\ncrc32 00000000\n"):
            with open(path, "wb") as file:
                file.write(content)
            result = program.command("seal", path)
            self.assertEqual(result.returncode, 1)
            self.assertIn("does not begin with a seal", result.stderr)
            with open(path, "rb") as file:
                self.assertEqual(file.read(), content)
        result = program.command("seal", self.folder)
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), result.stderr)

    def test_a_summary_is_whole_or_not_there(self):
        os.mkdir(self.path("summary.json.new"))  # where it would be drafted
        program.must_refuse(self, [*BAR, "-output", self.folder],
                            "summary.json.new: cannot be written: something that is no file has that name", ranks=2)
        self.assertFalse(os.path.exists(self.path("summary.json")))


if __name__ == "__main__":
    unittest.main()
