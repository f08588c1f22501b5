#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "common/analysis/distances.h"
#include "common/base/rng.h"

namespace ramify {
namespace {

constexpr std::uint64_t kDirections = 128;
constexpr std::size_t kMostRows = 1024;  // of an order: more would not change the second digit

template <std::size_t N>
using Row = std::array<double, N>;

/// Evenly spread over the unit sphere, the same for every pair of trees.
template <std::size_t N>
std::vector<Row<N>> random_directions() {
  std::vector<Row<N>> directions;
  for (std::uint64_t i = 0; i < kDirections; ++i) {
    Rng random = Rng::stream(1, Stream::projection, i, N);
    Row<N> direction{};
    double square = 0.0;
    for (double& x : direction) {  // normal deviates by Box and Muller
      const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
      x = radius * std::cos(2.0 * std::numbers::pi * random.uniform());
      square += x * x;
    }
    for (double& x : direction) x /= std::sqrt(square);
    directions.push_back(direction);
  }
  return directions;
}

template <std::size_t N>
Rows<N> thinned(const Rows<N>& rows) {
  if (rows.size() <= kMostRows) return rows;
  Rows<N> kept;
  for (std::size_t i = 0; i < kMostRows; ++i) kept.push_back(rows[i * rows.size() / kMostRows]);
  return kept;
}

/// For each column 1 over its standard deviation in both samples together; 0 for a column of one value. Sums
/// are taken sample by sample, so that the order of both does not matter.
template <std::size_t N>
Row<N> scales(const Rows<N>& a, const Rows<N>& b) {
  Row<N> result{};
  const double count = static_cast<double>(a.size()) + static_cast<double>(b.size());
  for (std::size_t i = 0; i < N; ++i) {
    const auto sum = [i](const Rows<N>& rows, const auto& term) {
      double total = 0.0;
      for (const Row<N>& row : rows) total += term(row[i]);
      return total;
    };
    const auto value = [](double x) { return x; };
    const double center = (sum(a, value) + sum(b, value)) / count;
    const auto square = [center](double x) { return (x - center) * (x - center); };
    const double deviation = std::sqrt((sum(a, square) + sum(b, square)) / count);
    if (deviation > 1e-12 * std::max(1.0, std::abs(center))) result[i] = 1.0 / deviation;
  }
  return result;
}

template <std::size_t N>
std::vector<double> projected(const Rows<N>& rows, const Row<N>& direction) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row<N>& row : rows) {
    double value = 0.0;
    for (std::size_t i = 0; i < N; ++i) value += direction[i] * row[i];
    values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// The greatest difference of the distribution functions of two sorted samples.
double kolmogorov_smirnov(std::span<const double> a, std::span<const double> b) {
  double greatest = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const double next = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == next) ++i;
    while (j < b.size() && b[j] == next) ++j;
    const double difference = static_cast<double>(i) / static_cast<double>(a.size()) -
                              static_cast<double>(j) / static_cast<double>(b.size());
    greatest = std::max(greatest, std::abs(difference));
  }
  return greatest;
}

template <std::size_t N>
double row_distance(const Rows<N>& all_of_a, const Rows<N>& all_of_b) {
  if (all_of_a.empty() || all_of_b.empty()) return all_of_a.empty() == all_of_b.empty() ? 0.0 : 1.0;
  static const std::vector<Row<N>> kRandom = random_directions<N>();
  const Rows<N> a = thinned(all_of_a);
  const Rows<N> b = thinned(all_of_b);
  const Row<N> scale = scales(a, b);
  double sum = 0.0;
  for (Row<N> direction : kRandom) {
    for (std::size_t i = 0; i < N; ++i) direction[i] *= scale[i];
    sum += kolmogorov_smirnov(projected(a, direction), projected(b, direction));
  }
  return sum / static_cast<double>(kDirections);
}

/// Mean over the orders of the distance between their rows, by their mean share of the rows.
template <class Member>
double mean_over_orders(const TreeForm& a, const TreeForm& b, Member member) {
  const auto rows_of = [member](const TreeForm& tree, std::size_t order) {
    return order < tree.scatter.size() ? tree.scatter[order].*member : decltype(OrderScatter{}.*member){};
  };
  const auto count_rows = [member](const TreeForm& tree) {
    double count = 0.0;
    for (const OrderScatter& own : tree.scatter) count += static_cast<double>((own.*member).size());
    return count;
  };
  const double count_a = count_rows(a);
  const double count_b = count_rows(b);
  if (count_a == 0.0 || count_b == 0.0) return count_a == count_b ? 0.0 : 1.0;
  double sum = 0.0;
  for (std::size_t order = 0; order < std::max(a.scatter.size(), b.scatter.size()); ++order) {
    const auto rows_a = rows_of(a, order);
    const auto rows_b = rows_of(b, order);
    const double share =
        0.5 * (static_cast<double>(rows_a.size()) / count_a + static_cast<double>(rows_b.size()) / count_b);
    sum += share * row_distance(rows_a, rows_b);
  }
  return sum;
}

}  // namespace

double scatter_distance(const TreeForm& a, const TreeForm& b) {
  return 0.5 *
         (mean_over_orders(a, b, &OrderScatter::branches) + mean_over_orders(a, b, &OrderScatter::segments));
}

}  // namespace ramify
