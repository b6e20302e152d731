"""Pages in HTML, for screen and paper, of the templates in the folder pages; numbers as engineers write them."""

import base64
from pathlib import Path

import jinja2
import numpy as np

from pounding.files import write_text

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
    return str(value)


_PAGES = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).with_name("pages")), autoescape=True, trim_blocks=True,
                            lstrip_blocks=True)
_PAGES.filters |= {"number": number, "base64": lambda image: base64.b64encode(image).decode()}
_PIECES = _PAGES.get_template("pieces.html").module
html_table, html_figures, answer_box, linked, paragraphs, folded, html_view = (
    getattr(_PIECES, name) for name in ("table", "figures", "answer", "linked", "paragraphs", "folded", "view"))


def figure_parts(folder: Path, pages: list) -> list:
    """Parts of a page that are one figure each."""
    return [(page["title"], html_figures(folder, [page])) for page in pages]


def write_page(path: Path, title: str, parts: list, **around: str) -> Path:
    """Writes a page of its own and returns the path. `parts`: pairs of title and content, of which those without content are
    left out; `around`: HTML `answer`, `before` and `after` them, and a line `under` the title."""
    write_text(path, _PAGES.get_template("page.html").render(title=title, parts=parts, **around))
    return path
