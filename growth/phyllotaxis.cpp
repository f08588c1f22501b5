#include "growth/phyllotaxis.h"

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

// Turning about world Z does nothing to a shoot that points along it.
const double kNearlyAlongZ = std::cos(radians(10.0));

// Nodes of an axis whose buds' azimuths are worked out beforehand: few axes have more in a step that matters.
constexpr std::uint32_t kFirstNodes = 64;

constexpr double kHalfTurn = std::numbers::pi;

/// The perpendicular to the frame's direction at this azimuth.
Vec3 outwards(const Frame& frame, const Turn& azimuth) {
  return frame.reference * azimuth.cosine + glm::cross(frame.direction, frame.reference) * azimuth.sine;
}

/// S4: the axis's direction turned left or right in the XY plane, a fair coin.
Vec3 planar_direction(const Frame& frame, Rng& random, double angle) {
  const double turn = random.coin() ? angle : -angle;
  const Vec3 z(0.0, 0.0, 1.0);
  if (std::abs(glm::dot(frame.direction, z)) < kNearlyAlongZ) return rotated(frame.direction, z, turn);
  const double azimuth = random.uniform(0.0, 2.0 * kHalfTurn);
  return rotated(frame.direction, perpendicular_at(frame.direction, azimuth), turn);
}

/// Azimuth of the first bud of the rank-th node.
double node_azimuth(const TreeParameters& tree, double divergence, std::uint32_t rank) {
  switch (tree.phyllotaxis) {
    case Phyllotaxis::spiral:
      return divergence * rank;
    case Phyllotaxis::alternate:
      return kHalfTurn * rank;
    case Phyllotaxis::opposite:
    case Phyllotaxis::whorled:
      // Each node's buds stand above the gaps of the node before.
      return kHalfTurn / static_cast<double>(buds_per_node(tree)) * rank;
    case Phyllotaxis::planar_random:
      break;
  }
  return 0.0;
}

/// Azimuth of one of so many buds, without jitter.
double bud_azimuth(double of_first, std::size_t bud, std::size_t bud_count) {
  const double share = static_cast<double>(bud) / static_cast<double>(bud_count);
  return of_first + 2.0 * kHalfTurn * share;
}

}  // namespace

BudAngles::BudAngles(const TreeParameters& tree, int step)
    : branching(radians(tree.branching_angle_deg.at(step))),
      cosine(std::cos(branching)),
      sine(std::sin(branching)),
      divergence(radians(tree.divergence_deg.at(step))),
      jitter(radians(tree.jitter_deg.at(step))) {
  if (jitter > 0.0 || tree.phyllotaxis == Phyllotaxis::planar_random) return;
  const std::size_t buds = buds_per_node(tree);
  for (std::uint32_t rank = 0; rank < kFirstNodes; ++rank) {
    const double azimuth = node_azimuth(tree, divergence, rank);
    for (std::size_t bud = 0; bud < buds; ++bud) first_turns.emplace_back(bud_azimuth(azimuth, bud, buds));
  }
}

std::size_t buds_per_node(const TreeParameters& tree) {
  switch (tree.phyllotaxis) {
    case Phyllotaxis::opposite:
      return 2;
    case Phyllotaxis::whorled:
      return static_cast<std::size_t>(tree.whorl_buds);
    default:
      return 1;
  }
}

void place_buds(const TreeParameters& tree, std::uint64_t seed, const BudAngles& angles, const Frame& frame,
                std::uint32_t axis_id, std::uint32_t rank, std::span<Vec3f> directions) {
  const std::size_t first_turn = rank * directions.size();
  if (first_turn < angles.first_turns.size()) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const Vec3 side = outwards(frame, angles.first_turns[first_turn + i]);
      directions[i] = Vec3f(frame.direction * angles.cosine + side * angles.sine);
    }
    return;
  }

  Rng random = Rng::stream(seed, Stream::bud, axis_id, rank);
  const auto strayed = [&] {
    return angles.jitter > 0.0 ? random.uniform(-angles.jitter, angles.jitter) : 0.0;
  };
  const double first_azimuth = node_azimuth(tree, angles.divergence, rank);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double stray = strayed();
    if (tree.phyllotaxis == Phyllotaxis::planar_random) {
      const Vec3 planar = planar_direction(frame, random, angles.branching + stray);
      directions[i] = Vec3f(rotated(planar, frame.direction, strayed()));
      continue;
    }
    const Vec3 side = outwards(frame, Turn(bud_azimuth(first_azimuth, i, directions.size()) + strayed()));
    const double cosine = stray == 0.0 ? angles.cosine : std::cos(angles.branching + stray);
    const double sine = stray == 0.0 ? angles.sine : std::sin(angles.branching + stray);
    directions[i] = Vec3f(frame.direction * cosine + side * sine);
  }
}

}  // namespace ramify::growth
