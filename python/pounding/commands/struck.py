"""Does the place that is struck hold? run/struck DIR STRENGTHS.yaml [--out DIR]

    strength: 30e6                 # f'c [Pa]
    support: 4                     # area A2 behind the one that is pressed [m2]
    edge_strength: 0.8e6           # of the slab's edge [N/m]
    contacts:
      roof: {strength: 40e6}       # of its own

DIR is the result folder of a run with `struck_areas` or `struck_edges`. docs/manual/review.md has the keys and the formulas. Writes
struck.csv (the largest mean pressure over each area of the faces, and force per length of their edges, where and when, beside the
strength) and prints it. Ends with status 3 where one is above its strength.
"""

from pathlib import Path

from pounding import UserError, load, struck
from pounding.fragility.study_file import Reader, load as load_file
from pounding.study import understood
from pounding.tables import cells_of, markdown, write_csv

from .process import parser_of

ABOVE = 3  # exit status


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("folder", metavar="DIR", type=Path, help="result folder of a run")
    parser.add_argument("strengths", metavar="STRENGTHS", type=Path, help="file of the strengths")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of the table (default: that of the run)")
    options = parser.parse_args()
    given = struck.read_strengths(Reader(load_file(options.strengths), options.strengths, "", ("contacts", *struck.STRENGTHS)))
    run, out = load(options.folder), options.out or options.folder
    with understood(options.folder):
        windows, found = struck.of_run(run)
        contacts = list(run.summary.get("contacts", {}))
    if not windows:
        raise UserError(f"{options.folder}: the run did not look over areas of its faces; run it with struck_areas or struck_edges")
    unknown = next((name for name in given.own if name not in contacts), None)
    if unknown is not None:
        raise UserError(f"{options.strengths}: contacts: {unknown} is no contact of the run; it has {', '.join(contacts)}")
    rows = struck.rows_of(contacts, windows, found, given)
    out.mkdir(parents=True, exist_ok=True)
    write_csv(out / "struck.csv", rows)
    print(markdown("Places that are struck, beside their strengths", *cells_of(rows)) if rows else "nothing is struck")
    print(f"see {out / 'struck.csv'}")
    return ABOVE if any(row["holds"] == "no" for row in rows) else 0
