// SimpleForest's table of cylinders (J. Hackenberg et al., SimpleForest, a plugin of Computree), as rTwig
// reads it too. Metres, +Z up.
#pragma once

#include <iosfwd>
#include <string>

#include "common/format/cylinders.h"
#include "common/format/text_table.h"

namespace ramify {

/// True for a header with the columns of segments or of growth lengths, which no other table has.
bool is_simpleforest(const TextTable& table);

/// The rows of such a table; axes are maximal chains of equal branchOrder, which may be missing. Throws
/// InputError naming the line.
Cylinders read_simpleforest(TextTable& table);

/// All columns, those of segments too; a cylinder has the volume of the truncated cone it stands for, and
/// what only a point cloud could tell (averagePointDistance) is empty. Several trees stand one after another.
void write_simpleforest(const Skeleton& skeleton, std::ostream& out);

}  // namespace ramify
