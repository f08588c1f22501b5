#include <algorithm>
#include <cmath>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {
namespace {

constexpr double kMostExponent = 20.0;  // beyond, the widths say nothing about pipes

std::vector<std::uint32_t> tip_counts(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  std::vector<std::uint32_t> counts(s.node_count(), 0);
  for (const std::uint32_t tip : stem.tips()) counts[tip] = 1;
  for (std::size_t node = s.node_count(); node-- > s.root_count();) counts[s.parent[node]] += counts[node];
  return counts;
}

/// The n that solves sum of child^n = 1, children's diameters in units of their parent's. By Newton's method:
/// the sum is convex and falls, so the steps from 0 on never pass the solution.
std::optional<double> pipe_exponent(std::span<const double> children) {
  if (std::any_of(children.begin(), children.end(), [](double d) { return !(d < 1.0); })) return std::nullopt;
  double n = 0.0;
  for (int round = 0; round < 100; ++round) {
    double excess = -1.0;
    double slope = 0.0;
    for (const double child : children) {
      const double power = std::pow(child, n);
      excess += power;
      slope += power * std::log(child);
    }
    const double step = -excess / slope;
    n += step;
    if (!(n <= kMostExponent)) return std::nullopt;
    if (step < 1e-12) break;
  }
  return n;
}

}  // namespace

void measure_forks(const Anatomy& stem, Metrics& metrics) {
  const Skeleton& s = stem.skeleton();
  const std::vector<std::uint32_t> tips = tip_counts(stem);
  std::vector<double> asymmetries;
  std::vector<double> exponents;
  std::vector<double> widths;
  for (std::size_t node = 0; node < s.node_count(); ++node) {
    const auto children = stem.children(node);
    if (children.size() < 2) continue;
    for (std::size_t i = 0; i < children.size(); ++i) {
      for (std::size_t j = i + 1; j < children.size(); ++j) {
        const double a = tips[children[i]];
        const double b = tips[children[j]];
        if (a + b > 2.0) asymmetries.push_back(std::abs(a - b) / (a + b - 2.0));
      }
    }
    if (s.is_root(node)) continue;  // no internode, so no width of its own
    widths.clear();
    for (const std::uint32_t child : children) widths.push_back(s.diameter[child] / s.diameter[node]);
    if (const auto exponent = pipe_exponent(widths)) exponents.push_back(*exponent);
  }
  metrics.asymmetry = mean(asymmetries);
  metrics.pipe_exponent = quantile(std::move(exponents), 0.5);
}

}  // namespace ramify
