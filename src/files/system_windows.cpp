#include <algorithm>
#include <array>
#include <cwchar>
#include <new>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include "files/environment.h"
#include "files/names.h"
#include "files/system.h"
#include "files/windows.h"

namespace mimicry {
namespace {

constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// A handle, closed at the end.
struct Handle {
  explicit Handle(HANDLE handle) : value(handle) {}
  ~Handle() {
    if (*this) CloseHandle(value);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  explicit operator bool() const { return value != nullptr && value != INVALID_HANDLE_VALUE; }
  HANDLE value;
};

HANDLE handle_of(int file) {
  return reinterpret_cast<HANDLE>(_get_osfhandle(file));
}

// Others may read, replace and remove a file while it is open here, as on POSIX.
int open_file(const std::string& path, DWORD access, DWORD how, int flags) {
  const HANDLE handle = CreateFileW(system_path(path).c_str(), access, kShareAll, nullptr, how,
                                    FILE_ATTRIBUTE_NORMAL, nullptr);
  if (handle == INVALID_HANDLE_VALUE) {
    const DWORD error = GetLastError();
    const DWORD attributes = GetFileAttributesW(system_path(path).c_str());
    const bool is_folder = attributes != INVALID_FILE_ATTRIBUTES &&
                           (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0 && how != CREATE_NEW;
    set_errno(error);
    if (is_folder) errno = EISDIR;
    return -1;
  }
  const int file =
      _open_osfhandle(reinterpret_cast<std::intptr_t>(handle), flags | _O_BINARY | _O_NOINHERIT);
  if (file < 0) CloseHandle(handle);
  return file;
}

Kind kind_of_handle(HANDLE handle) {
  const DWORD type = GetFileType(handle);
  if (type == FILE_TYPE_PIPE) return Kind::pipe;
  if (type != FILE_TYPE_DISK) return Kind::device;
  BY_HANDLE_FILE_INFORMATION found = {};
  const bool is_folder = GetFileInformationByHandle(handle, &found) != 0 &&
                         (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return is_folder ? Kind::folder : Kind::file;
}

// Over a file that others have open or mapped, too. Windows 10 and later, and not all file systems.
bool replace_open(const std::wstring& from, const std::wstring& to) {
  const Handle file(CreateFileW(from.c_str(), DELETE | SYNCHRONIZE, kShareAll, nullptr,
                                OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!file) return false;
  const std::size_t bytes = to.size() * sizeof(wchar_t);
  const std::size_t size = sizeof(FILE_RENAME_INFO) + bytes;
  std::string memory(size, '\0');
  auto* const info = new (memory.data()) FILE_RENAME_INFO{};
  constexpr DWORD kReplaceIfExists = 1, kPosixSemantics = 2;
  constexpr auto kRenameInfoEx = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);
  // The flags stand where the older form has its one truth value.
  const DWORD flags = kReplaceIfExists | kPosixSemantics;
  std::copy_n(reinterpret_cast<const char*>(&flags), sizeof flags, memory.data());
  info->FileNameLength = static_cast<DWORD>(bytes);
  std::copy_n(reinterpret_cast<const char*>(to.data()), bytes,
              reinterpret_cast<char*>(info->FileName));
  return SetFileInformationByHandle(file.value, kRenameInfoEx, info, static_cast<DWORD>(size)) != 0;
}

// The same where there is no such rename: the name is free for a moment.
bool replace_aside(const std::wstring& from, const std::wstring& to) {
  const std::wstring aside = from + L".old";
  if (MoveFileExW(to.c_str(), aside.c_str(), MOVEFILE_REPLACE_EXISTING) == 0) return false;
  if (MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_WRITE_THROUGH) == 0) {
    MoveFileExW(aside.c_str(), to.c_str(), MOVEFILE_WRITE_THROUGH);
    return false;
  }
  DeleteFileW(aside.c_str());  // gone when its readers close it
  return true;
}

}  // namespace

std::wstring to_wide(std::string_view text) {
  if (text.empty()) return {};
  const int size = static_cast<int>(text.size());
  std::wstring wide(
      static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), size, nullptr, 0)),
      L'\0');
  MultiByteToWideChar(CP_UTF8, 0, text.data(), size, wide.data(), static_cast<int>(wide.size()));
  return wide;
}

std::string to_utf8(std::wstring_view text) {
  if (text.empty()) return {};
  const int size = static_cast<int>(text.size());
  std::string narrow(static_cast<std::size_t>(WideCharToMultiByte(CP_UTF8, 0, text.data(), size,
                                                                  nullptr, 0, nullptr, nullptr)),
                     '\0');
  WideCharToMultiByte(CP_UTF8, 0, text.data(), size, narrow.data(), static_cast<int>(narrow.size()),
                      nullptr, nullptr);
  return narrow;
}

std::wstring system_path(const std::string& path) {
  std::wstring wide = to_wide(path);
  constexpr std::size_t kLongest = 240;  // what folders take of their 260
  if (wide.size() < kLongest || wide.starts_with(LR"(\\)")) return wide;
  std::wstring full(32768, L'\0');
  full.resize(
      GetFullPathNameW(wide.c_str(), static_cast<DWORD>(full.size()), full.data(), nullptr));
  return full.empty() || full.starts_with(LR"(\\)") ? wide : LR"(\\?\)" + full;
}

void set_errno(unsigned long error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_INVALID_DRIVE:
    case ERROR_BAD_NETPATH:
      errno = ENOENT;
      return;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      errno = EEXIST;
      return;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
    case ERROR_USER_MAPPED_FILE:
      errno = EACCES;
      return;
    case ERROR_WRITE_PROTECT:
      errno = EROFS;
      return;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      errno = ENOSPC;
      return;
    case ERROR_TOO_MANY_OPEN_FILES:
      errno = EMFILE;
      return;
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_OUTOFMEMORY:
      errno = ENOMEM;
      return;
    case ERROR_FILENAME_EXCED_RANGE:
      errno = ENAMETOOLONG;
      return;
    case ERROR_DIRECTORY:
      errno = ENOTDIR;
      return;
    case ERROR_NO_DATA:
    case ERROR_BROKEN_PIPE:
      errno = EPIPE;
      return;
    case ERROR_PIPE_BUSY:
      errno = ENXIO;
      return;
    default:
      errno = EIO;
  }
}

void close_file(int file) noexcept {
  _close(file);
}

bool Descriptor::close() {
  return _close(std::exchange(file_, -1)) == 0;
}

int open_to_read(const std::string& path, Wait) {
  return open_file(path, GENERIC_READ, OPEN_EXISTING, _O_RDONLY);
}

int open_new(const std::string& path) {
  return open_file(path, GENERIC_WRITE, CREATE_NEW, _O_WRONLY);
}

int open_to_append(const std::string& path) {
  return open_file(path, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS, _O_RDWR | _O_APPEND);
}

int open_device(const std::string& path) {
  return open_file(path, GENERIC_WRITE, OPEN_EXISTING, _O_WRONLY);
}

bool status_of(int file, FileStatus& status) {
  const HANDLE handle = handle_of(file);
  status = {kind_of_handle(handle), 0};
  if (status.kind != Kind::file) return true;
  LARGE_INTEGER size = {};
  if (GetFileSizeEx(handle, &size) == 0) {
    set_errno(GetLastError());
    return false;
  }
  status.size = static_cast<std::uint64_t>(size.QuadPart);
  return true;
}

Kind kind_of(const std::string& path) {
  // With this flag folders open, too.
  const Handle handle(CreateFileW(system_path(path).c_str(), 0, kShareAll, nullptr, OPEN_EXISTING,
                                  FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  return handle ? kind_of_handle(handle.value) : Kind::none;
}

std::ptrdiff_t read_some(int file, char* bytes, std::size_t count) {
  return _read(file, bytes, static_cast<unsigned>(std::min<std::size_t>(count, 1U << 30)));
}

bool write_all(int file, std::string_view bytes) {
  constexpr std::size_t kAtOnce = 1U << 26;
  while (!bytes.empty()) {
    const int written =
        _write(file, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), kAtOnce)));
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool cut(int file, std::size_t size) {
  const int error = _chsize_s(file, static_cast<long long>(size));
  if (error != 0) errno = error;
  return error == 0;
}

bool sync(int file) {
  return _commit(file) == 0;
}

bool sync_folder_of(const std::string&) {
  return true;  // `replace` writes through
}

bool replace(const std::string& from, const std::string& to) {
  const std::wstring wide_from = system_path(from), wide_to = system_path(to);
  for (int trial = 0;; ++trial) {
    if (MoveFileExW(wide_from.c_str(), wide_to.c_str(),
                    MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0)
      return true;
    const DWORD error = GetLastError();
    const bool is_held = error == ERROR_ACCESS_DENIED || error == ERROR_SHARING_VIOLATION;
    if (is_held && (replace_open(wide_from, wide_to) || replace_aside(wide_from, wide_to)))
      return true;
    // A scanner or an index has the file for itself, for a moment.
    if (!is_held || trial == 20) {
      set_errno(error);
      return false;
    }
    sleep_ms(10);
  }
}

// Without memory of its own: the program may have none left.
void remove_file(const char* path) noexcept {
  std::array<wchar_t, 4096> wide;
  if (MultiByteToWideChar(CP_UTF8, 0, path, -1, wide.data(), static_cast<int>(wide.size())) > 0)
    DeleteFileW(wide.data());
}

void remove_folder(const char* path) noexcept {
  std::array<wchar_t, 4096> wide;
  if (MultiByteToWideChar(CP_UTF8, 0, path, -1, wide.data(), static_cast<int>(wide.size())) > 0)
    RemoveDirectoryW(wide.data());
}

const char* map_file(int file, std::size_t) {
  const Handle mapping(CreateFileMappingW(handle_of(file), nullptr, PAGE_READONLY, 0, 0, nullptr));
  if (!mapping) return nullptr;
  return static_cast<const char*>(MapViewOfFile(mapping.value, FILE_MAP_READ, 0, 0, 0));
}

void unmap_file(const char* bytes, std::size_t) noexcept {
  UnmapViewOfFile(bytes);
}

unsigned long process_number() {
  return GetCurrentProcessId();
}

void sleep_ms(int milliseconds) noexcept {
  Sleep(static_cast<DWORD>(milliseconds));
}

void wait_for_end() noexcept {
  for (;;) Sleep(INFINITE);
}

std::filesystem::path to_path(const std::string& text) {
  return to_wide(text);
}

std::string to_text(const std::filesystem::path& path) {
  return to_utf8(path.native());
}

std::FILE* open_stream(const std::string& path) {
  return _wfopen(system_path(path).c_str(), L"rb");
}

std::optional<std::string> environment(const char* name) {
  const wchar_t* const value = _wgetenv(to_wide(name).c_str());
  return value ? std::optional(to_utf8(value)) : std::nullopt;
}

std::string cache_folder() {
  return environment("LOCALAPPDATA").value_or("");
}

}  // namespace mimicry
