#include "lab/row_journal.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kRecordEvery{500};

std::size_t size_of(const std::string& path) {
  std::error_code none;
  const auto size = fs::file_size(to_path(path), none);
  return none ? 0 : static_cast<std::size_t>(size);
}

bool begins_with(const std::string& path, const std::string& heading) {
  const MappedFile file(path, Accept::regular);
  return file.bytes().starts_with(heading);
}

}  // namespace

RowJournal::RowJournal(const std::string& folder, const std::string& settings,
                       const std::string& heading)
    : lock_(OutputLock::of_folder(folder)) {
  const auto in_folder = [&](const char* name) { return join_path(folder, name); };
  const std::string csv_path = in_folder("rows.csv"), json_path = in_folder("rows.jsonl"),
                    journal_path = in_folder("rows.journal");
  std::size_t journal_bytes = 0, csv_bytes = 0, json_bytes = 0;
  if (fs::exists(status_of(journal_path))) {
    const std::string text = read_file(journal_path, Accept::regular);
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
          csv > size_of(csv_path) || json > size_of(json_path))
        break;
      jobs_ = jobs;
      rows_ = rows;
      rejected_ = rejected;
      csv_bytes = csv;
      json_bytes = json;
      from = journal_bytes = to + 1;
    }
    if (csv_bytes > 0 && !begins_with(csv_path, heading))
      throw Error(ErrorKind::invalid_input,
                  folder +
                      ": holds rows with other columns, of another version; give another --out, "
                      "or remove rows.csv, rows.jsonl and rows.journal");
  } else if (fs::exists(status_of(csv_path)) || fs::exists(status_of(json_path))) {
    throw Error(ErrorKind::invalid_input,
                folder + ": holds rows of another program; give another --out");
  }
  recorded_ = jobs_;
  // The journal first: tables without one would be taken for another program's.
  journal_ = std::make_unique<AppendFile>(journal_path, journal_bytes);
  csv_ = std::make_unique<AppendFile>(csv_path, csv_bytes);
  json_ = std::make_unique<AppendFile>(json_path, json_bytes);
  if (journal_bytes > 0) return;
  failed_ = true;
  journal_->append(settings + "\n");
  csv_->append(heading);
  record();
  failed_ = false;
}

RowJournal::~RowJournal() {
  if (failed_ || recorded_ == jobs_) return;
  try {
    record();
  } catch (const Error&) {  // as if the last rows had not been made
  }
}

void RowJournal::append(std::string_view csv, std::string_view json_lines, std::size_t rows,
                        std::size_t rejected) {
  failed_ = true;
  csv_->append(csv);
  json_->append(json_lines);
  failed_ = false;
  ++jobs_;
  rows_ += rows;
  rejected_ += rejected;
  if (Clock::now() - recorded_at_ >= kRecordEvery) record();
}

void RowJournal::record() {
  failed_ = true;
  csv_->sync();
  json_->sync();
  journal_->append(std::to_string(jobs_) + " " + std::to_string(rows_) + " " +
                   std::to_string(rejected_) + " " + std::to_string(csv_->size()) + " " +
                   std::to_string(json_->size()) + "\n");
  journal_->sync();
  failed_ = false;
  recorded_ = jobs_;
  recorded_at_ = Clock::now();
}

}  // namespace mimicry::lab
