#pragma once

namespace mimicry::cli {

inline constexpr const char* kPageStyle = R"css(
:root { color-scheme: light; }
body { margin: 0 auto; padding: 1.5rem; max-width: 74rem; background: #fff; color: #222;
  font: 15px/1.5 "DejaVu Sans", Verdana, sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .3rem; }
h2 { font-size: 1.15rem; margin: 2.4rem 0 .5rem; padding-top: .8rem; border-top: 1px solid #ddd; }
p { max-width: 60rem; margin: .5rem 0; }
nav a { margin-right: 1rem; }
a { color: #0057a3; }
table { border-collapse: collapse; margin: .8rem 0; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { padding: .22rem .5rem; text-align: right; white-space: nowrap; }
th { font-weight: normal; vertical-align: bottom; color: #444; border-bottom: 1px solid #888; }
th.group { text-align: center; }
td:first-child, th:first-child, td.text, th.text { text-align: left; }
td.reason { white-space: normal; min-width: 16rem; }
tbody tr:hover { background: #f4f7fb; }
tr.head td { padding-top: .9rem; border-bottom: 1px solid #bbb; text-align: left; }
.paper { background: #f6f4ee; color: #555; }
.agrees { color: #1b6e2b; }
.differs { color: #a32114; }
.unit { color: #777; }
.swatch { display: inline-block; width: .75em; height: .75em; margin-right: .4em; }
.wide { overflow-x: auto; }
.plot svg { max-width: 100%; height: auto; }
.save { margin: 0; font-size: .8rem; }
.save a { margin-right: .8rem; }
.gallery { display: grid; grid-template-columns: repeat(auto-fit, minmax(17rem, 1fr)); gap: .8rem; margin: .6rem 0 1.2rem; }
figure { margin: 0; max-width: 440px; }
sub { line-height: 0; }
h3 { font-size: 1rem; margin: 1.2rem 0 .3rem; }
figure img { width: 100%; display: block; border: 1px solid #e3e3e3; }
figcaption { font-size: .8rem; }
details summary { cursor: pointer; }
.notice { max-width: none; margin: .6rem 0; padding: .5rem .8rem; background: #fff3d6; border-left: 4px solid #c98a00; }
noscript p { padding: .5rem .8rem; background: #fff3d6; }
@media print { body { max-width: none; padding: 0; font-size: 11px; } .save, nav { display: none; }
  h2 { break-after: avoid; } figure, .plot { break-inside: avoid; } }
)css";

}  // namespace mimicry::cli
