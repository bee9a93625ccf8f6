#include "core/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;

std::size_t entries_of(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(File, BytesComeBackAsWritten) {
  const myotact::testing::TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder / "f", bytes);
  EXPECT_EQ(read_file(folder / "f"), bytes);
  write_file(folder / "f", "");
  EXPECT_EQ(read_file(folder / "f"), "");
  EXPECT_EQ(entries_of(folder.path()), 1u) << "the temporary file stays behind";
}

TEST(File, WhatIsNoFileIsRefusedWithItsName) {
  const myotact::testing::TemporaryFolder folder;
  EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { read_file(folder / "gone"); }), HasSubstr("gone"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_file(folder.path()); }), HasSubstr("not a regular file"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_file(folder / "pipe"); }), HasSubstr("pipe"));
  complaint(ExitStatus::NoInput, [&] { read_file(folder / std::string(5000, 'x')); });
}

TEST(File, TooLargeAFileIsRefusedBeforeItIsRead) {
  const myotact::testing::TemporaryFolder folder;
  const int fd = ::open((folder / "sparse").c_str(), O_CREAT | O_WRONLY, 0600);
  ASSERT_EQ(::ftruncate(fd, static_cast<off_t>(kLargestInput_bytes) + 1), 0);
  ::close(fd);
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_file(folder / "sparse"); }), HasSubstr("at most"));
}

TEST(File, AFailedWriteLeavesNothingBehind) {
  const myotact::testing::TemporaryFolder folder;
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { write_file(folder / "no/such/f", "x"); }),
              HasSubstr("no/such/f"));
  std::filesystem::create_directory(folder / "taken");
  complaint(ExitStatus::InputOutput, [&] { write_file(folder / "taken", "x"); });  // a folder is in the way
  EXPECT_EQ(entries_of(folder.path()), 1u);
}

TEST(File, ADeviceOrPipeIsNeverReplaced) {
  const myotact::testing::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { write_file(folder / "pipe", "x"); }),
              HasSubstr("pipe: cannot be written: it is a device or pipe"));
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST(File, WhetherItCanBeWrittenIsKnownBefore) {
  const myotact::testing::TemporaryFolder folder;
  require_writable(folder / "f");
  EXPECT_EQ(entries_of(folder.path()), 0u);
  complaint(ExitStatus::InputOutput, [&] { require_writable(folder / "new/f"); });
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { require_writable(folder.path()); }),
              HasSubstr("it is a folder, not a file"));
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [] { require_writable(""); }), HasSubstr("names no file"));
  complaint(ExitStatus::InputOutput, [] { require_writable("/proc/f"); });
}

TEST(File, AFolderIsMadeOrTheReasonIsNamed) {
  const myotact::testing::TemporaryFolder folder;
  make_writable_folder(folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  EXPECT_EQ(entries_of(folder / "a/b"), 0u);
  write_file(folder / "f", "x");
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { make_writable_folder(folder / "f/under"); }),
              HasSubstr("f/under"));
  // A read-only place for everyone, root included.
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [] { make_writable_folder("/proc/myotact"); }), HasSubstr("/proc"));
}

TEST(File, Sha256OfThePublishedExamples) {  // FIPS 180-2, appendix B.1, and the empty message
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace myotact
