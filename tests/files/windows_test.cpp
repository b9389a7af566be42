// What Windows does its own way: files in use, long paths, the null device.
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <windows.h>

#include <mimicry/base/error.h>

#include "files/environment.h"
#include "files/file.h"
#include "files/file_folder.h"
#include "files/output_lock.h"
#include "files/system.h"

namespace mimicry {
namespace {

namespace fs = std::filesystem;

TEST_F(FileTest, FileThatIsBeingReadCanBeReplaced) {
  write_file_atomically(path("a"), "old");
  {
    const Descriptor reader(open_to_read(path("a"), Wait::no));
    ASSERT_TRUE(reader);
    write_file_atomically(path("a"), "new");
    EXPECT_EQ(read_file(path("a")), "new");
    char old = 0;
    EXPECT_EQ(read_some(reader.get(), &old, 1), 1);
    EXPECT_EQ(old, 'o');
  }
  EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, PathsMayBeLong) {
  const std::wstring prefix = LR"(\\?\)";
  std::vector<std::wstring> folders = {fs::absolute(folder_).make_preferred().native()};
  while (folders.back().size() < 300) {
    folders.push_back(folders.back() + L"\\a folder with quite a long name");
    ASSERT_TRUE(CreateDirectoryW((prefix + folders.back()).c_str(), nullptr));
  }
  const std::string file = to_text(folders.back()) + "\\file";
  write_file_atomically(file, "far");
  write_file_atomically(file, "farther");
  EXPECT_EQ(read_file(file), "farther");
  EXPECT_TRUE(DeleteFileW((prefix + to_path(file).native()).c_str()));
  for (; folders.size() > 1; folders.pop_back())
    EXPECT_TRUE(RemoveDirectoryW((prefix + folders.back()).c_str()));
}

TEST_F(FileTest, NullDeviceTakesEverything) {
  write_file_atomically("NUL", "x");
  (void)OutputLock::of_file("NUL");
  EXPECT_EQ(read_file("NUL"), "");
  EXPECT_THROW(read_file("NUL", Accept::regular), Error);
}

TEST_F(FileTest, EnvironmentIsUtf8) {
  _wputenv(L"MIMICRY_FILE_TEST=\u00dc \u66f2");
  EXPECT_EQ(environment("MIMICRY_FILE_TEST"), to_text(u8"\u00dc \u66f2"));
  EXPECT_EQ(environment("MIMICRY_NO_SUCH_VARIABLE"), std::nullopt);
  EXPECT_FALSE(cache_folder().empty());
}

TEST_F(FileTest, WhatIsUnfinishedCanBeRemovedWhileItIsWritten) {
  // The other program is this one, started again for the statement alone.
  EXPECT_EXIT(
      {
        std::thread writer([&] {
          const OutputLock lock = OutputLock::of_file(path("a"));
          const std::string bytes(100'000, 'x');
          for (;;) write_file_atomically(path("a"), bytes);
        });
        Sleep(100);
        remove_unfinished();
        TerminateProcess(GetCurrentProcess(), 7);
      },
      testing::ExitedWithCode(7), "");
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_EQ(entry.path().filename(), "a");
}

}  // namespace
}  // namespace mimicry
