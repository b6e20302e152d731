"""Seals checkpoints and modal bases anew after they were changed on purpose, in Python say: run/seal FILE [FILE ...]

Such a file begins with 512 bytes of text that hold length and CRC-32 of what follows; the program
refuses a file that does not agree with them. The format is in src/io/file_seal.h. A file that HDF5
cannot read whole is not sealed: the library ends the program on some damaged files.
"""

import os
import re
import subprocess
import sys
import zlib
from pathlib import Path

from .process import parser_of

SIZE = 512
HEAD = re.compile(rb"pounding seal 1\nbytes \d+\ncrc32 [0-9a-f]{8}\n((?:open \d+ \d+\n)*)\0*")
HDF5 = b"\x89HDF\r\n\x1a\n"  # a piece of a mesh begins otherwise

# In a process of its own: a damaged file may end it inside the library.
READING = """
import sys
import h5py


def attributes(thing):
    for name in thing.attrs:
        thing.attrs[name]


def visit(name, thing):
    attributes(thing)
    if isinstance(thing, h5py.Dataset):
        thing[()]


with h5py.File(sys.argv[1], "r") as file:
    attributes(file)
    file.visititems(visit)
"""


def read_whole(path):
    """The error of HDF5 that reads every dataset and attribute of a file, empty where it can."""
    reading = subprocess.run([sys.executable, "-c", READING, path], capture_output=True, text=True)
    if reading.returncode < 0:
        return f"the library stops by signal {-reading.returncode}"
    lines = reading.stderr.strip().splitlines() if reading.returncode else []
    return lines[-1] if lines else ""


def seal(path):
    with open(path, "r+b") as file:
        head = HEAD.fullmatch(file.read(SIZE)) if os.fstat(file.fileno()).st_size >= SIZE else None
        if not head:
            sys.exit(f"{path}: does not begin with a seal; it is not a file that pounding reads back")
        content = file.read()
        trouble = read_whole(path) if content.startswith(HDF5) else ""
        if trouble:
            sys.exit(f"{path}: HDF5 cannot read it whole, so it is not sealed: {trouble}")
        crc, begin = 0, SIZE
        for first, count in re.findall(rb"open (\d+) (\d+)", head[1]):
            crc, begin = zlib.crc32(content[begin - SIZE:int(first) - SIZE], crc), int(first) + int(count)
        crc = zlib.crc32(content[begin - SIZE:], crc)
        text = f"pounding seal 1\nbytes {len(content)}\ncrc32 {crc:08x}\n".encode() + head[1]
        file.seek(0)
        file.write(text.ljust(SIZE, b"\0"))


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("files", metavar="FILE", type=Path, nargs="+", help="checkpoint or basis")
    for path in parser.parse_args().files:
        seal(path)
    return 0
