#include "pathplan/near_nodes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "common/base/lanes.h"

namespace ramify::pathplan {
namespace {

// Near nothing, itself included.
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

}  // namespace

RoundedNodes::RoundedNodes(std::span<const Vec3> nodes, const PointGrid& grid) : grid_(grid) {
  Box box;
  for (const Vec3& node : nodes) box.include(node);
  if (nodes.empty()) box.include(Vec3(0.0));
  center_ = box.center();
  size_ = box.size().x + box.size().y + box.size().z;

  for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->assign(nodes.size() + kLanes, kNowhere);
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    const Vec3f rounded(nodes[grid.order()[place]] - center_);
    x_[place] = rounded.x;
    y_[place] = rounded.y;
    z_[place] = rounded.z;
  }
}

float RoundedNodes::reach_with_rounding(double reach) const {
  // Each coordinate is off by at most half a last place of the size; sums and squares round a few times more.
  return static_cast<float>(reach + 4.0 * (size_ + reach) * std::numeric_limits<float>::epsilon());
}

void NearNodes::gather_ahead(std::size_t cell) {
  begin();
  nodes_.grid_.for_each_run_ahead(cell, [&](std::size_t first, std::size_t size) { add_run(first, size); });
  end();
}

std::span<const std::uint32_t> NearNodes::ahead_of(std::size_t i, double reach) {
  return near(i + 1, {x_[i], y_[i], z_[i]}, reach);
}

std::span<const std::uint32_t> NearNodes::among(const PointGrid::Cells& cells, const Vec3& position,
                                                double reach) {
  begin();
  const std::uint32_t* const order = nodes_.grid_.order().data();
  nodes_.grid_.for_each_run(cells, [&](std::span<const std::uint32_t> run) {
    add_run(static_cast<std::size_t>(run.data() - order), run.size());
  });
  end();
  return near(0, Vec3f(position - nodes_.center_), reach);
}

/// Takes whole quads: what is beyond the run is nodes farther on.
void NearNodes::add_run(std::size_t first, std::size_t size) {
  const std::size_t end = count_ + (size + kLanes - 1) / kLanes * kLanes;
  if (places_.size() < end + kLanes) {
    for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->resize(2 * (end + kLanes));
    for (std::vector<std::uint32_t>* places : {&places_, &near_}) places->resize(2 * (end + kLanes));
  }
  for (; count_ < end; count_ += kLanes, first += kLanes) {
    std::memcpy(&x_[count_], &nodes_.x_[first], sizeof(Lanes));
    std::memcpy(&y_[count_], &nodes_.y_[first], sizeof(Lanes));
    std::memcpy(&z_[count_], &nodes_.z_[first], sizeof(Lanes));
    for (std::size_t k = 0; k < kLanes; ++k) places_[count_ + k] = static_cast<std::uint32_t>(first + k);
  }
}

/// Quads may begin anywhere, so that the last one may go on behind the last node.
void NearNodes::end() {
  if (count_ > 0) std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(count_), kLanes, kNowhere);
}

std::span<const std::uint32_t> NearNodes::near(std::size_t from, const Vec3f& position, double reach) {
  const Lanes x = all_lanes(position.x);
  const Lanes y = all_lanes(position.y);
  const Lanes z = all_lanes(position.z);
  const float limit = nodes_.reach_with_rounding(reach);
  const Lanes square = all_lanes(limit * limit);
  const std::uint32_t* const places = places_.data();
  std::uint32_t* const found = near_.data();
  std::size_t count = 0;
  for (std::size_t i = from; i < count_; i += kLanes) {
    const Lanes dx = load_lanes(&x_[i]) - x;
    const Lanes dy = load_lanes(&y_[i]) - y;
    const Lanes dz = load_lanes(&z_[i]) - z;
    const LaneMask is_near = dx * dx + dy * dy + dz * dz <= square;
    count += pack(load_lanes(places + i), is_near, found + count);
  }
  return {found, count};
}

}  // namespace ramify::pathplan
