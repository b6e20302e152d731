"""Cards of all formats: the fields of a line as text, read by their places."""

from .model import InputFault
from .texts import number, whole


class Fields:
    """What cards have in common: `fields` as text and their `place`. `NAMED`: faults say `name` as well; `MISSING`: how a
    field that is not there is told, from which number on, where there is no fallback."""

    __slots__ = ()
    NAMED = True
    MISSING = ("field", 1)

    @property
    def where(self) -> str:
        return f"{self.place}: {self.name}" if self.NAMED else self.place

    def text(self, at: int) -> str:
        return self.fields[at] if at < len(self.fields) else ""

    def real(self, at: int, fallback: float = 0.0) -> float:
        return number(self.text(at), self.where) if self.text(at) else fallback

    def int(self, at: int, fallback: int | None = None) -> int:
        """Throws InputFault where there is none and no fallback."""
        if not self.text(at):
            if fallback is None:
                raise InputFault(f"{self.where} has no {self.MISSING[0]} {at + self.MISSING[1]}")
            return fallback
        return whole(self.text(at), self.where)

    def vector(self, at: int) -> tuple:
        return tuple(self.real(at + k) for k in range(3))


def cut(line: str, widths) -> list:
    """Fields of these widths, as far as the line goes; more of the last width."""
    fields, at = [], 0
    while at < len(line.rstrip()):
        width = widths[min(len(fields), len(widths) - 1)]
        fields.append(line[at:at + width].strip())
        at += width
    return fields
