#include "view/ui/icons.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace myotact::view::ui {

namespace {

// Characters of Fork Awesome 1.2.
constexpr ImWchar kEye = 0xf06e, kPointingHand = 0xf25a, kGrip = 0xf255, kFlatHand = 0xf256, kBolt = 0xf0e7;
constexpr ImWchar kPlay = 0xf04b, kPause = 0xf04c, kSquare = 0xf04d, kToBegin = 0xf049, kToEnd = 0xf050;
constexpr ImWchar kStepBack = 0xf048, kStepOn = 0xf051, kDisc = 0xf111, kFilm = 0xf008, kList = 0xf03a;
constexpr ImWchar kDiskette = 0xf0c7, kFolder = 0xf07c, kUndo = 0xf0e2, kRedo = 0xf01e, kQuestion = 0xf059;
constexpr ImWchar kHouse = 0xf015, kScales = 0xf24e, kGraduate = 0xf19d, kCube = 0xf1b2, kGroup = 0xf0c0,
                  kBranch = 0xf126;

constexpr std::array kIcons = {
    std::pair{std::string_view("toolbar.look"), kEye},
    std::pair{std::string_view("toolbar.touch"), kPointingHand},
    std::pair{std::string_view("toolbar.pull"), kGrip},
    std::pair{std::string_view("toolbar.forces_off"), kFlatHand},
    std::pair{std::string_view("toolbar.forces_on"), kBolt},
    std::pair{std::string_view("toolbar.play"), kPlay},
    std::pair{std::string_view("toolbar.pause"), kPause},
    std::pair{std::string_view("toolbar.step"), kStepOn},
    std::pair{std::string_view("toolbar.reset"), kToBegin},
    std::pair{std::string_view("toolbar.undo"), kUndo},
    std::pair{std::string_view("toolbar.redo"), kRedo},
    std::pair{std::string_view("toolbar.help"), kQuestion},
    std::pair{std::string_view("toolbar.start"), kHouse},
    std::pair{std::string_view("session.save_now"), kDiskette},
    std::pair{std::string_view("session.works"), kFolder},
    std::pair{std::string_view("keep.record"), kDisc},
    std::pair{std::string_view("keep.stop_recording"), kSquare},
    std::pair{std::string_view("keep.film"), kFilm},
    std::pair{std::string_view("keep.stop_film"), kSquare},
    std::pair{std::string_view("keep.recordings"), kList},
    std::pair{std::string_view("keep.step_back"), kStepBack},
    std::pair{std::string_view("keep.step_forward"), kStepOn},
    std::pair{std::string_view("keep.play"), kPlay},
    std::pair{std::string_view("keep.pause"), kPause},
    std::pair{std::string_view("keep.now"), kToEnd},
    std::pair{std::string_view("keep.go_on"), kBranch},
    std::pair{std::string_view("start.touch"), kPointingHand},
    std::pair{std::string_view("start.teach"), kScales},
    std::pair{std::string_view("start.lesson"), kGraduate},
    std::pair{std::string_view("start.prepare"), kCube},
    std::pair{std::string_view("start.join"), kGroup},
};

/// All are of the Basic Multilingual Plane from U+0800 on: three bytes.
std::string utf8_of(ImWchar character) {
  const unsigned code = character;
  return {static_cast<char>(0xE0u | (code >> 12u)), static_cast<char>(0x80u | ((code >> 6u) & 0x3Fu)),
          static_cast<char>(0x80u | (code & 0x3Fu))};
}

}  // namespace

std::string icon_of(std::string_view key) {
  const auto* found = std::find_if(kIcons.begin(), kIcons.end(), [&](const auto& icon) { return icon.first == key; });
  if (found == kIcons.end() || ImGui::GetFont()->FindGlyphNoFallback(found->second) == nullptr) return {};
  return utf8_of(found->second);
}

const ImWchar* icon_ranges() {
  static const std::vector<ImWchar> kRanges = [] {
    std::vector<ImWchar> ranges;
    for (const auto& [key, character] : kIcons) ranges.insert(ranges.end(), {character, character});
    ranges.push_back(0);
    return ranges;
  }();
  return kRanges.data();
}

}  // namespace myotact::view::ui
