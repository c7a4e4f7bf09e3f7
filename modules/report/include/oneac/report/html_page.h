#pragma once

#include "oneac/report/table.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oneac {

/// For text and attributes of HTML and SVG.
[[nodiscard]] std::string html_escaped(std::string_view text);
/// RFC 4648, padded.
[[nodiscard]] std::string base64_of(std::string_view bytes);

/// One HTML file that needs nothing else: style inside, pictures as data URIs, no script, and a
/// policy that forbids the browser to load anything. Light or dark as the reader's system is.
class HtmlPage {
 public:
  using Rows = std::vector<std::pair<std::string, std::string>>;

  /// Texts are escaped here and below; only `svg` elements go in as they are.
  HtmlPage(const std::string& title, const std::string& subtitle);

  /// Opens a section.
  void heading(const std::string& text);
  /// A remark in grey.
  void paragraph(const std::string& text);
  /// A sentence that must not be overlooked.
  void warning(const std::string& text);
  /// Large values with their names.
  void tiles(const Rows& names_and_values);
  /// A table of names and values under a caption.
  void table(const std::string& caption, const Rows& names_and_values);
  /// A table as wide as it takes, which scrolls on a narrow screen.
  void table(const Table& table);
  /// Figures beside each other where the window is wide enough.
  void figures(const std::vector<std::string>& svgs);
  /// A figure with a caption.
  void picture(const std::string& caption, const std::string& svg);
  /// What tells the series of plots without a legend of their own apart: a label for each, with a
  /// box that shows and hides it. @pre once on a page
  void legend(const std::vector<std::string>& labels);
  /// Tables that follow stand beside each other until the group ends.
  void begin_group();
  /// Ends what begin_group() began.
  void end_group();
  /// What follows is folded away under a summary until the end.
  void begin_details(const std::string& summary);
  /// Ends what begin_details() began.
  void end_details();

  /// The whole file.
  [[nodiscard]] std::string text() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace oneac
