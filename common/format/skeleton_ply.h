// Skeletons as binary PLY, .skel.ply: everything a skeleton holds, exactly.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/provenance.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Little-endian. Vertices are nodes: x y z diameter axis order kind (0 stem, 1 root), what else the skeleton
/// has of birth_step shed_step level light vigour, and its channels as `channel.NAME`; edges are internodes,
/// vertex1 the parent. The pipe model and `provenance` stand in comments, the config line by line.
void write_skeleton_ply(const Skeleton& skeleton, const std::optional<Provenance>& provenance,
                        std::ostream& out);

struct SkeletonPly {
  Skeleton skeleton;
  std::optional<Provenance> provenance;
};

/// Reads what write_skeleton_ply() writes, properties in any order and of any number type; without axis or
/// order axes go by width. `bytes` is the file's content, `name` what to call it in messages. Takes memory in
/// proportion to `bytes`, whatever its header claims. Throws InputError.
SkeletonPly read_skeleton_ply(std::string_view bytes, const std::string& name);

/// The provenance in the comments of a PLY header; empty if the file is none of ours. `bytes` may end after
/// the header.
std::optional<Provenance> ply_provenance(std::string_view bytes);

}  // namespace ramify
