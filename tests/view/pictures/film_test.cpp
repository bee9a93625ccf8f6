// Films with a stand-in for ffmpeg on PATH, and without one.

#include "view/pictures/film.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/file.h"
#include "view/pictures/video_pipe.h"

namespace myotact::view {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 32, kHeight = 20;
constexpr std::size_t kPicture_bytes = std::size_t{kWidth} * kHeight * 3;

/// A folder of its own, and a PATH on which only what the test puts there is found before the system's programs.
class FilmTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("myotact_film_" + name);
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "bin");
    path_ = std::getenv("PATH");
    ::setenv("PATH", (folder_ / "bin").c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }

  void put_ffmpeg(const std::string& script) const {
    const fs::path file = folder_ / "bin" / "ffmpeg";
    std::ofstream(file) << "#!/bin/sh\nPATH=" << path_ << "\nfor last; do :; done\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }

  /// Its pictures at these times, each of one colour: of the number of the call.
  FilmResult film_of(const std::vector<double>& times_s) const {
    Film film(folder_ / "film", kWidth, kHeight);
    std::uint8_t colour = 0;
    for (const double time_s : times_s) {
      ++colour;
      for (int i = 0; i < 200 && !film.wants_picture(time_s) && !film.result(); ++i) rest();
      if (film.wants_picture(time_s)) film.add(time_s, std::vector<std::uint8_t>(kPicture_bytes, colour));
    }
    film.end();
    while (!film.result()) rest();
    return *film.result();
  }

  static void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }

  fs::path folder_;
  std::string path_;
};

TEST_F(FilmTest, FfmpegGetsTheSizeTheRateAndEveryPicture) {
  put_ffmpeg("echo \"$@\" > " + (folder_ / "words").string() + "\ncat > \"$last\"");
  const FilmResult result = film_of({0.0, 0.01, 0.05, 0.09, 0.25});
  EXPECT_EQ(result.fault, "");
  EXPECT_TRUE(result.video);
  EXPECT_EQ(result.path, folder_ / "film.mp4");
  // At 25 a second these are pictures 0, 1, 2 and 6: the second of picture 0 is not wanted, 6 stands for 3 to 5 too.
  EXPECT_EQ(result.pictures, 7);
  const std::string video = read_file(result.path);
  ASSERT_EQ(video.size(), 7 * kPicture_bytes);
  std::string colours;
  for (std::size_t i = 0; i < 7; ++i) colours += static_cast<char>('0' + video[i * kPicture_bytes]);
  EXPECT_EQ(colours, "1345555");
  const std::string words = read_file(folder_ / "words");
  for (const char* wanted : {"-pixel_format rgb24", "-video_size 32x20", "-framerate 25", "-vf vflip"}) {
    EXPECT_NE(words.find(wanted), std::string::npos) << words;
  }
}

TEST_F(FilmTest, APathIsNeverReadByAShell) {
  put_ffmpeg("cat > \"$last\"");
  const fs::path stem = folder_ / "a film; touch $(echo here) 'x";
  Film film(stem, kWidth, kHeight);
  film.add(0.0, std::vector<std::uint8_t>(kPicture_bytes));
  film.end();
  while (!film.result()) rest();
  EXPECT_EQ(film.result()->fault, "");
  EXPECT_TRUE(fs::exists(stem.string() + ".mp4"));
}

TEST_F(FilmTest, AnFfmpegThatDiesEndsTheFilmAlone) {
  put_ffmpeg("head -c 100 > /dev/null; exit 3");
  std::vector<double> times_s;
  for (int i = 0; i < 200; ++i) times_s.push_back(0.04 * i);  // far more than a pipe holds
  const FilmResult result = film_of(times_s);
  EXPECT_NE(result.fault.find("ffmpeg"), std::string::npos) << result.fault;
  EXPECT_FALSE(fs::exists(folder_ / "film.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "unfinished_film.mp4"));
}

TEST_F(FilmTest, AnFfmpegThatCannotWriteSaysSoAtTheEnd) {
  put_ffmpeg("echo half > \"$last\"; cat > /dev/null; exit 1");  // as on a full disk
  const FilmResult result = film_of({0.0, 0.04, 0.08});
  EXPECT_NE(result.fault.find("could not write"), std::string::npos) << result.fault;
  EXPECT_FALSE(fs::exists(folder_ / "unfinished_film.mp4"));
}

TEST_F(FilmTest, ASlowFfmpegNeverHoldsUpTheDrawing) {
  put_ffmpeg("sleep 1; cat > \"$last\"");
  Film film(folder_ / "film", kWidth, kHeight);
  int taken = 0;
  for (int i = 0; i < 500; ++i) {  // twenty seconds of film at once
    if (!film.wants_picture(0.04 * i)) continue;
    film.add(0.04 * i, std::vector<std::uint8_t>(kPicture_bytes));
    ++taken;
  }
  EXPECT_LT(taken, 100);  // what the pipe and the queue hold
  film.end();
  while (!film.result()) rest();
  EXPECT_EQ(film.result()->fault, "");
}

TEST_F(FilmTest, WithoutFfmpegItIsNumberedPictures) {
  const FilmResult result = film_of({0.0, 0.05, 0.13});
  EXPECT_EQ(result.fault, "");
  EXPECT_FALSE(result.video);
  EXPECT_EQ(result.pictures, 4);
  for (const char* name : {"00001.png", "00002.png", "00003.png", "00004.png"}) {
    EXPECT_TRUE(read_file(result.path / name).starts_with("\x89PNG")) << name;
  }
  EXPECT_EQ(read_file(result.path / "00003.png"), read_file(result.path / "00004.png"));  // stands for both
  EXPECT_NE(read_file(result.path / "00001.png"), read_file(result.path / "00002.png"));
}

TEST_F(FilmTest, AFolderThatCannotBeWrittenIsSaid) {
  std::ofstream(folder_ / "film") << "a file where a folder is wanted";
  EXPECT_NE(film_of({0.0, 0.05}).fault, "");
}

TEST_F(FilmTest, TheRealFfmpegMakesAVideo) {
  ::setenv("PATH", path_.c_str(), 1);
  if (!program_on_path("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
  std::vector<double> times_s;
  for (int i = 0; i < 50; ++i) times_s.push_back(0.04 * i);
  const FilmResult result = film_of(times_s);
  EXPECT_EQ(result.fault, "");
  const std::string video = read_file(result.path);
  EXPECT_EQ(video.substr(4, 4), "ftyp");  // ISO/IEC 14496-12: the first box of a file
  EXPECT_NE(video.find("moov"), std::string::npos);
}

}  // namespace
}  // namespace myotact::view
