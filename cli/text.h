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

/// Three digits; from 1,000 on whole numbers, grouped.
std::string short_number(double value);

/// "12 times the spread", or in short "12 x"; of an infinite factor "whatever the seed".
std::string factor_text(double factor, bool in_words);

/// A word of a command line as a shell takes it, in quotes only if it must be.
std::string shell_quoted(const std::string& word);

/// A cell of a CSV file, quoted if it must be (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace ramify::cli
