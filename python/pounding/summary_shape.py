"""The shape of summary.json: which kinds of values stand where, as far as its readers rely on them."""

NUMBER, TEXT, ANY = "a number", "a text", "anything"


class _Or:
    """One of several kinds."""

    def __init__(self, *kinds):
        self.kinds = [one for kind in kinds for one in (kind.kinds if isinstance(kind, _Or) else [kind])]


NONE = "none"
LOOSE = _Or(NUMBER, NONE)  # no number where nothing was found, or what was found is not finite
THREE = _Or((LOOSE, LOOSE, LOOSE), NONE)
PAIR = (LOOSE, LOOSE)

# A tuple stands for a list of as many values. A key with ! behind it must be there; * stands for names of the user's. Keys that are not named are free.
SIDE = {"structure": TEXT, "peak_displacement": LOOSE, "frequency": LOOSE, "damping_ratio": LOOSE}
MODE = {"frequency!": NUMBER, "direction": TEXT, "fraction": LOOSE, "effective_mass": LOOSE,
        "effective_modal_mass": [LOOSE], "damped_frequency": LOOSE}
REGION = {"element": TEXT, "thickness": LOOSE, "material": {"name": TEXT, "young": LOOSE, "poisson": LOOSE, "density": LOOSE},
          "section": {"name": TEXT, "area": LOOSE, "z_axis": [LOOSE]}}
STRUCTURE = {"dofs": NUMBER, "nodes": NUMBER, "mass": LOOSE, "groups": {"*": ANY},
             "regions": {"*": REGION}, "damping": _Or({"band": [NUMBER], "filters": [{"weight!": NUMBER, "rate!": NUMBER}],
                                                       "uniform": LOOSE, "reference_frequency": LOOSE}, NONE),
             "frequencies": [MODE], "omega_max": LOOSE, "stable_time_step": LOOSE, "stable_time_step_undamped": LOOSE}
YIELDED = {"elements!": NUMBER, "yielded!": NUMBER, "ductility!": NUMBER, "element!": NUMBER, "place": THREE, "first_time!": LOOSE,
           "energy_lost!": LOOSE}
SUMMARY = {
    **dict.fromkeys(("title", "version", "commit", "started", "ended"), TEXT),
    **dict.fromkeys(("time_step", "stable_time_step", "steps", "end_time", "output_interval", "ranks", "wall_time",
                     "microseconds_per_step", "peak_memory"), LOOSE),
    "machine": {"names": [TEXT], "processor": TEXT, "folder": TEXT},
    "overrides": {"*": TEXT}, "versions": {"*": TEXT}, "options": {"*": TEXT},
    "inputs": [{"option!": TEXT, "file!": TEXT, "bytes!": NUMBER, "sha256!": TEXT}],
    "structures": {"*": STRUCTURE}, "files": [{"name!": TEXT, "holds!": TEXT}],
    "motion": {"*": _Or({"*": ANY}, NONE)},
    "energy": {"*": LOOSE},
    "impacts": {"episodes!": NUMBER, "*": _Or(LOOSE, {"*": LOOSE})},
    "separations": {"*": {"secondary": SIDE, "primary": SIDE, "*": LOOSE}},
    "contacts": {"*": {"initial_gap": PAIR, "geometric_gap": PAIR, "normal": [LOOSE], "pairs": NUMBER}},
    "yielding": {"*": {**YIELDED, "storeys": {"*": YIELDED}}},
    "probes": {"*": {"structure": TEXT, "peak_acceleration": THREE, "peak_displacement": THREE}},
    "peak_frequency": LOOSE, "drifts": [{"*": ANY}], "warnings": [TEXT], "supports": _Or([ANY], {"*": ANY}, NONE),
}
WORDS = {dict: "a mapping", list: "a list", tuple: "a list"}


def _is(value, kind) -> bool:
    if kind == NUMBER:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, str) if kind == TEXT else value is None if kind == NONE else True


def _holds(value, kind) -> bool:
    return isinstance(value, dict if isinstance(kind, dict) else list)


def _words(kind) -> str:
    if isinstance(kind, _Or):
        return " or ".join(_words(one) for one in kind.kinds)
    return kind if isinstance(kind, str) else WORDS[type(kind)]


def _fault(value, kind, place: str) -> str:
    """What is wrong, or ''."""
    if isinstance(kind, _Or):
        alike = [one for one in kind.kinds if (_is(value, one) if isinstance(one, str) else _holds(value, one))]
        return _fault(value, alike[0], place) if alike else f"{place} is not {_words(kind)}"
    if isinstance(kind, str):
        return "" if _is(value, kind) else f"{place} is not {kind}"
    if not _holds(value, kind):
        return f"{place} is not {WORDS[type(kind)]}"
    if isinstance(kind, tuple) and len(value) != len(kind):
        return f"{place} has {len(value)} values, not {len(kind)}"
    if isinstance(kind, (list, tuple)):
        return next((fault for number, one in enumerate(value) if (fault := _fault(one, kind[0], f"{place}[{number}]"))),
                    "")
    for key, own in kind.items():
        if key.endswith("!") and key[:-1] not in value:
            return f"{place} has no {key[:-1]}"
    for name, one in value.items():
        own = kind.get(name, kind.get(f"{name}!", kind.get("*", ANY)))
        if fault := _fault(one, own, f"{place}.{name}" if place else name):
            return fault
    return ""


def check(summary) -> None:
    """Throws ValueError where the summary is none that a run wrote."""
    if not isinstance(summary, dict):
        raise ValueError("it is no mapping of names to values, as a run writes it")
    if fault := _fault(summary, SUMMARY, ""):
        raise ValueError(f"{fault}, as a run writes it")
