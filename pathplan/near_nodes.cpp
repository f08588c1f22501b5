#include "pathplan/near_nodes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#ifdef __SSSE3__
#include <immintrin.h>
#endif

namespace ramify::pathplan {
namespace {

// Nodes that are looked at in one instruction.
constexpr std::size_t kQuad = 4;
using Quad [[gnu::vector_size(kQuad * sizeof(float))]] = float;
using QuadMask [[gnu::vector_size(kQuad * sizeof(float))]] = std::int32_t;

// Near nothing, itself included.
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

Quad load(const float* values) {
  Quad quad;
  std::memcpy(&quad, values, sizeof quad);
  return quad;
}

Quad all(float value) {
  return Quad{value, value, value, value};
}

/// Writes the places whose lanes are set, one after the other, and returns how many; behind them as many are
/// overwritten as are not set. Without a branch, which could not be foreseen.
std::size_t pack(const std::uint32_t* places, const QuadMask& is_set, std::uint32_t* packed) {
#ifdef __SSSE3__
  static constexpr auto kShuffles = [] {
    std::array<std::array<std::uint8_t, 16>, 16> shuffles{};
    for (unsigned set = 0; set < 16; ++set) {
      unsigned to = 0;
      for (unsigned lane = 0; lane < kQuad; ++lane) {
        if ((set >> lane & 1) == 0) continue;
        for (unsigned byte = 0; byte < 4; ++byte)
          shuffles[set][to++] = static_cast<std::uint8_t>(4 * lane + byte);
      }
    }
    return shuffles;
  }();
  const auto set = static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(is_set)));
  const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(places));
  const __m128i shuffle = _mm_loadu_si128(reinterpret_cast<const __m128i*>(kShuffles[set].data()));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(packed), _mm_shuffle_epi8(all, shuffle));
  return static_cast<std::size_t>(std::popcount(set));
#else
  std::size_t count = 0;
  for (std::size_t k = 0; k < kQuad; ++k) {
    packed[count] = places[k];
    count += static_cast<std::size_t>(is_set[k] & 1);
  }
  return count;
#endif
}

}  // namespace

RoundedNodes::RoundedNodes(std::span<const Vec3> nodes, const PointGrid& grid) : grid_(grid) {
  Box box;
  for (const Vec3& node : nodes) box.include(node);
  if (nodes.empty()) box.include(Vec3(0.0));
  center_ = box.center();
  size_ = box.size().x + box.size().y + box.size().z;

  for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->assign(nodes.size() + kQuad, kNowhere);
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
  const std::size_t end = count_ + (size + kQuad - 1) / kQuad * kQuad;
  if (places_.size() < end + kQuad) {
    for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->resize(2 * (end + kQuad));
    for (std::vector<std::uint32_t>* places : {&places_, &near_}) places->resize(2 * (end + kQuad));
  }
  for (; count_ < end; count_ += kQuad, first += kQuad) {
    std::memcpy(&x_[count_], &nodes_.x_[first], sizeof(Quad));
    std::memcpy(&y_[count_], &nodes_.y_[first], sizeof(Quad));
    std::memcpy(&z_[count_], &nodes_.z_[first], sizeof(Quad));
    for (std::size_t k = 0; k < kQuad; ++k) places_[count_ + k] = static_cast<std::uint32_t>(first + k);
  }
}

/// Quads may begin anywhere, so that the last one may go on behind the last node.
void NearNodes::end() {
  if (count_ > 0) std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(count_), kQuad, kNowhere);
}

std::span<const std::uint32_t> NearNodes::near(std::size_t from, const Vec3f& position, double reach) {
  const Quad x = all(position.x);
  const Quad y = all(position.y);
  const Quad z = all(position.z);
  const float limit = nodes_.reach_with_rounding(reach);
  const Quad square = all(limit * limit);
  const std::uint32_t* const places = places_.data();
  std::uint32_t* const found = near_.data();
  std::size_t count = 0;
  for (std::size_t i = from; i < count_; i += kQuad) {
    const Quad dx = load(&x_[i]) - x;
    const Quad dy = load(&y_[i]) - y;
    const Quad dz = load(&z_[i]) - z;
    const QuadMask is_near = dx * dx + dy * dy + dz * dz <= square;
    count += pack(places + i, is_near, found + count);
  }
  return {found, count};
}

}  // namespace ramify::pathplan
