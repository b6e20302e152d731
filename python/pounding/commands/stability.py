"""Do the mats of a run slide, tip or float? run/stability DIR MATS.yaml [--out DIR]

    asked: 1.1                     # factor that is asked
    gravity: 9.81                  # where the scene has none
    mats:
      block: {friction: 0.6, passive: 2e6, water: -3}

DIR is the result folder of a run that recorded the forces under these structures (forces of kind reactions), or whose mats
stand on a contact with friction. docs/manual/review.md has the keys and the formulas. Writes stability.csv (least factor over
time of sliding, overturning about each edge and flotation; slip and settlement) and stability_instants.csv (the five worst
instants of each with their numbers), and prints the first. Ends with status 3 where a factor is below what is asked.
"""

from pathlib import Path

from pounding import load, stability
from pounding.fragility.stability import KEYS, read_block
from pounding.fragility.study_file import Reader, load as load_file
from pounding.study import understood
from pounding.tables import cells_of, markdown, write_csv

from .process import parser_of

MISSED = 3  # exit status


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("folder", metavar="DIR", type=Path, help="result folder of a run")
    parser.add_argument("mats", metavar="MATS", type=Path, help="file of the mats")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of the tables (default: that of the run)")
    options = parser.parse_args()
    given = read_block(Reader(load_file(options.mats), options.mats, "", KEYS), None)
    run, out = load(options.folder), options.out or options.folder
    with understood(options.folder):
        found = stability.of_run(run, given.mats, given.gravity, str(options.mats))
    rows, instants = stability.tables_of(found, list(given.mats), given.asked)
    out.mkdir(parents=True, exist_ok=True)
    for name, table in (("stability", rows), ("stability_instants", instants)):
        write_csv(out / f"{name}.csv", table)
    print("".join(f"{line}\n" for mat, *_ in found if mat for line in mat.doubts), end="")
    print(markdown("Least factors over time of the mats, their slip and settlement", *cells_of(rows)))
    print(f"see {out / 'stability.csv'}, {out / 'stability_instants.csv'}")
    return MISSED if any(row.get("holds") == "no" for row in rows) else 0
