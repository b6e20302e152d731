"""Instructions of a step, counted one by one and put beside the time of the step: a roofline by ports."""

import re
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from pounding.tables import leave, markdown

from .machine import Machine
from .shapes import SHAPES, Shape
from .workers import COUNTING, MeasuringError, Stepper, block_cells, slab_cells, step_benchmark, with_environment

CASES = {"cube": Shape("cube of bricks", block_cells(100_000)), "slab": Shape("slab of bricks, one layer", slab_cells(36_000)),
         "plate": Shape("plate of shells", (*slab_cells(36_000)[:2], 0)),
         **{name: shape for name, shape in SHAPES.items() if not shape.cells}}
IN_ROWS = ["cube", "slab", "plate"]  # the others take minutes each
UNITS = {"v4": "avx512f", "v3": "avx2", "v2": "sse4_2"}  # and a flag of processors that have them
WHOLE = "whole step"
ARITHMETIC = re.compile(r"v?(f?n?m?(add|sub)\w*|mul|div|sqrt|max|min)\w*[ps]d$")
SHUFFLE = re.compile(r"v?(perm|shuf|unpck|p?align|insert|extract|blend|broadcast|pbroadcast|compress|expand|movddup|movhlps|k)")
INTO_MEMORY = re.compile(r",[^,()]*\([^()]*\)(\{%k\d\})?$")  # the last operand
KINDS = ["instructions", "arithmetic", "loads", "stores", "shuffles and masks"]
MULTIPLY_ADDS = 2 * 2 * 4  # operations that machine_limits does in a cycle: two multiply-adds of four
PER_CYCLE = {"arithmetic": 2, "loads": 2, "stores": 1, "instructions": 8}  # of full vectors, on a core of today
STATE_BYTES = 32  # u and v, read and written, of a dof
SHOWN = 10  # functions


class Count(NamedTuple):
    """Instructions of one step by function, each a Counter of KINDS."""

    functions: dict
    all: Counter


def kinds_of(mnemonic: str, operands: str) -> list:
    """What an instruction, as objdump writes it, takes of a core: some load and compute."""
    found = ["instructions"]
    if ARITHMETIC.match(mnemonic):
        found.append("arithmetic")
    elif SHUFFLE.match(mnemonic):
        found.append("shuffles and masks")
    if "(" in operands and not mnemonic.startswith(("lea", "nop", "prefetch")):
        stores = "mov" in mnemonic and INTO_MEMORY.search(operands) or mnemonic.startswith("push")
        found.append("stores" if stores else "loads")
    return found


def name_of(symbol: str) -> str:
    """A function without namespaces and arguments, those of templates included."""
    bare = re.sub(r"\(anonymous namespace\)::|pounding::(stiffness::)?|<double>(?=::)", "", symbol)
    return re.sub(r"[<(].*", "", bare).removeprefix("void ").strip()


def read_counts(path: Path) -> dict:
    """Offset -> times; those in libraries under None."""
    found = {}
    for line in path.read_text().splitlines():
        place, times = line.split()
        found[None if place == "elsewhere" else int(place, 16)] = int(times)
    return found


def explain(program: Path, counts: dict) -> Count:
    """Kinds and functions of the counted addresses, from the program's own text."""
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", program], text=True, capture_output=True)
    if text.returncode != 0:
        raise MeasuringError(f"objdump: {text.stderr.strip().splitlines()[0]}")
    functions, function, found = {}, "", 0
    for line in text.stdout.splitlines():
        if head := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            function = head[1]
            continue
        one = re.match(r"\s*([0-9a-f]+):\t(?:(?:rep[nz]*|lock|bnd|notrack|data16|cs|ds) )*(\S+)\s*(.*)", line)
        times = counts.get(int(one[1], 16), 0) if one else 0
        if times:
            found += times
            kinds = functions.setdefault(name_of(function), Counter())
            for kind in kinds_of(one[2], one[3].split("#")[0].split("<")[0].strip()):
                kinds[kind] += times
    own = sum(times for place, times in counts.items() if place is not None)
    if found != own:
        raise MeasuringError(f"objdump explains {found} of {own} instructions of {program}")
    functions["libraries"] = Counter(instructions=counts[None])
    total = Counter()
    for kinds in functions.values():
        total += kinds
    return Count(functions, total)


def measure(build: Path, scratch: Path, motion: Path, case: str, rounds: int, seconds: float) -> list:
    """Rows of the functions of a step on one rank, by each vector unit, with the whole first: numbers per dof, and the
    time of the step."""
    if not COUNTING:
        raise MeasuringError("instructions are counted on x86-64 alone")
    print(f"  {case}", file=sys.stderr, flush=True)
    model = CASES[case].model(scratch, motion)
    rows = []
    with Machine(build, [1]) as machine:
        for unit in units_of(build):
            command = step_benchmark(build, 1, motion, model, ["element"], "-vector_unit", unit)
            counted = scratch / f"{case}-{unit}.counts"
            done = subprocess.run(with_environment([build / "tests" / "count_instructions", counted, *command[3:]]), text=True,
                                  capture_output=True, input="element 0\n")
            if done.returncode != 0:
                raise MeasuringError(f"count_instructions: {(done.stderr.strip().splitlines() or ['failed'])[-1]}")
            with Stepper(command) as stepper:
                dofs = stepper.ways["element"]["dofs"]
                times, rates = [], []
                for _ in range(rounds):
                    rates.append(machine.calibrate()[1])
                    machine.measure_triad(case, 1, STATE_BYTES * dofs, seconds)
                    times.append(stepper.ask(f"element {seconds}")["quiet_seconds_per_step"])
            count = explain(Path(command[3]), read_counts(counted))
            ordered = sorted(count.functions.items(), key=lambda one: -one[1]["instructions"])
            speed = {"dofs": dofs, "nanoseconds": 1e9 * min(times) / dofs, "flops_per_second": max(rates),
                     "bytes_per_second": max(machine.triad[case, 1].values)}
            rows += [{"case": case, "unit": unit, "function": name, **{kind: kinds[kind] / dofs for kind in KINDS}, **speed}
                     for name, kinds in [(WHOLE, count.all), *ordered]]
    return rows


def units_of(build: Path) -> list:
    """The two best vector units that the processor has, of those that the build has kernels for."""
    built = re.search(r"^POUNDING_VECTOR_UNITS:STRING=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)[1].split(";")
    flags = set(re.findall(r"\w+", next((line for line in Path("/proc/cpuinfo").read_text().splitlines()
                                         if line.startswith("flags")), "")))
    return [unit for unit, flag in UNITS.items() if flag in flags and unit in built][:2]


def bounds(row: dict) -> dict:
    """Least time of a dof by what a core can begin in a cycle (PER_CYCLE), and by the bytes of the state at the rate of a
    triad on as many [ns]."""
    cycle = 1e9 * MULTIPLY_ADDS / row["flops_per_second"]
    return {**{kind: row[kind] / most * cycle for kind, most in PER_CYCLE.items()},
            "state": 1e9 * STATE_BYTES / row["bytes_per_second"]}


def write(folder: Path, rows: list) -> str:
    """Writes instructions.md and instructions.csv; returns the tables."""
    whole = [row for row in rows if row["function"] == WHOLE]
    least = [max((time, kind) for kind, time in bounds(row).items()) for row in whole]
    text = markdown("Instructions of a step on one rank per dof, its time, and the least that they take [ns]",
                    ["", "unit", "dofs", *KINDS, "measured", "least", "by"],
                    [[CASES[row["case"]].label, row["unit"], row["dofs"], *(row[kind] for kind in KINDS), row["nanoseconds"],
                      *most] for row, most in zip(whole, least)])
    for case in dict.fromkeys(row["case"] for row in whole):
        mine = [row for row in rows if row["case"] == case]
        best, *others = dict.fromkeys(row["unit"] for row in mine)
        found = {(row["unit"], row["function"]): row for row in mine}
        text += "\n" + markdown(
            f"{CASES[case].label}: instructions per dof by {best}", ["", *KINDS, *(f"all by {unit}" for unit in others)],
            [[row["function"], *(row[kind] for kind in KINDS),
              *(found.get((unit, row["function"]), {}).get("instructions") for unit in others)]
             for row in [row for row in mine if row["unit"] == best][:SHOWN + 1]])
    return leave(folder, "instructions", text, rows)
