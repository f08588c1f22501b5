#include "cli/experiment/process_pool.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cstring>
#include <thread>
#include <utility>

#include "common/base/memory.h"

namespace ramify::cli {
namespace {

constexpr int kPollMilliseconds = 50;  // between two looks at memory and Ctrl-C

}  // namespace

ProcessPool::ProcessPool(PoolOptions options, std::uint64_t first_guess)
    : options_(std::move(options)), most_(process_count(options_.processes)), first_guess_(first_guess) {}

void ProcessPool::expect(std::uint64_t bytes) {
  expected_ = std::max(expected_, bytes);
}

void ProcessPool::work(const std::function<void(double)>& report) {
  while (!waiting_.empty() || !workers_.empty()) {
    if (options_.stop.stop_requested()) return end_all();
    look_at_memory();
    while (may_start()) {
      Task task = std::move(waiting_.front());
      waiting_.pop_front();
      Process process = task.start();
      workers_.push_back({std::move(process), std::move(task)});
    }
    gather_ended();
    report(running());
  }
}

void ProcessPool::look_at_memory() {
  held_.clear();
  for (const Worker& worker : workers_) {
    const ProcessMemory memory = process_memory(worker.process.id());
    held_.push_back(memory.now);
    expect(memory.peak);
  }
}

bool ProcessPool::may_start() {
  if (waiting_.empty() || workers_.size() >= most_) return false;
  if (workers_.empty()) return true;  // what does not fit alone fails alone
  held_.resize(workers_.size(), 0);   // those that have only just begun
  const std::uint64_t expected = has_finished_ ? expected_ : std::max(expected_, first_guess_);
  return fits_beside(held_, expected, available_memory());
}

void ProcessPool::gather_ended() {
  std::vector<pollfd> files;
  for (const Worker& worker : workers_) files.push_back({worker.process.errors_file(), POLLIN, 0});
  if (poll(files.data(), files.size(), kPollMilliseconds) <= 0) return;
  for (std::size_t i = files.size(); i-- > 0;) {
    if (files[i].revents == 0 || workers_[i].process.read_errors()) continue;
    const ProcessEnd end = workers_[i].process.wait();
    const Task task = std::move(workers_[i].task);
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    has_finished_ = true;
    if (task.ended) task.ended(end);
  }
}

double ProcessPool::running() const {
  double sum = 0.0;
  for (const Worker& worker : workers_) {
    sum += worker.task.count * std::min(static_cast<double>(worker.process.output_size()) / 100.0, 1.0);
  }
  return sum;
}

void ProcessPool::end_all() {
  for (Worker& worker : workers_) worker.process.stop();
  for (Worker& worker : workers_) worker.process.wait();
  workers_.clear();
  waiting_.clear();
}

std::size_t process_count(int processes) {
  return processes > 0 ? static_cast<std::size_t>(processes)
                       : std::max(1u, std::thread::hardware_concurrency());
}

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

}  // namespace ramify::cli
