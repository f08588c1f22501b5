#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ramify::cli {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr int kBarWidth = 30;               // characters
constexpr double kRedrawSeconds = 0.1;      // faster than the eye follows
constexpr double kPlainStartSeconds = 2.0;  // short runs print nothing into a log
constexpr double kPlainIntervalSeconds = 10.0;

}  // namespace

ProgressBar::ProgressBar(bool is_quiet) : is_quiet_(is_quiet), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(const Progress& now) {
  if (is_quiet_) return;
  const Clock::time_point time = Clock::now();
  if (stage_ != now.stage) {
    stage_ = now.stage;
    stage_start_ = time;
  }
  const bool is_first = last_ == Clock::time_point{};
  const double since_last = Seconds(time - last_).count();
  const double interval = is_terminal_ ? kRedrawSeconds : kPlainIntervalSeconds;
  if (!is_terminal_ && Seconds(time - start_).count() < kPlainStartSeconds) return;
  if (!is_first && since_last < interval) return;
  last_ = time;

  const double fraction = now.total > 0 ? std::clamp(now.done / now.total, 0.0, 1.0) : 0.0;
  const double passed = Seconds(time - stage_start_).count();
  const std::string left =
      fraction > 0 && passed > 0.5 ? ", " + duration_text(passed / fraction - passed) + " left" : "";
  const std::string count =
      now.unit.empty() ? "" : fmt::format(" {} {:.0f}/{:.0f}", now.unit, now.done, now.total);
  const std::string rate =
      now.unit.empty() || passed < 0.5 ? "" : fmt::format(", {:.1f} {}s/s", now.done / passed, now.unit);
  if (is_terminal_) {
    const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
    fmt::print(stderr, "\r\033[K{} [{}{}]{}{}{}", stage_, std::string(filled, '#'),
               std::string(kBarWidth - filled, '.'), count, rate, left);
    std::fflush(stderr);
    is_shown_ = true;
  } else {
    fmt::print(stderr, "{}: {:.0f} %{}{}{}\n", stage_, 100 * fraction, count, rate, left);
  }
}

void ProgressBar::clear() {
  if (!is_shown_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  is_shown_ = false;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace ramify::cli
