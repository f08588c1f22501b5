// Text in pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/base/color.h"
#include "common/base/image.h"

namespace ramify {

/// The file of the first font, of those that are good to read on screens, that is installed; empty if none
/// is.
std::filesystem::path installed_font();

/// Letters of the installed font in one size. Characters outside ASCII are shown as '?'.
class Letters {
 public:
  /// `height` is that of a line, pixels.
  explicit Letters(float height);
  ~Letters();
  Letters(const Letters&) = delete;
  Letters& operator=(const Letters&) = delete;

  /// Whether there is a font to draw with; without one nothing is drawn.
  bool can_draw() const;

  /// How wide a text is drawn, pixels.
  float width(std::string_view text) const;

  /// Draws a line of text over the image; (x, y) is the line's upper left corner. What does not fit into the
  /// image is cut off.
  void draw(Image& image, int x, int y, std::string_view text, const ColorBytes& ink) const;

 private:
  struct Font;
  std::unique_ptr<Font> font_;
};

}  // namespace ramify
