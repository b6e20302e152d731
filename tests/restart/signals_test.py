"""A run that a signal stops, or that is killed, is continued to what the uninterrupted run leaves, to the last bit."""
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

import program
from restart_test import BAR, RestartCase, checkpoint, checkpoint_step, history

PROCESSORS = 2  # signals to ranks


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        return [int(child) for child in file.read().split()]


class Running:
    """The program at work, to be interrupted."""

    def __init__(self, arguments, ranks=2):
        self.command = program.words(arguments, ranks)
        self.process = subprocess.Popen(self.command, cwd=program.SOURCE, env=program.ENVIRONMENT,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for_step(self, folder, step):
        """Until there is a checkpoint at this step or a later one."""
        while self.process.poll() is None:
            if os.path.exists(checkpoint(folder)) and checkpoint_step(folder) >= step:
                return
            time.sleep(0.002)
        raise AssertionError(f"the run was over before a checkpoint at step {step}")

    def finish(self):
        out, error = self.process.communicate(timeout=300)
        return subprocess.CompletedProcess(self.command, self.process.returncode, out, error)


class Signals(RestartCase):
    CASE = BAR + ["-end_time", 5000, "-output_interval", 0.1, "-energy_interval", 400]

    @classmethod
    def setUpClass(cls):
        cls.whole = tempfile.mkdtemp(prefix="pounding-")
        program.must_end(cls(), [*cls.CASE, "-output", cls.whole], 2)

    def interrupted(self, send):
        """Starts the case, calls `send` with mpirun's number in the middle of it."""
        folder = self.folder()
        running = Running([*self.CASE, "-output", folder, "-checkpoint_steps", 20000])
        running.wait_for_step(folder, 20000)
        send(running.process.pid)
        return folder, running.finish()

    def assert_stopped(self, folder, result, name):
        lines = program.error_lines(result)
        self.assertEqual(len(lines), 1, result.stderr)
        stopped = re.search(f"stopped by {name} after step ([0-9]+) of [0-9]+, t = ([0-9.e+]+) s", lines[0])
        self.assertIsNotNone(stopped, lines[0])
        time = history(folder)["time"][-1]  # of the last record, up to an interval before
        self.assertTrue(time - 1e-3 <= float(stopped.group(2)) <= time + 0.101, (lines[0], time))
        self.assertIn(f"-restart {checkpoint(folder)}", lines[0])
        self.assertFalse(os.path.exists(os.path.join(folder, "summary.json")))
        step = checkpoint_step(folder)
        self.assertIn(f"after step {step} ", lines[0])
        samples = len(history(folder)["time"])
        self.assertGreater(samples, 1)
        for name in ("impacts.csv", "energy.csv"):
            self.assertGreater(len(program.read_csv(os.path.join(folder, name))), 1)

    def test_signal_to_one_rank_then_restart(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)[:3 if program.ALL else 1]:
            folder, result = self.interrupted(lambda pid: os.kill(children(pid)[-1], number))
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assert_stopped(folder, result, number.name)
            self.complete([*self.CASE, "-restart", checkpoint(folder)], 2, folder)
            self.assert_same_results(self.whole, folder)

    def test_signal_to_mpirun(self):
        # Not SIGTERM: mpirun itself kills the ranks one second after it has passed it on.
        folder, result = self.interrupted(lambda pid: os.kill(pid, signal.SIGUSR1))
        self.assertNotEqual(result.returncode, 0)
        self.assert_stopped(folder, result, "SIGUSR1")

    def test_checkpoints_by_wall_time(self):
        folder = self.folder()
        running = Running([*self.CASE, "-end_time", 1e6, "-checkpoint_interval", 0.2,
                           "-output", folder])
        running.wait_for_step(folder, 1)
        first = checkpoint_step(folder)
        self.assertGreater(first, 0)
        os.kill(children(running.process.pid)[0], signal.SIGTERM)
        self.assertEqual(running.finish().returncode, 2)
        self.assertGreater(checkpoint_step(folder), first)

    def test_killed_again_and_again(self):
        folder = self.folder()
        arguments = [*self.CASE, "-output", folder, "-checkpoint_steps", 3000]

        def kill_all(pid):
            for process in [*children(pid), pid]:
                os.kill(process, signal.SIGKILL)

        restart = []
        step = 0
        for _ in range(4 if program.ALL else 2):
            running = Running(arguments + restart)
            running.wait_for_step(folder, step + 15000)
            kill_all(running.process.pid)
            running.finish()
            step = checkpoint_step(folder)
            restart = ["-restart", checkpoint(folder)]
        self.complete(arguments + restart, 2, folder)
        self.assert_same_results(self.whole, folder)


if __name__ == "__main__":
    unittest.main()
