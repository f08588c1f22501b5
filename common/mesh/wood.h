// What the mesh methods that sweep rings along branches have in common.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/mesh/mesh.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// A mesh with room for so many vertices and triangles of bark, to be filled in place; without triangles it
/// has no material. Nothing of `memory` stays but its memory.
Mesh wood_of_size(std::size_t vertices, std::size_t triangles, Mesh memory = {});

/// Makes all triangles bark; a mesh without triangles stays without material.
void finish_wood(Mesh& mesh);

/// Sides of a tube that is `diameter` thick in a tree whose thickest wood is `greatest`: in proportion to the
/// root of the width, so that the error of the silhouette is spread evenly.
std::uint32_t side_count(double diameter, double greatest, const MesherOptions& options);

/// Bands that a cone is parted into, evenly: a side of one that tapers much is no rectangle, and its two
/// triangles would squeeze and widen what lies on it.
std::uint32_t bands_of_taper(double base_radius, double radius);

/// Of the thickest wood: on thinner wood nobody sees that.
constexpr double kThickTaper = 0.1;

/// Points of the unit circle of so many sides, at most 128, one a side. O(1) after the first call.
const Vec2f* unit_circle(std::uint32_t sides);

/// Metres; wood that is thinner is drawn as thick as this, since float positions could not keep its sides
/// apart.
double thinnest_radius(const Skeleton& skeleton);
double thinnest_radius(double farthest);  // the greatest coordinate, metres

}  // namespace ramify
