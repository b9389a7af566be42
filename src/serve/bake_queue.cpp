#include "serve/bake_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mimicry/base/error.h>

#include "serve/limits.h"
#include "serve/text.h"

namespace mimicry::serve {
namespace {

constexpr const char* kStopped = "the server was stopped";

std::string mesh_name(const Request& request) {
  const auto given = request.query.find("name");
  if (given == request.query.end() || given->second.empty()) return "model";
  // The end says which format it is.
  constexpr std::size_t kMost = 1000;
  const std::string& name = given->second;
  return printable(name.size() <= kMost ? name : "..." + name.substr(name.size() - kMost));
}

}  // namespace

std::optional<Response> BakeQueue::refusal_for(const std::string& client) const {
  const auto is_own = [&](const auto& exchange) { return exchange->request.client == client; };
  const auto own =
      static_cast<std::size_t>(std::count_if(waiting_.begin(), waiting_.end(), is_own)) +
      (current_ && is_own(current_) ? 1 : 0);
  if (own >= limits::kBakesOfClient)
    return busy(
        "one of your models is being baked or waits, and others wait; try again in a while");
  if (waiting_.size() + (current_ ? 1 : 0) >= limits::kBakes)
    return busy("one model is being baked and others wait; try again in a while");
  return std::nullopt;
}

void BakeQueue::add(std::shared_ptr<Exchange> exchange) {
  if (stopped_) return exchange->answer(busy(kStopped));
  if (auto no = refusal_for(exchange->request.client)) return exchange->answer(std::move(*no));
  exchange->on_leave = [this, e = exchange.get()] { leave(e); };
  waiting_.push_back(std::move(exchange));
  start_next();
}

void BakeQueue::leave(const Exchange* exchange) {
  if (current_.get() == exchange && process_) process_->kill("the client left");
  std::erase_if(waiting_, [&](const auto& e) { return e.get() == exchange; });
}

void BakeQueue::start_next() {
  while (!process_ && !waiting_.empty()) {
    current_ = std::move(waiting_.front());
    waiting_.pop_front();
    const auto exchange = current_;
    process_ = std::make_shared<BakeProcess>(
        io_, BakeProcess::Events{[exchange](Response r) { exchange->answer(std::move(r)); },
                                 [this](const std::string& sentence) { options_.note(sentence); },
                                 [this] {
                                   process_.reset();
                                   current_.reset();
                                   start_next();
                                 }});
    std::vector<std::string> command = options_.bake_command;
    command.push_back("--name=" + mesh_name(exchange->request));
    command.push_back("--keep=" + options_.data_folder + "/bakes");
    command.push_back("--keep-bytes=" + std::to_string(limits::kKeptBytes));
    command.push_back("--result-bytes=" + std::to_string(limits::kResultBytes));
    command.push_back("--threads=" + std::to_string(options_.threads));
    command.push_back("--memory=" + std::to_string(options_.bake_memory));
    command.push_back("--faces=" + std::to_string(options_.most_faces));
    command.push_back("--cpu-s=" + std::to_string(static_cast<long long>(std::ceil(
                                                      options_.longest_bake_s * options_.threads)) +
                                                  1));
    try {
      process_->start(command, std::exchange(exchange->request.body, {}), options_.longest_bake_s,
                      held_);
    } catch (const Error& error) {
      process_.reset();
      current_.reset();
      exchange->answer(busy(error.what()));
    }
  }
}

void BakeQueue::stop() {
  stopped_ = true;
  for (const auto& exchange : std::exchange(waiting_, {})) exchange->answer(busy(kStopped));
  if (process_) process_->kill(kStopped);
}

std::string BakeQueue::stage() const {
  return process_ ? process_->stage() : "";
}

double BakeQueue::fraction() const {
  return process_ ? process_->fraction() : 0.0;
}

}  // namespace mimicry::serve
