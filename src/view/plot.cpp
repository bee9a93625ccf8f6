#include "view/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr ImU32 kCurve = IM_COL32(86, 180, 233, 255);  // Okabe-Ito sky blue
constexpr ImU32 kFrame = IM_COL32(90, 95, 105, 255);
constexpr ImU32 kZero = IM_COL32(120, 125, 135, 120);
constexpr ImU32 kText = IM_COL32(205, 208, 214, 255);

}  // namespace

void Plot::add(double time_s, double value) {
  if (!samples_.empty() && time_s <= samples_.back().time_s) return;
  samples_.push_back({time_s, value});
  const auto old =
      std::find_if(samples_.begin(), samples_.end(), [&](const Sample& s) { return s.time_s > time_s - kWindow_s; });
  samples_.erase(samples_.begin(), old);
}

void Plot::clear() {
  samples_.clear();
}

void Plot::draw(float height) const {
  double lowest = 0.0, highest = 0.0;
  for (const Sample& s : samples_) {
    lowest = std::min(lowest, s.value);
    highest = std::max(highest, s.value);
  }
  const double missing = std::max(smallest_range_ - (highest - lowest), 0.0);
  lowest -= lowest < 0.0 ? 0.5 * missing : 0.0;
  highest = std::max(highest, lowest + smallest_range_);
  const double now_s = samples_.empty() ? 0.0 : samples_.back().time_s;
  ImGui::Text("%s  %s", ui::tr(label_), samples_.empty() ? "-" : fmt::format("{:.3f}", samples_.back().value).c_str());

  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, height);
  ImGui::InvisibleButton(label_.c_str(), ImVec2(std::max(size.x, 1.0f), std::max(size.y, 1.0f)));
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto x_of = [&](double t) { return corner.x + size.x * static_cast<float>(1.0 - (now_s - t) / kWindow_s); };
  const auto y_of = [&](double v) {
    return corner.y + size.y * static_cast<float>(1.0 - (v - lowest) / (highest - lowest));
  };
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  list->AddRectFilled(corner, end, IM_COL32(24, 26, 30, 255));
  list->AddLine(ImVec2(corner.x, y_of(0.0)), ImVec2(end.x, y_of(0.0)), kZero);
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    list->AddLine(ImVec2(x_of(samples_[i - 1].time_s), y_of(samples_[i - 1].value)),
                  ImVec2(x_of(samples_[i].time_s), y_of(samples_[i].value)), kCurve, 2.0f);
  }
  list->AddRect(corner, end, kFrame);
  list->AddText(ImVec2(corner.x + 4, corner.y + 1), kText, fmt::format("{:.2f}", highest).c_str());
  list->AddText(ImVec2(corner.x + 4, end.y - ImGui::GetTextLineHeight()), kText, fmt::format("{:.2f}", lowest).c_str());
  if (!ImGui::IsItemHovered() || samples_.empty()) return;
  const double at_s = now_s - kWindow_s * (1.0 - static_cast<double>((ImGui::GetIO().MousePos.x - corner.x) / size.x));
  const auto nearest = std::min_element(samples_.begin(), samples_.end(), [&](const Sample& a, const Sample& b) {
    return std::abs(a.time_s - at_s) < std::abs(b.time_s - at_s);
  });
  ImGui::SetTooltip("%.2f s: %.4f", nearest->time_s, nearest->value);
}

}  // namespace myotact::view
