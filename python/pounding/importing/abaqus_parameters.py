"""Names that *PARAMETER of Abaqus gives to numbers, and `<name>` in the lines behind: numbers, + - * / ( ) and earlier
names; nothing is executed."""

import math
import re

from .cards import number
from .model import InputFault

TOKEN = re.compile(r"\s*(\*\*|[+\-*/()]|(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?|[A-Za-z_]\w*)", re.ASCII)
MOST = 1000  # tokens of an expression
DEEPEST = 50  # brackets within each other


class Parameters:
    """Their values by name, as the lines of a deck go by."""

    def __init__(self):
        self.values: dict = {}

    def assign(self, line: str, place: str) -> None:
        """A line `name = expression`. Throws InputFault."""
        line = line.split("#")[0].strip()
        if not line:
            return
        name, equals, text = line.partition("=")
        if not equals or not re.fullmatch(r"[A-Za-z_]\w*", name.strip(), re.ASCII):
            raise InputFault(f"{place}: *PARAMETER has lines of name = number")
        self.values[name.strip().upper()] = self._value(text, place)

    def fill(self, line: str, place: str) -> str:
        """A line with the numbers in place of names. Throws InputFault."""
        def value(match: re.Match) -> str:
            if match[1].strip().upper() not in self.values:
                raise InputFault(f"{place}: {match[0]} is no name of *PARAMETER")
            found = self.values[match[1].strip().upper()]
            return str(int(found)) if found == int(found) and abs(found) < 1e15 else repr(found)

        return re.sub(r"<\s*([A-Za-z_]\w*)\s*>", value, line, flags=re.ASCII) if "<" in line else line

    def _value(self, text: str, place: str) -> float:
        tokens, at = [], 0
        text = text.rstrip()
        while at < len(text):
            found = TOKEN.match(text, at)
            if not found or found[1] == "**" or len(tokens) == MOST:
                raise InputFault(f"{place}: '{text.strip()[:60]}' is more than numbers, + - * / ( ) and earlier names")
            tokens.append(found[1])
            at = found.end()
        self._tokens, self._place, self._depth = [*tokens, ""], place, 0
        try:
            value = self._sum()
        except ZeroDivisionError as error:
            raise InputFault(f"{place}: a division by zero") from error
        if self._tokens != [""] or not math.isfinite(value):
            raise InputFault(f"{place}: '{text.strip()[:60]}' is no expression of numbers and earlier names")
        return value

    def _sum(self) -> float:
        value = self._product()
        while self._tokens[0] in ("+", "-"):
            value += self._product() if self._tokens.pop(0) == "+" else -self._product()
        return value

    def _product(self) -> float:
        value = self._factor()
        while self._tokens[0] in ("*", "/"):
            if self._tokens.pop(0) == "*":
                value *= self._factor()
            else:
                value /= self._factor()
        return value

    def _factor(self) -> float:
        self._depth += 1
        token = self._tokens.pop(0) if self._tokens[0] else ""
        if self._depth > DEEPEST:
            raise InputFault(f"{self._place}: more than {DEEPEST} brackets or signs within each other")
        if token in ("+", "-"):
            value = self._factor() * (1 if token == "+" else -1)
        elif token == "(":
            value = self._sum()
            if self._tokens.pop(0) != ")":
                raise InputFault(f"{self._place}: a bracket that is not closed")
        elif token.upper() in self.values:
            value = self.values[token.upper()]
        elif token[:1].isdigit() or token[:1] == ".":
            value = number(token, self._place)
        else:
            raise InputFault(f"{self._place}: '{token}' is no number, nor an earlier name")
        self._depth -= 1
        return value
