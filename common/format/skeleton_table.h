// The skeleton table: one row an internode, parents before children, header first. The columns are a
// contract.
#pragma once

#include <iosfwd>
#include <string>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// Columns: ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,length,branchID,branchOrder,birthStep,
/// shedStep,level,light,vigour,kind. Metres; floats read back to the same value; what a skeleton does not
/// have stays empty. IDs count from 0 in row order; internodes that start at a root have parentID -1.
void write_skeleton_table(const Skeleton& skeleton, std::ostream& out);

/// Reads a table of these columns, in any order; `text` is the file's content, `name` what to call it in
/// messages. Rows may come in any order. Internodes with parentID -1 that start at one point share a root
/// node, as wide as the widest of them. Throws InputError naming the row.
Skeleton read_skeleton_table(const std::string& text, const std::string& name);

}  // namespace ramify
