#include "cli/experiment/html.h"

#include <fmt/format.h>

#include "common/config/provenance.h"

namespace ramify::cli {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c1c1a; --soft: #5c5c57; --paper: #fdfdfb; --shade: #f1f1ec; --line: #d5d5cd;
  --accent: #0a5c8c; --mark: #fff1c4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e4df; --soft: #a5a59e; --paper: #191a1b; --shade: #242628;
  --line: #3d4043; --accent: #7cc0ea; --mark: #47401f; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem clamp(1rem, 4vw, 3rem) 4rem; max-width: 76rem; background: var(--paper);
  color: var(--ink); font: 1rem/1.55 system-ui, sans-serif; }
h1 { font-size: 1.8rem; line-height: 1.2; margin: 0 0 1rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 0.75rem; padding-top: 0.75rem; border-top: 1px solid var(--line); }
p { max-width: 48rem; }
a { color: var(--accent); }
a:focus-visible, summary:focus-visible, .scroll:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
.skip { position: absolute; left: -100rem; }
.skip:focus { left: 1rem; top: 0.5rem; background: var(--paper); padding: 0.25rem 0.75rem; }
.opening { font-size: 1.1rem; background: var(--shade); padding: 1rem 1.25rem; border-left: 4px solid var(--accent);
  max-width: 60rem; }
.opening p { margin: 0.4rem 0; max-width: none; }
nav ul { list-style: none; display: flex; flex-wrap: wrap; gap: 0.25rem 1.25rem; padding: 0; }
.figures { display: grid; gap: 1.25rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 11rem), 1fr)); }
.figures + .figures { margin-top: 1.25rem; }
.tables { display: flex; flex-wrap: wrap; gap: 0 2.5rem; } .tables .scroll { max-width: 100%; }
.plots { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 29rem), 1fr)); }
figure { margin: 0; min-width: 0; }
figure img { display: block; width: 100%; height: auto; border: 1px solid var(--line); border-radius: 4px; }
figcaption { font-size: 0.9rem; margin-top: 0.4rem; overflow-wrap: anywhere; }
code { font: 0.85em/1.4 ui-monospace, monospace; background: var(--shade); padding: 0.1em 0.35em; border-radius: 3px;
  overflow-wrap: anywhere; }
.command { display: block; margin-top: 0.35rem; padding: 0.35em 0.6em; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: 0.4rem; max-width: 48rem; }
th, td { padding: 0.25rem 0.75rem; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; }
th[scope=row], th:first-child { text-align: left; }
thead th { border-bottom: 2px solid var(--soft); vertical-align: bottom; }
.words { text-align: left; white-space: normal; } td.words { color: var(--soft); min-width: 11rem; }
mark { background: var(--mark); color: inherit; padding: 0 0.3em; border-radius: 3px; font-weight: 600; }
.key, mark { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.key { display: inline-block; width: 0.8em; height: 0.8em; border-radius: 2px; margin-right: 0.35em; }
summary { cursor: pointer; color: var(--accent); }
footer { margin-top: 3rem; padding-top: 0.75rem; border-top: 1px solid var(--line); color: var(--soft); font-size: 0.9rem; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; background: var(--shade); padding: 0.75rem; font: 0.85rem/1.4 ui-monospace, monospace; }
@media print {
  :root { color-scheme: light; --ink: #000; --soft: #444; --paper: #fff; --shade: #f4f4f0; --line: #bbb; --accent: #000;
    --mark: #eee; }
  @page { margin: 15mm; }
  body { padding: 0; max-width: none; font-size: 10pt; }
  nav, .skip, details { display: none; }
  h2 { break-after: avoid; }
  figure, tr { break-inside: avoid; }
  .scroll { overflow: visible; }
  table { font-size: 7.5pt; }
  th, td { padding: 1.5pt 5pt; white-space: normal; }
  .figures { grid-template-columns: repeat(4, 1fr); gap: 4mm; }
  .figures figcaption { font-size: 7pt; }
  .plots { grid-template-columns: repeat(2, 1fr); gap: 5mm; }
}
)";

}  // namespace

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n') result += c;
    }
  }
  return result;
}

std::string data_url(std::string_view media_type, std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string url = fmt::format("data:{};base64,", media_type);
  url.reserve(url.size() + bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return at < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) : 0u;
    };
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    url += kDigits[three >> 18];
    url += kDigits[three >> 12 & 63];
    url += i + 1 < bytes.size() ? kDigits[three >> 6 & 63] : '=';
    url += i + 2 < bytes.size() ? kDigits[three & 63] : '=';
  }
  return url;
}

std::string figure(const Picture& picture, const std::string& caption, const std::string& command) {
  const std::string size =
      picture.width > 0 ? fmt::format(" width=\"{}\" height=\"{}\"", picture.width, picture.height) : "";
  const std::string made_by =
      command.empty() ? "" : fmt::format("<code class=\"command\">{}</code>", html_text(command));
  std::string image =
      fmt::format("<img src=\"{}\" alt=\"{}\"{}>", data_url(picture.media_type, picture.bytes),
                  html_text(picture.alternative), size);
  if (!picture.link.empty()) image = fmt::format("<a href=\"{}\">{}</a>", html_text(picture.link), image);
  return fmt::format("<figure>{}<figcaption>{}{}</figcaption></figure>\n", image, caption, made_by);
}

std::string table(const std::string& caption, const std::vector<std::vector<std::string>>& rows,
                  bool has_words_last) {
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" "
      "aria-label=\"{0}\"><table><caption>{0}</caption>\n",
      html_text(caption));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0) html += "<thead>";
    if (i == 1) html += "<tbody>";
    html += "<tr>";
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      const bool is_words = has_words_last && j + 1 == rows[i].size();
      const char* kind = is_words ? " class=\"words\"" : "";
      if (i == 0) {
        html += fmt::format("<th scope=\"col\"{}>{}</th>", kind, rows[i][j]);
      } else if (j == 0) {
        html += fmt::format("<th scope=\"row\">{}</th>", rows[i][j]);
      } else {
        html += fmt::format("<td{}>{}</td>", kind, rows[i][j]);
      }
    }
    html += "</tr>\n";
    if (i == 0) html += "</thead>\n";
  }
  return html + (rows.size() > 1 ? "</tbody>" : "") + "</table></div>\n";
}

std::string foldable(const std::string& summary, const std::string& content) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", html_text(summary), content);
}

std::string page(const std::string& title, const std::string& opening, const std::vector<Section>& sections) {
  std::string contents;
  std::string body;
  for (const Section& section : sections) {
    contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, html_text(section.heading));
    body += fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n",
                        section.id, html_text(section.heading), section.content);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#main\">To the "
      "results</a>\n"
      "<header><h1>{0}</h1></header>\n<main id=\"main\">\n<div class=\"opening\">\n{2}</div>\n"
      "<nav aria-label=\"Contents\"><ul>\n{3}</ul></nav>\n{4}</main>\n<footer>ramify "
      "{5}</footer>\n</body>\n</html>\n",
      html_text(title), kStyle, opening, contents, body, html_text(version()));
}

}  // namespace ramify::cli
