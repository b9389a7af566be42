#pragma once

namespace mimicry::cli {

/// From here on Ctrl-C, a request to end and the end of the terminal (SIGINT, SIGTERM, SIGHUP) end
/// the program within about a second: long work asks `end_if_requested` and stops orderly; what
/// does not ask, or takes too long, is ended where it is, and unfinished files are removed. A
/// second signal ends it at once. A pipe that nobody reads any more, or a file that would grow over
/// a limit, is an error of the write and not the end of the program.
void catch_signals();

/// Whether the program was asked to end.
bool end_requested();
/// Throws Error(cancelled) where it was.
void end_if_requested();

/// Ends the program where it is, as a second signal does.
[[noreturn]] void end_now();

/// A program that we wait for: it is ended with us. 0: none. Not on Windows.
void set_child(long process_number);

}  // namespace mimicry::cli
