// How unlike two trees are: by the places and sizes of their branches and segments, by their branching as a
// topological barcode, and by their outer shape. Each distance is 0 for identical trees and the same in both
// directions, to the last bit.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// A row a branch or a segment, as the scatter distance compares them.
template <std::size_t N>
using Rows = std::vector<std::array<double, N>>;

/// One branch order's rows.
struct OrderScatter {
  /// Of orders above 0. Branching angle (deg), azimuth about the bearing axis (deg, from its upper side; of
  /// upright bearers from +X), length (m), base radius (m), position along the bearing axis (0 to 1).
  Rows<5> branches;
  /// Radius (m), elevation (deg), place along the axis (m), path from the root (m).
  Rows<4> segments;
};

/// A branch of the topological morphology descriptor: metres along the paths from the root.
struct Bar {
  double tip = 0.0;
  double fork = 0.0;  // where it meets a branch that reaches farther
};

/// Sizes that make the outer shape, metres.
constexpr std::size_t kShapeFeatures = 6;
using ShapeFeatures = std::array<double, kShapeFeatures>;

/// What the distances compare, worked out once a tree.
struct TreeForm {
  std::vector<OrderScatter> scatter;  // by branch order
  std::vector<Bar> barcode;           // one a tip
  ShapeFeatures shape{};
};

/// Of the living stem, without roots below the ground. O(n log n).
TreeForm form_of(const Skeleton& skeleton);

/// 0 to 1: mean over random directions of the two-sample Kolmogorov-Smirnov statistic of the rows, each
/// column in units of its standard deviation over both trees, projected on the direction; by branch order,
/// orders weighted by their share of the rows; mean of branches and segments. An order that one tree lacks
/// counts as
/// 1. Of an order with very many rows some, evenly spaced, stand for all.
/// M. Potapov, M. Jarvenpaa, M. Akerblom, P. Raumonen, M. Kaasalainen, Bayes Forest: a data-intensive
/// generator of morphological tree clones, GigaScience 6, 2017.
double scatter_distance(const TreeForm& a, const TreeForm& b);

/// 0 upwards, mostly below 1: 1-D Wasserstein distance of the barcodes, projected on directions in the plane
/// of (fork, tip), mean over the directions, in units of the longest path of both trees. L. Kanari et al., A
/// topological representation of branching neuronal morphologies, Neuroinformatics 16, 2018; M. Carriere, M.
/// Cuturi, S. Oudot, Sliced Wasserstein kernel for persistence diagrams, ICML 2017.
double morphology_distance(const TreeForm& a, const TreeForm& b);

/// 0 to 1: mean over the features of 1 - exp(-(x1 - x2)^2 / (2 sigma^2)); sigma is a quarter of both values'
/// mean. Features: height, crown radius, and where the leaves are, taken to be at the tips: mean height above
/// the root, standard deviation of the height, and those along the wider and the narrower horizontal axis of
/// the crown.
/// O. Stava et al., Inverse procedural modelling of trees, Computer Graphics Forum 33, 2014.
double shape_distance(const TreeForm& a, const TreeForm& b);

/// What a distance is called and compares.
struct DistanceInfo {
  std::string_view key;
  std::string_view help;  // one line
  double (*value)(const TreeForm& a, const TreeForm& b) = nullptr;
};

/// Scatter, morphology, shape.
inline constexpr std::size_t kDistanceCount = 3;
std::span<const DistanceInfo, kDistanceCount> distance_table();

/// All of them, in the table's order.
std::array<double, kDistanceCount> distances_of(const TreeForm& a, const TreeForm& b);

}  // namespace ramify
