#include "viewer/workshop.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <new>

#include "common/mesh/obstacle_mesh.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "viewer/scene.h"

namespace ramify {
namespace {

// Runs shorter than this follow a slider, seconds.
constexpr double kLiveSeconds = 0.3;

constexpr double kNotifyEvery = 0.1;  // seconds

// Sides of a draft's tubes: round enough to tell thick from thin.
constexpr int kDraftSides = 3;
constexpr int kDraftSidesOfTrunk = 8;

// A mesh of more triangles than this has a coarse one beside it, of about so many: they are drawn in a blink.
constexpr std::size_t kManyTriangles = 400'000;
constexpr std::size_t kCoarseTriangles = 250'000;

// See surface_of().
constexpr int kObstacleVoxels = 128;
constexpr int kDraftObstacleVoxels = 32;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Looks looks_of(const Order& order) {
  if (!order.is_draft) return order.job ? order.job->looks() : Looks();
  Looks looks;
  looks.mesher.sides_min = kDraftSides;
  looks.mesher.sides_max = kDraftSidesOfTrunk;
  looks.bark.kind = BarkKind::plain;
  return looks;
}

/// After the step that `at` names, or up to the level where the tree has levels; the whole tree where it has
/// neither.
Skeleton shown_part(const Skeleton& whole, std::optional<std::uint32_t> at) {
  const bool has_parts = !whole.birth_step.empty() || !whole.level.empty();
  return at && has_parts ? cut_at(whole, *at) : living(whole);
}

}  // namespace

std::uint64_t new_serial() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

std::vector<Vec3> framing_points(const Product& product) {
  std::vector<Vec3> points;
  Box tree;
  for (const Vec3f& position : product.outline) {
    points.emplace_back(position);
    tree.include(points.back());
  }
  if (const Box room = obstacle_room(product.obstacles, tree); !room.is_empty()) {
    for (const Vec3& corner : corners(room)) points.push_back(corner);
  }
  return points;
}

void dress(Product& product, const Order& order) {
  const double start = now_seconds();
  product.last_step = last_step(product.run->skeleton);
  product.skeleton = shown_part(product.run->skeleton, order.at);
  const std::uint64_t seed = order.job ? order.job->seed() : 0;
  product.mesh = make_tree_mesh(product.skeleton, looks_of(order), seed, std::move(product.mesh)).mesh;
  if (!order.is_draft && product.mesh.triangles.size() > kManyTriangles) {
    Looks looks = looks_of(order);
    // Each level has half of the leaves, or less of the wood.
    looks.mesher.lod += static_cast<int>(std::bit_width(product.mesh.triangles.size() / kCoarseTriangles));
    product.coarse = make_tree_mesh(product.skeleton, looks, seed).mesh;
  }
  product.outline = outline_of(product.mesh.positions);
  for (const Vec3& position : product.skeleton.position) product.box.include(position);
  for (const Vec3f& position : product.mesh.positions) product.box.include(Vec3(position));
  if (order.job) {
    product.obstacles = obstacle_mesh(*order.job, order.is_draft ? kDraftObstacleVoxels : kObstacleVoxels);
    product.box.include(obstacle_room(product.obstacles, product.box));
  }
  if (!order.is_draft) {
    product.sky = sky_light(product.mesh, base_of({.mesh = &product.mesh, .skeleton = &product.skeleton}).y);
  }
  if (!order.is_draft) product.numbers = std::make_shared<const Numbers>(numbers_of(product.skeleton));
  product.mesh_seconds = now_seconds() - start;
}

Workshop::Workshop(std::function<void()> notify)
    : notify_(std::move(notify)), thread_([this](const std::stop_token& ending) { work(ending); }) {}

Workshop::~Workshop() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  running_.request_stop();
}

void Workshop::order(Order order) {
  const std::lock_guard lock(mutex_);
  const bool is_short = last_run_seconds_ < kLiveSeconds && now_seconds() - running_since_ < kLiveSeconds;
  if (running_since_ > 0.0 && !is_short) running_.request_stop();
  next_ = std::move(order);
  state_.is_busy = true;
  wake_.notify_one();
}

std::unique_ptr<Product> Workshop::take() {
  const std::lock_guard lock(mutex_);
  return std::move(done_);
}

void Workshop::retire(std::unique_ptr<Product> product, bool is_mesh_reused) {
  const std::lock_guard lock(mutex_);
  if (is_mesh_reused) spare_ = std::move(product->mesh);
  retired_.push_back(std::move(product));
  wake_.notify_one();
}

WorkState Workshop::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Workshop::work(const std::stop_token& ending) {
  while (true) {
    Order order;
    std::stop_token stop;
    std::vector<std::unique_ptr<Product>> retired;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, ending, [this] { return next_ || !retired_.empty(); })) return;
      retired.swap(retired_);
      if (!next_) continue;
      order = std::move(*next_);
      next_.reset();
      running_ = std::stop_source();
      stop = running_.get_token();
      if (ending.stop_requested()) return;
      running_since_ = now_seconds();
      state_ = {.is_busy = true, .stage = {}, .part = 0.0};
    }
    retired.clear();
    std::unique_ptr<Product> product = make(order, stop);
    {
      const std::lock_guard lock(mutex_);
      running_since_ = 0.0;
      if (product && product->run_seconds > 0.0) last_run_seconds_ = product->run_seconds;
      if (product) done_ = std::move(product);
      state_.is_busy = next_.has_value();
    }
    notify_();
  }
}

/// Null if it was stopped.
std::unique_ptr<Product> Workshop::make(const Order& order, const std::stop_token& stop) {
  auto product = std::make_unique<Product>();
  product->number = order.number;
  product->job = order.job;
  product->is_draft = order.is_draft;
  product->run = order.run;
  try {
    if (!product->run) {
      const double start = now_seconds();
      RunContext context;
      context.stop = stop;
      context.progress = [this](const Progress& now) { set_progress(now); };
      context.layers = order.layers;
      context.wants_history = true;
      product->run = std::make_shared<const RunResult>(order.job->run(context));
      product->run_seconds = now_seconds() - start;
      if (stop.stop_requested()) return nullptr;
    }
    {
      const std::lock_guard lock(mutex_);
      product->mesh = std::move(spare_);
    }
    dress(*product, order);
  } catch (const std::bad_alloc&) {
    product->error = "out of memory";
  } catch (const std::exception& error) {
    product->error = error.what();
  }
  if (stop.stop_requested()) return nullptr;
  return product;
}

void Workshop::set_progress(const Progress& now) {
  {
    const std::lock_guard lock(mutex_);
    state_.stage = std::string(now.stage);
    state_.part = now.total > 0.0 ? std::clamp(now.done / now.total, 0.0, 1.0) : 0.0;
    // It looked short when the next order came, but is not.
    if (next_ && now_seconds() - running_since_ > kLiveSeconds) running_.request_stop();
    if (now_seconds() - last_notified_ < kNotifyEvery) return;
    last_notified_ = now_seconds();
  }
  notify_();
}

}  // namespace ramify
