"""Files include each other in one direction only: from the driver down to common, from room to room
and inside a room. No room holds more than a share of the house, no file grows long."""
import collections
import os
import re
import unittest

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")

# room -> what it may include besides itself
MAY_INCLUDE = {
    "common": set(),
    "io": {"common"},
    "scene": {"common", "elements", "soil"},
    "soil": {"common"},
    "elements": {"common"},
    "mesh": {"common", "scene", "elements"},
    "motion/records": {"common", "scene"},
    "motion": {"common", "io", "scene", "motion/records"},
    "stiffness/rows": {"common", "elements"},
    "stiffness/bricks": {"common", "elements", "stiffness/rows"},
    "stiffness/shells": {"common", "elements", "stiffness/rows"},
    "stiffness/strains": {"common", "elements"},
    "stiffness": {"common", "scene", "elements", "mesh", "stiffness/rows", "stiffness/bricks",
                  "stiffness/shells", "stiffness/strains"},
    "laws": {"common", "scene", "soil"},
    "solvers": {"common", "laws"},
    "interactions/pairing": {"common", "io", "scene", "soil", "elements", "mesh", "system"},
    "interactions": {"common", "scene", "elements", "mesh", "system", "laws", "solvers",
                     "interactions/pairing"},
    "system": {"common", "io", "scene", "elements", "mesh", "laws", "stiffness"},
    "modal": {"common", "io", "scene", "elements", "mesh", "stiffness", "system"},
    "stability": {"common", "scene", "mesh", "system", "modal"},
    "statics": {"common", "scene", "mesh", "system", "interactions", "laws", "solvers",
                "interactions/pairing"},
    "dynamics": {"common", "stiffness", "system", "interactions", "motion"},
    "output": {"common", "io", "mesh", "system"},
    "model": {"common", "scene", "elements", "mesh", "system", "modal", "stability", "motion", "interactions",
              "interactions/pairing", "statics", "dynamics"},
    "observers": {"common", "io", "scene", "elements", "mesh", "system", "modal", "motion", "motion/records",
                  "interactions", "laws", "interactions/pairing", "dynamics", "output", "model"},
    "checks": {"common", "scene", "mesh", "stability", "motion", "model", "observers"},
    "report": {"common", "io", "scene", "elements", "system", "stability", "motion", "output", "model", "observers",
               "checks"},
    "driver": {"common", "io", "scene", "mesh", "system", "modal", "stability", "interactions/pairing", "statics",
               "output", "model", "observers", "checks", "report"},
    "fidelity": {"common", "scene", "elements", "mesh", "system", "motion", "interactions", "dynamics", "model", "observers",
                 "driver"},
    "ensemble": {"common", "io", "scene", "mesh", "stiffness", "system", "modal", "stability", "motion",
                 "interactions/pairing", "dynamics", "output", "model", "observers", "checks", "report", "driver",
                 "fidelity"},
    "spectra": {"common", "io", "scene", "motion", "observers"},
    "run_job.h": set(),
    "run_job.cpp": {"common", "scene", "ensemble", "run_job.h"},
    "main.cpp": {"common", "io", "run_job.h"},
    "spectra_main.cpp": {"common", "spectra"},
    "mesh_main.cpp": {"mesh"},
}

PURE = {"elements": ("mpi.h", "petsc", "slepc"), "laws": ("mpi.h", "petsc", "slepc"),
        "solvers": ("mpi.h", "petsc", "slepc"), "soil": ("mpi.h", "petsc", "slepc"),
        "motion": ("mpi.h", "petsc", "slepc"), "motion/records": ("mpi.h", "petsc", "slepc"),
        "stiffness/rows": ("mpi.h", "petsc", "slepc"), "stiffness/bricks": ("mpi.h", "petsc", "slepc"),
        "stiffness/shells": ("mpi.h", "petsc", "slepc"),
        "stiffness/strains": ("mpi.h", "petsc", "slepc")}

LARGEST_SHARE = 0.12  # of the lines of src in one room


def sources():
    """Name below src, path."""
    for folder, _, files in os.walk(SOURCE):
        for name in files:
            path = os.path.join(folder, name)
            yield os.path.relpath(path, SOURCE), path


def room_of(name):
    return os.path.dirname(name) or name


def unit_of(name):
    """A header and its source are one."""
    return os.path.splitext(name)[0]


def includes(path):
    with open(path) as file:
        return re.findall(r'^#include "([^"]+)"', file.read(), re.MULTILINE)


def cycles(edges):
    """Sets of units that include each other, by repeated removal of those that include nothing left."""
    left = {unit: set(others) for unit, others in edges.items()}
    while True:
        free = [unit for unit, others in left.items() if not others & left.keys() - {unit}]
        if not free:
            break
        for unit in free:
            del left[unit]
    # what only leads to a cycle goes too
    while True:
        wanted = set().union(*left.values()) if left else set()
        idle = [unit for unit in left if unit not in wanted]
        if not idle:
            return sorted(left)
        for unit in idle:
            del left[unit]


class IncludeDirection(unittest.TestCase):
    def test_every_include_points_down(self):
        seen = 0
        for name, path in sources():
            room = room_of(name)
            self.assertIn(room, MAY_INCLUDE, f"{name} is in no known room")
            for include in includes(path):
                seen += 1
                other = room_of(include)
                self.assertTrue(other == room or other in MAY_INCLUDE[room],
                                f"{name} includes {include}")
        self.assertGreater(seen, 50)

    def test_rooms_have_an_order(self):
        self.assertEqual(cycles(MAY_INCLUDE), [])

    def test_rooms_with_their_folders_have_an_order(self):
        """A folder in a room is a part of it: no room stands between two folders of another."""
        whole = collections.defaultdict(set)
        for room, others in MAY_INCLUDE.items():
            whole[room.split("/")[0]] |= {other.split("/")[0] for other in others} - {room.split("/")[0]}
        self.assertEqual(cycles(whole), [])

    def test_no_arrow_runs_back_inside_a_room(self):
        edges = collections.defaultdict(set)
        for name, path in sources():
            edges[unit_of(name)] |= {unit_of(other) for other in includes(path)} - {unit_of(name)}
        for name, path in sources():
            for other in includes(path):
                self.assertTrue(os.path.exists(os.path.join(SOURCE, other)), f"{name}: {other}")
        self.assertGreater(len(edges), 50)
        self.assertEqual(cycles(edges), [], "these include each other")

    def test_a_cycle_is_found(self):
        self.assertEqual(cycles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": set()}), ["b", "c"])
        self.assertEqual(cycles({"a": {"b"}, "b": {"c"}, "c": set()}), [])

    def test_pure_rooms_know_no_mpi(self):
        for name, path in sources():
            for word in PURE.get(room_of(name), ()):
                with open(path) as file:
                    self.assertNotIn(f"#include <{word}", file.read(), name)

    def test_files_stay_small(self):
        for name, path in sources():
            with open(path) as file:
                lines = len(file.readlines())
            self.assertLessEqual(lines, 80 if name == "main.cpp" else 500, name)

    def test_no_room_is_the_house(self):
        lines = collections.Counter()
        for name, path in sources():
            with open(path) as file:
                lines[room_of(name)] += len(file.readlines())
        largest, count = lines.most_common(1)[0]
        self.assertLessEqual(count, LARGEST_SHARE * sum(lines.values()), largest)


if __name__ == "__main__":
    unittest.main()
