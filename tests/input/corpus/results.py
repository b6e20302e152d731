"""Places of results that cannot be written."""
from corpus.case import Case

CASES = [
    Case("a file in the place of the results", ["-output", "{folder}/record.csv"],
         ["-output {folder}/record.csv", "cannot be"]),
    Case("results below a file", ["-output", "{folder}/record.csv/run"], ["-output {folder}/record.csv/run", "cannot be"]),
    Case("results below the kernel's files", ["-output", "/proc/none/run"], ["-output /proc/none/run", "cannot be"]),
    Case("matrices below a file", ["-dry_run", "-export_matrices", "{folder}/record.csv"],
         ["-export_matrices {folder}/record.csv", "cannot be"]),
]
