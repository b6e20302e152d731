"""Commands that are stopped or killed leave no run behind; two in one folder do not disturb each other."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import program
import two_buildings

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding import study  # noqa: E402

PROCESSORS = 2  # killed runs

ENVIRONMENT = {**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)}
# A run of a minute in the place of the program's, started as commands start theirs.
SLEEPER = """
import os, sys
sys.path[:0] = [sys.argv[1]]
from pathlib import Path
from pounding.commands.process import begin, stop_when_terminated
begin("run/sleeper")
from pounding import runs
runs.command = lambda words, ranks: ["sleep", sys.argv[2]]
stop_when_terminated()
runs.finish(lambda: print(runs.Job([], Path(sys.argv[3]), 1, Path("."), dict(os.environ)).process.pid, flush=True)
            or sys.stdin.read() or None)
"""


def processes(text):
    """Command lines of processes that hold the text, without this one's."""
    found = subprocess.run(["pgrep", "-a", "-f", text], capture_output=True, text=True, check=False).stdout
    return [line for line in found.splitlines() if not line.startswith(f"{os.getpid()} ")]


class InFolder(unittest.TestCase):
    def setUp(self):
        self.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        for path in two_buildings.FOLDER.iterdir():
            shutil.copy(path, self.place)

    def start(self, name, *words):
        job = subprocess.Popen([os.path.join(program.SOURCE, "run", name), *map(str, words)], cwd=self.place,
                               env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(job.kill)
        return job

    def nothing_is_left(self):
        deadline = time.monotonic() + 60
        while processes(str(self.place)) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(processes(str(self.place)), [])


class Stopped(InFolder):
    def stop(self, number, name, *words):
        with self.start(name, *words) as job:
            deadline = time.monotonic() + 120
            while job.poll() is None and not list(self.place.glob("out/**/running.lock")):
                self.assertLess(time.monotonic(), deadline, "no run began")
                time.sleep(0.05)
            self.assertIsNone(job.poll())
            job.send_signal(number)
            job.wait(60)
            said = job.stderr.read()
        if number != signal.SIGKILL:
            self.assertEqual(job.returncode, 1)
            self.assertEqual(said.strip().splitlines(), [said.strip()])
        self.nothing_is_left()

    def test_killed(self):
        self.stop(signal.SIGKILL, "sweep", "two-buildings.yaml", "--set", "end_time=900,901", "--ranks", 2, "--jobs", 2,
                  "--options", "-probes left_roof", "--out", self.place / "out")

    def test_terminated_and_hung_up(self):
        self.stop(signal.SIGTERM, "tradeoff", "--scene", "two-buildings.yaml", "--window", 900, "--output",
                  self.place / "out")
        shutil.rmtree(self.place / "out")
        self.stop(signal.SIGHUP, "sweep", "two-buildings.yaml", "--set", "end_time=900", "--out", self.place / "out")


LONG = """
\"\"\"A run of many minutes.\"\"\"
import unittest
import program

class Long(unittest.TestCase):
    def test_it(self):
        program.launch(["-options_file", PLACE + "/two-buildings.yaml", "-probes", "left_roof", "-end_time", 900,
                        "-output", PLACE + "/out/run"], RANKS)
"""


class Verification(Stopped):
    def test_killed(self):
        self.verify(signal.SIGKILL, 2)

    def test_terminated_and_hung_up(self):
        self.verify(signal.SIGTERM, 2)

    def verify(self, number, ranks):
        (self.place / "problems").mkdir()
        (self.place / "problems" / "long_test.py").write_text(
            LONG.replace("PLACE", repr(str(self.place))).replace("RANKS", str(ranks)))
        self.stop(number, "verification", "--problems", self.place / "problems", "--output", self.place / "figures")


class Tied(unittest.TestCase):
    """A run ends with its command however that dies."""

    def test_by_any_signal(self):
        seconds = str(60 + os.getpid() / 1e7)  # tells this sleeper from others
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            with self.subTest(number), tempfile.TemporaryDirectory() as place:
                job = subprocess.Popen([sys.executable, "-B", "-c", SLEEPER, os.path.join(program.SOURCE, "python"),
                                        seconds, place], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
                child = int(job.stdout.readline())
                job.send_signal(number)
                said = job.communicate(timeout=60)[1]
                deadline = time.monotonic() + 30
                while os.path.exists(f"/proc/{child}") and time.monotonic() < deadline:
                    time.sleep(0.02)
                self.assertFalse(os.path.exists(f"/proc/{child}"))
                self.assertNotIn("Traceback", said)


class Locks(InFolder):
    def test_a_second_command_in_one_folder_is_refused(self):
        (self.place / "study.yaml").write_text(
            "scene: two-buildings.yaml\nmotions: {x: {target: ground.csv, seeds: [1, 2]}}\nlevels: [2]\n"
            "gaps: [0.01]\njoints: {floor1: {}}\n")
        out = self.place / "out"
        with study.alone_in(out, "run/first"):
            for words in (("sweep", "two-buildings.yaml", "--set", "end_time=1", "--out", out),
                          ("tradeoff", "--scene", "two-buildings.yaml", "--output", out),
                          ("fragility", "study.yaml", "--out", out), ("plant", "--out", out),
                          ("campaign", "--output", out, "--no-tables")):
                with self.subTest(words[0]), self.start(*words) as job:
                    said = job.communicate(timeout=120)[1]
                    self.assertEqual(job.returncode, 1, said)
                    self.assertIn("run/first, process", said)
                    self.assertEqual(len(said.splitlines()), 1, said)
        self.assertEqual([path.name for path in out.iterdir()], [study.LOCK])

    def test_the_lock_ends_with_the_command(self):
        with study.alone_in(self.place, "run/first"):
            with self.assertRaises(study.FolderTaken), study.alone_in(self.place, "run/second"):
                self.fail("two at once")
        with study.alone_in(self.place, "run/second", shared=True), \
                study.alone_in(self.place, "run/third", shared=True):
            pass


class TooMany(InFolder):
    def test_ranks_and_runs_beyond_the_cores(self):
        for name, words in (("sweep", ("two-buildings.yaml", "--set", "end_time=1", "--ranks", 500)),
                            ("sweep", ("two-buildings.yaml", "--set", "end_time=1", "--jobs", 5000)),
                            ("tradeoff", ("--scene", "two-buildings.yaml", "--ranks", 500)),
                            ("plant", ("--ranks", 500))):
            with self.subTest(name), self.start(name, *words) as job:
                said = job.communicate(timeout=120)[1]
                self.assertIn(job.returncode, (1, 2))
                self.assertIn("cores: more than", said.replace("1 core:", "1 cores:"))
        with self.assertRaises(two_buildings.pounding.RunError):
            two_buildings.launched(self.place / "many", ranks=500)


if __name__ == "__main__":
    unittest.main()
