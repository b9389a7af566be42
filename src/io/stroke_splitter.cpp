#include <utility>

#include <mimicry/io/stroke_splitter.h>

namespace mimicry::io {
namespace {

constexpr std::size_t kBlockBytes = 1 << 16;
constexpr int kEnd = -1;

bool is_space(int c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

StrokeSplitter::StrokeSplitter(Source source) : source_(std::move(source)) {}

int StrokeSplitter::get() {
  if (at_ == block_.size()) {
    block_.resize(kBlockBytes);
    block_.resize(source_(block_.data(), block_.size()));
    at_ = 0;
    if (block_.empty()) return kEnd;
  }
  return static_cast<unsigned char>(block_[at_++]);
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
  depth = 0;
  bool is_empty = true;
  for (int c = get();; c = get()) {
    if (c == kEnd) {  // cut off
      done_ = true;
      return part;
    }
    if (!in_string && depth == 0 && (c == ',' || c == ']')) {
      done_ = c == ']';
      if (!done_ || !is_empty) return part + "]}";
      return std::nullopt;
    }
    part += static_cast<char>(c);
    is_empty = is_empty && is_space(c);
    if (in_string) {
      if (!escaped && c == '"') in_string = false;
      escaped = !escaped && c == '\\';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

}  // namespace mimicry::io
