#include "cli/experiment/sweep_pool.h"

#include <utility>

#include "cli/experiment/run_folder.h"

namespace ramify::cli {
namespace {

// What a run is taken to need before one has been seen; a tree of 600,000 internodes takes less.
constexpr std::uint64_t kFirstGuess = 256ull << 20;  // bytes

class RunMaker {
 public:
  RunMaker(const SweepPlan& plan, const std::filesystem::path& runs, const PoolOptions& options)
      : plan_(plan), runs_(runs), pool_(options, kFirstGuess) {}

  void add(const Batch& batch) { pool_.add(task_of(batch)); }

  void work(const std::function<void(double)>& report) {
    pool_.work([&](double running) { report(made_ + running); });
  }

 private:
  Task task_of(const Batch& batch) {
    return {[this, batch] { return start(batch); },
            [this, batch](const ProcessEnd& end) { finish(batch, end); }, static_cast<double>(batch.size())};
  }

  Process start(const Batch& batch) const {
    std::vector<std::string> arguments = {kThisProgram,   "sweep-run", "/dev/stdin", "-o",
                                          runs_.string(), "--threads", "1"};
    for (std::size_t i = 0; i + 1 < batch.size(); ++i) {
      arguments.push_back("--at-step");
      arguments.push_back(std::to_string(plan_.runs[batch[i]].steps));
    }
    // The program that runs is there.
    return *Process::start(arguments, MemoryFile(plan_.runs[batch.back()].config));
  }

  void finish(Batch batch, const ProcessEnd& end) {
    if (end.code == 0) {
      for (const std::size_t run : batch) expect(run);
      made_ += static_cast<double>(batch.size());
      return;
    }
    // Those of fewer steps may well succeed.
    write_failure(runs_, plan_.runs[batch.back()].name, failure_of(end));
    made_ += 1.0;
    batch.pop_back();
    if (!batch.empty()) pool_.add_first(task_of(batch));
  }

  void expect(std::size_t run) {
    const auto record = read_run(runs_, plan_.runs[run].name, plan_.runs[run].config);
    if (record) pool_.expect(record->peak_memory_bytes);
  }

  const SweepPlan& plan_;
  const std::filesystem::path& runs_;
  ProcessPool pool_;
  double made_ = 0.0;
};

}  // namespace

void make_batches(const SweepPlan& plan, const std::vector<Batch>& batches, const std::filesystem::path& runs,
                  const PoolOptions& options, const std::function<void(double made)>& report) {
  RunMaker maker(plan, runs, options);
  for (const Batch& batch : batches) maker.add(batch);
  maker.work(report);
}

}  // namespace ramify::cli
