#include "pathplan/endpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/base/errors.h"
#include "common/base/rng.h"

namespace ramify::pathplan {
namespace {

bool is_in_place(const Candidates& candidates, const EndpointWish& wish, std::uint32_t node) {
  if (candidates.is_fit && !candidates.is_fit(node)) return false;
  if (wish.kind == EndpointKind::random || !candidates.region) return true;
  const Vec3& position = candidates.nodes[node];
  if (!candidates.region->contains(position)) return false;
  return wish.kind == EndpointKind::region ||
         candidates.region->outer_depth(position) <= wish.shell_thickness;
}

std::string place_name(const EndpointWish& wish) {
  switch (wish.kind) {
    case EndpointKind::region:
      return "in the region";
    case EndpointKind::shell:
      return fmt::format("in the shell of {} m", wish.shell_thickness);
    default:
      return "beside the root";
  }
}

/// `wanted` of those in `pool` that are fit, or all of them. The first steps of Fisher and Yates's shuffle;
/// only nodes that are drawn are looked at, since how deep a node is in a volume can take long to tell.
template <class IsFit>
std::vector<std::uint32_t> drawn(std::vector<std::uint32_t> pool, std::size_t wanted, Rng& rng,
                                 const IsFit& is_fit) {
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < pool.size() && chosen.size() < wanted; ++i) {
    std::swap(pool[i], pool[i + rng.below(pool.size() - i)]);
    if (is_fit(pool[i])) chosen.push_back(pool[i]);
  }
  return chosen;
}

std::vector<std::uint32_t> random_endpoints(const Candidates& candidates, const EndpointWish& wish) {
  std::vector<std::uint32_t> pool(candidates.nodes.size() - 1);
  std::iota(pool.begin(), pool.end(), 1u);
  const auto wanted = static_cast<std::size_t>(wish.b);
  Rng rng = Rng::stream(wish.seed, Stream::endpoint, 0);
  std::vector<std::uint32_t> chosen = drawn(
      std::move(pool), wanted, rng, [&](std::uint32_t node) { return is_in_place(candidates, wish, node); });
  if (chosen.size() < wanted && wish.must_be_all) {
    throw RunError(
        fmt::format("b: {} endpoints wanted, {} nodes {} (more nodes, fewer endpoints or a larger place)",
                    wanted, chosen.size(), place_name(wish)));
  }
  return chosen;
}

std::vector<std::uint32_t> endpoints_by_subvolume(const Candidates& candidates, const EndpointWish& wish) {
  const std::uint32_t count = *std::max_element(candidates.subvolumes.begin(), candidates.subvolumes.end());
  std::vector<std::vector<std::uint32_t>> pools(count);
  for (std::uint32_t node = 1; node < candidates.nodes.size(); ++node) {
    if (candidates.subvolumes[node] > 0) pools[candidates.subvolumes[node] - 1].push_back(node);
  }
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t wanted =
        static_cast<std::size_t>(wish.b) / count + (i < static_cast<std::size_t>(wish.b) % count ? 1 : 0);
    Rng rng = Rng::stream(wish.seed, Stream::endpoint, 0, i + 1);
    const std::vector<std::uint32_t> some = drawn(std::move(pools[i]), wanted, rng, [&](std::uint32_t node) {
      return is_in_place(candidates, wish, node);
    });
    if (some.size() < wanted && wish.must_be_all) {
      throw RunError(
          fmt::format("b: {} endpoints wanted in sphere {}, {} nodes there (more nodes, fewer endpoints or "
                      "larger spheres)",
                      wanted, i + 1, some.size()));
    }
    chosen.insert(chosen.end(), some.begin(), some.end());
  }
  return chosen;
}

std::vector<std::uint32_t> manual_endpoints(const Candidates& candidates, const EndpointWish& wish) {
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < wish.points.size(); ++i) {
    const Vec3& point = wish.points[i].position;
    const auto nearest =
        std::min_element(candidates.nodes.begin(), candidates.nodes.end(), [&](const Vec3& a, const Vec3& b) {
          return glm::dot(a - point, a - point) < glm::dot(b - point, b - point);
        });
    const auto node = static_cast<std::uint32_t>(nearest - candidates.nodes.begin());
    if (node == 0) {
      throw RunError(fmt::format("points.{}: the node nearest to [{}, {}, {}] is the root (farther away)",
                                 i + 1, point.x, point.y, point.z));
    }
    if (std::find(chosen.begin(), chosen.end(), node) == chosen.end()) chosen.push_back(node);
  }
  return chosen;
}

}  // namespace

std::vector<std::uint32_t> choose_endpoints(const Candidates& candidates, const EndpointWish& wish) {
  if (wish.kind == EndpointKind::manual) return manual_endpoints(candidates, wish);
  if (!candidates.subvolumes.empty()) return endpoints_by_subvolume(candidates, wish);
  return random_endpoints(candidates, wish);
}

std::vector<std::uint32_t> choose_nearby_endpoints(const Graph& graph, const PathUnion& paths,
                                                   const Stage& stage, std::size_t number, bool must_be_all,
                                                   std::uint64_t seed) {
  std::vector<bool> is_seen(graph.nodes.size(), false);
  std::vector<std::uint32_t> ring(paths.nodes());  // nodes that are as many edges away
  for (const std::uint32_t node : ring) is_seen[node] = true;
  std::vector<std::uint32_t> pool;
  for (int hop = 0; hop < stage.hops; ++hop) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t node : ring) {
      for (const Link& link : graph.links_of(node)) {
        if (is_seen[link.node]) continue;
        is_seen[link.node] = true;
        next.push_back(link.node);
      }
    }
    pool.insert(pool.end(), next.begin(), next.end());
    ring = std::move(next);
  }
  const auto wanted = static_cast<std::size_t>(stage.b);
  if (pool.size() < wanted && must_be_all) {
    throw RunError(
        fmt::format("stages.{}.b: {} endpoints wanted, {} nodes within {} hops of the paths (fewer endpoints "
                    "or more hops)",
                    number, wanted, pool.size(), stage.hops));
  }
  Rng rng = Rng::stream(seed, Stream::endpoint, number);
  return drawn(std::move(pool), wanted, rng, [](std::uint32_t) { return true; });
}

}  // namespace ramify::pathplan
