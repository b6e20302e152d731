"""A scene or a study to begin from: run/new two-buildings DIR

Copies its files into a folder, which may be there already; nothing that is there is written over. Without arguments it lists what there is.
"""

import os
import shlex
from pathlib import Path

from pounding.runs import next_steps

from . import command_line
from .process import called, parser_of

NAME = called("run/new")
SCENES = Path(__file__).parent / "scenes"


def known() -> dict:
    """Name -> first line of the scene's comment."""
    return {folder.name: (folder / f"{folder.name}.yaml").read_text().splitlines()[0].lstrip("# ")
            for folder in sorted(SCENES.iterdir()) if folder.is_dir()}


def write(name: str, folder: Path) -> list:
    """Copies the files of a scene and returns their paths: all of them or, where one is there already or the disk is
    full, none, with OSError. What is there is never written over."""
    contents = {path.name: path.read_bytes() for path in sorted((SCENES / name).iterdir())}
    for one in contents:
        if os.path.lexists(folder / one):
            raise FileExistsError(f"{folder / one} is there already; give another folder, or move it away")
    made, written = [], []
    try:
        for place in [folder, *folder.parents][::-1]:
            if not place.exists():
                place.mkdir()
                made.append(place)
        for one, content in contents.items():
            with open(folder / one, "xb") as file:
                written.append(folder / one)
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
    except BaseException as error:
        if isinstance(error, OSError) and written:
            error.filename = str(written[-1])
        for path in written:
            path.unlink()
        for place in made[::-1]:
            place.rmdir()
        raise
    return written


def main() -> int:
    scenes = known()
    parser = parser_of(__doc__)
    parser.add_argument("scene", nargs="?", choices=list(scenes), help="which one")
    parser.add_argument("folder", nargs="?", metavar="DIR", type=Path, help="where to")
    options = parser.parse_args()
    if not options.scene:
        print("\n".join(f"{NAME} {name} DIR    {what}" for name, what in scenes.items()))
        return 0
    if not options.folder:
        parser.error(f"say where to: {NAME} two-buildings DIR")
    files = write(options.scene, options.folder)
    print("wrote " + ", ".join(map(str, files)))
    first = options.folder / f"{options.scene}.yaml"
    if "\nscene:" in first.read_text():
        print("next: " + shlex.join([command_line("fragility"), str(first), "--dry-run"]))
    else:
        print(next_steps(first))
    return 0
