#pragma once

namespace oneac::internal {

/// Light unless the reader's system is dark; twenty curves told apart by colour and dashes.
inline constexpr const char* kPageStyle = R"css(
:root{color-scheme:light dark;--bg:#ffffff;--fg:#1c1f23;--dim:#5b6470;--rule:#d9dde2;--fine:#eef0f3;
--head:#f4f6f8;--best:#0b6b3a;--bad:#b3261e;
--c0:#0072b2;--c1:#d55e00;--c2:#00875f;--c3:#b0508a;--c4:#8a6d00;--c5:#3d4fb8;--c6:#7a4fd0;--c7:#a03030;
--c8:#4d6b1f;--c9:#555f6b}
@media (prefers-color-scheme:dark){:root{--bg:#15181c;--fg:#e6e9ed;--dim:#9aa4b0;--rule:#343b44;
--fine:#22272e;--head:#1d2228;--best:#5fd39a;--bad:#ff8a80;
--c0:#5db4ee;--c1:#ff9248;--c2:#3fd0a4;--c3:#ee9dcb;--c4:#e3c64b;--c5:#9aa8ff;--c6:#b79bff;--c7:#ff8f8f;
--c8:#b5d975;--c9:#c0c8d2}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1120px;padding:24px 20px 60px;background:var(--bg);color:var(--fg);
font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
h1{font-size:26px;margin:0 0 4px}h2{font-size:19px;margin:36px 0 10px}p{margin:6px 0;max-width:80ch}
.dim{color:var(--dim)}.scroll{overflow-x:auto}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px;margin:8px 0}
th,td{padding:3px 8px;border-bottom:1px solid var(--rule);text-align:right;white-space:nowrap}
th{background:var(--head);font-weight:600}th.name,td.name{text-align:left}
td.best{color:var(--best);font-weight:700}td.bad{color:var(--bad);font-weight:600}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:12px}
svg.cdf{width:100%;height:auto;font:12px system-ui,sans-serif}
svg text{fill:var(--dim)}svg .title{fill:var(--fg);font-weight:600;font-size:14px}
.grid{stroke:var(--rule)}.fine{stroke:var(--fine)}
.curve{fill:none;stroke-width:2}
.c0{stroke:var(--c0)}.c1{stroke:var(--c1)}.c2{stroke:var(--c2)}.c3{stroke:var(--c3)}.c4{stroke:var(--c4)}
.c5{stroke:var(--c5)}.c6{stroke:var(--c6)}.c7{stroke:var(--c7)}.c8{stroke:var(--c8)}.c9{stroke:var(--c9)}
.d1{stroke-dasharray:7 4}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:9 3 2 3}
.legend{display:flex;flex-wrap:wrap;gap:4px 16px;margin:8px 0}
.legend label{display:inline-flex;align-items:center;gap:6px;cursor:pointer}
.legend svg{width:30px;height:10px}
.off{display:none}
figure{margin:18px 0;padding:0}figure img{width:100%;height:auto;border-radius:4px;display:block}
figcaption{margin-bottom:6px}details{margin:8px 0}summary{cursor:pointer;font-weight:600}
@media (max-width:520px){.plots{grid-template-columns:1fr}}
)css";

/// The boxes of the legend show and hide a method's curves. The page is complete without it.
inline constexpr const char* kPageScript = R"js(
document.querySelectorAll('.legend input').forEach(box => box.addEventListener('change', () =>
  document.querySelectorAll('.plots .' + box.dataset.curve).forEach(path =>
    path.classList.toggle('off', !box.checked))));
)js";

}  // namespace oneac::internal
