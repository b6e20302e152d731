"""Samples of a study that are run at full order as well as by its reduction, as its file asks for them."""

import re
from dataclasses import dataclass, field

from .study_file import Reader

REDUCED, FULL = "reduced", "full"  # orders of every study
PILOT = 8
LEAST = 4  # samples that a correlation comes from


@dataclass(frozen=True)
class BothOrders:
    """`samples` that are run at full order as well, or the `accuracy` for which the program chooses them after a `pilot` of so many;
    `between`: options of other orders beside those of the reduction, by their names."""

    samples: int
    accuracy: float
    pilot: int
    between: dict = field(default_factory=dict)

    def complaint(self, samples: int) -> str:
        """Why a study of so many samples cannot have these; empty: it can."""
        if self.samples:
            return "" if self.samples <= samples - 2 else f"samples: {self.samples} leave of the study's {samples} no two for the reduction alone"
        least = self.pilot + LEAST + 2
        return "" if samples >= least else f"accuracy: needs {least} samples or more, {self.pilot} of them for its pilot; the study has {samples}"


def read(reader: Reader, exchange: bool) -> BothOrders | None:
    """Of the keys below full_order; None where the study asks for none. Throws UserError."""
    given = [key for key in ("share", "samples", "accuracy") if key in reader.values]
    if len(given) > 1:
        reader.fail(given[1], f"goes without {given[0]}")
    for key in ("pilot", "between"):
        if key in reader.values and given != ["accuracy"]:
            reader.fail(key, "goes with accuracy")
    if not given or given == ["share"]:
        return None
    if given == ["samples"]:
        return BothOrders(reader.whole("samples", 0, 2 * LEAST), 0.0, 0)
    if exchange:
        reader.fail("accuracy", "chooses how many samples there are, in whose joints those of exchange are; give samples")
    return BothOrders(0, reader.number("accuracy", None, 0.0, 1.0), reader.whole("pilot", PILOT, LEAST), _between(reader))


def _between(reader: Reader) -> dict:
    """Options of the orders between, by their names."""
    values = reader.values.get("between") or {}
    if not isinstance(values, dict):
        reader.fail("between", "is no list of named options, as `between: {m200: {left_modes: 200}}`")
    for name in values:
        if not re.fullmatch(r"[A-Za-z]\w*", str(name)) or name in (REDUCED, FULL):
            reader.fail("between", f"has the name {name!r}, which is none of letters and digits, or that of the reduction or of full order")
    one = reader.part("between", tuple(values))
    return {name: one.options(name) for name in values}
