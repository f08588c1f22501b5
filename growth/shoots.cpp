#include "growth/shoots.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "growth/phyllotaxis.h"

namespace ramify::growth {
namespace {

// v is a sum of many shares: one that rounding left a hair below a whole number counts as that number.
constexpr double kVigourSlack = 1e-9;
constexpr double kLeastVigour = 1.0 - kVigourSlack;

constexpr std::size_t kBudsAtOnce = 4096;

constexpr std::size_t kShootsPerTask = 256;
constexpr std::size_t kReadAhead = 4;
constexpr std::size_t kNodesAhead = 12;

/// A bud's v after the cap, or 0 where it rests.
double capped_vigour(double vigour, double cap) {
  if (vigour < kLeastVigour) return 0.0;
  return cap > 0.0 ? std::min(vigour, cap) : vigour;
}

double metamer_count(double capped) {
  return std::floor(capped + kVigourSlack);
}

/// A tropism as it is in one step.
struct Pull {
  double weight;
  Towards towards;
  Vec3 direction;  // unit
  int min_order;
  int max_order;

  Vec3 on(const Vec3& axis) const {
    if (towards == Towards::direction) return weight * direction;
    return weight * normalized_or(Vec3(axis.x, 0.0, axis.z), Vec3(0.0));
  }
};

std::vector<Pull> pulls_of(const TreeParameters& tree, int step) {
  std::vector<Pull> pulls;
  for (const auto& [name, tropism] : tree.tropism) {
    pulls.push_back({tropism.weight.at(step), tropism.towards, glm::normalize(tropism.direction),
                     tropism.min_order, tropism.max_order});
  }
  return pulls;
}

/// `axis` turned by this share of the angle towards `pull`.
Vec3 turned_towards(const Vec3& axis, const Vec3& pull, double share) {
  const Vec3 normal = glm::cross(axis, pull);
  const double sine = glm::length(normal);
  if (sine < 1e-12) return axis;
  return glm::normalize(rotated(axis, normal / sine, share * std::atan2(sine, glm::dot(axis, pull))));
}

/// Traces shoots with the numbers of one step.
class Tracer {
 public:
  Tracer(const Plant& plant, const Guides& guides, int step)
      : plant_(plant),
        guides_(guides),
        seeker_(guides.tree, guides.light, step),
        angles_(guides.tree, step),
        pulls_(pulls_of(guides.tree, step)),
        w_default_(guides.tree.w_default.at(step)),
        w_optimal_(guides.tree.w_optimal.at(step)),
        turn_max_(guides.tree.turn_max.at(step)) {}

  /// Begins to fetch what prefetch() will read, then what trace() will.
  void prefetch_node(const Shoot& shoot) const {
    const std::uint32_t node = plant_.buds[shoot.bud].node;
    __builtin_prefetch(&plant_.position[node]);
    __builtin_prefetch(&plant_.axis[node]);
  }
  void prefetch(const Shoot& shoot) const {
    const Bud& bud = plant_.buds[shoot.bud];
    __builtin_prefetch(&plant_.axes[plant_.axis[bud.node]]);
    if (guides_.world.environment == Environment::light)
      seeker_.prefetch(plant_.position[bud.node], Vec3(plant_.bud_direction[shoot.bud]));
  }

  void trace(Shoot& shoot, Traces& traces) const {
    const Bud& bud = plant_.buds[shoot.bud];
    const Axis& axis = plant_.axes[plant_.axis[bud.node]];
    const int order = axis.order + (bud.is_terminal ? 0 : 1);
    std::uint32_t rank = bud.is_terminal ? axis.node_count - 1 : kNone;  // of a new axis the next is 0
    Frame frame{Vec3(plant_.bud_direction[shoot.bud]), Vec3(axis.reference)};
    if (bud.is_terminal) {
      shoot.axis_id = axis.id;
    } else {
      frame.reference = first_reference(shoot.axis_id, frame.direction);
    }
    Vec3 apex = plant_.position[bud.node];
    set_node(traces, shoot.first, apex);
    if (bud.is_terminal && guides_.tree.tip_bud == TipBud::terminal) {
      set_buds(traces, shoot.first, frame, shoot.axis_id, rank);
    }
    Vec3 optimal = optimal_at(shoot.bud, apex, frame.direction);
    for (; shoot.made < shoot.planned; ++shoot.made) {
      if (guides_.tree.v_per == OptimalPer::metamer && shoot.made > 0) {
        optimal = optimal_at(shoot.bud, apex, frame.direction);
      }
      const Vec3 direction = next_direction(frame.direction, optimal + tropisms(frame.direction, order));
      const Vec3 next = apex + direction * shoot.metamer_length;
      if (guides_.barriers.block(apex, next)) break;
      frame = {direction, transported(frame.reference, frame.direction, direction)};
      apex = next;
      const std::size_t slot = shoot.first + shoot.made + 1;
      set_node(traces, slot, apex);
      set_buds(traces, slot, frame, shoot.axis_id, ++rank);
    }
    shoot.end_direction = Vec3f(frame.direction);
    shoot.end_reference = Vec3f(frame.reference);
  }

 private:
  Vec3 first_reference(std::uint32_t axis_id, const Vec3& direction) const {
    Rng random = Rng::stream(guides_.seed, Stream::axis, axis_id);
    return perpendicular_at(direction, random.uniform(0.0, 2.0 * std::numbers::pi));
  }

  void set_node(Traces& traces, std::size_t slot, const Vec3& position) const {
    traces.position[slot] = position;
    traces.voxel[slot] = guides_.light.grid().voxel_of(position);
  }

  void set_buds(Traces& traces, std::size_t slot, const Frame& frame, std::uint32_t axis_id,
                std::uint32_t rank) const {
    const std::span<Vec3f> directions(traces.axillary.data() + slot * traces.buds_per_node,
                                      traces.buds_per_node);
    place_buds(guides_.tree, guides_.seed, angles_, frame, axis_id, rank, directions);
  }

  Vec3 tropisms(const Vec3& axis, int order) const {
    Vec3 sum(0.0);
    for (const Pull& pull : pulls_) {
      if (order >= pull.min_order && order <= pull.max_order) sum += pull.on(axis);
    }
    return sum;
  }

  /// The weighted best direction.
  Vec3 optimal_at(std::uint32_t bud, const Vec3& apex, const Vec3& axis) const {
    if (w_optimal_ <= 0.0) return Vec3(0.0);
    const bool is_light = guides_.world.environment == Environment::light;
    return w_optimal_ * (is_light ? seeker_.best_direction(apex, axis) : towards_markers(bud));
  }

  Vec3 towards_markers(std::uint32_t bud) const {
    return Vec3(guides_.exposure[bud] > 0.0 ? guides_.space[bud] : plant_.bud_direction[bud]);
  }

  Vec3 next_direction(const Vec3& axis, const Vec3& pull) const {
    if (guides_.tree.combine == Combine::sum) return normalized_or(w_default_ * axis + pull, axis);
    return turned_towards(axis, pull, std::min(glm::length(pull), turn_max_));
  }

  const Plant& plant_;
  const Guides& guides_;
  LightSeeker seeker_;
  BudAngles angles_;
  std::vector<Pull> pulls_;
  double w_default_;
  double w_optimal_;
  double turn_max_;
};

}  // namespace

double planned_metamers(const MappedVector<double>& vigour, const TreeParameters& tree, int step) {
  const double cap = tree.max_metamers.at(step);
  double sum = 0.0;
  for (const double v : vigour) sum += metamer_count(capped_vigour(v, cap));
  return sum;
}

ShootPlanner::ShootPlanner(const Plant& plant, const MappedVector<double>& vigour, const TreeParameters& tree,
                           int step)
    : plant_(plant),
      vigour_(vigour),
      cap_(tree.max_metamers.at(step)),
      length_(tree.internode_length.at(step)),
      next_axis_(plant.axes_founded) {}

/// Picks the buds with v >= 1 among the next ones, without a branch: which they are is hard to foretell.
/// False if there are no more.
bool ShootPlanner::pick_buds() {
  const std::size_t end = std::min(next_bud_ + kBudsAtOnce, vigour_.size());
  next_pick_ = 0;
  picked_.resize(kBudsAtOnce);
  std::size_t count = 0;
  for (; next_bud_ < end; ++next_bud_) {
    picked_[count] = next_bud_;
    count += vigour_[next_bud_] >= kLeastVigour;
  }
  picked_.resize(count);
  return count > 0 || next_bud_ < vigour_.size();
}

std::vector<Shoot> ShootPlanner::next(std::size_t most) {
  std::vector<Shoot> shoots;
  while (shoots.size() < most) {
    if (next_pick_ == picked_.size()) {
      if (!pick_buds()) break;
      continue;
    }
    const std::uint32_t picked = picked_[next_pick_++];
    const double capped = capped_vigour(vigour_[picked], cap_);
    const double count = metamer_count(capped);
    const Bud& bud = plant_.buds[picked];
    if (count < 1.0 || bud.is_dead()) continue;
    Shoot shoot;
    shoot.bud = picked;
    shoot.planned = static_cast<std::uint32_t>(count);
    shoot.is_terminal = bud.is_terminal;
    if (!bud.is_terminal) shoot.axis_id = next_axis_++;
    shoot.metamer_length = length_ * capped / count;
    shoots.push_back(shoot);
  }
  return shoots;
}

Traces trace_shoots(std::span<Shoot> shoots, const Plant& plant, const Guides& guides, int step) {
  std::size_t slots = 0;
  for (Shoot& shoot : shoots) {
    shoot.first = slots;
    slots += shoot.planned + 1;
  }
  Traces traces;
  traces.buds_per_node = buds_per_node(guides.tree);
  traces.position.resize(slots);
  traces.voxel.resize(slots);
  traces.axillary.resize(slots * traces.buds_per_node);
  const Tracer tracer(plant, guides, step);
  // What the shoots to come will read is fetched ahead, for it lies anywhere.
  parallel_for(shoots.size(), kShootsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + kNodesAhead < end) tracer.prefetch_node(shoots[i + kNodesAhead]);
      if (i + kReadAhead < end) tracer.prefetch(shoots[i + kReadAhead]);
      tracer.trace(shoots[i], traces);
    }
  });
  return traces;
}

}  // namespace ramify::growth
