// Child processes, as many at a time as threads and memory allow.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/experiment/process.h"

namespace ramify::cli {

struct PoolOptions {
  int processes = 0;  // at a time; 0: as many as there are cores
  std::stop_token stop;
};

/// Something that a process of its own does.
struct Task {
  std::function<Process()> start;
  std::function<void(const ProcessEnd&)> ended = {};  // may put more tasks into the pool
  double count = 0.0;                                 // of what it makes, for progress
};

class ProcessPool {
 public:
  /// `first_guess`: bytes that a process is taken to need before one has been seen.
  ProcessPool(PoolOptions options, std::uint64_t first_guess);

  void add(Task task) { waiting_.push_back(std::move(task)); }
  void add_first(Task task) { waiting_.push_front(std::move(task)); }

  /// That a process may need so many bytes: of those that end soon nothing is seen while they run.
  void expect(std::uint64_t bytes);

  /// Starts the tasks in their order and returns when all have ended; no more at a time than fit into the
  /// memory that the machine has left, going by the largest that was seen so far. `report(running)`, called
  /// some twenty times a second, tells how much of the counts of those at work is done: a child says so by
  /// writing to stdout, a byte for each hundredth. After a stop all are ended; those that wait are forgotten
  /// and nothing is called. Throws RunError if a process cannot be started.
  void work(const std::function<void(double running)>& report);

 private:
  struct Worker {
    Process process;
    Task task;
  };

  void look_at_memory();
  bool may_start();
  void gather_ended();
  double running() const;
  void end_all();

  PoolOptions options_;
  std::deque<Task> waiting_;
  std::size_t most_ = 1;
  std::vector<Worker> workers_;
  std::vector<std::uint64_t> held_;  // by the workers, bytes
  std::uint64_t first_guess_;
  std::uint64_t expected_ = 0;  // the most that any process held, bytes
  bool has_finished_ = false;
};

/// `processes` as in PoolOptions, counted.
std::size_t process_count(int processes);

/// Why a process of this program failed, in one line: the last that it said.
std::string failure_of(const ProcessEnd& end);

// Ours whatever its name, and the same even if it is built anew meanwhile.
inline constexpr const char* kThisProgram = "/proc/self/exe";

}  // namespace ramify::cli
