#pragma once

#include <condition_variable>
#include <mutex>

namespace mimicry::serve {

/// One bake runs and one waits. A place is taken before a request's body is read.
class BakeQueue {
 public:
  class Place {
   public:
    explicit Place(BakeQueue& queue) : queue_(queue), taken_(queue.enter()) {}
    ~Place() {
      if (taken_) queue_.leave(running_);
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    explicit operator bool() const { return taken_; }
    /// Returns when it is this one's turn.
    void wait() {
      queue_.wait();
      running_ = true;
    }

   private:
    BakeQueue& queue_;
    bool taken_;
    bool running_ = false;
  };

 private:
  static constexpr int kMost = 2;

  bool enter() {
    const std::lock_guard lock(mutex_);
    if (inside_ == kMost) return false;
    ++inside_;
    return true;
  }
  void wait() {
    std::unique_lock lock(mutex_);
    turn_.wait(lock, [&] { return !busy_; });
    busy_ = true;
  }
  void leave(bool running) {
    const std::lock_guard lock(mutex_);
    --inside_;
    if (running) busy_ = false;
    turn_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable turn_;
  int inside_ = 0;
  bool busy_ = false;
};

}  // namespace mimicry::serve
