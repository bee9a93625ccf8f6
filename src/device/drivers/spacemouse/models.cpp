#include "device/drivers/spacemouse/models.h"

#include <algorithm>
#include <array>

namespace myotact::device::spacemouse {

namespace {

constexpr std::uint16_t kLogitech = 0x046D;  // who made them first
constexpr std::uint16_t kConnexion = 0x256F;
constexpr std::uint16_t kGenericDesktop = 1;  // usage page
constexpr std::uint16_t kMultiAxis = 8;       // usage

struct Model {
  std::uint16_t vendor, product;
  std::string_view name;
};

// Not here and so not taken, though of the same maker: CadMouse 256F C650, C651, C654 to C658; keyboards C664, C665,
// C668; 256F C62C; and C641, on which the lists disagree.
constexpr std::array kModels = {Model{kLogitech, 0xC603, "SpaceMouse Plus XT"},
                                Model{kLogitech, 0xC605, "CADman"},
                                Model{kLogitech, 0xC606, "SpaceMouse Classic"},
                                Model{kLogitech, 0xC621, "Spaceball 5000"},
                                Model{kLogitech, 0xC623, "Space Traveler"},
                                Model{kLogitech, 0xC625, "SpacePilot"},
                                Model{kLogitech, 0xC626, "SpaceNavigator"},
                                Model{kLogitech, 0xC627, "SpaceExplorer"},
                                Model{kLogitech, 0xC628, "SpaceNavigator for Notebooks"},
                                Model{kLogitech, 0xC629, "SpacePilot Pro"},
                                Model{kLogitech, 0xC62B, "SpaceMouse Pro"},
                                Model{kLogitech, 0xC640, "NuLOOQ"},
                                Model{kConnexion, 0xC62E, "SpaceMouse Wireless (cable)"},
                                Model{kConnexion, 0xC62F, "SpaceMouse Wireless (receiver)"},
                                Model{kConnexion, 0xC631, "SpaceMouse Pro Wireless (cable)"},
                                Model{kConnexion, 0xC632, "SpaceMouse Pro Wireless (receiver)"},
                                Model{kConnexion, 0xC633, "SpaceMouse Enterprise"},
                                Model{kConnexion, 0xC635, "SpaceMouse Compact"},
                                Model{kConnexion, 0xC636, "SpaceMouse Module"},
                                Model{kConnexion, 0xC638, "SpaceMouse Pro Wireless BT"},
                                Model{kConnexion, 0xC63A, "SpaceMouse Wireless BT"},
                                Model{kConnexion, 0xC652, "Universal Receiver"}};

}  // namespace

std::string_view model_of(std::uint16_t vendor, std::uint16_t product) noexcept {
  const auto* const model = std::find_if(kModels.begin(), kModels.end(), [&](const Model& known) {
    return known.vendor == vendor && known.product == product;
  });
  return model == kModels.end() ? std::string_view() : model->name;
}

bool is_cap(const HidEntry& entry) noexcept {
  return entry.usage_page == kGenericDesktop && entry.usage == kMultiAxis &&
         !model_of(entry.vendor, entry.product).empty();
}

}  // namespace myotact::device::spacemouse
