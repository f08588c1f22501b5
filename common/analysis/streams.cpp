#include <algorithm>
#include <cmath>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

struct Stream {
  std::uint16_t order = 0;
  double length = 0.0;
  double diameters = 0.0;  // sum over its internodes
  std::size_t internodes = 0;
};

std::vector<Stream> streams_of(const Skeleton& s) {
  const std::vector<std::uint16_t> strahler = strahler_orders(s);
  std::vector<std::uint32_t> stream_of(s.node_count(), 0);
  std::vector<Stream> streams;
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    const std::uint32_t parent = s.parent[node];
    if (s.is_root(parent) || strahler[parent] != strahler[node]) {
      stream_of[node] = static_cast<std::uint32_t>(streams.size());
      streams.push_back({.order = strahler[node]});
    } else {
      stream_of[node] = stream_of[parent];
    }
    Stream& stream = streams[stream_of[node]];
    stream.length += s.length(node);
    stream.diameters += s.diameter[node];
    ++stream.internodes;
  }
  return streams;
}

/// By what factor `values`, of the orders 1, 2, ..., change from one order to the next.
std::optional<double> ratio(const std::vector<double>& values) {
  std::vector<double> orders;
  std::vector<double> logarithms;
  for (const double value : values) {
    if (!(value > 0.0)) return std::nullopt;
    orders.push_back(static_cast<double>(orders.size()));
    logarithms.push_back(std::log(value));
  }
  const std::optional<double> slope = regression_slope(orders, logarithms);
  return slope ? std::optional(std::exp(*slope)) : std::nullopt;
}

}  // namespace

void measure_streams(const Anatomy& stem, Metrics& metrics) {
  const std::vector<Stream> streams = streams_of(stem.skeleton());
  if (streams.empty()) return;
  std::uint16_t highest = 0;
  for (const Stream& stream : streams) highest = std::max(highest, stream.order);
  std::vector<double> counts(highest, 0.0);
  std::vector<double> lengths(highest, 0.0);
  std::vector<double> diameters(highest, 0.0);
  for (const Stream& stream : streams) {
    counts[stream.order - 1u] += 1.0;
    lengths[stream.order - 1u] += stream.length;
    diameters[stream.order - 1u] += stream.diameters / static_cast<double>(stream.internodes);
  }
  for (std::size_t order = 0; order < highest; ++order) {
    lengths[order] /= counts[order];
    diameters[order] /= counts[order];
  }
  metrics.strahler_order = highest;
  if (const auto fewer = ratio(counts)) metrics.bifurcation_ratio = 1.0 / *fewer;
  metrics.length_ratio = ratio(lengths);
  metrics.diameter_ratio = ratio(diameters);
}

}  // namespace ramify
