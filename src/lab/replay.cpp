#include "lab/replay.h"

#include <mimicry/assets/canvas.h>

#include "assets/work.h"
#include "base/ordered_work.h"
#include "lab/replay_settings.h"
#include "lab/replay_source.h"
#include "lab/replayer.h"
#include "lab/row_journal.h"

namespace mimicry::lab {

ReplayResult replay_strokes(const ReplayOptions& options, const Monitor& monitor) {
  const Replayer replayer(options, monitor);
  ReplaySource source(options.strokes);
  const ReplaySettings settings = settings_of(options);
  RowJournal journal(options.out, settings_line(settings), rows_heading());
  write_settings(options.out, settings);

  // Jobs that were finished before the interruption.
  for (std::size_t job = 0; job < journal.jobs(); ++job)
    if (!source.next()) break;
  if (journal.jobs() > 0)
    monitor.tell(options.out + ": " + std::to_string(journal.rows()) +
                 " rows are there already; the rest follows");

  const int threads = thread_count(options.threads);
  // Results are small; a slow stroke must not make the others wait.
  const std::size_t most_ahead = 64 * static_cast<std::size_t>(threads);
  work_in_order(
      threads, most_ahead, [&] { return source.next(); },
      [&](const ReplayJob& next) { return replayer.run(next); },
      [&](const ReplayRows& rows) {
        monitor.check();
        for (const std::string& reason : rows.reasons) monitor.tell("rejected: " + reason);
        journal.append(rows.csv, rows.json_lines, rows.rows, rows.rejected);
        monitor.report("replaying", source.bytes_read(), source.bytes());
      });
  journal.record();
  return {journal.csv_path(), journal.rows(), journal.rejected()};
}

}  // namespace mimicry::lab
