// The program run as a person or a script runs it.
#pragma once

#include <string>

namespace ramify::test {

struct Outcome {
  int code = -1;    // exit code; 128 + signal if it was killed
  std::string out;  // stdout
  std::string err;  // stderr
};

/// Runs `ramify ARGUMENTS` in `folder`, through the shell. `prefix` stands before the program's name.
Outcome run_program(const std::string& arguments, const std::string& folder = ".",
                    const std::string& prefix = "");

/// Checks that the program ended with `code` and said one line on stderr, which begins with `ramify: ` and
/// the message, and nothing on stdout.
void check_failure(const Outcome& outcome, int code, const std::string& message);

/// The program's path, for commands that do more than run it.
std::string program_path();

/// Any command, by bash.
Outcome run_shell(const std::string& command, const std::string& folder = ".");

/// The same for a value that an option does not allow, which names both limits, by whatever words CLI11 has.
void check_out_of_range(const Outcome& outcome, const std::string& option, const std::string& value,
                        const std::string& low, const std::string& high);

}  // namespace ramify::test
