"""Formats by name, with the endings of their files."""

import importlib
from pathlib import Path

from .cards import GUARD
from .model import InputFault, Model
from .second_order import settle
from .stacks import unstack

# Name -> module, endings.
FORMATS = {"abaqus": ("abaqus", (".inp",)), "nastran": ("nastran", (".bdf", ".nas", ".dat")),
           "ansys": ("ansys", (".cdb",)), "med": ("med", (".med", ".rmed", ".mmed")), "unv": ("unv", (".unv",)),
           "dyna": ("dyna", (".k", ".key", ".dyn")), "sap2000": ("sap2000", (".s2k", ".$2k"))}


def read(path: Path, wanted: str | None) -> Model:
    """The model of a file. Throws InputFault, in one line with the file and the line in it."""
    ending = path.suffix.lower()
    name = wanted or next((one for one, (_, endings) in FORMATS.items() if ending in endings), None)
    if name is None:
        known = ", ".join(ending for _, endings in FORMATS.values() for ending in endings)
        raise InputFault(f"{path}: files with the ending '{ending}' are not known ({known}); say --format")
    if not path.is_file():
        raise InputFault(f"{path}: no such file")
    GUARD.begin()
    module = importlib.import_module(f".{FORMATS[name][0]}", __package__)
    try:
        model = module.read(path)
    except RecursionError as error:
        raise InputFault(f"{path}: files that include each other too deeply") from error
    settle(model)
    unstack(model)
    if not (model.elements or model.masses or model.springs or model.cards.lost):
        raise InputFault(f"{path}: no element in it")
    return model
