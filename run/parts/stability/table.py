"""The table of run/stability: CSV for machines, Markdown for people."""

import csv
import io

HEAD = ("sweep", "case", "expected", "seen", "outcome", "measure", "limit", "verdict")


def number(value: float) -> str:
    return "" if value != value else f"{value:.3g}"


def cells(row) -> list:
    return [row.sweep, row.case, row.expected, row.seen, row.outcome, number(row.measure), number(row.limit),
            row.verdict]


def as_csv(rows) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEAD)
    writer.writerows(cells(row) for row in rows)
    return text.getvalue()


def as_markdown(rows) -> str:
    lines = [list(HEAD), ["---"] * len(HEAD)] + [cells(row) for row in rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "/") for cell in line) + " |" for line in lines) + "\n"


def as_text(rows) -> str:
    """A line per case, for the terminal."""
    width = max(len(row.case) for row in rows)
    return "\n".join(f"{row.verdict:15}  {row.sweep:15}  {row.case:{width}}  {row.seen}" for row in rows)
