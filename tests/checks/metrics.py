"""Computes the metrics of a skeleton table anew and compares them with those of `ramify stats --json`.

Usage: metrics.py TABLE.csv METRICS.json
"""

import csv
import json
import sys

import numpy
from scipy.integrate import simpson
from scipy.optimize import brentq
from scipy.spatial import ConvexHull
from scipy.stats import linregress


class Tree:
    """The internodes of a table, as arrays by row."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        column = lambda name, kind: numpy.array([kind(row[name]) for row in rows])
        points = lambda name: numpy.stack([column(name + axis, float) for axis in "XYZ"], axis=1)
        self.parent = column("parentID", int)
        self.start, self.end = points("start"), points("end")
        self.radius = column("radius", float)
        self.axis, self.order = column("branchID", int), column("branchOrder", int)
        self.along = self.end - self.start
        self.length = numpy.linalg.norm(self.along, axis=1)
        self.count = len(rows)
        self.children = [[] for _ in rows]
        self.root_children = []
        for i, parent in enumerate(self.parent):
            (self.children[parent] if parent >= 0 else self.root_children).append(i)
        self.tips = [i for i in range(self.count) if not self.children[i]]
        self.founds = [p < 0 or self.axis[p] != self.axis[i] for i, p in enumerate(self.parent)]
        self.base = self.start[0]

    def axes(self):
        """Rows of each axis, from its base to its tip."""
        found = {}
        for i in range(self.count):
            found.setdefault(self.axis[i], []).append(i)
        return found


def angle(u, v):
    return numpy.degrees(numpy.arccos(numpy.clip(u @ v / numpy.linalg.norm(u) / numpy.linalg.norm(v), -1, 1)))


def size(tree):
    ends = numpy.vstack([tree.end, [tree.base]])
    tips = tree.end[tree.tips]
    crown = tree.end[tree.order > 0]
    crossing = []
    start_radius = numpy.array([tree.radius[i] if tree.founds[i] else tree.radius[p] for i, p in enumerate(tree.parent)])
    low, high = tree.start[:, 1] - tree.base[1], tree.end[:, 1] - tree.base[1]
    for i in numpy.flatnonzero((low <= 1.3) & (high >= 1.3) & (low < high)):
        crossing.append(2 * numpy.interp(1.3, [low[i], high[i]], [start_radius[i], tree.radius[i]]))
    fine = numpy.linspace(0, 1, 101)  # the cones cut into discs
    moment, volume = numpy.zeros(3), 0.0
    for i in range(tree.count):
        area = numpy.pi * (start_radius[i] + (tree.radius[i] - start_radius[i]) * fine) ** 2
        own = simpson(area, x=fine) * tree.length[i]
        place = simpson(area * fine, x=fine) * tree.length[i]
        volume += own
        moment += own * (tree.start[i] - tree.base) + place * tree.along[i]
    height = numpy.ptp(ends[:, 1])
    flat = numpy.linalg.matrix_rank(tips - tips[0], tol=1e-6) < 3
    return {
        "height": height,
        "crown_radius": numpy.percentile(numpy.hypot(*(tips - tree.base)[:, [0, 2]].T), 95),
        "crown_height": numpy.ptp(crown[:, 1]),
        "crown_volume": None if flat else ConvexHull(tips).volume,
        "trunk_diameter": 2 * tree.radius[tree.root_children].max(),
        "dbh": max(crossing),
        "total_length": tree.length.sum(),
        "wood_volume": volume,
        "surface_area": (numpy.pi * (start_radius + tree.radius) * numpy.hypot(tree.length, start_radius - tree.radius)).sum(),
        "lean": numpy.hypot(moment[0], moment[2]) / volume / height,
        "internode_length_mean": tree.length.mean(),
    }


def streams(tree):
    strahler = [1] * tree.count
    for i in reversed(range(tree.count)):
        below = [strahler[c] for c in tree.children[i]]
        if below:
            strahler[i] = max(below) + (below.count(max(below)) > 1)
    head = list(range(tree.count))
    found = {}
    for i, parent in enumerate(tree.parent):
        if parent >= 0 and strahler[parent] == strahler[i]:
            head[i] = head[parent]
        found.setdefault(head[i], []).append(i)
    orders = range(1, max(strahler) + 1)
    of = [[rows for first, rows in found.items() if strahler[first] == order] for order in orders]
    slope = lambda values: linregress(list(orders), numpy.log(values)).slope
    return {
        "strahler_order": max(strahler),
        "bifurcation_ratio": numpy.exp(-slope([len(own) for own in of])),
        "length_ratio": numpy.exp(slope([numpy.mean([tree.length[rows].sum() for rows in own]) for own in of])),
        "diameter_ratio": numpy.exp(slope([numpy.mean([tree.radius[rows].mean() for rows in own]) for own in of])),
    }


def angles(tree):
    founders = [i for i in range(tree.count) if tree.founds[i] and tree.parent[i] >= 0]
    found = {i: angle(tree.along[i], tree.along[tree.parent[i]]) for i in founders}
    values = list(found.values())
    crooked = {}
    for rows in tree.axes().values():
        if len(rows) >= 3:
            chord = numpy.linalg.norm(tree.end[rows[-1]] - tree.start[rows[0]])
            crooked[rows[0]] = tree.length[rows].sum() / chord
    by_order = []
    for order in range(tree.order.max() + 1):
        own = [v for i, v in found.items() if tree.order[i] == order]
        bent = [v for i, v in crooked.items() if tree.order[i] == order]
        by_order.append({
            "order": order,
            "axes": sum(tree.order[rows[0]] == order for rows in tree.axes().values()),
            "length": tree.length[tree.order == order].sum(),
            "angle_mean": numpy.mean(own) if own else None,
            "angle_median": numpy.median(own) if own else None,
            "tortuosity_mean": numpy.mean(bent) if bent else None,
        })
    return {
        "branching_angle_mean": numpy.mean(values),
        "branching_angle_sd": numpy.std(values, ddof=1),
        "tortuosity_mean": numpy.mean(list(crooked.values())),
        "divergence_angle_mean": divergence(tree, found),
        "by_order": by_order,
    }


def divergence(tree, founders):
    """Between laterals' parts square to the bearer; a bend of the axis turns the earlier one along (Rodrigues)."""
    steps = []
    for rows in tree.axes().values():
        earlier = None
        for i, before in zip(rows, [None] + rows[:-1]):
            about = tree.along[i] / tree.length[i]
            if earlier is not None:
                last = tree.along[before] / tree.length[before]
                axis, cosine = numpy.cross(last, about), last @ about
                sine = numpy.linalg.norm(axis)
                if sine > 1e-12:
                    axis = axis / sine
                    earlier = (earlier * cosine + numpy.cross(axis, earlier) * sine + axis * (axis @ earlier) * (1 - cosine))
            for child in tree.children[i]:
                if child not in founders:
                    continue
                aside = tree.along[child] - about * (tree.along[child] @ about)
                if numpy.linalg.norm(aside) < 1e-9 * tree.length[child]:
                    continue
                if earlier is not None:
                    steps.append(angle(earlier, aside))
                earlier = aside
    return numpy.mean(steps) if steps else None


def paths(tree):
    lengths = numpy.zeros(tree.count)
    for i, parent in enumerate(tree.parent):
        lengths[i] = tree.length[i] + (lengths[parent] if parent >= 0 else 0)
    tips = lengths[tree.tips]
    return {"path_length_mean": tips.mean(), "path_length_max": tips.max(), "path_fraction": tips.mean() / tips.max()}


def forks(tree):
    tips = numpy.zeros(tree.count)
    tips[tree.tips] = 1
    for i in reversed(range(tree.count)):
        if tree.parent[i] >= 0:
            tips[tree.parent[i]] += tips[i]
    asymmetries, exponents = [], []
    for i, children in [(None, tree.root_children)] + list(enumerate(tree.children)):
        for a in range(len(children)):
            for b in range(a):
                one, two = tips[children[a]], tips[children[b]]
                if one + two > 2:
                    asymmetries.append(abs(one - two) / (one + two - 2))
        if i is None or len(children) < 2:
            continue
        widths = tree.radius[children] / tree.radius[i]
        excess = lambda n: (widths**n).sum() - 1
        if excess(20) <= 0:
            exponents.append(brentq(excess, 0, 20, xtol=1e-13))
    return {
        "asymmetry": numpy.mean(asymmetries) if asymmetries else None,
        "pipe_exponent": numpy.median(exponents) if exponents else None,
    }


def dimension(tree, height):
    """By points set close together along the internodes."""
    points = []
    for i in range(tree.count):
        parts = int(numpy.ceil(tree.length[i] / height * 128 * 25)) + 1
        points.append(tree.start[i] + numpy.linspace(0, 1, parts)[:, None] * tree.along[i])
    points = numpy.vstack(points)
    low, extent = points.min(axis=0), numpy.ptp(points, axis=0)
    counts = []
    for i in range(2, 8):
        edge = height / 2**i
        last = numpy.maximum(numpy.ceil(extent / edge) - 1, 0)
        counts.append(len(numpy.unique(numpy.minimum(numpy.floor((points - low) / edge), last), axis=0)))
    return {"fractal_dimension": linregress(numpy.arange(2, 8) * numpy.log(2), numpy.log(counts)).slope}


# Points miss some of the boxes between them; a small lean is a small difference of large sums.
TOLERANCES = {"fractal_dimension": 5e-3, "lean": 1e-6}


def differs(key, mine, theirs):
    if mine is None or theirs is None:
        return mine is not theirs
    return abs(mine - theirs) > TOLERANCES.get(key, 1e-7) * max(abs(mine), 1e-3)


def main(table, metrics_file):
    tree = Tree(table)
    with open(metrics_file) as file:
        theirs = json.load(file)
    mine = {"internodes": tree.count, "axes": len(tree.axes()), "max_order": int(tree.order.max())}
    mine.update(size(tree), **streams(tree), **angles(tree), **paths(tree), **forks(tree))
    mine.update(dimension(tree, mine["height"]))
    missed = [f"{key}: {mine[key]} here, {theirs[key]} there" for key in mine
              if key != "by_order" and differs(key, mine[key], theirs[key])]
    for own, other in zip(mine["by_order"], theirs["by_order"]):
        missed += [f"order {own['order']} {key}: {own[key]} here, {other[key]} there" for key in own
                   if differs(key, own[key], other[key])]
    for line in missed:
        print("  " + line)
    compared = len(mine) + 6 * len(mine["by_order"])
    print(f"  {compared} values compared, {len(missed)} differ")
    sys.exit(bool(missed) or len(mine["by_order"]) != len(theirs["by_order"]))


main(*sys.argv[1:])
