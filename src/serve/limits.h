#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

// What one client, and all together, may take of the server. docs/serve.md says the same in words.
namespace mimicry::serve::limits {

using namespace std::chrono_literals;

// A request's head.
inline constexpr std::uint32_t kHeadBytes = 16 * 1024;  ///< more: 431
inline constexpr std::size_t kHeaders = 100;            ///< more: 431
inline constexpr std::size_t kTargetBytes = 4096;       ///< more: 414
/// From the end of the last answer (or the start) until the head of the next request is whole.
inline constexpr auto kHeadTime = 30s;
inline constexpr auto kHandshakeTime = 10s;

// Bodies and answers: both must go on at this pace after the first seconds.
inline constexpr auto kGrace = 10s;
inline constexpr std::uint64_t kLeastBytesPerSecond = 64 * 1024;
/// How long what a refused client still sends is read, so that it sees the refusal.
inline constexpr auto kDrainTime = 2s;

// Connections. Where there are more, the one that has waited longest with no whole request ends.
inline constexpr std::size_t kConnections = 4096;
inline constexpr std::size_t kConnectionsOfClient = 2048;
/// Files that the process may open beside connections.
inline constexpr std::size_t kOtherFiles = 64;

// Uploads under way. Where there are more, the slowest ends if it is slower than this.
inline constexpr std::size_t kUploads = 64;
inline constexpr std::size_t kUploadsOfClient = 16;
inline constexpr double kFastBytesPerSecond = 256.0 * 1024;
/// All bodies and results that are in memory at one time; more: 503.
inline constexpr std::uint64_t kHeldBytes = std::uint64_t{2} << 30;

// Bakes: one runs.
inline constexpr std::size_t kBakes = 8;          ///< with those that wait; more: 503
inline constexpr std::size_t kBakesOfClient = 4;  ///< with those that wait; more: 503
inline constexpr std::size_t kResultBytes = std::size_t{1} << 30;
inline constexpr std::uint64_t kKeptBytes = 2'000'000'000;  ///< all kept bakes

// The studio's folder.
inline constexpr std::size_t kStudioFiles = 10'000;
inline constexpr std::uint64_t kStudioBytes = std::uint64_t{512} << 20;

/// Answers under way have this long when the server is stopped.
inline constexpr auto kFarewell = 500ms;

}  // namespace mimicry::serve::limits
