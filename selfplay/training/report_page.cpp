#include "selfplay/training/report_page.h"

#include <fmt/format.h>

#include "selfplay/training/chart.h"

namespace selfplay::training {

const std::string_view page_head = R"part(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>sanban train</title>
<meta name="viewport" content="width=device-width">
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 24px auto; max-width: 1460px; padding: 0 20px;
       color: #222; background: #fff; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 17px; margin: 28px 0 6px; }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(420px, 1fr)); gap: 14px; }
svg { width: 100%; display: block; }
.charts svg { border: 1px solid #ddd; border-radius: 4px; }
table { border-collapse: collapse; } td, th { padding: 2px 14px 2px 0; text-align: left; }
td:nth-child(n+2), th:nth-child(n+2) { text-align: right; font-variant-numeric: tabular-nums; }
.settings td:nth-child(3) { text-align: left; color: #666; }
#board { max-width: 440px; } #steps { width: 440px; max-width: 100%; }
button { min-width: 36px; }
</style></head><body>
)part";

const std::string_view page_board = R"part(<div id="board"></div>
<p><button id="first">|&lt;</button> <button id="back">&lt;</button>
<button id="next">&gt;</button> <button id="last">&gt;|</button> <span id="told"></span><br>
<input id="steps" type="range" min="0" value="0"></p>
)part";

const std::string_view page_script = R"part(const pieces = {
  K: "\u2654", Q: "\u2655", R: "\u2656", B: "\u2657", N: "\u2658", P: "\u2659",
  k: "\u265a", q: "\u265b", r: "\u265c", b: "\u265d", n: "\u265e", p: "\u265f"};
const shogi = {P: "\u6b69", L: "\u9999", N: "\u6842", S: "\u9280", G: "\u91d1", B: "\u89d2",
  R: "\u98db", K: "\u7389", "+P": "\u3068", "+L": "\u674f", "+N": "\u572d", "+S": "\u5168",
  "+B": "\u99ac", "+R": "\u9f8d"};
const go = sample.game === "go";
function cells(text) {
  return text.split(" ")[0].split("/").map(row => {
    const line = [];
    for (const part of row.match(/\d+|\+?[A-Za-z]/g) || [])
      if (/\d/.test(part)) for (let i = 0; i < +part; i++) line.push("");
      else line.push(part);
    return line;
  });
}
function mark(x, y, part) {
  const cx = x * 40 + 20, cy = y * 40 + 20;
  if (go)
    return `<circle cx="${cx}" cy="${cy}" r="18" fill="${part === "X" ? "#111" : "#fff"}" stroke="#111"/>`;
  const first = part === part.toUpperCase();
  const glyph = sample.game === "chess" ? pieces[part] : shogi[part.toUpperCase()];
  const turn = sample.game === "shogi" && !first ? ` transform="rotate(180 ${cx} ${cy})"` : "";
  return `<text x="${cx}" y="${cy + 11}"${turn} style="font-size:31px;fill:#111;text-anchor:middle">${glyph}</text>`;
}
function lines(size) {
  const from = go ? 20 : 0, to = size * 40 - from;
  let svg = "";
  for (let i = 0; i <= (go ? size - 1 : size); i++) {
    const at = i * 40 + from;
    svg += `<path d="M${from} ${at}H${to}M${at} ${from}V${to}" stroke="#765" fill="none"/>`;
  }
  return svg;
}
function draw(step) {
  const now = cells(sample.positions[step]);
  const before = step > 0 ? cells(sample.positions[step - 1]) : now;
  const side = now.length * 40;
  let svg = `<svg viewBox="0 0 ${side} ${side}"><rect width="${side}" height="${side}" fill="#e9c98a"/>`;
  svg += lines(now.length);
  now.forEach((line, y) => line.forEach((part, x) => {
    const changed = part !== before[y][x];
    if (changed && !go)
      svg += `<rect x="${x * 40}" y="${y * 40}" width="40" height="40" fill="#f6e05e" opacity=".6"/>`;
    if (part) svg += mark(x, y, part);
    if (part && changed && go)
      svg += `<circle cx="${x * 40 + 20}" cy="${y * 40 + 20}" r="6" fill="#d33"/>`;
  }));
  document.getElementById("board").innerHTML = svg + "</svg>";
  const hand = sample.game === "shogi" ? ", in hand " + sample.positions[step].split(" ")[2] : "";
  document.getElementById("told").textContent = step === 0 ? "before the first move" :
    `move ${step}: ${sample.moves[step - 1]}, value ${sample.values[step - 1].toFixed(2)} for the first player` + hand;
  steps.value = step;
}
const steps = document.getElementById("steps");
steps.max = sample.moves.length;
const show = step => draw(Math.max(0, Math.min(sample.moves.length, step)));
document.getElementById("first").onclick = () => show(0);
document.getElementById("back").onclick = () => show(+steps.value - 1);
document.getElementById("next").onclick = () => show(+steps.value + 1);
document.getElementById("last").onclick = () => show(sample.moves.length);
steps.oninput = () => show(+steps.value);
show(Math.min(20, sample.moves.length));
)part";

const std::string_view page_end = "</body></html>\n";

std::string setting_lines(std::span<const engine::OptionRow> rows) {
    std::string lines;
    for (const auto& row : rows)
        lines += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(row.name),
                             escaped(row.value), escaped(row.help));
    return lines;
}

}  // namespace selfplay::training
