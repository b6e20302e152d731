"""Tables of the pages that commands measure. In a page each stands between two marks, `<!-- table NAME -->` and
`<!-- end -->`, below one line with its title, machine, date and version."""

import re
import subprocess
from datetime import date
from functools import partial
from pathlib import Path

from parts.benchmark.machine import description
from parts.benchmark.workers import MeasuringError
from parts.campaign import paper_tables
from pounding.tables import markdown

SOURCE = Path(__file__).resolve().parents[2]
MARKED = re.compile(r"(<!-- table (\w+) -->\n)(.*?)(^<!-- end -->)", re.DOTALL | re.MULTILINE)
TABLE = re.compile(r"^\*\*(.+)\*\*\n\n((?:\|.*\n)+)", re.MULTILINE)
# Title; machine, date and version; the name again.
LINE = re.compile(r"^\*\*.+\.\*\* Measured on .+, \d+ cores?, \d{4}-\d\d-\d\d, version \d+\.\d+\.\d+(?: \([0-9a-f]{8,}\+?\))?; "
                  r"again by `run/tables (\w+)`$")


def of_paper(table, folder: Path) -> str:
    """Models A and B for a few steps."""
    return markdown(*table(paper_tables.run_models(folder)))


def told(file: str, command: str, *words, title: str = "") -> partial:
    """The table that a command leaves in a file, the first whose title begins so."""
    return partial(_told, file, title, [SOURCE / "run" / command, *map(str, words)])


def _told(file: str, title: str, command: list, folder: Path) -> str:
    if subprocess.run([*command, "--output", folder], stdout=subprocess.DEVNULL).returncode != 0:
        raise MeasuringError(f"{' '.join(map(str, command))} failed, see above")
    text = (folder / file).read_text(encoding="utf-8")
    found = next((match for match in TABLE.finditer(text) if match[1].startswith(title)), None)
    if found is None:
        raise MeasuringError(f"{folder / file} has no table '{title}'")
    return found[0]


TABLES = {
    "frequencies": partial(of_paper, paper_tables.frequency_table),
    "time_steps": partial(of_paper, paper_tables.time_step_table),
    "pair": told("pair.md", "benchmark", "--scenes", "pair", "--ranks", 2, "--rounds", 3),
    "bricks": told("table.md", "benchmark", "--install-octave", "--sizes", "14000,36000,100000,300000,1000000,3000000",
                   "--rounds", 5, "--seconds", 0.3),
    "scaling": told("table.md", "scaling", "--pair", "4M", "--parts", "2,8,32", title="Modelled"),
    "large": told("table.md", "scaling", "--seconds", 0.1, "--apart", "64k,100k,250k,1M", "--pair", "4M", "--parts", 2,
                  "--large", "1000M", title="Modelled on nodes"),
    "shapes": told("shapes.md", "benchmark", "--shapes", "--rounds", 5, "--seconds", 0.1),
    "plant": told("plant.md", "benchmark", "--scenes", "plant", "--rounds", 3),
    "faces": told("faces.md", "benchmark", "--faces", "--rounds", 3),
    "start_up": told("start_up.md", "benchmark", "--scenes", "start_up", "--ranks", 1, "--rounds", 3),
    "bases": told("bases.md", "benchmark", "--scenes", "bases", "--ranks", 2, "--rounds", 1),
    "memory": told("memory.md", "benchmark", "--scenes", "memory", "--ranks", 2, "--rounds", 1),
    "instructions": told("instructions.md", "benchmark", "--instructions", "cube,slab", "--rounds", 5),
    "ensembles": told("ensembles.md", "benchmark", "--ensembles", 16, "--ranks", 1, "--rounds", 3),
    "certificates": told("certificates.md", "tradeoff", "--scene", *sorted((SOURCE / "petsc-options" / "trade").glob("*.yaml")),
                         "--only", "modal-25", "--only", "modal-50", "--ranks", 1),
}


def version() -> str:
    """Of CMakeLists.txt, with the commit where Git knows one; a + says that files were changed after it."""
    number = re.search(r"project\(pounding VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    commit = subprocess.run(["git", "describe", "--always", "--abbrev=8", "--exclude=*", "--dirty=+"], cwd=SOURCE,
                            capture_output=True, text=True)
    return f"{number} ({commit.stdout.strip()})" if commit.returncode == 0 else number


def measured(name: str, folder: Path) -> str:
    """A table with its line. Throws MeasuringError or TableError."""
    folder.mkdir(parents=True, exist_ok=True)
    title, table = TABLE.search(TABLES[name](folder)).groups()
    machine = description()
    vectors = " with AVX-512" if "avx512f" in Path("/proc/cpuinfo").read_text() else ""
    line = (f"**{title}.** Measured on {machine['processor']}{vectors}, {machine['cores']} core"
            f"{'s' if machine['cores'] != 1 else ''}, {date.today()}, version {version()}; again by `run/tables {name}`")
    return f"{line}\n\n{table}"


def pages_of(docs: Path) -> dict:
    """Name of a table -> its page."""
    return {found[2]: page for page in sorted(docs.rglob("*.md"))
            for found in MARKED.finditer(page.read_text(encoding="utf-8"))}


def replaced(page: str, name: str, text: str) -> str:
    """A page whose table of that name is a new one."""
    return MARKED.sub(lambda found: f"{found[1]}{text}\n{found[4]}" if found[2] == name else found[0], page)
