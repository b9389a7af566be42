#include "io/stroke_splitter.h"

#include <array>
#include <utility>

namespace mimicry {
namespace {

constexpr std::size_t kBlockBytes = 1 << 16;
constexpr int kEnd = -1;

// What opens, closes or quotes: nearly no byte of a stroke.
constexpr std::array<bool, 256> make_marks() {
  std::array<bool, 256> marks{};
  for (const char c : std::string_view("\"{}[]")) marks[static_cast<unsigned char>(c)] = true;
  return marks;
}
constexpr std::array<bool, 256> kIsMark = make_marks();

bool is_space(int c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

StrokeSplitter::StrokeSplitter(Source source) : source_(std::move(source)) {}

bool StrokeSplitter::fill() {
  if (at_ < block_.size()) return true;
  used_ += block_.size();
  block_.resize(kBlockBytes);
  block_.resize(source_(block_.data(), block_.size()));
  at_ = 0;
  return !block_.empty();
}

int StrokeSplitter::get() {
  return fill() ? static_cast<unsigned char>(block_[at_++]) : kEnd;
}

std::optional<std::string> StrokeSplitter::next() {
  if (done_) return std::nullopt;
  bool in_string = false, escaped = false;
  int depth = 0;
  if (!in_array_) {
    std::string word;
    bool is_array_next = false;  // the key "strokes" of the outermost object has just been read
    for (int c = get(); c != kEnd; c = get()) {
      head_ += static_cast<char>(c);
      if (in_string) {
        if (!escaped && c == '"')
          in_string = false;
        else
          word += static_cast<char>(c);
        escaped = !escaped && c == '\\';
        continue;
      }
      if (c == '"') {
        in_string = true;
        word.clear();
      } else if (c == ':') {
        is_array_next = depth == 1 && word == "strokes";
      } else if (c == '[' && is_array_next) {
        in_array_ = true;
        break;
      } else if (!is_space(c)) {
        is_array_next = false;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
      }
    }
    if (!in_array_) {
      done_ = true;
      return head_;
    }
  }
  std::string part = head_;
  begin_ = used();
  depth = 0;
  bool is_empty = true;
  while (fill()) {
    const char* const begin = block_.data() + at_;
    const char* const end = block_.data() + block_.size();
    for (const char* p = begin; p != end; ++p) {
      const char c = *p;
      if (in_string) {
        if (!escaped && c == '"') in_string = false;
        escaped = !escaped && c == '\\';
        continue;
      }
      if (depth > 0 && !kIsMark[static_cast<unsigned char>(c)]) continue;
      if (depth == 0 && (c == ',' || c == ']')) {
        part.append(begin, p);
        at_ += static_cast<std::size_t>(p + 1 - begin);
        done_ = closed_ = c == ']';
        if (!done_ || !is_empty) return part + "]}";
        return std::nullopt;
      }
      is_empty = is_empty && is_space(c);
      if (c == '"') {
        in_string = true;
      } else if (c == '{' || c == '[') {
        ++depth;
      } else if (c == '}' || c == ']') {
        --depth;
      }
    }
    part.append(begin, end);
    at_ = block_.size();
  }
  done_ = true;  // cut off
  return part;
}

}  // namespace mimicry
