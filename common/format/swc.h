// Skeletons as SWC, the format of traced neurons (R. C. Cannon et al. 1998; standardized by the INCF).
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/provenance.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// One row a node, numbered from 1, parents first: id type x y z radius parent, type 1 for a root and 16 +
/// branchOrder for the rest; metres, +Y up. `provenance` stands in comments, with the config.
void write_swc(const Skeleton& skeleton, const std::optional<Provenance>& provenance, std::ostream& out);

/// Reads rows of any types in any order. Axes are maximal chains of equal type if all nodes but the roots
/// have a type of at least 16, else they go by width; orders are counted. `text` is the file's content,
/// `name` what to call it in messages. Throws InputError naming the line.
Skeleton read_swc(std::string_view text, const std::string& name);

}  // namespace ramify
