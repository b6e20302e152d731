"""Result folders beside each other: run/compare A B [C ...] [--out DIR]

The first folder is what the others are compared with. Writes spectra.csv (floor spectra of the probes that all
runs have, and their ratios), impacts.csv, peaks.csv, options.csv (what differs between the scenes), a figure per
probe and comparison.html, and prints the tables.
"""

from pathlib import Path

from pounding import UserError
from pounding.compare import page, runs
from pounding.study import understood

from .process import parser_of



def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("folders", metavar="DIR", type=Path, nargs="+", help="result folders of two runs or more")
    parser.add_argument("--out", metavar="DIR", type=Path, default=Path("comparison"),
                        help="folder of tables, figures and page (default: comparison)")
    options = parser.parse_args()
    if len(options.folders) < 2:
        parser.error("give two result folders or more")
    if options.out.resolve() in [folder.resolve() for folder in options.folders]:
        raise UserError(f"--out {options.out} is one of the runs; give another folder")
    if (options.out / "summary.json").exists():
        raise UserError(f"--out {options.out} holds the results of a run; give another folder")
    with understood(" beside ".join(map(str, options.folders))):
        found = runs.read(options.folders)
    with understood(" beside ".join(map(str, options.folders))):
        written, text = page.write(found, options.out), page.text(found)
    print(text)
    print(f"see {written}")
    return 0
