"""The kernels on another processor, aarch64, emulated: their own tests pass there as well. With `run/test --all`, where a
cross compiler (g++-aarch64-linux-gnu), an emulator (qemu-user) and the source of GoogleTest (googletest) are installed."""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import program

SOURCE = Path(program.SOURCE)
COMPILER, EMULATOR, GOOGLETEST = "aarch64-linux-gnu-g++", "qemu-aarch64", Path("/usr/src/googletest/googletest")


def sources_of(tests):
    """Tests, and the source beside every header that they include, of whatever depth."""
    seen, left = set(), list(tests)
    while left:
        file = left.pop()
        if file in seen or not file.exists():
            continue
        seen.add(file)
        for name in re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE):
            left += [SOURCE / "src" / name, (SOURCE / "src" / name).with_suffix(".cpp")]
    return sorted(str(file) for file in seen if file.suffix == ".cpp")


@program.long
@unittest.skipUnless(shutil.which(COMPILER) and shutil.which(EMULATOR) and GOOGLETEST.exists(), "no cross compiler here")
class OnAarch64(unittest.TestCase):
    def test_kernels_pass_their_tests(self):
        words = [COMPILER, "-std=c++20", "-O1", "-static", "-pthread", "-ffp-contract=off", "-Wno-psabi", "-DPOUNDING_KERNELS",
                 f"-I{SOURCE}/src", f"-I{GOOGLETEST}", f"-I{GOOGLETEST}/include", f"{GOOGLETEST}/src/gtest-all.cc",
                 f"{GOOGLETEST}/src/gtest_main.cc", *sources_of((SOURCE / "tests" / "kernels").glob("*_test.cpp"))]
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            tests = f"{folder}/kernel_tests"
            built = subprocess.run([*words, "-o", tests], capture_output=True, text=True)
            self.assertEqual(built.returncode, 0, built.stderr[-3000:])
            done = subprocess.run([EMULATOR, tests], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-1000:])
            self.assertRegex(done.stdout, r"\[  PASSED  \] [1-9]\d* tests")


if __name__ == "__main__":
    unittest.main()
