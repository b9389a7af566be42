#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include <mimicry/base/parallel.h>

namespace mimicry {

/// Works on a stream of jobs on several threads: `next()` gives the next job or nothing at the end,
/// `work(job)` its result, `done(result)` takes the results in the order of the jobs. next and done
/// are called by one thread at a time, work by all at once. Whichever thread is free takes the next
/// job, so that reading, working and writing overlap. No more than `most_ahead` (at least 1) jobs
/// are taken beyond the first whose result is not there yet: memory is bounded however many jobs
/// there are. The first exception ends the work and is thrown again here, when all threads have
/// stopped; results before it may be left out.
template <class Next, class Work, class Done>
void work_in_order(int threads, std::size_t most_ahead, Next&& next, Work&& work, Done&& done) {
  using Job = typename decltype(next())::value_type;
  using Result = decltype(work(std::declval<Job>()));
  std::mutex mutex;
  std::condition_variable room;
  std::size_t taken = 0, handed = 0;
  std::map<std::size_t, Result> waiting;  // for the result of an earlier job
  bool ended = false;
  std::exception_ptr error;

  const auto serve = [&] {
    std::unique_lock lock(mutex);
    try {
      while (true) {
        room.wait(lock,
                  [&] { return ended || taken - handed < std::max<std::size_t>(1, most_ahead); });
        if (ended) return;
        std::optional<Job> job = next();
        if (!job) {
          ended = true;
          break;
        }
        const std::size_t number = taken++;
        lock.unlock();
        Result result = work(std::move(*job));
        job.reset();
        lock.lock();
        if (error) return;
        waiting.emplace(number, std::move(result));
        for (auto first = waiting.begin(); first != waiting.end() && first->first == handed;
             first = waiting.erase(first), ++handed)
          done(std::move(first->second));
        room.notify_all();
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      if (!error) error = std::current_exception();
      ended = true;
    }
    room.notify_all();
  };
  parallel_for(static_cast<std::size_t>(std::max(1, threads)), threads,
               [&](std::size_t) { serve(); });
  if (error) std::rethrow_exception(error);
}

}  // namespace mimicry
