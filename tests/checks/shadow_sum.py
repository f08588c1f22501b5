"""Compares a shadow grid with the sum over the metamers of a skeleton table.

Usage: shadow_sum.py TABLE.csv GRID.vdb VOXEL A B Q_MAX SUN_X SUN_Y SUN_Z
"""

import csv
import sys

import numpy

try:
    import pyopenvdb as openvdb
except ImportError:
    import openvdb


def rounded(x):
    """To the nearest whole number, halves away from 0."""
    return int(numpy.sign(x) * numpy.floor(abs(x) + 0.5))


def summed(voxels, a, b, q_max, sun, low, shape):
    """The field in units of 2^-16, by its definition: P09 4.1 with the sun aside."""
    field = numpy.zeros(shape, dtype=numpy.int64)
    for q in range(q_max + 1):
        amount = rounded(a * b**-q * 65536)
        shift = (rounded(-q * sun[0] / sun[1]), -q, rounded(-q * sun[2] / sun[1]))
        for i in range(-q, q + 1):
            for k in range(-q, q + 1):
                at = voxels + numpy.array(shift) + (i, 0, k) - low
                numpy.add.at(field, tuple(at.T), amount)
    return field


def main(table, grid_file, voxel, a, b, q_max, *sun):
    voxel, a, b, q_max = float(voxel), float(a), float(b), int(q_max)
    sun = [float(x) for x in sun]
    with open(table, newline="") as file:
        ends = [[float(row["end" + axis]) for axis in "XYZ"] for row in csv.DictReader(file)]
    voxels = numpy.floor(numpy.array(ends) / voxel + 0.5).astype(int)

    margin = 4 * q_max + 2
    low = voxels.min(axis=0) - margin
    shape = voxels.max(axis=0) + margin + 1 - low
    expected = (summed(voxels, a, b, q_max, sun, low, shape) / 65536).astype(numpy.float32)

    grid = openvdb.read(grid_file, "shadow")
    found = numpy.zeros(shape, dtype=numpy.float32)
    grid.copyToArray(found, ijk=tuple(int(x) for x in low))
    different = int(numpy.count_nonzero(found != expected))
    shaded = int(numpy.count_nonzero(expected))
    print(f"{len(ends)} metamers, {shaded} voxels in shadow, {grid.activeVoxelCount()} in the grid, {different} differ")
    same_size = abs(grid.transform.voxelSize()[0] - voxel) < 1e-9
    sys.exit(different != 0 or shaded != grid.activeVoxelCount() or shaded == 0 or not same_size)


main(*sys.argv[1:])
