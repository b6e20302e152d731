"""Reads the XDMF files of a run, without VTK and with it, for the tests."""
import importlib
import os
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

# Codes of XDMF's mixed topology: their nodes, where the topology does not say it, and VTK's type.
FIXED = {4: 3, 5: 4, 6: 4, 8: 6, 9: 8}
VTK_TYPES = {(1, 1): 2, (2, 2): 4, (4, 3): 5, (5, 4): 9, (6, 4): 10, (8, 6): 13, (9, 8): 12}  # 2, 4: poly-


class Grid:
    """A mesh with its arrays: points, cells (lists of nodes), types (VTK's), point and cell data."""

    def __init__(self, element, folder):
        self.name = element.get("Name")
        self.notes = {note.get("Name"): note.get("Value") for note in element.findall("Information")}
        self.points = data(element.find("Geometry/DataItem"), folder)
        topology = element.find("Topology")
        self.cells, self.types = cells(data(topology.find("DataItem"), folder))
        if len(self.cells) != int(topology.get("NumberOfElements")):
            raise ValueError(f"{self.name}: {len(self.cells)} cells, not {topology.get('NumberOfElements')}")
        self.point_data, self.cell_data = {}, {}
        for attribute in element.findall("Attribute"):
            values = data(attribute.find("DataItem"), folder)
            centre = attribute.get("Center")
            rows = len(self.points) if centre == "Node" else len(self.cells)
            if len(values) != rows:
                raise ValueError(f"{attribute.get('Name')}: {len(values)} values for {rows}")
            (self.point_data if centre == "Node" else self.cell_data)[attribute.get("Name")] = values


def numbers(text):
    return [int(word) for word in text.split()]


def data(item, folder):
    """The array of a DataItem, of the shape that it promises."""
    promised = tuple(numbers(item.get("Dimensions")))
    file, path = item.text.split(":")
    with h5py.File(os.path.join(folder, file), "r") as handle:
        values = handle[path][()]
    kind = {"Int": np.dtype("<i4"), "Float": np.dtype("<f8")}[item.get("NumberType")]
    if values.shape != promised or values.dtype != kind:
        raise ValueError(f"{path}: {values.dtype} of shape {values.shape}, promised {kind} of {promised}")
    return values


def cells(topology):
    found, types, place = [], [], 0
    while place < len(topology):
        code = topology[place]
        place += 1
        count = FIXED.get(code)
        if count is None:
            count = topology[place]
            place += 1
        found.append(list(topology[place:place + count]))
        types.append(VTK_TYPES[code, count])
        place += count
    return found, types


def read(path):
    """Frames of a file: pairs of the time (None if it tells none) and the grids by name."""
    root = ElementTree.parse(path).getroot()
    folder = os.path.dirname(path)
    outer = root.find("Domain/Grid")
    steps = [outer] if outer.get("CollectionType") == "Spatial" else outer.findall("Grid")
    frames = []
    for step in steps:
        time = step.find("Time")
        grids = [Grid(element, folder) for element in step.findall("Grid")]
        frames.append((None if time is None else float(time.get("Value")), {grid.name: grid for grid in grids}))
    return frames


def vtk_readers():
    """VTK's readers of XDMF files, the two that ParaView offers; none where no package brings them."""
    found = []
    for module, name in (("vtkmodules.vtkIOXdmf2", "vtkXdmfReader"), ("vtkmodules.vtkIOXdmf3", "vtkXdmf3Reader")):
        try:
            found.append(getattr(importlib.import_module(module), name))
        except ImportError:
            continue
    return found


def vtk_blocks(reader, path, time=None):
    """Grids by name as a reader of VTK gives them, at a time if one is asked for, and all times of the file."""
    pipeline = importlib.import_module("vtkmodules.vtkCommonExecutionModel").vtkStreamingDemandDrivenPipeline
    composite = importlib.import_module("vtkmodules.vtkCommonDataModel").vtkCompositeDataSet
    reader.SetFileName(path)
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    times = list(information.Get(pipeline.TIME_STEPS())) if information.Has(pipeline.TIME_STEPS()) else []
    if time is None:
        reader.Update()
    else:
        reader.UpdateTimeStep(time)
    blocks = {}
    iterator = reader.GetOutputDataObject(0).NewIterator()
    while not iterator.IsDoneWithTraversal():
        name = iterator.GetCurrentMetaData().Get(composite.NAME())  # in frame 7: "left[7]"
        blocks[name.partition("[")[0]] = iterator.GetCurrentDataObject()
        iterator.GoToNextItem()
    return blocks, times


def vtk_grid(block):
    """Points, cells, VTK's types, point and cell data of a block, as those of Grid."""
    view_of = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy

    def numpy_of(array):
        return np.array(view_of(array))

    cells = [[block.GetCell(i).GetPointId(k) for k in range(block.GetCell(i).GetNumberOfPoints())]
             for i in range(block.GetNumberOfCells())]
    arrays = [{part.GetArrayName(i): numpy_of(part.GetArray(i)) for i in range(part.GetNumberOfArrays())}
              for part in (block.GetPointData(), block.GetCellData())]
    points = block.GetPoints()  # held while its values are copied
    return (numpy_of(points.GetData()), cells, [block.GetCellType(i) for i in range(len(cells))], *arrays)
