"""Write the models of the scenarios as parts, one for each process.

    python3 prepare.py FOLDER

A model in a distribution over N processes is FOLDER/MODEL-DISTRIBUTION-N.pvtp. Process i of N
reads part i; one process alone reads all parts, appended. Parts have no point normals, as receivers
of several processes are on their triangles.
"""

import pathlib
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

COUNTS = (2, 3, 4)


class Mesh:
    """Points of shape (n, 3), and cells of shape (m, 3) or (m, 4)."""

    def __init__(self, points, cells):
        self.points = np.asarray(points, np.float32)
        self.cells = np.asarray(cells, np.int64)

    def __add__(self, other):
        return Mesh(
            np.concatenate([self.points, other.points]),
            np.concatenate([self.cells, other.cells + len(self.points)]),
        )


def grid(columns, rows, height=lambda x, y: 0.0 * x, corners=4):
    """Return a height field over [-1, 1] in x and y."""
    x, y = np.meshgrid(np.linspace(-1, 1, columns + 1), np.linspace(-1, 1, rows + 1))
    points = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1)
    quads = np.stack([first, first + 1, first + columns + 2, first + columns + 1], axis=-1)
    if corners == 4:
        return Mesh(points, quads)
    return Mesh(points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def box(lower, upper):
    """Return the quads of a box."""
    x, y, z = np.stack([lower, upper])[:, :].T
    points = [(x[i], y[j], z[k]) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return Mesh(points, quads)


def bunny():
    """Return the bunny of the package glmark2-data on a floor; z is up."""
    points, triangles = [], []
    with open("/usr/share/glmark2/models/bunny.obj", encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append([float(word) for word in words[1:4]])
            elif words and words[0] == "f":
                corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
                triangles += [[corners[0], a, b] for a, b in zip(corners[1:], corners[2:])]
    points = np.asarray(points)[:, [0, 2, 1]] * (1, -1, 1)
    points -= (points.min(axis=0) + points.max(axis=0)) / 2
    points *= 0.6 / np.abs(points).max()
    points[:, 2] -= points[:, 2].min()
    return Mesh(points, triangles) + grid(20, 20, corners=3)


def atrium():
    """Return a floor with two storeys of columns and beams, and lattices between them."""
    mesh = grid(16, 16)
    for x in np.linspace(-0.8, 0.8, 5):
        for y in np.linspace(-0.8, 0.8, 5):
            if abs(x) > 0.5 or abs(y) > 0.5:
                for floor in (0.0, 0.3):
                    side = 0.04 if floor == 0 else 0.025
                    mesh += box((x - side, y - side, floor), (x + side, y + side, floor + 0.26))
    for floor in (0.26, 0.56):
        for at in (-0.8, -0.4, 0.4, 0.8):
            for start in np.linspace(-0.9, 0.65, 8):
                mesh += box((start, at - 0.05, floor), (start + 0.2, at + 0.05, floor + 0.04))
                mesh += box((at - 0.05, start, floor), (at + 0.05, start + 0.2, floor + 0.04))
    for i, x in enumerate(np.linspace(-0.38, 0.38, 20)):
        mesh += box((x, -0.4, 0.5 + 0.002 * i), (x + 0.01, 0.4, 0.51 + 0.002 * i))
    return mesh


def terrain():
    """Return hills of a square kilometre, far from the origin."""
    waves = np.random.default_rng(3).uniform(-1, 1, (24, 3))

    def height(x, y):
        terms = [
            np.sin(2.0 * (1 + i) * (a * x + b * y) + 9 * c) / (3 + i)
            for i, (a, b, c) in enumerate(waves)
        ]
        return 0.1 * sum(terms)

    mesh = grid(90, 90, height, corners=3)
    post = box((-0.01, -0.01, -0.2), (0.01, 0.01, 0.15))
    post.cells = np.concatenate([post.cells[:, [0, 1, 2]], post.cells[:, [0, 2, 3]]])
    for x, y in waves[:, :2] * 0.9:
        mesh += Mesh(post.points + (x, y, height(x, y)), post.cells)
    return Mesh(mesh.points * 500 + (3000, -2000, 100), mesh.cells)


def panel(mesh):
    """Return a lattice above a model."""
    lower, upper = mesh.points.min(axis=0), mesh.points.max(axis=0)
    size = (upper - lower).max() / 2
    slats = grid(1, 1)
    slats = Mesh(slats.points * (1, 0.05, 1), slats.cells)
    lattice = Mesh(slats.points + (0, -0.8, 0), slats.cells)
    for y in (-0.4, 0.0, 0.4, 0.8):
        lattice += Mesh(slats.points + (0, y, 0), slats.cells)
    if mesh.cells.shape[1] == 3:
        quads = lattice.cells
        lattice = Mesh(lattice.points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))
    middle = (lower + upper) / 2 * (1, 1, 0)
    return Mesh(lattice.points * size + middle + (0, 0, upper[2] + 0.8 * size), lattice.cells)


MODELS = {"bunny": bunny, "atrium": atrium, "terrain": terrain}


def block(cells, count):
    return np.arange(cells) * count // max(cells, 1)


def by_chance(cells, count):
    return np.random.default_rng(11).integers(0, count, cells)


def in_parts(mesh, distribution, count):
    """Return (mesh, cells, ghosts) of each process."""
    cells = len(mesh.cells)
    if distribution == "out-of-view":
        whole = mesh + panel(mesh)
        owners = np.append(block(cells, count - 1), np.full(len(whole.cells) - cells, count - 1))
        return [(whole, np.flatnonzero(owners == rank), 0) for rank in range(count)]
    owners = {
        "block": lambda: block(cells, count),
        "round-robin": lambda: np.arange(cells) % count,
        "random": lambda: by_chance(cells, count),
        "ghosts": lambda: block(cells, count),
        "doubles": lambda: block(cells, count),
        "empty": lambda: np.delete(np.arange(count), 1)[block(cells, count - 1)],
    }[distribution]()
    parts = []
    for rank in range(count):
        own = np.flatnonzero(owners == rank)
        ghosts = np.empty(0, np.int64)
        if distribution in ("ghosts", "doubles"):  # of the next process
            ghosts = np.flatnonzero(owners == (rank + 1) % count)[: cells // 10]
        flagged = len(ghosts) if distribution == "ghosts" else 0
        parts.append((mesh, np.append(own, ghosts), flagged))
    return parts


DISTRIBUTIONS = ("block", "round-robin", "random", "ghosts", "doubles", "empty", "out-of-view")


def polydata(mesh, cells, ghosts, has_ghosts):
    """Return the cells of a mesh; the last ones are ghosts."""
    used, corners = np.unique(mesh.cells[cells].reshape(-1), return_inverse=True)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(mesh.points[used], deep=True))
    side = mesh.cells.shape[1]
    array = vtkCellArray()
    array.SetData(side, numpy_to_vtkIdTypeArray(corners.astype(np.int64), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(array)
    if has_ghosts:
        flags = np.zeros(len(cells), np.uint8)
        flags[len(cells) - ghosts :] = vtkDataSetAttributes.DUPLICATECELL
        flags = numpy_to_vtk(flags, deep=True)
        flags.SetName(vtkDataSetAttributes.GhostArrayName())
        data.GetCellData().AddArray(flags)
    return data


def write(folder, name, parts):
    """Write FOLDER/NAME.pvtp. This ParaView reads appended data as empty, so data are binary."""
    has_ghosts = any(ghosts for _, _, ghosts in parts)
    pieces = ""
    for rank, (mesh, cells, ghosts) in enumerate(parts):
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(folder / f"{name}-{rank}.vtp"))
        writer.SetInputData(polydata(mesh, cells, ghosts, has_ghosts))
        writer.SetDataModeToBinary()
        writer.Write()
        pieces += f'<Piece Source="{name}-{rank}.vtp"/>\n'
    flags = '<PDataArray type="UInt8" Name="vtkGhostType"/>' if has_ghosts else ""
    (folder / f"{name}.pvtp").write_text(
        '<VTKFile type="PPolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">\n'
        '<PPolyData GhostLevel="0">\n'
        f"<PCellData>{flags}</PCellData>\n"
        '<PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>\n'
        f"{pieces}</PPolyData></VTKFile>\n",
        encoding="ascii",
    )


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for model, make in MODELS.items():
        mesh = make()
        for count in COUNTS:
            for distribution in DISTRIBUTIONS:
                parts = in_parts(mesh, distribution, count)
                write(folder, f"{model}-{distribution}-{count}", parts)
        print(f"{model}: {len(mesh.cells)} cells")


if __name__ == "__main__":
    main()
