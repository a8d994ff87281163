// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <signal.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <base/progress.h>

#include "temporary_folder.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string failure_of(const fs::path& path, std::string_view bytes) {
  try {
    write_file_atomically(path, bytes);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "not refused";
}

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(WriteFileAtomically, NewFileHasTheBytesAndNothingElseIsLeft) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b", 3);
  write_file_atomically(folder.path() / "out", bytes);
  EXPECT_EQ(content_of(folder.path() / "out"), bytes);
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(WriteFileAtomically, NewFileHasThePermissionsOfTheMask) {
  const TemporaryFolder folder;
  const mode_t old_mask = ::umask(027);
  write_file_atomically(folder.path() / "out", "x");
  ::umask(old_mask);
  EXPECT_EQ(mode_of(folder.path() / "out"), 0640u);
}

TEST(WriteFileAtomically, PermissionsOfTheOldFileAreKept) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out";
  std::ofstream(path) << "old";
  ASSERT_EQ(::chmod(path.c_str(), 0604), 0);
  write_file_atomically(path, "new");
  EXPECT_EQ(content_of(path), "new");
  EXPECT_EQ(mode_of(path), 0604u);
}

TEST(WriteFileAtomically, LinkStaysALink) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out";
  std::ofstream(path) << "old";
  fs::create_symlink("out", folder.path() / "link");
  write_file_atomically(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content_of(path), "new");
}

TEST(WriteFileAtomically, RelativeNamesNeedNoFolder) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  write_file_atomically("out", "x");
  fs::current_path(before);
  EXPECT_EQ(content_of(folder.path() / "out"), "x");
}

TEST(WriteFileAtomically, LongestNameIsWritten) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / std::string(255, 'n');
  write_file_atomically(path, "x");
  EXPECT_EQ(content_of(path), "x");
}

TEST(WriteFileAtomically, FailuresNameThePathAndTheReason) {
  const TemporaryFolder folder;
  const fs::path missing = folder.path() / "missing" / "out";
  EXPECT_EQ(failure_of(missing, "x"),
            missing.string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(failure_of(folder.path(), "x"), folder.path().string() + ": is a folder");
}

TEST(WriteFileAtomically, FullDeviceIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "the system has no /dev/full";
  EXPECT_THAT(failure_of("/dev/full", "x"),
              HasSubstr("/dev/full: cannot be written: No space left"));
}

TEST(WriteFileAtomically, DevicesAreWrittenDirectly) {
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteFileAtomically, PipesAreWrittenDirectly) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  write_file_atomically("/dev/fd/" + std::to_string(ends[1]), "through");
  char bytes[7];
  EXPECT_EQ(::read(ends[0], bytes, sizeof bytes), 7);
  EXPECT_EQ(std::string(bytes, sizeof bytes), "through");
  ::close(ends[0]);
  ::close(ends[1]);
}

class Impatient : public ProgressObserver {
 public:
  bool cancelled() override { return ++asked_ > 2; }

 private:
  int asked_ = 0;
};

TEST(WriteFileAtomically, CancellingEndsTheWaitForAReaderOfThePipe) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  Impatient impatient;
  const std::string more_than_a_pipe_holds(std::size_t{1} << 21, 'x');
  EXPECT_THROW(write_file_atomically("/dev/fd/" + std::to_string(ends[1]), more_than_a_pipe_holds,
                                     &impatient),
               Cancelled);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(WriteFileAtomically, TargetIsAsItWasWhenCancelled) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out";
  std::ofstream(path) << "old";
  Impatient impatient;
  const std::string bytes(std::size_t{1} << 22, 'x');
  EXPECT_THROW(write_file_atomically(path, bytes, &impatient), Cancelled);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

// Runs in a process of its own, because limits and signals are those of a process. Returns the exit
// code.
template <class Body>
int exit_code_of_child(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(WriteFileAtomically, TargetIsAsItWasWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out";
  std::ofstream(path) << "old";
  const int code = exit_code_of_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    return failure_of(path, std::string(5000, 'x')) ==
                   path.string() + ": cannot be written: File too large"
               ? 0
               : 1;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(RemoveUnfinishedFile, SignalInTheMiddleLeavesTheTargetAsItWas) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out";
  std::ofstream(path) << "old";
  const int code = exit_code_of_child([&] {
    // The limit on the file's size raises the signal while the temporary file is half written.
    ::signal(SIGXFSZ, [](int) {
      remove_unfinished_file();
      ::_exit(42);
    });
    const rlimit small = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    write_file_atomically(path, std::string(5000, 'x'));
    return 0;
  });
  EXPECT_EQ(code, 42);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(RemoveUnfinishedFile, DoesNothingWhenNoFileIsBeingWritten) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "out", "x");
  remove_unfinished_file();
  EXPECT_EQ(content_of(folder.path() / "out"), "x");
}

TEST(WriteFileAtomically, WritesToWhereALinkLeadsThoughNothingIsThere) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("there", folder.path() / "link");
  write_file_atomically(folder.path() / "link", "bytes");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder.path() / "there"));
}

}  // namespace
}  // namespace meshrepair
