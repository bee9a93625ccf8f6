#include "view/session/saved_work.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "core/file.h"
#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

anatomy::Specimen limb() {
  return myotact::testing::antagonist_hinge();
}

/// Nothing as it is at the start.
ViewState unusual_view(const anatomy::Specimen& specimen) {
  ViewState view = start_view(specimen, 1.5f);
  view.camera = {{0.1f, -1.0f / 3.0f, 1e-7f}, -3.1f, Camera::kSteepest_rad, 0.123f};
  view.bones = {{true, false}, {false, true}};
  view.muscles = {{true, true}, {false, false}};
  view.layers = {0.1f, 0.7f, 0.0f};
  view.colour = MuscleColour::StiffnessShare;
  view.names = NameStyle::Both;
  view.section = {true, true, 2, 0.3f};
  view.labels = !view.labels;
  view.lines = !view.lines;
  view.fibres = !view.fibres;
  view.attachments = !view.attachments;
  view.plotted_muscles = {1, 0};
  view.selected_bone = 1;
  return view;
}

SavedWork unusual_work() {
  const anatomy::Specimen specimen = limb();
  SavedWork work{"elbow", "line", specimen.name, saved_view(unusual_view(specimen), specimen), {}, {}, {}};
  work.state = {Drive::Balance, 0.125, 1.0, 1.0 / 3.0, -1.0, true, true, {std::nullopt, messages::ToolShape::Point}};
  work.marks.notes["flexor"] = "zwei \"Köpfe\"\n";
  work.marks.bookmarks = {{"von vorn / 前", saved_view(start_view(specimen, 1.0f), specimen)}, {"b", work.view}};
  return work;
}

/// The error that reading gives, or none.
std::string complaint(const std::string& text) {
  try {
    parse_work(text, "w.json");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.status(), ExitStatus::BadData);
    return failure.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

TEST(SavedView, EverythingThatIsSeenComesBack) {
  const anatomy::Specimen specimen = limb();
  const ViewState view = unusual_view(specimen);
  ViewState other = start_view(specimen, 1.0f);
  ASSERT_NE(other, view);
  EXPECT_TRUE(show(saved_view(view, specimen), specimen, other).empty());
  EXPECT_EQ(other, view);
}

TEST(SavedView, PartsThatAreNotThereAreToldAndTheRestIsShown) {
  const anatomy::Specimen whole = limb();
  anatomy::Specimen half = limb();
  half.muscles.pop_back();  // the extensor
  half.bones[1].key = "tail";
  ViewState view = start_view(half, 1.0f);
  const std::vector<std::string> missing = show(saved_view(unusual_view(whole), whole), half, view);
  EXPECT_EQ(missing, (std::vector<std::string>{"lower", "extensor"}));
  EXPECT_EQ(view.muscles, (std::vector<PartLook>{{true, true}}));
  EXPECT_EQ(view.bones, (std::vector<PartLook>{{true, false}, {false, false}}));
  EXPECT_EQ(view.plotted_muscles, std::vector<int>{0});
  EXPECT_EQ(view.selected_bone, -1);
}

TEST(SavedView, DoesNotNameWhatALessonAsksFor) {
  const anatomy::Specimen specimen = limb();
  SavedView named;
  named.look.labels = true;
  ViewState view = start_view(specimen, 1.0f);
  view.names_hidden = true;
  show(named, specimen, view);
  EXPECT_TRUE(view.names_hidden);
  EXPECT_FALSE(view.labels);
  EXPECT_FALSE(saved_view(view, specimen).look.names_hidden);
}

TEST(SavedWork, IsReadAsItWasWrittenToTheLastBit) {
  const SavedWork work = unusual_work();
  EXPECT_EQ(parse_work(work_text(work), "w.json"), work);
}

/// A and B with it, where they were kept; works of earlier versions know neither.
TEST(SavedWork, KeepsTheTwoStatesThatAreFeltInTurn) {
  SavedWork work = unusual_work();
  EXPECT_EQ(work_text(work).find("kept"), std::string::npos);
  EXPECT_EQ(parse_work(work_text(work), "w.json").kept, KeptStates{});
  work.kept[1] = work.state;
  EXPECT_EQ(parse_work(work_text(work), "w.json"), work);
  work.kept[0] = SceneState{Drive::Levels, 0.5, 0.25, 0.0, 0.0, false, false};
  const std::string text = work_text(work);
  EXPECT_EQ(parse_work(text, "w.json"), work);
  EXPECT_NE(complaint(replaced(text, "\"extensors\": 0.25", "\"extensors\": 2")).find("/kept/a/extensors: is 2"),
            std::string::npos);
  EXPECT_NE(complaint(replaced(text, "\"b\": {", "\"c\": {")).find("/kept"), std::string::npos);
}

TEST(SavedWork, CutAnywhereIsRefused) {
  const std::string text = work_text(unusual_work());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    EXPECT_TRUE(complaint(text.substr(0, length)).starts_with("w.json:")) << length;
  }
}

TEST(SavedWork, WhatIsWrongIsToldWithPlaceAndRemedy) {
  const std::string text = work_text(unusual_work());
  ASSERT_EQ(complaint(text), "");
  const auto told = [&](const std::string& what, const std::string& by, const std::string& sentence) {
    const std::string complained = complaint(replaced(text, what, by));
    EXPECT_NE(complained.find(sentence), std::string::npos) << complained;
  };
  told("\"schema\": 1", "\"schema\": 2", "/schema: is 2; this program reads 1: open the file with the Myotact that");
  told("\"tissue\": \"line\"", "\"tissue\": \"lime\"", "/tissue: is \"lime\"; must be one of");
  told("\"common\": 0.3333333333333333", "\"common\": 1.5", "/settings/common: is 1.5; must be between 0 and 1");
  told("\"point\"", "\"pint\"", "/settings/tools/1: is \"pint\"; must be one of scene, ball, point, clamp");
  told("\"settings\"", "\"setings\"", "\"settings\" is missing");
  told("\"drive\": \"balance\"", "\"drive\": 3", "/settings/drive: is 3; must be a text");
  told("\"selected\"", "\"selektiert\"", "selektiert");
  told("\"distance_m\"", "\"distance_mm\"", "\"distance_m\" is missing");
  told("\"axis\": \"z\"", "\"axis\": \"w\"", "/section/axis: is \"w\"; must be one of x, y, z");
  told("\"b\"", "\"von vorn / 前\"", "/bookmarks/1/name: is there twice");
  told("\"b\"", "\"\"", "/bookmarks/1/name: has 0 characters; must have 1 to 60");
  told("zwei", std::string(kLongestNote, 'n'), "/notes/flexor: has 509 characters; must have 1 to 500");
  EXPECT_NE(complaint(R"({"mesh": "bar.vtk", "schema": 1})").find("\"scene\" is missing"), std::string::npos);
}

TEST(SavedWork, CharactersAreCountedNotBytes) {
  std::string note;
  for (std::size_t i = 0; i < kLongestNote; ++i) note += "ö";
  SavedWork work = unusual_work();
  work.marks.notes["flexor"] = note;
  EXPECT_EQ(parse_work(work_text(work), "w.json"), work);
  EXPECT_EQ(characters_in("aö前"), 3u);
  EXPECT_EQ(bytes_of_characters("aö前", 2), 3u);
  EXPECT_EQ(bytes_of_characters("aö前", 9), 6u);
}

/// With a home of its own: tests run beside each other.
struct PersonsFolder : ::testing::Test {
  PersonsFolder() {
    std::filesystem::remove_all(folder);
    setenv("XDG_DATA_HOME", folder.c_str(), 1);
  }
  ~PersonsFolder() override {
    unsetenv("XDG_DATA_HOME");
    std::filesystem::remove_all(folder);
  }
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / fmt::format("myotact_works_{}", ::getpid());
};

TEST_F(PersonsFolder, ListsWhatWasSavedNewestFirstAndLosesNothing) {
  EXPECT_TRUE(list_works().empty());
  const SavedWork work = unusual_work();
  const auto first = save_work(work, ""), second = save_work(work, "../Biceps: übung_1"), third = save_work(work, "");
  std::filesystem::last_write_time(second, std::filesystem::last_write_time(third) + std::chrono::seconds(1));
  std::filesystem::last_write_time(first, std::filesystem::last_write_time(third) - std::chrono::seconds(1));
  const std::vector<ListedWork> works = list_works();
  ASSERT_EQ(works.size(), 3u);
  EXPECT_EQ(works[0].name, "_._Biceps:_übung_1");
  EXPECT_EQ(works[1].name, "elbow");
  EXPECT_EQ(works[2].file, first);
  EXPECT_EQ(works[0].time.size(), 16u);
  for (const ListedWork& listed : works) {
    EXPECT_EQ(listed.file.parent_path(), works_folder());
    EXPECT_EQ(read_work(listed.file, {"elbow"}), work);
  }
}

TEST_F(PersonsFolder, ASceneThatIsNotThereIsToldWithThoseThatAre) {
  const auto file = save_work(unusual_work(), "w");
  try {
    read_work(file, {"elbov", "hock"});
    FAIL();
  } catch (const Error& failure) {
    const std::string told = failure.what();
    EXPECT_TRUE(told.starts_with(file.string() + ": /scene: there is no scene \"elbow\"")) << told;
    EXPECT_NE(told.find("elbov, hock (nearest: \"elbov\")"), std::string::npos) << told;
  }
}

TEST_F(PersonsFolder, MarksAreKeptPerSpecimen) {
  const Marks marks = unusual_work().marks;
  const auto file = marks_file("canine forelimb / Ö");
  EXPECT_EQ(file.parent_path(), folder / "myotact" / "marks");
  EXPECT_NE(file, marks_file("canine hindlimb"));
  EXPECT_EQ(read_marks(file), Marks{});
  write_marks(marks, "canine forelimb / Ö", file);
  std::string message;
  EXPECT_EQ(marks_or_none(file, message), marks);
  EXPECT_EQ(message, "");
}

TEST_F(PersonsFolder, MarksThatCannotBeUsedAreSetAside) {
  const auto file = marks_file("limb");
  make_writable_folder(file.parent_path());
  const std::string whole = marks_text(unusual_work().marks, "limb");
  for (const std::string& text :
       {std::string(), whole.substr(0, whole.size() / 2), replaced(whole, "\"schema\": 1", "\"schema\": 2"),
        work_text(unusual_work()), std::string("[]")}) {
    write_file(file, text);
    std::string message;
    EXPECT_EQ(marks_or_none(file, message), Marks{});
    EXPECT_NE(message.find("limb.json.broken"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(read_file(file.string() + ".broken"), text);
  }
}

TEST(Marks, JoiningLosesNothingOfThePersonsOwn) {
  SavedView near, far;
  far.look.camera.distance_m = 3.0f;
  const Marks own{{{"front", near}}, {{"biceps", "mine"}, {"ulna", "same"}}};
  const Marks others{{{"front", far}, {"again", near}}, {{"biceps", "theirs"}, {"ulna", "same"}, {"radius", "new"}}};
  const JoinedMarks both = joined(own, others);
  EXPECT_EQ(both.differing_notes, 1);
  EXPECT_EQ(both.marks.notes,
            (std::map<std::string, std::string>{{"biceps", "mine"}, {"ulna", "same"}, {"radius", "new"}}));
  EXPECT_EQ(both.marks.bookmarks, (std::vector<Bookmark>{{"front", near}, {"front (2)", far}}));
  EXPECT_EQ(joined(both.marks, others).marks, both.marks) << "opening once more adds nothing";
}

TEST(Marks, ABookmarkGetsANameOfItsOwnWithinTheLimits) {
  std::vector<Bookmark> bookmarks;
  const std::string longest(kLongestName, 'x');
  for (std::size_t i = 0; i < kMostBookmarks; ++i) EXPECT_TRUE(add_bookmark(bookmarks, {longest, {}}));
  EXPECT_FALSE(add_bookmark(bookmarks, {"one more", {}}));
  EXPECT_EQ(bookmarks[1].name, std::string(kLongestName - 4, 'x') + " (2)");
  const Marks marks{bookmarks, {}};
  EXPECT_EQ(parse_marks(marks_text(marks, "limb"), "m.json"), marks);
}

}  // namespace
}  // namespace myotact::view
