#include "growth/shadow_stencil.h"

#include <algorithm>

namespace ramify::growth {
namespace {

Shadow in_units(double shadow) {
  return static_cast<Shadow>(std::lround(shadow / kShadowUnit));
}

/// a * b^-q on all of level q; P09 4.1.
Shadow additive_amount(const Penumbra& penumbra, int q) {
  return in_units(penumbra.a * std::pow(penumbra.b, -q));
}

/// The field of the public demo of P09's authors: a voxel at distance d keeps 1 - 0.441 * 6.31^-d of its
/// light.
Shadow multiplicative_amount(int i, int q, int k) {
  const double distance = std::sqrt(double(i * i + q * q + k * k));
  return in_units(-std::log(1.0 - 0.441 * std::pow(6.31, -distance)));
}

}  // namespace

/// A run of voxels along z, relative to the caster.
struct ShadowStencil::Row {
  Coord first{0};
  std::vector<Shadow> amounts;
};

std::vector<ShadowStencil::Row> ShadowStencil::rows_of(const Penumbra& penumbra) {
  const bool is_additive = penumbra.model == ShadowModel::additive;
  const int first_level = is_additive ? 0 : 1;
  const int last_level = is_additive ? penumbra.q_max : 5;
  const Vec3& sun = penumbra.sun_direction;
  std::vector<Row> rows;
  for (int q = first_level; q <= last_level; ++q) {
    const Coord center(std::lround(-q * sun.x / sun.y), -q, std::lround(-q * sun.z / sun.y));
    for (int i = -q; i <= q; ++i) {
      Row row{center + Coord(i, 0, -q), {}};
      for (int k = -q; k <= q; ++k) {
        row.amounts.push_back(is_additive ? additive_amount(penumbra, q) : multiplicative_amount(i, q, k));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

ShadowStencil::ShadowStencil(const Penumbra& penumbra) {
  const std::vector<Row> rows = rows_of(penumbra);
  low_ = high_ = rows.front().first;
  for (const Row& row : rows) {
    const Coord last = row.first + Coord(0, 0, static_cast<int>(row.amounts.size()) - 1);
    low_ = glm::min(low_, row.first);
    high_ = glm::max(high_, last);
    if (row.first == Coord(0) && row.amounts.size() == 1) own_shadow_ = row.amounts.front();
  }
  leaves_wide_ = (high_.z - low_.z + kLeafEdge - 1) / kLeafEdge + 1;

  // Rows that differ in neither amounts nor z share their patterns.
  std::vector<std::pair<int, std::vector<Shadow>>> known;
  for (const Row& row : rows) {
    const std::pair<int, std::vector<Shadow>> shape{row.first.z, row.amounts};
    const auto found = std::find(known.begin(), known.end(), shape);
    const auto number = static_cast<std::uint32_t>(found - known.begin()) * kLeafEdge;
    if (found == known.end()) known.push_back(shape);
    if (levels_.empty() || levels_.back().y != row.first.y) levels_.push_back({row.first.y, row.first.x, {}});
    levels_.back().patterns.push_back(number);
  }

  const auto width = static_cast<std::size_t>(leaves_wide_ * kLeafEdge);
  amounts_.assign(known.size() * kLeafEdge * width, 0);
  for (std::uint32_t i = 0; i < known.size(); ++i) {
    const auto& [first_z, amounts] = known[i];
    for (int place = 0; place < kLeafEdge; ++place) {
      const std::size_t pattern = (std::size_t{i} * kLeafEdge + static_cast<std::size_t>(place)) * width;
      // The stencil of a caster in this place begins so far into its first leaf.
      const int begin = (place + low_.z) & (kLeafEdge - 1);
      const auto offset = static_cast<std::size_t>(begin + first_z - low_.z);
      std::copy(amounts.begin(), amounts.end(),
                amounts_.begin() + static_cast<std::ptrdiff_t>(pattern + offset));
    }
  }
}

}  // namespace ramify::growth
