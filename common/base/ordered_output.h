// Long outputs formatted on all threads and written in order, a few chunks at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace ramify {

/// Calls format(begin, end, text) for ranges that together cover the rows 0 .. count - 1, and writes what
/// they append to `text` in the order of the rows: the same bytes for any number of threads. `text` has room
/// for row_bytes a row before it must grow. Memory: some megabytes, however many rows.
void write_rows(std::size_t count, std::size_t row_bytes, std::ostream& out,
                const std::function<void(std::size_t begin, std::size_t end, std::string& text)>& format);

}  // namespace ramify
