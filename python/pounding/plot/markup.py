"""Pieces of pages in HTML: numbers, tables, figures, and the page around them, for screen and paper."""

import base64
import itertools
import re
from html import escape
from pathlib import Path

import numpy as np

from pounding.files import write_text

HEADING = r"<h2([^>]*)>(.*?)</h2>"
FEW = 4  # parts of a page that need no list
SHORT = 25  # rows of a table that stays on one page of paper
WIDE = 8    # columns of a table that needs small letters on paper

CSS = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; line-height: 1.25; } h2 { font-size: 1.25em; margin-top: 2em; } h3 { font-size: 1.05em; margin-top: 1.6em; }
table { border-collapse: collapse; margin: 0.8em 0; font-size: 0.9em; }
caption { text-align: left; font-weight: bold; padding: 0.3em 0; }
.rows { overflow-x: auto; } .wide th, .wide td { padding: 0.25em 0.4em; } .wide td:first-child { white-space: nowrap; }
th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #ddd; vertical-align: top; }
th { border-bottom: 2px solid #888; } th:first-child, td:first-child { text-align: left; }
td.text, th.text { text-align: left; overflow-wrap: anywhere; min-width: 6em; } td.hash { font: 0.8em monospace; text-align: left; overflow-wrap: anywhere; }
figure { margin: 1.5em 0; } img { max-width: 100%; height: auto; }
.panels { display: flex; flex-wrap: wrap; align-items: flex-start; justify-content: center; }
.legend { flex: 0 0 100%; text-align: center; }
figcaption, .note, .from { color: #555; font-size: 0.9em; }
.answer { border-left: 5px solid #08519C; padding: 0.1em 1.2em; background: #f4f7fb; }
.answer.touched { border-color: #C0392B; background: #fdf5f4; }
.answer p:first-child { font-size: 1.2em; font-weight: bold; }
nav ul { columns: 3 14em; padding-left: 1.2em; font-size: 0.9em; } nav a { color: #08519C; text-decoration: none; }
h1, code { overflow-wrap: anywhere; } summary { cursor: pointer; margin: 0.4em 0; } .small table { font-size: 0.75em; }
@page { size: A4; margin: 16mm 14mm 18mm 14mm;
  @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #555; } }
@media (max-width: 40em) { body { margin: 1em auto; } h1 { font-size: 1.25em; } th, td { padding: 0.25em 0.4em; }
  .panels img { width: 100% !important; } }
@media print {
  body { font-size: 10pt; line-height: 1.4; margin: 0; max-width: none; padding: 0; }
  h1 { font-size: 16pt; } h2 { font-size: 13pt; } h2, h3, caption { break-after: avoid; }
  figure, tr, .answer, .together { break-inside: avoid; } thead { display: table-header-group; }
  table.short { break-inside: avoid; } h2 { margin-top: 1.4em; } #view .bar { display: none !important; }
  th, td { padding: 0.15em 0.6em; } table { max-width: 100%; } .rows { overflow: visible; } .screen { display: none; }
  table.wide { font-size: 0.68em; } .wide th, .wide td { padding: 0.1em 0.3em; overflow-wrap: anywhere; }
  figure { margin: 0.8em 0; } img { max-height: 235mm; object-fit: contain; }
}
"""


POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def readable(value: float, digits: int = 4) -> str:
    """A number as engineers write it, of so many significant digits: 11 000 and 2.3 × 10⁻⁵, with thin blanks between
    thousands."""
    text = f"{value:.{digits}g}"
    if "e" not in text:
        whole, dot, rest = text.partition(".")
        return f"{int(whole):,}".replace(",", "\u202f") + dot + rest if abs(value) >= 10000 else text
    if 1 <= abs(value) < 1e7:
        return f"{int(float(text)):,}".replace(",", "\u202f")
    mantissa, power = text.split("e")
    return f"{mantissa} × 10{str(int(power)).translate(POWERS)}"


def number(value) -> str:
    """A cell as text: whole numbers with thin blanks between thousands, others with four digits."""
    if isinstance(value, bool) or value is None:
        return "–" if value is None else "yes" if value else "no"
    if isinstance(value, (int, np.integer)):
        return f"{value:,}".replace(",", "\u202f")
    if isinstance(value, (float, np.floating)):
        return readable(value) if np.isfinite(value) else "not finite"
    return escape(str(value))


def html_table(caption: str, header: list, rows: list, text: tuple = (), hashes: tuple = ()) -> str:
    """A table, or nothing of no rows; columns `text` (numbers from 0) and `hashes` are set to the left."""
    if not rows:
        return ""

    def kind(column: int) -> str:
        return ' class="hash"' if column in hashes else ' class="text"' if column in text else ""

    head = "".join(f"<th{kind(i).replace('hash', 'text')}>{escape(name)}</th>" for i, name in enumerate(header))
    body = "".join("<tr>" + "".join(f"<td{kind(i)}>{number(cell)}</td>" for i, cell in enumerate(row)) + "</tr>\n"
                   for row in rows)
    kinds = " ".join(name for name, holds in (("short", len(rows) <= SHORT), ("wide", len(header) > WIDE)) if holds)
    kinds = f' class="{kinds}"' if kinds else ""
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    return (f'<div class="rows"><table{kinds}>{title}\n<thead><tr>{head}</tr></thead>\n'
            f"<tbody>{body}</tbody></table></div>\n")


def html_figure(folder: Path, page: dict, level: int = 2) -> str:
    """A figure with its picture in it, under a title of that level; its panels, where it has some, below each other on
    a narrow page."""
    title = escape(page["title"])
    legends, panels = page.get("panels") or (0, [(1.0, (folder / page["file"]).read_bytes())])
    images = ""
    for number, (part, image) in enumerate(panels):
        width = f' style="width: {99.9 * part:.3f}%"' if part < 1 else ""
        one = f'<img alt="{title}"{width} src="data:image/png;base64,{base64.b64encode(image).decode()}">'
        images += f'<div class="legend">{one}</div>' if number < legends else one
    return (f'<div class="together"><h{level}>{title}</h{level}>\n<figure><div class="panels">{images}</div>'
            f'<figcaption>{escape(page["caption"])}</figcaption></figure></div>\n')


def paragraphs(lines: list) -> str:
    return "".join(f"<p>{escape(line)}</p>\n" for line in lines)


def answer_box(lines: list, touched: bool, more: str = "") -> str:
    """The answer with which a page opens, its first line in large letters; `more`: HTML below them."""
    return f'<div class="answer{" touched" if touched else ""}">\n{paragraphs(lines)}{more}</div>\n'


def folded(title: str, content: str, printed: bool = True) -> str:
    """Content that a click opens; on paper its title alone, or nothing."""
    kind = "" if printed else ' class="screen"'
    return f"<details{kind}><summary>{escape(title)}</summary>\n{content}</details>\n" if content else ""


def with_contents(content: str) -> str:
    """The content with a list of its parts, if there are more than a few: after the answer where it begins with one."""
    titles = re.findall(HEADING, content)
    if len(titles) < FEW:
        return content
    count = itertools.count(1)
    content = re.sub(HEADING, lambda found: f'<h2{found[1]} id="part-{next(count)}">{found[2]}</h2>', content)
    links = "".join(f'<li><a href="#part-{place}">{title}</a></li>\n' for place, (_, title) in enumerate(titles, 1))
    answer = re.match(r'<div class="answer.*?</div>\n', content, re.DOTALL)
    begin = answer.end() if answer else 0
    return f'{content[:begin]}<nav><ul>\n{links}</ul></nav>\n{content[begin:]}'


def write_page(path: Path, title: str, content: str, under: str = "") -> Path:
    """Writes a page of its own, its content in HTML, a line under its title, and returns the path."""
    title = escape(title)
    under = f'<p class="from">{escape(under)}</p>\n' if under else ""
    write_text(path, f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
                    f'<meta name="viewport" content="width=device-width, initial-scale=1"><title>{title}</title>'
                    f"<style>{CSS}</style></head>\n<body>\n<h1>{title}</h1>\n{under}{with_contents(content)}</body></html>\n")
    return path
