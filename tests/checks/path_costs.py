"""Compares a planned tree's paths with scipy's least costs on its graph, and the graph with the Yao rule.

Usage: path_costs.py FOLDER NODES SECTORS, with graph.csv, graph.nodes.csv and tree.csv in the folder; 0 sectors: no Yao graph.
"""

import csv
import sys

import numpy
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

# Of larger graphs the Yao rule is tried at about so many nodes and half as many edges.
TRIED = 1000


def table(name):
    with open(name, newline="") as file:
        return list(csv.DictReader(file))


def least_costs(edges, count, is_directed):
    rows, columns, costs = edges
    matrix = csr_matrix((costs, (rows.astype(int), columns.astype(int))), shape=(count, count))
    return dijkstra(matrix, directed=is_directed, indices=0)


def tree_costs(tree, nodes, edges, is_directed):
    """Of every node of the tree: the sum of the weights on its way from the root."""
    number = {tuple(node): i for i, node in enumerate(nodes)}
    weight = {}
    for u, v, w in zip(*edges):
        weight[int(u), int(v)] = w
        if not is_directed:
            weight[int(v), int(u)] = w
    cost = {0: 0.0}
    for row in tree:
        start, end = (number[tuple(float(row[which + axis]) for axis in "XYZ")] for which in ("start", "end"))
        assert end not in cost, "a node has two parents"
        cost[end] = cost[start] + weight[start, end]
    return cost


def sectors_of(difference, sectors):
    """The nearest by angle of a cube's corners, its faces or both."""
    corners = [(x, y, z) for z in (1, -1) for y in (1, -1) for x in (1, -1)]
    faces = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    directions = {6: faces, 8: corners, 14: faces + corners}[sectors]
    best = numpy.full(len(difference), -numpy.inf)
    sector = numpy.zeros(len(difference), dtype=int)
    for i, direction in enumerate(directions):
        cosine = difference @ (numpy.array(direction) / numpy.linalg.norm(direction))
        sector[cosine > best] = i
        best = numpy.maximum(best, cosine)
    return sector


def chosen_by(node, nodes, sectors):
    """The nearest node in each sector."""
    difference = nodes - nodes[node]
    square = (difference**2).sum(axis=1)
    square[node] = numpy.inf
    sector = sectors_of(difference, sectors)
    least = numpy.full(sectors, numpy.inf)
    numpy.minimum.at(least, sector, square)
    return set(numpy.flatnonzero((square == least[sector]) & numpy.isfinite(square)))


def yao_errors(nodes, edges, sectors):
    """How many edges are missing, and how many neither end has chosen."""
    joined = {(min(u, v), max(u, v)) for u, v in zip(edges[0].astype(int), edges[1].astype(int))}
    ends = sorted(joined)
    tried = range(len(nodes))
    if len(nodes) > TRIED:
        ends = ends[:: len(ends) // (TRIED // 2)]
        tried = set(range(0, len(nodes), len(nodes) // TRIED)).union(*ends)
    chosen = {node: chosen_by(node, nodes, sectors) for node in tried}
    missing = sum((min(u, v), max(u, v)) not in joined for u in chosen for v in chosen[u])
    unwanted = sum(v not in chosen[u] and u not in chosen[v] for u, v in ends)
    return missing, unwanted


def main(folder, count, sectors):
    count, sectors = int(count), int(sectors)
    nodes = numpy.array([[float(row[axis]) for axis in "xyz"] for row in table(f"{folder}/graph.nodes.csv")])
    edges = numpy.array([[float(row[key]) for key in ("u", "v", "weight")] for row in table(f"{folder}/graph.csv")]).T
    pairs = set(zip(edges[0], edges[1]))
    is_directed = (edges[1][0], edges[0][0]) in pairs  # guiding vectors: a row each way

    least = least_costs(edges, count, is_directed)
    found = tree_costs(table(f"{folder}/tree.csv"), nodes, edges, is_directed)
    reached = numpy.array([node for node in found if node != 0])
    off = abs(numpy.array([found[node] for node in reached]) / least[reached] - 1)
    is_least = bool((off <= 1e-5).all())
    print(f"{len(found)} in the tree, costs differ by {off.max():.1e}", end="")

    missing, unwanted = yao_errors(nodes, edges, sectors) if sectors else (0, 0)
    print(f", {missing} edges missing, {unwanted} unwanted" if sectors else "")
    is_sound = len(nodes) == count and len(found) > count // 10 and is_least and missing == 0 and unwanted == 0
    sys.exit(not is_sound)


main(*sys.argv[1:])
