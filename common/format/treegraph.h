// The table of cylinders of Treegraph and of the R package aRchi. Metres, +Z up.
#pragma once

#include "common/format/cylinders.h"
#include "common/format/text_table.h"

namespace ramify {

/// True for a header with cyl_ID.
bool is_treegraph(const TextTable& table);

/// The rows of such a table; axes are those of axis_ID, or by width where that column is missing. Throws
/// InputError naming the line.
Cylinders read_treegraph(TextTable& table);

}  // namespace ramify
