#include "pathplan/near_nodes.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace ramify::pathplan {
namespace {

// Near nothing, itself included.
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

constexpr double kLastPlace = std::numeric_limits<float>::epsilon();

/// Tells which of four nodes are near a position.
class Sieve {
 public:
  Sieve(const Vec3f& position, float reach)
      : x_(all_lanes(position.x)),
        y_(all_lanes(position.y)),
        z_(all_lanes(position.z)),
        square_(all_lanes(reach * reach)) {}

  LaneMask is_near(const Lanes& x, const Lanes& y, const Lanes& z) const {
    const Lanes dx = x - x_;
    const Lanes dy = y - y_;
    const Lanes dz = z - z_;
    return dx * dx + dy * dy + dz * dz <= square_;
  }

 private:
  Lanes x_, y_, z_;
  Lanes square_;
};

LaneNumbers numbers_from(std::size_t first) {
  return static_cast<std::uint32_t>(first) + LaneNumbers{0, 1, 2, 3};
}

}  // namespace

RoundedNodes::RoundedNodes(std::span<const Vec3> nodes, const PointGrid& grid) : grid_(grid) {
  Box box;
  for (const Vec3& node : nodes) box.include(node);
  if (nodes.empty()) box.include(Vec3(0.0));
  center_ = box.center();
  size_ = box.size().x + box.size().y + box.size().z;

  points_.reserve(nodes.size() + kLanes);
  for (const std::uint32_t node : grid.order()) {
    const Vec3f rounded(nodes[node] - center_);
    points_.push_back(Lanes{rounded.x, rounded.y, rounded.z, 0.0f});
  }
  points_.insert(points_.end(), kLanes, all_lanes(kNowhere));
}

float RoundedNodes::way_error() const {
  // Two coordinates of at most half the size are off by half a last place each, and so is their difference.
  return static_cast<float>(size_ * kLastPlace);
}

float RoundedNodes::square_error(double reach) const {
  const double error = size_ * kLastPlace;
  return static_cast<float>((2.0 * reach + error) * error + 2.0 * reach * reach * kLastPlace);
}

float RoundedNodes::reach_with_rounding(double reach) const {
  // Each coordinate is off by at most half a last place of the size; sums and squares round a few times more.
  return static_cast<float>(reach + 4.0 * (size_ + reach) * kLastPlace);
}

void NearNodes::gather_ahead(std::size_t cell) {
  count_ = 0;
  nodes_.grid_.for_each_run_ahead(cell, [&](std::size_t first, std::size_t size) { add_run(first, size); });
  // Quads may begin anywhere, so that the last one may go on behind the last node.
  if (count_ > 0) std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(count_), kLanes, kNowhere);
}

/// Takes whole quads: what is beyond the run is nodes farther on.
void NearNodes::add_run(std::size_t first, std::size_t size) {
  const std::size_t end = count_ + (size + kLanes - 1) / kLanes * kLanes;
  if (places_.size() < end + kLanes) {
    for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->resize(2 * (end + kLanes));
    for (std::vector<std::uint32_t>* places : {&places_, &near_}) places->resize(2 * (end + kLanes));
  }
  for (; count_ < end; count_ += kLanes, first += kLanes) {
    const auto [x, y, z, zero] = nodes_.quad(first);
    store(x, &x_[count_]);
    store(y, &y_[count_]);
    store(z, &z_[count_]);
    store(numbers_from(first), &places_[count_]);
  }
}

std::span<const std::uint32_t> NearNodes::ahead_of(std::size_t i, double reach) {
  const Sieve sieve({x_[i], y_[i], z_[i]}, nodes_.reach_with_rounding(reach));
  const std::uint32_t* const places = places_.data();
  std::uint32_t* const near = near_.data();
  std::size_t count = 0;
  for (std::size_t k = i + 1; k < count_; k += kLanes) {
    const LaneMask is_near = sieve.is_near(load_lanes(&x_[k]), load_lanes(&y_[k]), load_lanes(&z_[k]));
    count += pack(load_lanes(places + k), is_near, near + count);
  }
  return {near, count};
}

std::span<const std::uint32_t> NearNodes::among(const PointGrid::Cells& cells, const Vec3& position,
                                                double reach) {
  const Sieve sieve(Vec3f(position - nodes_.center_), nodes_.reach_with_rounding(reach));
  const std::uint32_t* const order = nodes_.grid_.order().data();
  std::size_t count = 0;
  nodes_.grid_.for_each_run(cells, [&](std::span<const std::uint32_t> run) {
    const auto first = static_cast<std::size_t>(run.data() - order);
    if (near_.size() < count + run.size() + 2 * kLanes) near_.resize(2 * (count + run.size() + 2 * kLanes));
    for (std::size_t k = first; k < first + run.size(); k += kLanes) {
      const auto [x, y, z, zero] = nodes_.quad(k);
      count += pack(numbers_from(k), sieve.is_near(x, y, z), &near_[count]);
    }
  });
  return {near_.data(), count};
}

}  // namespace ramify::pathplan
