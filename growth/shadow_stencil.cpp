#include "growth/shadow_stencil.h"

#include <algorithm>
#include <functional>

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

/// A run of voxels along z, relative to the caster.
struct Row {
  Coord first{0};
  std::vector<Shadow> amounts;
};

/// By level, and in each by x.
std::vector<Row> rows_of(const Penumbra& penumbra) {
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

}  // namespace

ShadowStencil::ShadowStencil(const Penumbra& penumbra) {
  const std::vector<Row> rows = rows_of(penumbra);
  low_ = high_ = rows.front().first;
  for (const Row& row : rows) {
    const Coord last = row.first + Coord(0, 0, static_cast<int>(row.amounts.size()) - 1);
    low_ = glm::min(low_, row.first);
    high_ = glm::max(high_, last);
    if (row.first == Coord(0) && row.amounts.size() == 1) own_shadow_ = row.amounts.front();
  }

  const auto add_change = [this](const Coord& first, std::vector<Shadow> amounts) {
    if (std::all_of(amounts.begin(), amounts.end(), [](Shadow amount) { return amount == 0; })) return;
    while (amounts.size() % kQuad != 0) amounts.push_back(0);
    changes_.push_back({first, std::move(amounts)});
  };
  std::vector<Shadow> before;  // the amounts of the row before, of the same level
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    std::vector<Shadow> change = row.amounts;
    for (std::size_t k = 0; k < before.size(); ++k) change[k] -= before[k];
    add_change(row.first, std::move(change));
    before = row.amounts;
    const bool is_last = i + 1 == rows.size() || rows[i + 1].first.y != row.first.y;
    if (!is_last) continue;
    std::transform(before.begin(), before.end(), before.begin(), std::negate());
    add_change(row.first + Coord(1, 0, 0), std::move(before));
    before.clear();
  }
}

}  // namespace ramify::growth
