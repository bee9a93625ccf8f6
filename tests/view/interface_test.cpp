#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "anatomy/part_facts.h"
#include "core/error.h"
#include "core/file.h"
#include "support/source_folder.h"
#include "view/input/key_bindings.h"
#include "view/ui/font.h"
#include "view/ui/layout.h"
#include "view/ui/text.h"

// What holds for the interface as a whole: texts, keys, areas.

namespace myotact::view {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = source_folder();

/// The sources of the window, by path.
std::map<std::string, std::string> window_sources() {
  std::map<std::string, std::string> sources;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "src" / "view")) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
      sources[entry.path().string()] = read_file(entry.path());
    }
  }
  return sources;
}

std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

std::vector<std::string> places_of(const std::string& text) {
  return all_matches(text, std::regex(R"((\{[^}]*\}))"));
}

TEST(Languages, HaveTheSameKeysAndTheSamePlaces) {
  ASSERT_GE(ui::languages().size(), 2u);
  const ui::Catalogue english = ui::load_catalogue("en");
  for (const std::string& language : ui::languages()) {
    const ui::Catalogue texts = ui::load_catalogue(language);
    for (const auto& [key, text] : english) {
      const auto found = texts.find(key);
      ASSERT_NE(found, texts.end()) << language << " lacks " << key;
      EXPECT_EQ(places_of(found->second), places_of(text)) << language << ": " << key;
      EXPECT_EQ(found->second.empty(), text.empty()) << language << ": " << key;
    }
    for (const auto& [key, text] : texts)
      EXPECT_TRUE(english.contains(key)) << "en lacks " << key << " of " << language;
  }
}

TEST(Languages, HoldEveryKeyThatTheSourcesName) {
  const ui::Catalogue english = ui::load_catalogue("en");
  std::set<std::string> prefixes;
  for (const auto& [key, text] : english) prefixes.insert(key.substr(0, key.find('.')));
  const std::regex quoted(R"re("([a-z]+\.[a-zA-Z0-9_.]+)")re");
  int keys = 0;
  const std::regex note(R"re(note_(?:control|place)\([^;]*;)re");  // names places, not texts
  for (const auto& [file, source] : window_sources()) {
    for (const std::string& key : all_matches(std::regex_replace(source, note, ""), quoted)) {
      if (!prefixes.contains(key.substr(0, key.find('.'))) || key.ends_with(".h") || key.ends_with('.')) continue;
      ++keys;
      EXPECT_TRUE(english.contains(key)) << file << " names " << key;
    }
  }
  EXPECT_GT(keys, 100);
}

/// What the card of a part shows; its file has them in English.
TEST(Languages, HoldEveryFactOfTheParts) {
  const ui::Catalogue english = ui::load_catalogue("en");
  int facts = 0;
  for (const auto& [part, of_part] : anatomy::load_part_facts(kRoot / "assets" / "canine" / "names.json")) {
    for (const std::string& fact : {of_part.origin, of_part.insertion, of_part.action, of_part.innervation}) {
      if (fact.empty()) continue;
      ++facts;
      const auto found = english.find("fact." + fact);
      ASSERT_NE(found, english.end()) << part << ": assets/languages lack fact." << fact;
      EXPECT_EQ(found->second, fact);
    }
  }
  EXPECT_GT(facts, 100);
}

TEST(Languages, NoTextOfThePanelsStandsInTheSources) {
  // Letters in a literal that a person would read; "%s", "##id" and single signs are none.
  const std::regex literal(
      R"re((?:TextUnformatted|TextWrapped|TextDisabled|Text|Button|Checkbox|SetTooltip|MenuItem)\(\s*"([^"#%]*[A-Za-z]{2,}[^"]*)")re");
  for (const auto& [file, source] : window_sources()) {
    EXPECT_EQ(all_matches(source, literal), std::vector<std::string>{}) << file;
  }
}

TEST(Languages, OneThatIsNotThereIsNamedWithThoseThatAre) {
  try {
    ui::load_catalogue("xx");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::NoInput);
    EXPECT_NE(std::string(error.what()).find("en"), std::string::npos);
  }
}

TEST(Languages, ATextWhosePlacesDoNotFitIsShownAsItIs) {
  EXPECT_EQ(ui::tr("no.such.key", 1.0), "no.such.key");
  EXPECT_EQ(ui::tr("find.nothing", std::string("x")).find('{'), std::string::npos);
  EXPECT_NE(ui::tr("status.rates", std::string("not a number"), 1, 2, 3).find('{'), std::string::npos);
}

TEST(KeyBindings, NoKeyDoesTwoThingsAndEachHasAText) {
  std::set<std::pair<int, int>> keys;
  std::set<KeyAction> actions;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(keys.emplace(binding.key, binding.mods).second) << name_of(binding);
    EXPECT_TRUE(actions.insert(binding.action).second) << name_of(binding);
    EXPECT_TRUE(ui::has_text(binding.what)) << binding.what;
  }
}

TEST(KeyBindings, EachIsFoundWithItsModifiersAloneTheStopWithAny) {
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_EQ(binding_of(key_bindings(), binding.key, binding.mods), &binding) << name_of(binding);
  }
  for (int mods = 0; mods <= (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT); ++mods) {
    const KeyBinding* stop = binding_of(key_bindings(), GLFW_KEY_ESCAPE, mods);
    ASSERT_NE(stop, nullptr) << mods;
    EXPECT_EQ(stop->action, KeyAction::StopForces) << mods;
  }
  EXPECT_EQ(binding_of(key_bindings(), GLFW_KEY_ENTER, GLFW_MOD_CONTROL), nullptr);  // forces come back by Enter alone
  EXPECT_EQ(binding_of(key_bindings(), GLFW_KEY_UNKNOWN, 0), nullptr);
}

TEST(KeyBindings, StandOnThePageOfTheWindow) {
  const std::string page = read_file(kRoot / "docs" / "window.md");
  std::size_t last = 0;
  for (const KeyBinding& binding : key_bindings()) {
    const std::string row = "| `" + name_of(binding) + "` | " + ui::tr(binding.what) + " |";
    const std::size_t place = page.find(row);
    ASSERT_NE(place, std::string::npos) << "docs/window.md lacks: " << row;
    EXPECT_GT(place, last) << "not in the order of the help: " << row;
    last = place;
  }
}

TEST(WindowLayout, TheTabsOfTheTasksAreReadWholeInEveryLanguage) {
  ImGui::CreateContext();
  constexpr float kEm = 15.0f;
  ui::add_font(kEm);
  ASSERT_TRUE(ImGui::GetIO().Fonts->Build());
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room = layout_of(1280.0f, 800.0f, kEm).tasks.width - 2.0f * style.WindowPadding.x;
  for (const std::string& language : ui::languages()) {
    const ui::Catalogue texts = ui::load_catalogue(language);
    float width = 0.0f;
    for (const char* tab : {"feel", "see", "demonstrate", "learn", "plots", "settings"}) {
      const std::string& text = texts.at(std::string("tasks.") + tab);
      width += ImGui::GetIO().Fonts->Fonts[0]->CalcTextSizeA(kEm, 1e4f, 0.0f, text.c_str()).x;
      width += 2.0f * style.FramePadding.x + 1.0f + style.ItemInnerSpacing.x;  // as ImGui's tabs are laid out
    }
    EXPECT_LE(width, room) << language;
  }
  ImGui::DestroyContext();
}

void expect_within(const Layout& layout, float width, float height) {
  EXPECT_FALSE(layout.scene.empty());
  for (const Area& area : {layout.toolbar, layout.find, layout.scene, layout.timeline, layout.tasks, layout.status}) {
    EXPECT_TRUE(area.x >= 0.0f && area.y >= 0.0f) << area.x << ' ' << area.y;
    EXPECT_LE(area.x + area.width, width + 0.01f);
    EXPECT_LE(area.y + area.height, height + 0.01f);
  }
}

TEST(WindowLayout, AreasLieWithinTheWindowAndTheSceneNeverVanishes) {
  for (const float em : {13.0f, 15.0f, 30.0f}) {
    for (float width = 1.0f; width < 4000.0f; width *= 1.37f) {
      for (float height = 1.0f; height < 2200.0f; height *= 1.41f) {
        expect_within(layout_of(width, height, em), width, height);
      }
    }
  }
}

TEST(WindowLayout, FoldedPanelsLeaveTheirPlaceToTheLimb) {
  const auto share = [](const SidePanels& sides) {
    const Layout layout = layout_of(1280.0f, 800.0f, 15.0f, sides);
    expect_within(layout, 1280.0f, 800.0f);
    return layout.scene.width * layout.scene.height / (1280.0f * 800.0f);
  };
  EXPECT_GE(share({true, false}), 0.6f);
  EXPECT_GT(share({false, true}), share({true, true}));
  EXPECT_GE(share({false, false}), 0.8f);
  EXPECT_TRUE(layout_of(1280.0f, 800.0f, 15.0f, {false, true}).find.empty());
  EXPECT_TRUE(layout_of(1280.0f, 800.0f, 15.0f, {true, false}).tasks.empty());
}

TEST(WindowLayout, TheLargestLettersStillShowTheSettings) {
  for (const float width : {640.0f, 700.0f, 1280.0f, 3840.0f}) {
    for (const float height : {400.0f, 500.0f, 800.0f, 2160.0f}) {
      const Layout fits = layout_of(width, height, 0.999f * largest_em(width, height));
      EXPECT_FALSE(fits.toolbar.empty() || fits.tasks.empty()) << width << " x " << height;
    }
  }
  EXPECT_TRUE(layout_of(700.0f, 2160.0f, 1.01f * largest_em(700.0f, 2160.0f)).tasks.empty());
}

}  // namespace
}  // namespace myotact::view
