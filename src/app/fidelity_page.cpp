#include "app/fidelity_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/fidelity_style.h"
#include "core/text.h"
#include "measure/fidelity/scene_fidelity_report.h"
#include "view/charts/chart_svg.h"

namespace myotact::app {

namespace {

using measure::Grade;
using measure::GradedFigure;
using measure::SceneFidelity;

/// Points of a long series for a chart: of every stretch its lowest and its highest, in their order in time.
view::ChartSeries thinned(std::string name, const std::vector<double>& values, view::Stroke stroke) {
  constexpr std::size_t kStretches = 700;
  view::ChartSeries series;
  series.name = std::move(name);
  series.stroke = stroke;
  const std::size_t length = std::max<std::size_t>(1, values.size() / kStretches);
  for (std::size_t start = 0; start < values.size(); start += length) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(start);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), start + length));
    const auto [low, high] = std::minmax_element(begin, end);
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      series.x.push_back(1e-3 * static_cast<double>(at - values.begin()));
      series.y.push_back(*at);
    }
  }
  return series;
}

std::vector<double> sizes(const std::vector<Vec3>& force_N) {
  std::vector<double> size_N;
  for (const Vec3& force : force_N) size_N.push_back(force.norm());
  return size_N;
}

std::string force_chart(const SceneFidelity& fidelity) {
  view::Chart chart{"Force on the hand", "time [s]", "size of the force [N]", {}};
  chart.series.push_back(thinned("commanded", sizes(fidelity.force.commanded_N), view::Stroke::Line));
  chart.series.push_back(thinned("true", sizes(fidelity.force.true_N), view::Stroke::Line));
  return view::line_chart_svg(chart);
}

std::string error_chart(const SceneFidelity& fidelity) {
  view::Chart chart{"Commanded less true", "time [s]", "difference [N]", {}};
  constexpr std::array kAxes = {"x, cranial", "y, left", "z, up"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> error_N;
    for (std::size_t i = 0; i < fidelity.force.true_N.size(); ++i)
      error_N.push_back(
          fidelity.force.compared[i] ? fidelity.force.commanded_N[i][axis] - fidelity.force.true_N[i][axis] : 0.0);
    chart.series.push_back(thinned(kAxes[static_cast<std::size_t>(axis)], error_N, view::Stroke::Line));
  }
  return view::line_chart_svg(chart);
}

std::string scatter_chart(const SceneFidelity& fidelity) {
  constexpr std::size_t kDots = 1500;
  view::ChartSeries dots{"ticks", {}, {}, view::Stroke::Dots};
  double largest_N = 0.0;
  const std::size_t step = std::max<std::size_t>(1, fidelity.force.true_N.size() / kDots);
  for (std::size_t i = 0; i < fidelity.force.true_N.size(); i += step) {
    if (!fidelity.force.compared[i]) continue;
    dots.x.push_back(fidelity.force.true_N[i].norm());
    dots.y.push_back(fidelity.force.commanded_N[i].norm());
    largest_N = std::max(largest_N, dots.x.back());
  }
  const double gain = fidelity.compared.front().found.gain;
  view::Chart chart{"Commanded against true", "true force [N]", "commanded force [N]", {std::move(dots)}};
  chart.series.push_back({"equal", {0.0, largest_N}, {0.0, largest_N}, view::Stroke::Line, {}, {}, view::kInk});
  if (std::isfinite(gain))
    chart.series.push_back({"fitted strength", {0.0, largest_N}, {0.0, gain * largest_N}, view::Stroke::Dashed});
  return view::line_chart_svg(chart);
}

std::string spectrum_chart(const SceneFidelity& fidelity) {
  view::ChartSeries series{"commanded beyond true", {}, {}, view::Stroke::Line};
  const std::vector<double>& density = fidelity.compared.front().found.noise_N2_Hz;
  for (std::size_t bin = 1; bin < density.size(); ++bin) {
    series.x.push_back(1000.0 / 256.0 * static_cast<double>(bin));
    series.y.push_back(1e3 * std::sqrt(density[bin]));
  }
  return view::line_chart_svg(
      {"Spectrum of what gain, lag and rotation do not explain", "frequency [Hz]", "density [mN/sqrt(Hz)]", {series}});
}

std::string bar(double x_px, double y_px, double length_px, const char* colour, const std::string& text) {
  return fmt::format(R"(<rect x="{}" y="{}" width="{:.1f}" height="12" fill="{}"/><text x="{:.1f}" y="{}">{}</text>)",
                     x_px, y_px, length_px, colour, x_px + length_px + 6.0, y_px + 10.0, text) +
         "\n";
}

/// Stiffness by device: in a hand, with no hand, and what is rendered at most. The axis is one of decades: from 100
/// N/m.
std::string range_chart(const SceneFidelity& fidelity) {
  constexpr double kLeft_px = 120.0, kDecade_px = 220.0, kRow_px = 52.0, kWidth_px = 880.0, kTitle_px = 36.0;
  const auto length_px = [](double N_m) { return kDecade_px * std::max(0.0, std::log10(N_m / 100.0)); };
  const double height_px = kRow_px * static_cast<double>(fidelity.ranges.size()) + kTitle_px;
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12" fill="#222222">)",
      kWidth_px, height_px);
  svg += fmt::format(
             R"(<text x="{}" y="20" font-size="16" font-weight="bold">Stiffness that a device renders [N/m]</text>)",
             kLeft_px) +
         "\n";
  double y_px = kTitle_px;
  for (const measure::StiffnessRange& range : fidelity.ranges) {
    svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="end">{}</text>)", kLeft_px - 8.0, y_px + 24.0,
                       escape_markup(range.device)) +
           "\n";
    svg += bar(kLeft_px, y_px, length_px(range.in_hand_N_m), "#0072B2",
               fmt::format("in a hand {:.0f}", range.in_hand_N_m));
    svg += bar(kLeft_px, y_px + 14.0, length_px(range.no_hand_N_m), "#D55E00",
               fmt::format("no hand {:.0f}", range.no_hand_N_m));
    svg += bar(kLeft_px, y_px + 28.0, length_px(range.allowed_N_m), "#999999",
               fmt::format("rendered at most {:.0f}", range.allowed_N_m));
    y_px += kRow_px;
  }
  return svg + "</svg>\n";
}

std::string summary(const SceneFidelity& fidelity, const std::vector<GradedFigure>& figures) {
  const measure::ForceComparison& whole = fidelity.compared.front().found;
  if (!std::isfinite(whole.gain)) return "<p>Nothing was felt that could be graded.</p>\n";
  const auto grade = measure::worst_grade(figures);
  std::string html = fmt::format("<p>On the whole {}: the worst figure decides. ", graded(grade));
  html += fmt::format(
      "While the hand was in touch ({:.2f} s compared) the commanded force differed from the true one by {:.1f} % "
      "(root "
      "mean square; at worst {:.2f} N of {:.2f} N). It was {:.1f} % too {}, {:.1f} ms {}, rotated by {:.1f} degrees, "
      "and jittered by {:.0f} mN.</p>\n",
      1e-3 * static_cast<double>(whole.ticks), 100.0 * whole.error_rms_share, whole.error_worst_N, whole.true_peak_N,
      100.0 * std::abs(whole.gain - 1.0), whole.gain >= 1.0 ? "strong" : "weak", 1e3 * std::abs(whole.lag_s),
      whole.lag_s >= 0.0 ? "late" : "early", 57.29577951 * whole.rotation_angle_rad(), 1e3 * whole.noise_rms_N);
  html += fmt::format("<p>The truth is {}. ", measure::truth_text(fidelity.truth));
  if (fidelity.haptic_part && fidelity.step_part)
    html += fmt::format(
        "Beside what the scene's own steps gave, the force differed by {:.1f} %, and those steps differed from the "
        "truth by {:.1f} %: the first is the rendering's part, the second that of the simulation's step. ",
        100.0 * fidelity.haptic_part->error_rms_share, 100.0 * fidelity.step_part->error_rms_share);
  html += fmt::format(
      "Left out: {:.2f} s while the force gate was not open, {:.2f} s while a hand closed or opened, "
      "{:.2f} s in which the true force is more than the device may give. Texture and the snap of lines were off: they "
      "are for the hand alone.</p>\n",
      1e-3 * static_cast<double>(fidelity.gate_ticks), 1e-3 * static_cast<double>(fidelity.hand_ticks),
      1e-3 * static_cast<double>(fidelity.limit_ticks));
  for (const std::string& note : fidelity.notes) html += fmt::format("<p>Note: {}.</p>\n", escape_markup(note));
  return html;
}

std::string figure_table(const std::vector<GradedFigure>& figures) {
  std::string html =
      "<h2>Figures</h2>\n<table><tr><th>what</th><th class=\"number\">value</th><th>unit</th><th>verdict</th>"
      "<th class=\"number\">good to</th><th class=\"number\">fair to</th><th>where the bounds are from</th></tr>\n";
  for (const GradedFigure& figure : figures)
    html += fmt::format(R"(<tr><td>{}</td><td class="number">{:.3g}</td><td>{}</td><td>{}</td>)"
                        R"(<td class="number">{:g}</td><td class="number">{:g}</td><td class="source">{}</td></tr>)",
                        escape_markup(figure.name), figure.value, figure.unit, graded(figure.grade()), figure.good,
                        figure.fair, escape_markup(figure.source)) +
            "\n";
  return html + "</table>\n";
}

std::string comparison_row(const std::string& name, const measure::ForceComparison& c) {
  std::string row = fmt::format("<tr><td>{}</td>", escape_markup(name));
  for (const double value : {c.true_rms_N, 100.0 * c.error_rms_share, 100.0 * c.error_worst_share, c.gain,
                             1e3 * c.lag_s, 57.29577951 * c.rotation_angle_rad(), 1e3 * c.noise_rms_N})
    row += fmt::format(R"(<td class="number">{:.3g}</td>)", value);
  return row + "</tr>\n";
}

std::string comparison_table(const SceneFidelity& fidelity) {
  std::string html = "<h2>Parts of the force</h2>\n<table><tr><th></th>";
  for (const char* head : {"N RMS", "% RMS", "% worst", "gain", "lag ms", "rotation degrees", "noise mN"})
    html += fmt::format(R"(<th class="number">{}</th>)", head);
  html += "</tr>\n";
  for (const measure::ComparedForce& one : fidelity.compared) html += comparison_row(one.name, one.found);
  if (fidelity.haptic_part) html += comparison_row("of it: felt, on the scene's own steps", *fidelity.haptic_part);
  if (fidelity.step_part) html += comparison_row("of it: own steps, on the truth", *fidelity.step_part);
  return html +
         "</table>\n<p class=\"why\">Gain, lag and rotation are fitted together; noise is what they do not explain, "
         "over 20 Hz. Forces below 20 mN, which move no device, are not looked at.</p>\n";
}

std::string planted_table(const measure::PlantedReport& report) {
  std::string html =
      "<h2>Self-check</h2>\n<p>Faults were put into the recorded force; this is what was found of them. The figures "
      "and "
      "charts above and below are without them.</p>\n<table><tr><th></th><th class=\"number\">ms late</th><th "
      "class=\"number\">scale</th><th class=\"number\">degrees</th><th class=\"number\">mN of noise</th></tr>\n";
  const std::vector<std::pair<const char*, const measure::PlantedFaults*>> rows = {
      {"planted", &report.planted},
      {"found beside the force without them", &report.alone},
      {"found beside the truth, beyond what was there", &report.on_truth}};
  for (const auto& [name, faults] : rows)
    html += fmt::format(R"(<tr><td>{}</td><td class="number">{:.2f}</td><td class="number">{:.3f}</td>)"
                        R"(<td class="number">{:.2f}</td><td class="number">{:.1f}</td></tr>)",
                        name, 1e3 * faults->delay_s, faults->scale, 57.29577951 * faults->rotate_rad,
                        1e3 * faults->noise_N) +
            "\n";
  return html + "</table>\n";
}

std::string explained(const std::string& svg, const char* why) {
  return svg + fmt::format("<p class=\"why\">{}</p>\n", why);
}

}  // namespace

std::string fidelity_page(const SceneFidelity& fidelity) {
  const std::vector<GradedFigure> figures = measure::grade(fidelity);
  std::string html = kFidelityHead;
  html += fmt::format("<h1>How true is what is felt: {}</h1>\n<p>{}; device: {}.</p>\n", escape_markup(fidelity.scene),
                      escape_markup(fidelity.title), escape_markup(fidelity.device));
  html += summary(fidelity, figures) + figure_table(figures) + comparison_table(fidelity);
  if (fidelity.planted) html += planted_table(*fidelity.planted);
  html += "<h2>Charts</h2>\n";
  html += explained(force_chart(fidelity),
                    "The two lines should lie on each other. Of every stretch of time the lowest and the highest value "
                    "are drawn, so that no jitter is hidden.");
  html +=
      explained(error_chart(fidelity),
                "What the hand felt wrongly, by axis of the world; zero where a tick is not compared. Spikes belong "
                "to first touches and to letting go.");
  html += explained(
      scatter_chart(fidelity),
      "Dots off the line are wrong in strength; a slope other than 1 is a stiffness that feels wrong by as much.");
  html += explained(spectrum_chart(fidelity),
                    "Over 20 Hz this is felt as a buzz. Peaks at 100 Hz and its multiples are steps of a simulation of "
                    "10 ms coming through.");
  html +=
      explained(range_chart(fidelity),
                "The stiffest wall that each device renders calmly, in N/m, decades long. Without a hand its own "
                "friction alone keeps it calm; the program renders no more than theory allows with the lightest hand.");
  return html + "</body></html>\n";
}

}  // namespace myotact::app
