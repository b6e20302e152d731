"""Bricks whose nodes repeat: wedges and tetrahedra."""

# Pairs of places that coincide -> places of the wedge, so that its volume is above 0 where the brick's would be.
WEDGES = (((2, 3), (6, 7), (0, 1, 2, 4, 5, 6)), ((0, 1), (4, 5), (0, 2, 3, 4, 6, 7)), ((1, 2), (5, 6), (0, 1, 3, 4, 5,
                                                                                                        7)),
          ((0, 3), (4, 7), (0, 1, 2, 4, 5, 6)), ((4, 5), (6, 7), (0, 4, 1, 3, 6, 2)), ((4, 7), (5, 6), (0, 3, 4, 1, 2,
                                                                                                        5)))


def shape_of(nodes) -> tuple:
    """Kind and nodes of a brick as eight nodes give it: `brick`, `wedge6`, `tet4`; None for pyramids and others."""
    count = len(set(nodes))
    if count == 8:
        return "brick", tuple(nodes)
    if count == 6:
        for (a, b), (c, d), places in WEDGES:
            if nodes[a] == nodes[b] and nodes[c] == nodes[d]:
                return "wedge6", tuple(nodes[k] for k in places)
    if count == 4 and len(set(nodes[4:])) == 1 and nodes[2] == nodes[3]:
        return "tet4", (*nodes[:3], nodes[4])
    if count == 4 and len(set(nodes[3:])) == 1:
        return "tet4", tuple(nodes[:4])
    return None, tuple(nodes)
