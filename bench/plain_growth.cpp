#include "bench/plain_growth.h"

#include <algorithm>
#include <span>
#include <utility>

#include "bench/plain_seeker.h"
#include "common/base/errors.h"
#include "common/base/rng.h"
#include "growth/phyllotaxis.h"

namespace ramify::bench {
namespace {

using namespace growth;

// As in growth/: decided the same way, or the trees would differ.
constexpr double kVigourSlack = 1e-9;

Penumbra penumbra_of(const Parameters& world) {
  return {.a = world.a, .b = world.b, .q_max = world.q_max};
}

bool is_known_light(const Parameters& p) {
  return p.environment == Environment::light && p.shadow == ShadowModel::additive &&
         p.casters == Casters::metamers && p.leaf_lifespan == 0 && p.sun_direction == kUp &&
         p.tie == Tie::mean;
}

bool is_known_growth(const Parameters& p) {
  const bool are_pulls_for_all = std::all_of(p.tropism.begin(), p.tropism.end(), [](const auto& named_pull) {
    const Tropism& pull = named_pull.second;
    return pull.towards == Towards::direction && pull.min_order == 0 && pull.max_order >= 1000;
  });
  return are_pulls_for_all && p.allocation == Allocation::borchert_honda && p.demand == Demand::sum &&
         p.combine == Combine::sum && p.phyllotaxis == Phyllotaxis::spiral && p.tip_bud == TipBud::both &&
         !p.sympodial && p.bud_lifespan.is_constant() && p.bud_lifespan.at(0) <= 0.0 &&
         p.shed_by == ShedBy::light;
}

bool never_sheds(const Parameters& p) {
  return p.shed_threshold.is_constant() && p.shed_threshold.at(0) <= 0.0;
}

bool is_known_world(const Parameters& p) {
  return p.obstacles.empty() && p.prune.empty() && p.trees.empty();
}

}  // namespace

struct PlainTree::Bud {
  Vec3f direction{kUp};  // unit, default direction of its first metamer
  double light = 0.0;
  double vigour = 0.0;
};

/// Carries on what the next metamer of its axis needs.
struct PlainTree::TerminalBud : Bud {
  Vec3f reference{1, 0, 0};   // perpendicular to the tip
  std::uint32_t axis_id = 0;  // how many axes were founded before
  std::uint32_t rank = 0;     // of the node it stands on, along the axis
};

struct PlainTree::Node {
  Vec3 position{0.0};
  std::uint32_t number = 0;  // how many nodes were made before it; the root has 0
  std::unique_ptr<Node> continuation;
  std::unique_ptr<Node> lateral;
  std::unique_ptr<TerminalBud> terminal_bud;
  std::unique_ptr<Bud> axillary_bud;

  // Of the subtree
  double main_light = 0.0;
  double lateral_light = 0.0;
  std::uint32_t internodes = 0;  // with its own

  bool is_shaded = false;  // the first of an axis that is to be shed
  double lost_area = 0.0;  // d^n of the axes that were shed from it
  double diameter = 0.0;
};

struct PlainTree::GrowingBud {
  Node* node = nullptr;
  bool is_terminal = false;
  double vigour = 0.0;  // after the cap
};

/// Grows the shoots of one step.
class PlainTree::Shoots {
 public:
  Shoots(PlainTree& tree, const Parameters& parameters, int step)
      : tree_(tree),
        p_(parameters),
        seeker_(p_, step),
        w_default_(p_.w_default.at(step)),
        w_optimal_(p_.w_optimal.at(step)),
        length_(p_.internode_length.at(step)),
        ground_y_(p_.ground_y.at(step)),
        angles_(p_, step) {
    for (const auto& [name, pull] : p_.tropism)
      pull_ += pull.weight.at(step) * glm::normalize(pull.direction);
  }

  /// `next_axis` is the name of an axis that this bud may found. Returns whether a metamer was made.
  bool grow(const GrowingBud& bud, std::uint32_t next_axis);

 private:
  TerminalBud start(const GrowingBud& bud, std::uint32_t next_axis) const;
  Vec3 best_direction(const Vec3& apex, const Vec3& axis) const;

  PlainTree& tree_;
  const Parameters& p_;
  PlainSeeker seeker_;
  double w_default_;
  double w_optimal_;
  double length_;
  double ground_y_;
  BudAngles angles_;
  Vec3 pull_{0.0};  // all tropisms
};

/// The tip that the shoot begins with; the bud is spent.
PlainTree::TerminalBud PlainTree::Shoots::start(const GrowingBud& bud, std::uint32_t next_axis) const {
  if (bud.is_terminal) return *std::exchange(bud.node->terminal_bud, nullptr);
  TerminalBud tip;
  tip.direction = std::exchange(bud.node->axillary_bud, nullptr)->direction;
  tip.axis_id = next_axis;
  tip.rank = ~std::uint32_t{0};  // the next is 0
  return tip;
}

bool PlainTree::Shoots::grow(const GrowingBud& bud, std::uint32_t next_axis) {
  TerminalBud tip = start(bud, next_axis);
  Frame frame{Vec3(tip.direction), Vec3(tip.reference)};
  if (!bud.is_terminal) {
    Rng random = Rng::stream(p_.seed, Stream::axis, next_axis);
    frame.reference = perpendicular_at(frame.direction, random.uniform(0.0, 2.0 * std::numbers::pi));
  }
  const double count = std::floor(bud.vigour + kVigourSlack);
  const double metamer_length = length_ * bud.vigour / count;
  Node* node = bud.node;
  Vec3 optimal(0.0);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    if (i == 0 || p_.v_per == OptimalPer::metamer) optimal = best_direction(node->position, frame.direction);
    const Vec3 pull = w_optimal_ * optimal + pull_;
    const Vec3 direction = normalized_or(w_default_ * frame.direction + pull, frame.direction);
    const Vec3 end = node->position + direction * metamer_length;
    if (p_.ground && end.y < ground_y_) break;
    frame = {direction, transported(frame.reference, frame.direction, direction)};

    const bool founds_axis = node == bud.node && !bud.is_terminal;
    std::unique_ptr<Node>& child = founds_axis ? node->lateral : node->continuation;
    child = std::make_unique<Node>();
    child->position = end;
    child->number = ++tree_.nodes_made_;
    child->axillary_bud = std::make_unique<Bud>();
    place_buds(p_, p_.seed, angles_, frame, tip.axis_id, ++tip.rank,
               std::span(&child->axillary_bud->direction, 1));
    node = child.get();
    if (std::holds_alternative<DenseShadow>(tree_.shadow_)) tree_.uncast_.push_back(node);
  }
  if (node == bud.node) return false;
  tip.direction = Vec3f(frame.direction);
  tip.reference = Vec3f(frame.reference);
  node->terminal_bud = std::make_unique<TerminalBud>(tip);
  return true;
}

Vec3 PlainTree::Shoots::best_direction(const Vec3& apex, const Vec3& axis) const {
  return std::visit([&](const auto& shadow) { return seeker_.best_direction(shadow, apex, axis); },
                    tree_.shadow_);
}

PlainTree::PlainTree(const Parameters& parameters)
    : PlainTree(parameters, PlainShadow(penumbra_of(parameters), parameters.voxel_edge())) {}

PlainTree::PlainTree(const Parameters& parameters, int voxels)
    : PlainTree(parameters, DenseShadow(penumbra_of(parameters), parameters.voxel_edge(), voxels)) {}

PlainTree::PlainTree(const Parameters& parameters, Field field)
    : parameters_(parameters), shadow_(std::move(field)), root_(std::make_unique<Node>()) {
  const bool is_known = is_known_light(parameters) && is_known_growth(parameters) &&
                        is_known_world(parameters) &&
                        (std::holds_alternative<PlainShadow>(shadow_) || never_sheds(parameters));
  if (!is_known) {
    throw InputError(
        "the plain version of the growth model has no code for these parameters (plain_growth.h)");
  }
  const double azimuth = Rng::stream(parameters.seed, Stream::axis, 0).uniform(0.0, 2.0 * std::numbers::pi);
  root_->terminal_bud = std::make_unique<TerminalBud>();
  root_->terminal_bud->reference = Vec3f(perpendicular_at(kUp, azimuth));
}

PlainTree::~PlainTree() = default;

void PlainTree::grow() {
  while (step_ < parameters_.steps) advance();
  sense();
  compute_diameters();
}

void PlainTree::advance() {
  sense();
  const int step = step_ + 1;
  const double threshold = step > parameters_.shed_after ? parameters_.shed_threshold.at(step) : 0.0;
  if (threshold > 0.0) mark_shaded(*root_, threshold);

  std::vector<GrowingBud> buds;
  collect_growing(*root_, buds);
  // Axes are named in the order in which their buds were made.
  std::sort(buds.begin(), buds.end(), [](const GrowingBud& a, const GrowingBud& b) {
    return a.node->number != b.node->number ? a.node->number < b.node->number : a.is_terminal < b.is_terminal;
  });
  const double cap = parameters_.max_metamers.at(step);
  Shoots shoots(*this, parameters_, step);
  std::uint32_t next_axis = axes_founded_;
  for (GrowingBud& bud : buds) {
    if (cap > 0.0) bud.vigour = std::min(bud.vigour, cap);
    const std::uint32_t axis = bud.is_terminal ? 0 : next_axis++;
    if (shoots.grow(bud, axis) && !bud.is_terminal) axes_founded_ = axis + 1;
  }

  if (threshold > 0.0) shed_marked(*root_, pipe());
  step_ = step;
}

void PlainTree::sense() {
  cast_shadows();
  sense_light();
  sum_light();
  share_resource();
}

void PlainTree::cast_shadows() {
  if (auto* const dense = std::get_if<DenseShadow>(&shadow_)) {
    for (const Node* node : uncast_) dense->cast(dense->voxel_of(node->position));
    uncast_.clear();
  } else {
    auto& sparse = std::get<PlainShadow>(shadow_);
    sparse.clear();
    cast_shadows(*root_, sparse);
  }
}

void PlainTree::cast_shadows(const Node& node, PlainShadow& shadow) {
  if (node.number > 0) shadow.cast(shadow.voxel_of(node.position));
  if (node.continuation) cast_shadows(*node.continuation, shadow);
  if (node.lateral) cast_shadows(*node.lateral, shadow);
}

void PlainTree::sense_light() {
  const double full = parameters_.C.at(step_ + 1);
  std::visit([&](const auto& shadow) { sense_light(*root_, shadow, full); }, shadow_);
}

template <class AnyShadow>
void PlainTree::sense_light(Node& node, const AnyShadow& shadow, double full) {
  const auto exposure = [&] {
    const Shadow own = node.number > 0 ? shadow.own_shadow() : 0;
    return std::max(full - (shadow.at(shadow.voxel_of(node.position)) - own) * kShadowUnit, 0.0);
  };
  if (node.terminal_bud) node.terminal_bud->light = exposure();
  if (node.axillary_bud) node.axillary_bud->light = exposure();
  if (node.continuation) sense_light(*node.continuation, shadow, full);
  if (node.lateral) sense_light(*node.lateral, shadow, full);
}

void PlainTree::sum_light() {
  sum_light(*root_);
}

void PlainTree::sum_light(Node& node) {
  node.main_light = node.terminal_bud ? node.terminal_bud->light : 0.0;
  node.lateral_light = node.axillary_bud ? node.axillary_bud->light : 0.0;
  node.internodes = 1;
  if (Node* child = node.continuation.get()) {
    sum_light(*child);
    node.main_light += child->main_light + child->lateral_light;
    node.internodes += child->internodes;
  }
  if (Node* child = node.lateral.get()) {
    sum_light(*child);
    node.lateral_light += child->main_light + child->lateral_light;
    node.internodes += child->internodes;
  }
}

void PlainTree::share_resource() {
  const int step = step_ + 1;
  const double light = root_->main_light + root_->lateral_light;
  const double vigour = parameters_.alpha0.at(step) + parameters_.alpha.at(step) * light;
  share_resource(*root_, vigour, parameters_.lambda.at(step));
}

void PlainTree::share_resource(Node& node, double received, double lambda) {
  // A side without light leaves all to the other.
  const double main_weight = node.lateral_light > 0.0 ? lambda : 1.0;
  const double lateral_weight = node.main_light > 0.0 ? 1.0 - lambda : 1.0;
  const double demand = main_weight * node.main_light + lateral_weight * node.lateral_light;
  const double rate = demand > 0.0 ? received / demand : 0.0;
  const double to_main = rate * main_weight * node.main_light;
  const double to_lateral = rate * lateral_weight * node.lateral_light;
  if (node.terminal_bud) node.terminal_bud->vigour = to_main;
  if (node.axillary_bud) node.axillary_bud->vigour = to_lateral;
  if (node.continuation) share_resource(*node.continuation, to_main, lambda);
  if (node.lateral) share_resource(*node.lateral, to_lateral, lambda);
}

void PlainTree::mark_shaded(Node& node, double threshold) {
  if (node.continuation) mark_shaded(*node.continuation, threshold);
  if (Node* first = node.lateral.get()) {
    first->is_shaded = first->main_light + first->lateral_light < threshold * first->internodes;
    mark_shaded(*first, threshold);
  }
}

void PlainTree::shed_marked(Node& node, const PipeModel& pipe) {
  if (node.lateral && node.lateral->is_shaded) {
    node.lost_area += compute_areas(*node.lateral, pipe);
    node.lateral = nullptr;
  }
  if (node.continuation) shed_marked(*node.continuation, pipe);
  if (node.lateral) shed_marked(*node.lateral, pipe);
}

void PlainTree::collect_growing(Node& node, std::vector<GrowingBud>& buds) {
  const auto collect_bud = [&](const Bud* bud, bool is_terminal) {
    if (bud && bud->vigour >= 1.0 - kVigourSlack) buds.push_back({&node, is_terminal, bud->vigour});
  };
  collect_bud(node.axillary_bud.get(), false);
  collect_bud(node.terminal_bud.get(), true);
  if (node.continuation) collect_growing(*node.continuation, buds);
  if (node.lateral) collect_growing(*node.lateral, buds);
}

PipeModel PlainTree::pipe() const {
  return {.exponent = parameters_.pipe_exponent, .tip_diameter = parameters_.tip_diameter};
}

void PlainTree::compute_diameters() {
  compute_areas(*root_, pipe());
}

/// Sets diameters and returns d^n of the node.
double PlainTree::compute_areas(Node& node, const PipeModel& pipe) {
  double area = node.lost_area;
  if (node.continuation) area += compute_areas(*node.continuation, pipe);
  if (node.lateral) area += compute_areas(*node.lateral, pipe);
  if (area == 0.0) area = std::pow(pipe.tip_diameter, pipe.exponent);
  node.diameter = std::pow(area, 1.0 / pipe.exponent);
  return area;
}

void PlainTree::collect(const Node& node, std::vector<const Node*>& nodes) {
  nodes.push_back(&node);
  if (node.continuation) collect(*node.continuation, nodes);
  if (node.lateral) collect(*node.lateral, nodes);
}

std::size_t PlainTree::internode_count() const {
  std::vector<const Node*> nodes;
  collect(*root_, nodes);
  return nodes.size() - 1;
}

Skeleton PlainTree::skeleton() const {
  std::vector<const Node*> nodes;
  collect(*root_, nodes);
  std::sort(nodes.begin(), nodes.end(), [](const Node* a, const Node* b) { return a->number < b->number; });
  std::vector<std::uint32_t> index(nodes_made_ + 1, kNoParent);
  Skeleton skeleton;
  skeleton.parent.assign(nodes.size(), kNoParent);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    index[nodes[i]->number] = i;
    skeleton.position.push_back(nodes[i]->position);
    skeleton.diameter.push_back(nodes[i]->diameter);
  }
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    for (const Node* child : {nodes[i]->continuation.get(), nodes[i]->lateral.get()}) {
      if (child) skeleton.parent[index[child->number]] = i;
    }
  }
  return skeleton;
}

}  // namespace ramify::bench
