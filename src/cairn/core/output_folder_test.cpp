// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <set>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

class OutputFolderTest : public testing::Test {
 protected:
  static std::set<std::string> names(const fs::path& folder) {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder)) result.insert(entry.path().filename());
    return result;
  }

  /// A finished result in `target` that holds one file.
  static void make(const fs::path& target, const std::string& name, std::string_view kind = "run") {
    OutputFolder output(target, kind);
    write_file(output.work() / name, name);
    output.commit();
  }

  /// What the refusal says was found; "" where nothing is refused.
  static std::string refusal(const fs::path& target, std::string_view kind = "run") {
    try {
      const OutputFolder output(target, kind);
    } catch (const InputError& error) {
      return error.details().found;
    }
    return "";
  }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  const fs::path target_ = folder_ / "run";
};

using Names = std::set<std::string>;

TEST_F(OutputFolderTest, appears_as_a_whole) {
  OutputFolder output(target_, "run");
  write_file(output.work() / "a", "a");
  EXPECT_FALSE(fs::exists(target_));
  output.commit();
  EXPECT_EQ(names(target_), (Names{".cairn", "a"}));
  EXPECT_EQ(names(folder_), Names{"run"});
}

TEST_F(OutputFolderTest, leaves_nothing_when_it_is_given_up) {
  {
    const OutputFolder output(folder_ / "new" / "deep" / "run", "run");
    write_file(output.work() / "a", "a");
  }
  EXPECT_TRUE(names(folder_).empty());
}

TEST_F(OutputFolderTest, makes_the_folders_above_it) {
  make(folder_ / "new" / "deep" / "run", "a");
  EXPECT_EQ(names(folder_ / "new" / "deep"), Names{"run"});
}

TEST_F(OutputFolderTest, replaces_its_own_earlier_result) {
  make(target_, "old");
  make(target_, "new");
  EXPECT_EQ(names(target_), (Names{".cairn", "new"}));
  EXPECT_EQ(names(folder_), Names{"run"});
}

TEST_F(OutputFolderTest, keeps_the_old_result_when_the_new_one_is_given_up) {
  make(target_, "old");
  { const OutputFolder output(target_, "run"); }
  EXPECT_EQ(names(target_), (Names{".cairn", "old"}));
}

TEST_F(OutputFolderTest, takes_an_empty_folder) {
  fs::create_directory(target_);
  make(target_, "a");
  EXPECT_EQ(names(target_), (Names{".cairn", "a"}));
}

TEST_F(OutputFolderTest, refuses_what_is_not_its_own) {
  fs::create_directory(target_);
  write_file(target_ / "thesis.tex", "years of work");
  EXPECT_EQ(refusal(target_), "a folder with other contents");
  EXPECT_EQ(names(target_), Names{"thesis.tex"});
  EXPECT_EQ(refusal(target_ / "thesis.tex"), "a file of that name");
}

TEST_F(OutputFolderTest, refuses_a_folder_of_another_kind) {
  make(target_, "a", "sequence");
  EXPECT_EQ(refusal(target_, "run"), "a sequence that cairn wrote");
  EXPECT_EQ(refusal(target_, "sequence"), "");
}

TEST_F(OutputFolderTest, refuses_what_cannot_be_made) {
  EXPECT_NE(refusal("/dev/null/run"), "");
  EXPECT_NE(refusal("/proc/run"), "");
}

TEST_F(OutputFolderTest, takes_a_slash_at_the_end) {
  make(target_ / "", "a");
  EXPECT_EQ(names(folder_), Names{"run"});
}

TEST_F(OutputFolderTest, follows_a_link) {
  fs::create_directory(folder_ / "disk");
  fs::create_directory_symlink("disk", target_);
  make(target_, "a");
  EXPECT_TRUE(fs::is_symlink(target_));
  EXPECT_EQ(names(folder_ / "disk"), (Names{".cairn", "a"}));
}

TEST_F(OutputFolderTest, takes_a_relative_path) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  make("run", "a");
  make("new/run", "a");
  fs::current_path(before);
  EXPECT_EQ(names(folder_), (Names{"new", "run"}));
  EXPECT_EQ(names(target_), (Names{".cairn", "a"}));
}

TEST_F(OutputFolderTest, fills_the_current_folder_in_place) {
  fs::create_directory(target_);
  const fs::path before = fs::current_path();
  fs::current_path(target_);
  make(".", "old");
  make(".", "new");
  EXPECT_EQ(fs::current_path(), target_);
  fs::current_path(before);
  EXPECT_EQ(names(target_), (Names{".cairn", "new"}));
}

TEST_F(OutputFolderTest, is_committed_once) {
  OutputFolder output(target_, "run");
  output.commit();
  EXPECT_THROW(output.commit(), PreconditionError);
}

/// What is to be gone on with lies in a file of that name.
bool has_state(const fs::path& work) {
  return fs::exists(work / "state");
}

/// Work on `target` that is given up when it has written a file.
void give_up(const fs::path& target, const std::string& name) {
  const OutputFolder output(target, "run", has_state);
  write_file(output.work() / name, name);
}

/// What the refusal of going on says was found; "" where nothing is refused.
std::string refusal_to_go_on(const fs::path& target) {
  try {
    const OutputFolder output(target, "run", has_state);
  } catch (const InputError& error) {
    return error.details().found;
  }
  return "";
}

TEST_F(OutputFolderTest, keeps_unfinished_work_that_is_worth_it) {
  make(target_, "old");
  give_up(target_, "state");
  EXPECT_EQ(names(folder_), (Names{"run", "run.unfinished"}));
  EXPECT_EQ(names(target_), (Names{".cairn", "old"}));
  OutputFolder output(target_, "run", has_state);
  EXPECT_EQ(output.work(), folder_ / "run.unfinished");
  EXPECT_EQ(names(output.work()), (Names{".cairn", "state"}));
  write_file(output.work() / "new", "new");
  output.commit();
  EXPECT_EQ(names(folder_), Names{"run"});
  EXPECT_EQ(names(target_), (Names{".cairn", "new", "state"}));
}

TEST_F(OutputFolderTest, removes_unfinished_work_that_is_not) {
  give_up(folder_ / "new" / "run", "nothing");
  EXPECT_TRUE(names(folder_).empty());
  give_up(target_, "state");
  {
    const OutputFolder output(target_, "run", has_state);
    fs::remove(output.work() / "state");
  }
  EXPECT_TRUE(names(folder_).empty());
}

TEST_F(OutputFolderTest, two_do_not_work_on_one) {
  {
    const OutputFolder output(target_, "run", has_state);
    write_file(output.work() / "state", "of the first");
    EXPECT_EQ(refusal_to_go_on(target_), "another run that works in it");
    EXPECT_EQ(read_file(output.work() / "state"), "of the first");
  }
  EXPECT_EQ(refusal_to_go_on(target_), "");
}

TEST_F(OutputFolderTest, another_process_locks_until_it_is_killed) {
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const OutputFolder output(target_, "run", has_state);
    write_file(output.work() / "state", "half");
    (void)!::write(ready[1], "!", 1);
    ::pause();
  }
  char signal = 0;
  ASSERT_EQ(::read(ready[0], &signal, 1), 1);
  EXPECT_EQ(refusal_to_go_on(target_), "another run that works in it");
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  for (const int end : ready) ::close(end);
  EXPECT_EQ(refusal_to_go_on(target_), "");
  EXPECT_EQ(names(folder_ / "run.unfinished"), (Names{".cairn", "state"}));
}

TEST_F(OutputFolderTest, goes_on_in_place) {
  fs::create_directory(target_);
  const fs::path before = fs::current_path();
  fs::current_path(target_);
  give_up(".", "state");
  EXPECT_EQ(names(target_), Names{"result.unfinished"});
  OutputFolder output(".", "run", has_state);
  EXPECT_EQ(names(output.work()), (Names{".cairn", "state"}));
  output.commit();
  fs::current_path(before);
  EXPECT_EQ(names(target_), (Names{".cairn", "state"}));
}

TEST_F(OutputFolderTest, goes_on_in_place_of_an_earlier_result) {
  make(target_, "old");
  const fs::path before = fs::current_path();
  fs::current_path(target_);
  give_up(".", "state");
  EXPECT_EQ(names(target_), (Names{".cairn", "old", "result.unfinished"}));
  OutputFolder output(".", "run", has_state);
  output.commit();
  fs::current_path(before);
  EXPECT_EQ(names(target_), (Names{".cairn", "state"}));
}

TEST_F(OutputFolderTest, does_not_go_on_in_what_is_not_its_own) {
  fs::create_directory(folder_ / "run.unfinished");
  write_file(folder_ / "run.unfinished" / "thesis.tex", "years of work");
  EXPECT_EQ(refusal_to_go_on(target_), "a folder with other contents");
  EXPECT_EQ(names(folder_ / "run.unfinished"), Names{"thesis.tex"});
  fs::create_directory(target_);
  write_file(target_ / "thesis.tex", "years of work");
  fs::remove_all(folder_ / "run.unfinished");
  EXPECT_EQ(refusal_to_go_on(target_), "a folder with other contents");
  EXPECT_EQ(names(folder_), Names{"run"});
}

TEST_F(OutputFolderTest, survives_a_killed_writer) {
  make(target_, "old");
  const pid_t child = ::fork();
  if (child == 0) {
    const OutputFolder output(target_, "run");
    write_file(output.work() / "half", "half");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(names(target_), (Names{".cairn", "old"}));
}

}  // namespace
}  // namespace cairn
