// Pictures in memory, and PNG and JPEG files.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramify {

/// 8 bits a channel, encoded as sRGB, alpha straight.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // four bytes a pixel, row by row; row 0 is the top

  bool is_empty() const { return rgba.empty(); }
  /// The four bytes of the pixel in column x, row y.
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
  }
};

/// Writes a PNG file. Throws IoError if the stream fails.
void write_png(const Image& image, std::ostream& out);

/// The bytes of a PNG file, with as few channels as the image needs: grey, RGB or RGBA.
std::string png_bytes(const Image& image);

/// A side of an image that is read, pixels, at most.
inline constexpr int kMaxImageSide = 8192;

/// A PNG or JPEG file's picture, `bytes` being its content and `name` what to call it in messages. Throws
/// InputError if it is none, is damaged or is larger than kMaxImageSide; memory is bounded by what the bytes
/// can hold, whatever their header claims.
Image decoded_image(std::string_view bytes, const std::string& name);

/// The images in rows of `columns` (at least 1), left to right; they must be of one size. What the last row
/// lacks is transparent. Empty for none.
Image contact_sheet(std::span<const Image> images, std::size_t columns);

}  // namespace ramify
