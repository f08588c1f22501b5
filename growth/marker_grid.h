// Where marker points stand: in rows of a dense grid, so that those near a place are found without a look at
// the others, and those taken away are soon not looked at any more.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/base/bulk.h"
#include "common/base/geometry.h"
#include "common/base/lanes.h"

namespace ramify::growth {

inline Lanes lanes_of(const Vec3& vector) {
  return Lanes{static_cast<float>(vector.x), static_cast<float>(vector.y), static_cast<float>(vector.z),
               0.0F};
}

/// What two balls and a box share. Coordinates x, y, z from the low corner of the grid's box, and a lane that
/// does not count; metres, as right as floats are.
struct Lens {
  Lanes center;  // of the one ball
  float radius = 0.0f;
  Lanes apex;  // the centre of the other
  float reach = 0.0f;
  Lanes low;  // of the box
  Lanes high;
};

/// Writes the offsets, from a box's low corner, of the markers from number `first` on. May be called by
/// several threads at once.
using DrawMarkers = std::function<void(std::size_t first, std::span<Vec3f> offsets)>;

class MarkerGrid {
 public:
  /// Working arrays of searches by one thread; what is in them means nothing in between.
  struct Search {
    std::vector<std::uint32_t> first;   // slice of each row that is met
    std::vector<std::uint32_t> last;    // likewise
    std::vector<std::uint32_t> groups;  // the first place of each
    std::vector<std::uint32_t> places;  // of markers
    std::vector<std::uint32_t> blocks;
  };

  /// So many markers, all drawn inside the box, on all threads. `reach`: how far is_barren() looks, metres,
  /// > 0. 25 to 50 bytes a marker: where there are few in a large box, the cells are wider. What is found and
  /// left does not depend on the number of threads.
  MarkerGrid(const Box& box, double reach, std::size_t count, const DrawMarkers& draw);

  /// Groups of four successive markers, told by their first places, which hold all markers in the lens,
  /// others too, and some twice. Costs some nanoseconds a row of cells and a group. Valid until the next
  /// search.
  std::span<const std::uint32_t> find(const Lens& lens, Search& search) const;

  /// Takes away for good the markers within `radius` metres of a place, given from the box's low corner.
  /// Costs what find() does.
  void take_within(const Vec3& from_low, double radius, Search& search);

  /// Whether no marker is left within reach of the point: then there never will be one again. One lookup in a
  /// table; may say false where a closer look would say true.
  bool is_barren(const Vec3& point) const;

  const Box& box() const { return box_; }
  double reach() const { return reach_; }

  /// How many are left.
  std::size_t count() const { return count_; }

  /// Those that are left, in the order of their places.
  std::vector<Vec3> points() const;

  /// All places are numbers below this. A marker keeps its place until others near it are taken away.
  std::size_t place_count() const { return place_count_; }

  /// Offsets of markers by place; where none is, nowhere near the box.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  Vec3 offset(std::size_t place) const { return {x_[place], y_[place], z_[place]}; }

  /// Cells along each axis, and the one of an offset: the nearest for an offset outside the box.
  const Coord& size() const { return size_; }
  Coord cell_of(const Vec3& offset) const {
    return Coord(glm::clamp(offset * inverse_edge_, Vec3(0.0), last_cell_));
  }

 private:
  struct Chunks;

  void lay_out(double marker_count);
  Chunks drawn(const DrawMarkers& draw) const;
  void place(const Chunks& chunks);
  void place_layer(std::span<const Vec3f> offsets, std::uint32_t first_place, std::size_t layer);
  void count_neighbours();
  void add_to_neighbourhood(const Coord& cell, std::uint8_t amount);
  std::size_t find_rows(const Lens& lens, Search& search) const;
  std::uint32_t take(std::uint32_t place);
  void close_holes(std::uint32_t block);

  /// Which cell along an axis an offset along it is in.
  std::size_t cell_along(int axis, double offset) const {
    return static_cast<std::size_t>(std::clamp(offset * inverse_edge_, 0.0, last_cell_[axis]));
  }
  std::size_t row_of(const Coord& cell) const {
    return static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(size_.y) +
           static_cast<std::size_t>(cell.y);
  }
  std::size_t index_of(const Coord& cell) const {
    return row_of(cell) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(cell.x);
  }
  std::uint32_t slice_of(std::size_t row, double x) const {
    return static_cast<std::uint32_t>(row) * slices_a_row_ +
           static_cast<std::uint32_t>(std::clamp(x * inverse_slice_, 0.0, last_slice_));
  }

  Box box_;
  Vec3 box_size_;
  double reach_;         // metres
  double square_reach_;  // and a little more
  double edge_ = 1.0;    // of a cell, metres
  double inverse_edge_ = 1.0;
  double inverse_slice_ = 1.0;
  Coord size_{1};  // cells along each axis
  Vec3 last_cell_{0.0};
  double last_slice_ = 0.0;  // of a row
  std::uint32_t slices_a_row_ = 1;
  int dilation_ = 1;  // so many cells are at least `reach` wide
  std::size_t count_;
  std::size_t place_count_;

  std::vector<std::uint32_t> living_;     // by cell, x fastest: markers that are left
  std::vector<std::uint8_t> neighbours_;  // how many cells within `dilation_` of a cell have markers
  std::vector<std::uint32_t> begin_;      // place of each slice; after those of a block, the last one's end
  std::vector<std::uint32_t> holes_;      // by block: places of taken markers between begin and end
  BulkVector<float> x_, y_, z_;           // slice by slice
};

}  // namespace ramify::growth
