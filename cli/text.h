// Numbers and cells as people and spreadsheets read them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/analysis/metrics.h"

namespace ramify::cli {

/// Whole numbers with thousands set apart: "12,345".
std::string grouped(std::uint64_t number);

/// Four digits, counts in full, "-" where there is no value.
std::string metric_text(const MetricInfo& info, const std::optional<double>& value);

/// A cell of a CSV file, quoted if it must be (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace ramify::cli
