"""Reads VTKHDF files as their specification says (version 2.0, unstructured grids over time), and with VTK's reader."""
import importlib

import h5py
import numpy as np

NODES = {1: 1, 3: 2, 5: 3, 9: 4, 10: 4, 12: 8, 13: 6}  # of VTK's types of cells


class Part:
    """A part of a step: points, cells (lists of nodes), types, point and cell data."""

    def __init__(self, points, cells, types, point_data, cell_data):
        self.points, self.cells, self.types = points, cells, types
        self.point_data, self.cell_data = point_data, cell_data


def values(group, step, names, first, offsets, count):
    """Rows of the arrays of a group at a step: `first` where the array has no offset of its own."""
    found = {}
    for name in names:
        start = first if offsets is None or name not in offsets else int(offsets[name][step]) + count[0]
        rows = group[name][start:start + count[1]]
        if len(rows) != count[1]:
            raise ValueError(f"{name}: {len(rows)} rows at step {step}, not {count[1]}")
        found[name] = rows
    return found


def read(path):
    """Steps of a file: pairs of the time and the parts."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        if list(root.attrs["Version"]) != [2, 0] or root.attrs["Type"] != b"UnstructuredGrid":
            raise ValueError(f"{path}: {root.attrs['Type']} of version {root.attrs['Version']}")
        steps = root["Steps"]
        return [(float(steps["Values"][step]), parts_of(root, steps, step)) for step in range(steps.attrs["NSteps"])]


def parts_of(root, steps, step):
    first_part = int(steps["PartOffsets"][step])
    numbers = [root[name] for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds")]
    place = [int(steps[name][step]) for name in ("PointOffsets", "CellOffsets", "ConnectivityIdOffsets")]
    start = list(place)
    found = []
    for part in range(int(steps["NumberOfParts"][step])):
        points, cells, ids = (int(number[first_part + part]) for number in numbers)
        of_offsets = start[1] + first_part + part
        offsets = root["Offsets"][of_offsets:of_offsets + cells + 1]
        connectivity = root["Connectivity"][start[2]:start[2] + ids]
        types = root["Types"][start[1]:start[1] + cells]
        if offsets[0] != 0 or offsets[-1] != ids or list(np.diff(offsets)) != [NODES[kind] for kind in types]:
            raise ValueError(f"part {part}: cells and their offsets differ")
        data = [values(root[name], step, root[name], start[kind], steps.get(name + "Offsets"),
                       (start[kind] - place[kind], count))
                for kind, (name, count) in enumerate((("PointData", points), ("CellData", cells)))]
        found.append(Part(root["Points"][start[0]:start[0] + points],
                          [list(cell) for cell in np.split(connectivity, offsets[1:-1])], list(types), *data))
        start = [start[0] + points, start[1] + cells, start[2] + ids]
    return found


def vtk_reader():
    """VTK's reader of VTKHDF files where it knows time (VTK 9.3 and later), else None."""
    try:
        version = importlib.import_module("vtkmodules.vtkCommonCore").vtkVersion
        if (version.GetVTKMajorVersion(), version.GetVTKMinorVersion()) < (9, 3):
            return None
        return importlib.import_module("vtkmodules.vtkIOHDF").vtkHDFReader()
    except ImportError:
        return None
