// Pages that are one file: readable from disk, in light and dark, on paper, by keyboard and by ear.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ramify::cli {

/// Text for a page: <, >, &, quotes escaped, control characters left out.
std::string html_text(std::string_view text);

/// `bytes` as a data URL, so that the page needs no other file.
std::string data_url(std::string_view media_type, std::string_view bytes);

struct Picture {
  std::string media_type;  // image/png, image/svg+xml
  std::string bytes;
  std::string alternative;  // what it shows, in words
  int width = 0;            // pixels that it takes on the page; 0: those of the file
  int height = 0;
  std::string link = {};  // where a click on it leads; empty: nowhere
};

/// A picture with its caption and the command line that makes it, if any. `caption` is HTML.
std::string figure(const Picture& picture, const std::string& caption, const std::string& command);

/// Cells are HTML, the caption is text. The first row and the first column are headings. It can be scrolled
/// sideways, by keyboard too, where it is wider than the page.
std::string table(const std::string& caption, const std::vector<std::vector<std::string>>& rows,
                  bool has_words_last = false);

/// A part of a page that is opened by a click or the Enter key.
std::string foldable(const std::string& summary, const std::string& content);

struct Section {
  std::string id;       // for links within the page
  std::string heading;  // text
  std::string content;  // HTML
};

/// The whole page. `opening` is HTML that stands under the title, before the list of contents.
std::string page(const std::string& title, const std::string& opening, const std::vector<Section>& sections);

}  // namespace ramify::cli
