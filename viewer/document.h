// A tree that is open in the window: what it is made from, what was changed by hand, and what was made last.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/job.h"
#include "viewer/undo.h"
#include "viewer/workshop.h"

namespace ramify {

/// What was found under a name: a config, or else a tree that was read.
struct Opened {
  std::string input;                      // preset or file
  std::optional<Job> job;                 // of a config
  std::shared_ptr<const RunResult> tree;  // of a skeleton file
  std::optional<Mesh> mesh;               // of a mesh file
};

class Document {
 public:
  /// Begins to make the tree. `notify` as in Workshop.
  Document(Opened opened, std::function<void()> notify);

  const std::string& input() const { return input_; }

  /// Whether there are parameters: only trees of configs have them.
  bool has_job() const { return undo_.has_value(); }

  /// To be changed in place, and edited() called then. With parameters only.
  Job& job() { return job_; }
  const Job& job() const { return job_; }
  const Job& opened_job() const { return opened_.at(job_.engine); }

  /// Parameters were changed: checks them and orders a draft, the fine tree follows when they rest. `now` in
  /// seconds. An error is kept for error(), and the last tree stays.
  void edited(double now);

  /// The change is complete: one step of undo.
  void settle();

  void undo(double now);
  void redo(double now);
  bool can_undo() const { return undo_ && undo_->has_earlier(); }
  bool can_redo() const { return undo_ && undo_->has_later(); }

  /// Goes on with the parameters that were last used with that engine, or its defaults.
  void switch_engine(const AnyEngine& engine, double now);

  /// A config that was read anew from its file; `job` takes the place of what was opened and of what was made
  /// of it.
  void replace(Job job, double now);

  /// A message about the config, instead of a tree.
  void fail(std::string message) { error_ = std::move(message); }

  /// Layers to have beside the tree; those that the engine does not make are left out.
  void want_layers(const std::vector<std::string>& layers, double now);

  /// Steps, or levels, of the tree that is shown: 0 where it has neither.
  std::uint32_t last_step() const { return product_ ? product_->last_step : 0; }
  bool has_levels() const;
  std::uint32_t step() const { return at_.value_or(last_step()); }
  void show_step(std::uint32_t step, double now);

  /// Takes what was made and orders what is due. True if there is something new to be seen.
  bool update(double now);

  /// Seconds until update() has something to order; nothing if only a product can come.
  std::optional<double> due_in(double now) const;

  /// The tree on show; null before the first.
  const Product* product() const { return product_.get(); }
  WorkState work() const { return workshop_.state(); }
  const std::string& error() const { return error_; }

  /// When the change that the tree on show answers was made: the clock of edited().
  double product_edit_time() const { return product_edit_time_; }
  bool is_settled() const { return product_ && product_->number == ordered_ && !product_->is_draft; }

 private:
  void order(bool is_draft, double now);
  bool has_wanted_layers(const RunResult& run) const;

  std::string input_;
  Job job_;
  std::map<const AnyEngine*, Job> opened_;  // what the changes are counted from
  std::map<const AnyEngine*, Job> left_;    // when the engine was last switched
  std::optional<Undo> undo_;

  std::shared_ptr<const RunResult> tree_;  // read from a file
  std::shared_ptr<const Job> ordered_job_;
  std::vector<std::string> layers_;
  std::optional<std::uint32_t> at_;
  std::uint64_t ordered_ = 0;
  std::map<std::uint64_t, double> edit_times_;
  std::optional<double> fine_due_;

  std::unique_ptr<Product> product_;
  double product_edit_time_ = 0.0;
  std::string error_;
  Workshop workshop_;  // last: stops before what it tells is gone
};

/// What --set and the like must say to make the document's tree with `ramify generate`, ready for a shell.
std::string generate_command(const Document& document);

}  // namespace ramify
