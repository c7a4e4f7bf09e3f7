#include "oneac/evaluation/html_page.h"

#include <cstdint>

namespace oneac {
namespace {

// Six colours of Okabe and Ito's kind, darker on white and lighter on black.
constexpr const char* kStyle = R"css(
:root{color-scheme:light dark;--bg:#ffffff;--fg:#1c1f23;--dim:#5b6470;--rule:#d9dde2;
--panel:#f4f6f8;--warn:#8a4b00;--warnbg:#fff4e0;
--c0:#0072b2;--c1:#d55e00;--c2:#00875f;--c3:#b0508a;--c4:#8a6d00;--c5:#555f6b}
@media (prefers-color-scheme:dark){:root{--bg:#15181c;--fg:#e6e9ed;--dim:#9aa4b0;--rule:#343b44;
--panel:#1d2228;--warn:#ffcf8a;--warnbg:#33270f;
--c0:#5db4ee;--c1:#ff9248;--c2:#3fd0a4;--c3:#ee9dcb;--c4:#e3c64b;--c5:#c0c8d2}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1160px;padding:24px 20px 60px;background:var(--bg);color:var(--fg);
font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;overflow-wrap:anywhere}
h1{font-size:26px;margin:0 0 4px}h2{font-size:19px;margin:36px 0 10px}p{margin:6px 0;max-width:84ch}
.dim{color:var(--dim)}
.warning{color:var(--warn);background:var(--warnbg);padding:6px 10px;border-radius:4px}
.tiles{display:flex;flex-wrap:wrap;gap:10px;margin:16px 0}
.tiles div{background:var(--panel);border-radius:6px;padding:8px 14px}
.tiles b{display:block;font-size:21px;font-variant-numeric:tabular-nums}
.tiles span{color:var(--dim);font-size:13px}
.figures,.group{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(440px,100%),1fr));
gap:14px;align-items:start}
.group{grid-template-columns:repeat(auto-fit,minmax(min(300px,100%),1fr))}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px;width:100%}
caption{text-align:left;font-weight:600;padding:4px 0}
td{padding:3px 8px 3px 0;border-bottom:1px solid var(--rule);vertical-align:top}
td+td{text-align:right;padding-right:0}
svg.plot{width:100%;height:auto;font:12px system-ui,sans-serif}
.figures svg:only-child{max-width:760px}
svg text{fill:var(--dim)}svg .title{fill:var(--fg);font-weight:600;font-size:14px}
.grid{stroke:var(--rule)}.axis{stroke:var(--dim)}
.curve{fill:none;stroke-width:1.6;stroke-linejoin:round}
.c0{stroke:var(--c0)}.c1{stroke:var(--c1)}.c2{stroke:var(--c2)}.c3{stroke:var(--c3)}
.c4{stroke:var(--c4)}.c5{stroke:var(--c5)}
.dot{stroke:none}.dot.c0{fill:var(--c0)}.dot.c1{fill:var(--c1)}.dot.c2{fill:var(--c2)}
.dot.c3{fill:var(--c3)}.dot.c4{fill:var(--c4)}.dot.c5{fill:var(--c5)}
figure{margin:0 0 18px;padding:0;max-width:960px}figcaption{margin-bottom:4px;font-size:14px}
svg.snapshot{width:100%;height:auto;display:block;border-radius:4px}
.inlier,.outlier{fill:none;stroke-width:1.3}.inlier{stroke:#4fc3ff}.outlier{stroke:#ff8c2e}
)css";

// The page loads nothing, not even when a text of the log tried to make it.
constexpr const char* kPolicy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'\">\n";

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

std::string base64_of(std::string_view bytes) {
  static constexpr char kLetters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t group = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kLetters[group >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

HtmlPage::HtmlPage(const std::string& title, const std::string& subtitle)
    : title_(html_escaped(title)) {
  body_ = "<h1>" + title_ + "</h1>\n<p class=\"dim\">" + html_escaped(subtitle) + "</p>\n";
}

void HtmlPage::heading(const std::string& text) {
  body_ += "<h2>" + html_escaped(text) + "</h2>\n";
}

void HtmlPage::paragraph(const std::string& text) {
  body_ += "<p class=\"dim\">" + html_escaped(text) + "</p>\n";
}

void HtmlPage::warning(const std::string& text) {
  body_ += "<p class=\"warning\">" + html_escaped(text) + "</p>\n";
}

void HtmlPage::tiles(const Rows& names_and_values) {
  body_ += "<div class=\"tiles\">\n";
  for (const auto& [name, value] : names_and_values) {
    body_ +=
        "<div><b>" + html_escaped(value) + "</b><span>" + html_escaped(name) + "</span></div>\n";
  }
  body_ += "</div>\n";
}

void HtmlPage::table(const std::string& caption, const Rows& names_and_values) {
  body_ += "<table><caption>" + html_escaped(caption) + "</caption>\n";
  for (const auto& [name, value] : names_and_values) {
    body_ += "<tr><td>" + html_escaped(name) + "</td><td>" + html_escaped(value) + "</td></tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlPage::figures(const std::vector<std::string>& svgs) {
  body_ += "<div class=\"figures\">\n";
  for (const std::string& svg : svgs) body_ += svg;
  body_ += "</div>\n";
}

void HtmlPage::picture(const std::string& caption, const std::string& svg) {
  body_ += "<figure><figcaption>" + html_escaped(caption) + "</figcaption>\n" + svg + "</figure>\n";
}

void HtmlPage::begin_group() {
  body_ += "<div class=\"group\">\n";
}

void HtmlPage::end_group() {
  body_ += "</div>\n";
}

std::string HtmlPage::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" +
         std::string(kPolicy) +
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
         title_ + "</title>\n<style>" + kStyle + "</style></head><body>\n" + body_ +
         "</body></html>\n";
}

}  // namespace oneac
