"""Checkpoints and stored bases: files that are none, damaged, or of another run."""
import os
import shutil

import h5py
import numpy

import program
from corpus.case import Case


def made_file(source, edit):
    """A copy of a file of the sound run, edited through h5py and sealed anew."""
    def make(path, made):
        shutil.copy(os.path.join(made, source), path)
        with h5py.File(path, "r+") as file:
            edit(file)
        if program.command("seal", path).returncode != 0:
            raise ValueError(f"{path} was not sealed")
    return make


def made_bytes(source, edit):
    """A copy of a file of the sound run with its bytes edited."""
    def make(path, made):
        with open(os.path.join(made, source), "rb") as file:
            content = edit(bytearray(file.read()))
        with open(path, "wb") as file:
            file.write(content)
    return make


def history(path, made):
    shutil.copy(os.path.join(made, "run/history.h5"), path)


def no_records(path, made):
    history(path, made)
    with h5py.File(path, "r+") as file:
        del file["records"]
        file["records"] = numpy.zeros(0)


SOUND = ["-options_file", "{made}/scene/scene.yaml"]
RESTART = [*SOUND, "-end_time", "0.02", "-restart", "{folder}/checkpoint.h5"]


RESTART_SOUND = Case("sound", RESTART, [], {"checkpoint.h5": made_bytes("run/checkpoint.h5", bytes),
                                            "history.h5": history}, scene="")


def checkpoint(name, edit, words, *arguments):
    """A run continued from an edited checkpoint; the edit gets the open file."""
    return Case(name, [*RESTART, *arguments], ["-restart", "{folder}/checkpoint.h5", *words],
                {"checkpoint.h5": made_file("run/checkpoint.h5", edit), "history.h5": history}, scene="")


def damaged(name, edit, words):
    """A run continued from a checkpoint of which the bytes were edited."""
    return Case(name, RESTART, ["-restart", "{folder}/checkpoint.h5", *words],
                {"checkpoint.h5": made_bytes("run/checkpoint.h5", edit), "history.h5": history}, scene="")


def attribute(place, key, value):
    def edit(file):
        file[place].attrs[key] = numpy.bytes_(value) if isinstance(value, str) else value
    return edit


def removed(place):
    def edit(file):
        del file[place]
    return edit


def values(place, value):
    def edit(file):
        file[place][...] = value
    return edit


def shortened(place):
    def edit(file):
        rows = file[place][:-1]
        del file[place]
        file[place] = rows
    return edit


CHECKPOINTS = [
    Case("no such checkpoint", ["-restart", "{folder}/none.h5"], ["-restart", "{folder}/none.h5"]),
    Case("a folder as a checkpoint", ["-restart", "{folder}"], ["-restart", "{folder}"]),
    Case("text as a checkpoint", ["-restart", "{folder}/record.csv"], ["-restart", "{folder}/record.csv"]),
    Case("an empty checkpoint", ["-restart", "{folder}/checkpoint.h5"], ["-restart", "{folder}/checkpoint.h5"],
         {"checkpoint.h5": b""}),
    Case("a history as a checkpoint", ["-restart", "{folder}/history.h5"],
         ["-restart", "{folder}/history.h5", "not a checkpoint"], {"history.h5": history}),
    Case("no history beside the checkpoint", RESTART, ["-restart", "history"],
         {"checkpoint.h5": made_bytes("run/checkpoint.h5", bytes)}, scene=""),
    Case("a history that counts no records", RESTART, ["-restart", "history.h5: dataset 'records' has 0 rows"],
         {"checkpoint.h5": made_bytes("run/checkpoint.h5", bytes), "history.h5": no_records}, scene=""),
    Case("text as the history", RESTART, ["-restart", "history"],
         {"checkpoint.h5": made_bytes("run/checkpoint.h5", bytes), "history.h5": "time\n"}, scene=""),
    damaged("a checkpoint cut in half", lambda content: content[:len(content) // 2], []),
    damaged("a checkpoint without its first bytes", lambda content: content[8:], []),
    damaged("a checkpoint of zeros", lambda content: bytes(len(content)), []),
    checkpoint("a checkpoint of another schema", attribute("/", "schema", 99.0), ["schema 99"]),
    checkpoint("a checkpoint that calls itself otherwise", attribute("/", "format", "recipe"),
               ["not a checkpoint"]),
    checkpoint("another time step", lambda file: None, ["time step"], "-time_step", "1e-4"),
    checkpoint("another material", lambda file: None, ["-material_concrete_young"],
               "-material_concrete_young", "31e9"),
    checkpoint("another motion", lambda file: None, ["-motion_x_pga"], "-motion_x_pga", "2"),
    checkpoint("a motion whose hash differs", attribute("/", "ground_motion", "0123456789abcdef"), ["ground motion"]),
    Case("an end before the checkpoint", [*RESTART, "-end_time", "0.001"], ["-end_time 0.001", "stands at"],
         {"checkpoint.h5": made_bytes("run/checkpoint.h5", bytes), "history.h5": history}, scene=""),
    checkpoint("no options in it", removed("options"), ["options"]),
    checkpoint("no step in it", removed("tables/step"), ["step"]),
    checkpoint("no structure in it", removed("structures/right"), ["right"]),
    checkpoint("no velocity in it", removed("structures/right/velocity"), ["velocity"]),
    checkpoint("velocities of fewer nodes", shortened("structures/right/velocity"), ["velocity", "one row per node"]),
    checkpoint("nodes elsewhere", values("structures/right/coordinates", 7.0), ["right", "another mesh"]),
    checkpoint("a step that is no number", values("tables/step", numpy.nan), ["step"]),
    checkpoint("a step beyond all steps", values("tables/step", 1e300), ["step"]),
    checkpoint("velocities that are no numbers", values("structures/right/velocity", numpy.nan), ["velocity"]),
    checkpoint("an infinite displacement", values("structures/left/displacement", numpy.inf), ["displacement"]),
    checkpoint("another count of dofs", attribute("structures/right", "dofs", 23.0), ["right", "23"]),
]

MODAL = ["-left_model", "modal", "-left_modal_vectors", "4", "-left_modal_basis", "{folder}/basis.h5"]

BASIS_SOUND = Case("sound", MODAL, [], {"basis.h5": made_bytes("basis.h5", bytes)})


def basis(name, edit, words):
    """A reduced structure with an edited stored basis; the edit gets the open file."""
    return Case(name, MODAL, ["-left_modal_basis", "{folder}/basis.h5", *words],
                {"basis.h5": made_file("basis.h5", edit)})


BASES = [
    Case("text as a basis", MODAL, ["-left_modal_basis", "{folder}/basis.h5"], {"basis.h5": "modes\n"}),
    Case("an empty basis", MODAL, ["-left_modal_basis", "{folder}/basis.h5"], {"basis.h5": b""}),
    Case("a folder as a basis", MODAL[:-1] + ["{folder}"], ["-left_modal_basis", "{folder}"]),
    Case("a checkpoint as a basis", MODAL, ["-left_modal_basis", "{folder}/basis.h5", "no modal basis"],
         {"basis.h5": made_bytes("run/checkpoint.h5", bytes)}),
    Case("a basis cut in half", MODAL, ["-left_modal_basis", "{folder}/basis.h5"],
         {"basis.h5": made_bytes("basis.h5", lambda content: content[:len(content) // 2])}),
    basis("a basis that calls itself otherwise", attribute("/", "format", "recipe"), ["another format"]),
    basis("a basis of another schema", attribute("/", "schema", 99.0), ["schema 99"]),
    basis("a basis without rows", removed("rows"), ["rows"]),
    basis("a basis without frequencies", removed("squared_frequency"), ["squared_frequency"]),
    basis("a basis of no numbers", values("squared_frequency", numpy.nan), []),
    basis("a basis with one row less", shortened("rows"), ["sizes"]),
    basis("a basis that counts its modes wrong", attribute("/", "modes", 3.0), ["sizes"]),
    basis("a basis without points", removed("points"), ["points"]),
]

CASES = CHECKPOINTS + BASES
