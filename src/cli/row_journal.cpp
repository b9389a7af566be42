#include "cli/row_journal.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

namespace mimicry::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const char* what, int error) {
  throw Error(ErrorKind::io, path + ": " + what + ": " + std::generic_category().message(error));
}

std::size_t size_of(const std::string& path) {
  std::error_code none;
  const auto size = fs::file_size(path, none);
  return none ? 0 : static_cast<std::size_t>(size);
}

}  // namespace

RowJournal::RowJournal(const std::string& folder, const std::string& settings,
                       const std::string& heading)
    : csv_path_((fs::path(folder) / "rows.csv").string()),
      json_path_((fs::path(folder) / "rows.jsonl").string()),
      journal_path_((fs::path(folder) / "rows.journal").string()) {
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  if (trouble)
    throw Error(ErrorKind::io, folder + ": the folder cannot be made: " + trouble.message());
  std::size_t journal_bytes = 0;
  if (fs::exists(journal_path_)) {
    const std::string text = files::read_file(journal_path_);
    const std::size_t end = text.find('\n');
    if (end != std::string::npos && text.substr(0, end) != settings)
      throw Error(ErrorKind::invalid_input,
                  folder +
                      ": holds the rows of a run with other strokes, techniques or options; "
                      "give another --out, or remove rows.csv, rows.jsonl and rows.journal");
    // Lines of which the end was not written do not count, nor do those whose rows were not.
    for (std::size_t from = end + 1; end != std::string::npos;) {
      const std::size_t to = text.find('\n', from);
      std::size_t jobs = 0, rows = 0, rejected = 0, csv = 0, json = 0;
      if (to == std::string::npos ||
          std::sscanf(text.c_str() + from, "%zu %zu %zu %zu %zu", &jobs, &rows, &rejected, &csv,
                      &json) != 5 ||
          csv > size_of(csv_path_) || json > size_of(json_path_))
        break;
      jobs_ = jobs;
      rows_ = rows;
      rejected_ = rejected;
      csv_bytes_ = csv;
      json_bytes_ = json;
      from = journal_bytes = to + 1;
    }
  } else if (fs::exists(csv_path_) || fs::exists(json_path_)) {
    throw Error(ErrorKind::invalid_input,
                folder + ": holds rows of another program; give another --out");
  }
  journal_ = open_at(journal_path_, journal_bytes);
  csv_ = open_at(csv_path_, csv_bytes_);
  json_ = open_at(json_path_, json_bytes_);
  if (journal_bytes == 0) {
    write(journal_, journal_path_, settings + "\n");
    write(csv_, csv_path_, heading);
    csv_bytes_ = heading.size();
    record();
  }
}

RowJournal::File RowJournal::open_at(const std::string& path, std::size_t size) {
  File file(std::fopen(path.c_str(), "ab"));
  if (!file) fail(path, "cannot be written", errno);
  if (ftruncate(fileno(file.get()), static_cast<off_t>(size)) != 0)
    fail(path, "cannot be cut", errno);
  return file;
}

void RowJournal::write(const File& file, const std::string& path, std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0)
    fail(path, "cannot be written", errno);
}

void RowJournal::append(std::string_view csv, std::string_view json_lines, std::size_t rows,
                        std::size_t rejected) {
  write(csv_, csv_path_, csv);
  write(json_, json_path_, json_lines);
  ++jobs_;
  rows_ += rows;
  rejected_ += rejected;
  csv_bytes_ += csv.size();
  json_bytes_ += json_lines.size();
  record();
}

void RowJournal::record() {
  write(journal_, journal_path_,
        std::to_string(jobs_) + " " + std::to_string(rows_) + " " + std::to_string(rejected_) +
            " " + std::to_string(csv_bytes_) + " " + std::to_string(json_bytes_) + "\n");
}

void RowJournal::finish() {
  for (const File* file : {&csv_, &json_, &journal_})
    if (fsync(fileno(file->get())) != 0) fail(csv_path_, "cannot be written", errno);
}

}  // namespace mimicry::cli
