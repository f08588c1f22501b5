// What the benchmarks have in common as programs.
#pragma once

#include <functional>
#include <string_view>

#include "bench/lone_run.h"

namespace ramify::bench {

/// Takes a flag out of the arguments; whether it was there.
bool take_flag(int& argc, char** argv, std::string_view flag);

/// main(): performs a trial if run_alone() started this process, else runs the benchmark. Returns the exit
/// code; an exception is printed and makes it 1.
int run_program(int argc, char** argv, const std::function<int(int argc, char** argv)>& run,
                const Performer& perform);

}  // namespace ramify::bench
