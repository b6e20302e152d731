"""Soil under one or several mats from their impedances: run/soil TABLE OUT

TABLE is a CSV file of complex impedances over the frequency, with the columns frequency, kxx_re, kxx_im and so on, of several
mats kx1x1_re, kx1x2_re; or impedances of MISS3D as text; or a YAML file of rectangular mats on a half-space, whose impedances
are found first (--impedances FILE keeps them). Fits springs, dashpots and masses, with hidden motions where the table asks for
them; they can only take energy, whatever the table is. OUT is the file for the option <structure>_soil_table. Prints the misfit
at each frequency, the worst term of each set of coupled motions over its diagonals; one above 10 % is doubted.
docs/reference/scene/soil.md has all files.
"""

from pathlib import Path

from pounding.soil import fit, half_space, impedances, miss, soil_file

from .process import parser_of

WIDE_MISS = 0.1  # misfit to doubt


def report(table: impedances.Impedances, blocks: list, left_out: float) -> list:
    names = [block.names for block in blocks]
    lines = ["".join(["frequency, Hz", *(f"{name + ', %':>16}" for name in names)])]
    lines += ["".join([f"{f:13.6g}", *(f"{100 * block.misfit[i]:16.3g}" for block in blocks)])
              for i, f in enumerate(table.frequency)]
    for block in blocks:
        lines.append(f"{block.names}: {block.cells} internal parts, misfit {100 * block.misfit.max():.2g} % at most, at "
                     f"{table.frequency[block.misfit.argmax()]:.3g} Hz, {100 * block.misfit.mean():.2g} % in the mean; least "
                     f"damping {block.damping:.3g} at {block.damping_at:.3g} Hz, of the table {block.table_damping:.3g}; at any "
                     f"frequency {block.margin:.2g} or more")
    if left_out > 0:
        lines.append(f"coupled by up to {100 * left_out:.2g} % of the diagonals, and taken as not coupled")
    lines += [f"warning: springs, dashpots and masses miss the table along {block.names} by up to "
              f"{100 * block.misfit.max():.3g} %, at {table.frequency[block.misfit.argmax()]:.4g} Hz; passive soil may not be able "
              "to move so" for block in blocks if block.misfit.max() > WIDE_MISS]
    return lines


def read(path: Path) -> impedances.Impedances:
    """By the kind of the file. Throws UserError or OSError."""
    if path.suffix in (".yaml", ".yml"):
        return half_space.read(path)
    return miss.read(path) if miss.is_miss(path) else impedances.read(path)


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("table", metavar="TABLE", type=Path, help="impedances, or mats on a half-space (.yaml)")
    parser.add_argument("out", metavar="OUT", type=Path, help="file of the soil")
    parser.add_argument("--impedances", metavar="FILE", type=Path, help="the table of impedances that is fitted, as CSV")
    options = parser.parse_args()
    for place in filter(None, (options.out, options.impedances)):
        if place.exists() and place.samefile(options.table):
            parser.error(f"{place} is the table itself")
    table = read(options.table)
    if options.impedances:
        impedances.write(options.impedances, table, f"impedances of {options.table.name}")
    soil, blocks, left_out = fit.fit(table)
    soil_file.write(options.out, soil, table, blocks, options.table.name)
    print("\n".join(report(table, blocks, left_out)))
    return 0
