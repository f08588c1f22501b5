// A parameter that may change in the course of a tree's life, or along its branches.
#pragma once

#include <utility>
#include <vector>

namespace ramify {

/// Piecewise linear in the step (or whatever else the table's row names), constant before the first and after
/// the last point. A constant is one point.
class Schedule {
 public:
  Schedule(double constant) : points_{{0.0, constant}} {}  // NOLINT: a number is a schedule
  /// `points` are (step, value), steps rising, at least one.
  explicit Schedule(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {}

  double at(double step) const {
    if (step <= points_.front().first) return points_.front().second;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const auto& [step0, value0] = points_[i - 1];
      const auto& [step1, value1] = points_[i];
      if (step < step1) return value0 + (value1 - value0) * (step - step0) / (step1 - step0);
    }
    return points_.back().second;
  }

  bool is_constant() const { return points_.size() == 1; }
  const std::vector<std::pair<double, double>>& points() const { return points_; }

 private:
  std::vector<std::pair<double, double>> points_;
};

}  // namespace ramify
