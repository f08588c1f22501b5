#include "common/base/letters.h"

#include <array>
#include <cmath>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

#include "common/base/files.h"

namespace ramify {
namespace {

// In order of preference; Debian's packages fonts-dejavu-core, fonts-noto-core and fonts-liberation.
constexpr std::array kFonts = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
};

int code_of(char c) {
  return c >= 32 && c < 127 ? c : '?';
}

/// Lays `ink` over the pixel as densely as `cover` says, 0 to 255.
void cover_pixel(Image& image, int x, int y, const ColorBytes& ink, int cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* pixel = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * image.width + x);
  for (int k = 0; k < 4; ++k) {
    pixel[k] = static_cast<std::uint8_t>((pixel[k] * (255 - cover) + ink[k] * cover + 127) / 255);
  }
}

}  // namespace

struct Letters::Font {
  std::string bytes;
  stbtt_fontinfo info{};
  float scale = 1.0f;     // pixels a unit of the font's
  float baseline = 0.0f;  // below the upper edge of the line, pixels

  float advance(int code, int next) const {
    int width = 0;
    stbtt_GetCodepointHMetrics(&info, code, &width, nullptr);
    const int kern = next != 0 ? stbtt_GetCodepointKernAdvance(&info, code, next) : 0;
    return scale * static_cast<float>(width + kern);
  }
};

std::filesystem::path installed_font() {
  for (const char* path : kFonts) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return path;
  }
  return {};
}

Letters::Letters(float height) {
  const std::filesystem::path path = installed_font();
  if (path.empty()) return;
  auto font = std::make_unique<Font>();
  font->bytes = read_file(path);
  const auto* data = reinterpret_cast<const unsigned char*>(font->bytes.data());
  if (stbtt_InitFont(&font->info, data, 0) == 0) return;
  int ascent = 0;
  stbtt_GetFontVMetrics(&font->info, &ascent, nullptr, nullptr);
  font->scale = stbtt_ScaleForPixelHeight(&font->info, height);
  font->baseline = std::round(font->scale * static_cast<float>(ascent));
  font_ = std::move(font);
}

Letters::~Letters() = default;

bool Letters::can_draw() const {
  return font_ != nullptr;
}

float Letters::width(std::string_view text) const {
  float width = 0.0f;
  for (std::size_t i = 0; font_ && i < text.size(); ++i) {
    width += font_->advance(code_of(text[i]), i + 1 < text.size() ? code_of(text[i + 1]) : 0);
  }
  return width;
}

void Letters::draw(Image& image, int x, int y, std::string_view text, const ColorBytes& ink) const {
  float pen = static_cast<float>(x);
  for (std::size_t i = 0; font_ && i < text.size(); ++i) {
    const int code = code_of(text[i]);
    int width = 0;
    int height = 0;
    int left = 0;
    int top = 0;
    const float whole = std::floor(pen);
    const std::unique_ptr<unsigned char, void (*)(unsigned char*)> shape(
        stbtt_GetCodepointBitmapSubpixel(&font_->info, font_->scale, font_->scale, pen - whole, 0.0f, code,
                                         &width, &height, &left, &top),
        [](unsigned char* bitmap) { stbtt_FreeBitmap(bitmap, nullptr); });
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        cover_pixel(image, static_cast<int>(whole) + left + column,
                    y + static_cast<int>(font_->baseline) + top + row, ink,
                    shape.get()[row * width + column]);
      }
    }
    pen += font_->advance(code, i + 1 < text.size() ? code_of(text[i + 1]) : 0);
  }
}

}  // namespace ramify
