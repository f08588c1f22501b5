#include "cli/text.h"

#include <fmt/format.h>

namespace ramify::cli {

std::string grouped(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) result += ',';
    result += digits[i];
  }
  return result;
}

std::string metric_text(const MetricInfo& info, const std::optional<double>& value) {
  if (!value) return "-";
  return info.is_count ? grouped(static_cast<std::uint64_t>(*value)) : fmt::format("{:.4g}", *value);
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace ramify::cli
