#include "view/chart_svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::view {

namespace {

constexpr double kWidth = 760, kHeight = 460, kLeft = 80, kRight = 24, kTop = 52, kBottom = 64;  // pixels

/// Okabe and Ito's palette without its yellow, which vanishes on white.
constexpr std::array<const char*, 6> kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000"};

struct Range {
  double lowest, highest;
};

/// Fewest digits that tell neighbouring ticks apart.
std::string tick_text(double value, double spacing) {
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(spacing) - 1e-9)));
  return fmt::format("{:.{}f}", value, digits);
}

Range range_of(const Chart& chart, std::vector<double> ChartSeries::*values) {
  Range range{0.0, 0.0};  // zero is always shown: a stiffness is read against it
  for (const ChartSeries& series : chart.series) {
    for (const double value : series.*values) {
      if (!std::isfinite(value)) continue;
      range.lowest = std::min(range.lowest, value);
      range.highest = std::max(range.highest, value);
    }
  }
  if (range.highest - range.lowest < 1e-12) range.highest = range.lowest + 1.0;
  return range;
}

struct Axes {
  std::vector<double> x_ticks, y_ticks;
  double px(double x) const {
    return kLeft + (x - x_ticks.front()) / (x_ticks.back() - x_ticks.front()) * (kWidth - kLeft - kRight);
  }
  double py(double y) const {
    return kHeight - kBottom - (y - y_ticks.front()) / (y_ticks.back() - y_ticks.front()) * (kHeight - kTop - kBottom);
  }
};

std::string frame_svg(const Chart& chart, const Axes& axes) {
  std::string svg;
  const double x_step = axes.x_ticks[1] - axes.x_ticks[0];
  const double y_step = axes.y_ticks[1] - axes.y_ticks[0];
  for (const double y : axes.y_ticks) {
    svg += fmt::format(R"(<line x1="{}" y1="{:.1f}" x2="{}" y2="{:.1f}" stroke="#dddddd"/>)", kLeft, axes.py(y),
                       kWidth - kRight, axes.py(y));
    svg += fmt::format(R"(<text x="{}" y="{:.1f}" text-anchor="end">{}</text>)", kLeft - 8, axes.py(y) + 4,
                       tick_text(y, y_step)) +
           "\n";
  }
  for (const double x : axes.x_ticks) {
    svg += fmt::format(R"(<line x1="{:.1f}" y1="{}" x2="{:.1f}" y2="{}" stroke="#dddddd"/>)", axes.px(x), kTop,
                       axes.px(x), kHeight - kBottom);
    svg += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", axes.px(x), kHeight - kBottom + 18,
                       tick_text(x, x_step)) +
           "\n";
  }
  svg += fmt::format(R"(<text x="{}" y="28" font-size="16" font-weight="bold">{}</text>)", kLeft,
                     escape_markup(chart.title));
  svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", 0.5 * (kLeft + kWidth - kRight),
                     kHeight - 18, escape_markup(chart.x_label));
  const double middle = 0.5 * (kTop + kHeight - kBottom);
  svg += fmt::format(R"svg(<text x="22" y="{0}" text-anchor="middle" transform="rotate(-90 22 {0})">{1}</text>)svg",
                     middle, escape_markup(chart.y_label)) +
         "\n";
  return svg;
}

std::string series_svg(const ChartSeries& series, const Axes& axes, const char* colour, double legend_y) {
  std::string points, markers;
  for (std::size_t i = 0; i < series.x.size() && i < series.y.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    const double x = axes.px(series.x[i]);
    const double y = axes.py(series.y[i]);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    markers += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3.5" fill="{}"/>)", x, y, colour);
  }
  std::string svg = fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2"/>)", points, colour);
  svg += markers;
  svg += fmt::format(R"(<line x1="{0}" y1="{1}" x2="{2}" y2="{1}" stroke="{3}" stroke-width="3"/>)", kLeft + 14,
                     legend_y, kLeft + 38, colour);
  svg += fmt::format(R"(<text x="{}" y="{}">{}</text>)", kLeft + 46, legend_y + 4, escape_markup(series.name)) + "\n";
  return svg;
}

}  // namespace

std::vector<double> round_ticks(double lowest, double highest, int wanted) {
  const double raw = (highest - lowest) / std::max(wanted, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * power * (1.0 + 1e-9)) {
      step = factor * power;
      break;
    }
  }
  const auto first = static_cast<long>(std::floor(lowest / step + 1e-9));
  const auto last = static_cast<long>(std::ceil(highest / step - 1e-9));
  std::vector<double> ticks;
  for (long i = first; i <= std::max(last, first + 1); ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::string line_chart_svg(const Chart& chart) {
  const Range x = range_of(chart, &ChartSeries::x);
  const Range y = range_of(chart, &ChartSeries::y);
  const Axes axes{round_ticks(x.lowest, x.highest, 6), round_ticks(y.lowest, y.highest, 6)};
  std::string svg =
      fmt::format(
          R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12" fill="#222222"><rect width="100%" height="100%" fill="white"/>)",
          kWidth, kHeight) +
      "\n";
  svg += frame_svg(chart, axes);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    svg += series_svg(chart.series[i], axes, kColours[i % kColours.size()], kTop + 16 + 18 * static_cast<double>(i));
  }
  return svg + "</svg>\n";
}

}  // namespace myotact::view
