#include "serve/kept_certificate.h"

#include <filesystem>
#include <system_error>

#include <sys/stat.h>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry::serve {
namespace {

namespace fs = std::filesystem;

// What is created meanwhile is for its owner alone.
class PrivateFiles {
 public:
  PrivateFiles() : before_(::umask(077)) {}
  ~PrivateFiles() { ::umask(before_); }
  PrivateFiles(const PrivateFiles&) = delete;
  PrivateFiles& operator=(const PrivateFiles&) = delete;

 private:
  mode_t before_;
};

}  // namespace

Certificate kept_certificate(const std::string& data_folder,
                             const std::vector<std::string>& addresses) {
  const PrivateFiles private_files;
  std::error_code trouble;
  fs::create_directories(data_folder, trouble);
  if (trouble)
    throw Error(ErrorKind::io, data_folder + ": the folder cannot be made: " + trouble.message() +
                                   "; name another with --data");
  const fs::path kept = to_path(data_folder) / "certificate.pem";
  // A headset that has accepted it is not asked again.
  if (fs::exists(kept, trouble)) {
    try {
      Certificate known = read_certificate(read_file(to_text(kept)), to_text(kept));
      if (serves(known, addresses)) {
        fs::permissions(kept, fs::perms::owner_read | fs::perms::owner_write, trouble);
        return known;
      }
    } catch (const Error&) {  // it is made again
    }
  }
  Certificate made = make_certificate(addresses);
  write_file_atomically(to_text(kept), write_certificate(made));
  return made;
}

}  // namespace mimicry::serve
