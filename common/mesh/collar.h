// The collar of a lateral: where it leaves its parent, its surface flows over into the parent's, so that
// neither an edge nor a gap shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/bearer_facets.h"
#include "common/mesh/centre_line.h"

namespace ramify {

/// The parent's wood around the place where a lateral leaves it.
struct Fork {
  Vec3 center;                           // where the lateral's own line begins
  Vec3 along = kUp;                      // unit, of the parent there
  double radius = 0.0;                   // of the parent there
  double inset = 1.0;                    // share of the radius that lies within the parent's facets all round
  std::vector<LinePoint> line;           // of the parent, below and above; not empty
  bool has_tip = false;                  // the line ends in the parent's tip
  const BearerFacets* facets = nullptr;  // of the parent, where round wood is not like them
};

struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
};

/// The point of the parent's wood that lies nearest, seen from its axis. A point on the axis goes to the side
/// of `fallback`.
SurfacePoint on_parent(const Fork& fork, const Vec3& point, const Vec3& fallback);

/// Whether one of the points where a collar begins may lie outside of the parent's tube, which is narrower
/// than its wood where it turns, as its rings lean there.
bool may_stand_out(const Fork& fork, std::span<const Vec3f> feet);

/// A lateral as its collar needs it.
struct Lateral {
  Vec3 along{0.0};      // unit, of its first stretch
  double length = 0.0;  // of that stretch
  double free = 0.0;    // as far along it goes what stands before the next ring, metres
  double radius = 0.0;
  Vec3 bow{0.0};  // what the derivative at the stretch's end is beyond the straight line's
};

/// The part of the lateral's first stretch that its collar may take.
constexpr double kCollarShare = 0.7;

/// One line of a collar, from the parent's surface to the lateral's: a quadratic Bezier curve that touches
/// both surfaces.
struct CollarLine {
  Vec3 foot;
  Vec3 crotch;
  Vec3 top;
  Vec3 foot_normal;
  Vec3 top_normal;

  /// At t from 0, the parent's surface, to 1.
  SurfacePoint at(double t) const;
};

/// The line on the lateral's side `outwards`, a unit vector perpendicular to its direction. With a `spread`
/// less than 1 it runs so much nearer to the lateral's own surface, at 0 on it.
CollarLine collar_line(const Fork& fork, const Lateral& lateral, const Vec3& outwards, double spread = 1.0);

/// The lines of a whole collar and what its mesh is made of.
struct Collar {
  std::vector<CollarLine> lines;     // one on each side
  std::vector<SurfacePoint> points;  // of each line, from its foot to its top: stretches + 1

  /// Makes those on these sides, which stand counter-clockwise seen from the lateral's end. Where triangles
  /// between them would fold over, as in narrow forks, lines spread less. O(sides stretches).
  void lay(const Fork& fork, const Lateral& lateral, std::span<const Vec3> outwards, std::uint32_t stretches);

 private:
  void lay_lines(const Fork& fork, const Lateral& lateral, std::span<const Vec3> outwards,
                 std::uint32_t stretches);

  /// Marks the lines on both sides of triangles that are folded. False if none is.
  bool find_folds(std::uint32_t stretches);

  std::vector<double> spreads_;
  std::vector<bool> is_folded_;
};

}  // namespace ramify
