#include "haptics/effects/reported_contact.h"

#include <algorithm>

#include "core/at.h"

namespace myotact::haptics {

namespace {

/// One contact, or several at right angles, are right after the first sweep; for two whose normals differ by 20 degrees
/// all but cos(20 deg)^64 = 2 % of the way is found after this many.
constexpr int kMostSweeps = 32;

/// Whether another contact of the same body is deeper, or as deep and before it.
bool is_outdone(const messages::ReportedContacts& reported, int count, int place) {
  const messages::ReportedContact& own = reported.contacts[at(place)];
  for (int i = 0; i < count; ++i) {
    const messages::ReportedContact& other = reported.contacts[at(i)];
    const bool deeper =
        other.penetration_m > own.penetration_m || (other.penetration_m == own.penetration_m && i < place);
    if (other.surface == own.surface && deeper) return true;
  }
  return false;
}

}  // namespace

void PressedContacts::take(const messages::ReportedContacts& reported) noexcept {
  clear();
  const int count = std::clamp(reported.count, 0, messages::kMaxReportedContacts);
  for (int i = 0; i < count; ++i) {
    const messages::ReportedContact& contact = reported.contacts[at(i)];
    if (!is_outdone(reported, count, i)) add({to_vec3(contact.normal_world), contact.penetration_m, i});
  }
}

void PressedContacts::add(const PressedContact& contact) noexcept {
  if (count_ < messages::kMaxReportedContacts) contacts_[at(count_++)] = contact;
}

/// Coordinate by coordinate: w_i is put where its own condition holds while the others stay. From w = 0 on, so that
/// what comes out depends on the contacts alone, and changes as little as they do.
Depenetration PressedContacts::depenetration() const noexcept {
  std::array<double, messages::kMaxReportedContacts> w_m{};
  Depenetration out;
  bool moves = true;
  for (int sweep = 0; moves && sweep < kMostSweeps; ++sweep) {
    moves = false;
    for (int i = 0; i < count_; ++i) {
      const PressedContact& contact = contacts_[at(i)];
      const double others_m = contact.normal_W.dot(out.way_m) - w_m[at(i)];
      const double own_m = std::clamp(contact.depth_m - others_m, 0.0, std::max(0.0, contact.depth_m));
      moves = moves || own_m != w_m[at(i)];
      out.way_m += (own_m - w_m[at(i)]) * contact.normal_W;
      w_m[at(i)] = own_m;
    }
  }
  const auto most = std::max_element(w_m.begin(), w_m.begin() + count_);
  if (most == w_m.begin() + count_ || !(*most > 0.0)) return {};
  const PressedContact& bearing = contacts_[static_cast<std::size_t>(most - w_m.begin())];
  out.bearing = bearing.place;
  out.depth_m = bearing.depth_m;
  return out;
}

void PenetrationMethod::move(const Vec3& tool_m) noexcept {
  for (int i = 0; i < pressed_.count(); ++i) pressed_[i].depth_m -= pressed_[i].normal_W.dot(tool_m - tool_m_);
  tool_m_ = tool_m;
}

void PlaneMethod::take(const messages::ReportedContacts& reported) noexcept {
  PressedContacts pressed;
  pressed.take(reported);
  count_ = pressed.count();
  for (int i = 0; i < count_; ++i) {
    const PressedContact& contact = pressed[i];
    const Vec3 point_m = to_vec3(reported.contacts[at(contact.place)].point_world_m);
    planes_[at(i)] = {contact.normal_W, -contact.normal_W.dot(point_m), contact.place};
  }
}

Depenetration PlaneMethod::depenetration() const noexcept {
  PressedContacts pressed;
  for (int i = 0; i < count_; ++i) {
    const Plane& plane = planes_[at(i)];
    pressed.add({plane.normal_W, radius_m_ - (plane.normal_W.dot(tool_m_) + plane.offset_m), plane.place});
  }
  return pressed.depenetration();
}

}  // namespace myotact::haptics
