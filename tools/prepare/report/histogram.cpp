#include "prepare/report/histogram.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::prepare {

namespace {

constexpr double kWidth_px = 260.0, kHeight_px = 90.0;
constexpr double kTop_px = 18.0, kBottom_px = 18.0;  // title, numbers
constexpr const char* kBarColour = "#0072B2";

}  // namespace

std::string histogram_svg(const std::vector<double>& values, const HistogramScale& scale) {
  std::vector<int> counts(static_cast<std::size_t>(scale.bars), 0);
  const double span = scale.highest - scale.lowest;
  for (const double value : values) {
    const int bar = static_cast<int>((value - scale.lowest) / span * scale.bars);
    ++counts[static_cast<std::size_t>(std::clamp(bar, 0, scale.bars - 1))];
  }
  const int most = std::max(1, *std::max_element(counts.begin(), counts.end()));
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-size="11">)",
      kWidth_px, kTop_px + kHeight_px + kBottom_px);
  svg += fmt::format(R"(<text x="0" y="12">{}</text>)", escape_markup(scale.title));
  const double bar_px = kWidth_px / scale.bars;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    const double high_px = kHeight_px * counts[b] / most;
    svg +=
        fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)",
                    bar_px * static_cast<double>(b), kTop_px + kHeight_px - high_px, bar_px - 1.0, high_px, kBarColour);
  }
  const double limit_px = kWidth_px * (scale.limit - scale.lowest) / span;
  svg += fmt::format(R"(<line x1="{0:.1f}" y1="{1}" x2="{0:.1f}" y2="{2}" stroke="#222222" stroke-dasharray="3 3"/>)",
                     limit_px, kTop_px, kTop_px + kHeight_px);
  const double below_px = kTop_px + kHeight_px + 13.0;
  svg += fmt::format(R"(<text x="0" y="{0}">{1:g}{3}</text><text x="{4}" y="{0}" text-anchor="end">{2:g}{3}</text>)",
                     below_px, scale.lowest, scale.highest, escape_markup(scale.unit), kWidth_px);
  return svg + "</svg>";
}

}  // namespace myotact::prepare
