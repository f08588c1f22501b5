#include "cli/experiment/slurm_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/experiment/process.h"
#include "cli/text.h"
#include "common/base/digest.h"
#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlan = "plan.json";  // of its own: the sweep's changes with the next command
constexpr const char* kScript = "job.sh";
constexpr const char* kJob = "job.json";

void write_file(const fs::path& path, const std::string& bytes) {
  OutputFiles files;
  files.add(path) << bytes;
  files.commit();
}

/// What each task runs. Options on sbatch's command line go before those in here, of which the last counts.
std::string script_text(const fs::path& sweep, const fs::path& folder, std::size_t slices,
                        const SlurmOptions& options) {
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  std::string text = "#!/bin/sh\n#SBATCH --job-name=ramify-sweep\n#SBATCH --requeue --open-mode=append\n";
  text += fmt::format("#SBATCH --ntasks=1 --cpus-per-task={}\n", std::max(1, options.threads));
  if (!options.sbatch_options.empty()) text += fmt::format("#SBATCH {}\n", options.sbatch_options);
  text += fmt::format(
      "exec {} sweep-task {} -o {} --slice \"$SLURM_ARRAY_TASK_ID\" --slices {} "
      "--threads \"${{SLURM_CPUS_PER_TASK:-1}}\"\n",
      shell_quoted(program), shell_quoted((folder / kPlan).string()), shell_quoted(sweep.string()), slices);
  return text;
}

/// sbatch --parsable says "JOB" or "JOB;CLUSTER".
std::string job_id(const std::string& output) {
  return output.substr(0, output.find_first_of(";\n"));
}

std::string one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n'))
    text.replace(at, 1, "; ");
  return text;
}

/// The same for the same runs.
fs::path job_folder(const fs::path& sweep, const SweepPlan& plan) {
  std::string names;
  for (const PlannedRun& run : plan.runs) names += run.name + "\n";
  return sweep / "slurm" / digest_of(names);
}

/// The last job that was submitted for the plan.
std::optional<SlurmJob> submitted(const fs::path& sweep, const SweepPlan& plan) {
  const fs::path folder = job_folder(sweep, plan);
  std::error_code error;
  if (!fs::is_regular_file(folder / kJob, error)) return std::nullopt;
  const nlohmann::json object = nlohmann::json::parse(read_file(folder / kJob), nullptr, false);
  if (!object.is_object()) return std::nullopt;
  return SlurmJob{object.value("job", ""), object.value("slices", std::size_t{1}),
                  object.value("tasks", std::size_t{1}), folder};
}

}  // namespace

SlurmJob submit(const SweepPlan& plan, std::span<const std::size_t> runs, const fs::path& sweep,
                const SlurmOptions& options) {
  const fs::path shared = fs::absolute(sweep).lexically_normal();
  SlurmJob job;
  job.folder = job_folder(shared, plan);
  const std::size_t most = options.tasks > 0 ? static_cast<std::size_t>(options.tasks) : kUsualTasks;
  std::size_t families = 1;
  for (const PlannedRun& run : plan.runs) families = std::max(families, run.family + 1);
  job.slices = std::min(most, families);
  std::set<std::size_t> busy;
  for (const std::size_t run : runs) busy.insert(slice_of(plan.runs[run], job.slices));
  job.tasks = busy.size();

  std::error_code error;
  fs::create_directories(job.folder, error);
  if (error) throw IoError(fmt::format("{}: cannot write: {}", job.folder.string(), error.message()));
  write_file(job.folder / kPlan, plan_text(plan));
  write_file(job.folder / kScript, script_text(shared, job.folder, job.slices, options));
  const std::string script = (job.folder / kScript).string();
  const auto end = run_process({"sbatch", "--parsable", fmt::format("--array={}", fmt::join(busy, ",")),
                                "--chdir=" + job.folder.string(), "--output=task-%a.log", script});
  if (!end) {
    throw RunError(fmt::format(
        "--slurm: there is no sbatch in PATH (its job script is {}; without --slurm the runs are made here)",
        script));
  }
  if (end->code != 0) {
    throw RunError(fmt::format("--slurm: {} (the job script is {})",
                               end->errors.empty() ? fmt::format("sbatch ended with exit code {}", end->code)
                                                   : one_line(end->errors),
                               script));
  }
  job.id = job_id(end->output);
  const nlohmann::ordered_json object = {{"job", job.id}, {"slices", job.slices}, {"tasks", job.tasks}};
  write_file(job.folder / kJob, object.dump() + "\n");
  return job;
}

std::string missing_text(const SweepResults& results, const fs::path& sweep) {
  const SweepPlan& plan = results.plan;
  std::vector<std::size_t> missing = unfinished(results);
  std::erase_if(missing, [&](std::size_t run) { return !results.rows[run].failure.empty(); });
  std::string text = fmt::format("{} of {} runs are missing", missing.size(), plan.runs.size());
  if (const auto job = submitted(sweep, plan)) {
    std::set<std::size_t> tasks;
    for (const std::size_t run : missing) tasks.insert(slice_of(plan.runs[run], job->slices));
    text += fmt::format(", of job {}'s tasks {} (`squeue --job {}` tells whether they run; logs: {})",
                        job->id, fmt::join(tasks, ", "), job->id, (job->folder / "task-K.log").string());
  }
  return text + fmt::format("; `{}` makes them here, --slurm there", plan.command);
}

}  // namespace ramify::cli
