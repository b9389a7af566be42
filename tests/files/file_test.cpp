#include "files/file.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "files/append_file.h"
#include "files/beside.h"
#include "files/environment.h"
#include "files/file_folder.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "files/system.h"

namespace mimicry {
namespace {

namespace fs = std::filesystem;

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

TEST_F(FileTest, WhatStandsAtAPathOrWhyThatIsNotKnown) {
  write_file_atomically(path("a"), "");
  EXPECT_EQ(status_of(path("a")).type(), fs::file_type::regular);
  EXPECT_EQ(status_of(folder_.string()).type(), fs::file_type::directory);
  EXPECT_EQ(status_of(path("nowhere")).type(), fs::file_type::not_found);
#ifndef _WIN32
  fs::create_symlink(path("ring"), path("ring"));
  try {
    status_of(path("ring"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(std::string(error.what()).find(path("ring") + ": "), 0u) << error.what();
  }
#endif
}

TEST_F(FileTest, PartOfAnotherWriterIsNotTouched) {
  const std::string part = path("a.part") + std::to_string(process_number()) + "-0";
  write_file_atomically(part, "another's");
  write_file_atomically(path("a"), "ours");
  EXPECT_EQ(read_file(part), "another's");
  EXPECT_EQ(read_file(path("a")), "ours");
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
      EXPECT_NE(std::string(error.what()).find("another place"), std::string::npos) << error.what();
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
  write_file_atomically(path("file"), "");
  EXPECT_THROW(OutputLock::of_folder(path("file") + "/x"), Error);
}

TEST_F(FileTest, NamesAreUtf8) {
  const fs::path folder = folder_ / u8"\u00dcbung \u66f2\u7dda";
  const std::string inside = to_text(folder) + "/";
  make_folder(to_text(folder));
  ASSERT_TRUE(fs::is_directory(folder));
  const fs::path name = u8"r\u00fccken \U0001f58c.obj";
  const std::string file = inside + to_text(name);
  write_file_atomically(file, "first");
  write_file_atomically(file, "mesh");
  EXPECT_TRUE(fs::is_regular_file(folder / name));
  EXPECT_EQ(read_file(file), "mesh");
  EXPECT_EQ(MappedFile(file, Accept::regular).bytes(), "mesh");
  EXPECT_EQ(read_beside(inside + "a.gltf", to_text(name)), "mesh");
  std::FILE* const stream = open_stream(file);
  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(std::fgetc(stream), 'm');
  std::fclose(stream);
  {
    const OutputLock lock = OutputLock::of_file(file);
    EXPECT_THROW(OutputLock::of_file(file), Error);
    AppendFile rows(inside + to_text(u8"\u6570.csv"), 0);
    rows.append("1\n");
    rows.sync();
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  EXPECT_EQ(read_file(inside + to_text(u8"\u6570.csv")), "1\n");
  try {
    read_file(inside + to_text(u8"\u00f8"));
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find(inside + to_text(u8"\u00f8") + ": "), 0u);
  }
}

TEST_F(FileTest, FilesBesideAnotherAreReadAndNoneOutsideOfItsFolder) {
  fs::create_directories(folder_ / "model" / "parts");
  for (const char* name : {"model/a.gltf", "model/a.bin", "model/parts/b.bin", "secret"})
    write_file_atomically(path(name), name);
  const std::string mesh = path("model/a.gltf");
  EXPECT_EQ(read_beside(mesh, "a.bin"), "model/a.bin");
  EXPECT_EQ(read_beside(mesh, "parts/b.bin"), "model/parts/b.bin");
  EXPECT_EQ(read_beside(mesh, "parts/../a.bin"), "model/a.bin");
  EXPECT_EQ(read_beside(mesh, "none.bin"), std::nullopt);
  for (const char* name : {"../secret", ".."})
    EXPECT_EQ(refusal_beside(mesh, name), ErrorKind::unsupported) << name;
  for (const char* name : {"parts", "."})
    EXPECT_EQ(refusal_beside(mesh, name), ErrorKind::io) << name;
}

TEST_F(FileTest, BytesAreNotTakenForLines) {
  const std::string bytes = "a\nb\r\nc\x1a\n\r";
  write_file_atomically(path("lines"), bytes);
  EXPECT_EQ(fs::file_size(folder_ / "lines"), bytes.size());
  EXPECT_EQ(read_file(path("lines")), bytes);
  AppendFile file(path("lines"), bytes.size());
  file.append(bytes);
  file.sync();
  EXPECT_EQ(read_file(path("lines")), bytes + bytes);
}

}  // namespace
}  // namespace mimicry
