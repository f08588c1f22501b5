// Random numbers that are addressed, not drawn in turn: the stream of a bud or an edge depends on the seed,
// the purpose and the index alone, so neither the order of work nor the number of threads changes a tree.
// Generator: SplitMix64 (Steele, Lea and Flood 2014, Fast splittable pseudorandom number generators).
#pragma once

#include <cstdint>

namespace ramify {

/// What a stream is for. A new purpose goes to the end: the numbers are part of every tree's identity.
enum class Stream : std::uint64_t {
  bud,          // growth: a bud's default direction, by (axis, rank)
  axis,         // growth: an axis's first azimuth
  dart,         // pathplan: the Poisson darts of a row of cells, by (row, pass)
  surplus,      // pathplan: which nodes of the last pass are dropped
  edge_weight,  // pathplan: by (lower node, higher node)
  endpoint,     // pathplan: which nodes become endpoints, by stage
  marker,       // growth: where the i-th marker point of a volume is
  sky,          // growth: the uneven light of a voxel, by (x and y, z)
  subgraph,     // pathplan: the seed of a graph around an endpoint, by (level, endpoint)
  root_graphs,  // pathplan: the seed of all graphs of the roots
  v_g,          // pathplan: where a graph is turned to, by (level, endpoint)
  lifespan,     // pathplan: of an endpoint, by (level, endpoint)
  light,        // pathplan: what the light deals out, by level
  turn,         // pathplan: of a guiding vector, by node
  spheres,      // pathplan: the seed of the spheres that refine a crown
  leaf,         // leaves: how one is turned, sized and coloured, by (axis, rank)
  leaf_axis,    // leaves: where they begin along an axis and around it, by axis
  projection,   // analysis: the directions of the scatter distance
};

class Rng {
 public:
  /// The numbers that belong to (seed, purpose, index, second index).
  static Rng stream(std::uint64_t seed, Stream purpose, std::uint64_t index, std::uint64_t second = 0) {
    std::uint64_t state = mixed(seed + kGolden);
    state = mixed(state ^ (static_cast<std::uint64_t>(purpose) + kGolden));
    state = mixed(state ^ (index + kGolden));
    state = mixed(state ^ (second + kGolden));
    return Rng(state);
  }

  std::uint64_t next() { return mixed(state_ += kGolden); }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0 .. count - 1; count > 0.
  std::uint64_t below(std::uint64_t count) {
    // Rejection keeps small counts exactly uniform.
    const std::uint64_t limit = ~std::uint64_t{0} - ~std::uint64_t{0} % count;
    std::uint64_t drawn = next();
    while (drawn >= limit) drawn = next();
    return drawn % count;
  }

  bool coin() { return (next() >> 63) != 0; }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // 2^64 / golden ratio, odd

  explicit Rng(std::uint64_t state) : state_(state) {}

  static constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace ramify
