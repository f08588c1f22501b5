// The families of metrics, one file each; measure() asks them all.
#pragma once

#include <optional>
#include <vector>

#include "common/analysis/anatomy.h"
#include "common/analysis/metrics.h"

namespace ramify {

/// Counts, lengths, volume, surface and centre of mass of the wood. An internode is a truncated cone.
void measure_wood(const Anatomy& wood, Metrics& metrics);

/// Height, crown and trunk. Horizontal distances are from the root that a node stands on.
void measure_size(const Anatomy& stem, Metrics& metrics);

/// Volume of the convex hull of the tips (qhull), m3; nothing if they lie in one plane or are fewer than
/// four.
std::optional<double> hull_volume(const Anatomy& stem);

/// Strahler's order, and Horton's ratios of the number, mean length and mean diameter of streams of
/// successive orders, by regression of their logarithms. A stream is a maximal chain of internodes of one
/// Strahler order; its diameter is the mean over its internodes. R. E. Horton, Erosional development of
/// streams and their drainage basins, GSA Bulletin 56, 1945; A. N. Strahler, Hypsometric analysis of
/// erosional topography, GSA Bulletin 63, 1952.
void measure_streams(const Anatomy& stem, Metrics& metrics);

/// Branching and divergence angles.
void measure_angles(const Anatomy& stem, Metrics& metrics);

/// Between the founder of each axis and the internode that bears it, 0 to 180 degrees; nothing for an axis
/// that starts at a root or where one of the two has no length.
/// H. Honda, Description of the form of trees by the parameters of the tree-like body, J. Theor. Biol. 31,
/// 1971.
std::vector<std::optional<double>> branching_angles_deg(const Anatomy& stem);

/// Azimuth of each axis about the one that bears it, -180 to 180 degrees, counted from a direction that is
/// carried along the bearing axis without twist. Nothing for an axis that starts at a root or goes on in the
/// bearer's direction.
std::vector<std::optional<double>> azimuths_deg(const Anatomy& stem);

/// Tortuosity and lengths of the paths from the root to the tips.
/// D. D. Smith et al., Deviation from symmetrically self-similar branching in trees predicts altered
/// hydraulics, mechanics, light interception and metabolic scaling, New Phytologist 201, 2014 (path
/// fraction).
void measure_paths(const Anatomy& stem, Metrics& metrics);

/// Arc length over chord of each axis of at least three internodes; nothing for the others and closed ones.
std::vector<std::optional<double>> tortuosities(const Anatomy& stem);

/// Box-counting dimension of the internodes as lines, with boxes of 1/4 to 1/128 of the height.
void measure_dimension(const Anatomy& stem, Metrics& metrics);

/// Asymmetry of the forks by the tips on their sides (J. van Pelt, H. B. M. Uylings, R. W. H. Verwer, R. J.
/// Pentney, M. J. Woldenberg, Tree asymmetry, a sensitive and practical measure for binary topological trees,
/// Bull. Math. Biol. 54, 1992; a fork of more than two goes in pairs) and the exponent of the pipe model.
void measure_forks(const Anatomy& stem, Metrics& metrics);

/// One entry an order, from the trunk to the highest.
void measure_orders(const Anatomy& stem, Metrics& metrics);

/// Volume and lateral surface of an internode, a truncated cone.
struct Cone {
  double volume = 0.0;   // m3
  double surface = 0.0;  // m2, without the ends
  Vec3 center{0.0};      // of mass, metres
};
Cone cone_of(const Anatomy& wood, std::size_t node);

}  // namespace ramify
