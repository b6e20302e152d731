"""Phases of the start-up that take long say so, on any number of ranks, once; so does the run itself, in a log by whole
lines, on a terminal in one line of its width."""
import fcntl
import os
import pty
import re
import struct
import subprocess
import tempfile
import termios
import unittest

import program

PROCESSORS = 2  # words while ranks run, on a terminal, and read by nobody

CASE = ["-options_file", "petsc-options/plant/frames.yaml", "-end_time", "0.02", "-modes", 1, "-dry_run",
        "-a_mesh_set", "size=2,bays_x=4", "-b_mesh_set", "size=2,bays_x=3,x_offset=24.05,face_at_end=0"]
SMALL = ["-structures", "bar", "-bar_mesh", "tests/meshes/box.geo", "-bar_body_element", "hex8_full",
         "-bar_body_material", "soft", "-material_soft_young", 900, "-material_soft_poisson", 0.2, "-material_soft_density", 1,
         "-bar_damping_beta", 1e-4, "-bar_gravity", "0,0,-10", "-contacts", "stop", "-stop_secondary", "bar:z_min",
         "-stop_primary", "wall", "-stop_gap", 0.5, "-end_time", 1]
PHASES = ("a: mesh", "b: mesh", "a: lowest modes", "a: largest frequency and stable time step",
          "a: bounds of the gap rates")


def phases(text):
    """The phases that printed progress, and how many times each of them ended."""
    found = re.findall(r"^  (\S.*?): \d+\.\d s(?:, (?!done)[^,\n]+)?(, done)?$", text, re.MULTILINE)
    return {name: sum(1 for other, done in found if other == name and done) for name, _ in found}


class Unheard(unittest.TestCase):
    """The words of a run end where nobody reads them, and not the run."""

    def ends_well(self, ranks, wrapped=(), lines=1):
        folder = tempfile.mkdtemp(prefix="pounding-")
        words = program.words([*SMALL, "-progress_interval", 1e-5, "-output", folder], ranks)
        words = words if ranks > 1 else words[words.index(program.PROGRAM):]
        with subprocess.Popen([*wrapped, *words], cwd=program.SOURCE, env=program.ENVIRONMENT, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as run:
            for _ in range(lines):
                run.stdout.readline()
            run.stdout.close()
            self.assertEqual((run.stderr.read(), run.wait(60)), ("", 0))
        self.assertIn("started", program.summary(folder))

    def test_after_a_line(self):
        self.ends_well(1)

    def test_after_a_line_of_two_ranks(self):
        self.ends_well(2)

    def test_closed_from_the_start(self):
        self.ends_well(1, ["bash", "-c", 'exec "$0" "$@" >&- <&-'], 0)


class Progress(unittest.TestCase):
    def test_every_long_phase_says_so_once(self):
        for ranks in (1, 2):
            result = program.must_end(self, CASE + ["-progress_interval", "1e-5"], ranks)
            told = phases(result.stdout)
            for phase in PHASES:
                self.assertEqual(told.get(phase), 1, (ranks, phase, result.stdout[:4000]))
            self.assertRegex(result.stdout, r"a: largest frequency and stable time step: \d\.\d s, \d+ products")
            self.assertRegex(result.stdout, r"a: bounds of the gap rates: \d\.\d s, row \d+ of \d+")

    def test_short_phases_are_silent(self):
        result = program.must_end(self, CASE + ["-progress_interval", "1000"])
        self.assertEqual(phases(result.stdout), {})


LOOP = ["-options_file", "petsc-options/plant/frames.yaml", "-end_time", "0.15", "-modes", 1, "-probes", "none",
        "-a_mesh_set", "size=2,bays_x=4", "-b_mesh_set", "size=2,bays_x=3,x_offset=24.05,face_at_end=0"]
LINE = re.compile(r"^  (\d+\.\d) %: t = (\S+) of 0\.15 s, (\S+) s of wall time per simulated s, (\d+) s left, "
                  r"smallest gap -?\d+\.\d\d mm, \d+ impacts, energy residual \S+$", re.MULTILINE)


class Steps(unittest.TestCase):
    def started(self, ranks, interval, **streams):
        folder = tempfile.mkdtemp(prefix="pounding-")
        line = program.words([*LOOP, "-progress_interval", interval, "-output", folder], ranks)
        return subprocess.Popen(line, cwd=program.SOURCE, env=program.ENVIRONMENT, stderr=subprocess.DEVNULL, **streams)

    def test_a_log_grows_line_by_line(self):
        """In a pipe: whole lines as they come, no carriage return, and numbers that agree with each other."""
        for ranks in (1, 2):
            running = self.started(ranks, 0.01, stdout=subprocess.PIPE)
            text, alive = b"", False
            with running.stdout:
                for line in running.stdout:
                    text += line
                    alive = alive or (b" %: t = " in line and running.poll() is None)
            self.assertEqual(running.wait(), 0)
            self.assertTrue(alive, "a line of progress came before the end")
            self.assertNotIn(b"\r", text)
            found = LINE.findall(text.decode())
            self.assertGreaterEqual(len(found), 2, text[-3000:])
            self.assertEqual(len(found), text.count(b" %: t = "), "every line is whole")
            for percent, time, cost, left in found:
                self.assertAlmostEqual(float(percent), 100 * float(time) / 0.15, delta=0.1)
                self.assertAlmostEqual(float(left), float(cost) * (0.15 - float(time)), delta=0.51 + 0.01 * float(cost))

    def test_short_runs_are_silent(self):
        running = self.started(2, 1000, stdout=subprocess.PIPE)
        text = running.communicate()[0]
        self.assertEqual(running.returncode, 0)
        self.assertNotIn(b" %: t = ", text)

    def test_a_terminal_has_one_line_of_its_width(self):
        for ranks in (1, 2):
            ours, theirs = pty.openpty()
            fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 61, 0, 0))
            running = self.started(ranks, 1000, stdout=theirs)
            os.close(theirs)
            text = b""
            while True:
                try:
                    more = os.read(ours, 65536)
                except OSError:     # the other end is closed
                    break
                text += more
            os.close(ours)
            self.assertEqual(running.wait(), 0)
            pieces = [piece.split(b"\n")[0] for piece in text.split(b"\r") if b" %: t = " in piece]
            self.assertGreater(len(pieces), 50)
            self.assertEqual({len(piece) for piece in pieces}, {60}, pieces[:3])


if __name__ == "__main__":
    unittest.main()
