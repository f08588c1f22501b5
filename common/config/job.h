// A config, read and checked: which engine, with which parameters, meshed how.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/config/engine.h"
#include "common/config/provenance.h"
#include "common/config/toml_reader.h"
#include "common/mesh/tree_mesh.h"

namespace ramify {

struct Job {
  std::string name;  // the preset's, or the file as it was given
  const AnyEngine* engine = nullptr;
  std::shared_ptr<void> parameters;  // the engine's, seed and steps among them
  MesherOptions mesher;
  BarkOptions bark;
  LeafOptions leaves;
  std::vector<std::string> warnings;  // of the check, one line each

  Looks looks() const { return {mesher, bark, leaves}; }
  std::uint64_t seed() const { return engine->seed(parameters.get()); }
  int steps() const { return engine->steps(parameters.get()); }
  RunResult run(const RunContext& context) const { return engine->run(parameters.get(), context); }
};

/// One `KEY=VALUE` laid over a config, and the flag that said it.
struct Override {
  std::string flag;  // "--set", "--seed", "--steps"
  std::string key;
  std::string value;
};

/// Reads `config`, a preset's name, a TOML file or one that ramify made of a config (.glb, .gltf, .skel.ply),
/// with what it is based on, then the overrides; checks all of it. Throws ConfigError, or InputError where
/// there is no such preset or file.
Job load_job(const EngineRegistry& registry, const std::string& config,
             std::span<const Override> overrides = {});

/// A job of `engine` with all parameters at their defaults.
Job default_job(const AnyEngine& engine);

/// A job with parameters of its own: the copy of a Job shares them.
Job independent_copy(const Job& job);

/// Gives a job other steps, as --steps does; it is not checked. Throws ConfigError.
void set_steps(Job& job, int steps);

/// Checks a job whose parameters were changed and sets its warnings. Throws ConfigError.
void check(Job& job);

/// The table of a whole config of `engine`; its owner is a Job of that engine. `engine` must outlive it.
Table job_table(const AnyEngine& engine);

/// The complete config, ready to be read again.
std::string to_toml(const Job& job, bool with_comments = false);

Provenance provenance_of(const Job& job);

}  // namespace ramify
