"""Runs one file of tests and keeps, of every assertion with a tolerance, how far off the program was.

    python3 measured.py TEST.py FIGURES.json

The assertions stay those of unittest; they are only watched. An assertion of closeness gives the
difference and what is allowed; `a <= b` of two numbers gives a as the error and b as what is allowed.
"""

import importlib.util
import json
import numbers
import os
import signal
import sys
import unittest
from pathlib import Path


ENERGY = "energy identity"  # every recorded run asserts it: one row for all of a file


class Watch:
    """Per test, the number of checks and the one that came nearest to what is allowed."""

    def __init__(self):
        self.tests = {}

    def note(self, test: unittest.TestCase, error: float, allowed: float, label) -> None:
        name = ENERGY if label == ENERGY else test.id().split(".")[-1]
        found = self.tests.setdefault(name, {"checks": 0, "share": -1.0, "error": 0.0, "allowed": 0.0, "what": ""})
        found["checks"] += 1
        if allowed > 0 and abs(error) / allowed > found["share"]:
            found.update(share=abs(error) / allowed, error=abs(error), allowed=allowed, what=label if isinstance(label, str) else "")


def is_number(value) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def watched(watch: Watch) -> None:
    """Lets the assertions of unittest tell what they compare before they judge it."""
    almost_equal = unittest.TestCase.assertAlmostEqual

    def assert_almost_equal(self, first, second, places=None, msg=None, delta=None):
        allowed = delta if delta is not None else 0.5 * 10.0**-(7 if places is None else places)
        if is_number(first) and is_number(second):
            watch.note(self, float(first - second), float(allowed), msg)
        almost_equal(self, first, second, places=places, msg=msg, delta=delta)

    def of_order(name: str, swapped: bool):
        plain = getattr(unittest.TestCase, name)

        def assertion(self, a, b, msg=None):
            error, allowed = (b, a) if swapped else (a, b)
            # Counts and bounds that are no tolerances are left out.
            if isinstance(error, float) and is_number(allowed) and 0 < allowed < 0.5 and error >= 0:
                watch.note(self, float(error), float(allowed), msg)
            plain(self, a, b, msg)
        return assertion

    unittest.TestCase.assertAlmostEqual = assert_almost_equal
    unittest.TestCase.assertLess = of_order("assertLess", False)
    unittest.TestCase.assertLessEqual = of_order("assertLessEqual", False)


def end_with_runs(number, _frame) -> None:
    """The runs that tests have started end with them: they are of one process group, which run/verification begins."""
    signal.signal(number, signal.SIG_IGN)
    os.killpg(0, number)
    os._exit(1)


def main() -> int:
    if os.getpgrp() == os.getpid():
        signal.signal(signal.SIGTERM, end_with_runs)
    path, figures = Path(sys.argv[1]), Path(sys.argv[2])
    sys.path.insert(0, str(path.parent))
    watch = Watch()
    watched(watch)
    specification = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(specification)
    sys.modules[path.stem] = module
    specification.loader.exec_module(module)
    result = unittest.TextTestRunner(stream=sys.stderr, verbosity=0).run(
        unittest.defaultTestLoader.loadTestsFromModule(module))
    figures.write_text(json.dumps({
        "problem": " ".join(module.__doc__.split("\n\n")[0].split()),
        "passed": result.wasSuccessful(), "run": result.testsRun, "skipped": len(result.skipped),
        "tests": watch.tests}, indent=1))
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
