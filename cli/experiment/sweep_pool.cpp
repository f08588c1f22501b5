#include "cli/experiment/sweep_pool.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <thread>

#include "cli/experiment/process.h"
#include "cli/experiment/run_folder.h"
#include "common/base/memory.h"

namespace ramify::cli {
namespace {

// What a run is taken to need before one has been seen; a tree of 600,000 internodes takes less.
constexpr std::uint64_t kFirstGuess = 256ull << 20;  // bytes

constexpr int kPollMilliseconds = 50;  // between two looks at memory and Ctrl-C

// Ours whatever its name, and the same even if it is built anew meanwhile.
constexpr const char* kThisProgram = "/proc/self/exe";

struct Worker {
  Process process;
  Batch batch;
};

Process start(const SweepPlan& plan, const Batch& batch, const PoolOptions& options) {
  std::vector<std::string> arguments = {kThisProgram,          "sweep-run", "/dev/stdin", "-o",
                                        options.runs.string(), "--threads", "1"};
  for (std::size_t i = 0; i + 1 < batch.size(); ++i) {
    arguments.push_back("--at-step");
    arguments.push_back(std::to_string(plan.runs[batch[i]].steps));
  }
  // The program that runs is there.
  return *Process::start(arguments, plan.runs[batch.back()].config);
}

/// Why a process failed, in one line: the last that it said.
std::string failure_of(const ProcessEnd& end) {
  if (end.code > 128 && end.code != 130) {
    const int signal = end.code - 128;
    return fmt::format("ended by signal {} ({}){}", signal, strsignal(signal),
                       signal == 9 ? "; perhaps there was too little memory" : "");
  }
  std::string text = end.errors.substr(0, end.errors.find_last_not_of('\n') + 1);
  text = text.substr(text.rfind('\n') + 1);
  constexpr std::string_view kPrefix = "ramify: ";
  if (text.rfind(kPrefix, 0) == 0) text = text.substr(kPrefix.size());
  return text.empty() ? fmt::format("ended with exit code {}", end.code) : text;
}

class Pool {
 public:
  Pool(const SweepPlan& plan, std::vector<Batch> batches, const PoolOptions& options)
      : plan_(plan), waiting_(batches.begin(), batches.end()), options_(options) {
    most_ = options.processes > 0 ? static_cast<std::size_t>(options.processes)
                                  : std::max(1u, std::thread::hardware_concurrency());
  }

  void work(const std::function<void(std::size_t)>& report) {
    while (!waiting_.empty() || !workers_.empty()) {
      if (options_.stop.stop_requested()) return end_all();
      look_at_memory();
      while (may_start()) {
        workers_.push_back({start(plan_, waiting_.front(), options_), waiting_.front()});
        waiting_.pop_front();
      }
      gather_ended();
      report(made_);
    }
  }

 private:
  void look_at_memory() {
    held_.clear();
    for (const Worker& worker : workers_) {
      const ProcessMemory memory = process_memory(worker.process.id());
      held_.push_back(memory.now);
      expected_ = std::max(expected_, memory.peak);
    }
  }

  bool may_start() {
    if (waiting_.empty() || workers_.size() >= most_) return false;
    if (workers_.empty()) return true;  // what does not fit alone fails alone
    held_.resize(workers_.size(), 0);   // those that have only just begun
    const std::uint64_t expected = has_finished_ ? expected_ : std::max(expected_, kFirstGuess);
    return fits_beside(held_, expected, available_memory());
  }

  void gather_ended() {
    std::vector<pollfd> files;
    for (const Worker& worker : workers_) files.push_back({worker.process.errors_file(), POLLIN, 0});
    if (poll(files.data(), files.size(), kPollMilliseconds) <= 0) return;
    for (std::size_t i = files.size(); i-- > 0;) {
      if (files[i].revents == 0 || workers_[i].process.read_errors()) continue;
      const ProcessEnd end = workers_[i].process.wait();
      Batch batch = std::move(workers_[i].batch);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      finish(std::move(batch), end);
    }
  }

  void finish(Batch batch, const ProcessEnd& end) {
    has_finished_ = true;
    if (end.code == 0) {
      for (const std::size_t run : batch) expect_largest(run);
      made_ += batch.size();
      return;
    }
    // Those of fewer steps may well succeed.
    write_failure(options_.runs, plan_.runs[batch.back()].name, failure_of(end));
    ++made_;
    batch.pop_back();
    if (!batch.empty()) waiting_.push_front(std::move(batch));
  }

  /// Of short runs nothing is seen while they run.
  void expect_largest(std::size_t run) {
    const auto record = read_run(options_.runs, plan_.runs[run].name, plan_.runs[run].config);
    if (record) expected_ = std::max(expected_, record->peak_memory_bytes);
  }

  void end_all() {
    for (Worker& worker : workers_) worker.process.stop();
    for (Worker& worker : workers_) worker.process.wait();
    workers_.clear();
  }

  const SweepPlan& plan_;
  std::deque<Batch> waiting_;
  const PoolOptions& options_;
  std::size_t most_ = 1;
  std::vector<Worker> workers_;
  std::vector<std::uint64_t> held_;  // by the workers, bytes
  std::uint64_t expected_ = 0;       // the most that any run held, bytes
  bool has_finished_ = false;
  std::size_t made_ = 0;
};

}  // namespace

void make_batches(const SweepPlan& plan, std::vector<Batch> batches, const PoolOptions& options,
                  const std::function<void(std::size_t made)>& report) {
  Pool(plan, std::move(batches), options).work(report);
}

}  // namespace ramify::cli
