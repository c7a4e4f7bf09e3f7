#pragma once

#include <string>

namespace oneac::internal {

/// The style sheet of an HtmlPage: light unless the reader's system is dark.
[[nodiscard]] std::string page_style();
/// What a plot needs of it, in the light colours, for programs that know no variables.
[[nodiscard]] std::string light_plot_style();

}  // namespace oneac::internal
