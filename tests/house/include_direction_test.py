"""Files include each other in one direction only: from the driver down to common."""
import os
import re
import unittest

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")

# module -> what it may include besides itself
MAY_INCLUDE = {
    "common": set(),
    "scene": {"common"},
    "elements": {"common"},
    "mesh": {"common", "scene", "elements"},
    "system": {"common", "scene", "elements", "mesh"},
    "modal": {"common", "scene", "mesh", "system"},
    "motion": {"common", "scene"},
    "contact": {"common", "scene", "elements", "mesh", "system"},
    "dynamics": {"common", "scene", "system", "contact", "motion"},
    "output": {"common", "scene", "mesh", "system", "modal", "motion", "dynamics"},
    "driver": {"common", "scene", "elements", "mesh", "system", "modal", "motion", "contact",
               "dynamics", "output"},
    "spectra": {"common", "scene", "motion", "output"},
    "main.cpp": {"common", "scene", "driver"},
    "spectra_main.cpp": {"spectra"},
    "mesh_main.cpp": {"mesh"},
}

PURE = {"elements": ("mpi.h", "petsc", "slepc"), "motion": ("mpi.h", "petsc", "slepc")}


def sources():
    for folder, _, files in os.walk(SOURCE):
        for name in files:
            path = os.path.join(folder, name)
            yield os.path.relpath(path, SOURCE), path


class IncludeDirection(unittest.TestCase):
    def test_every_include_points_down(self):
        seen = 0
        for name, path in sources():
            module = name.split(os.sep)[0]
            self.assertIn(module, MAY_INCLUDE, f"{name} is in no known module")
            with open(path) as file:
                for line in file:
                    found = re.match(r'#include "([^"/]+)/', line)
                    if found:
                        seen += 1
                        other = found.group(1)
                        self.assertTrue(other == module or other in MAY_INCLUDE[module],
                                        f"{name} includes {other}: {line.strip()}")
        self.assertGreater(seen, 50)

    def test_pure_modules_know_no_mpi(self):
        for name, path in sources():
            for word in PURE.get(name.split(os.sep)[0], ()):
                with open(path) as file:
                    self.assertNotIn(f"#include <{word}", file.read(), name)

    def test_files_stay_small(self):
        for name, path in sources():
            with open(path) as file:
                lines = len(file.readlines())
            self.assertLessEqual(lines, 80 if name == "main.cpp" else 500, name)


if __name__ == "__main__":
    unittest.main()
