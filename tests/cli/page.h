// The pages that commands write, as a browser would read them.
#pragma once

#include <cstddef>
#include <string>

namespace ramify::test {

/// Checks that a page is well-formed, needs no other file, and that its links lead to places that it has;
/// returns how many pictures it shows.
std::size_t check_page(const std::string& html);

/// How often `part` stands in a text.
std::size_t count_of(const std::string& text, const std::string& part);

/// Whether there is a gnuplot, without which pages have no plots.
bool has_gnuplot();

}  // namespace ramify::test
