#include "tests/cli/program.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/folder.h"

namespace ramify::test {

std::string program_path() {
  return RAMIFY_PROGRAM;
}

Outcome run_shell(const std::string& command, const std::string& folder) {
  const Folder scratch;
  std::ofstream(scratch.file("script")) << "cd '" << folder << "' || exit 99\n" << command << '\n';
  const std::string line = "bash '" + scratch.file("script") + "' >'" + scratch.file("out") + "' 2>'" +
                           scratch.file("err") + "' </dev/null";
  const int status = std::system(line.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_file(scratch.file("out"));
  outcome.err = read_file(scratch.file("err"));
  return outcome;
}

Outcome run_program(const std::string& arguments, const std::string& folder, const std::string& prefix) {
  return run_shell(prefix + "'" + program_path() + "' " + arguments, folder);
}

void check_failure(const Outcome& outcome, int code, const std::string& message) {
  INFO(outcome.err);
  CHECK(outcome.code == code);
  CHECK(outcome.err.rfind("ramify: " + message, 0) == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.out.empty());
}

void check_out_of_range(const Outcome& outcome, const std::string& option, const std::string& value,
                        const std::string& low, const std::string& high) {
  const std::string start = option + ": Value " + value + " not in range ";
  check_failure(outcome, 2, start);
  const std::string limits = outcome.err.substr(std::min(start.size(), outcome.err.size()));
  CHECK(limits.find(low) < limits.find(high));
  CHECK(limits.find(high) != std::string::npos);
}

}  // namespace ramify::test
