#include "files/unfinished.h"

#include <array>
#include <atomic>
#include <cstring>

#include "files/file.h"
#include "files/system.h"

namespace mimicry {
namespace {

enum State : int { kFree, kNaming, kMaking, kMade };

struct Slot {
  std::atomic<int> state{kFree};
  std::array<char, 4096> path{};
};
std::array<Slot, 64> slots;
std::atomic<bool> ending{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

}  // namespace

Unfinished::Unfinished(const std::string& path) {
  if (path.size() >= slots[0].path.size()) return;
  for (std::size_t s = 0; s < slots.size() && slot_ < 0; ++s) {
    int free = kFree;
    if (slots[s].state.compare_exchange_strong(free, kNaming)) slot_ = static_cast<int>(s);
  }
  if (slot_ < 0) return;
  Slot& slot = slots[static_cast<std::size_t>(slot_)];
  std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
  slot.state = kMaking;
  // Either this sees that the program ends, or the one who ends it sees the name.
  if (ending) wait_for_end();
}

void Unfinished::made() noexcept {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = kMade;
}

Unfinished::~Unfinished() {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = kFree;
}

void remove_unfinished() noexcept {
  ending = true;
  // Files that are just being made; the thread that makes one may be the one that we interrupt.
  for (int wait = 0; wait < 50; ++wait) {
    bool making = false;
    for (const Slot& slot : slots) making = making || slot.state == kMaking;
    if (!making) break;
    sleep_ms(1);
  }
  // Files first: a folder goes when nothing is in it.
  for (const auto remove : {remove_file, remove_folder})
    for (const Slot& slot : slots)
      if (slot.state == kMaking || slot.state == kMade) remove(slot.path.data());
}

}  // namespace mimicry
