#include "cli/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

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

std::string short_number(double value) {
  const double size = std::abs(value);
  if (size < 999.5 || size >= 1e18) return fmt::format("{:.3g}", value);
  return (value < 0.0 ? "-" : "") + grouped(static_cast<std::uint64_t>(std::llround(size)));
}

std::string factor_text(double factor, bool in_words) {
  if (std::isinf(factor)) return "whatever the seed";
  const std::string number = factor < 10.0 ? fmt::format("{:.1f}", factor) : short_number(std::round(factor));
  return number + (in_words ? " times the spread" : " x");
}

std::string shell_quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::strchr("-_./:=,+@%", c) != nullptr;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace ramify::cli
