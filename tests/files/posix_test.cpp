// What only POSIX has: pipes, devices, links that anyone may make, signals.
#include <csignal>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mimicry/base/error.h>

#include "files/append_file.h"
#include "files/beside.h"
#include "files/file.h"
#include "files/file_folder.h"
#include "files/output_lock.h"
#include "files/system.h"

namespace mimicry {
namespace {

namespace fs = std::filesystem;

TEST_F(FileTest, LinkStaysALinkAndAPipeStaysAPipe) {
  write_file_atomically(path("target"), "old");
  fs::create_symlink("target", path("link"));
  write_file_atomically(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_file(path("target")), "new");

  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const int pipe = ::open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
  write_file_atomically(path("pipe"), "through");
  char got[8] = {};
  EXPECT_EQ(::read(pipe, got, sizeof(got)), 7);
  EXPECT_STREQ(got, "through");
  ::close(pipe);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(FileTest, PipeWithoutItsOtherEndIsAnErrorAndNoWait) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file_atomically(path("pipe"), "x"), Error);
  EXPECT_THROW(read_file(path("pipe"), Accept::regular), Error);
  EXPECT_THROW(MappedFile(path("pipe"), Accept::regular), Error);
  EXPECT_THROW(AppendFile(path("pipe"), 0), Error);
  EXPECT_THROW(AppendFile("/dev/null", 0), Error);
  EXPECT_THROW(AppendFile(folder_.string(), 0), Error);
  write_file_atomically("/dev/null", "x");
  EXPECT_THROW(write_file_atomically("/dev/full", "x"), Error);
  EXPECT_THROW(OutputLock::of_folder("/dev/null/x"), Error);
  (void)OutputLock::of_file("/dev/null");
}

TEST_F(FileTest, WhatIsUnfinishedCanBeRemovedAtAnyTime) {
  // A child writes files again and again, and ends itself in the middle of it as a signal would.
  for (int round = 0; round < 40; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      std::signal(SIGALRM, [](int) {
        remove_unfinished();
        ::_exit(0);
      });
      const OutputLock lock = OutputLock::of_file(path("a"));
      ::ualarm(static_cast<useconds_t>(1000 + 700 * round), 0);
      const std::string bytes(100'000, 'x');
      for (;;) write_file_atomically(path("a"), bytes);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename(), "a") << "round " << round;
  }
  EXPECT_EQ(read_file(path("a")).size(), 100'000u);
}

TEST_F(FileTest, LinksThatLeadOutOfTheFolderAreNotFollowed) {
  fs::create_directories(folder_ / "model" / "parts");
  const auto write = [&](const char* name) { write_file_atomically(path(name), name); };
  for (const char* name : {"model/a.gltf", "model/a.bin", "model/parts/b.bin", "secret"})
    write(name);
  fs::create_symlink("parts/b.bin", folder_ / "model" / "inside");
  fs::create_symlink("../secret", folder_ / "model" / "outside");
  fs::create_directory_symlink("..", folder_ / "model" / "up");
  ASSERT_EQ(::mkfifo(path("model/pipe").c_str(), 0600), 0);
  const std::string mesh = path("model/a.gltf");
  EXPECT_EQ(read_beside(mesh, "a.bin"), "model/a.bin");
  EXPECT_EQ(read_beside(mesh, "parts/b.bin"), "model/parts/b.bin");
  EXPECT_EQ(read_beside(mesh, "inside"), "model/parts/b.bin");
  EXPECT_EQ(read_beside(mesh, "none.bin"), std::nullopt);
  EXPECT_EQ(read_beside(mesh, "a.bin/c"), std::nullopt);
  for (const char* name : {"../secret", "/etc/passwd", "outside", "up/secret", "..", "up"})
    EXPECT_EQ(refusal_beside(mesh, name), ErrorKind::unsupported) << name;
  for (const char* name : {"pipe", "parts", "."})
    EXPECT_EQ(refusal_beside(mesh, name), ErrorKind::io) << name;
}

TEST_F(FileTest, AFolderThatWasMadeIsRemovedAtAnyTimeWhereNothingCameThere) {
  const auto end_in_the_middle = [&](const std::string& folder, auto&& meanwhile) {
    const pid_t child = ::fork();
    if (child == 0) {
      const OutputLock lock = OutputLock::of_folder(folder);
      meanwhile();
      remove_unfinished();
      ::_exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  };
  end_in_the_middle(path("new"), [] {});
  EXPECT_EQ(entries(), 0);
  end_in_the_middle(path("new"), [&] { write_file_atomically(path("new/a"), "row"); });
  EXPECT_EQ(read_file(path("new/a")), "row");
  fs::create_directory(path("old"));
  end_in_the_middle(path("old"), [] {});
  EXPECT_TRUE(fs::is_empty(path("old")));
}

}  // namespace
}  // namespace mimicry
