// What an engine is: parameters with a table, a check and a run. Engines derive from nothing; the registry
// erases their types once.
#pragma once

#include <concepts>
#include <deque>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config/field.h"
#include "common/config/layer.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

struct Volume;

struct Progress {
  std::string_view stage;  // what is being done: "growing", "graph"
  double done = 0.0;
  double total = 1.0;
  std::string_view unit = "";  // of done and total, "step" for instance
};

/// What a run may use of its caller, and what the caller wants beside the tree.
struct RunContext {
  std::stop_token stop;  // asked at least once a step; a stopped run returns the valid tree so far
  std::function<void(const Progress&)> progress;  // may be empty; called on the thread that called run()
  std::vector<std::string> layers;                // names of the layers wanted; no other is made
  bool wants_history = false;                     // growth: keep shed internodes in the skeleton

  bool wants(std::string_view layer) const;
  void report(const Progress& now) const {
    if (progress) progress(now);
  }
};

/// A named block of numbers, such as the graph's statistics.
struct ReportGroup {
  std::string name;
  std::vector<std::pair<std::string, double>> values;
};

struct Report {
  std::vector<std::pair<std::string, double>> seconds;  // by stage
  std::vector<std::string> warnings;                    // one line each
  std::vector<ReportGroup> groups;
};

/// The skeleton has no violations() and its diameter, order and axis are set: nothing downstream repairs it.
struct RunResult {
  Skeleton skeleton;
  bool is_complete = true;  // false: stopped by the user or at a limit, which a warning names
  std::vector<Layer> layers;
  Report report;
};

/// Volumes that a run looks at, where they are in the world; their addresses are the parameters' own.
struct UsedVolumes {
  std::vector<const Volume*> obstacles;  // what stands in the way
  std::vector<const Volume*> others;     // where trees, markers, shade and cuts may be
};

/// An engine. `seed` and `steps` are members of its Parameters and rows of its table (is_top_level).
/// The other rows stand in the config's table that has the engine's name. steps() is how many steps, or
/// levels, a run will take; has_history says whether a run that wants_history can be cut at any step
/// (cut_at_step); layers() names the layers it can make, volumes() the volumes it uses. check() throws
/// ConfigError for what no single range can say, with keys below the engine's table, and returns warnings.
template <class E>
concept TreeEngine = requires(const typename E::Parameters& parameters, const RunContext& context) {
  { E::name } -> std::convertible_to<std::string_view>;
  { E::has_history } -> std::convertible_to<bool>;
  { E::layers(parameters) } -> std::same_as<std::vector<std::string>>;
  { E::Parameters::fields() } -> std::same_as<const Table&>;
  { E::volumes(parameters) } -> std::same_as<UsedVolumes>;
  { E::check(parameters) } -> std::same_as<std::vector<std::string>>;
  { E::run(parameters, context) } -> std::same_as<RunResult>;
}
&&std::default_initializable<typename E::Parameters>&& std::copyable<typename E::Parameters>;

/// An engine with its types erased; parameters go by address.
struct AnyEngine {
  std::string name;
  bool has_history = false;
  Table top_fields;  // rows that stand at the top of a config: seed, steps
  Table fields;      // the others, in the table that has the engine's name
  std::function<std::shared_ptr<void>()> make_parameters;
  std::function<std::shared_ptr<void>(const void* parameters)> copy_parameters;
  std::function<std::uint64_t(const void* parameters)> seed;
  std::function<int(const void* parameters)> steps;
  std::function<std::vector<std::string>(const void* parameters)> layers;
  std::function<UsedVolumes(const void* parameters)> volumes;
  std::function<std::vector<std::string>(const void* parameters)> check;
  std::function<RunResult(const void* parameters, const RunContext&)> run;
};

class EngineRegistry {
 public:
  template <TreeEngine E>
  void add() {
    using P = typename E::Parameters;
    AnyEngine engine;
    engine.name = E::name;
    engine.has_history = E::has_history;
    engine.layers = [](const void* p) { return E::layers(*static_cast<const P*>(p)); };
    engine.volumes = [](const void* p) { return E::volumes(*static_cast<const P*>(p)); };
    for (const FieldRow& row : P::fields()) {
      (row.info.is_top_level ? engine.top_fields : engine.fields).push_back(row);
    }
    engine.make_parameters = [] { return std::make_shared<P>(); };
    engine.copy_parameters = [](const void* p) { return std::make_shared<P>(*static_cast<const P*>(p)); };
    engine.seed = [](const void* p) { return static_cast<const P*>(p)->seed; };
    engine.steps = [](const void* p) { return E::steps(*static_cast<const P*>(p)); };
    engine.check = [](const void* p) { return E::check(*static_cast<const P*>(p)); };
    engine.run = [](const void* p, const RunContext& context) {
      return E::run(*static_cast<const P*>(p), context);
    };
    engines_.push_back(std::move(engine));
  }

  /// nullptr if there is none of that name.
  const AnyEngine* find(std::string_view name) const;
  std::vector<std::string> names() const;
  const std::deque<AnyEngine>& engines() const { return engines_; }

 private:
  std::deque<AnyEngine> engines_;  // addresses stay valid
};

}  // namespace ramify
