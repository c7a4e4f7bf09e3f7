#include "page_style.h"

#include <array>

namespace oneac::internal {
namespace {

/// A colour by its name, on white and on black. c0 … c9: Okabe and Ito's kind, then what tells
/// twenty curves apart together with dashes.
struct Colour {
  const char* name;
  const char* light;
  const char* dark;
};
constexpr std::array<Colour, 20> kColours = {{
    {"bg", "#ffffff", "#15181c"},   {"fg", "#1c1f23", "#e6e9ed"},
    {"dim", "#5b6470", "#9aa4b0"},  {"rule", "#d9dde2", "#343b44"},
    {"fine", "#eef0f3", "#22272e"}, {"panel", "#f4f6f8", "#1d2228"},
    {"warn", "#8a4b00", "#ffcf8a"}, {"warnbg", "#fff4e0", "#33270f"},
    {"best", "#0b6b3a", "#5fd39a"}, {"bad", "#b3261e", "#ff8a80"},
    {"c0", "#0072b2", "#5db4ee"},   {"c1", "#d55e00", "#ff9248"},
    {"c2", "#00875f", "#3fd0a4"},   {"c3", "#b0508a", "#ee9dcb"},
    {"c4", "#8a6d00", "#e3c64b"},   {"c5", "#3d4fb8", "#9aa8ff"},
    {"c6", "#7a4fd0", "#b79bff"},   {"c7", "#a03030", "#ff8f8f"},
    {"c8", "#4d6b1f", "#b5d975"},   {"c9", "#555f6b", "#c0c8d2"},
}};

constexpr const char* kPage = R"css(
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
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px}
.group table{width:100%}
caption{text-align:left;font-weight:600;padding:4px 0}
th,td{padding:3px 0 3px 8px;border-bottom:1px solid var(--rule);vertical-align:top;text-align:right}
th{background:var(--panel);font-weight:600}
th:first-child,td:first-child{text-align:left;padding:3px 8px 3px 0}
.scroll{overflow-x:auto;margin:8px 0}.scroll th,.scroll td{white-space:nowrap;padding:3px 8px}
td.best{color:var(--best);font-weight:700}td.bad{color:var(--bad);font-weight:600}
svg.plot{width:100%;height:auto}.figures svg:only-child{max-width:760px}
.legend{display:flex;flex-wrap:wrap;gap:4px 16px;margin:8px 0}
.legend label{display:inline-flex;align-items:center;gap:6px;cursor:pointer}
.legend svg{width:30px;height:10px}
figure{margin:0 0 18px;padding:0;max-width:960px}figcaption{margin-bottom:4px;font-size:14px}
svg.overlay{width:100%;height:auto;display:block;border-radius:4px}
details{margin:8px 0}summary{cursor:pointer;font-weight:600}
.inlier,.outlier{fill:none;stroke-width:1.3}
)css";

constexpr const char* kPlot = R"css(
svg.plot{font:12px system-ui,sans-serif}
svg text{fill:var(--dim)}svg .title{fill:var(--fg);font-weight:600;font-size:14px}
.grid{stroke:var(--rule)}.fine{stroke:var(--fine)}.axis{stroke:var(--dim)}
.curve{fill:none;stroke-width:1.6;stroke-linejoin:round}
.ring{fill:none;stroke-width:.7;opacity:.6}
.d1{stroke-dasharray:7 4}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:9 3 2 3}
)css";

std::string variables(const char* Colour::*shade) {
  std::string css = ":root{color-scheme:light dark";
  for (const Colour& colour : kColours) {
    css += ";--" + std::string(colour.name) + ":" + colour.*shade;
  }
  return css + "}";
}

std::string plot_style() {
  std::string css = kPlot;
  for (const char digit : std::string("0123456789")) {
    const std::string c = std::string("c") + digit;
    css += "." + c + "{stroke:var(--" + c + ")}.dot." + c + "{stroke:none;fill:var(--" + c + ")}\n";
  }
  return css;
}

}  // namespace

std::string page_style() {
  return variables(&Colour::light) + "\n@media (prefers-color-scheme:dark){" +
         variables(&Colour::dark) + "}" + kPage + plot_style();
}

std::string light_plot_style() {
  std::string css = plot_style();
  for (const Colour& colour : kColours) {
    const std::string variable = "var(--" + std::string(colour.name) + ")";
    for (auto at = css.find(variable); at != std::string::npos; at = css.find(variable, at)) {
      css.replace(at, variable.size(), colour.light);
    }
  }
  return css;
}

}  // namespace oneac::internal
