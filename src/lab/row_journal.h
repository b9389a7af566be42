#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "files/append_file.h"
#include "files/output_lock.h"

namespace mimicry::lab {

/// The tables rows.csv and rows.jsonl of a long run, appended job by job. Beside them a journal
/// says how many jobs are done and how long both tables are then; a run that ends anywhere, with
/// its machine too, goes on there: what is behind is cut off, and no row is lost or doubled. Rows
/// are on the disk before the journal speaks of them, which it does about twice a second and at the
/// end. Another program that would write to the folder meanwhile is refused.
class RowJournal {
 public:
  /// Opens or starts the tables in a folder, which is made where it is missing. Throws
  /// Error(invalid_input) where they belong to a run with other settings or columns, Error(io)
  /// where they cannot be written or another program writes there. `settings` and `heading`: a line
  /// each, the heading with its end.
  RowJournal(const std::string& folder, const std::string& settings, const std::string& heading);
  /// What was appended is recorded, but where writing has failed: that is cut off.
  ~RowJournal();
  RowJournal(const RowJournal&) = delete;
  RowJournal& operator=(const RowJournal&) = delete;

  /// Done already, by this or an earlier run.
  std::size_t jobs() const { return jobs_; }
  std::size_t rows() const { return rows_; }
  std::size_t rejected() const { return rejected_; }
  const std::string& csv_path() const { return csv_->path(); }

  /// The rows of the next job, in both forms.
  void append(std::string_view csv, std::string_view json_lines, std::size_t rows,
              std::size_t rejected);
  /// Everything that was appended is on the disk, and the journal says so.
  void record();

 private:
  using Clock = std::chrono::steady_clock;

  OutputLock lock_;
  std::unique_ptr<AppendFile> csv_, json_, journal_;
  std::size_t jobs_ = 0, rows_ = 0, rejected_ = 0;
  std::size_t recorded_ = 0;  // jobs
  bool failed_ = false;
  Clock::time_point recorded_at_ = Clock::now();
};

}  // namespace mimicry::lab
