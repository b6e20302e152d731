"""Meshes: files that are none, groups that are not there, elements that cannot be."""
from corpus import meshes
from corpus.case import Case, SCENE
from corpus.meshes import edited

LEFT = meshes.block(-1.0, face="right")


def spoilt(name, words, *pairs, arguments=()):
    """The left block's mesh with one part after the other replaced."""
    return Case(name, arguments, words, {"left.msh": edited(LEFT, *pairs)})


def geometry(name, text, words, *arguments):
    """A .geo file in the place of the left block's mesh."""
    return Case(name, ["-left_mesh", "{folder}/left.geo", *arguments], words, {"left.geo": text})


FILES = [
    Case("no such mesh", ["-left_mesh", "{folder}/none.msh"], ["{folder}/none.msh", "no such file"]),
    Case("no such geometry", ["-left_mesh", "{folder}/none.geo"], ["{folder}/none.geo", "no such file"]),
    Case("an empty mesh", [], ["{folder}/left.msh"], {"left.msh": ""}),
    Case("prose as a mesh", [], ["{folder}/left.msh"], {"left.msh": "This is no mesh.\n"}),
    Case("bytes as a mesh", [], ["{folder}/left.msh"], {"left.msh": bytes(range(256)) * 4}),
    Case("a record as a mesh", ["-left_mesh", "{folder}/record.csv"], ["{folder}/record.csv"]),
    Case("a mesh cut in its nodes", [], ["{folder}/left.msh"], {"left.msh": LEFT[:LEFT.index("$EndNodes") - 40]}),
    Case("a mesh cut in its elements", [], ["{folder}/left.msh"], {"left.msh": LEFT[:-40]}),
    Case("a mesh with parameters", ["-left_mesh_set", "h=1"], ["-left_mesh_set", ".geo"]),
    spoilt("a mesh of version 9", ["{folder}/left.msh"], ("2.2 0 8", "9.9 0 8")),
    geometry("a geometry with a mistake", "Point(1) = {0, 0, 0;\n", ["{folder}/left.geo"]),
    geometry("an empty geometry", "", ["{folder}/left.geo"]),
    geometry("a geometry without groups", 'Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nLine(1) = {1, 2};\n',
             ["body"]),
    geometry("a parameter that the geometry has not", "h = 1;\nPoint(1) = {0, 0, 0, h};\n",
             ["-left_mesh_set", "no parameter 'w'"], "-left_mesh_set", "w=2"),
    geometry("a parameter without a value", "h = 1;\nPoint(1) = {0, 0, 0, h};\n",
             ["-left_mesh_set", "name=value"], "-left_mesh_set", "h"),
    geometry("a parameter set twice", "h = 1;\nPoint(1) = {0, 0, 0, h};\n",
             ["-left_mesh_set", "h is set twice"], "-left_mesh_set", "h=1,h=2"),
]

GROUPS = [
    Case("a clamp that is no group", ["-left_clamp", "bottom"], ["-left_clamp", "bottom", "base"]),
    Case("a clamp in no component", ["-left_clamp", "base:w"], ["-left_clamp", "base:w", "x, y, z"]),
    Case("a clamp named twice", ["-left_clamp", "base,base"], ["-left_clamp", "twice"]),
    Case("a rigid group that is no group", ["-left_rigid", "bottom"], ["-left_rigid", "bottom", "base"]),
    Case("a rigid group with clamped nodes", ["-left_rigid", "body"], ["-left_rigid", "body", "is clamped"]),
    Case("a node in two rigid groups", ["-left_rigid", "face,body", "-left_clamp", "none", "-left_allow_loose", "true"],
         ["-left_rigid", "body", "face", "as well"]),
    Case("a rigid group that is a diaphragm", ["-left_rigid", "face", "-left_diaphragm", "face"],
         ["-left_diaphragm", "face"]),
    Case("a diaphragm that stands", ["-left_diaphragm", "body"], ["-left_diaphragm", "body", "not level"]),
    Case("a pin of nodes that are apart", ["-left_pin", "face"], ["-left_pin", "face", "lie on each other"]),
    Case("a join of one group", ["-left_join", "face"], ["-left_join", "face", "two groups"]),
    Case("a join with no group", ["-left_join", "face:roof"], ["-left_join", "roof"]),
    Case("a join of clamped nodes", ["-left_join", "face:base"], ["-left_join face:base", "is clamped"]),
    Case("rigid groups and matrices to write", ["-left_rigid", "face", "-export_matrices", "{folder}/matrices"],
         ["-export_matrices", "rigid group"]),
    Case("a region that is no group", ["-left_brick_element", "hex8", "-left_brick_material", "concrete"],
         ["brick", "which has", "body"]),
    Case("bricks as shells", ["-left_body_element", "shell", "-left_body_thickness", "0.1"],
         ["-left_body_element", "Hexahedron", "shell"]),
    Case("faces as bricks", ["-left_base_element", "hex8", "-left_base_material", "concrete"],
         ["-left_base_element", "hex8"]),
    Case("a line as a point mass", ["-options_file", "{folder}/mass.yaml"], ["-left_tie_element", "point_mass"],
         {"mass.yaml": edited(SCENE, ("{element: bar, material: steel, area: 1e-4}",
                                      "{element: point_mass, mass: 5}"))}, scene=""),
    Case("a probe on no group", ["-options_file", "{folder}/probe.yaml"], ["-top_group", "roof", "face"],
         {"probe.yaml": edited(SCENE, ('at: "1.05,0,2"', "group: roof"))}, scene=""),
    Case("all of it clamped", ["-left_clamp", "base,body"], ["left", "clamp"]),
    spoilt("a brick in two regions", ["left", "already belongs"], ('3 1 "body"', '3 1 "body"\n3 9 "core"'),
           ("$PhysicalNames\n5", "$PhysicalNames\n6"), ("$Elements\n6", "$Elements\n7"),
           ("\n2 5 2 1 1", "\n7 5 2 9 1 1 2 3 4 5 6 7 8\n2 5 2 1 1"),
           arguments=["-left_core_element", "hex8", "-left_core_material", "concrete"]),
]

ELEMENTS = [
    spoilt("a brick inside out", ["left", "element 1", "body"], ("1 2 3 4 5 6 7 8", "5 6 7 8 1 2 3 4")),
    spoilt("a brick with two nodes swapped", ["left", "element 1", "body"], ("1 2 3 4 5 6 7 8", "1 3 2 4 5 6 7 8")),
    spoilt("a brick without height", ["left", "element", "body"],
           *((f"\n{k} {'-1' if k in (5, 8) else '0'} {'0' if k < 7 else '1'} 1\n",
              f"\n{k} {'-1' if k in (5, 8) else '0'} {'0' if k < 7 else '1'} 0\n") for k in range(5, 9))),
    spoilt("a brick with a node twice", ["left", "element 1", "body"], ("1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7 7")),
    spoilt("a bar of no length", ["left", "element 5", "tie"], ("5 1 2 4 4 1 9", "5 1 2 4 4 1 1")),
    spoilt("a node that is not there", ["left"], ("1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7 99")),
    spoilt("a coordinate that is nan", ["left"], ("\n7 0 1 1", "\n7 nan 1 1")),
    spoilt("a coordinate of 1e300", ["left"], ("\n7 0 1 1", "\n7 1e300 1 1")),
    spoilt("a coordinate that is a word", ["{folder}/left.msh"], ("\n7 0 1 1", "\n7 here 1 1")),
    spoilt("tetrahedra", ["Tetrahedron", "body"], ("1 5 2 1 1 1 2 3 4 5 6 7 8", "1 4 2 1 1 1 2 4 5")),
    spoilt("a wedge inside out", ["left", "element 1", "body"],
           ("1 5 2 1 1 1 2 3 4 5 6 7 8", "1 6 2 1 1 1 4 2 5 8 6")),
    Case("bricks in a region of wedges", ["-left_body_element", "wedge6"], ["body", "wedge6"]),
    spoilt("bricks of 20 nodes", ["body"],
           ("1 5 2 1 1 1 2 3 4 5 6 7 8", "1 17 2 1 1 1 2 3 4 5 6 7 8 1 2 3 4 5 6 7 8 9 10 11 12")),
    Case("a beam along its z axis", ["-section_tube_z_axis", "0,0,1"], ["pole", "element 1"], scene="frame.yaml"),
    Case("a beam of no length", [], ["mast", "element 2", "pole"],
         {"mast.msh": edited(meshes.mast(), ("\n3 0 0 2\n", "\n3 0 0 1\n"))}, scene="frame.yaml"),
    Case("a shell crossed over", [], ["panel", "element 1", "plate"],
         {"panel.msh": edited(meshes.panel(), ("1 3 2 1 1 1 2 4 3", "1 3 2 1 1 1 2 3 4"))}, scene="frame.yaml"),
    Case("a shell with a node twice", [], ["panel", "element 1", "plate"],
         {"panel.msh": edited(meshes.panel(), ("1 3 2 1 1 1 2 4 3", "1 3 2 1 1 1 2 4 4"))}, scene="frame.yaml"),
]

CONTACTS = [
    Case("a face that is no group", ["-joint_primary", "right:front"], ["-joint_primary right:front", "face"]),
    Case("a face of lines", ["-joint_secondary", "left:tie"], ["-joint_secondary left:tie", "faces of solids"]),
    Case("a face of points", ["-joint_secondary", "left:machine"], ["-joint_secondary left:machine"]),
    Case("a face that is clamped", ["-joint_secondary", "left:base"], ["-joint_secondary left:base", "clamped"]),
    Case("a face that looks down", ["-joint_secondary", "left:base", "-left_clamp", "face"],
         ["joint", "face each other"]),
    Case("a face that is shifted away", [], ["joint", "overlap"],
         {"right.msh": meshes.block(0.05, face="left").replace(" 1 1\n", " 6 1\n").replace(" 1 2\n", " 6 2\n")
          .replace(" 1 0\n", " 6 0\n").replace(" 0 0\n", " 5 0\n").replace(" 0 1\n", " 5 1\n")
          .replace(" 0 2\n", " 5 2\n")}),
]

CASES = FILES + GROUPS + ELEMENTS + CONTACTS
