// What is to be drawn, and how a picture of it is wanted.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/color.h"
#include "common/base/geometry.h"
#include "viewer/camera.h"

namespace ramify {

struct Mesh;
struct Skeleton;
struct SkyLight;

enum class RenderStyle {
  lit,        // sun, sky, shadow and ground
  schematic,  // silhouette on white, as the papers print trees
  skeleton,   // a line an internode
};

struct RenderOptions {
  int width = 1024;
  int height = 1024;
  ViewDirection view;
  std::optional<CloseUp> close_up;  // else all of the scene is in the picture
  RenderStyle style = RenderStyle::lit;
  std::optional<Color> background;  // else a sky if lit, white otherwise
  std::string color_by;       // an attribute (attribute_colors.h); empty: bark if lit, black if schematic
  std::optional<Color> tint;  // all of the tree in this one, whatever color_by says
  std::span<const Vec3f> room_for;  // points in the picture besides the scene's: one scale for several scenes
  bool obstacles_take_room = true;  // those near the tree; else room_for has to see to it
  bool with_scale = false;          // a bar with its length and a human figure beside the tree
  bool with_occlusion = true;       // lit: the sky's light and the sun's are kept out; without, drawn sooner
};

struct Scene {
  const Mesh* mesh = nullptr;           // null is drawn as an empty one
  const Skeleton* skeleton = nullptr;   // null for a mesh read from a file
  const SkyLight* sky = nullptr;        // of the mesh, where it was made before; null: made when it is needed
  const Mesh* obstacles = nullptr;      // what stands in the tree's way; null: nothing
  std::span<const Vec3f> outline = {};  // outline_of() the mesh, where it is known: spares walking through it
};

/// Points that take up as much room as all of them do, from any side, to half a percent of their box or so;
/// along the axes exactly. All, if they are not many. O(points).
std::vector<Vec3f> outline_of(std::span<const Vec3f> points);

/// The scene's own, else all of the mesh's points.
std::span<const Vec3f> outline_of(const Scene& scene);

/// Where the tree stands: the lowest root node or, without a skeleton, the middle of the mesh's underside;
/// the origin for an empty scene. The ground is level with it.
Vec3 base_of(const Scene& scene);

/// What of the scene's obstacles a picture of the tree is to show: as much as is near it. `tree` is around
/// the tree; empty if there is none or it is far away.
Box obstacle_room(const Mesh& obstacles, const Box& tree);
Box obstacle_room(const Box& obstacles, const Box& tree);

/// Whether the mesh has colours or images of its own, to be shown as they are.
bool shows_materials(const Mesh& mesh);

/// The colour of each vertex in the style lit or schematic: by attribute, else black or the mesh's own, white
/// where it has images alone; bark by the width (leaves green) where it has none of these. Throws InputError
/// if color_by names what the scene's skeleton lacks, or there is no skeleton.
std::vector<ColorBytes> vertex_colors(const Scene& scene, const RenderOptions& options);

/// The colour of each skeleton node in the style skeleton; by order if color_by is empty. Throws InputError.
std::vector<ColorBytes> node_colors(const Scene& scene, const RenderOptions& options);

}  // namespace ramify
