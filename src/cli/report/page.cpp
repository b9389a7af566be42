#include "cli/report/page.h"

#include <cmath>

#include "base/comma_list.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/report/base64.h"
#include "cli/report/bundle.h"
#include "cli/report/page_style.h"
#include "lab/columns.h"
#include "lab/paper_agreement.h"
#include "lab/report_data.h"

namespace mimicry::cli {
namespace {

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : printable(text)) switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  return html;
}

std::string tag(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name.substr(0, name.find(' ')) + ">";
}

std::string cell(const std::string& content) {
  return tag("td", content);
}

std::string row(const std::vector<std::string>& cells) {
  std::string html;
  for (const std::string& c : cells) html += cell(c);
  return tag("tr", html) + "\n";
}

// A method with its colour.
std::string method_label(const std::string& method) {
  return "<span class=\"swatch\" style=\"background:" + method_color(method) + "\"></span>" +
         escaped(method);
}

std::string count(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}
std::string count(std::size_t n, const std::string& noun) {
  return count(n, noun, noun + "s");
}

std::string joined_names(const std::vector<std::string>& names) {
  return comma_list(names, [](const std::string& name) { return escaped(name); });
}

// True minus signs, and "<" as text.
std::string shown(const std::string& number) {
  if (number == "-0.00") return "0.00";
  return number.starts_with("-") && number.size() > 1 ? "\u2212" + number.substr(1)
                                                      : escaped(number);
}

std::string percent(double part) {
  return std::isfinite(part) ? fixed(100 * part, 1) + " %" : "-";
}

std::string mean_and_deviation(double mean, double deviation) {
  return shown(significant(mean)) + " ± " + significant(deviation);
}

std::string group_title(const std::string& name) {
  const std::string title = name.starts_with("task ") ? name.substr(5) : name;
  if (title == "tracing") return "Tracing";
  if (title == "re-creating") return "Re-creating";
  return title == "all" ? "All strokes" : escaped(title);
}

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] += 'a' - 'A';
  return text;
}

// Not by colour alone.
std::string mark(bool agrees, const std::string& what) {
  return std::string(" <span class=\"") + (agrees ? "agrees" : "differs") + "\" title=\"" + what +
         (agrees ? "\">✓" : "\">✗") + "</span>";
}

std::string paper_cells(const PaperFigure* paper, const Comparison& ours) {
  const auto in_cell = [](const std::string& text) { return tag("td class=\"paper\"", text); };
  if (paper == nullptr) return in_cell("") + in_cell("") + in_cell("") + in_cell("");
  const Agreement agreement = mimicry::agreement(ours, *paper);
  // Its own digits.
  const auto mean = [](double value, double deviation) {
    return fixed(value, value >= 100 ? 0 : 2) + " ± " + fixed(deviation, value >= 100 ? 0 : 2);
  };
  const auto near = [](bool agrees) {
    return mark(agrees, std::string("our mean is ") + (agrees ? "within" : "more than") + " 25 %" +
                            (agrees ? "" : " off"));
  };
  const bool difference = agreement.difference(*paper);
  return in_cell(mean(paper->spraycan, paper->spraycan_deviation) + near(agreement.spraycan_mean)) +
         in_cell(mean(paper->mimicry, paper->mimicry_deviation) + near(agreement.mimicry_mean)) +
         in_cell(shown(fixed(paper->z, 2))) +
         in_cell(escaped(std::string(paper->p)) +
                 mark(difference, difference ? "our difference has its sign and significance"
                                             : "our difference has another sign or significance"));
}

bool is_significant(const Comparison& c) {
  return c.pairs > 0 && c.test.p() < 0.05;
}

std::string comparison_row(const Comparison& c, const lab::MethodPair& pair,
                           const std::string& group, bool with_paper) {
  const lab::PaperMeasure& measure = *lab::paper_measure(c.name);
  const bool significantly = is_significant(c);
  const auto strong = [significantly](const std::string& text) {
    return significantly ? tag("b", text) : text;
  };
  std::string html = cell(std::string(measure.html) + " <span class=\"unit\">" +
                          std::string(measure.unit) + "</span>");
  html += cell(strong(mean_and_deviation(c.a.mean, c.a.standard_deviation)));
  html += cell(strong(mean_and_deviation(c.b.mean, c.b.standard_deviation)));
  html += cell(strong(shown(fixed(c.test.z, 2))));
  html += cell(strong(shown(probability(c.test.p()))));
  html += cell(shown(probability(c.p_holm)));
  html += cell(shown(participants_probability(c)));
  html += cell(shown(fixed(c.test.effect_r, 2)));
  html +=
      cell(shown(significant(c.difference.low)) + " to " + shown(significant(c.difference.high)));
  if (with_paper) html += paper_cells(lab::published_figure(pair.a, pair.b, group, c.name), c);
  return tag("tr", html) + "\n";
}

std::string comparison_table(const lab::MethodPair& pair, double level) {
  std::vector<lab::AgreementCount> agreements;
  lab::AgreementCount all;
  for (std::size_t g = 0; g < pair.groups.size(); ++g) {
    agreements.push_back(lab::count_agreement(pair.a, pair.b, pair.groups[g], pair.comparisons[g]));
    all += agreements.back();
  }
  const bool with_paper = all.rows > 0;
  std::string head = "<th></th><th>" + method_label(pair.a) + "</th><th>" + method_label(pair.b) +
                     "</th><th>z</th><th>p</th><th>p, Holm</th><th>p, "
                     "by<br>participant</th><th>r</th><th>difference, " +
                     fixed(100 * level, 0) + " %</th>";
  std::string above;
  if (with_paper) {
    head +=
        "<th class=\"paper\">spraycan</th><th class=\"paper\">mimicry</th>"
        "<th class=\"paper\">z</th><th class=\"paper\">p</th>";
    above =
        "<tr><th colspan=\"9\"></th><th colspan=\"4\" class=\"paper group\">the paper</th></tr>";
  }
  std::string body;
  for (std::size_t g = 0; g < pair.groups.size(); ++g) {
    const lab::PairedGroup& group = pair.groups[g];
    std::string title = tag("b", group_title(group.name)) + ": " + count(group.pairs, "pair");
    if (const auto& rows = pair.comparisons[g]; !rows.empty() && rows.front().participants > 0)
      title += " of " + count(static_cast<std::size_t>(rows.front().participants), "participant");
    if (group.failed > 0) title += ", " + std::to_string(group.failed) + " left out";
    if (group.unpaired > 0) title += ", " + std::to_string(group.unpaired) + " without a partner";
    std::string paper;
    if (const lab::AgreementCount& agree = agreements[g]; agree.rows > 0)
      paper = count(static_cast<std::size_t>(group.name == "task tracing" ? kPaperTracingPairs
                                                                          : kPaperReCreatingPairs),
                    "pair") +
              "; agree: means " + std::to_string(agree.means) + ", differences " +
              std::to_string(agree.differences) + " of " + std::to_string(agree.rows);
    body += "<tr class=\"head\"><td colspan=\"9\">" + title + "</td>" +
            (with_paper ? "<td colspan=\"4\" class=\"paper\">" + paper + "</td>" : "") + "</tr>\n";
    for (const Comparison& c : pair.comparisons[g])
      body += comparison_row(c, pair, group.name, with_paper);
  }
  return "<div class=\"wide\"><table class=\"comparison\"><thead>" + above + tag("tr", head) +
         "</thead><tbody>\n" + body + "</tbody></table></div>\n" +
         (with_paper
              ? tag("p id=\"agreement\"",
                    "Beside the paper's table: " + all.text() +
                        ". Ticks: our mean is within 25 % of the one they stand at; at p, the "
                        "difference has the same sign and, at .05, significance (only the "
                        "latter where the paper found no difference).") +
                    "\n"
              : "");
}

std::string plot(const std::string& id, const std::string& label) {
  return "<div class=\"plot wide\" role=\"img\" aria-label=\"" + escaped(label) +
         "\" data-figure=\"" + id + "\"></div>\n";
}

std::string section(const std::string& id, const std::string& title, const std::string& content) {
  return "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string introduction(const lab::Summary& summary,
                         const std::vector<lab::RejectedStroke>& rejected) {
  const std::size_t strokes = summary.counted.size() + summary.failed.size();
  std::string text = count(strokes, "measured stroke");
  if (summary.participants > 0) text += " of " + count(summary.participants, "participant");
  text += " on " + count(summary.shapes.size(), "shape") + " (" + joined_names(summary.shapes) +
          ") with " + count(summary.methods.size(), "technique") + " (" +
          joined_names(summary.methods) + "). " + std::to_string(summary.counted.size()) + " (" +
          percent(static_cast<double>(summary.counted.size()) / static_cast<double>(strokes)) +
          ") pass the filters";
  text += ".";
  if (!rejected.empty())
    text += " " + count(rejected.size(), "stroke or file", "strokes or files") +
            " could not be measured.";
  if (summary.tutorial > 0)
    text += " The tutorial's " + count(summary.tutorial, "stroke") + " are left out.";
  return tag("p", text);
}

// Says first what a reader must not miss.
std::string simulation_notice(const lab::Summary& summary) {
  if (summary.simulated == 0) return "";
  const std::size_t strokes = summary.counted.size() + summary.failed.size();
  constexpr std::size_t kMost = 5;
  std::vector<std::string> programs = summary.simulated_by;
  if (programs.size() > kMost) {
    programs.resize(kMost);
    programs.emplace_back("and more");
  }
  const std::string which = summary.simulated == strokes ? "No person drew these strokes: they are"
                                                         : std::to_string(summary.simulated) +
                                                               " of " + count(strokes, "stroke") +
                                                               " were drawn by no person: they are";
  return tag("p class=\"notice\" id=\"simulated\"",
             tag("b", "Simulated.") + " " + which + " made by " + joined_names(programs) +
                 ". They show what the model of people assumes, and are no evidence of how people "
                 "draw.") +
         "\n";
}

// Of rows in bold, those whose interval spans 0: "T_c (tracing)".
std::string bold_spanning_zero(const lab::MethodPair& pair) {
  std::vector<std::string> rows;
  for (std::size_t g = 0; g < pair.groups.size(); ++g)
    for (const Comparison& c : pair.comparisons[g])
      if (is_significant(c) && c.difference.low <= 0 && c.difference.high >= 0)
        rows.push_back(std::string(lab::paper_measure(c.name)->html) + " (" +
                       lower_first(group_title(pair.groups[g].name)) + ")");
  if (rows.empty()) return "";
  return tag("p id=\"spanning-zero\"",
             "Bold, though the interval of the difference spans 0: " + comma_list(rows) +
                 ". The two ask different things. The test ranks the differences, so that most "
                 "pairs decide; the interval is of their mean, which a few large differences move "
                 "and widen.") +
         "\n";
}

std::string comparisons(const lab::Summary& summary, double level) {
  if (summary.pairs.empty())
    return tag("p", "There is one technique only: nothing to compare it with.");
  std::string html =
      "<p>Mean ± standard deviation over the pairs of which both strokes count. z and p: "
      "Wilcoxon's "
      "signed-rank test, z &gt; 0 where the first technique's values are larger; <b>bold</b> where "
      "p &lt; .05. Holm: p corrected for all measures of a group. By participant: the test of the "
      "participants' means; the strokes of one person resemble each other, which the test over "
      "strokes (the paper's) takes no account of, so that its p is too small. Of "
      "n participants it cannot be below 2 / 2<sup>n</sup>: five or fewer cannot reach .05. r = z "
      "/ √N. "
      "Difference: bootstrap interval (BCa) of the mean difference. The same as <code>mimicry "
      "compare</code>.</p>\n";
  for (const lab::MethodPair& pair : summary.pairs) {
    if (summary.pairs.size() > 1) html += tag("h3", escaped(pair.a) + " and " + escaped(pair.b));
    html += comparison_table(pair, level) + bold_spanning_zero(pair);
  }
  return html;
}

std::string smoothness(const lab::Summary& summary) {
  std::string html =
      "<p>A point is a pair of strokes. Below the dashed line the second technique's curve is the "
      "smoother one. Solid: least squares on the logarithms, with its slope and the correlation "
      "r.</p>\n";
  for (const lab::MethodPair& pair : summary.pairs)
    if (!pair.scatter.empty())
      html += plot(lab::scatter_id(pair), "Smoothness of " + pair.b + " over " + pair.a);
  return html;
}

std::string jumps(const lab::Summary& summary) {
  std::string html =
      "<p>A step jumps where the curve moves more than five times as far as the hand.</p>\n"
      "<div class=\"wide\"><table><thead><tr><th></th><th>strokes</th><th>strokes with a jump</th>"
      "<th>steps that jump</th><th>largest |Δq| / |Δp|, median</th><th>maximum</th>"
      "<th>gaps a stroke</th></tr></thead><tbody>\n";
  for (const lab::JumpRate& rate : summary.jumps)
    html +=
        row({method_label(rate.method), std::to_string(rate.strokes), percent(rate.jumping_strokes),
             std::isfinite(rate.jumping_steps) ? fixed(100 * rate.jumping_steps, 2) + " %" : "-",
             significant(rate.median_largest), significant(rate.largest), significant(rate.gaps)});
  return html + "</tbody></table></div>\n";
}

std::string filters(const lab::Summary& summary) {
  std::string html =
      "<p>The paper's filters: shorter than half of the target curve; a step of the hand above "
      "5 cm; drawn the other way round. Violation: how far the stroke is from a copy of the target "
      "curve, (largest − smallest distance) / length; parts of the strokes that pass. Change on "
      "repeating: mean |f − f′| / f over a stroke and its repeat, changes beyond five standard "
      "deviations dropped.</p>\n"
      "<div class=\"wide\"><table><thead><tr><th></th><th>strokes</th><th>too short</th>"
      "<th>noisy</th><th>inverted</th><th>rejected</th><th>pass</th><th>violation &lt; 25 %</th>"
      "<th>&lt; 20 %</th><th>repeats</th><th>change of D<sub>ep</sub></th><th>of F<sub>g</sub></th>"
      "</tr></thead><tbody>\n";
  bool paper = false;
  for (const lab::FilterRate& rate : summary.filters) {
    const auto n = [](std::size_t number) { return std::to_string(number); };
    html += row({method_label(rate.method), n(rate.strokes), n(rate.too_short), n(rate.noisy),
                 n(rate.inverted), n(rate.rejected),
                 percent(static_cast<double>(rate.passed) / static_cast<double>(rate.strokes)),
                 percent(rate.violation_below_25), percent(rate.violation_below_20),
                 n(rate.d_ep.used), percent(rate.d_ep.mean_change), percent(rate.f_g.mean_change)});
    paper = paper || rate.method == "spraycan" || rate.method == "mimicry";
  }
  if (paper)
    for (const auto& cells :
         {std::vector<std::string>{"paper, spraycan", "1200", "", "", "", "", "", "80 %", "66 %",
                                   "", "36.8 %", "34.1 %"},
          {"paper, mimicry", "1200", "", "", "", "", "", "86 %", "71 %", "", "35.4 %", "36.5 %"},
          {"paper, both", "2400", "17", "38", "66", "", "95.8 %", "", "", "", "", ""}})
      html += "<tr class=\"paper\">" + row(cells).substr(4);
  return html + "</tbody></table></div>\n";
}

std::string rejected_list(const lab::Summary& summary,
                          const std::vector<lab::RejectedStroke>& rejected) {
  if (summary.failed.empty() && rejected.empty()) return tag("p", "No stroke is left out.");
  std::string html =
      "<details" + std::string(summary.failed.size() + rejected.size() <= 30 ? " open" : "") +
      "><summary>" +
      count(summary.failed.size() + rejected.size(), "stroke or file", "strokes or files") +
      "</summary>\n<div class=\"wide\"><table id=\"rejected\"><thead><tr><th>participant</th>"
      "<th class=\"text\">technique</th><th class=\"text\">shape</th><th>drawn as</th>"
      "<th>curve</th><th class=\"text\">task</th><th class=\"text\">reason</th></tr></thead>"
      "<tbody>\n";
  const auto line = [](const std::vector<std::string>& texts, const std::string& reason) {
    const auto text = [&](std::size_t i) { return tag("td class=\"text\"", escaped(texts[i])); };
    return tag("tr", cell(escaped(texts[0])) + text(1) + text(2) + cell(escaped(texts[3])) +
                         cell(escaped(texts[4])) + text(5) +
                         tag("td class=\"text reason\"", escaped(reason))) +
           "\n";
  };
  for (const lab::RejectedStroke& r : rejected)
    html += line({r.participant, r.method, r.shape, r.index, "", ""}, r.reason);
  for (const lab::StudyRow* r : summary.failed)
    html += line({r->participant.empty() ? r->stroke : r->participant, r->method, r->shape,
                  r->index, r->curve, r->task},
                 r->failed);
  return html + "</tbody></table></div></details>\n";
}

std::string pictures(const lab::Summary& summary, const Gallery& gallery,
                     const GalleryOptions& options) {
  const lab::PaperMeasure* measure = lab::paper_measure(options.measure);
  const std::string name = measure != nullptr ? std::string(measure->html) : options.measure;
  const std::string unit = measure != nullptr ? " " + std::string(measure->unit) : "";
  std::string html =
      "<p>By " + name +
      ", of the strokes that pass. Black: the pen in mid-air. White: the target curve. In the "
      "technique's colour: what was drawn on the shape; paler behind it.</p>\n";
  for (const std::string& method : summary.methods)
    for (const bool best : {false, true}) {
      std::string images;
      for (const GalleryPicture& picture : gallery.pictures) {
        if (picture.pick.row->method != method || picture.pick.best != best) continue;
        const std::string caption = name + " " + significant(picture.pick.value) + unit + ": " +
                                    escaped(picture.pick.row->name());
        images += "<figure><img alt=\"" +
                  escaped(picture.pick.row->method + ", " + picture.pick.row->name()) +
                  "\" src=\"data:image/png;base64," + base64(picture.png) + "\">" +
                  tag("figcaption", caption) + "</figure>\n";
      }
      if (!images.empty())
        html += "<h3>" + method_label(method) + ", " + (best ? "best" : "worst") +
                "</h3>\n<div class=\"gallery\">\n" + images + "</div>\n";
    }
  if (!gallery.problems.empty()) {
    std::string list;
    for (const std::string& problem : gallery.problems) list += tag("li", escaped(problem));
    html += "<details><summary>" + count(gallery.problems.size(), "stroke") +
            " without a picture</summary><ul>" + list + "</ul></details>\n";
  }
  return html;
}

// JSON inside a script element must not end it.
std::string inside_script(std::string json) {
  for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3)
    json.replace(at, 2, "<\\/");
  return json;
}

}  // namespace

std::string write_page(const lab::Summary& summary,
                       const std::vector<lab::RejectedStroke>& rejected, const Gallery& gallery,
                       const GalleryOptions& gallery_options, const std::string& figure_data,
                       const PageOptions& options) {
  std::string body, links;
  const auto add = [&](const std::string& id, const std::string& title,
                       const std::string& content) {
    links += "<a href=\"#" + id + "\">" + title + "</a>";
    body += section(id, title, content);
  };
  add("table", "Comparison", comparisons(summary, options.level));
  bool scatter = false;
  for (const lab::MethodPair& pair : summary.pairs) scatter = scatter || !pair.scatter.empty();
  if (scatter) add("smoothness", "Smoothness, pair by pair", smoothness(summary));
  add("distributions", "Distributions",
      "<p>Bars: quartiles (of bars too thin for it, without the line); white line: median; "
      "diamond: mean; thin line: 5 to 95 % of the strokes "
      "that pass the filters.</p>\n" +
          plot(lab::kBoxesId, "Distributions of the measures"));
  add("by-shape", "Shape by shape", plot(lab::kShapesId, "Distributions of the measures by shape"));
  if (!summary.jumps.empty()) add("jumps", "Jumps", jumps(summary));
  if (!gallery.pictures.empty() || !gallery.problems.empty())
    add("gallery", "Worst and best strokes", pictures(summary, gallery, gallery_options));
  add("filters", "Filters and repeats", filters(summary));
  add("left-out", "What is left out", rejected_list(summary, rejected));

  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      // Nothing may come from elsewhere; the plotting library makes functions of its
      // specifications.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data: "
      "blob:\">\n";
  page += tag("title", escaped(options.title)) + "\n" + tag("style", kPageStyle) +
          "\n</head>\n<body>\n" + tag("h1", escaped(options.title)) + "\n";
  page +=
      simulation_notice(summary) + introduction(summary, rejected) + "\n" + tag("nav", links) +
      "\n<noscript><p>The plots need JavaScript; the tables and pictures do not.</p></noscript>\n";
  page += body;
  page += "<script type=\"application/json\" id=\"data\">" + inside_script(figure_data) +
          "</script>\n<script>";
  page += page_script();
  page += "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace mimicry::cli
