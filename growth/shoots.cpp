#include "growth/shoots.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "growth/environment_light.h"
#include "growth/phyllotaxis.h"

namespace ramify::growth {
namespace {

// v is a sum of many shares: one that rounding left a hair below a whole number counts as that number.
constexpr double kVigourSlack = 1e-9;

/// A bud's v after the cap, or 0 where it rests.
double capped_vigour(double vigour, double cap) {
  if (vigour < 1.0 - kVigourSlack) return 0.0;
  return cap > 0.0 ? std::min(vigour, cap) : vigour;
}

double metamer_count(double capped) {
  return std::floor(capped + kVigourSlack);
}

/// What one bud will make, and where in `Traces` it is traced.
struct Shoot {
  std::uint32_t bud = 0;
  std::uint32_t planned = 0;  // metamers
  std::uint32_t made = 0;     // fewer where the ground is in the way
  double metamer_length = 0.0;
  std::size_t first = 0;
};

/// Upper ends and unit directions of the metamers of all shoots.
struct Traces {
  std::vector<Vec3> position;
  std::vector<Vec3> direction;
};

std::vector<Shoot> plan_shoots(const std::vector<double>& vigour, const Parameters& parameters, int step) {
  const double cap = parameters.max_metamers.at(step);
  const double length = parameters.internode_length.at(step);
  std::vector<Shoot> shoots;
  std::size_t metamers = 0;
  for (std::uint32_t bud = 0; bud < vigour.size(); ++bud) {
    const double capped = capped_vigour(vigour[bud], cap);
    const double count = metamer_count(capped);
    if (count < 1.0) continue;
    Shoot shoot;
    shoot.bud = bud;
    shoot.planned = static_cast<std::uint32_t>(count);
    shoot.metamer_length = length * capped / count;
    shoot.first = metamers;
    metamers += shoot.planned;
    shoots.push_back(shoot);
  }
  return shoots;
}

Vec3 tropism_sum(const Parameters& parameters, int step) {
  Vec3 sum(0.0);
  for (const auto& [name, tropism] : parameters.tropism) {
    sum += tropism.weight.at(step) * glm::normalize(tropism.direction);
  }
  return sum;
}

/// Follows one shoot through the light: P09 4.3's weighted sum of default, optimal and tropism direction.
void trace_shoot(Shoot& shoot, const Plant& plant, const Parameters& parameters, const LightSeeker& seeker,
                 int step, Traces& traces) {
  const double w_default = parameters.w_default.at(step);
  const double w_optimal = parameters.w_optimal.at(step);
  const Vec3 tropism = tropism_sum(parameters, step);
  const Bud& bud = plant.buds[shoot.bud];
  Vec3 direction = bud.is_terminal ? plant.axes[bud.axis].direction : bud.direction;
  Vec3 apex = plant.position[bud.node];
  for (; shoot.made < shoot.planned; ++shoot.made) {
    Vec3 sum = w_default * direction + tropism;
    if (w_optimal > 0.0) sum += w_optimal * seeker.best_direction(apex, direction);
    direction = normalized_or(sum, direction);
    apex += direction * shoot.metamer_length;
    if (parameters.ground && apex.y < parameters.ground_y) return;
    traces.position[shoot.first + shoot.made] = apex;
    traces.direction[shoot.first + shoot.made] = direction;
  }
}

/// Adds traced shoots to the plant, bud by bud.
class ShootBuilder {
 public:
  ShootBuilder(Plant& plant, const Parameters& parameters, const ShadowGrid& shadow, int step)
      : plant_(plant), parameters_(parameters), shadow_(shadow), step_(step) {}

  void keep(const Bud& bud) { buds_.push_back(bud); }

  void build(const Bud& bud, const Shoot& shoot, const Traces& traces) {
    if (parameters_.casters == Casters::buds) changes_.removed.push_back(voxel_of(bud.node));
    // Blocked at once: its light would draw resource for ever, so it dies.
    if (shoot.made == 0) return;

    // The node that a terminal bud leaves behind may get its axillary bud only now.
    if (bud.is_terminal && parameters_.tip_bud == TipBud::terminal) add_axillary_bud(bud.node, bud.axis);
    const std::uint32_t axis = bud.is_terminal ? bud.axis : found_axis(bud);
    std::uint32_t node = bud.node;
    for (std::uint32_t i = 0; i < shoot.made; ++i) {
      node = add_node(axis, node, traces.position[shoot.first + i], traces.direction[shoot.first + i]);
      const bool is_last = i + 1 == shoot.made;
      if (!is_last || parameters_.tip_bud == TipBud::both) add_axillary_bud(node, axis);
    }
    add_bud({.node = node, .axis = axis, .is_terminal = true, .direction = plant_.axes[axis].direction});
  }

  CasterChanges finish() {
    plant_.buds = std::move(buds_);
    return std::move(changes_);
  }

 private:
  Coord voxel_of(std::uint32_t node) const { return shadow_.voxel_of(plant_.position[node]); }

  std::uint32_t found_axis(const Bud& bud) {
    const auto index = static_cast<std::uint32_t>(plant_.axes.size());
    Axis axis;
    axis.base = bud.node;
    axis.first = static_cast<std::uint32_t>(plant_.node_count());
    axis.birth_step = static_cast<std::uint32_t>(step_);
    axis.order = static_cast<std::uint16_t>(plant_.axes[bud.axis].order + 1);
    axis.direction = bud.direction;
    Rng random = Rng::stream(parameters_.seed, Stream::axis, index);
    axis.reference = perpendicular_at(bud.direction, random.uniform(0.0, 2.0 * std::numbers::pi));
    plant_.axes.push_back(axis);
    return index;
  }

  std::uint32_t add_node(std::uint32_t axis, std::uint32_t parent, const Vec3& position,
                         const Vec3& direction) {
    const auto node = static_cast<std::uint32_t>(plant_.node_count());
    plant_.position.push_back(position);
    plant_.parent.push_back(parent);
    plant_.axis.push_back(axis);
    plant_.birth_step.push_back(static_cast<std::uint32_t>(step_));
    plant_.shed_step.push_back(kAlive);
    Axis& extended = plant_.axes[axis];
    extended.reference = transported(extended.reference, extended.direction, direction);
    extended.direction = direction;
    ++extended.node_count;
    if (parameters_.casters == Casters::metamers) changes_.added.push_back(voxel_of(node));
    return node;
  }

  /// On the axis's last node so far.
  void add_axillary_bud(std::uint32_t node, std::uint32_t axis) {
    const Axis& bearer = plant_.axes[axis];
    const std::uint32_t rank = bearer.node_count - 1;
    add_bud({.node = node,
             .axis = axis,
             .is_terminal = false,
             .direction = axillary_direction(parameters_, bearer, axis, rank, step_)});
  }

  void add_bud(const Bud& bud) {
    buds_.push_back(bud);
    if (parameters_.casters == Casters::buds) changes_.added.push_back(voxel_of(bud.node));
  }

  Plant& plant_;
  const Parameters& parameters_;
  const ShadowGrid& shadow_;
  int step_;
  std::vector<Bud> buds_;
  CasterChanges changes_;
};

}  // namespace

double planned_metamers(const std::vector<double>& vigour, const Parameters& parameters, int step) {
  const double cap = parameters.max_metamers.at(step);
  double sum = 0.0;
  for (const double v : vigour) sum += metamer_count(capped_vigour(v, cap));
  return sum;
}

CasterChanges extend_shoots(Plant& plant, const std::vector<double>& vigour, const Parameters& parameters,
                            const ShadowGrid& shadow, int step) {
  std::vector<Shoot> shoots = plan_shoots(vigour, parameters, step);
  const std::size_t metamers = shoots.empty() ? 0 : shoots.back().first + shoots.back().planned;
  Traces traces{std::vector<Vec3>(metamers), std::vector<Vec3>(metamers)};
  const LightSeeker seeker(parameters, shadow, step);
  parallel_for(shoots.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) trace_shoot(shoots[i], plant, parameters, seeker, step, traces);
  });

  ShootBuilder builder(plant, parameters, shadow, step);
  auto shoot = shoots.cbegin();
  for (std::uint32_t i = 0; i < plant.buds.size(); ++i) {
    const Bud bud = plant.buds[i];
    if (shoot != shoots.cend() && shoot->bud == i) {
      builder.build(bud, *shoot++, traces);
    } else {
      builder.keep(bud);
    }
  }
  return builder.finish();
}

}  // namespace ramify::growth
