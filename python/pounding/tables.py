"""One list of rows as Markdown and CSV."""

import csv
import math
import re
from pathlib import Path

from pounding.files import write_text, written_beside


def number(value, digits: int = 3) -> str:
    """Plain digits, so many of them significant; a dash for what was not measured."""
    if value is None or value == "":
        return "—"
    if isinstance(value, str):
        return value
    if isinstance(value, int) or float(value).is_integer() and abs(value) >= 1000:
        return str(int(value))
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{decimals}f}"


def markdown(title: str, head: list, rows: list) -> str:
    lines = ["| " + " | ".join(str(cell) if isinstance(cell, str) else number(cell) for cell in row)
             + " |" for row in [head, ["---"] * len(head)] + rows]
    return "\n".join([f"**{title}**", ""] + lines) + "\n"


def by_ranks(title: str, key: str, rows: list, columns: dict) -> str:
    """A line for each value of `key`, with what was found on one number of ranks after the other in its cells, once where
    all are alike; `columns`: head -> key of the rows."""
    lines = []
    for value in dict.fromkeys(row[key] for row in rows):
        found = [[number(row.get(column)) for row in rows if row[key] == value] for column in columns.values()]
        lines.append([cells[0] if len(set(cells)) == 1 else " / ".join(cells) for cells in found])
    ranks = sorted({row["ranks"] for row in rows})
    return markdown(f"{title}, {' / '.join(map(str, ranks))} rank{'s' if ranks != [1] else ''}", list(columns), lines)


def leave(folder: Path, name: str, text: str, rows: list) -> str:
    """Writes a table, NAME.md, and its rows, NAME.csv; returns the table."""
    write_text(folder / f"{name}.md", text)
    write_csv(folder / f"{name}.csv", rows)
    return text


def cells_of(rows: list) -> tuple:
    """Header and cells of rows that are dictionaries of scalars: a column per key."""
    head = list(dict.fromkeys(key for row in rows for key in row))
    return head, [[row.get(key, "") for key in head] for row in rows]


def read_csv(path: Path) -> list:
    """Rows of a CSV file as dictionaries of texts; empty lines and comments ('#') are passed over. Throws OSError, UnicodeDecodeError
    or csv.Error."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))


def write_csv(path: Path, rows: list) -> None:
    write_rows(path, *cells_of(rows))


# Texts that a spreadsheet runs as formulas; numbers and lists of them are none.
FORMULA = re.compile(r"[=@\t\r]|[+-](?![\d.,;eE +-]*$)")


def cell_of(value):
    """A cell that a spreadsheet takes for what it is: a text that begins as a formula does follows an apostrophe."""
    return f"'{value}" if not isinstance(value, (int, float)) and FORMULA.match(str(value)) else value


def write_rows(path: Path, head, rows, comment: str = "", exact: bool = False) -> None:
    """A CSV file of sequences, below a line that is a comment where one is given. `exact`: the program reads it, and
    texts stay as they are."""
    with written_beside(path) as draft, open(draft, "w", newline="", encoding="utf-8") as file:
        file.write(f"# {comment}\n" if comment else "")
        csv.writer(file, lineterminator="\n").writerows(
            row if exact else map(cell_of, row) for row in (head, *rows))
