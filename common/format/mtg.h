// Skeletons as a multiscale tree graph, the text format of OpenAlea and AMAPmod (C. Godin, Y. Caraglio,
// A multiscale model of plant topological structures, J. Theor. Biol. 191, 1998).
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "common/format/up_axis.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Plants P of axes A of internodes I, with Length, TopDiameter and the top's XX YY ZZ; metres, +Z up. A root
/// node is a plant's first internode, of length 0. Numbers have no exponent, which the format could not read.
void write_mtg(const Skeleton& skeleton, std::ostream& out);

/// Reads the entities of the finest scale, whatever their classes are called; coarser ones only say what
/// belongs together. Each needs XX, YY, ZZ and TopDiameter. A plant's first entity is its root node if its
/// Length is 0; else the root is that Length below its top along `up`. Nodes stand as in the file, each
/// branch before what follows on its axis; coordinates are the file's. Throws InputError naming the line.
Skeleton read_mtg(std::string_view text, const std::string& name, UpAxis up);

}  // namespace ramify
