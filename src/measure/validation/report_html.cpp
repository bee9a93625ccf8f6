#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "measure/validation/report.h"

namespace myotact::measure {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Myotact: validation</title><style>
body { font: 14px sans-serif; color: #222222; margin: 2em; }
table { border-collapse: collapse; margin: 0.5em 0; }
th, td { border-bottom: 1px solid #dddddd; padding: 2px 10px; text-align: left; vertical-align: top; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
td.source, p.source { color: #555555; font-size: 12px; max-width: 60em; }
.fail { color: #a02c00; font-weight: bold; }
</style></head><body>
)";

constexpr double kTolerance_px = 200.0;  // a bar of this length has used up its tolerance
constexpr double kLongest_px = 300.0;    // a longer bar ends here
constexpr double kRow_px = 18.0;
constexpr double kLabel_px = 260.0;

// Blue and orange of Okabe and Ito: distinguishable with any colour vision.
constexpr const char* kPassColour = "#0072B2";
constexpr const char* kFailColour = "#D55E00";

/// Error over tolerance. Without a tolerance it is either kept (0) or not (the longest bar).
double used_share(const CheckResult& result) {
  constexpr double kMost = kLongest_px / kTolerance_px;
  if (result.verdict == Verdict::Fail && !(result.check.tolerance > 0.0)) return kMost;
  if (!(result.check.tolerance > 0.0)) return 0.0;
  const double share = result.error / result.check.tolerance;
  return std::isfinite(share) ? std::min(share, kMost) : kMost;
}

/// A check's name, and beside it its bar, or the word for what has none.
std::string bar_of(const CheckResult& result, double top_px) {
  std::string svg = fmt::format(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", kLabel_px - 8.0, top_px + 13.0,
                                escape_markup(result.check.quantity));
  const bool failed = result.verdict == Verdict::Fail;
  if (!failed && !(result.check.tolerance > 0.0)) {
    return svg + fmt::format(R"(<text x="{}" y="{}" fill="{}">kept</text>)", kLabel_px, top_px + 13.0, kPassColour);
  }
  return svg + fmt::format(R"(<rect x="{}" y="{}" width="{:.1f}" height="{}" fill="{}"/>)", kLabel_px, top_px + 3.0,
                           std::max(1.0, used_share(result) * kTolerance_px), kRow_px - 6.0,
                           failed ? kFailColour : kPassColour);
}

/// One row for each check with a tolerance.
std::string bars_svg(const CaseResult& result) {
  std::string bars;
  double top_px = 4.0;
  for (const CheckResult& check : result.checks) {
    if (check.verdict == Verdict::Reported) continue;
    bars += bar_of(check, top_px);
    top_px += kRow_px;
  }
  const double width_px = kLabel_px + kLongest_px + 10.0;
  const double height_px = top_px + 4.0;
  const std::string head = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-size="12">)",
      width_px, height_px);
  const std::string tolerance =
      fmt::format(R"(<line x1="{0}" y1="0" x2="{0}" y2="{1}" stroke="#222222" stroke-dasharray="3 3"/>)",
                  kLabel_px + kTolerance_px, height_px);
  return head + bars + tolerance + "</svg>\n";
}

std::string case_table(const CaseResult& result) {
  std::string html =
      R"(<table><tr><th>quantity</th><th class="number">expected</th><th class="number">obtained</th>)"
      R"(<th class="number">error</th><th class="number">tolerance</th><th>result</th><th>source</th></tr>)";
  html += '\n';
  for (const CheckResult& c : result.checks) {
    html += fmt::format("<tr><td>{}</td>", escape_markup(c.check.quantity));
    for (const std::string& number :
         {expected_text(c.check), fmt::format("{:.7g}", c.obtained), error_text(c), tolerance_text(c.check)}) {
      html += fmt::format(R"(<td class="number">{}</td>)", escape_markup(number));
    }
    const std::string own_source = c.check.source == result.source ? "" : c.check.source;
    html += fmt::format(R"(<td{}>{}</td><td class="source">{}</td></tr>)",
                        c.verdict == Verdict::Fail ? R"( class="fail")" : "", verdict_text(c.verdict),
                        escape_markup(own_source));
    html += '\n';
  }
  return html + "</table>\n";
}

}  // namespace

std::string validation_html(const std::vector<CaseResult>& results) {
  std::vector<std::string> failed;
  for (const CaseResult& result : results) {
    if (!result.passed()) failed.push_back(result.name);
  }
  std::string html = kHead;
  html += fmt::format("<h1>Myotact: validation</h1>\n<p>{} of {} cases pass.", results.size() - failed.size(),
                      results.size());
  if (!failed.empty()) html += fmt::format(R"( <span class="fail">FAIL: {}</span>)", escape_markup(join(failed)));
  html +=
      "</p>\n<p>Bars show errors; the dashed line is the tolerance. Bounds have no tolerance: \"kept\", or the longest "
      "bar. What is only reported has a line in the table and is not checked.</p>\n";
  for (const CaseResult& result : results) {
    html += fmt::format("<h2{}>{}: {}</h2>\n<p>{}</p>\n", result.passed() ? "" : R"( class="fail")",
                        escape_markup(result.name), result.passed() ? "pass" : "FAIL", escape_markup(result.title));
    html += fmt::format("<p class=\"source\">{}</p>\n", escape_markup(result.source));
    html += bars_svg(result) + case_table(result);
  }
  return html + "</body></html>\n";
}

}  // namespace myotact::measure
