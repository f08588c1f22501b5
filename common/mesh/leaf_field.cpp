#include "common/mesh/leaf_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ramify {
namespace {

// Of a zone's radius: from here on the blend fades.
constexpr float kFade = 0.5f;

constexpr float kFar = 1e30f;
constexpr float kTiny = 1e-12f;

// Distances in floats are off by less, in voxels.
constexpr float kRounding = 1e-2f;

}  // namespace

/// Of a group of cones, for each point of a batch.
struct alignas(64) LeafField::Nearest {
  Lane value;
  Lane slope_x, slope_y, slope_z;
  std::array<std::uint32_t, kBatch> internode;
};

void LeafField::reset(const FieldItems& items, std::span<const std::uint32_t> touching, const Vec3& center,
                      double voxel_size) {
  global_.clear();
  for (const std::uint32_t item : touching) {
    if (items.is_cone(item)) {
      global_.push_back(item);
      continue;
    }
    const ForkBlend& fork = items.fork(item);
    global_.insert(global_.end(), fork.cones.begin(), fork.cones.end());
    global_.insert(global_.end(), fork.others.begin(), fork.others.end());
  }
  std::sort(global_.begin(), global_.end());
  global_.erase(std::unique(global_.begin(), global_.end()), global_.end());

  const auto voxels = [&](double metres) { return static_cast<float>(metres / voxel_size); };
  cones_.clear();
  for (const std::uint32_t index : global_) {
    const RoundCone& cone = items.cone(index);
    const Vec3f cut_at((cone.cut_at - center) / voxel_size);
    cones_.push_back({Vec3f((cone.base - center) / voxel_size), Vec3f(cone.along), voxels(cone.length),
                      voxels(cone.base_radius), static_cast<float>(cone.sine),
                      static_cast<float>(cone.sine / cone.cosine), Vec3f(cone.cut),
                      glm::dot(cut_at, Vec3f(cone.cut)), cone.cut != Vec3(0.0), cone.internode});
  }
  blend_count_ = 0;
  const auto local = [&](std::uint32_t index) {
    const auto found = std::lower_bound(global_.begin(), global_.end(), index);
    return static_cast<std::uint32_t>(found - global_.begin());
  };
  for (const std::uint32_t item : touching) {
    if (items.is_cone(item)) continue;
    const ForkBlend& fork = items.fork(item);
    if (blend_count_ == blends_.size()) blends_.emplace_back();
    Blend& one = blends_[blend_count_++];
    one.center = Vec3f((fork.center - center) / voxel_size);
    one.zone = voxels(fork.zone);
    one.width = voxels(fork.width);
    one.cut = Vec3f(fork.cut);
    one.cut_offset =
        fork.cut != Vec3(0.0) ? glm::dot(Vec3f((fork.cut_at - center) / voxel_size), one.cut) : -kFar;
    one.cones.resize(fork.cones.size());
    one.others.resize(fork.others.size());
    std::transform(fork.cones.begin(), fork.cones.end(), one.cones.begin(), local);
    std::transform(fork.others.begin(), fork.others.end(), one.others.begin(), local);
  }
}

inline LeafField::Foot LeafField::foot_of(const Cone& cone, float x, float y, float z) {
  x -= cone.base.x;
  y -= cone.base.y;
  z -= cone.base.z;
  const float axial = x * cone.along.x + y * cone.along.y + z * cone.along.z;
  const float rx = x - cone.along.x * axial;
  const float ry = y - cone.along.y * axial;
  const float rz = z - cone.along.z * axial;
  const float radial2 = rx * rx + ry * ry + rz * rz;
  float at = axial - std::sqrt(radial2) * cone.tangent;
  at = at > 0.0f ? at : 0.0f;
  at = at < cone.length ? at : cone.length;
  const float rest = axial - at;
  const float apart = std::sqrt(radial2 + rest * rest);
  return {x - cone.along.x * at, y - cone.along.y * at, z - cone.along.z * at, apart,
          apart - cone.base_radius + at * cone.sine};
}

void LeafField::focus(const Vec3f& place, float radius) {
  radius += kRounding;
  distances_.resize(cones_.size());
  float nearest = kFar;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    const float round = foot_of(cone, place.x, place.y, place.z).value;
    distances_[i] = cone.has_cut ? std::max(round, cone.cut_offset - glm::dot(place, cone.cut)) : round;
    nearest = std::min(nearest, distances_[i]);
  }
  near_cones_.clear();
  for (std::uint32_t i = 0; i < cones_.size(); ++i) {
    if (distances_[i] <= nearest + 2.0f * radius) near_cones_.push_back(i);
  }
  const auto least_of = [&](const std::vector<std::uint32_t>& cones) {
    float least = kFar;
    for (const std::uint32_t i : cones) least = std::min(least, distances_[i]);
    return least;
  };
  const auto keep = [&](const std::vector<std::uint32_t>& from, float limit, std::vector<std::uint32_t>& to) {
    to.clear();
    for (const std::uint32_t i : from) {
      if (distances_[i] <= limit) to.push_back(i);
    }
  };
  float deepest = 0.0f;
  near_blend_count_ = 0;
  for (std::size_t i = 0; i < blend_count_; ++i) {
    const Blend& fork = blends_[i];
    const float depth = static_cast<float>(kBlendDepth) * fork.width;
    if (glm::length(place - fork.center) >= fork.zone + radius) continue;
    const float a = least_of(fork.cones);
    const float b = least_of(fork.others);
    if (std::abs(a - b) >= fork.width + 2.0f * radius) continue;
    if (std::min(a, b) > nearest + 2.0f * radius + depth) continue;
    if (near_blend_count_ == near_blends_.size()) near_blends_.emplace_back();
    Blend& one = near_blends_[near_blend_count_++];
    one.center = fork.center;
    one.zone = fork.zone;
    one.width = fork.width;
    one.cut = fork.cut;
    one.cut_offset = fork.cut_offset;
    keep(fork.cones, a + 2.0f * radius, one.cones);
    keep(fork.others, b + 2.0f * radius, one.others);
    deepest = std::max(deepest, depth);
  }
  greatest_ = nearest + radius;
  least_ = nearest - radius - deepest;
}

void LeafField::lower_values(const Cone& cone, Batch& batch) {
  for (int i = 0; i < batch.lanes; ++i) {
    const float value = foot_of(cone, batch.x[i], batch.y[i], batch.z[i]).value;
    batch.value[i] = value < batch.value[i] ? value : batch.value[i];
  }
}

void LeafField::find_nearest(std::span<const std::uint32_t> cones, const Batch& batch,
                             Nearest& nearest) const {
  nearest.value.fill(kFar);
  for (const std::uint32_t index : cones) {
    const Cone& cone = cones_[index];
    const float cut_offset = cone.has_cut ? cone.cut_offset : -kFar;
    for (int i = 0; i < batch.lanes; ++i) {
      const Foot foot = foot_of(cone, batch.x[i], batch.y[i], batch.z[i]);
      const float share = 1.0f / (foot.apart > kTiny ? foot.apart : kTiny);
      const float behind =
          cut_offset - (batch.x[i] * cone.cut.x + batch.y[i] * cone.cut.y + batch.z[i] * cone.cut.z);
      const bool is_cut = behind > foot.value;
      const float value = is_cut ? behind : foot.value;
      const bool is_nearer = value < nearest.value[i];
      nearest.value[i] = is_nearer ? value : nearest.value[i];
      nearest.slope_x[i] = is_nearer ? (is_cut ? -cone.cut.x : foot.x * share) : nearest.slope_x[i];
      nearest.slope_y[i] = is_nearer ? (is_cut ? -cone.cut.y : foot.y * share) : nearest.slope_y[i];
      nearest.slope_z[i] = is_nearer ? (is_cut ? -cone.cut.z : foot.z * share) : nearest.slope_z[i];
      nearest.internode[i] = is_nearer ? cone.internode : nearest.internode[i];
    }
  }
}

void LeafField::blend(const Blend& fork, Batch& batch, bool with_slopes) const {
  Nearest a;
  Nearest b;
  find_nearest(fork.cones, batch, a);
  find_nearest(fork.others, batch, b);
  for (int i = 0; i < batch.lanes; ++i) {
    const float least = std::min(a.value[i], b.value[i]);
    const float apart = std::abs(a.value[i] - b.value[i]);
    // Surfaces that run alongside each other would bulge where they part: they meet at an angle or not at
    // all.
    const float cosine =
        a.slope_x[i] * b.slope_x[i] + a.slope_y[i] * b.slope_y[i] + a.slope_z[i] * b.slope_z[i];
    const float angle = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    const float dx = batch.x[i] - fork.center.x;
    const float dy = batch.y[i] - fork.center.y;
    const float dz = batch.z[i] - fork.center.z;
    const float place = std::sqrt(dx * dx + dy * dy + dz * dz) / fork.zone;
    const float faded = std::clamp((1.0f - place) / (1.0f - kFade), 0.0f, 1.0f);
    const float width = fork.width * angle * faded * faded * (3.0f - 2.0f * faded);
    if (apart >= width) continue;
    const float overlap = width - apart;
    const float blended = least - static_cast<float>(kBlendDepth) * overlap * overlap / width;
    const float behind =
        fork.cut_offset - (batch.x[i] * fork.cut.x + batch.y[i] * fork.cut.y + batch.z[i] * fork.cut.z);
    const float value = std::max(blended, behind);
    if (value >= batch.value[i]) continue;
    batch.value[i] = value;
    if (!with_slopes) continue;
    if (behind > blended) {
      batch.slope_x[i] = -fork.cut.x;
      batch.slope_y[i] = -fork.cut.y;
      batch.slope_z[i] = -fork.cut.z;
      continue;
    }
    const float of_farther = 2.0f * static_cast<float>(kBlendDepth) * overlap / width;
    const bool is_a = a.value[i] < b.value[i];
    const float of_a = is_a ? 1.0f - of_farther : of_farther;
    batch.slope_x[i] = std::lerp(b.slope_x[i], a.slope_x[i], of_a);
    batch.slope_y[i] = std::lerp(b.slope_y[i], a.slope_y[i], of_a);
    batch.slope_z[i] = std::lerp(b.slope_z[i], a.slope_z[i], of_a);
  }
}

void LeafField::values(Batch& batch) const {
  batch.value.fill(kFar);
  for (const std::uint32_t index : near_cones_) {
    const Cone& cone = cones_[index];
    if (!cone.has_cut) {
      lower_values(cone, batch);
      continue;
    }
    Nearest nearest;
    find_nearest(std::span(&index, 1), batch, nearest);
    for (int i = 0; i < batch.lanes; ++i) batch.value[i] = std::min(batch.value[i], nearest.value[i]);
  }
  for (std::size_t i = 0; i < near_blend_count_; ++i) blend(near_blends_[i], batch, false);
}

void LeafField::slopes(Batch& batch) const {
  Nearest nearest;
  find_nearest(near_cones_, batch, nearest);
  batch.value = nearest.value;
  batch.slope_x = nearest.slope_x;
  batch.slope_y = nearest.slope_y;
  batch.slope_z = nearest.slope_z;
  batch.internode = nearest.internode;
  for (std::size_t i = 0; i < near_blend_count_; ++i) blend(near_blends_[i], batch, true);
}

}  // namespace ramify
