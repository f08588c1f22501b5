#include "common/mesh/watertight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/errors.h"
#include "common/mesh/bark_charts.h"
#include "common/mesh/closed_surface.h"
#include "common/mesh/thin_tubes.h"
#include "common/mesh/touched_leaves.h"
#include "common/mesh/wood.h"
#include "common/mesh/wood_field.h"

namespace ramify {
namespace {

// The thinnest twig is so many voxels thick where nothing else is asked for: enough to look round.
constexpr double kVoxelsWanted = 3.0;

// Twigs of a thousandth of the trunk's width do not choose the voxel size.
constexpr double kFinestShare = 1e-3;

constexpr int kHalvings = 40;

// A level of detail has a third of the triangles of the one before; they are as many as voxels' faces.
constexpr double kLessEachLevel = 3.0;

// At least so many, of thick wood: from here on a budget is sought with coarser voxels, in steps.
constexpr double kTrianglesAVoxel = 0.1;
constexpr double kLeastStep = 1.05;

double cone_volume(double length, double a, double b) {
  return std::numbers::pi / 3.0 * length * (a * a + a * b + b * b);
}

double wood_volume(const Skeleton& skeleton, std::size_t internode) {
  return cone_volume(skeleton.length(internode), skeleton.start_radius(internode),
                     0.5 * skeleton.diameter[internode]);
}

/// Voxels within the band around an internode's surface.
double band_voxels(const Skeleton& skeleton, std::size_t internode, double voxel_size) {
  const double band = kBandVoxels * voxel_size;
  const double base = skeleton.start_radius(internode);
  const double tip = 0.5 * skeleton.diameter[internode];
  const double length = skeleton.length(internode);
  const double shell = cone_volume(length, base + band, tip + band) -
                       cone_volume(length, std::max(base - band, 0.0), std::max(tip - band, 0.0));
  return shell / (voxel_size * voxel_size * voxel_size);
}

/// Metres, of the thickest internode that starts at a root.
double trunk_diameter(const Skeleton& skeleton) {
  double greatest = 0.0;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (skeleton.is_root(node) || !skeleton.is_root(skeleton.parent[node])) continue;
    greatest = std::max(greatest, skeleton.diameter[node]);
  }
  return greatest;
}

WatertightPlan plan_with(const Skeleton& skeleton, double voxel_size) {
  WatertightPlan plan{voxel_size, std::vector<bool>(skeleton.node_count(), false), 0.0};
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (skeleton.is_root(node)) continue;
    const std::size_t parent = skeleton.parent[node];
    const double thinnest = std::min(2.0 * skeleton.start_radius(node), skeleton.diameter[node]);
    // Rounding must not take the twig that chose the size.
    const bool is_thick = thinnest >= kVoxelsAcross * voxel_size * (1.0 - 1e-9);
    plan.is_kept[node] = is_thick && (skeleton.is_root(parent) || plan.is_kept[parent]);
    if (plan.is_kept[node]) plan.predicted_voxels += band_voxels(skeleton, node, voxel_size);
  }
  return plan;
}

/// The finest size, from `finest` up, whose level set is not too large.
WatertightPlan finest_plan(const Skeleton& skeleton, double finest, double coarsest) {
  WatertightPlan plan = plan_with(skeleton, finest);
  if (plan.predicted_voxels <= kActiveVoxelsMax) return plan;
  double low = std::log(finest);
  double high = std::log(coarsest);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const bool fits = plan_with(skeleton, std::exp(middle)).predicted_voxels <= kActiveVoxelsMax;
    (fits ? high : low) = middle;
  }
  return plan_with(skeleton, std::exp(high));
}

/// What is left out, as one line; empty if nothing is.
std::string thin_warning(const Skeleton& skeleton, const WatertightPlan& plan, const std::string& fate) {
  std::size_t thin = 0;
  double volume = 0.0;
  double whole = 0.0;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (skeleton.is_root(node)) continue;
    const double one = wood_volume(skeleton, node);
    whole += one;
    if (plan.is_kept[node]) continue;
    ++thin;
    volume += one;
  }
  if (thin == 0) return {};
  return fmt::format(
      "watertight: {} of {} internodes, {:.3g} m3 of wood ({:.2g} %), are thinner than {} voxels of {:.3g} m "
      "or "
      "grow on such: {}",
      thin, skeleton.internode_count(), volume, whole > 0.0 ? 100.0 * volume / whole : 0.0, kVoxelsAcross,
      plan.voxel_size, fate);
}

Mesh mesh_of(const Skeleton& skeleton, ClosedSurface surface) {
  Mesh mesh;
  mesh.positions = std::move(surface.positions);
  mesh.normals = std::move(surface.normals);
  mesh.internodes = std::move(surface.internodes);
  mesh.triangles = std::move(surface.triangles);
  lay_bark_charts(skeleton, mesh);
  return mesh;
}

Mesh mesh_with(const Skeleton& skeleton, const MesherOptions& options, const WatertightPlan& plan) {
  ClosedSurface surface = closed_surface(wood_field(skeleton, plan.is_kept, options.blend), plan.voxel_size,
                                         options.adaptivity * plan.voxel_size);
  Mesh mesh = mesh_of(skeleton, std::move(surface));
  std::string fate = "left out";
  if (options.thin_twigs == ThinTwigs::tubes) {
    std::vector<bool> is_thin = plan.is_kept;
    is_thin.flip();
    fate = fmt::format("kept as {} closed tubes", add_thin_tubes(skeleton, is_thin, options.sides_min, mesh));
  }
  const std::string warning = thin_warning(skeleton, plan, fate);
  if (!warning.empty()) mesh.warnings.push_back(warning);
  finish_wood(mesh);
  return mesh;
}

}  // namespace

WatertightPlan plan_watertight(const Skeleton& skeleton, const MesherOptions& options) {
  const double trunk = trunk_diameter(skeleton);
  if (!(trunk > 0.0)) throw InputError("watertight: no internode at a root has a width");
  const double coarsest = trunk / kVoxelsAcross;
  if (options.voxel_size > coarsest * (1.0 + 1e-9)) {
    throw InputError(
        fmt::format("mesher.voxel_size: {} m is too coarse for a trunk {:.4g} m thick (at most {:.4g})",
                    options.voxel_size, trunk, coarsest));
  }
  if (options.voxel_size > 0.0) {
    WatertightPlan plan = plan_with(skeleton, options.voxel_size);
    if (plan.predicted_voxels <= kActiveVoxelsMax) return plan;
    // A little more, so that what is printed of it fits as well.
    const double possible = 1.001 * finest_plan(skeleton, options.voxel_size, coarsest).voxel_size;
    throw InputError(
        fmt::format("mesher.voxel_size: {} m takes about {:.3g} million voxels, more than {:g} (at "
                    "least {:.4g}, or 0: chosen)",
                    options.voxel_size, plan.predicted_voxels / 1e6, kActiveVoxelsMax / 1e6, possible));
  }
  double thinnest = trunk;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (!skeleton.is_root(node))
      thinnest = std::min({thinnest, skeleton.diameter[node], 2.0 * skeleton.start_radius(node)});
  }
  const double finest = std::max(thinnest, kFinestShare * trunk) / kVoxelsWanted;
  return finest_plan(skeleton, finest, coarsest);
}

Mesh watertight_mesh(const Skeleton& skeleton, const MesherOptions& options) {
  if (skeleton.internode_count() == 0) return {};
  WatertightPlan plan = plan_watertight(skeleton, options);
  const double coarsest = trunk_diameter(skeleton) / kVoxelsAcross;
  const auto coarsen = [&](double factor) {
    plan = plan_with(skeleton, std::min(plan.voxel_size * factor, coarsest));
  };
  if (options.lod > 0) coarsen(std::pow(kLessEachLevel, 0.5 * options.lod));
  const double most = options.max_triangles;
  if (most > 0.0 && kTrianglesAVoxel * plan.predicted_voxels > most) {
    coarsen(std::sqrt(kTrianglesAVoxel * plan.predicted_voxels / most));
  }
  for (;;) {
    Mesh mesh = mesh_with(skeleton, options, plan);
    const auto count = static_cast<double>(mesh.triangles.size());
    if (most <= 0.0 || count <= most) return mesh;
    if (plan.voxel_size >= coarsest) {
      throw InputError(fmt::format(
          "mesher: the tree's mesh has at least {:.0f} triangles; {:.0f} are allowed by max_triangles", count,
          most));
    }
    coarsen(std::max(kLeastStep, std::sqrt(count / most)));
  }
}

}  // namespace ramify
