"""Files of options: what is no YAML, and YAML that describes no scene."""
from corpus.case import Case, SCENE
from corpus.meshes import edited


def spoilt(name, words, *pairs):
    """The sound scene with one part after the other replaced."""
    return Case(name, [], words, {"scene.yaml": edited(SCENE, *pairs)})


def text(name, content, words, file="case.yaml"):
    return Case(name, ["-options_file", "{folder}/" + file], words, {file: content}, scene="")


NO_YAML = [
    spoilt("a bracket left open", ["{folder}/scene.yaml", "YAML"], ("mass: 50}", "mass: 50")),
    spoilt("a quote left open", ["{folder}/scene.yaml", "YAML"], ('"left:face"', '"left:face')),
    spoilt("a tab", ["{folder}/scene.yaml", "YAML"], ("  clamp: base", "\tclamp: base")),
    spoilt("an indentation that fits nothing", ["{folder}/scene.yaml", "YAML"],
           ("  body: {element", " body: {element")),
    spoilt("a key without a colon", ["{folder}/scene.yaml", "YAML"], ("end_time: 0.01", "end_time 0.01")),
    text("prose", "This is a letter, not a scene.\nIt has: two: colons.\n", ["{folder}/case.yaml", "YAML"]),
    text("bytes", bytes(range(256)), ["{folder}/case.yaml"]),
]

NO_SCENE = [
    Case("no such file", ["-options_file", "{folder}/none.yaml"], ["{folder}/none.yaml", "no such file"], scene=""),
    Case("a folder", ["-options_file", "{folder}"], ["{folder}", "file"], scene=""),
    Case("nothing at all", [], ["-structures"], scene=""),
    text("only a comment", "# nothing\n", ["{folder}/case.yaml", "no options"]),
    spoilt("an included file that is missing", ["{folder}/none.yaml", "no such file"],
           ("structures:", "include: {folder}/none.yaml\nstructures:")),
    spoilt("a file that includes itself", ["{folder}/scene.yaml", "read already"],
           ("structures:", "include: {folder}/scene.yaml\nstructures:")),
    spoilt("no structures", ["-structures", "missing"], ("structures: left,right\n", "")),
    spoilt("no mesh", ["-right_mesh", "missing"], ("  mesh: {folder}/right.msh\n", "")),
    spoilt("no element", ["-left_tie_element", "missing"], ("{element: bar, material", "{material")),
    spoilt("no area", ["-left_tie_area", "missing"], (", area: 1e-4", "")),
    spoilt("no mass", ["-left_machine_mass", "missing"], (", mass: 50", "")),
    spoilt("no material", ["-left_tie_material", "missing"], ("bar, material: steel,", "bar,")),
    spoilt("no Young's modulus", ["-material_steel_young", "missing"], ("young: 210e9, ", "")),
    spoilt("no density", ["-material_concrete_density", "missing"], (", density: 2400", "")),
    spoilt("no end", ["-end_time", "missing"], ("end_time: 0.01\n", "")),
    spoilt("no primary side", ["-joint_primary", "missing"], (', primary: "right:face"', "")),
    spoilt("no place of a probe", ["probe top", "-top_at", "-top_group"], (', at: "1.05,0,2"', "")),
    spoilt("a decimal comma", ["-end_time", "0,01"], ("end_time: 0.01", "end_time: 0,01")),
    spoilt("a value with its unit", ["-material_steel_young", "210 GPa"], ("young: 210e9", "young: 210 GPa")),
    spoilt("a key that is misspelt", ["-left_clmp", "-left_clamp"], ("clamp: base", "clmp: base")),
    spoilt("a block in the wrong place", ["-left_material_steel_young"],
           ("machine:", "material: {steel: {young: 1}}\n  machine:")),
    spoilt("a value left out", ["-end_time"], ("end_time: 0.01", "end_time:")),
]

TOO_MUCH = [
    spoilt("a key twice", ["{folder}/scene.yaml", "end_time is in line"],
           ("modes: 0\n", "modes: 0\nend_time: 2\n")),
    spoilt("a structure described twice", ["{folder}/scene.yaml", "right is in line"],
           ("material:\n", "right:\n  mesh: other.msh\nmaterial:\n")),
    spoilt("a second document", ["{folder}/scene.yaml", "second document"],
           ("modes: 0\n", "modes: 0\n---\nend_time: 2\n")),
    spoilt("a sequence within a sequence", ["{folder}/scene.yaml", "list"],
           ("structures: left,right", "structures: [[left], [right]]")),
    Case("a scene without -options_file", ["{folder}/scene.yaml"], ["did you mean -options_file"], scene=""),
    Case("-options_file without a file", ["-options_file"], ["-options_file needs a file"], scene=""),
    Case("an option without a dash", ["end_time=0.1"], ["end_time=0.1", "-end_time 0.1"]),
    Case("an option with an equal sign", ["-end_time=0.1"], ["-end_time=0.1", "with a blank"]),
    Case("a stray word", ["again"], ["'again' on the command line"]),
]

CASES = NO_YAML + NO_SCENE + TOO_MUCH
