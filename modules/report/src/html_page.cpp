#include "oneac/report/html_page.h"

#include "page_style.h"
#include "svg_canvas.h"

#include "oneac/base/printable.h"

#include <cstdint>

namespace oneac {
namespace {

// The page loads nothing, not even when a text of the log tried to make it.
constexpr const char* kPolicy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'\">\n";

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string safe;
  for (const char letter : printable(text)) {
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
  Table table{caption, {}, {}};
  for (const auto& [name, value] : names_and_values) table.rows.push_back({{name}, {value}});
  body_ += table_html(table);
}

void HtmlPage::table(const Table& table) {
  body_ += "<div class=\"scroll\">" + table_html(table) + "</div>\n";
}

void HtmlPage::figures(const std::vector<std::string>& svgs) {
  body_ += "<div class=\"figures\">\n";
  for (const std::string& svg : svgs) body_ += svg;
  body_ += "</div>\n";
}

void HtmlPage::picture(const std::string& caption, const std::string& svg) {
  body_ += "<figure><figcaption>" + html_escaped(caption) + "</figcaption>\n" + svg + "</figure>\n";
}

void HtmlPage::legend(const std::vector<std::string>& labels) {
  std::string boxes, rules;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string number = std::to_string(i);
    boxes += "<label><input type=\"checkbox\" checked id=\"show" + number +
             "\"><svg viewBox=\"0 0 30 10\"><path class=\"curve " + internal::series_class(i) +
             "\" d=\"M0 5H30\"/></svg>" + html_escaped(labels[i]) + "</label>\n";
    rules += "body:has(#show" + number + ":not(:checked)) .plot .m" + number + "{display:none}\n";
  }
  body_ += "<style>" + rules + "</style><div class=\"legend\">\n" + boxes + "</div>\n";
}

void HtmlPage::begin_details(const std::string& summary) {
  body_ += "<details><summary>" + html_escaped(summary) + "</summary>\n";
}

void HtmlPage::end_details() {
  body_ += "</details>\n";
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
         title_ + "</title>\n<style>" + internal::page_style() + "</style></head><body>\n" + body_ +
         "</body></html>\n";
}

}  // namespace oneac
