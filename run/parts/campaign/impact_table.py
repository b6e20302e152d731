"""Impacts of a case, floor by floor."""

import numpy as np

from .results import CaseResult

HEAD = ["case", "floor", "impacts", "contact [ms]: median", "longest", "impulse [N s]: sum", "largest",
        "left [%]", "bottom [%]", "at both ends"]
AT_AN_END = 0.9  # share of the impulse in one half of the face that counts as a hit of that end


def floor_row(result: CaseResult, floor: str) -> list:
    """left, bottom: share of the impulse below the middle of the face, along y and along z; at both
    ends: impacts shared by both halves along y."""
    hits = [hit for hit in result.impacts if hit["contact"] == floor]
    label = [f"gap {result.case.gap} cm, {result.case.motion}, {result.case.variant}", floor, len(hits)]
    if not hits:
        return label + [None] * 7
    column = {name: np.array([hit[name] for hit in hits]) for name in ("contact_time", "impulse", "left", "bottom")}
    impulse = column["impulse"]
    share = {name: 100 * float((column[name] * impulse).sum() / impulse.sum()) for name in ("left", "bottom")}
    both = int(((column["left"] > 1 - AT_AN_END) & (column["left"] < AT_AN_END)).sum())
    time = 1e3 * column["contact_time"]
    return label + [float(np.median(time)), float(time.max()), float(impulse.sum()), float(impulse.max()),
                    round(share["left"], 1), round(share["bottom"], 1), both]


def rows(results: list) -> list:
    return [floor_row(result, floor) for result in results if result.case.pounds for floor in ("floor1", "floor2")]
