#include "growth/marker_grid.h"

#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

// So many cells to the reach. Narrower ones fit better what is looked for, and hold too few markers each.
constexpr double kCellsAReach = 1.75;

// Cells are this share wider, so that rounding a point into the next cell takes no marker out of reach.
constexpr double kCellSlack = 1e-6;

// Wider cells for fewer markers: so many cells a marker, and at least so many.
constexpr double kCellsPerMarker = 2.0;
constexpr double kCellsMin = 4096.0;

// Slices of a cell along x. They cost less than rows do: a search reads where the first and the last begin.
constexpr std::uint32_t kSlices = 2;

// Slices whose markers stand in one piece, as a block; both are powers of two.
constexpr std::uint32_t kBlockBits = 3;
constexpr std::uint32_t kBlock = 1U << kBlockBits;
constexpr double kBlockCells = kBlock / kSlices;

// The holes of a block are closed when they are one in so many places.
constexpr std::uint32_t kHoleShare = 16;

// Where a marker goes that is taken away: its squared distance is infinite.
constexpr float kNowhere = 1e30F;

// Markers that are drawn at once, and sorted before they leave the cache.
constexpr std::size_t kChunk = 1 << 15;

// So many groups of a block are listed without a branch.
constexpr std::uint32_t kUsualGroups = 4;

// Floats hold offsets to 2^-24 of their size; what is worked out from some of them, to this.
constexpr float kFloatSlack = 0x1p-20F;

/// Where the place of a slice is written: a block has one entry more than slices.
std::size_t entry_of(std::uint32_t slice) {
  return std::size_t{slice} + (slice >> kBlockBits);
}

Lanes clamped(const Lanes& values, const Lanes& low, const Lanes& high) {
  return lesser(greater(values, low), high);
}

LaneNumbers as_numbers(const LaneMask& values) {
  return reinterpret_cast<LaneNumbers>(values);
}

}  // namespace

/// The markers of one chunk after the other, of each those of the first layer of cells first.
struct MarkerGrid::Chunks {
  /// How many markers of a layer a chunk has.
  std::size_t size_of(std::size_t chunk, std::size_t layer) const {
    const std::size_t i = chunk * layers + layer;
    return ends[i] - (layer == 0 ? 0 : ends[i - 1]);
  }

  std::size_t count;
  std::size_t layers;
  BulkVector<Vec3f> offsets;
  std::vector<std::uint32_t> ends;  // of the layers of each chunk, from the chunk's begin
};

MarkerGrid::MarkerGrid(const Box& box, double reach, std::size_t count, const DrawMarkers& draw)
    : box_(box),
      box_size_(box.size()),
      reach_(reach),
      square_reach_(reach * reach * (1.0 + kCellSlack)),
      count_(count),
      place_count_(count + kLanes) {
  assert(reach > 0.0);
  lay_out(static_cast<double>(count));
  place(drawn(draw));
  count_neighbours();
}

void MarkerGrid::lay_out(double marker_count) {
  const double cells_max = std::max(kCellsMin, kCellsPerMarker * marker_count);
  edge_ = reach_ / kCellsAReach * (1.0 + kCellSlack);
  const auto cells = [&] { return glm::floor(box_size_ / edge_) + 1.0; };
  const auto is_too_fine = [&](const Vec3& size) {
    return std::ceil(size.x / kBlockCells) * kBlockCells * size.y * size.z > cells_max;
  };
  while (is_too_fine(cells())) edge_ *= 1.25;
  size_ = Coord(cells());
  inverse_edge_ = 1.0 / edge_;
  inverse_slice_ = inverse_edge_ * kSlices;
  last_cell_ = Vec3(size_ - 1);
  const std::uint32_t slices = static_cast<std::uint32_t>(size_.x) * kSlices;
  last_slice_ = slices - 1;
  slices_a_row_ = (slices + kBlock - 1) / kBlock * kBlock;
  dilation_ = static_cast<int>(std::ceil(reach_ / edge_));
}

/// Each chunk is sorted before it leaves the cache.
MarkerGrid::Chunks MarkerGrid::drawn(const DrawMarkers& draw) const {
  const std::size_t chunk_count = (count_ + kChunk - 1) / kChunk;
  const auto layers = static_cast<std::size_t>(size_.z);
  Chunks chunks{chunk_count, layers, BulkVector<Vec3f>(count_),
                std::vector<std::uint32_t>(chunk_count * layers)};
  parallel_for(chunk_count, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3f> offsets;
    std::vector<std::uint32_t> next(layers);
    const auto layer_of = [&](const Vec3f& offset) { return cell_along(2, offset.z); };
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const std::size_t first = chunk * kChunk;
      offsets.resize(std::min(kChunk, count_ - first));
      draw(first, offsets);
      std::uint32_t* const ends = &chunks.ends[chunk * layers];
      for (const Vec3f& offset : offsets) ++ends[layer_of(offset)];
      std::exclusive_scan(ends, ends + layers, next.begin(), 0U);
      std::inclusive_scan(ends, ends + layers, ends);
      for (const Vec3f& offset : offsets) chunks.offsets[first + next[layer_of(offset)]++] = offset;
    }
  });
  return chunks;
}

/// Layer by layer, so that each is sorted within the cache.
void MarkerGrid::place(const Chunks& chunks) {
  const std::size_t rows = chunks.layers * static_cast<std::size_t>(size_.y);
  const std::size_t blocks = rows * slices_a_row_ / kBlock;
  living_.resize(rows * static_cast<std::size_t>(size_.x));
  holes_.resize(blocks);
  begin_.resize(blocks * (kBlock + 1));
  for (auto* const values : {&x_, &y_, &z_}) {
    values->resize(place_count());
    std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(count_), place_count() - count_, kNowhere);
  }

  std::vector<std::uint32_t> first_place(chunks.layers + 1);
  for (std::size_t layer = 0; layer < chunks.layers; ++layer) {
    std::size_t count = 0;
    for (std::size_t chunk = 0; chunk < chunks.count; ++chunk) count += chunks.size_of(chunk, layer);
    first_place[layer + 1] = first_place[layer] + static_cast<std::uint32_t>(count);
  }
  parallel_for(chunks.layers, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3f> offsets;
    for (std::size_t layer = begin; layer < end; ++layer) {
      offsets.clear();
      for (std::size_t chunk = 0; chunk < chunks.count; ++chunk) {
        const Vec3f* const last =
            &chunks.offsets[chunk * kChunk] + chunks.ends[chunk * chunks.layers + layer];
        offsets.insert(offsets.end(), last - chunks.size_of(chunk, layer), last);
      }
      place_layer(offsets, first_place[layer], layer);
    }
  });
}

/// Gives the markers of a layer their places, those of a slice in their order.
void MarkerGrid::place_layer(std::span<const Vec3f> offsets, std::uint32_t first_place, std::size_t layer) {
  const auto rows = static_cast<std::size_t>(size_.y);
  const auto cells = static_cast<std::uint32_t>(size_.x);             // a row
  const std::size_t entries = slices_a_row_ / kBlock * (kBlock + 1);  // a row
  const std::span<std::uint32_t> begins = std::span(begin_).subspan(layer * rows * entries, rows * entries);
  std::vector<std::uint32_t> entry(offsets.size());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    entry[i] = static_cast<std::uint32_t>(entry_of(slice_of(cell_along(1, offsets[i].y), offsets[i].x)));
    ++begins[entry[i]];
  }
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint32_t* const living = &living_[(layer * rows + row) * cells];
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      const std::uint32_t* const counts = &begins[row * entries + entry_of(cell * kSlices)];
      living[cell] = std::accumulate(counts, counts + kSlices, 0U);
    }
  }
  std::exclusive_scan(begins.begin(), begins.end(), begins.begin(), first_place);
  std::vector<std::uint32_t> next(begins.begin(), begins.end());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const std::uint32_t place = next[entry[i]]++;
    x_[place] = offsets[i].x;
    y_[place] = offsets[i].y;
    z_[place] = offsets[i].z;
  }
}

/// Along one axis after the other.
void MarkerGrid::count_neighbours() {
  neighbours_.resize(living_.size());
  std::transform(living_.begin(), living_.end(), neighbours_.begin(),
                 [](std::uint32_t living) { return static_cast<std::uint8_t>(living > 0); });
  std::size_t stride = 1;  // from a cell to the next along the axis
  for (int axis = 0; axis < 3; ++axis) {
    const auto length = static_cast<std::size_t>(size_[axis]);
    const auto dilation = static_cast<std::size_t>(dilation_);
    const std::vector<std::uint8_t> before = neighbours_;
    for (std::size_t shift = 1; shift <= std::min(dilation, length - 1); ++shift) {
      // Blocks of cells among which the axis runs from end to end.
      for (std::size_t block = 0; block < before.size(); block += length * stride) {
        const std::size_t apart = shift * stride;
        const std::size_t count = length * stride - apart;
        for (std::size_t i = block; i < block + count; ++i) {
          neighbours_[i] = static_cast<std::uint8_t>(neighbours_[i] + before[i + apart]);
          neighbours_[i + apart] = static_cast<std::uint8_t>(neighbours_[i + apart] + before[i]);
        }
      }
    }
    stride *= length;
  }
}

void MarkerGrid::add_to_neighbourhood(const Coord& cell, std::uint8_t amount) {
  const Coord low = glm::max(cell - dilation_, Coord(0));
  const Coord high = glm::min(cell + dilation_, size_ - 1);
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      const std::size_t row = index_of({0, y, z});
      for (int x = low.x; x <= high.x; ++x) {
        std::uint8_t& neighbours = neighbours_[row + static_cast<std::size_t>(x)];
        neighbours = static_cast<std::uint8_t>(neighbours + amount);
      }
    }
  }
}

bool MarkerGrid::is_barren(const Vec3& point) const {
  // No marker is nearer to the point than to the nearest point of the box.
  const Vec3 from_low = point - box_.low;
  const Vec3 away = from_low - glm::clamp(from_low, Vec3(0.0), box_size_);
  return glm::dot(away, away) > square_reach_ || neighbours_[index_of(cell_of(from_low))] == 0;
}

/// Slices between which rows of cells are met, in `first` and `last`; returns how many rows. Which they are
/// is hard to foretell, so nothing here branches on it.
std::size_t MarkerGrid::find_rows(const Lens& lens, Search& search) const {
  const Lanes far = magnitude(lens.apex) + lens.reach;
  const float margin =
      static_cast<float>(kCellSlack * edge_) + kFloatSlack * std::max({far[0], far[1], far[2]});
  const auto edge = static_cast<float>(edge_);
  const auto inverse_edge = static_cast<float>(inverse_edge_);
  const auto inverse_slice = static_cast<float>(inverse_slice_);
  const Lanes last_cell{static_cast<float>(last_cell_.x), static_cast<float>(last_cell_.y),
                        static_cast<float>(last_cell_.z), 0.0F};
  const LaneMask low = whole(clamped((lens.low - margin) * inverse_edge, Lanes{}, last_cell));
  const LaneMask high = whole(clamped((lens.high + margin) * inverse_edge, Lanes{}, last_cell));
  const Lanes last_slice = all_lanes(static_cast<float>(last_slice_));
  const float low_x = lens.low[0] - margin;
  const float high_x = lens.high[0] + margin;
  const float ball_square = (lens.radius + margin) * (lens.radius + margin);
  const float reach_square = (lens.reach + margin) * (lens.reach + margin);

  const std::size_t most = static_cast<std::size_t>((high[1] - low[1] + 8) * (high[2] - low[2] + 1));
  if (search.first.size() < most) {
    search.first.resize(2 * most);
    search.last.resize(2 * most);
  }
  std::size_t count = 0;
  for (int z = low[2]; z <= high[2]; ++z) {
    const float low_z = static_cast<float>(z) * edge;
    const auto square_rest = [&](float square, float place) {
      const float gap = std::max({low_z - place, place - edge - low_z, 0.0F});
      return square - gap * gap;
    };
    const float ball_rest = square_rest(ball_square, lens.center[2]);
    const float reach_rest = square_rest(reach_square, lens.apex[2]);
    for (int first_y = low[1]; first_y <= high[1]; first_y += static_cast<int>(kLanes)) {
      const LaneMask y = first_y + LaneMask{0, 1, 2, 3};
      const Lanes low_y = as_lanes(y) * edge;
      const auto square_half = [&](float rest, float place) {
        const Lanes gap = greater(greater(low_y - place, (place - edge) - low_y), Lanes{});
        return rest - gap * gap;
      };
      const Lanes ball = square_half(ball_rest, lens.center[1]);
      const Lanes around = square_half(reach_rest, lens.apex[1]);
      const Lanes ball_half = square_root(greater(ball, Lanes{}));
      const Lanes half = square_root(greater(around, Lanes{}));
      const Lanes from = greater(greater(lens.center[0] - ball_half, lens.apex[0] - half), all_lanes(low_x));
      const Lanes to = lesser(lesser(lens.center[0] + ball_half, lens.apex[0] + half), all_lanes(high_x));
      const LaneMask is_met = (lesser(ball, around) >= 0.0F) & (from <= to) & (y <= high[1]);
      const auto slice_at = [&](const Lanes& x) {
        return as_numbers(whole(clamped(x * inverse_slice, Lanes{}, last_slice)));
      };
      const LaneNumbers row = static_cast<std::uint32_t>(z * size_.y) + as_numbers(y);
      const LaneNumbers begin = row * slices_a_row_;
      pack(begin + slice_at(from), is_met, &search.first[count]);
      count += pack(begin + slice_at(to), is_met, &search.last[count]);
    }
  }
  return count;
}

std::span<const std::uint32_t> MarkerGrid::find(const Lens& lens, Search& search) const {
  const std::size_t rows = find_rows(lens, search);
  const std::uint32_t* const begins = begin_.data();
  std::uint32_t* groups = search.groups.data();
  std::size_t room = search.groups.size();
  std::size_t count = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t last = search.last[row];
    for (std::uint32_t first = search.first[row]; first <= last; first = (first | (kBlock - 1)) + 1) {
      std::uint32_t place = begins[entry_of(first)];
      const std::uint32_t end = begins[entry_of(std::min(first | (kBlock - 1), last)) + 1];
      if (room < count + (end - place) + kUsualGroups) {
        search.groups.resize(2 * (count + (end - place) + kUsualGroups));
        groups = search.groups.data();
        room = search.groups.size();
      }
      for (std::uint32_t group = 0; group < kUsualGroups; ++group, place += kLanes) {
        groups[count] = place;
        count += place < end;
      }
      for (; place < end; place += kLanes) groups[count++] = place;
    }
  }
  return {groups, count};
}

void MarkerGrid::take_within(const Vec3& from_low, double radius, Search& search) {
  const auto reach = static_cast<float>(radius);
  const Lanes place = lanes_of(from_low);
  const std::span<const std::uint32_t> groups =
      find({place, reach, place, reach, place - reach, place + reach}, search);
  const Lanes far = magnitude(place) + reach;
  const float wide = reach + kFloatSlack * std::max({far[0], far[1], far[2]});
  if (search.places.size() < kLanes * (groups.size() + 1))
    search.places.resize(2 * kLanes * (groups.size() + 1));
  std::size_t count = 0;
  for (const std::uint32_t group : groups) {
    const Lanes dx = load_lanes(&x_[group]) - place[0];
    const Lanes dy = load_lanes(&y_[group]) - place[1];
    const Lanes dz = load_lanes(&z_[group]) - place[2];
    const LaneMask is_near = dx * dx + dy * dy + dz * dz <= wide * wide;
    count += pack(LaneNumbers{0, 1, 2, 3} + group, is_near, &search.places[count]);
  }
  search.blocks.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 to_marker = offset(search.places[i]) - from_low;
    if (glm::dot(to_marker, to_marker) > radius * radius) continue;
    search.blocks.push_back(take(search.places[i]));
  }
  for (const std::uint32_t block : search.blocks) close_holes(block);
}

/// Leaves a hole where the marker was; returns its block.
std::uint32_t MarkerGrid::take(std::uint32_t place) {
  const Coord cell = cell_of(offset(place));
  const std::uint32_t block = slice_of(row_of(cell), x_[place]) / kBlock;
  x_[place] = kNowhere;
  --count_;
  ++holes_[block];
  if (--living_[index_of(cell)] == 0) add_to_neighbourhood(cell, static_cast<std::uint8_t>(-1));
  return block;
}

/// Markers keep their order: what is left does not depend on the order in which others were taken.
void MarkerGrid::close_holes(std::uint32_t block) {
  std::uint32_t* const begin = &begin_[std::size_t{block} * (kBlock + 1)];
  if (holes_[block] * kHoleShare < begin[kBlock] - begin[0] || holes_[block] == 0) return;
  holes_[block] = 0;
  std::uint32_t kept = begin[0];
  std::uint32_t place = kept;
  for (std::uint32_t slice = 0; slice < kBlock; ++slice) {
    for (const std::uint32_t end = begin[slice + 1]; place < end; ++place) {
      const float x = x_[place];
      x_[kept] = x;
      y_[kept] = y_[place];
      z_[kept] = z_[place];
      kept += x < kNowhere;
    }
    begin[slice + 1] = kept;
  }
  std::fill(x_.begin() + kept, x_.begin() + place, kNowhere);
}

std::vector<Vec3> MarkerGrid::points() const {
  std::vector<Vec3> points;
  points.reserve(count_);
  for (std::size_t place = 0; place < place_count_; ++place) {
    if (x_[place] != kNowhere) points.push_back(box_.low + offset(place));
  }
  return points;
}

}  // namespace ramify::growth
