#include "tests/cli/page.h"

#include <map>
#include <set>
#include <vector>

#include "tests/catch.h"
#include "tests/cli/program.h"

namespace ramify::test {
namespace {

/// A tag with its attributes.
struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
};

/// The opening tags of a page, in order; adds to `faults` what is not well-formed.
std::vector<Tag> tags_of(const std::string& html, std::vector<std::string>& faults) {
  const std::set<std::string> empty_tags = {"meta", "img", "br"};
  std::vector<Tag> tags;
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    if (html.compare(at, 9, "<!DOCTYPE") == 0) continue;
    std::size_t end = at;
    bool is_quoted = false;
    while (end < html.size() && (is_quoted || html[end] != '>')) is_quoted ^= html[end++] == '"';
    std::string text = html.substr(at + 1, end - at - 1);
    if (text[0] == '/') {
      if (open.empty() || open.back() != text.substr(1)) faults.push_back("closes </" + text.substr(1) + ">");
      if (!open.empty()) open.pop_back();
      continue;
    }
    Tag tag;
    tag.name = text.substr(0, text.find(' '));
    std::size_t place = tag.name.size();
    while ((place = text.find_first_not_of(' ', place)) != std::string::npos) {
      const std::size_t equals = text.find("=\"", place);
      const std::size_t quote = equals == std::string::npos ? equals : text.find('"', equals + 2);
      if (quote == std::string::npos) {
        faults.push_back("attribute in <" + text.substr(0, 80) + ">");
        break;
      }
      tag.attributes[text.substr(place, equals - place)] = text.substr(equals + 2, quote - equals - 2);
      place = quote + 1;
    }
    if (empty_tags.count(tag.name) == 0) open.push_back(tag.name);
    tags.push_back(tag);
    if (tag.name == "style") at = html.find("</style>", at) - 1;
  }
  for (const std::string& name : open) faults.push_back("never closes <" + name + ">");
  return tags;
}

}  // namespace

std::size_t check_page(const std::string& html) {
  CHECK(html.rfind("<!DOCTYPE html>\n<html lang=\"en\">", 0) == 0);
  std::vector<std::string> faults;
  const std::vector<Tag> tags = tags_of(html, faults);
  CHECK(faults == std::vector<std::string>{});
  std::set<std::string> ids;
  for (const Tag& tag : tags) {
    if (tag.attributes.count("id") == 1) CHECK(ids.insert(tag.attributes.at("id")).second);
  }
  std::size_t pictures = 0;
  for (const Tag& tag : tags) {
    CHECK(tag.name != "script");
    CHECK(tag.name != "link");
    if (tag.attributes.count("href") == 1) {
      const std::string target = tag.attributes.at("href");
      CHECK(target.at(0) == '#');
      CHECK(ids.count(target.substr(1)) == 1);
    }
    if (tag.name != "img") continue;
    ++pictures;
    CHECK(tag.attributes.at("src").rfind("data:image/", 0) == 0);
    CHECK(tag.attributes.at("alt").size() > 8);
  }
  CHECK(html.find("url(") == std::string::npos);
  return pictures;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool has_gnuplot() {
  return run_shell("command -v gnuplot").code == 0;
}

}  // namespace ramify::test
