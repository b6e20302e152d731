"""What a broken input is, and the sound scene that each of them spoils in one place."""
import dataclasses
import os
from typing import Callable, Dict, List, Sequence, Tuple, Union

from corpus import meshes

Content = Union[str, bytes, Callable[[str, str], None]]


@dataclasses.dataclass(frozen=True)
class Case:
    """`words` must stand in the one line of the program; "{folder}" in arguments, in words and in the
    text of files is the folder of the case's own files, "{made}" that of the files a sound run made.
    A file is its text, its bytes, or a function of its path and of "{made}" that makes it."""
    name: str
    arguments: Sequence[str]
    words: Sequence[str]
    files: Dict[str, Content] = dataclasses.field(default_factory=dict)
    scene: str = "scene.yaml"   # of the sound scenes below; "" for none
    ranks: Tuple[int, ...] = (1, 2)


RECORD = "time [s], acceleration [g]\n" + "".join(
    f"{0.01 * i:.2f}, {value}\n" for i, value in enumerate((0, .1, .25, .1, -.15, -.3, -.1, .2, .1, 0)))

SCENE = """# Two blocks of concrete 50 mm apart; one carries a machine and is braced.
structures: left,right
left:
  mesh: {folder}/left.msh
  clamp: base
  damping: {alpha: 0.2, beta: 1e-6}
  body: {element: hex8, material: concrete}
  tie: {element: bar, material: steel, area: 1e-4}
  machine: {element: point_mass, mass: 50}
right:
  mesh: {folder}/right.msh
  clamp: base
  body: {element: hex8, material: concrete}
material:
  concrete: {young: 30e9, poisson: 0.2, density: 2400}
  steel: {young: 210e9, poisson: 0.3, density: 7850}
contacts: joint
joint: {secondary: "left:face", primary: "right:face"}
motion:
  x: {record: {folder}/record.csv}
probes: top
top: {structure: right, at: "1.05,0,2"}
modes: 0
output_interval: 2.5e-4
end_time: 0.01
"""

FRAME = """# A cantilever of steel beams with a spring to the ground at its tip, beside a panel of shells.
structures: mast,panel
mast:
  mesh: {folder}/mast.msh
  clamp: foot
  pole: {element: beam, material: steel, section: tube}
  tip: {element: grounded_spring, stiffness: "1e4,1e4,0"}
panel:
  mesh: {folder}/panel.msh
  clamp: foot
  plate: {element: shell, material: steel, thickness: 0.02}
material:
  steel: {young: 210e9, poisson: 0.3, density: 7850}
section:
  tube: {area: 5e-3, inertia_y: 2e-5, inertia_z: 2e-5, torsion: 4e-5, z_axis: "1,0,0"}
motion:
  x: {record: {folder}/record.csv}
probes: head
head: {structure: mast, at: "0,0,3"}
modes: 0
end_time: 0.002
"""


def write(path, content, folder, made):
    """Makes one file of a case."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if callable(content):
        content(path, made)
        return
    if isinstance(content, str):
        content = filled(content, folder, made).encode()
    with open(path, "wb") as file:
        file.write(content)


def filled(text, folder, made):
    return text.replace("{folder}", folder).replace("{made}", made)


def prepare(case, folder, made):
    """Writes the files of a case into its folder and returns the words after the program's name."""
    sound = {"scene.yaml": SCENE, "frame.yaml": FRAME, "record.csv": RECORD,
             "left.msh": meshes.block(-1.0, face="right"), "right.msh": meshes.block(0.05, face="left"),
             "mast.msh": meshes.mast(), "panel.msh": meshes.panel()}
    for name, content in {**sound, **case.files}.items():
        write(os.path.join(folder, name), content, folder, made)
    words: List[str] = ["-options_file", os.path.join(folder, case.scene)] if case.scene else []
    return words + [filled(str(word), folder, made) for word in case.arguments]
