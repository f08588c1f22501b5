// Tables of cylinders, one a row: how laser-scanned trees are told (QSM, quantitative structure models).
#pragma once

#include <string>
#include <vector>

#include "common/format/row_links.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// One entry a row, whatever the table it is from.
struct Cylinders {
  RowLinks links;
  std::vector<Vec3> start;
  std::vector<Vec3> end;
  std::vector<double> radius;
  std::vector<std::int64_t> run;  // rows of one axis have the same; empty: axes by width
};

/// A table read: the tree, and the largest distance from the end of a cylinder to the start of one that
/// follows it. Internodes run from end to end, so such a gap is bridged.
struct CylinderTree {
  Skeleton skeleton;
  double largest_gap = 0.0;          // metres
  std::size_t largest_gap_line = 0;  // 0 if there is none
};

/// The skeleton through the cylinders' ends, as wide as they are; a root node at each point where cylinders
/// without parent start. Axes follow `run`, orders are counted. Throws InputError naming the line.
CylinderTree join_cylinders(const Cylinders& cylinders, const std::string& file);

}  // namespace ramify
