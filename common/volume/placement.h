// How a part's own frame lies in the world: scaled, then turned, then moved, and all that again for each
// union around it.
#pragma once

#include "common/base/geometry.h"

namespace ramify {

struct Volume;

class Placement {
 public:
  /// The world's own frame.
  Placement() = default;

  /// Of what has the transform of `volume`, inside a frame that is placed so itself.
  Placement(const Placement& around, const Volume& volume);

  Vec3 to_world(const Vec3& own) const { return linear_ * own + offset_; }
  Vec3 to_own(const Vec3& world) const { return inverse_ * (world - offset_); }

  /// Of a direction or the difference of two points; lengths change.
  Vec3 vector_to_world(const Vec3& own) const { return linear_ * own; }

  /// A normal of a surface, unit length.
  Vec3 normal_to_world(const Vec3& own) const { return glm::normalize(own * inverse_); }

  /// w such that dot(w, own) = dot(world, to_world(own)) but for a constant: support functions need it.
  Vec3 covector_to_own(const Vec3& world) const { return world * linear_; }

  bool is_identity() const { return is_identity_; }

  /// One scale in all directions: shapes keep theirs.
  bool is_even() const { return is_even_; }

  /// Neither turned nor sheared: axes keep their directions.
  bool is_upright() const { return is_upright_; }

  /// Distances in the world are at least so many times those in the own frame; exactly so if it is even.
  double least_scale() const { return least_scale_; }

 private:
  glm::dmat3 linear_{1.0};
  glm::dmat3 inverse_{1.0};
  Vec3 offset_{0.0};
  double least_scale_ = 1.0;
  bool is_identity_ = true;
  bool is_even_ = true;
  bool is_upright_ = true;
};

}  // namespace ramify
