#include "common/base/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <ostream>

// The distribution also has a library with these functions: ours stay in this file.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#include <stb/stb_image.h>

#include "common/base/errors.h"

namespace ramify {
namespace {

// No PNG or JPEG holds more pixels a byte: deflate reaches 1032 to 1, and a PNG's byte can stand for 8
// pixels.
constexpr double kMostPixelsAByte = 8 * 1032;

/// 1: grey, 3: RGB, 4: RGBA.
int needed_channels(const Image& image) {
  bool is_grey = true;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    if (image.rgba[i + 3] != 255) return 4;
    is_grey = is_grey && image.rgba[i] == image.rgba[i + 1] && image.rgba[i] == image.rgba[i + 2];
  }
  return is_grey ? 1 : 3;
}

}  // namespace

void write_png(const Image& image, std::ostream& out) {
  assert(image.rgba.size() == 4 * static_cast<std::size_t>(image.width) * image.height);
  const auto write = [](void* stream, void* bytes, int count) {
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(bytes), count);
  };
  const int is_written =
      stbi_write_png_to_func(write, &out, image.width, image.height, 4, image.rgba.data(), 4 * image.width);
  if (is_written == 0) throw IoError("cannot write the picture: out of memory");
  if (!out) throw IoError("cannot write the picture: write failed");
}

std::string png_bytes(const Image& image) {
  const int channels = needed_channels(image);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.rgba.size() / 4 * static_cast<std::size_t>(channels));
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    pixels.insert(pixels.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                  image.rgba.begin() + static_cast<std::ptrdiff_t>(i) + channels);
  }
  const auto append = [](void* bytes, void* part, int count) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(part), static_cast<std::size_t>(count));
  };
  std::string bytes;
  const int is_written = stbi_write_png_to_func(append, &bytes, image.width, image.height, channels,
                                                pixels.data(), channels * image.width);
  if (is_written == 0) throw RunError("cannot compress an image: out of memory");
  return bytes;
}

Image decoded_image(std::string_view bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max()));
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0) {
    throw InputError(fmt::format("{}: no PNG or JPEG image: {}", name, stbi_failure_reason()));
  }
  if (image.width > kMaxImageSide || image.height > kMaxImageSide) {
    throw InputError(fmt::format("{}: {} x {} pixels (at most {} x {})", name, image.width, image.height,
                                 kMaxImageSide, kMaxImageSide));
  }
  const double pixels = static_cast<double>(image.width) * image.height;
  if (pixels > kMostPixelsAByte * static_cast<double>(bytes.size())) {
    throw InputError(
        fmt::format("{}: claims {} x {} pixels in {} bytes", name, image.width, image.height, bytes.size()));
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &image.width, &image.height, &channels, 4), stbi_image_free);
  if (!decoded) throw InputError(fmt::format("{}: damaged image: {}", name, stbi_failure_reason()));
  image.rgba.assign(decoded.get(), decoded.get() + 4 * static_cast<std::size_t>(pixels));
  return image;
}

Image contact_sheet(std::span<const Image> images, std::size_t columns) {
  assert(columns > 0);
  if (images.empty()) return {};
  const Image& first = images.front();
  columns = std::min(columns, images.size());
  const std::size_t rows = (images.size() + columns - 1) / columns;
  Image sheet{first.width * static_cast<int>(columns), first.height * static_cast<int>(rows), {}};
  sheet.rgba.assign(4 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 0);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    assert(image.width == first.width && image.height == first.height);
    const int left = first.width * static_cast<int>(i % columns);
    const int top = first.height * static_cast<int>(i / columns);
    for (int y = 0; y < image.height; ++y) {
      const std::ptrdiff_t start = sheet.pixel(left, top + y) - sheet.rgba.data();
      std::copy_n(image.pixel(0, y), 4 * image.width, sheet.rgba.begin() + start);
    }
  }
  return sheet;
}

}  // namespace ramify
