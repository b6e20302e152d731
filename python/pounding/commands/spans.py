"""What goes from one building to another, as input of a pipe code: run/spans DIR [--out DIR] [--interval S]

DIR is the result folder of a run whose scene has `spans` (docs/manual/results.md). Writes spans.csv (largest relative
displacements and rotations, and when), and of each span span_NAME.csv, the history of both ends and of their difference in
named columns, and span_NAME_spectra.csv, the floor spectra at both ends and the larger of the two. Prints the first.
"""

from pathlib import Path

from pounding import UserError, load, spans
from pounding.arguments import positive
from pounding.study import understood
from pounding.tables import cells_of, markdown

from .process import parser_of


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("folder", metavar="DIR", type=Path, help="result folder of a run")
    parser.add_argument("--out", metavar="DIR", type=Path, help="folder of the tables (default: that of the run)")
    parser.add_argument("--interval", metavar="S", type=positive(float), default=spans.INTERVAL,
                        help=f"between the lines of the histories, at least that of the run (default: {spans.INTERVAL:g} s)")
    options = parser.parse_args()
    run, out = load(options.folder), options.out or options.folder
    if not run.spans:
        raise UserError(f"{options.folder}: the run has no spans; give its scene `spans` (docs/manual/results.md)")
    with understood(options.folder):
        rows = spans.write(run, out, options.interval)
    print(markdown("Largest motion of the second end against the first, since the start", *cells_of(rows)))
    for name, span in run.spans.items():
        how = [f"{end} ({', '.join(f'{x:g}' for x in place)}) on {structure}"
               for end, place, structure in zip(span.ends, span.places, span.structures)]
        print(f"{name}: from {how[0]}; to {how[1]}")
    print(f"see {out / 'spans.csv'}" + "".join(f", span_{name}.csv" for name in run.spans))
    return 0
