#include <algorithm>

#include "tests/catch.h"
#include "tests/cli/program.h"

using namespace ramify::test;

TEST_CASE("view: without a display one line says so and names the way without") {
  // Wayland's own library has a line to say where there is no folder for it.
  const Outcome outcome = run_program("view", ".", "env -u DISPLAY -u WAYLAND_DISPLAY XDG_RUNTIME_DIR=/tmp ");
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("ramify: no window: ") == 0);
  CHECK(outcome.err.find("`ramify render` draws pictures without a display") != std::string::npos);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

TEST_CASE("view: what cannot be opened is told before a window is") {
  const std::string nowhere = "env -u DISPLAY -u WAYLAND_DISPLAY ";
  const Outcome unknown = run_program("view s4-fig66", ".", nowhere);
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("s4-fig66: no such file or preset") != std::string::npos);
  const Outcome size = run_program("view --size big", ".", nowhere);
  CHECK(size.code == 2);
  CHECK(size.err == "ramify: --size: 'big' is no WxH (1x1 to 32768x32768)\n");
  const Outcome three = run_program("view s4-fig4 s4-fig5 s4-fig6", ".", nowhere);
  CHECK(three.code == 2);
}
