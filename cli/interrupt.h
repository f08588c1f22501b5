// Ctrl-C as a stop token.
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace ramify::cli {

/// While alive, SIGINT and SIGTERM request a stop; a second one ends the program at once.
/// Must be made before any other thread, so that all threads leave the signals to its own.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::thread watcher_;
};

}  // namespace ramify::cli
