"""Lines of a Nastran deck: includes, small, large and free fields, continuations by their marks, replication; and its cards."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from .cards import lines_of, number, shown
from .model import InputFault
from .nastran_cards import Card

LONGEST = 4096  # letters of a name of a file
MOST = 10**6  # cards that a replication makes
FREE = re.compile(r"[^,]{0,9},|\s*=[^,]*,")  # a comma within the first ten columns, or beyond a replication


@dataclass(slots=True)
class Line:
    """`mark`: of a continuation, None of a card; `tail`: the tenth field; both without their first letter. `after`: the
    line that goes on from here."""

    head: str
    fields: list
    tail: str | None
    place: str
    mark: str | None = None
    after: object = None
    taken: bool = field(default=False)
    doubtful: str = ""  # a ninth field of data that could be a mark


def included(path: Path, seen=(), top: Path | None = None):
    """Lines of a deck and of the files that it includes, without comments. Names are those beside the file, or else beside
    the deck."""
    top = top or path.parent
    name = ""  # of an include over several lines
    for place, line in lines_of(path, seen):
        line = line.split("$")[0].rstrip()
        if name:
            name += line.strip()
        elif re.match(r"\s*INCLUDE\b", line, re.IGNORECASE):
            name = line.strip()[7:].strip()
        elif line.strip():
            yield place, line
        if len(name) > LONGEST:
            raise InputFault(f"{place}: an INCLUDE with a name of more than {LONGEST} letters")
        if name and (name[0] not in "'\"" or name.count(name[0]) > 1):
            file = name.strip("'\"").strip()
            yield from included(next((one / file for one in (path.parent, top) if (one / file).exists()), path.parent / file),
                                (*seen, path.resolve()), top)
            name = ""
    if name:
        raise InputFault(f"{path}: an INCLUDE whose name does not end")


def is_large(head: str) -> bool:
    return head[:1] == "*" or head[:1] != "+" and head[-1:] == "*"


def words_of(line: str, place: str) -> list:
    """Words between commas, or between blanks. Throws InputFault where blanks may be within a number."""
    found: list = []
    for part in line.split(","):
        words = part.split()
        for one, other in zip(words, words[1:]):
            if re.fullmatch(r"[+-]?(\d+\.\d*|\.\d+)", one) and re.fullmatch(r"[+-]\d+|[ED][+-]?\d*", other, re.IGNORECASE):
                raise InputFault(f"{place}: '{one} {other}' could be one number or two; put a comma between, or no blank")
        found += words or [""]
    return found


def fields_of(line: str, place: str) -> Line:
    """Name or mark of continuation, 8 fields, or 4 of a large card, and the tenth one. Throws InputFault."""
    if FREE.match(line):
        words = words_of(line, place)
        count = 4 if is_large(words[0]) else 8
        head, fields, tail = words[0], words[1:count + 1], words[count + 1] if len(words) > count + 1 else ""
        doubtful = ""
        if any(words[count + 2:]) or re.fullmatch(r"[\d.+-]*\d[\d.+-]*|THRU|BY", tail, re.IGNORECASE) and tail[0] != "+":
            if not tail or tail[0] == "+":
                raise InputFault(f"{place}: fields of data go on behind a tenth field that is a mark or empty; go on in a next "
                                 "line that begins with +")
            fields, doubtful, tail = words[1:], tail, ""  # goes on in the same line
        fields = fields + [""] * (-len(fields) % count or (0 if fields else count))
    else:
        line = line.expandtabs(8)
        head, tail = line[:8].strip(), line[72:80].rstrip()
        width = 16 if is_large(head) else 8
        fields = [line[at:at + width].strip() for at in range(8, 72, width)]
        doubtful = ""
    found = Line(head, fields, tail[1:].strip() if tail else None, place, doubtful=doubtful)
    if head[:1] in ("+", "*", ""):
        found.mark = head[1:].strip()
    return found


def _join(lines: list) -> None:
    """Gives every continuation to the line whose tenth field has its mark; without a mark to the one before it."""
    tails: dict = {}
    for line in lines:
        if line.tail:
            tails.setdefault(line.tail.upper(), []).append(line)
    marks = {line.mark.upper() for line in lines if line.mark}
    for before, line in zip([None, *lines], lines):
        if line.doubtful and line.doubtful[1:].upper() in marks:
            raise InputFault(f"{line.place}: the ninth field of data, {line.doubtful}, could be the mark of a continuation; write + "
                             "before marks, and no more than eight fields on a line")
        if line.mark is None:
            continue
        mark = line.mark.upper()
        if before is None and mark not in tails:
            raise InputFault(f"{line.place}: a continuation of no card")
        if not mark:
            if before.tail and before.tail.upper() in marks:
                raise InputFault(f"{line.place}: a continuation without a mark follows a line whose tenth field has the mark "
                                 f"'{before.tail}' of another one")
            own = before
        elif before is not None and before.tail is not None and before.tail.upper() == mark:
            own = before
        else:
            owners = [one for one in tails.get(mark, ()) if not one.taken]
            if len(owners) != 1:
                raise InputFault(f"{line.place}: {'more than one' if owners else 'no'} line has the mark '{line.mark}' of this "
                                 "continuation in its tenth field")
            own = owners[0]
        if own.taken:
            raise InputFault(f"{line.place}: {own.place} has a continuation already")
        own.after, own.taken = line, True


def _replicated(text: str, before: str, place: str) -> str:
    """A field that is `=`, or `*1`, `*(1)` more than the one of the card before."""
    if text == "=":
        return before
    step = re.fullmatch(r"\*\(?([^()]+)\)?", text)
    if not step:
        return text
    value = number(before or "0", place) + number(step[1], place)
    whole = re.fullmatch(r"[+-]?\d+", before or "0") and re.fullmatch(r"[+-]?\d+", step[1])
    return str(int(value)) if whole else repr(value)


def _repeat(lines: list, line: Line) -> list:
    """Lines that a line with `=` in place of its name stands for; `=(4)`: four more by the steps of the line before."""
    if not lines:
        raise InputFault(f"{line.place}: a replication of no card")
    count = re.fullmatch(r"=\(?(\d{1,7})\)?", line.head)
    last, steps = lines[-1], line.fields
    if count and not any(steps):
        steps = getattr(last, "steps", None)
        if steps is None:
            raise InputFault(f"{line.place}: {line.head} repeats no replication")
    elif line.head != "=" and not count:
        raise InputFault(f"{line.place}: '{shown(line.head)}' is no replication: =, or = and a number")
    times = int(count[1]) if count else 1
    if times > MOST:
        raise InputFault(f"{line.place}: a replication of {times} cards")
    made = []
    for _ in range(times):
        rest = steps.index("==") if "==" in steps else len(steps)
        fields = [_replicated(text, before, line.place) for text, before in zip(steps[:rest], last.fields)]
        last = Replica(last.head, fields + last.fields[rest:], line.tail, line.place)
        last.steps = steps
        made.append(last)
    return made


class Replica(Line):
    """A line that replication made; `steps`: its fields as they stand."""

    __slots__ = ("steps",)


def _bulk(lines: list) -> list:
    """Lines of the bulk data up to ENDDATA as fields."""
    found: list = []
    equation = False
    for place, text in lines:
        if equation and text[0] in " +*":  # the text of an equation, in which commas mean nothing
            continue
        equation = bool(re.match(r"\s*DEQATN\b", text, re.IGNORECASE))
        if equation:
            found.append(Line("DEQATN", [text[8:16].strip()], None, place))
            continue
        if re.match(r"\s*BEGIN\s+(SU|BU|AU)", text, re.IGNORECASE):
            raise InputFault(f"{place}: '{' '.join(text.split())}': superelements in parts of their own are not known")
        line = fields_of(text, place)
        if line.mark is None and line.head[0] == "=":
            found += _repeat([one for one in found[-1:] if one.mark is None], line)
            continue
        if line.mark is None and re.fullmatch(r"ENDDATA\*?", line.head, re.IGNORECASE):
            break
        found.append(line)
    return found


def deck_of(path: Path) -> tuple:
    """Lines of the control sections as (place, text), and the cards of the bulk data, up to ENDDATA."""
    lines = list(included(path))
    begin = next((at for at, (_, line) in enumerate(lines) if re.match(r"\s*BEGIN\s+BULK", line, re.IGNORECASE)), None)
    control = [] if begin is None else lines[:begin]
    bulk = _bulk(lines[0 if begin is None else begin + 1:])
    _join(bulk)
    cards: list = []
    for line in bulk:
        if line.mark is not None:
            continue
        name = line.head.rstrip("* ").upper()
        if not re.fullmatch(r"[A-Z][A-Z0-9_]*", name):
            raise InputFault(f"{line.place}: '{shown(line.head)}' is no card of Nastran")
        card, after = Card(name, list(line.fields), line.place), line.after
        while after is not None:
            if after.head[:1] != "*":
                card.fields += [""] * (-len(card.fields) % 8)
            card.fields += after.fields
            after = after.after
        cards.append(card)
    return control, once(cards)


# Elements of structures, those of NASTRAN-95 among them, and where cards have a density or a mass.
STRUCTURAL = re.compile(r"C(BAR|BEAM|BEND|ROD|ONROD|TUBE|SHEAR|QUAD[124R8]|TRIA[1236R]|QDMEM\d?|TRMEM|QDPLT|TRPLT|TRBSC|HEXA[12]?|"
                        r"PENTA|WEDGE|TETRA|PYRAM|IHEX[123]|BUSH|ELAS[12])")
MASS_AT = {"MAT1": 4, "MAT2": 7, "MAT8": 7, "MAT9": 22, "CONM2": 3, "CMASS2": 1, "PMASS": 1, "PSHELL": 7, "PBAR": 6,
           "PROD": 5}
# Kinds of things that have numbers of their own -> their cards.
NUMBERED = {"grid point": r"GRID", "element": STRUCTURAL.pattern, "one of its kind": r"CONM[12]|CMASS\d|CDAMP\d|R(BE[123]|BAR|ROD)",
            "material": r"MAT([12389]|10|11)", "coordinate system": r"CORD[12][RCS]", "property of bars": r"PBARL?",
            "property of beams": r"PBEAML?", "property of shells": r"PSHELL|PCOMPG?", "property": r"PSOLID|PROD|PTUBE|PBUSH|PELAS|PDAMP",
            "sum of sets": r"SPCADD|MPCADD", "default": r"GRDSET|BAROR|BEAMOR", "parameter": r"PARAM"}
SEVERAL = {"PELAS": 4, "PDAMP": 2, "PVISC": 4, "CORD1R": 4, "CORD1C": 4, "CORD1S": 4}  # fields of each of the things on a card


def _contents(fields) -> list:
    """Fields by their values, without empty ones at the end."""
    found: list = []
    for text in fields:
        try:
            found.append(number(text, ""))
        except InputFault:
            found.append(text.upper())
    while found and found[-1] == "":
        found.pop()
    return found


def once(cards: list) -> list:
    """Cards without those that say the same again. Throws InputFault where a number is given twice in two ways."""
    kinds: dict = {}
    seen: dict = {}
    kept = []
    for card in cards:
        if card.name not in kinds:
            kinds[card.name] = next((kind for kind, names in NUMBERED.items() if re.fullmatch(names, card.name)), None)
        kind = kinds[card.name]
        if kind is None:
            kept.append(card)
            continue
        width, new = SEVERAL.get(card.name, max(1, len(card.fields))), False
        for at in range(0, len(card.fields), width):
            if card.text(at) or kind == "default":
                family = card.name if kind in ("property", "default", "sum of sets", "one of its kind") else kind
                label = "" if kind == "default" else card.text(at)
                first = seen.setdefault((family, label), card)
                if first is not card and (first.name, _contents(first.fields)) != (card.name, _contents(card.fields)):
                    raise InputFault(f"{card.place}: {card.name} {label}{' ' if label else ''}is given twice, in another way at "
                                     f"{first.place}")
                new |= first is card
        if new:
            kept.append(card)
    return kept


def holds_mass(path: Path) -> bool:
    """Whether a deck has elements of a structure and mass. Throws InputFault."""
    cards = deck_of(path)[1]
    return any(STRUCTURAL.fullmatch(card.name) for card in cards) and any(
        card.name == "CONM1" or card.name in MASS_AT and card.real(MASS_AT[card.name]) for card in cards)
