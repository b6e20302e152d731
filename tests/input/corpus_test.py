"""Broken inputs by the hundred on one rank, and of each kind of reader the first also on three: one line that names
culprit and remedy, exit status 1 on every rank, no results, no hang. The cases are data in tests/input/corpus; a table of
them is printed.

    PYTHONPATH=tests /usr/bin/python3 tests/input/corpus_test.py Corpus.test_meshes
    ... corpus_test.py --show "a bar of no length"      # what the program says to one case
"""
import collections
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import program
from corpus import case, checkpoints, matrices, mesh, options, records, results, scenes

CLASSES = {"options": options, "scenes": scenes, "meshes": mesh, "records": records, "results": results,
           "matrices": matrices, "checkpoints": checkpoints}
LIMIT = 60       # s a case may take, on a machine as busy as it gets
AT_ONCE = 2      # cases side by side
MAY_BE_THERE = {"resolved.yaml"}  # the options in force, which say nothing of results
NOISE = re.compile(r"PETSC ERROR|HDF5-DIAG|MPI_ABORT|\*\*\* Process|internal error|Segmentation|terminate called")
Outcome = collections.namedtuple("Outcome", "case ranks statuses stderr files")


def start(words, ranks):
    """Runs to the end or to the limit; returns exit statuses by rank (None where it did not end) and stderr."""
    try:
        result = program.run(words, ranks, LIMIT)
    except subprocess.TimeoutExpired:
        return [None] * ranks, ""
    return [result.returncode] * ranks, result.stderr


def run(one, ranks, made):
    """Makes the files of a case, runs the program on them and returns what came of it."""
    folder = tempfile.mkdtemp(prefix="pounding-corpus-")
    try:
        words = case.prepare(one, folder, made)
        output = os.path.join(folder, "results")
        if "-output" not in words:
            words += ["-output", output]
        statuses, stderr = start(words, ranks)
        left = sorted(os.listdir(output)) if os.path.isdir(output) else []
        return Outcome(one, ranks, statuses, stderr.replace(folder, "{folder}").replace(made, "{made}"), left)
    finally:
        shutil.rmtree(folder)


def fault(outcome):
    """What is wrong with the way a case was refused; "" where it was refused as it should be."""
    lines = outcome.stderr.splitlines()
    own = [line for line in lines if line.startswith("pounding: ")]
    if None in outcome.statuses:
        return f"did not end within {LIMIT} s"
    if any(status == 0 for status in outcome.statuses):
        return "accepted"
    if any(status != 1 for status in outcome.statuses):
        return f"exit status {outcome.statuses}"
    if len(own) != 1 or len(lines) != 1 or NOISE.search(outcome.stderr):
        return f"{len(own)} lines of ours in {len(lines)} on stderr:\n{outcome.stderr[:1500]}"
    missing = [word for word in outcome.case.words if word not in own[0]]
    if missing:
        return f"{missing} not in: {own[0]}"
    left = set(outcome.files) - MAY_BE_THERE
    return f"left {sorted(left)}" if left else ""


def make_sound(made):
    """What sound runs leave, for the cases to spoil: a checkpoint with its history, matrices, a basis."""
    sound = case.Case("sound", [], [])
    words = case.prepare(sound, os.path.join(made, "scene"), made)
    for more in (["-output", f"{made}/run", "-checkpoint_steps", "20"],
                 ["-output", f"{made}/none", "-dry_run", "-export_matrices", f"{made}/matrices"],
                 ["-output", f"{made}/reduced", "-left_model", "modal", "-left_modal_vectors", "4",
                  "-left_modal_basis", f"{made}/basis.h5"]):
        statuses, stderr = start(words + more, 1)
        if statuses != [0]:
            raise RuntimeError(f"the sound scene with {more}: {stderr}")
    return made


class Corpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = []
        cls.made = make_sound(tempfile.mkdtemp(prefix="pounding-made-"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.made)
        print(f"\n{'class':14}{'cases':>7}{'runs':>7}{'refused':>9}   exit status", flush=True)
        for row in cls.table:
            print(f"{row[0]:14}{row[1]:>7}{row[2]:>7}{row[3]:>9}   {row[4]}", flush=True)
        print(f"{'all':14}{sum(row[1] for row in cls.table):>7}{sum(row[2] for row in cls.table):>7}"
              f"{sum(row[3] for row in cls.table):>9}", flush=True)

    def refuse(self, name):
        cases = CLASSES[name].CASES
        jobs = [(one, one.ranks[0]) for one in cases]
        jobs.append((next(one for one in cases if len(one.ranks) > 1), 3))
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            outcomes = list(pool.map(lambda job: run(*job, self.made), jobs))
        faults = [(outcome, fault(outcome)) for outcome in outcomes]
        statuses = collections.Counter(str(status) for outcome in outcomes for status in outcome.statuses)
        self.table.append((name, len(cases), len(jobs), sum(not text for _, text in faults),
                           ", ".join(f"{status}: {count}" for status, count in sorted(statuses.items()))))
        for outcome, text in faults:
            if text:
                with self.subTest(case=outcome.case.name, ranks=outcome.ranks):
                    self.fail(text)

    def test_sound_scenes_run(self):
        for scene in ("scene.yaml", "frame.yaml"):
            for ranks in (1, 3):
                outcome = run(case.Case(scene, [], [], scene=scene), ranks, self.made)
                self.assertEqual(outcome.statuses, [0] * ranks, outcome.stderr)
                self.assertEqual(outcome.stderr, "")
        for more in (checkpoints.RESTART_SOUND, checkpoints.BASIS_SOUND, matrices.SOUND):
            outcome = run(more, 1, self.made)
            self.assertEqual(outcome.statuses, [0], outcome.stderr)

    def test_names_are_distinct(self):
        names = [(key, one.name) for key, module in CLASSES.items() for one in module.CASES]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreaterEqual(len(names), 200)

    def test_options(self):
        self.refuse("options")

    def test_scenes(self):
        self.refuse("scenes")

    def test_meshes(self):
        self.refuse("meshes")

    def test_records(self):
        self.refuse("records")

    def test_results(self):
        self.refuse("results")

    def test_matrices(self):
        self.refuse("matrices")

    def test_checkpoints(self):
        self.refuse("checkpoints")


def show(names):
    """Prints what the program says to cases, by their names."""
    made = make_sound(tempfile.mkdtemp(prefix="pounding-made-"))
    for one in (one for module in CLASSES.values() for one in module.CASES if one.name in names):
        for ranks in one.ranks:
            outcome = run(one, ranks, made)
            print(f"{one.name} on {ranks}: {outcome.statuses} {fault(outcome) or 'refused'}\n{outcome.stderr}")
    shutil.rmtree(made)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--show"]:
        show(sys.argv[2:])
    else:
        unittest.main()
