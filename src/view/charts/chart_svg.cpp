#include "view/charts/chart_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::view {

namespace {

constexpr std::size_t kMostMarked = 100;  // points; more markers than that only thicken the line
constexpr double kWidth = 960, kHeight = 460, kLeft = 80, kRight = 260, kTop = 52, kBottom = 64;  // pixels

/// Okabe and Ito's palette without its yellow, which vanishes on white.
constexpr std::array<const char*, kChartColours> kColours = {"#0072B2", "#D55E00", "#009E73",
                                                             "#CC79A7", "#56B4E9", "#000000"};

struct Range {
  double lowest, highest;
};

/// Fewest digits that distinguish neighbouring ticks.
std::string tick_text(double value, double spacing) {
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(spacing) - 1e-9)));
  return fmt::format("{:.{}f}", value, digits);
}

Range range_of(const Chart& chart, std::initializer_list<std::vector<double> ChartSeries::*> members,
               bool with_zero = true) {
  Range range{0.0, 0.0};  // zero is mostly shown: a stiffness is read against it
  bool empty = !with_zero;
  for (const ChartSeries& series : chart.series) {
    for (const auto member : members) {
      for (const double value : series.*member) {
        if (!std::isfinite(value)) continue;
        if (empty) range = {value, value};
        empty = false;
        range.lowest = std::min(range.lowest, value);
        range.highest = std::max(range.highest, value);
      }
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

std::string colour_of(const ChartSeries& series, std::size_t place) {
  if (series.colour == kInk) return "#222222";
  const auto index = series.colour < 0 ? place : static_cast<std::size_t>(series.colour);
  return kColours[index % kColours.size()];
}

/// The places that are known, one after the other, as "x,y x,y ".
std::string points_text(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes) {
  std::string points;
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i]))
      points += fmt::format("{:.1f},{:.1f} ", axes.px(x[i]), axes.py(y[i]));
  }
  return points;
}

std::string band_svg(const ChartSeries& series, const Axes& axes, const std::string& colour) {
  std::vector<double> back_x(series.x.rbegin(), series.x.rend()), back_low(series.low.rbegin(), series.low.rend());
  const std::string outline = points_text(series.x, series.high, axes) + points_text(back_x, back_low, axes);
  return fmt::format(R"(<polygon points="{}" fill="{}" fill-opacity="0.14"/>)", outline, colour) + "\n";
}

std::string dash_of(Stroke stroke) {
  return stroke == Stroke::Dashed ? R"( stroke-dasharray="7 5")" : "";
}

std::string curve_svg(const ChartSeries& series, const Axes& axes, const std::string& colour) {
  std::string svg;
  const bool ring = series.stroke == Stroke::Rings, dots = series.stroke == Stroke::Dots;
  if (!ring && !dots) {
    svg += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2"{}/>)",
                       points_text(series.x, series.y, axes), colour, dash_of(series.stroke));
  }
  const bool marked = ring || dots || (series.stroke == Stroke::Line && series.x.size() <= kMostMarked);
  const double radius_px = ring ? 5.5 : dots ? 1.5 : 3.0;
  for (std::size_t i = 0; i < series.x.size() && i < series.y.size() && marked; ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="{}"/>)", axes.px(series.x[i]),
                       axes.py(series.y[i]), radius_px, ring ? "none" : colour, colour);
  }
  return svg + "\n";
}

std::string legend_svg(const ChartSeries& series, double y, const std::string& colour) {
  const double x = kWidth - kRight + 14;
  std::string svg;
  if (!series.low.empty() || !series.high.empty()) {
    svg +=
        fmt::format(R"(<rect x="{}" y="{}" width="24" height="12" fill="{}" fill-opacity="0.14"/>)", x, y - 6, colour);
  }
  if (series.stroke == Stroke::Rings || series.stroke == Stroke::Dots) {
    svg += fmt::format(R"(<circle cx="{}" cy="{}" r="5.5" fill="{}" stroke="{}"/>)", x + 12, y,
                       series.stroke == Stroke::Dots ? colour : "none", colour);
  } else {
    svg += fmt::format(R"(<line x1="{0}" y1="{1}" x2="{2}" y2="{1}" stroke="{3}" stroke-width="2"{4}/>)", x, y, x + 24,
                       colour, dash_of(series.stroke));
  }
  return svg + fmt::format(R"(<text x="{}" y="{}">{}</text>)", x + 32, y + 4, escape_markup(series.name)) + "\n";
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
  const Range x = range_of(chart, {&ChartSeries::x}, chart.x_from_zero);
  const Range y = range_of(chart, {&ChartSeries::y, &ChartSeries::low, &ChartSeries::high});
  const Axes axes{round_ticks(x.lowest, x.highest, 6), round_ticks(y.lowest, y.highest, 6)};
  std::string svg =
      fmt::format(
          R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12" fill="#222222"><rect width="100%" height="100%" fill="white"/>)",
          kWidth, kHeight) +
      "\n";
  svg += frame_svg(chart, axes);
  double legend_y = kTop + 6;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& series = chart.series[i];
    const std::string colour = colour_of(series, i);
    if (!series.low.empty()) svg += band_svg(series, axes, colour);
    svg += curve_svg(series, axes, colour);
    if (series.name.empty()) continue;
    svg += legend_svg(series, legend_y, colour);
    legend_y += 20;
  }
  return svg + "</svg>\n";
}

std::string stacked_svg(const std::vector<std::string>& charts) {
  constexpr std::string_view kOpening = "<svg ";
  std::string svg =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">)", kWidth,
                  kHeight * static_cast<double>(charts.size()));
  for (std::size_t i = 0; i < charts.size(); ++i) {
    svg += fmt::format("\n<svg y=\"{}\" {}", kHeight * static_cast<double>(i), charts[i].substr(kOpening.size()));
  }
  return svg + "</svg>\n";
}

}  // namespace myotact::view
