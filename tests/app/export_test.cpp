// What is printed and shared: one file of the asked kind, or a sentence and nothing.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kSmall = "bimanual --set tissue.default=rigid ";

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// The folder of a stand-in for ffmpeg: it writes what it is given.
std::filesystem::path stand_in(const std::filesystem::path& folder, const std::string& script) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\n" << script << "\n";
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
  return folder;
}

TEST(Export, APosterIsAPictureOfItsSize) {
  TemporaryFolder folder;
  const auto png = folder.path() / "limb.PNG";
  const Outcome outcome = run_program("export " + kSmall + "--size 600x300 --language de -o " + png.string());
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_GT(std::filesystem::file_size(png), 5000u);
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(Export, AFilmHasTwentyFivePicturesASecond) {
  TemporaryFolder folder, tools;
  const auto film = folder.path() / "limb.mp4";
  const auto bin = stand_in(tools.path() / "bin", "cat > \"$last\"");
  const Outcome outcome =
      run_program("export " + kSmall + "--size 64x48 --turn 1 -o " + film.string(), "PATH=" + bin.string() + ":$PATH");
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(std::filesystem::file_size(film), 25u * 64u * 48u * 3u);
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(Export, AFilmThatFfmpegCannotWriteLeavesNothing) {
  TemporaryFolder folder, tools;
  const auto bin = stand_in(tools.path() / "bin", "head -c 10000 > \"$last\"; exit 1");
  const Outcome outcome =
      run_program("export " + kSmall + "--size 64x48 --turn 1 -o " + (folder.path() / "limb.mp4").string(),
                  "PATH=" + bin.string() + ":$PATH");
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  EXPECT_EQ(outcome.status, 74) << outcome.output;
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(Export, AModelIsOpenedByAnotherProgram) {
  TemporaryFolder folder;
  const auto glb = folder.path() / "limb.glb";
  const Outcome outcome = run_program("export " + kSmall + "-o " + glb.string());
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  if (std::system("command -v assimp > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs assimp (apt: assimp-utils)";
  const auto info = folder.path() / "info.txt";
  ASSERT_EQ(std::system(("assimp info " + glb.string() + " > " + info.string() + " 2>&1").c_str()), 0);
  std::ifstream file(info);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text,
              AllOf(HasSubstr("Humerus"), HasSubstr("Biceps brachii"), HasSubstr("Primitive Types:    triangles")));
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Export, AModelMovesWithTheScript) {
  TemporaryFolder folder;
  const auto glb = folder.path() / "limb.glb";
  const Outcome outcome = run_program("export " + kSmall + "--seconds 0.2 --every 5 -o " + glb.string());
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("5 frames"));
  if (std::system("command -v assimp > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs assimp (apt: assimp-utils)";
  const auto info = folder.path() / "info.txt";
  ASSERT_EQ(std::system(("assimp info " + glb.string() + " > " + info.string() + " 2>&1").c_str()), 0);
  EXPECT_THAT(text_of(info), ::testing::ContainsRegex("Animations: +1"));
}

TEST(Export, ASeriesHasAGridAndASurfaceAFrame) {
  TemporaryFolder folder;
  const auto pvd = folder.path() / "run.pvd";
  const Outcome outcome = run_program("export " + kSmall + "--seconds 0.1 --every 5 -o " + pvd.string());
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(files_in(folder.path() / "run"), 6u);
  EXPECT_THAT(text_of(pvd), AllOf(HasSubstr("timestep=\"0.1\" part=\"0\" file=\"run/run_00002.vtu\""),
                                  HasSubstr("part=\"1\" file=\"run/run_00002.vtp\"")));
  EXPECT_THAT(text_of(folder.path() / "run" / "run_00000.vtu"), HasSubstr("<VTKFile type=\"UnstructuredGrid\""));
}

TEST(Export, ACaseForFebioIsSolvedAgain) {
  TemporaryFolder folder;
  const auto feb = folder.path() / "case.feb";
  const std::string cantilever = source_folder() + "/assets/cases/cantilever.json";
  const Outcome outcome = run_program("export " + cantilever + " -o " + feb.string());
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const Outcome solved = run_program("solve " + feb.string());
  EXPECT_EQ(solved.status, 0) << solved.output;
  EXPECT_THAT(solved.output,
              AllOf(HasSubstr("\"converged\": true"), HasSubstr("\"all.displacement.max\": 0.003962836")));
}

TEST(Export, AMuscleForFebioIsSolvedAgain) {
  TemporaryFolder folder;
  const auto feb = folder.path() / "muscle.feb";
  const Outcome outcome = run_program("export " + kSmall + "--muscle biceps_brachii -o " + feb.string());
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("belly is held as it is now"));
  EXPECT_EQ(run_program("solve " + feb.string()).status, 0);
  const Outcome slip = run_program("export " + kSmall + "--muscle bicps -o " + feb.string());
  EXPECT_EQ(slip.status, 2);
  EXPECT_THAT(slip.output, HasSubstr("biceps_brachii"));
}

TEST(Export, WhatCannotBeIsSaidBeforeAnythingIsSimulated) {
  TemporaryFolder folder;
  const std::string in = folder.path().string() + "/";
  const auto expect = [&](int status, const std::string& options, const auto& says) {
    const Outcome outcome = run_program("export elbow --seconds 3600 " + options);
    EXPECT_EQ(outcome.status, status) << options;
    EXPECT_THAT(outcome.output, says);
  };
  expect(2, "-o " + in + "limb.obj", AllOf(HasSubstr("\".obj\""), HasSubstr(".glb")));
  expect(2, "-o " + in + "limb", HasSubstr(".png"));
  expect(2, "", HasSubstr("--out"));
  expect(2, "--size 90000x2 -o " + in + "limb.png", HasSubstr("16 .. 8192"));
  expect(2, "--size 100x100 -o " + in + "limb.glb", HasSubstr("--size"));
  expect(2, "-o " + in + "limb.glb", AllOf(HasSubstr("72000 frames"), HasSubstr("--every")));
  expect(2, "--turn 5 -o " + in + "limb.png", HasSubstr("--turn"));
  expect(2, "--every 5 -o " + in + "limb.png", HasSubstr("--every"));
  expect(2, "--muscle biceps_brachii -o " + in + "limb.vtu", HasSubstr("--muscle"));
  expect(2, "--show labels=on -o " + in + "limb.vtu", HasSubstr("--show"));
  expect(2, "--turn 0 -o " + in + "limb.mp4", HasSubstr("--turn"));
  expect(2, "--size 101x100 -o " + in + "limb.mp4", HasSubstr("even"));
  expect(66, "--language xx -o " + in + "limb.png", HasSubstr("en"));
  expect(74, "-o " + in + "no/such/folder/limb.png", HasSubstr("no/such/folder"));
  EXPECT_EQ(files_in(folder.path()), 0u);
  const Outcome outcome = run_program("export elbow -o " + in + "limb.mp4", "PATH=/nowhere");
  EXPECT_EQ(outcome.status, 69);
  EXPECT_THAT(outcome.output, HasSubstr("apt-get install ffmpeg"));
}

}  // namespace
}  // namespace myotact::testing
