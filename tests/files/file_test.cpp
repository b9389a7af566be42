#include <csignal>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mimicry/base/error.h>
#include <mimicry/files/append_file.h>
#include <mimicry/files/beside.h>
#include <mimicry/files/file.h>
#include <mimicry/files/output_lock.h>

namespace mimicry::files {
namespace {

namespace fs = std::filesystem;

/// A new folder, gone at the end of the test.
class FileTest : public testing::Test {
 protected:
  FileTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_ = fs::path(testing::TempDir()) /
                     (std::string("mimicry_file_test_") +
                      testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FileTest, EveryByteComesBackAndNothingElseIsLeft) {
  std::string bytes;
  for (int n = 0; n < 300'000; ++n) bytes += static_cast<char>(n * 7);
  write_file_atomically(path("a"), "before");
  write_file_atomically(path("a"), bytes);
  EXPECT_EQ(read_file(path("a")), bytes);
  EXPECT_EQ(MappedFile(path("a")).bytes(), bytes);
  write_file_atomically(path("empty"), "");
  EXPECT_EQ(MappedFile(path("empty")).bytes(), "");
  EXPECT_THROW(MappedFile(path("nowhere")), Error);
  fs::remove(path("empty"));
  write_file_atomically(path("a"), "");
  EXPECT_EQ(read_file(path("a")), "");
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, FailuresAreErrorsThatNameThePathAndLeaveNothing) {
  const auto expect_error = [](const std::string& path, auto&& call) {
    try {
      call();
      ADD_FAILURE() << "no error for " << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_EQ(std::string(error.what()).find(path + ": "), 0u) << error.what();
    }
  };
  const std::string missing = path("no/such");
  expect_error(missing, [&] { read_file(missing); });
  expect_error(missing, [&] { write_file_atomically(missing, "x"); });
  expect_error(folder_.string(), [&] { read_file(folder_.string()); });
  expect_error(folder_.string(), [&] { write_file_atomically(folder_.string(), "x"); });
  EXPECT_EQ(entries(), 0);
}

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

TEST_F(FileTest, PartOfAnotherWriterIsNotTouched) {
  const std::string part = path("a.part") + std::to_string(::getpid()) + "-0";
  write_file_atomically(part, "another's");
  write_file_atomically(path("a"), "ours");
  EXPECT_EQ(read_file(part), "another's");
  EXPECT_EQ(read_file(path("a")), "ours");
}

TEST_F(FileTest, FilesBesideAnotherAreReadAndNoneOutsideOfItsFolder) {
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
  const auto kind = [&](const char* name) {
    try {
      read_beside(mesh, name);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::invalid_input;
  };
  for (const char* name : {"../secret", "/etc/passwd", "outside", "up/secret", "..", "up"})
    EXPECT_EQ(kind(name), ErrorKind::unsupported) << name;
  for (const char* name : {"pipe", "parts", "."}) EXPECT_EQ(kind(name), ErrorKind::io) << name;
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
}

TEST_F(FileTest, AppendedBytesStayOnceSynced) {
  {
    AppendFile file(path("rows"), 0);
    file.append("one\n");
    file.sync();
    file.append("two\n");
    EXPECT_EQ(file.size(), 8u);
    EXPECT_EQ(read_file(path("rows")), "one\ntwo\n");
  }
  EXPECT_EQ(read_file(path("rows")), "one\n");
  {
    AppendFile file(path("rows"), 2);
    file.append("ce");
    file.sync();
  }
  EXPECT_EQ(read_file(path("rows")), "once");
}

TEST_F(FileTest, LockKeepsASecondOneOutUntilItIsGone) {
  const auto refused = [&](auto&& take) {
    try {
      take();
      return false;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_NE(std::string(error.what()).find(path("out")), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--out"), std::string::npos) << error.what();
      return true;
    }
  };
  const auto folder = [&] { return OutputLock::of_folder(path("out")); };
  const auto file = [&] { return OutputLock::of_file(path("out.csv")); };
  for (int round = 0; round < 3; ++round) {
    const OutputLock one = folder();
    const OutputLock two = file();
    EXPECT_TRUE(refused(folder));
    EXPECT_TRUE(refused(file));
    EXPECT_TRUE(fs::exists(path(".out.csv.lock")));
    EXPECT_TRUE(fs::is_empty(path("out")));
  }
  EXPECT_FALSE(refused(folder));
  EXPECT_EQ(entries(), 0);  // no folder where nothing came; no lock's file
  fs::create_directory(path("out"));
  EXPECT_FALSE(refused(folder));
  EXPECT_EQ(entries(), 1);
  EXPECT_THROW(OutputLock::of_file(path("no/such")), Error);
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
}  // namespace mimicry::files
