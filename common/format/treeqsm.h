// TreeQSM's text export of cylinders, cylinder_*.txt (P. Raumonen et al.). Metres, +Z up.
#pragma once

#include "common/format/cylinders.h"
#include "common/format/text_table.h"

namespace ramify {

/// True for a header that names the axis' direction, or where numbers stand in its place.
bool is_treeqsm(const TextTable& table);

/// The rows of such a table, `text` being the whole file: a header's start and axis count for three numbers
/// each; without a header the order is that of the program (radius, length, start, axis, parent, extension,
/// branch, ...). A row's number is its line's, from 1. Axes are those of the column branch, or by width where
/// it is missing. Throws InputError naming the line.
Cylinders read_treeqsm(std::string_view text, const std::string& name);

}  // namespace ramify
