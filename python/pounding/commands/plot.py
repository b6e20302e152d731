"""The report of a run, report.html in its result folder, with its figures: run/plot DIR [--without DIR] [--pdf]

The report opens with the answer and sets the run beside the one without pounding: the folder of --without, else the
folder DIR-without or, of run/plant, apart, if it is there. Where there is none the report has the command that makes
it. --pdf prints report.pdf with Chromium.
"""

import subprocess
import sys
from pathlib import Path

from pounding import results
from pounding.plot import report, twin
from pounding.study import understood

from .process import parser_of


def told(name: str) -> None:
    """Shows what is being drawn, in one line that is written over, where somebody looks."""
    if sys.stderr.isatty():
        print(f"\r\033[K{name.replace('_', ' ')}", end="", file=sys.stderr, flush=True)


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("folder", metavar="DIR", type=Path, help="result folder of a run")
    parser.add_argument("--without", metavar="DIR", type=Path, help="result folder of the same model without pounding")
    parser.add_argument("--pdf", action="store_true", help="print report.pdf as well, with chromium")
    options = parser.parse_args()
    browser = report.require_browser("--pdf") if options.pdf else None
    run = results.load(options.folder)
    with understood(options.folder):
        run.without, why = twin.find(run, options.without)
        count, skipped, page = report.write(run, why, told)
    told("")
    if report.stopped(run):
        print(report.stopped(run))
    for line in skipped:
        print(line)
    if why:
        print(f"without pounding: {why}")
    print(f"{count} figures and {page}")
    if options.pdf:
        print(report.print_pdf(page, browser, subprocess.run))
    return 0
