#include "layer/report_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/vector.h"
#include "haptics/proxy/moving_surface.h"

namespace myotact::layer {

namespace {

constexpr std::array<ReportDefectText, kReportDefects> kTexts = {{
    {ReportDefect::NotFinite, "place or depth is not a number",
     "the contact was left out. Look at the engine's time step and at masses and stiffnesses that differ much."},
    {ReportDefect::NoNormal, "contact without a normal",
     "it was left out. Look for triangles without area in the collision shape, and for a tool in a body's middle."},
    {ReportDefect::NegativeDepth, "contact apart from the tool",
     "it was left out. Let the adapter report what touches only, with a depth of 0 or more."},
    {ReportDefect::NoSuchBody, "contact with a body that is not there",
     "it was left out. Let the adapter number surfaces from 0 to surface_count() - 1."},
    {ReportDefect::LostBody, "contact with a body that has no place",
     "it was left out. The engine lost the body: look at its time step."},
    {ReportDefect::TooMany, "number of contacts out of range",
     "the first ones were taken. Let the adapter report the deepest, as many as there is room for."},
    {ReportDefect::UnsoundSurface, "surface or pose is not a number",
     "the whole model was refused: force zero, then back through the ramp. Look at the engine's time step."},
    {ReportDefect::Silent, "engine hung",
     "forces faded and come back through the ramp. Make its step cheaper, or look for what it waits for."},
}};

constexpr double kLargest_m = 1000.0;      // nothing of a scene is farther, as for surfaces
constexpr double kNormalTolerance = 0.01;  // of its length: what single precision makes of a unit vector is 1e-6

bool is_place(const std::array<double, 3>& p_m) {
  return std::all_of(p_m.begin(), p_m.end(), [](double x) { return std::abs(x) < kLargest_m; });
}

bool is_finite(const Pose& pose) {
  return pose.rotation.allFinite() && pose.translation_m.allFinite();
}

}  // namespace

std::span<const ReportDefectText> report_defect_texts() {
  return kTexts;
}

/// Counts it; the first of its kind is reported. Always false.
bool ReportCheck::find(ReportDefect defect, const std::string& detail) {
  const auto kind = static_cast<std::size_t>(defect);
  if (counts_[kind].fetch_add(1, std::memory_order_relaxed) == 0) {
    news_.push_back(fmt::format("{}: {} ({}): {}", engine_.name(), kTexts[kind].name, detail, kTexts[kind].remedy));
  }
  return false;
}

bool ReportCheck::is_usable(const messages::ReportedContact& contact) {
  const Vec3 normal_W = to_vec3(contact.normal_world);
  if (!is_place(contact.point_world_m) || !normal_W.allFinite() || !(std::abs(contact.penetration_m) < kLargest_m)) {
    return find(ReportDefect::NotFinite, fmt::format("surface {}, depth {} m", contact.surface, contact.penetration_m));
  }
  if (std::abs(normal_W.norm() - 1.0) > kNormalTolerance) {
    return find(ReportDefect::NoNormal, fmt::format("surface {}, length {}; must be 1 within {}", contact.surface,
                                                    normal_W.norm(), kNormalTolerance));
  }
  if (contact.penetration_m < 0.0) {
    return find(ReportDefect::NegativeDepth,
                fmt::format("surface {}, depth {} m; must be 0 or more", contact.surface, contact.penetration_m));
  }
  if (contact.surface < 0 || contact.surface >= engine_.surface_count()) {
    return find(ReportDefect::NoSuchBody, fmt::format("surface {}; must be at least 0 and less than {}",
                                                      contact.surface, engine_.surface_count()));
  }
  if (!is_finite(engine_.body_pose(contact.surface))) {
    return find(ReportDefect::LostBody, fmt::format("surface {}", contact.surface));
  }
  return true;
}

void ReportCheck::clean(messages::ReportedContacts& reported) {
  if (!is_place(reported.tool_world_m)) {
    find(ReportDefect::NotFinite, "place of the tool");
    reported = {};
    return;
  }
  if (reported.count < 0 || reported.count > messages::kMaxReportedContacts) {
    find(ReportDefect::TooMany, fmt::format("{}; must be 0 to {}", reported.count, messages::kMaxReportedContacts));
    reported.count = std::clamp(reported.count, 0, messages::kMaxReportedContacts);
  }
  const auto begin = reported.contacts.begin();
  const auto end = std::remove_if(begin, begin + reported.count, [this](const auto& c) { return !is_usable(c); });
  reported.count = static_cast<std::int32_t>(end - begin);
}

void ReportCheck::look_at(const messages::LocalModel& model) {
  if (haptics::is_sound(model)) return;
  find(ReportDefect::UnsoundSurface,
       fmt::format("{} triangles, {} vertices, bone {}", model.triangle_count, model.vertex_count, model.grip.body));
}

void ReportCheck::note_silence(double lasted_s) {
  find(ReportDefect::Silent, fmt::format("nothing for {:.2f} s", lasted_s));
}

std::vector<std::string> ReportCheck::take_news() {
  std::vector<std::string> news;
  news.swap(news_);
  return news;
}

}  // namespace myotact::layer
