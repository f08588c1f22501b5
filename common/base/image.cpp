#include "common/base/image.h"

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
