// Tubes of three sides that run straight from knot to knot and begin inside their bearers: nearly all of a
// large tree. Four of them are written at a time, one in each lane of the processor's vectors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/base/lanes.h"
#include "common/mesh/mesh.h"
#include "common/mesh/tube_plan.h"

namespace ramify {

/// Gathers plain tubes until there are four with as many points, and writes these. The mesh is the same, to
/// the last bit, as that of smooth.cpp's way, which takes all kinds of tubes.
class PlainTubeWriter {
 public:
  /// Both must outlive the writer; the mesh has its final size.
  PlainTubeWriter(const TubePlan& plan, Mesh& mesh) : plan_(plan), mesh_(mesh) {}
  ~PlainTubeWriter() { write_rest(); }
  PlainTubeWriter(const PlainTubeWriter&) = delete;
  PlainTubeWriter& operator=(const PlainTubeWriter&) = delete;

  /// A tube of the plan with `is_plain`. It is written now, later or by write_rest().
  void add(std::uint32_t tube);

  void write_rest();

 private:
  struct Group {
    std::uint32_t size = 0;
    std::array<std::uint32_t, kLanes> tubes;
  };

  void write(Group& group);

  const TubePlan& plan_;
  Mesh& mesh_;
  std::vector<Group> groups_;  // by the number of points
};

}  // namespace ramify
