// Makes trees beside the window, so that it never waits for one: on a thread of its own the newest order is
// carried out, and what is no longer wanted is stopped. The workshop knows trees, not windows.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/job.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"
#include "viewer/numbers.h"
#include "viewer/sky_light.h"

namespace ramify {

/// The tree that is wanted.
struct Order {
  std::uint64_t number = 0;                   // of the newest product taken one sees which order it answers
  std::shared_ptr<const Job> job = {};        // whose parameters nobody changes; null: `run` is given
  std::shared_ptr<const RunResult> run = {};  // made before with the same job and layers: only shown anew
  std::vector<std::string> layers = {};       // wanted from a new run
  std::optional<std::uint32_t> at = {};       // how the tree was after this step, or of levels up to this one
  bool is_draft = false;                      // few triangles, no sky light: soon rather than fine
};

/// A number that no other call in this process gives.
std::uint64_t new_serial();

struct Product {
  std::uint64_t serial = new_serial();  // of this product alone
  std::uint64_t number = 0;             // the order's
  std::shared_ptr<const Job> job;
  std::shared_ptr<const RunResult> run;  // with all its history; null if it failed
  std::uint32_t last_step = 0;           // or level, of the whole run; 0 where there is neither
  Skeleton skeleton;                     // what is shown of it
  Mesh mesh;
  Mesh coarse;                             // the same with far fewer triangles, where the mesh has very many
  Mesh obstacles;                          // of the job
  std::vector<Vec3f> outline;              // outline_of() the mesh
  Box box;                                 // around the tree, and the obstacles near it
  SkyLight sky;                            // of the mesh; empty for a draft
  std::shared_ptr<const Numbers> numbers;  // of what is shown; of a draft those of the tree before it
  bool is_draft = false;
  double run_seconds = 0.0;   // 0 if there was no run
  double mesh_seconds = 0.0;  // with cutting and the sky's light
  std::string error;          // one line; then there is no tree
};

/// How far the present run is.
struct WorkState {
  bool is_busy = false;
  std::string stage;
  double part = 0.0;  // 0 to 1
};

class Workshop {
 public:
  /// `notify` is called from the workshop's thread when there is a product or progress, a few times a second.
  explicit Workshop(std::function<void()> notify);
  /// Stops what is being made and waits for it.
  ~Workshop();

  /// Takes the place of all orders before. A run that can be followed live, a short one, still comes out
  /// first, so that orders in quick succession do not starve each other; a longer one is stopped.
  void order(Order order);

  /// The newest product not taken yet.
  std::unique_ptr<Product> take();

  /// A product that is no longer shown: it goes on the workshop's thread, as that takes a while. Of a draft
  /// that takes its place, the next mesh is written into the memory.
  void retire(std::unique_ptr<Product> product, bool is_mesh_reused);

  WorkState state() const;

 private:
  void work(const std::stop_token& ending);
  std::unique_ptr<Product> make(const Order& order, const std::stop_token& stop);
  void set_progress(const Progress& now);

  std::function<void()> notify_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<Order> next_;
  std::stop_source running_;    // of the run under way
  double running_since_ = 0.0;  // seconds of the steady clock; 0: none
  double last_run_seconds_ = 0.0;
  double last_notified_ = 0.0;
  WorkState state_;
  std::unique_ptr<Product> done_;
  Mesh spare_;
  std::vector<std::unique_ptr<Product>> retired_;
  std::jthread thread_;  // last: it uses all of the others
};

/// What a picture of the tree is to hold: the tree, and obstacles near it.
std::vector<Vec3> framing_points(const Product& product);

/// The tree of an order as it is to be shown: cut, meshed, and, unless it is a draft, with its sky light. Of
/// the mesh that product has, the memory is used again.
void dress(Product& product, const Order& order);

}  // namespace ramify
