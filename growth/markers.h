// Marker points: the free space that buds compete for. A. Runions, B. Lane, P. Prusinkiewicz, Modeling trees
// with a space colonization algorithm, 2007; Palubicki et al. 2009, 4.1. What a bud costs
// depends on the markers near it, not on their number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/bulk.h"
#include "common/base/geometry.h"
#include "common/config/layer.h"
#include "growth/marker_cone.h"
#include "growth/marker_grid.h"

namespace ramify {
class Solid;
}

namespace ramify::growth {

/// A bud that looks for space. Its number is its place in the span.
struct Seeker {
  Vec3 position;
  Vec3 direction;           // unit
  double radius = 0.0;      // how far it sees, metres
  double min_cosine = 0.0;  // of the half angle of the cone in which it sees, about its direction
};

/// What a seeker has won.
struct Claim {
  std::uint32_t markers = 0;
  // Normalized sum of the unit vectors to its markers; the seeker's own direction where there are none or
  // they cancel out.
  Vec3 direction{0.0};
  bool is_blind = false;  // no marker is in sight, not even one that another has: there never will be again
};

class Markers {
 public:
  /// round(density * volume) markers, uniformly random in `solid`; `volume` in cubic metres, `density` per
  /// cubic metre. Marker i depends on the solid, the seed and i alone. `reach`: the greatest distance,
  /// metres, > 0, at which claim() will ever be asked. Throws RunError if there are too many markers or the
  /// solid is too small a part of its box to find points inside. 30 to 60 bytes a marker.
  Markers(const Solid& solid, double volume, double density, std::uint64_t seed, double reach);

  /// Takes away for good the markers within `radius` of these points. Costs each point the cells it touches.
  void occupy(std::span<const Vec3> points, double radius);

  /// Gives each marker to the nearest of the seekers that see it, ties to the lower number; a claim a seeker.
  /// Every radius must be <= reach. The cone's edge belongs to it. Near is by the squared distance rounded to
  /// a float. On all threads, with the same result for any number of them. A seeker costs the markers near
  /// it. Fewer than 2^32 - 1 seekers. Not const for its working arrays only,
  /// which are kept from call to call: some 100 bytes a seeker.
  void claim(std::span<const Seeker> seekers, std::vector<Claim>& claims);

  /// Whether no marker is left within `reach` of the point: then there never will be one again. One lookup
  /// in a table; may say false where a closer look would say true.
  bool is_barren(const Vec3& point) const { return grid_.is_barren(point); }

  /// How many are left.
  std::size_t count() const { return grid_.count(); }

  /// Those that are left.
  PointLayer layer() const;

 private:
  /// What a seeker sees, and perhaps a little more.
  struct Sight {
    bool is_any = false;                          // of all markers
    std::span<const std::uint32_t> candidates{};  // those that it may win
  };

  void sort_into_bricks(std::span<const Seeker> seekers);
  Sight look_over(const Cone& cone, MarkerGrid::Search& search);
  Lanes best_squares(std::uint32_t place);
  std::uint32_t contend(const Cone& cone, std::uint32_t number, std::span<const std::uint32_t> candidates,
                        std::vector<std::uint32_t>& won);
  Claim collect(const Seeker& seeker, std::uint32_t number, std::span<const std::uint32_t> won);

  MarkerGrid grid_;
  BulkVector<std::uint64_t> best_;  // the best bid for each marker, by place; kNoBid between calls

  // Of the last claim
  std::vector<std::uint32_t> brick_;             // of each seeker
  std::vector<std::uint32_t> brick_end_;         // of each brick's seekers in `order_`
  std::vector<std::uint32_t> order_;             // all seekers, brick by brick
  std::vector<Seeker> sorted_;                   // the same, themselves
  std::vector<std::uint32_t> win_count_;         // how often each of them was the best so far
  std::vector<std::uint8_t> saw_;                // of each seeker, whether any marker is in sight
  std::vector<std::vector<std::uint32_t>> won_;  // at which markers, by groups of seekers
};

}  // namespace ramify::growth
