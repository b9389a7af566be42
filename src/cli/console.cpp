#include "cli/console.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <mutex>
#include <optional>

#include <mimicry/assets/canvas.h>

#include "cli/interrupt.h"
#include "cli/system.h"

namespace mimicry::cli {

namespace {

// Columns of numbers (and of '-' for none) stand to the right.
bool is_number(const std::string& cell) {
  return !cell.empty() &&
         (std::isdigit(static_cast<unsigned char>(cell.back())) != 0 || cell == "-");
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string printable(std::string_view text) {
  // JSON's writer knows what UTF-8 is.
  std::string valid = nlohmann::json::parse(json_text(std::string(text))).get<std::string>();
  std::string shown;
  for (const char c : valid) {
    const auto byte = static_cast<unsigned char>(c);
    const bool steers = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    if (steers)
      shown += "\xEF\xBF\xBD";
    else
      shown += c;
  }
  return shown;
}

void complain(std::string_view sentence) {
  std::fprintf(stderr, "mimicry: %s\n", printable(sentence).c_str());
}

void print_table(const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  std::vector<bool> right(headings.size(), true);
  for (const std::string& h : headings) widths.push_back(h.size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], row[c].size());
      right[c] = right[c] && c > 0 && is_number(row[c]);
    }
  const auto print_row = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(widths[c] - row[c].size(), ' ');
      line += (c == 0 ? "" : "  ") + (right[c] ? pad + row[c] : row[c] + pad);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::printf("%s\n", line.c_str());
  };
  print_row(headings);
  for (const auto& row : rows) print_row(row);
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), terminal_(is_terminal(stderr)) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && last_percent_ >= 0) std::fprintf(stderr, "\r\033[K");
}

void ProgressLine::update(std::size_t done, std::size_t total) {
  end_if_requested();
  const int percent = total == 0 ? 100 : static_cast<int>(100 * done / total);
  if (!terminal_ || percent == last_percent_) return;
  last_percent_ = percent;
  std::fprintf(stderr, "\r%s %d %%", what_.c_str(), percent);
  std::fflush(stderr);
}

Monitor terminal_monitor() {
  struct Line {
    std::mutex mutex;
    std::string work;
    std::optional<ProgressLine> shown;
  };
  const auto line = std::make_shared<Line>();
  Monitor monitor;
  monitor.note = [](const std::string& sentence) { complain(sentence); };
  monitor.cancelled = end_requested;
  monitor.progress = [line](std::string_view work, double fraction) {
    const std::lock_guard guard(line->mutex);
    if (!line->shown || line->work != work) {
      line->work = work;
      line->shown.reset();  // clears the line of the work before
      line->shown.emplace(line->work);
    }
    line->shown->update(static_cast<std::size_t>(100 * fraction), 100);
  };
  return monitor;
}

}  // namespace mimicry::cli
