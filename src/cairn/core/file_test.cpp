// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder_)) result.push_back(entry.path().filename());
    return result;
  }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

/// Makes the system refuse to let a file grow beyond `bytes`, as a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

template <class Action>
InputError::Details failure_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.details();
  }
  return {"", 0, "no exception", "", ""};
}

TEST_F(FileTest, reads_what_was_written) {
  const std::string contents("a\0b\nc", 5);
  write_file(folder_ / "a", contents);
  EXPECT_EQ(read_file(folder_ / "a"), contents);
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(FileTest, reading_what_is_not_there_names_the_file) {
  const auto details = failure_of([&] { (void)read_file(folder_ / "a"); });
  EXPECT_EQ(details.file, (folder_ / "a").string());
  EXPECT_EQ(details.found, "No such file or directory");
}

TEST_F(FileTest, reading_a_folder_says_so) {
  EXPECT_EQ(failure_of([&] { (void)read_file(folder_); }).found, "a folder");
}

TEST_F(FileTest, replaces_an_older_file_only_when_complete) {
  write_file(folder_ / "a", "old");
  AtomicFile file(folder_ / "a");
  file.write("new");
  EXPECT_EQ(read_file(folder_ / "a"), "old");
  file.commit();
  EXPECT_EQ(read_file(folder_ / "a"), "new");
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(FileTest, leaves_nothing_when_it_is_given_up) {
  { AtomicFile(folder_ / "a").write("half"); }
  EXPECT_TRUE(names().empty());
}

TEST_F(FileTest, is_written_once) {
  AtomicFile file(folder_ / "a");
  file.commit();
  EXPECT_THROW(file.commit(), PreconditionError);
  EXPECT_THROW(file.write("more"), PreconditionError);
}

/// A killed writer leaves nothing under the file's name: the old contents stay.
TEST_F(FileTest, survives_a_killed_writer) {
  write_file(folder_ / "a", "old");
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(folder_ / "a");
    file.write(std::string(1 << 20, 'x'));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_file(folder_ / "a"), "old");
}

TEST_F(FileTest, a_full_disk_leaves_the_old_file) {
  write_file(folder_ / "a", "old");
  const auto write = [&](std::size_t bytes) {
    return failure_of([&] {
      const FileSizeLimit limit(1000);
      write_file(folder_ / "a", std::string(bytes, 'x'));
    });
  };
  EXPECT_EQ(write(1 << 20).expected, "to write the file");  // fails in write()
  EXPECT_EQ(write(1500).found, "File too large");           // stays in the buffer, fails in commit()
  EXPECT_EQ(read_file(folder_ / "a"), "old");
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(FileTest, a_missing_folder_says_what_to_do) {
  const auto details = failure_of([&] { write_file(folder_ / "no" / "a", "x"); });
  EXPECT_EQ(details.expected, "to create the file");
  EXPECT_EQ(details.remedy, "Make the folder first.");
}

TEST_F(FileTest, a_folder_or_device_is_no_file_to_write) {
  EXPECT_EQ(failure_of([&] { write_file(folder_, "x"); }).found, "a folder");
  EXPECT_EQ(failure_of([&] { write_file("/dev/null", "x"); }).found, "a device or pipe");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, follows_a_link) {
  write_file(folder_ / "a", "old");
  fs::create_symlink("a", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "a"), "new");
}

TEST_F(FileTest, temporary_names_differ) {
  EXPECT_NE(temporary_beside(folder_ / "a"), temporary_beside(folder_ / "a"));
  EXPECT_EQ(temporary_beside(folder_ / "a").parent_path(), folder_);
}

}  // namespace
}  // namespace cairn
