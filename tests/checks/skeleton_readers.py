"""Compares SWC, MTG and SimpleForest files of one tree with its skeleton table.

Usage: skeleton_readers.py TREE.csv TREE.swc TREE.mtg QSM.csv
Each is parsed here by its grammar and becomes a list of internodes: start, end, radius, order. The lists must be
equal; SimpleForest's radii are those of cylinders, so there only the places, lengths and volumes are compared.
"""

import csv
import re
import sys

import numpy as np


def table(path):
    with open(path, newline="") as file:
        rows = [[cell.strip() for cell in row] for row in csv.reader(file)]
    return rows[0], rows[1:]


def columns(path, names):
    header, rows = table(path)
    places = [header.index(name) for name in names]
    return np.array([[float(row[place]) for place in places] for row in rows])


ENDS = ["startX", "startY", "startZ", "endX", "endY", "endZ", "radius", "branchOrder"]


def read_swc(path):
    """Internodes of samples; types above 15 are orders."""
    samples = {}
    with open(path) as file:
        for line in file:
            if line.startswith("#"):
                continue
            number, kind, x, y, z, radius, parent = line.split()
            if int(parent) != -1 and int(parent) not in samples:
                sys.exit(f"{path}: {number} stands before its parent {parent}")
            if int(number) != len(samples) + 1:
                sys.exit(f"{path}: {number} is out of sequence")
            samples[int(number)] = (np.array([float(x), float(y), float(z)]), float(radius), int(kind), int(parent))
    return np.array([
        [*samples[parent][0], *place, radius, kind - 16]
        for place, radius, kind, parent in samples.values()
        if parent != -1
    ])


def mtg_rows(path):
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file]
    at = lines.index("MTG:") + 1
    header = lines[at].split("\t")
    features = header.index("Length")
    if header[0] != "ENTITY-CODE" or any(header[1:features]):
        sys.exit(f"{path}: a header of another form")
    for line in lines[at + 1:]:
        cells = line.split("\t")
        column = next(i for i in range(features) if cells[i])
        if any(re.search(r"[eE+</\[\],=()]", cell) for cell in cells[features:]):
            sys.exit(f"{path}: a value that the grammar forbids: {line}")
        yield column, cells[column], dict(zip(header[features:], map(float, cells[features:])))


def read_mtg(path):
    """Internodes in axes of the table (+Y up): the first entity of a plant is its root node, of length 0."""
    internodes = []
    last = {}  # column -> (place, axis' rank)
    for column, code, values in mtg_rows(path):
        top = np.array([values["XX"], values["ZZ"], 0.0 - values["YY"]])
        if re.fullmatch(r"/P\d+/A\d+/I1", code) and column == 0:
            if values["Length"] != 0:
                sys.exit(f"{path}: a plant that begins with length {values['Length']}")
            last = {0: (top, 1)}
            continue
        if re.fullmatch(r"\^<I\d+", code):
            before, rank = last[column]
        elif re.fullmatch(r"\+A\d+/I1", code):
            before, rank = last[column - 1][0], 0
        else:
            sys.exit(f"{path}: code {code}")
        if int(code.rsplit("I", 1)[1]) != rank + 1:
            sys.exit(f"{path}: {code} after rank {rank}")
        if abs(np.linalg.norm(top - before) - values["Length"]) > 1e-12 * (1 + abs(top).max()):
            sys.exit(f"{path}: {code} is not {values['Length']} long")
        internodes.append([*before, *top, values["TopDiameter"] / 2, column])
        last = {c: entry for c, entry in last.items() if c < column}
        last[column] = (top, rank + 1)
    return np.array(internodes)


def sorted_rows(rows):
    return rows[np.lexsort(rows.T)]


def cylinder_sums(path):
    """Count, height, length, volume of a QSM table as it says itself."""
    rows = columns(path, ["startZ", "endZ", "radius", "length"])
    heights = rows[:, :2]
    volume = np.sum(np.pi * rows[:, 2] ** 2 * rows[:, 3])
    return len(rows), np.max(heights) - np.min(heights), np.sum(rows[:, 3]), volume


def cone_sums(path):
    """The same of a skeleton table's truncated cones; a founding internode starts with its own radius."""
    rows = columns(path, ["ID", "parentID", "branchID"] + ENDS)
    ids = {int(row[0]): i for i, row in enumerate(rows)}
    length = np.linalg.norm(rows[:, 6:9] - rows[:, 3:6], axis=1)
    end = rows[:, 9]
    parent = np.array([ids.get(int(p), -1) for p in rows[:, 1]])
    goes_on = (parent >= 0) & (rows[parent, 2] == rows[:, 2])
    start = np.where(goes_on, end[parent], end)
    volume = np.sum(np.pi / 3 * (start**2 + start * end + end**2) * length)
    heights = np.concatenate([rows[:, 4], rows[:, 7]])
    return len(rows), np.max(heights) - np.min(heights), np.sum(length), volume


def main():
    tree, swc, mtg, qsm = sys.argv[1:]
    expected = sorted_rows(columns(tree, ENDS))
    for path, rows in ((swc, read_swc(swc)), (mtg, read_mtg(mtg))):
        if not np.array_equal(sorted_rows(rows), expected):
            sys.exit(f"{path}: not the tree of {tree}")
    count, height, length, volume = cylinder_sums(qsm)
    cones = cone_sums(tree)
    print(f"{count} internodes, {height:.3g} m high, {length:.4g} m of wood, {volume:.4g} m3 as cylinders, {cones[3]:.4g} m3 as cones")
    if count != cones[0] or abs(height - cones[1]) > 1e-9 or abs(length - cones[2]) > 1e-4 * length:
        sys.exit(f"{qsm}: not as high or long as {tree}")
    # A root's width, which a trunk's first cone starts with, stands in no row; cylinders read are wide from end to end.
    if abs(volume - cones[3]) > 0.05 * volume:
        sys.exit(f"{qsm}: another volume than {tree}")


main()
