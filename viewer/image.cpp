#include "viewer/image.h"

#include <algorithm>
#include <cassert>
#include <ostream>

// The distribution also has a library with these functions: ours stay in this file.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include "common/base/errors.h"

namespace ramify {

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

Image beside(std::span<const Image> images) {
  Image row;
  if (images.empty()) return row;
  row.height = images.front().height;
  for (const Image& image : images) {
    assert(image.height == row.height);
    row.width += image.width;
  }
  row.rgba.reserve(4 * static_cast<std::size_t>(row.width) * row.height);
  for (int y = 0; y < row.height; ++y) {
    for (const Image& image : images) {
      row.rgba.insert(row.rgba.end(), image.pixel(0, y), image.pixel(0, y) + 4 * image.width);
    }
  }
  return row;
}

}  // namespace ramify
