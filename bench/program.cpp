#include "bench/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>

namespace ramify::bench {

bool take_flag(int& argc, char** argv, std::string_view flag) {
  char** const end = std::remove(argv + 1, argv + argc, flag);
  const bool is_there = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return is_there;
}

int run_program(int argc, char** argv, const std::function<int(int argc, char** argv)>& run,
                const Performer& perform) {
  try {
    const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
    const bool is_lone_run = argc > 1 && std::string_view(argv[1]) == kLoneRunFlag;
    return is_lone_run ? answer_trial(arguments.subspan(2), perform) : run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}

}  // namespace ramify::bench
