#include <filesystem>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mimicry/base/error.h>
#include <mimicry/files/beside.h>
#include <mimicry/files/file.h>

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
  write_file_atomically(path("a.part0"), "another's");
  write_file_atomically(path("a"), "ours");
  EXPECT_EQ(read_file(path("a.part0")), "another's");
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

}  // namespace
}  // namespace mimicry::files
