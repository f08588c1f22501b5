#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/analysis/distances.h"

namespace ramify {
namespace {

constexpr int kDirections = 32;

std::vector<double> projected(const std::vector<Bar>& bars, double angle) {
  std::vector<double> values;
  values.reserve(bars.size());
  for (const Bar& bar : bars) values.push_back(std::cos(angle) * bar.fork + std::sin(angle) * bar.tip);
  std::sort(values.begin(), values.end());
  return values;
}

/// The area between the distribution functions of two sorted samples.
double wasserstein(const std::vector<double>& a, const std::vector<double>& b) {
  double area = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  double before = std::min(a.front(), b.front());
  while (i < a.size() || j < b.size()) {
    const double next = i == a.size() ? b[j] : (j == b.size() ? a[i] : std::min(a[i], b[j]));
    const double difference = static_cast<double>(i) / static_cast<double>(a.size()) -
                              static_cast<double>(j) / static_cast<double>(b.size());
    area += std::abs(difference) * (next - before);
    before = next;
    while (i < a.size() && a[i] == next) ++i;
    while (j < b.size() && b[j] == next) ++j;
  }
  return area;
}

double longest(const std::vector<Bar>& bars) {
  double length = 0.0;
  for (const Bar& bar : bars) length = std::max(length, bar.tip);
  return length;
}

}  // namespace

double morphology_distance(const TreeForm& a, const TreeForm& b) {
  if (a.barcode.empty() || b.barcode.empty()) return a.barcode.empty() == b.barcode.empty() ? 0.0 : 1.0;
  const double unit = std::max(longest(a.barcode), longest(b.barcode));
  if (unit == 0.0) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    sum += wasserstein(projected(a.barcode, angle), projected(b.barcode, angle));
  }
  return sum / kDirections / unit;
}

}  // namespace ramify
