#pragma once

#include <array>
#include <span>

namespace myotact::view::ui {

/// What Debian's packages fonts-inter and fonts-dejavu-core install; the first that is there is taken.
inline constexpr std::array kTextFonts = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                          "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
/// Of headings and large numbers.
inline constexpr const char* kBoldFont = "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf";
/// Of fonts-fork-awesome: the icons of `icons.h`. Without it controls have their words alone.
inline constexpr const char* kIconFont = "/usr/share/fonts/truetype/fork-awesome/forkawesome-webfont.ttf";

/// Adds the font of the interface, with icons, to the current ImGui context; where there is none of these files,
/// ImGui's own in the same height, and it returns false.
bool add_font(float height_px, std::span<const char* const> files = kTextFonts);

/// The sizes of type: text, the heading of a group, a title, a number that is read from the last row.
enum class Type { Text, Heading, Title, Number };
/// What is written until ImGui::PopFont(). Where there is no bold font, all is written as text.
void push_type(Type type);

}  // namespace myotact::view::ui
