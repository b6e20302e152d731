#!/usr/bin/python3
"""Joins the kernels of several vector units into one object: join_units.py OBJECT UNIT=FILE ...

Every FILE lists the objects of one unit, one per line. All their symbols become local, but for a table of functions; a
function that kernels define becomes a jump through the table of the unit in use, pounding_kernels, which the program
fills (src/common/vector_unit.cpp). Code of a unit is in a section of its name, text_v3 for instance. Data of kernels
cannot be reached from elsewhere, tables of virtual functions neither: a class of a kernel has its destructor in its
.cpp, else the linker says that its table is missing. Needs ld, nm, objdump, objcopy and as.
"""

import os
import subprocess
import sys
from pathlib import Path


def call(tool: str, *words: object) -> str:
    return subprocess.run([os.environ.get(tool.upper(), tool), *map(str, words)], check=True, stdout=subprocess.PIPE,
                          text=True).stdout


def functions_of(merged: Path) -> set[str]:
    """Functions that are defined once in the unit, and so are reached by their names from elsewhere."""
    lines = (line.split() for line in call("nm", "--defined-only", "--format=posix", merged).splitlines())
    return {words[0] for words in lines if words[1] == "T"}


def assemble(path: Path, lines: list[str]) -> Path:
    source = path.with_suffix(".s")
    source.write_text("\n".join([*lines, '.section .note.GNU-stack,"",@progbits', ""]))
    call("as", "-o", path, source)
    return path


def table(name: str, functions: list[str]) -> list[str]:
    return ['.section .data.rel.ro,"aw"', ".balign 8", f".globl {name}", f"{name}:",
            *(f".quad {function}" for function in functions)]


def merge(unit: str, objects: list[str], folder: Path) -> Path:
    merged = folder / f"{unit}.o"
    call("ld", "-r", "--force-group-allocation", "-o", merged, *objects)
    return merged


def hide(unit: str, merged: Path, functions: list[str]) -> Path:
    """The merged object with a table of its functions, of which alone the table is seen."""
    symbol = f"pounding_kernels_{unit}"
    entries = assemble(merged.with_name(f"{unit}-table.o"), table(symbol, functions))
    both = merged.with_name(f"{unit}-both.o")
    call("ld", "-r", "-o", both, merged, entries)
    sections = [words[1] for words in map(str.split, call("objdump", "-h", merged).splitlines())
                if len(words) > 1 and words[1].startswith(".text")]
    hidden = merged.with_name(f"{unit}-hidden.o")
    call("objcopy", f"--keep-global-symbol={symbol}", *(f"--rename-section={name}=text_{unit}" for name in sections), both,
         hidden)
    return hidden


def jumps(functions: list[str]) -> list[str]:
    lines = [".text"]
    for number, function in enumerate(functions):
        lines += [f".globl {function}", f".type {function}, @function", f"{function}:",
                  f"jmp *pounding_kernels+{8 * number}(%rip)", f".size {function}, .-{function}"]
    return lines


def join(result: Path, units: dict[str, list[str]]):
    folder = result.with_suffix(".parts")
    folder.mkdir(parents=True, exist_ok=True)
    merged = {unit: merge(unit, objects, folder) for unit, objects in units.items()}
    # Those whose types depend on the unit are called within it alone.
    functions = sorted(set.intersection(*(functions_of(file) for file in merged.values())))
    lines = [*jumps(functions), ".section .rodata", ".balign 8", ".globl pounding_kernel_count", "pounding_kernel_count:",
             f".quad {len(functions)}",
             *table("pounding_kernel_tables", [f"pounding_kernels_{unit}" for unit in units]),
             f".comm pounding_kernels, {8 * len(functions)}, 64",
             *table("pounding_kernels_filled_by", ["pounding_use_best_unit"])]
    hidden = [hide(unit, file, functions) for unit, file in merged.items()]
    call("ld", "-r", "-o", result, assemble(folder / "jumps.o", lines), *hidden)


if __name__ == "__main__":
    join(Path(sys.argv[1]), {unit: Path(path).read_text().split()
                             for unit, path in (word.split("=", 1) for word in sys.argv[2:])})
