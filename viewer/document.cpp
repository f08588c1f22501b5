#include "viewer/document.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/errors.h"
#include "common/config/differences.h"
#include "common/config/presets.h"
#include "common/config/toml_reader.h"
#include "viewer/scene.h"

namespace ramify {
namespace {

// Seconds without a change after which the tree is made fine.
constexpr double kRest = 0.3;

/// In single quotes where the shell would take it for more than a word.
std::string shell_word(const std::string& text) {
  const bool is_plain = !text.empty() && text.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_-+=./:,@%") == std::string::npos;
  if (is_plain) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Whether --set can make the one of the other: no assignment takes a named item away.
bool can_be_assigned(const Job& from, const Job& to) {
  Job job = independent_copy(from);
  const Table table = job_table(*job.engine);
  for (const auto& [key, value] : differences(table, &from, &to)) {
    Origins origins;
    assign(table, &job, key, value, "", origins);
  }
  return to_toml(job) == to_toml(to);
}

}  // namespace

Document::Document(Opened opened, std::function<void()> notify)
    : input_(std::move(opened.input)), tree_(std::move(opened.tree)), workshop_(std::move(notify)) {
  if (opened.job) {
    job_ = std::move(*opened.job);
    opened_[job_.engine] = independent_copy(job_);
    undo_.emplace(job_);
    ordered_job_ = std::make_shared<const Job>(independent_copy(job_));
  }
  if (opened.mesh) {
    product_ = std::make_unique<Product>();
    product_->mesh = std::move(*opened.mesh);
    product_->outline = outline_of(product_->mesh.positions);
    for (const Vec3f& position : product_->mesh.positions) product_->box.include(Vec3(position));
    return;
  }
  order(false, 0.0);
}

void Document::order(bool is_draft, double now) {
  Order order;
  order.number = ++ordered_;
  order.job = ordered_job_;
  order.run = tree_;
  // The history of the last run tells all its steps.
  const bool is_made = product_ && product_->run && product_->job == ordered_job_;
  if (ordered_job_ && is_made && has_wanted_layers(*product_->run)) order.run = product_->run;
  order.layers = layers_;
  order.at = at_;
  order.is_draft = is_draft;
  edit_times_[ordered_] = now;
  fine_due_.reset();
  if (is_draft) fine_due_ = now + kRest;
  workshop_.order(std::move(order));
}

bool Document::has_wanted_layers(const RunResult& run) const {
  return std::all_of(layers_.begin(), layers_.end(), [&](const std::string& name) {
    return std::any_of(run.layers.begin(), run.layers.end(),
                       [&](const Layer& layer) { return layer.name == name; });
  });
}

void Document::edited(double now) {
  try {
    check(job_);
  } catch (const ConfigError& error) {
    error_ = error.what();
    return;
  }
  error_.clear();
  ordered_job_ = std::make_shared<const Job>(independent_copy(job_));
  const std::vector<std::string> makes = job_.engine->layers(job_.parameters.get());
  std::erase_if(layers_, [&](const std::string& name) {
    return std::find(makes.begin(), makes.end(), name) == makes.end();
  });
  order(true, now);
}

void Document::settle() {
  undo_->record(job_);
}

void Document::undo(double now) {
  if (!can_undo()) return;
  job_ = *undo_->back();
  edited(now);
}

void Document::redo(double now) {
  if (!can_redo()) return;
  job_ = *undo_->forward();
  edited(now);
}

void Document::switch_engine(const AnyEngine& engine, double now) {
  if (job_.engine == &engine) return;
  left_[job_.engine] = independent_copy(job_);
  if (const auto known = left_.find(&engine); known != left_.end()) {
    job_ = independent_copy(known->second);
  } else {
    job_ = default_job(engine);
    opened_[&engine] = independent_copy(job_);
  }
  at_.reset();
  settle();
  edited(now);
}

void Document::replace(Job job, double now) {
  job_ = std::move(job);
  opened_[job_.engine] = independent_copy(job_);
  settle();
  edited(now);
}

void Document::want_layers(const std::vector<std::string>& layers, double now) {
  if (!has_job()) return;
  const std::vector<std::string> makes = job_.engine->layers(job_.parameters.get());
  std::vector<std::string> wanted;
  std::copy_if(layers.begin(), layers.end(), std::back_inserter(wanted), [&](const std::string& name) {
    return std::find(makes.begin(), makes.end(), name) != makes.end();
  });
  if (wanted == layers_) return;
  layers_ = std::move(wanted);
  if (product_ && product_->run && has_wanted_layers(*product_->run)) return;
  order(false, now);
}

bool Document::has_levels() const {
  return product_ && product_->run && product_->run->skeleton.birth_step.empty();
}

void Document::show_step(std::uint32_t step, double now) {
  if (step == this->step()) return;
  at_ = step;
  if (step >= last_step()) at_.reset();
  order(true, now);
}

bool Document::update(double now, bool is_at_rest) {
  std::unique_ptr<Product> made = workshop_.take();
  if (!made) {
    if (is_at_rest && due_in(now) == 0.0) order(false, now);
    return false;
  }
  const double edit_time = edit_times_[made->number];
  edit_times_.erase(edit_times_.begin(), edit_times_.upper_bound(made->number));
  if (!made->error.empty()) {
    error_ = made->error;
    if (made->number == ordered_) fine_due_.reset();
    return true;
  }
  // The last tree's, until the fine one is measured.
  if (!made->numbers && product_) made->numbers = product_->numbers;
  // While drafts follow each other; a tree that is looked at longer shall not hold memory twice.
  const bool is_mesh_reused = made->is_draft;
  product_.swap(made);
  if (made) workshop_.retire(std::move(made), is_mesh_reused);
  product_edit_time_ = edit_time;
  if (at_ && *at_ >= product_->last_step) at_.reset();
  return true;
}

std::optional<double> Document::due_in(double now) const {
  // The draft comes first: the fine tree is made from the same run.
  if (!fine_due_ || !product_ || product_->number != ordered_) return std::nullopt;
  return std::max(0.0, *fine_due_ - now);
}

std::string generate_command(const Document& document) {
  const Job& job = document.job();
  const Job* base = &document.opened_job();
  const Job defaults = default_job(*job.engine);
  std::string command;
  std::string config = base->name;
  std::error_code error;
  const bool is_there = find_preset(config) != nullptr || std::filesystem::is_regular_file(config, error);
  if (!is_there || !can_be_assigned(*base, job)) {
    base = &defaults;
    config = job.engine->name + ".toml";
    command = fmt::format("ramify params {} --toml > {} && ", job.engine->name, config);
  }
  command += fmt::format("ramify generate {}", shell_word(config));
  const Table table = job_table(*job.engine);
  for (const auto& [key, value] : differences(table, base, &job)) {
    command += fmt::format(" --set {}", shell_word(key + "=" + value));
  }
  return command + " -o tree.glb";
}

}  // namespace ramify
