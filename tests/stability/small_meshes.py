"""Meshes of a few elements made in Python, so that they can be moved, turned, mirrored and renumbered.

A mesh is its nodes [m], shape (n, 3), and its physical groups: name -> (kind of element, rows of
node indices from 0). It is written as a Gmsh file of version 2.2 with all digits.
"""
import numpy

GMSH = {"point": (15, 0), "line": (1, 1), "quadrangle": (3, 2), "hexahedron": (5, 3)}  # type, dimension


class Mesh:
    def __init__(self, nodes, groups):
        self.nodes = numpy.array(nodes, dtype=float)
        self.groups = {name: (kind, [list(row) for row in rows]) for name, (kind, rows) in groups.items()}

    def placed(self, place):
        """The same mesh with other nodes: place(nodes)."""
        return Mesh(place(self.nodes), self.groups)

    def mirrored(self):
        """x -> -x; hexahedra are read from their other face, so that their volume stays positive."""
        groups = {name: (kind, [row[4:] + row[:4] if kind == "hexahedron" else row for row in rows])
                  for name, (kind, rows) in self.groups.items()}
        return Mesh(self.nodes * (-1, 1, 1), groups)

    def write(self, path, seed=None):
        """Writes the file; a seed shuffles the tags of the nodes and the order of everything."""
        count = len(self.nodes)
        elements = [(name, kind, row) for name, (kind, rows) in self.groups.items() for row in rows]
        tags, order = numpy.arange(1, count + 1), numpy.arange(len(elements))
        if seed is not None:
            random = numpy.random.default_rng(seed)
            tags, order = 1 + random.permutation(3 * count)[:count], random.permutation(order)
        names = list(self.groups)
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
        lines += [f'{GMSH[self.groups[name][0]][1]} {i} "{name}"' for i, name in enumerate(names, 1)]
        lines += ["$EndPhysicalNames", "$Nodes", str(count)]
        lines += [f"{tag} " + " ".join(repr(float(x)) for x in node) for tag, node in zip(tags, self.nodes)]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        for tag, number in enumerate(order, 1):
            name, kind, row = elements[number]
            group = 1 + names.index(name)
            lines.append(f"{tag} {GMSH[kind][0]} 2 {group} {group} " + " ".join(str(tags[i]) for i in row))
        with open(path, "w") as file:
            file.write("\n".join(lines + ["$EndElements", ""]))
        return path


def brick(low, high, cells):
    """Hexahedra between two corners; groups body, x_min, x_max, y_min, y_max, z_min, z_max."""
    nx, ny, nz = cells
    axes = [numpy.linspace(low[d], high[d], cells[d] + 1) for d in range(3)]
    nodes = [(x, y, z) for z in axes[2] for y in axes[1] for x in axes[0]]

    def at(i, j, k):
        return (k * (ny + 1) + j) * (nx + 1) + i

    def layer(i, j, k):
        return [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)]

    body = [layer(i, j, k) + layer(i, j, k + 1) for k in range(nz) for j in range(ny) for i in range(nx)]
    groups = {"body": ("hexahedron", body)}
    for name, i in (("x_min", 0), ("x_max", nx)):
        groups[name] = ("quadrangle", [[at(i, j, k), at(i, j + 1, k), at(i, j + 1, k + 1), at(i, j, k + 1)]
                                       for k in range(nz) for j in range(ny)])
    for name, j in (("y_min", 0), ("y_max", ny)):
        groups[name] = ("quadrangle", [[at(i, j, k), at(i + 1, j, k), at(i + 1, j, k + 1), at(i, j, k + 1)]
                                       for k in range(nz) for i in range(nx)])
    for name, k in (("z_min", 0), ("z_max", nz)):
        groups[name] = ("quadrangle", [layer(i, j, k) for j in range(ny) for i in range(nx)])
    return Mesh(nodes, groups)


def house(left, width, storey, face):
    """One storey: a slab of hexahedra on four columns of two beams, two braces, a parapet of shells.

    `left`, `width` along x [m]; 2 m along y; slab of 0.25 m at z = `storey`. `face` (x_min or x_max)
    becomes the group face; the parapet stands on the other side. Groups: slab, column, brace,
    parapet, mass and base (points), face.
    """
    slab = brick((left, 0, storey), (left + width, 2, storey + 0.25), (3, 2, 1))
    nodes = slab.nodes.tolist()

    def find(x, y, z):
        """The node there, made if there is none."""
        for i, node in enumerate(nodes):
            if max(abs(node[0] - x), abs(node[1] - y), abs(node[2] - z)) < 1e-9:
                return i
        nodes.append([x, y, z])
        return len(nodes) - 1

    right, top = left + width, storey + 0.25
    corners = [(left, 0), (right, 0), (right, 2), (left, 2)]
    columns = [[find(x, y, z), find(x, y, z + storey / 2)] for x, y in corners for z in (0, storey / 2)]
    braces = [[find(x, y, 0), find(right + left - x, y, storey)] for x, y in (corners[0], corners[3])]
    edge = right if face == "x_min" else left
    parapet = [[find(edge, y, top), find(edge, y + 1, top), find(edge, y + 1, top + 0.5), find(edge, y, top + 0.5)]
               for y in (0, 1)]
    groups = {"slab": slab.groups["body"], "column": ("line", columns), "brace": ("line", braces),
              "parapet": ("quadrangle", parapet), "mass": ("point", [[find(edge, 1, top + 0.5)]]),
              "base": ("point", [[find(x, y, 0)] for x, y in corners]), "face": slab.groups[face]}
    return Mesh(nodes, groups)
