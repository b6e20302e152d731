"""Small meshes in Gmsh's text format, and ways to spoil them."""


def document(nodes, elements, names):
    """`nodes`: tag to (x, y, z); `elements`: (tag, Gmsh type, physical tag, nodes); `names`: physical
    tag to (dimension, name)."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dimension} {tag} "{name}"' for tag, (dimension, name) in names.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{tag} {x:.10g} {y:.10g} {z:.10g}" for tag, (x, y, z) in nodes.items()]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [" ".join(map(str, (tag, kind, 2, group, group, *of))) for tag, kind, group, of in elements]
    return "\n".join(lines + ["$EndElements", ""])


def block(x, face):
    """Two bricks of 1 m on one another from x; groups body, base, face (the upper brick's, at its right
    or left), tie (a line) and machine (a point). Nodes 1 to 12 in layers of four, counter-clockwise from
    the smallest x and y."""
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    nodes = {4 * layer + k + 1: (x + a, b, layer) for layer in range(3) for k, (a, b) in enumerate(corners)}
    side = (6, 7, 11, 10) if face == "right" else (5, 9, 12, 8)
    elements = [(1, 5, 1, (1, 2, 3, 4, 5, 6, 7, 8)), (2, 5, 1, (5, 6, 7, 8, 9, 10, 11, 12)),
                (3, 3, 2, (1, 2, 3, 4)), (4, 3, 3, side)]
    names = {1: (3, "body"), 2: (2, "base"), 3: (2, "face")}
    if face == "right":
        elements += [(5, 1, 4, (1, 9)), (6, 15, 5, (11,))]
        names.update({4: (1, "tie"), 5: (0, "machine")})
    return document(nodes, elements, names)


def mast():
    """Three line elements of 1 m up from the origin; groups pole, foot, tip. Nodes 1 to 4 from below."""
    nodes = {k + 1: (0, 0, k) for k in range(4)}
    elements = [(k + 1, 1, 1, (k + 1, k + 2)) for k in range(3)] + [(4, 15, 2, (1,)), (5, 15, 3, (4,))]
    return document(nodes, elements, {1: (1, "pole"), 2: (0, "foot"), 3: (0, "tip")})


def panel():
    """Two quadrangles of 1 m on one another in the plane x = 5; groups plate and foot."""
    nodes = {2 * layer + k + 1: (5, k, layer) for layer in range(3) for k in range(2)}
    elements = [(1, 3, 1, (1, 2, 4, 3)), (2, 3, 1, (3, 4, 6, 5)), (3, 1, 2, (1, 2))]
    return document(nodes, elements, {1: (2, "plate"), 2: (1, "foot")})


def edited(text, *pairs):
    """A text with one part after the other replaced; each must be there."""
    for before, after in pairs:
        if before not in text:
            raise ValueError(f"{before!r} is not in the text")
        text = text.replace(before, after, 1)
    return text
