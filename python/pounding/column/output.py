"""Files of run/column: the table of each estimate, transfer functions, motions, and the block `soils` of a study."""

from pathlib import Path

import yaml

from pounding.files import file_name, write_text
from pounding.tables import write_rows

from .answer import FREQUENCIES, Estimate
from .column_file import Ground

HEAD = ("layer", "top", "thickness", "density", "vs_small_strain", "vs", "modulus", "modulus_ratio", "damping", "effective_strain",
        "strain", "strain_largest", "acceleration", "acceleration_largest")


def write_table(folder: Path, one: Estimate, ratio: float) -> None:
    """Rows of sublayers and half-space: moduli [Pa] and damping as all motions leave them in the geometric mean, strains in the
    middle of layers [-] and accelerations at their tops [m/s2] in the mean of the motions' largest, and the largest of all."""
    strains, accelerations, column, small = one.strains(), one.accelerations(), one.column, one.soil.column
    rows = []
    for m, name in enumerate(one.soil.names):
        rock = m == len(column.thickness)
        strain = ["", "", ""] if rock else [f"{value:.6g}" for value in
                                            (ratio * strains[:, m].mean(), strains[:, m].mean(), strains[:, m].max())]
        rows.append([name, *(f"{value:.6g}" for value in (column.tops[m], *([] if rock else [column.thickness[m]]))), *[""] * rock,
                     *(f"{value:.8g}" for value in (column.density[m], small.speed[m], column.speed[m], column.modulus[m],
                                                    column.modulus[m] / small.modulus[m], column.damping[m])),
                     *strain, *(f"{value:.6g}" for value in (accelerations[:, m].mean(), accelerations[:, m].max()))])
    write_rows(folder / f"{one.name}.csv", HEAD, rows, f"{one.name} estimate, {len(one.found)} motions; SI units")


def write_transfer(folder: Path, ground: Ground, estimates: list) -> None:
    head, columns = ["frequency"], [FREQUENCIES]
    for one in estimates:
        head += [f"{one.name}_surface", f"{one.name}_mats"]
        columns += [one.transfer(0, False), one.transfer(ground.at_mats.entry, ground.at_mats.outcrop)]
    write_rows(folder / "transfer.csv", head, ([f"{value:.8g}" for value in row] for row in zip(*columns)),
               "acceleration over that of an outcrop of the half-space, with moduli and damping of the tables")


def write_motions(folder: Path, one: Estimate, signals: dict) -> dict:
    """Accelerograms [m/s2] at the mats, and at the surface where mats lie deeper; (axis, number) -> file of that at the mats."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for (axis, number), found in one.found.items():
        signal = signals[axis, number]
        files[axis, number] = (folder / f"{one.name}-{axis}{number + 1}-{file_name(signal.name)}.csv").absolute()
        rows = ([f"{k * signal.step:.9g}", *(f"{value:.9g}" for value in row)] for k, row in enumerate(zip(found.mat, found.surface)))
        write_rows(files[axis, number], ["time", "mats", "surface"], rows, "accelerations, m/s2", exact=True)
    return files


def half_space(one: Estimate, depth: float, over: float) -> tuple:
    """Speed of shear waves [m/s] by their time and mean density [kg/m3] from a depth on over so many metres."""
    column, way, time, mass = one.column, 0.0, 0.0, 0.0
    bottoms = [*column.tops[1:], float("inf")]
    for m, (top, bottom) in enumerate(zip(column.tops, bottoms)):
        part = max(0.0, min(bottom, depth + over) - max(top, depth))
        way, time, mass = way + part, time + part / column.speed[m], mass + part * column.density[m]
    return way / time, mass / way


def soil_options(ground: Ground, one: Estimate) -> dict:
    """Options of the soil under the mats of a scene."""
    mats, tables = ground.mats, dict(ground.mats.tables)
    speed, density = half_space(one, mats.depth, mats.over)
    options = {f"{name}_soil": {"vs": float(f"{speed:.6g}"), "density": float(f"{density:.6g}"), "poisson": mats.poisson}
               for name in mats.structures}
    return options | {f"{name}_soil_table": str((ground.path.parent / text.replace("{}", one.name)).absolute())
                      for name, text in tables.items()}


def write_soils(path: Path, ground: Ground, estimates: list, files: dict) -> None:
    """The block of a study whose levels are the one of the file: per estimate options of the soil and the motions at the mats,
    with the peaks that they have over that of the level; the vertical motion is the file's. `files`: name -> (axis, number) -> file."""
    blocks = {}
    for one in estimates:
        axes = {}
        for axis, own in ground.axes.items():
            if axis == "z":
                told = {"records": list(own.records)} if own.records else {"target": own.target, "seeds": list(own.seeds)}
                axes[axis] = {**told, "ratio": list(own.ratios) or own.ratio, **({"options": dict(own.options)} if own.options else {})}
                continue
            peaks = [float(f"{abs(one.found[axis, k].mat).max() / ground.level:.9g}") for k in range(len(own.motions))]
            axes[axis] = {"records": [str(files[one.name][axis, k]) for k in range(len(own.motions))], "ratio": peaks,
                          "options": {"unit": "m/s2", "column": 2}}
        blocks[one.name] = {"options": soil_options(ground, one), "motions": axes}
    write_text(path, f"# Soils of a study with `levels: [{ground.level:g}]`, made by run/column of {ground.path.name}\n" +
               yaml.safe_dump({"soils": blocks}, sort_keys=False, width=120))
