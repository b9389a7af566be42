#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "files/beside.h"

namespace mimicry {

/// A new folder, gone at the end of the test.
class FileTest : public testing::Test {
 protected:
  FileTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FileTest() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::ptrdiff_t entries() const {
    return std::distance(std::filesystem::directory_iterator(folder_),
                         std::filesystem::directory_iterator());
  }

  /// Why a file beside another is not read; invalid_input, which is no reason of its: it is.
  static ErrorKind refusal_beside(const std::string& file, const char* name) {
    try {
      read_beside(file, name);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::invalid_input;
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  (std::string("mimicry_file_test_") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace mimicry
