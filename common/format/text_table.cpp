#include "common/format/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/base/errors.h"

namespace ramify {
namespace {

// Tables of trees have about twenty; a line of commas alone must not take sixteen times its size.
constexpr std::size_t kMostColumns = 1000;

constexpr std::size_t kMostShown = 40;

template <class T>
std::optional<T> finite(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

std::string shown(std::string_view text) {
  std::string result(text.substr(0, kMostShown));
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > kMostShown ? result + "..." : result;
}

std::optional<double> finite_number(std::string_view text) {
  return finite<double>(text);
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  // Above 2^53 a double no longer tells neighbours apart.
  const std::optional<double> number = finite_number(text);
  if (!number || std::abs(*number) > 0x1p53 || *number != std::trunc(*number)) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

TextTable::TextTable(std::string_view text, const std::string& name, bool has_header)
    : text_(without_mark(text)), name_(name) {
  std::string_view rest = text_;
  const std::string_view header = next_line(rest);
  if (header.find('\t') != std::string_view::npos) separator_ = '\t';
  split(header);
  if (cells_.size() > kMostColumns) {
    fail(fmt::format("more than {} columns: no table of a tree", kMostColumns));
  }
  columns_ = cells_;
  if (has_header) {
    text_ = rest;
  } else {
    line_ = 0;
  }
}

void TextTable::split(std::string_view line) {
  cells_.clear();
  if (separator_ == '\t' && !line.empty() && line.back() == '\t') line.remove_suffix(1);
  while (cells_.size() <= kMostColumns) {
    const std::size_t end = line.find(separator_);
    cells_.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line = line.substr(end + 1);
  }
}

std::optional<std::size_t> TextTable::column(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t TextTable::required_column(std::string_view name, const std::string& hint) const {
  const std::optional<std::size_t> place = column(name);
  if (!place) throw InputError(fmt::format("{}:1: no column '{}' ({})", name_, name, hint));
  return *place;
}

bool TextTable::next_row(std::size_t width) {
  if (width == 0) width = columns_.size();
  while (!text_.empty()) {
    const std::string_view line = next_line(text_);
    ++line_;
    if (trimmed(line).empty()) continue;
    split(line);
    if (cells_.size() != width)
      fail(fmt::format("{}{} cells (the header has {})", cells_.size() > kMostColumns ? "more than " : "",
                       std::min(cells_.size(), kMostColumns), width));
    return true;
  }
  return false;
}

double TextTable::number(std::size_t column, std::string_view label) const {
  const std::optional<double> value = finite_number(cell(column));
  if (!value) fail(fmt::format("{}: '{}' is no finite number", label, shown(cell(column))));
  return *value;
}

float TextTable::float_number(std::size_t column, std::string_view label) const {
  const std::optional<float> value = finite<float>(cell(column));
  if (!value) fail(fmt::format("{}: '{}' is no finite number", label, shown(cell(column))));
  return *value;
}

std::int64_t TextTable::whole(std::size_t column, std::string_view label) const {
  const std::optional<std::int64_t> value = whole_number(cell(column));
  if (!value) fail(fmt::format("{}: '{}' is no whole number in range", label, shown(cell(column))));
  return *value;
}

Vec3 TextTable::point(const std::array<std::size_t, 3>& columns,
                      const std::array<std::string_view, 3>& labels) const {
  return {number(columns[0], labels[0]), number(columns[1], labels[1]), number(columns[2], labels[2])};
}

double TextTable::positive(std::size_t column, std::string_view label) const {
  const double value = number(column, label);
  if (!(value > 0)) fail(fmt::format("{}: {} (must be greater than 0)", label, value));
  return value;
}

void TextTable::fail(const std::string& problem) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line_, problem));
}

}  // namespace ramify
