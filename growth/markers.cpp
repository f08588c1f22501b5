#include "growth/markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <numbers>
#include <utility>

#include "common/base/errors.h"
#include "common/base/lanes.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/volume/solid.h"

namespace ramify::growth {
namespace {

// 10 GB while they are made.
constexpr double kMarkersMax = 1 << 28;

// A solid that passes check_volume() fills at least a hundred-thousandth of its box.
constexpr int kDrawsMax = 10'000'000;

// Half as wide as the reach: narrower cells fit the cones better and hold too few markers each. With two
// cells to the reach a neighbourhood has 125, which fits a byte.
constexpr int kCellsAReach = 2;

// Cells are this share wider, so that rounding a point into the next cell takes no marker out of reach.
constexpr double kCellSlack = 1e-6;

// Wider cells for fewer markers: so many cells a marker, and at least so many.
constexpr double kCellsPerMarker = 4.0;
constexpr double kCellsMin = 4096.0;

// The edge of the cone belongs to it, whatever the rounding of cosines.
constexpr double kConeSlack = 1e-9;

// Sums of unit vectors shorter than this have cancelled out.
constexpr double kShortestSum = 1e-6;

// Where a marker goes that is taken away: its squared distance is infinite.
constexpr float kNowhere = 1e30f;

// Cells along each edge of a brick. Seekers are served brick by brick, so that they find in the cache what
// their neighbours looked at.
constexpr int kBrick = 4;

// Seekers whose winnings stand in one array, some tens of microseconds of work; seekers sent to their bricks
// and markers drawn a task.
constexpr std::size_t kGroup = 128;
constexpr std::size_t kSendGrain = 4096;
constexpr std::size_t kDrawGrain = 1024;

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

/// Rises with `value` and compares cosines without a square root: a >= c * |v| as the signed squares of both
/// sides.
template <class Real>
Real signed_square(Real value) {
  return value * std::abs(value);
}

/// A random place in the solid, from the low corner of its box; rounded to floats, and inside as it stands.
Vec3f draw_offset(const Solid& solid, const Box& box, std::uint64_t seed, std::uint64_t number) {
  Rng random = Rng::stream(seed, Stream::marker, number);
  const Vec3 size = box.size();
  for (int draw = 0; draw < kDrawsMax; ++draw) {
    const double x = random.uniform();
    const double y = random.uniform();
    const double z = random.uniform();
    const Vec3f offset(size * Vec3(x, y, z));
    if (solid.contains(box.low + Vec3(offset))) return offset;
  }
  throw RunError(
      fmt::format("marker {}: none of {} points in the volume's box is inside it (a volume that "
                  "fills more of its box)",
                  number, kDrawsMax));
}

}  // namespace

/// Where a seeker sees, as seen from itself.
struct Markers::Cone {
  explicit Cone(const Seeker& seeker)
      : direction(seeker.direction),
        radius(seeker.radius),
        cosine(std::clamp(seeker.min_cosine - kConeSlack, -1.0, 1.0)),
        sine(std::sqrt(1.0 - cosine * cosine)),
        cosine_square(signed_square(seeker.min_cosine - kConeSlack)) {
    // Up to a right angle the ball touches apex and rim; then the rim is its widest circle; then it is all.
    constexpr double wide_cosine = 0.5 * std::numbers::sqrt2;
    ball_distance = radius * (cosine >= wide_cosine ? 0.5 / cosine : std::max(0.0, cosine));
    ball_radius = cosine >= wide_cosine ? ball_distance : radius * (cosine > 0.0 ? sine : 1.0);
  }

  /// The box about the cone with its apex at 0 and a cap of the ball for its base.
  Box bounds() const {
    Box box;
    for (int i = 0; i < 3; ++i) {
      const double c = direction[i];
      const double across = std::sqrt(std::max(0.0, 1.0 - c * c)) * sine;
      box.high[i] = c >= cosine ? radius : radius * std::max(0.0, c * cosine + across);
      box.low[i] = -c >= cosine ? -radius : radius * std::min(0.0, c * cosine - across);
    }
    return box;
  }

  bool contains(const Vec3& to_marker, double square) const {
    return square <= radius * radius &&
           signed_square(glm::dot(direction, to_marker)) >= cosine_square * square;
  }

  Vec3 direction;
  double radius;
  double cosine;
  double sine;
  double cosine_square;
  double ball_distance;  // a ball that holds the cone: its centre, from the apex along the direction
  double ball_radius;
};

/// The same in floats, wider by what they round off.
struct Markers::View {
  View(const Vec3& from_low, const Cone& cone) : position(from_low), direction(cone.direction) {
    // Floats hold offsets to 2^-24 of their size, three of them a vector.
    const Vec3 far = glm::abs(from_low) + cone.radius;
    const double slack = 0x1p-21 * std::max({far.x, far.y, far.z});
    const double wide_radius = cone.radius + slack;
    square_radius = static_cast<float>(wide_radius * wide_radius * (1.0 + 1e-5));
    lead = static_cast<float>(2.0 * slack);
    cosine_square = static_cast<float>(cone.cosine_square - 1e-5);
  }

  /// Which of four markers are seen, of those up to before the end.
  LaneMask look(const float* x, const float* y, const float* z, std::int32_t end) const {
    const Lanes dx = load_lanes(x) - position.x;
    const Lanes dy = load_lanes(y) - position.y;
    const Lanes dz = load_lanes(z) - position.z;
    const Lanes square = dx * dx + dy * dy + dz * dz;
    const Lanes along = dx * direction.x + dy * direction.y + dz * direction.z + lead;
    const Lanes signed_along = along * magnitude(along);
    return (square <= square_radius) & (signed_along >= cosine_square * square) &
           (LaneMask{0, 1, 2, 3} < end);
  }

  Vec3f position;  // from the box's low corner
  Vec3f direction;
  float square_radius;
  float lead;  // added to what is along the direction
  float cosine_square;
};

Markers::Markers(const Solid& solid, double volume, double density, std::uint64_t seed, double reach)
    : box_(solid.bounds()), reach_(reach), square_reach_(reach * reach * (1.0 + kCellSlack)) {
  assert(reach > 0.0);
  const double wanted = std::round(density * volume);
  if (wanted > kMarkersMax) {
    throw RunError(fmt::format("markers: {:.3g} of them (at most {:.3g}; less density or a smaller volume)",
                               wanted, kMarkersMax));
  }
  if (box_.is_empty()) box_ = {Vec3(0.0), Vec3(0.0)};
  box_size_ = box_.size();

  lay_out_cells(wanted);
  std::vector<Drawn> drawn(static_cast<std::size_t>(std::max(0.0, wanted)));
  parallel_for(drawn.size(), kDrawGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      drawn[i].offset = draw_offset(solid, box_, seed, i);
      drawn[i].cell = static_cast<std::uint32_t>(index_of(cell_of(Vec3(drawn[i].offset))));
    }
  });
  sort_into_cells(drawn);
}

void Markers::lay_out_cells(double marker_count) {
  const double cells_max = std::max(kCellsMin, kCellsPerMarker * marker_count);
  edge_ = reach_ / kCellsAReach * (1.0 + kCellSlack);
  const auto cells = [&] { return glm::floor(box_size_ / edge_) + 1.0; };
  for (Vec3 size = cells(); size.x * size.y * size.z > cells_max; size = cells()) edge_ *= 1.25;
  size_ = Coord(cells());
  inverse_edge_ = 1.0 / edge_;
  last_cell_ = Vec3(size_ - 1);
  dilation_ = edge_ < reach_ * (1.0 + kCellSlack) ? kCellsAReach : 1;
}

void Markers::sort_into_cells(std::span<const Drawn> drawn) {
  cells_.assign(index_of(size_ - 1) + 1, {});
  for (const Drawn& marker : drawn) ++cells_[marker.cell].end;
  std::uint32_t begin = 0;
  for (Cell& cell : cells_) {
    const std::uint32_t cell_count = cell.end;
    cell = {begin, begin};
    begin += cell_count;
  }

  const std::size_t padded = drawn.size() + kLanes;
  x_.assign(padded, kNowhere);
  y_.assign(padded, kNowhere);
  z_.assign(padded, kNowhere);
  best_.assign(drawn.size(), kNoBid);
  for (const Drawn& marker : drawn) {
    const std::uint32_t place = cells_[marker.cell].end++;
    x_[place] = marker.offset.x;
    y_[place] = marker.offset.y;
    z_[place] = marker.offset.z;
  }
  count_ = drawn.size();
  count_neighbours();
}

/// Along one axis after the other.
void Markers::count_neighbours() {
  neighbours_.resize(cells_.size());
  std::transform(cells_.begin(), cells_.end(), neighbours_.begin(),
                 [](const Cell& cell) { return static_cast<std::uint8_t>(!cell.is_empty()); });
  std::size_t stride = 1;  // from a cell to the next along the axis
  for (int axis = 0; axis < 3; ++axis) {
    const auto length = static_cast<std::size_t>(size_[axis]);
    const auto dilation = static_cast<std::size_t>(dilation_);
    const std::vector<std::uint8_t> before = neighbours_;
    for (std::size_t shift = 1; shift <= std::min(dilation, length - 1); ++shift) {
      // Blocks of cells among which the axis runs from end to end.
      for (std::size_t block = 0; block < before.size(); block += length * stride) {
        const std::size_t apart = shift * stride;
        const std::size_t count = length * stride - apart;
        for (std::size_t i = block; i < block + count; ++i) {
          neighbours_[i] = static_cast<std::uint8_t>(neighbours_[i] + before[i + apart]);
          neighbours_[i + apart] = static_cast<std::uint8_t>(neighbours_[i + apart] + before[i]);
        }
      }
    }
    stride *= length;
  }
}

void Markers::add_to_neighbourhood(const Coord& cell, std::uint8_t amount) {
  const Coord low = glm::max(cell - dilation_, Coord(0));
  const Coord high = glm::min(cell + dilation_, size_ - 1);
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      const std::size_t row = index_of({0, y, z});
      for (int x = low.x; x <= high.x; ++x) {
        std::uint8_t& neighbours = neighbours_[row + static_cast<std::size_t>(x)];
        neighbours = static_cast<std::uint8_t>(neighbours + amount);
      }
    }
  }
}

bool Markers::is_barren(const Vec3& point) const {
  // No marker is nearer to the point than to the nearest point of the box.
  const Vec3 from_low = point - box_.low;
  const Vec3 away = from_low - glm::clamp(from_low, Vec3(0.0), box_size_);
  return glm::dot(away, away) > square_reach_ || neighbours_[index_of(cell_of(from_low))] == 0;
}

void Markers::occupy(std::span<const Vec3> points, double radius) {
  std::vector<std::uint32_t> room;
  for (const Vec3& point : points) {
    if (radius > reach_ || !is_barren(point)) remove_within(point, radius, room);
  }
}

void Markers::remove_within(const Vec3& point, double radius, std::vector<std::uint32_t>& room) {
  const Vec3 from_low = point - box_.low;
  const double margin = radius + kCellSlack * edge_;
  const Coord low = cell_of(from_low - margin);
  const Coord high = cell_of(from_low + margin);
  const View all_round(from_low, Cone(Seeker{point, kUp, radius, -1.0}));
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      Cell* const row = &cells_[index_of({0, y, z})];
      const Cell run{row[low.x].begin, row[high.x].end};
      if (look_over({&run, 1}, all_round, room).empty()) continue;  // what was near is taken already
      for (int x = low.x; x <= high.x; ++x) {
        Cell& cell = row[x];
        // Those that stay keep their order: what is left does not depend on the order of the points.
        std::uint32_t kept = cell.begin;
        for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
          const Vec3 to_marker = offset(i) - from_low;
          if (glm::dot(to_marker, to_marker) <= radius * radius) continue;
          x_[kept] = x_[i];
          y_[kept] = y_[i];
          z_[kept] = z_[i];
          ++kept;
        }
        if (kept == cell.end) continue;
        std::fill(x_.begin() + kept, x_.begin() + cell.end, kNowhere);
        count_ -= cell.end - kept;
        cell.end = kept;
        if (cell.is_empty()) add_to_neighbourhood({x, y, z}, static_cast<std::uint8_t>(-1));
      }
    }
  }
}

void Markers::claim(std::span<const Seeker> seekers, std::vector<Claim>& claims) {
  assert(seekers.size() < kNone);
  claims.resize(seekers.size());
  sort_into_bricks(seekers, claims);
  sorted_.resize(order_.size());
  win_count_.resize(order_.size());
  saw_.resize(order_.size());
  const std::size_t groups = (order_.size() + kGroup - 1) / kGroup;
  if (won_.size() < groups) won_.resize(groups);
  const auto end_of = [&](std::size_t group) { return std::min((group + 1) * kGroup, order_.size()); };

  // All bid. A marker may be won and lost again; who holds it at the end is among those who won it.
  parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Cell> runs;
    std::vector<std::uint32_t> room;
    for (std::size_t group = begin; group < end; ++group) {
      won_[group].clear();
      // Fetched one after the other the seekers come from memory all at once.
      for (std::size_t i = group * kGroup; i < end_of(group); ++i) sorted_[i] = seekers[order_[i]];
      for (std::size_t i = group * kGroup; i < end_of(group); ++i) {
        const Cone cone(sorted_[i]);
        const Vec3 from_low = sorted_[i].position - box_.low;
        assert(cone.radius <= reach_ * (1.0 + kCellSlack));
        find_runs(from_low, cone, runs);
        const std::span<const std::uint32_t> candidates = look_over(runs, View(from_low, cone), room);
        saw_[i] = !candidates.empty();
        win_count_[i] = contend(from_low, order_[i], cone, candidates, won_[group]);
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

/// Sends the barren home with an empty claim and puts the others in the order of their bricks.
void Markers::sort_into_bricks(std::span<const Seeker> seekers, std::vector<Claim>& claims) {
  const Coord bricks = (size_ - 1) / kBrick + 1;
  brick_.resize(seekers.size());
  parallel_for(seekers.size(), kSendGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      claims[i] = {0, seekers[i].direction};
      const Coord brick = cell_of(seekers[i].position - box_.low) / kBrick;
      brick_[i] = is_barren(seekers[i].position)
                      ? kNone
                      : static_cast<std::uint32_t>((brick.z * bricks.y + brick.y) * bricks.x + brick.x);
    }
  });

  brick_end_.assign(static_cast<std::size_t>(bricks.x * bricks.y * bricks.z), 0);
  for (const std::uint32_t brick : brick_) {
    if (brick != kNone) ++brick_end_[brick];
  }
  std::uint32_t begin = 0;
  for (std::uint32_t& end : brick_end_) begin += std::exchange(end, begin);
  order_.resize(begin);
  for (std::size_t i = 0; i < seekers.size(); ++i) {
    if (brick_[i] != kNone) order_[brick_end_[brick_[i]]++] = static_cast<std::uint32_t>(i);
  }
}

/// Cells along x that hold all markers which a seeker may see from there, in their order. Which rows have any
/// is hard to foretell, so nothing here branches on it.
void Markers::find_runs(const Vec3& from_low, const Cone& cone, std::vector<Cell>& runs) const {
  const double margin = kCellSlack * edge_;
  const Box bounds = cone.bounds();
  const Coord low = cell_of(from_low + bounds.low - margin);
  const Coord high = cell_of(from_low + bounds.high + margin);
  const Vec3 center = from_low + cone.ball_distance * cone.direction;
  const double square_radius = (cone.ball_radius + margin) * (cone.ball_radius + margin);
  // How far along one axis the ball's centre is from a row of cells.
  const auto gap = [&](double place, int cell) {
    return std::max({cell * edge_ - place, place - (cell + 1) * edge_, 0.0});
  };

  runs.resize(static_cast<std::size_t>((high.y - low.y + 1) * (high.z - low.z + 1)));
  std::size_t count = 0;
  for (int z = low.z; z <= high.z; ++z) {
    const double gap_z = gap(center.z, z);
    for (int y = low.y; y <= high.y; ++y) {
      const double gap_y = gap(center.y, y);
      const double square_half = square_radius - gap_y * gap_y - gap_z * gap_z;
      const double half = std::sqrt(std::max(square_half, 0.0));
      const Cell* const row = &cells_[index_of({0, y, z})];
      const auto cell_at = [&](double x) {
        return std::clamp(static_cast<int>(x * inverse_edge_), low.x, high.x);
      };
      runs[count] = {row[cell_at(center.x - half)].begin, row[cell_at(center.x + half)].end};
      count += (square_half >= 0.0) & !runs[count].is_empty();
    }
  }
  runs.resize(count);
}

/// Those of their markers that are in view, and perhaps a few more, in the same order; valid until `room` is
/// used again. The view is copied, or it would be read again for each marker.
std::span<const std::uint32_t> Markers::look_over(std::span<const Cell> runs, View view,
                                                  std::vector<std::uint32_t>& room) const {
  std::size_t most = kLanes;
  for (const Cell& run : runs) most += run.end - run.begin;
  if (room.size() < most) room.resize(2 * most);
  std::uint32_t* const seen = room.data();
  const float* const x = x_.data();
  const float* const y = y_.data();
  const float* const z = z_.data();
  std::size_t count = 0;
  for (const Cell& run : runs) {
    for (std::size_t i = run.begin; i < run.end; i += kLanes) {
      const LaneMask is_seen = view.look(x + i, y + i, z + i, static_cast<std::int32_t>(run.end - i));
      count += pack(LaneNumbers{0, 1, 2, 3} + static_cast<std::uint32_t>(i), is_seen, seen + count);
    }
  }
  return {seen, count};
}

/// Bids for those that it sees indeed; says how many it won and puts them behind `won`.
std::uint32_t Markers::contend(const Vec3& from_low, std::uint32_t number, const Cone& cone,
                               std::span<const std::uint32_t> candidates, std::vector<std::uint32_t>& won) {
  const std::size_t before = won.size();
  for (const std::uint32_t marker : candidates) {
    const Vec3 to_marker = offset(marker) - from_low;
    const double square = glm::dot(to_marker, to_marker);
    if (!cone.contains(to_marker, square)) continue;
    if (outbid(best_[marker], bid(square, number))) won.push_back(marker);
  }
  return static_cast<std::uint32_t>(won.size() - before);
}

/// What is left of what it won.
Claim Markers::collect(const Seeker& seeker, std::uint32_t number, std::span<const std::uint32_t> won) {
  const Vec3 from_low = seeker.position - box_.low;
  Claim claim;
  Vec3 sum(0.0);
  for (const std::uint32_t marker : won) {
    if (bidder(best_[marker]) != number) continue;
    ++claim.markers;
    // A marker just where the seeker is points nowhere.
    sum += normalized_or(offset(marker) - from_low, Vec3(0.0), std::numeric_limits<double>::min());
  }
  claim.direction = normalized_or(sum, seeker.direction, kShortestSum);
  return claim;
}

PointLayer Markers::layer() const {
  PointLayer layer;
  layer.points.reserve(count_);
  for (const Cell& cell : cells_) {
    for (std::uint32_t i = cell.begin; i < cell.end; ++i) layer.points.push_back(box_.low + offset(i));
  }
  return layer;
}

}  // namespace ramify::growth
