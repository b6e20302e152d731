"""The file of soil that the option <structure>_soil_table takes; docs/reference/scene/soil.md has its form."""

from pathlib import Path

from pounding.soil.fit import Soil
from pounding.soil.impedances import Impedances
from pounding.files import write_text

VERSION = 1


def rows(matrix) -> list:
    return [",".join(f"{value:.17g}" for value in row) for row in matrix]


def write(path: Path, soil: Soil, table: Impedances, blocks: list, source: str) -> None:
    """Throws OSError."""
    lines = [f"pounding soil,{VERSION}",
             f"# springs, dashpots and masses fitted by run/soil to {' '.join(source.split())}, "
             f"{table.frequency[0]:g} to {table.frequency[-1]:g} Hz",
             f"mats,{soil.mats}", "# motions, misfit of the worst term over its diagonals: the most, its frequency [Hz], the mean"]
    lines += [f"misfit,{block.names},{block.misfit.max():.6g},{table.frequency[block.misfit.argmax()]:.6g},"
              f"{block.misfit.mean():.6g}" for block in blocks]
    for name, matrix, unit in (("stiffness", soil.stiffness, "N/m, N, N m"), ("dashpots", soil.dashpots, "N s/m, N s, N m s"),
                               ("masses", soil.masses, "kg, kg m, kg m2")):
        lines += [f"# along x, y, z and about them: {unit}", name, *rows(matrix)]
    lines += ["# motion along x, y, z and about them; dashpot, spring and mass in series against it, 0: none", "hidden",
              *rows([[*part.motion, part.dashpot, part.spring, part.mass] for part in soil.hidden])]
    write_text(path, "\n".join(lines) + "\n")

