#include "view/pictures/contact_sheet.h"

#include <algorithm>
#include <cstddef>

#include "core/error.h"
#include "view/look/limb_bounds.h"

namespace myotact::view {

namespace {

constexpr std::size_t kLargest_px = 16384;  // as graphics cards and picture readers take them

ViewBox box_round_all(const anatomy::Specimen& specimen, std::span<const messages::SceneFrame> frames) {
  ViewBox box = bounds_of(specimen, frames.front());
  for (const messages::SceneFrame& frame : frames) {
    const ViewBox one = bounds_of(specimen, frame);
    box = {glm::min(box.lowest_m, one.lowest_m), glm::max(box.highest_m, one.highest_m)};
  }
  return box;
}

void paste(const Image& from, std::size_t column, std::size_t row, Image& onto) {
  const std::size_t line = 3 * static_cast<std::size_t>(from.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(from.height); ++y) {
    const std::size_t place =
        (row * static_cast<std::size_t>(from.height) + y) * 3 * static_cast<std::size_t>(onto.width);
    std::copy_n(from.rgb.begin() + static_cast<std::ptrdiff_t>(y * line), line,
                onto.rgb.begin() + static_cast<std::ptrdiff_t>(place + column * line));
  }
}

void check(const ContactSheet& sheet) {
  const std::size_t width = sheet.columns.size() * static_cast<std::size_t>(std::max(sheet.cell.width, 0));
  const std::size_t height = sheet.rows.size() * static_cast<std::size_t>(std::max(sheet.cell.height, 0));
  if (width > 0 && height > 0 && width <= kLargest_px && height <= kLargest_px) return;
  throw Error(ExitStatus::Usage, "a sheet of " + std::to_string(width) + " x " + std::to_string(height) +
                                     " pixels; must be 1 .. " + std::to_string(kLargest_px) +
                                     " each way: ask for smaller pictures");
}

}  // namespace

Image draw_contact_sheet(const anatomy::Specimen& specimen, const ContactSheet& sheet, const ViewState& look,
                         const SceneExtras& extras) {
  check(sheet);
  const ViewBox box = box_round_all(specimen, sheet.rows);
  const float aspect = static_cast<float>(sheet.cell.width) / static_cast<float>(sheet.cell.height);
  OffscreenRenderer renderer(specimen, sheet.cell.width, sheet.cell.height);
  Image whole{sheet.cell.width * static_cast<int>(sheet.columns.size()),
              sheet.cell.height * static_cast<int>(sheet.rows.size()),
              {}};
  whole.rgb.resize(3 * static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height));
  for (std::size_t column = 0; column < sheet.columns.size(); ++column) {
    ViewState view = look;
    view.camera = camera_of(sheet.columns[column], specimen, box, aspect);
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
      paste(renderer.render(sheet.rows[row], view, extras), column, row, whole);
    }
  }
  return whole;
}

}  // namespace myotact::view
