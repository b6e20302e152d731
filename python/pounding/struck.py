"""Places that are struck: largest mean pressure over areas of a contact's face beside the bearing strength of its concrete, and largest
force per length along its edge beside a strength of the slab. docs/manual/review.md has keys and formulas."""

from dataclasses import dataclass

import numpy as np

from pounding.results import Result

TABLE = "struck_areas"
WIDEST = 2.0  # largest sqrt(A2 / A1) that counts
STRENGTHS = ("strength", "support", "reduction", "edge_strength")
VALUES = 5  # of a place: force [N], time [s], x, y, z [m]


@dataclass(frozen=True)
class Strength:
    """`concrete`: specified strength f'c [Pa]; `support`: area A2 behind the one that is pressed [m2], None: no wider than that;
    `reduction`: factor phi; `edge`: force per length of edge that the slab bears [N/m]. None of what is not asked for."""

    concrete: float | None = None
    support: float | None = None
    reduction: float = 1.0
    edge: float | None = None

    def bearing(self, area: float) -> float:
        """Mean pressure that an area A1 bears [Pa]: phi 0.85 f'c sqrt(A2 / A1), the root between 1 and 2 (ACI 318-19, table
        22.8.3.2); not a number without a strength."""
        wider = min(WIDEST, max(1.0, np.sqrt((self.support or area) / area)))
        return np.nan if self.concrete is None else float(self.reduction * 0.85 * self.concrete * wider)

    def of(self, window: "Window") -> float:
        """What a place bears, in the unit of its mean; not a number where that is not given."""
        return (np.nan if self.edge is None else self.edge) if window.is_edge else self.bearing(window.size)


@dataclass(frozen=True)
class Window:
    """A square of so many m2 anywhere on a face, or a length along it in m."""

    size: float
    is_edge: bool

    @property
    def name(self) -> str:
        return f"{self.size:.6g} m of edge" if self.is_edge else f"{self.size:.6g} m2"

    @property
    def unit(self) -> str:
        return "N/m" if self.is_edge else "Pa"


@dataclass(frozen=True)
class Strengths:
    """Strength of each contact that has one of its own, and of all others."""

    own: dict
    others: Strength

    def of(self, contact: str) -> Strength:
        return self.own.get(contact, self.others)


def read_strengths(reader) -> Strengths:
    """Keys STRENGTHS of a block (study_file.Reader), and by contact under `contacts`. Throws UserError."""
    own, others = {}, _strength(reader, Strength())
    contacts = reader.values.get("contacts") or {}
    if not isinstance(contacts, dict):
        reader.fail("contacts", "is no list of contacts with their strengths")
    for name in contacts:
        own[str(name)] = _strength(reader.part("contacts", tuple(contacts)).part(name, STRENGTHS), others)
    if all(one.concrete is one.edge is None for one in (others, *own.values())):
        reader.refuse("", "give strength, f'c in Pa, or edge_strength in N/m")
    return Strengths(own, others)


def _strength(reader, others: Strength) -> Strength:
    def above_zero(key: str, other):
        return reader.number(key, None, 0.0) if key in reader.values else other

    found = Strength(above_zero("strength", others.concrete), above_zero("support", others.support),
                     above_zero("reduction", others.reduction), above_zero("edge_strength", others.edge))
    for key, value, least in (("strength", found.concrete, 1e5), ("edge_strength", found.edge, 1e3)):
        if key in reader.values and value < least:
            reader.fail(key, f"is below {least:.0f} {'Pa' if key == 'strength' else 'N/m'}; strengths are in SI units, 30 MPa are 30e6")
    if found.reduction > 1:
        reader.fail("reduction", "is above 1")
    if found.support is not None and found.concrete is None:
        reader.fail("support", "goes with a strength")
    return found


def of_run(result: Result) -> tuple:
    """Windows, and what was found in them, shape (contacts, windows, VALUES), of a run; none of one that did not look."""
    table, contacts = result.table(TABLE), list(result.summary.get("contacts", {}))
    if not len(table.get("contact", [])):
        return [], np.empty((len(contacts), 0, VALUES))
    values = np.stack([table[name] for name in ("force", "time", "x", "y", "z")], -1).reshape(len(contacts), -1, VALUES)
    windows = [Window(float(f"{(length if height == 0 else length * height):.9g}"), height == 0)
               for length, height in zip(table["length"][:values.shape[1]], table["height"])]
    return windows, values


def beside(strength: float, mean: float, of: str = "largest") -> dict:
    """Columns of a strength and of a mean over it; empty cells of a strength that is not given."""
    known = np.isfinite(strength)
    return {"strength": strength if known else "", f"{of} over strength": float(mean / strength) if known else ""}


def placed(values: np.ndarray) -> dict:
    """Columns of when and where."""
    return {name: float(value) for name, value in zip(("time [s]", "x [m]", "y [m]", "z [m]"), values[1:])}


def rows_of(contacts: list, windows: list, found: np.ndarray, strengths: Strengths) -> list:
    """A row per contact and window of a run in which something was struck."""
    rows = []
    for contact, of_contact in zip(contacts, found):
        for window, values in zip(windows, of_contact):
            mean, strength = float(values[0] / window.size), strengths.of(contact).of(window)
            if mean > 0:
                rows.append({"contact": contact, "over": window.name, "unit": window.unit, "largest": mean, **beside(strength, mean),
                             **({"holds": "yes" if mean <= strength else "no"} if np.isfinite(strength) else {"holds": ""}), **placed(values)})
    return rows
