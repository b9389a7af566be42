#include <filesystem>
#include <utility>

#include <windows.h>

#include "files/file.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "files/system.h"
#include "files/windows.h"

namespace mimicry {

// A file that nobody else can open, and that the system removes when this program closes it or
// ends.
struct OutputLock::Held {
  HANDLE file = INVALID_HANDLE_VALUE;
  std::wstring made;  // a folder; empty: none

  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
    if (!made.empty()) RemoveDirectoryW(made.c_str());  // if nothing came there
  }

  void take(const std::filesystem::path& lock, const std::string& output) {
    file = CreateFileW(system_path(to_text(lock)).c_str(), GENERIC_WRITE, 0, nullptr, OPEN_ALWAYS,
                       FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (file != INVALID_HANDLE_VALUE) return;
    const DWORD error = GetLastError();
    if (error == ERROR_SHARING_VIOLATION) fail_locked(output);
    set_errno(error);
    fail(output, "cannot be written", errno);
  }
};

namespace {

std::filesystem::path lock_of(const std::filesystem::path& path) {
  return path.parent_path() / (L"." + path.filename().native() + L".lock");
}

}  // namespace

OutputLock::OutputLock(std::unique_ptr<Held> held) : held_(std::move(held)) {}
OutputLock::OutputLock(OutputLock&&) noexcept = default;
OutputLock::~OutputLock() = default;

OutputLock OutputLock::of_folder(const std::string& folder) {
  const bool was_there = kind_of(folder) != Kind::none;
  make_folder(folder);
  std::error_code none;
  std::filesystem::path path = std::filesystem::absolute(to_path(folder), none).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  auto held = std::make_unique<Held>();
  held->take(lock_of(path), folder);
  if (!was_there) held->made = system_path(folder);
  return OutputLock(std::move(held));
}

OutputLock OutputLock::of_file(const std::string& file) {
  const Kind kind = kind_of(file);
  if (kind != Kind::none && kind != Kind::file) return OutputLock(nullptr);
  auto held = std::make_unique<Held>();
  held->take(lock_of(to_path(file)), file);
  return OutputLock(std::move(held));
}

}  // namespace mimicry
