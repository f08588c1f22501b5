// Text tables: a header that names columns, then one row a line. What all readers of tables share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

/// Without blanks, tabs, carriage returns and a pair of double quotes around it.
std::string_view trimmed(std::string_view text);

/// Cuts the next line off `text`, its carriage return and line feed too.
std::string_view next_line(std::string_view& text);

/// Without a byte order mark.
std::string_view without_mark(std::string_view text);

/// What a message shows of a file's bytes: at most 40 of them, '?' for what is not printable.
std::string shown(std::string_view text);

/// All of `text` as a finite number; empty if it is none.
std::optional<double> finite_number(std::string_view text);

/// All of `text` as a whole number, which may be written with a fraction of 0 ("12.000"); empty if it is
/// none.
std::optional<std::int64_t> whole_number(std::string_view text);

/// Reads a table row by row. `text` must outlive it, and so must `name`, the file's in messages.
class TextTable {
 public:
  /// Reads the header, or with `has_header` false only looks at the first row. Cells are separated by tabs if
  /// the first line has any, else by commas; an empty cell after a line's last tab is none. Throws InputError
  /// if there are more columns than any table of trees has.
  TextTable(std::string_view text, const std::string& name, bool has_header = true);

  /// The first line's cells, trimmed.
  const std::vector<std::string_view>& columns() const { return columns_; }

  /// Where the column called `name` stands; empty if there is none.
  std::optional<std::size_t> column(std::string_view name) const;

  /// Where the column called `name` stands. Throws InputError if there is none, saying `hint`.
  std::size_t required_column(std::string_view name, const std::string& hint) const;

  /// Goes on to the next row that is not empty; false after the last. Throws InputError unless the row has
  /// `width` cells (0: as many as the header).
  bool next_row(std::size_t width = 0);

  /// The line that was read last, from 1.
  std::size_t line() const { return line_; }

  std::string_view cell(std::size_t column) const { return cells_[column]; }

  /// Throw InputError naming `label`, the column's name, if the cell is no such number.
  double number(std::size_t column, std::string_view label) const;
  float float_number(std::size_t column, std::string_view label) const;
  std::int64_t whole(std::size_t column, std::string_view label) const;
  /// Three columns as a point.
  Vec3 point(const std::array<std::size_t, 3>& columns, const std::array<std::string_view, 3>& labels) const;
  /// A number greater than 0.
  double positive(std::size_t column, std::string_view label) const;

  /// Throws InputError: "FILE:LINE: problem".
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void split(std::string_view line);

  std::string_view text_;
  const std::string& name_;
  char separator_ = ',';
  std::size_t line_ = 1;
  std::vector<std::string_view> columns_;
  std::vector<std::string_view> cells_;
};

}  // namespace ramify
