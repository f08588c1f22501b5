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

  // Rows that differ in neither amounts nor z share their patterns, one for each place.
  std::vector<const Row*> known;
  std::vector<std::size_t> pattern_of_row;
  for (const Row& row : rows) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const Row* other) {
      return other->first.z == row.first.z && other->amounts == row.amounts;
    });
    pattern_of_row.push_back(static_cast<std::size_t>(found - known.begin()) * kLeafEdge);
    if (found == known.end()) known.push_back(&row);
  }
  const auto width = static_cast<std::size_t>(leaves_wide_ * kLeafEdge);
  amounts_.assign(known.size() * kLeafEdge * width, 0);
  for (std::size_t i = 0; i < known.size(); ++i) {
    for (int place = 0; place < kLeafEdge; ++place) {
      // The stencil of a caster in this place begins so far into its first leaf.
      const int begin = (place + low_.z) & (kLeafEdge - 1);
      const std::size_t pattern = (i * kLeafEdge + static_cast<std::size_t>(place)) * width;
      const auto offset = pattern + static_cast<std::size_t>(begin + known[i]->first.z - low_.z);
      std::copy(known[i]->amounts.begin(), known[i]->amounts.end(),
                amounts_.begin() + static_cast<std::ptrdiff_t>(offset));
    }
  }

  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].first.y == rows[first].first.y) ++end;
    Level level{rows[first].first.y, rows[first].first.x, {}};
    for (std::size_t place = 0; place < kLeafEdge; ++place) {
      for (std::size_t i = first; i < end; ++i) {
        level.amounts.push_back(amounts_.data() + (pattern_of_row[i] + place) * width);
      }
    }
    levels_.push_back(std::move(level));
    first = end;
  }
}

}  // namespace ramify::growth
