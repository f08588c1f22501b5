// Finished pictures and PNG files.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

namespace ramify {

/// 8 bits a channel, encoded as sRGB, alpha straight.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // four bytes a pixel, row by row; row 0 is the top

  /// The four bytes of the pixel in column x, row y.
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
  }
};

/// Writes a PNG file. Throws IoError if the stream fails.
void write_png(const Image& image, std::ostream& out);

/// The images in rows of `columns` (at least 1), left to right; they must be of one size. What the last row
/// lacks is transparent. Empty for none.
Image contact_sheet(std::span<const Image> images, std::size_t columns);

}  // namespace ramify
