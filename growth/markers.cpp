#include "growth/markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/volume/solid.h"

namespace ramify::growth {
namespace {

// 10 GB while they are made.
constexpr double kMarkersMax = 1 << 28;

// A solid that passes check_volume() fills at least a hundred-thousandth of its box.
constexpr int kDrawsMax = 10'000'000;

// Points that the solid is asked about at once.
constexpr std::size_t kDrawnAtOnce = 256;

// Sums of unit vectors shorter than this have cancelled out.
constexpr double kShortestSum = 1e-6;

// Cells along each edge of a brick. Seekers are served brick by brick, so that they find in the cache what
// their neighbours looked at.
constexpr int kBrick = 4;

// Seekers whose winnings stand in one array, some tens of microseconds of work; seekers sent to their bricks
// a task.
constexpr std::size_t kGroup = 128;
constexpr std::size_t kSendGrain = 4096;

constexpr std::uint32_t kNone = 0xffffffff;

// The squared distance, then the number: less is nearer. Floats that are not negative sort as their bits do.
constexpr std::uint64_t kNoBid = ~std::uint64_t{0};
std::uint64_t bid(double square, std::uint32_t number) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(square))} << 32 | number;
}
std::uint32_t bidder(std::uint64_t bid) {
  return static_cast<std::uint32_t>(bid);
}

/// Lowers `best` to `bid`; false where it is no better.
bool outbid(std::uint64_t& best, std::uint64_t bid) {
  const std::atomic_ref<std::uint64_t> shared(best);
  std::uint64_t current = shared.load(std::memory_order_relaxed);
  while (bid < current) {
    if (shared.compare_exchange_weak(current, bid, std::memory_order_relaxed)) return true;
  }
  return false;
}

/// Random places in the solid for the markers from number `first` on, from the low corner of its box; rounded
/// to floats, and inside as they stand. Each marker has its own random numbers. All draw once, then those
/// that fell outside again, picked without a branch: which they are cannot be foreseen.
void draw_offsets(const Solid& solid, const Box& box, std::uint64_t seed, std::size_t first,
                  std::span<Vec3f> offsets) {
  struct Drawer {
    std::size_t marker;  // among these
    Rng random;
  };
  const Vec3 size = box.size();
  std::vector<Drawer> drawers;
  drawers.reserve(offsets.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
    drawers.push_back({i, Rng::stream(seed, Stream::marker, first + i)});
  std::array<Vec3, kDrawnAtOnce> points;
  std::array<std::uint8_t, kDrawnAtOnce> is_inside;
  for (int draw = 0; draw < kDrawsMax && !drawers.empty(); ++draw) {
    std::size_t outside = 0;
    for (std::size_t begin = 0; begin < drawers.size(); begin += kDrawnAtOnce) {
      const std::span<Drawer> some =
          std::span(drawers).subspan(begin, std::min(kDrawnAtOnce, drawers.size() - begin));
      for (std::size_t i = 0; i < some.size(); ++i) {
        const double x = some[i].random.uniform();
        const double y = some[i].random.uniform();
        const double z = some[i].random.uniform();
        const Vec3f offset(size * Vec3(x, y, z));
        offsets[some[i].marker] = offset;
        points[i] = box.low + Vec3(offset);
      }
      solid.find_inside(std::span(points).first(some.size()), std::span(is_inside).first(some.size()));
      for (std::size_t i = 0; i < some.size(); ++i) {
        drawers[outside] = some[i];
        outside += is_inside[i] == 0;
      }
    }
    drawers.erase(drawers.begin() + static_cast<std::ptrdiff_t>(outside), drawers.end());
  }
  if (drawers.empty()) return;
  throw RunError(
      fmt::format("marker {}: none of {} points in the volume's box is inside it (a volume that "
                  "fills more of its box)",
                  first + drawers.front().marker, kDrawsMax));
}

Box box_of(const Solid& solid) {
  const Box box = solid.bounds();
  return box.is_empty() ? Box{Vec3(0.0), Vec3(0.0)} : box;
}

MarkerGrid scattered(const Solid& solid, double volume, double density, std::uint64_t seed, double reach) {
  const double wanted = std::round(density * volume);
  if (wanted > kMarkersMax) {
    throw RunError(fmt::format("markers: {:.3g} of them (at most {:.3g}; less density or a smaller volume)",
                               wanted, kMarkersMax));
  }
  const Box box = box_of(solid);
  return MarkerGrid(
      box, reach, static_cast<std::size_t>(std::max(0.0, wanted)),
      [&](std::size_t first, std::span<Vec3f> offsets) { draw_offsets(solid, box, seed, first, offsets); });
}

}  // namespace

Markers::Markers(const Solid& solid, double volume, double density, std::uint64_t seed, double reach)
    : grid_(scattered(solid, volume, density, seed, reach)), best_(grid_.place_count(), kNoBid) {}

void Markers::occupy(std::span<const Vec3> points, double radius) {
  MarkerGrid::Search search;
  for (const Vec3& point : points) {
    if (radius > grid_.reach() || !is_barren(point))
      grid_.take_within(point - grid_.box().low, radius, search);
  }
}

void Markers::claim(std::span<const Seeker> seekers, std::vector<Claim>& claims) {
  assert(seekers.size() < kNone);
  claims.resize(seekers.size());
  sort_into_bricks(seekers);
  sorted_.resize(order_.size());
  win_count_.resize(order_.size());
  saw_.resize(order_.size());
  const std::size_t groups = (order_.size() + kGroup - 1) / kGroup;
  if (won_.size() < groups) won_.resize(groups);
  const auto end_of = [&](std::size_t group) { return std::min((group + 1) * kGroup, order_.size()); };

  // All bid. A marker may be won and lost again; who holds it at the end is among those who won it.
  parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
    MarkerGrid::Search search;
    ConeShape shape;
    for (std::size_t group = begin; group < end; ++group) {
      won_[group].clear();
      // Fetched one after the other the seekers come from memory all at once.
      for (std::size_t i = group * kGroup; i < end_of(group); ++i) sorted_[i] = seekers[order_[i]];
      for (std::size_t i = group * kGroup; i < end_of(group); ++i) {
        const Seeker& seeker = sorted_[i];
        assert(seeker.radius <= grid_.reach() * (1.0 + 1e-6));
        if (!shape.is_of(seeker.radius, seeker.min_cosine))
          shape = ConeShape(seeker.radius, seeker.min_cosine);
        const Cone cone{shape, seeker.position - grid_.box().low, seeker.direction};
        const Sight sight = look_over(cone, search);
        saw_[i] = sight.is_any;
        win_count_[i] = contend(cone, order_[i], sight.candidates, won_[group]);
      }
    }
  });

  // All look which they hold, in the order of the cells.
  parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      std::span<const std::uint32_t> won = won_[group];
      for (std::size_t i = group * kGroup; i < end_of(group); ++i) {
        claims[order_[i]] = collect(sorted_[i], order_[i], won.first(win_count_[i]));
        claims[order_[i]].is_blind = saw_[i] == 0;
        won = won.subspan(win_count_[i]);
      }
    }
  });

  parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      for (const std::uint32_t marker : won_[group]) {
        std::atomic_ref<std::uint64_t>(best_[marker]).store(kNoBid, std::memory_order_relaxed);
      }
    }
  });
}

/// Puts the seekers in the order of their bricks, of each brick those with the highest numbers first.
void Markers::sort_into_bricks(std::span<const Seeker> seekers) {
  const Coord bricks = (grid_.size() - 1) / kBrick + 1;
  brick_.resize(seekers.size());
  parallel_for(seekers.size(), kSendGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Coord brick = grid_.cell_of(seekers[i].position - grid_.box().low) / kBrick;
      brick_[i] = static_cast<std::uint32_t>((brick.z * bricks.y + brick.y) * bricks.x + brick.x);
    }
  });

  brick_end_.assign(static_cast<std::size_t>(bricks.x * bricks.y * bricks.z), 0);
  for (const std::uint32_t brick : brick_) ++brick_end_[brick];
  std::uint32_t begin = 0;
  for (std::uint32_t& end : brick_end_) end = begin += end;
  order_.resize(seekers.size());
  for (std::size_t i = 0; i < seekers.size(); ++i)
    order_[--brick_end_[brick_[i]]] = static_cast<std::uint32_t>(i);
}

/// Leaves out what has a better bid already; valid until the next search.
Markers::Sight Markers::look_over(const Cone& cone, MarkerGrid::Search& search) {
  const std::span<const std::uint32_t> groups = grid_.find(cone.lens(), search);
  const std::size_t most = kLanes * (groups.size() + 1);
  if (search.places.size() < most) search.places.resize(2 * most);
  const ConeView view(cone);
  const float* const x = grid_.x();
  const float* const y = grid_.y();
  const float* const z = grid_.z();
  std::uint32_t* const candidates = search.places.data();
  std::size_t count = 0;
  LaneMask is_any{};
  for (const std::uint32_t place : groups) {
    const LaneNumbers places = LaneNumbers{0, 1, 2, 3} + place;
    const Glance glance = view.look(x + place, y + place, z + place);
    is_any |= glance.is_seen;
    // No bid is no number, which nothing is farther than.
    const LaneMask is_farther = glance.square > best_squares(place);
    count += pack(places, glance.is_seen & ~is_farther, candidates + count);
  }
  return {sign_bits(is_any) != 0, {candidates, count}};
}

/// The squared distances that the best bids for four successive markers tell: their higher halves.
Lanes Markers::best_squares(std::uint32_t place) {
  const auto bid = [&](std::uint32_t marker) {
    return std::atomic_ref<std::uint64_t>(best_[marker]).load(std::memory_order_relaxed);
  };
  using Bids = std::uint64_t __attribute__((vector_size(16)));
  const auto low = reinterpret_cast<Lanes>(Bids{bid(place), bid(place + 1)});
  const auto high = reinterpret_cast<Lanes>(Bids{bid(place + 2), bid(place + 3)});
  constexpr int kHigher = std::endian::native == std::endian::little ? 1 : 0;
  return __builtin_shufflevector(low, high, kHigher, 2 + kHigher, 4 + kHigher, 6 + kHigher);
}

/// Bids for those that it sees indeed; says how many it won and puts them behind `won`. Sieved without a
/// branch before any is bid for: which are another's by then cannot be foreseen.
std::uint32_t Markers::contend(const Cone& cone, std::uint32_t number,
                               std::span<const std::uint32_t> candidates, std::vector<std::uint32_t>& won) {
  const std::size_t before = won.size();
  won.resize(before + candidates.size());
  std::uint32_t* const own = won.data() + before;
  std::size_t good_count = 0;
  for (const std::uint32_t marker : candidates) {
    const Vec3 to_marker = grid_.offset(marker) - cone.apex;
    const double square = glm::dot(to_marker, to_marker);
    const std::atomic_ref<std::uint64_t> best(best_[marker]);
    own[good_count] = marker;
    good_count +=
        (bid(square, number) < best.load(std::memory_order_relaxed)) & cone.contains(to_marker, square);
  }
  std::size_t count = 0;
  for (const std::uint32_t marker : std::span(own, good_count)) {
    const Vec3 to_marker = grid_.offset(marker) - cone.apex;
    own[count] = marker;
    count += outbid(best_[marker], bid(glm::dot(to_marker, to_marker), number));
  }
  won.resize(before + count);
  return static_cast<std::uint32_t>(count);
}

/// What is left of what it won.
Claim Markers::collect(const Seeker& seeker, std::uint32_t number, std::span<const std::uint32_t> won) {
  const Vec3 from_low = seeker.position - grid_.box().low;
  Claim claim;
  Vec3 sum(0.0);
  for (const std::uint32_t marker : won) {
    if (bidder(best_[marker]) != number) continue;
    ++claim.markers;
    // A marker just where the seeker is points nowhere.
    sum += normalized_or(grid_.offset(marker) - from_low, Vec3(0.0), std::numeric_limits<double>::min());
  }
  claim.direction = normalized_or(sum, seeker.direction, kShortestSum);
  return claim;
}

PointLayer Markers::layer() const {
  PointLayer layer;
  layer.points = grid_.points();
  return layer;
}

}  // namespace ramify::growth
