#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace mimicry::cli {

/// The tables rows.csv and rows.jsonl of a long run, appended job by job. Beside them a journal
/// says how long both were after each job, so that a run that was interrupted anywhere goes on
/// where it was: what is behind the last whole job is cut off, and no row is lost or doubled.
class RowJournal {
 public:
  /// Opens or starts the tables in a folder, which is made where it is missing. Throws
  /// Error(invalid_input) where they belong to a run with other settings, Error(io) where they
  /// cannot be written. `settings` and `heading`: a line each, the heading with its end.
  RowJournal(const std::string& folder, const std::string& settings, const std::string& heading);

  /// Done already, by this or an earlier run.
  std::size_t jobs() const { return jobs_; }
  std::size_t rows() const { return rows_; }
  std::size_t rejected() const { return rejected_; }
  const std::string& csv_path() const { return csv_path_; }

  /// The rows of the next job, in both forms.
  void append(std::string_view csv, std::string_view json_lines, std::size_t rows,
              std::size_t rejected);
  /// Everything is there, and on the disk.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;
  void record();
  File open_at(const std::string& path, std::size_t size);
  void write(const File& file, const std::string& path, std::string_view text);

  std::string csv_path_, json_path_, journal_path_;
  File csv_, json_, journal_;
  std::size_t jobs_ = 0, rows_ = 0, rejected_ = 0, csv_bytes_ = 0, json_bytes_ = 0;
};

}  // namespace mimicry::cli
