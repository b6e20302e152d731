"""The kernels of the vector units that the program was built for, one or all: no instruction of a higher unit is elsewhere,
and all answer alike."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import program
import two_buildings

SOURCE = Path(program.SOURCE)
# Instructions that machines with SSE4.2 alone lack: AVX and all after it begin with v; those of v3 without vectors.
# tzcnt is bsf to them, which is as good where g++ writes it, of numbers that are not zero.
BEYOND_V2 = re.compile(r"^(v(?!err|erw)\w+|andn|bextr|bls(i|r|msk)|bzhi|mulx|pdep|pext|rorx|sarx|shlx|shrx|lzcnt"
                       r"|movbe|k(and|or|mov|xor|not|test|add|shift|unpck|ortest)\w*)[lqwbd]?$")
BEYOND_V3 = re.compile(r"%zmm|%[xy]mm(1[6-9]|2\d|3[01])|%k[0-7]")


def build_option(name):
    cache = Path(program.BUILD, "CMakeCache.txt").read_text()
    return re.search(rf"^{name}:\w+=(.*)$", cache, re.MULTILINE)[1]


def instructions(file):
    """Of a program: (section, function, mnemonic, operands) of every instruction."""
    out = subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", file], stdout=subprocess.PIPE, text=True)
    section = function = ""
    for line in out.stdout:
        if line.startswith("Disassembly of section "):
            section = line.split()[-1].rstrip(":")
        elif line.endswith(">:\n"):
            function = line.split("<", 1)[1][:-3]
        elif line.startswith(" "):
            _, _, text = line.rstrip().partition(":\t")
            mnemonic, _, operands = text.partition(" ")
            yield section, function, mnemonic, operands
    if out.wait() != 0:
        raise RuntimeError(f"objdump cannot read {file}")


UNITS = build_option("POUNDING_VECTOR_UNITS").split(";")


@unittest.skipUnless(UNITS == ["v2", "v3", "v4"], "not built for all vector units (-DPOUNDING_VECTOR_UNITS=all)")
class Instructions(unittest.TestCase):
    def test_above_the_unit_are_nowhere(self):
        for name in ("pounding", "pounding-spectra"):
            seen, strange = {}, []
            for section, function, mnemonic, operands in instructions(Path(program.BUILD, name)):
                seen[section] = seen.get(section, 0) + 1
                limit = {"text_v4": False, "text_v3": BEYOND_V3.search(operands)}
                if limit.get(section, BEYOND_V2.match(mnemonic)):
                    strange.append(f"{section} {function}: {mnemonic} {operands}")
            self.assertEqual(strange[:5], [], name)
            for unit in ("v2", "v3", "v4"):
                self.assertGreater(seen[f"text_{unit}"], 1000, name)

    def test_wide_ones_are_in_the_kernels(self):
        wide = {"text_v3": "%ymm", "text_v4": "%zmm"}
        counts = dict.fromkeys(wide, 0)
        for section, _, _, operands in instructions(Path(program.BUILD, "pounding")):
            counts[section] = counts.get(section, 0) + (wide.get(section, "?") in operands)
        self.assertGreater(counts["text_v3"], 5000)
        self.assertGreater(counts["text_v4"], 5000)


@unittest.skipUnless(UNITS in (["v2"], ["v3"], ["v4"]), "built for several vector units, or another processor")
class OfOneUnit(unittest.TestCase):
    """Kernels of one unit are linked as they are, among all else."""

    def test_wide_instructions_are_those_of_the_unit(self):
        wide, above = {"v2": ("%xmm", BEYOND_V2), "v3": ("%ymm", BEYOND_V3), "v4": ("%zmm", None)}[UNITS[0]]
        found, strange = 0, []
        for section, function, mnemonic, operands in instructions(Path(program.BUILD, "pounding")):
            found += wide in operands
            if above and above.search(mnemonic if UNITS[0] == "v2" else operands):
                strange.append(f"{section} {function}: {mnemonic} {operands}")
        self.assertEqual(strange[:5], [])
        self.assertGreater(found, 5000)

    def test_the_check_at_the_start_needs_none_of_them(self):
        """On a machine without the unit the program must come as far as the line that says so."""
        check = [mnemonic for _, function, mnemonic, _ in instructions(Path(program.BUILD, "pounding"))
                 if function == "pounding_use_best_unit"]
        self.assertGreater(len(check), 5)
        self.assertEqual([mnemonic for mnemonic in check if BEYOND_V2.match(mnemonic)], [])


def best_unit(folder):
    return json.loads(Path(folder, "summary.json").read_text())["kernels"]["vector_unit"]


class Runs(unittest.TestCase):
    """Two buildings that hit each other, by the kernels of every unit of this machine."""

    def run_with(self, unit, name):
        folder = os.path.join(self.folder, name)
        two_buildings.run(folder, gap=0.01, vector_unit=unit)
        return folder

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="pounding-")
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def history(self, folder):
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            return np.array([file["displacement"][:], file["velocity"][:]])

    def test_answer_alike(self):
        best = self.run_with("auto", "auto")
        reference = self.history(best)
        self.assertIn(best_unit(best), UNITS)
        for unit in UNITS[:UNITS.index(best_unit(best)) + 1]:
            folder = self.run_with(unit, unit)
            self.assertEqual(best_unit(folder), unit)
            found = self.history(folder)
            if unit == best_unit(best):
                np.testing.assert_array_equal(found, reference)
            for own, other in zip(found, reference):
                self.assertLess(np.abs(own - other).max() / np.abs(other).max(), 1e-9, unit)

    def test_another_is_refused(self):
        program.must_refuse(self, ["-options_file", str(two_buildings.SCENE), "-vector_unit", "v9"], "-vector_unit", "v9",
                            "auto v2 v3 v4")

    @unittest.skipUnless(len(UNITS) == 1, "built for several vector units")
    def test_one_that_was_not_built_is_refused(self):
        other = "v3" if UNITS == ["v2"] else "v2"
        program.must_refuse(self, ["-options_file", str(two_buildings.SCENE), "-vector_unit", other], "-vector_unit", other,
                            "-DPOUNDING_VECTOR_UNITS=all")


if __name__ == "__main__":
    unittest.main()
