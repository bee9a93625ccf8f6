#include "view/charts/map_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/text.h"
#include "view/charts/chart_svg.h"
#include "view/charts/colour_map.h"

namespace myotact::view {

namespace {

constexpr double kWidth = 960, kHeight = 520, kLeft = 80, kRight = 300, kTop = 52, kBottom = 64;  // pixels
constexpr double kBarLeft = kWidth - kRight + 30, kBarWidth = 22, kBarBottom = kHeight - kBottom - 130;
constexpr int kBarSteps = 64;           // finer than the eye can see
constexpr std::size_t kMostTicks = 12;  // of an axis, so that their texts do not touch

/// Borders of the cells: halfway to the neighbours, at the ends as far outside as inside.
std::vector<double> borders_of(const std::vector<double>& middles) {
  const std::size_t n = middles.size();
  if (n == 1) return {middles[0] - 0.5, middles[0] + 0.5};
  std::vector<double> borders = {1.5 * middles[0] - 0.5 * middles[1]};
  for (std::size_t i = 1; i < n; ++i) borders.push_back(0.5 * (middles[i - 1] + middles[i]));
  borders.push_back(1.5 * middles[n - 1] - 0.5 * middles[n - 2]);
  return borders;
}

struct MapPlot {
  explicit MapPlot(const ValueMap& drawn) : map(drawn), x_borders(borders_of(drawn.x)), y_borders(borders_of(drawn.y)) {
    for (const MapCell& cell : map.cells) {
      if (!std::isfinite(cell.value)) continue;
      lowest = std::min(lowest, cell.value);
      highest = std::max(highest, cell.value);
    }
    if (!(lowest < highest)) {  // one value, or none
      lowest = std::isfinite(lowest) ? lowest - 0.5 : 0.0;
      highest = lowest + 1.0;
    }
  }

  double px(double x) const {
    return kLeft + (x - x_borders.front()) / (x_borders.back() - x_borders.front()) * (kWidth - kLeft - kRight);
  }
  double py(double y) const {
    const double share = (y - y_borders.front()) / (y_borders.back() - y_borders.front());
    return kHeight - kBottom - share * (kHeight - kTop - kBottom);
  }
  double bar_y(double value) const { return kBarBottom - (value - lowest) / (highest - lowest) * (kBarBottom - kTop); }
  std::string colour(double value) const {
    const glm::vec3 c = cividis((value - lowest) / (highest - lowest));
    const auto byte = [](float part) { return static_cast<int>(std::lround(255.0f * part)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(c.x), byte(c.y), byte(c.z));
  }
  const MapCell& cell(std::size_t column, std::size_t row) const { return map.cells[row * map.x.size() + column]; }

  const ValueMap& map;
  std::vector<double> x_borders, y_borders;
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
};

struct Box {
  double x, y, width, height;
};

/// White under black, to be seen on every colour.
std::string outlined(const std::string& shape) {
  return fmt::format(
      R"(<g fill="none" stroke="white" stroke-width="4">{0}</g><g fill="none" stroke="black" stroke-width="1.6">{0}</g>)",
      shape);
}

std::string marks_svg(const MapCell& cell, const Box& box) {
  std::string svg;
  if (cell.hatched) {
    svg += fmt::format(R"svg(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="url(#hatch)"/>)svg",
                       box.x, box.y, box.width, box.height);
  }
  const double x = box.x + 0.5 * box.width, y = box.y + 0.5 * box.height;
  const double size = std::min({6.0, 0.35 * box.width, 0.35 * box.height});
  if (cell.crossed) {
    svg += outlined(fmt::format(R"(<path d="M{0:.1f} {1:.1f}L{2:.1f} {3:.1f}M{0:.1f} {3:.1f}L{2:.1f} {1:.1f}"/>)",
                                x - size, y - size, x + size, y + size));
  }
  if (cell.ringed) svg += outlined(fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}"/>)", x, y, size));
  return svg;
}

std::string cells_svg(const MapPlot& plot) {
  std::string svg;
  for (std::size_t row = 0; row < plot.map.y.size(); ++row) {
    for (std::size_t column = 0; column < plot.map.x.size(); ++column) {
      const MapCell& cell = plot.cell(column, row);
      const double left = plot.px(plot.x_borders[column]), top = plot.py(plot.y_borders[row + 1]);
      const Box box{left, top, plot.px(plot.x_borders[column + 1]) - left, plot.py(plot.y_borders[row]) - top};
      const bool known = std::isfinite(cell.value);
      svg += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}">)", box.x, box.y,
                         box.width, box.height, known ? plot.colour(cell.value) : "#cccccc");
      svg += fmt::format("<title>{:g}, {:g}: {}</title></rect>", plot.map.x[column], plot.map.y[row],
                         known ? fmt::format("{:.3g}", cell.value) : "not known");
      svg += marks_svg(cell, box) + "\n";
    }
  }
  return svg;
}

/// The piece of the line value = 0 within the triangle of three cells' middles: empty, or from one side to another.
std::string zero_in_triangle(const MapPlot& plot, const std::array<std::array<std::size_t, 2>, 3>& corners) {
  std::string path;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % 3];
    const double at_a = plot.cell(a[0], a[1]).value, at_b = plot.cell(b[0], b[1]).value;
    if (!std::isfinite(at_a) || !std::isfinite(at_b)) return "";
    if ((at_a < 0.0) == (at_b < 0.0)) continue;
    const double s = at_a / (at_a - at_b);
    const double x = (1.0 - s) * plot.map.x[a[0]] + s * plot.map.x[b[0]];
    const double y = (1.0 - s) * plot.map.y[a[1]] + s * plot.map.y[b[1]];
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", plot.px(x), plot.py(y));
  }
  return path;
}

std::string zero_line_svg(const MapPlot& plot) {
  std::string path;
  for (std::size_t row = 0; row + 1 < plot.map.y.size(); ++row) {
    for (std::size_t column = 0; column + 1 < plot.map.x.size(); ++column) {
      path += zero_in_triangle(plot, {{{column, row}, {column + 1, row}, {column + 1, row + 1}}});
      path += zero_in_triangle(plot, {{{column, row}, {column + 1, row + 1}, {column, row + 1}}});
    }
  }
  return path.empty() ? "" : outlined(fmt::format(R"(<path class="zero" d="{}"/>)", path)) + "\n";
}

std::string axes_svg(const MapPlot& plot) {
  std::string svg;
  const auto stride = [](std::size_t count) { return (count + kMostTicks - 1) / kMostTicks; };
  for (std::size_t i = 0; i < plot.map.x.size(); i += stride(plot.map.x.size())) {
    svg += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{:.4g}</text>)", plot.px(plot.map.x[i]),
                       kHeight - kBottom + 18, plot.map.x[i]);
  }
  for (std::size_t i = 0; i < plot.map.y.size(); i += stride(plot.map.y.size())) {
    svg += fmt::format(R"(<text x="{}" y="{:.1f}" text-anchor="end">{:.4g}</text>)", kLeft - 8,
                       plot.py(plot.map.y[i]) + 4, plot.map.y[i]);
  }
  svg += fmt::format(R"(<text x="{}" y="28" font-size="16" font-weight="bold">{}</text>)", kLeft,
                     escape_markup(plot.map.title));
  svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", 0.5 * (kLeft + kWidth - kRight),
                     kHeight - 18, escape_markup(plot.map.x_label));
  svg += fmt::format(R"svg(<text x="22" y="{0}" text-anchor="middle" transform="rotate(-90 22 {0})">{1}</text>)svg",
                     0.5 * (kTop + kHeight - kBottom), escape_markup(plot.map.y_label));
  return svg + "\n";
}

std::string colour_bar_svg(const MapPlot& plot) {
  std::string svg;
  for (int i = 0; i < kBarSteps; ++i) {
    const double low = plot.lowest + (plot.highest - plot.lowest) * i / kBarSteps;
    const double high = plot.lowest + (plot.highest - plot.lowest) * (i + 1) / kBarSteps;
    svg += fmt::format(R"(<rect x="{}" y="{:.2f}" width="{}" height="{:.2f}" fill="{}"/>)", kBarLeft, plot.bar_y(high),
                       kBarWidth, plot.bar_y(low) - plot.bar_y(high) + 0.5, plot.colour(0.5 * (low + high)));
  }
  const auto ticks = round_ticks(plot.lowest, plot.highest, 6);
  for (const double tick : ticks) {
    if (tick < plot.lowest || tick > plot.highest) continue;
    svg += fmt::format(R"(<line x1="{0}" y1="{1:.1f}" x2="{2}" y2="{1:.1f}" stroke="black"/>)", kBarLeft + kBarWidth,
                       plot.bar_y(tick), kBarLeft + kBarWidth + 5);
    svg += fmt::format(R"(<text x="{}" y="{:.1f}">{:.4g}</text>)", kBarLeft + kBarWidth + 9, plot.bar_y(tick) + 4,
                       std::abs(tick) < 1e-9 * (ticks.back() - ticks.front()) ? 0.0 : tick);
  }
  const double middle = 0.5 * (kTop + kBarBottom);
  svg += fmt::format(R"svg(<text x="{0}" y="{1}" text-anchor="middle" transform="rotate(-90 {0} {1})">{2}</text>)svg",
                     kBarLeft + kBarWidth + 62, middle, escape_markup(plot.map.value_label));
  return svg + "\n";
}

std::string legend_svg(const MapPlot& plot) {
  const std::array<std::pair<MapCell, const std::string*>, 3> entries = {
      {{{0.0, true, false, false}, &plot.map.hatch_label},
       {{0.0, false, true, false}, &plot.map.cross_label},
       {{0.0, false, false, true}, &plot.map.ring_label}}};
  std::string svg;
  double y = kBarBottom + 34;
  for (const auto& [cell, label] : entries) {
    const Box box{kBarLeft, y - 10, 24, 18};
    svg += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="#a69d75"/>)", box.x, box.y, box.width,
                       box.height);
    svg += marks_svg(cell, box) +
           fmt::format(R"(<text x="{}" y="{}">{}</text>)", kBarLeft + 32, y + 3, escape_markup(*label));
    y += 26;
  }
  svg += outlined(fmt::format(R"(<path d="M{0} {2}L{1} {2}"/>)", kBarLeft, kBarLeft + 24, y));
  return svg +
         fmt::format(R"(<text x="{}" y="{}">{}</text>)", kBarLeft + 32, y + 4, escape_markup(plot.map.zero_label)) +
         "\n";
}

}  // namespace

std::string value_map_svg(const ValueMap& map) {
  const MapPlot plot(map);
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12" fill="#222222"><rect width="100%" height="100%" fill="white"/>)",
      kWidth, kHeight);
  svg +=
      R"svg(<defs><pattern id="hatch" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">)svg"
      R"(<rect width="1.5" height="8" fill="white"/><rect x="1.5" width="1.5" height="8" fill="black"/></pattern></defs>)"
      "\n";
  return svg + cells_svg(plot) + zero_line_svg(plot) + axes_svg(plot) + colour_bar_svg(plot) + legend_svg(plot) +
         "</svg>\n";
}

}  // namespace myotact::view
