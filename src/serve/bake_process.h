#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "serve/message.h"

namespace mimicry::serve {

/// One bake in a process of its own, which holds its limits of memory and time from the first byte
/// that it reads. It is told what to do by its arguments, reads the mesh from descriptor 0, writes
/// the result to descriptor 3 and tells its progress in lines of JSON on descriptor 1:
///
///     {"stage": "mds", "fraction": 0.4}
///     {"note": "a sentence for the server's log"}
///     {"error": "a sentence for the client", "status": 422}
///     {"done": true}
///
/// It may go on after `done`, to keep the result for the next time.
class BakeProcess : public std::enable_shared_from_this<BakeProcess> {
 public:
  struct Events {
    std::function<void(Response)> answer;  ///< once
    std::function<void(const std::string& sentence)> note;
    std::function<void()> ended;  ///< once, last; the next may start
  };

  BakeProcess(boost::asio::io_context& io, Events events);
  ~BakeProcess();

  /// Throws Error(io) where no process can be started.
  void start(const std::vector<std::string>& command, MemoryFile mesh, double longest_s,
             const HeldBytes& held);
  /// Ends it at once. `sentence` is the answer with 503 where it has given none.
  void kill(const std::string& sentence);

  const std::string& stage() const { return stage_; }
  double fraction() const { return fraction_; }

 private:
  void read();
  void take(std::string_view block);
  void take_line(const std::string& line);
  void give(Response response);
  void finish();

  Events events_;
  boost::asio::posix::stream_descriptor messages_;
  boost::asio::steady_timer limit_;
  MemoryFile result_;
  int process_ = 0;
  bool answered_ = false;
  std::string killed_because_, text_, block_, stage_;
  double fraction_ = 0.0;
};

}  // namespace mimicry::serve
