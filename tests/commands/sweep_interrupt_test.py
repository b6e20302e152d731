"""Ctrl-C and SIGTERM between the start of a run and the moment when its command knows of it: no run goes on alone."""
import os
import signal
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.commands.process import stop_when_terminated  # noqa: E402
from pounding.study import run_side_by_side  # noqa: E402
from pounding import runs  # noqa: E402

PROCESSORS = 2  # it starts runs


class Interrupt(unittest.TestCase):
    def setUp(self):
        place = tempfile.mkdtemp(prefix="pounding-")
        self.place, self.jobs = Path(place), []
        sleeper = mock.patch.object(runs, "command", lambda words, ranks: ["sleep", "60"])
        sleeper.start()
        self.addCleanup(sleeper.stop)
        before = signal.getsignal(signal.SIGTERM)
        self.addCleanup(signal.signal, signal.SIGTERM, before)

    def start_while(self, number):
        """Starts a run while the signal arrives."""
        job = runs.Job([], self.place / str(len(self.jobs)), 1, self.place, dict(os.environ))
        self.jobs.append(job)
        os.kill(os.getpid(), number)
        return job

    def no_run_goes_on(self):
        self.assertEqual(len(self.jobs), 1)
        self.assertFalse(self.jobs[0].running)

    def test_runs_side_by_side(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            stop_when_terminated()
            self.jobs.clear()
            with self.assertRaises(KeyboardInterrupt):
                run_side_by_side(["one", "two"], 2, lambda _item: self.start_while(number), lambda *_: self.fail())
            self.no_run_goes_on()

    def test_one_run(self):
        with self.assertRaises(KeyboardInterrupt):
            runs.finish(lambda: self.start_while(signal.SIGINT))
        self.no_run_goes_on()

    def test_handlers_come_back(self):
        before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
        with runs.interrupts_held():
            self.assertNotEqual(signal.getsignal(signal.SIGINT), before[0])
        self.assertEqual([signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)], before)

    def test_what_is_ignored_stays_ignored(self):
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            with runs.interrupts_held():
                os.kill(os.getpid(), signal.SIGINT)
        finally:
            signal.signal(signal.SIGINT, before)


if __name__ == "__main__":
    unittest.main()
