// `ramify render --frames`: films, read frame by frame.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "common/base/files.h"
#include "common/base/image.h"
#include "common/config/job.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"
#include "viewer/film_camera.h"
#include "viewer/renderer.h"

using namespace ramify;
using namespace ramify::test;

namespace {

// The MP4 is looked at in tests/checks/film; here it only takes time.
const std::string kNoFfmpeg = "PATH=/nowhere ";

/// The names in a folder, in order.
std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The frames as PNG files that the program has to draw for this config, made from one run here.
std::vector<std::string> expected_frames(const std::string& config, RenderOptions options) {
  EngineRegistry registry;
  growth::register_engine(registry);
  pathplan::register_engine(registry);
  const Job job = load_job(registry, config);
  RunContext context;
  context.wants_history = true;
  const Skeleton whole = job.run(context).skeleton;
  const Mesh last = make_tree_mesh(living(whole), job.looks(), job.seed()).mesh;
  const std::vector<Vec3f> room = film_room({.mesh = &last}, whole.position, options.style);
  options.room_for = room;
  Renderer renderer;
  std::vector<std::string> frames;
  for (int step = 1; step <= job.steps(); ++step) {
    const Skeleton tree = cut_at(whole, static_cast<std::uint32_t>(step));
    const Mesh mesh = make_tree_mesh(tree, job.looks(), job.seed()).mesh;
    std::ostringstream png;
    write_png(renderer.render({.mesh = &mesh, .skeleton = &tree}, options), png);
    frames.push_back(png.str());
  }
  return frames;
}

}  // namespace

TEST_CASE("film: frame K is the tree after step K, or of K levels, seen by the same camera") {
  // The one sheds branches on the way, the other is planned.
  for (const std::string config : {"s4-improved", "xm12-fig5"}) {
    const Folder folder;
    const Outcome outcome =
        run_program("render " + config + " --frames out --size 96x128 --view 30,10 --style schematic",
                    folder.path().string(), kNoFfmpeg);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    RenderOptions options;
    options.width = 96;
    options.height = 128;
    options.view = {.azimuth_deg = 30.0, .elevation_deg = 10.0};
    options.style = RenderStyle::schematic;
    const std::vector<std::string> expected = expected_frames(config, options);
    std::vector<std::string> names = {"about.json"};
    for (std::size_t i = 0; i < expected.size(); ++i) {
      names.push_back("frame-00" + std::string(i < 9 ? "0" : "") + std::to_string(i + 1) + ".png");
      CHECK(read_file(folder.file("out/" + names.back())) == expected[i]);
      if (i > 0) CHECK(expected[i] != expected[i - 1]);
    }
    CHECK(names_in(folder.file("out")) == names);
    CHECK(outcome.out.find("no MP4: ffmpeg is not installed\n") != std::string::npos);
  }
}

TEST_CASE("film: a run in steps is cut, not made again: a table with the history shows the same") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate p09-fig7-50 --steps 8 --history -o a.csv --quiet", where).code == 0);
  REQUIRE(
      run_program("render a.csv --frames a --size 64x64 --style skeleton --quiet", where, kNoFfmpeg).code ==
      0);
  REQUIRE(run_program("render p09-fig7-50 --steps 8 --frames b --size 64x64 --style skeleton --quiet", where,
                      kNoFfmpeg)
              .code == 0);
  CHECK(names_in(folder.file("a")).size() == 9);
  for (const std::string& name : names_in(folder.file("a"))) {
    if (name != "about.json") {
      CHECK(read_file(folder.file("a/" + name)) == read_file(folder.file("b/" + name)));
    }
  }
}

TEST_CASE("film: where nothing was shed the last frame is the picture of the tree") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string tree = "render s4-fig6 --size 80x80 --quiet --color-by birthStep --scale ";
  REQUIRE(run_program(tree + "--frames out", where, kNoFfmpeg).code == 0);
  REQUIRE(run_program(tree + "-o last.png", where).code == 0);
  CHECK(read_file(folder.file("out/frame-0005.png")) == read_file(folder.file("last.png")));
}

TEST_CASE("film: a turntable goes once round and begins where the picture is taken from") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string turning = "render s4-fig6 --size 64x64 --style schematic --quiet --turntable 4 --frames ";
  REQUIRE(run_program(turning + "a", where, kNoFfmpeg).code == 0);
  REQUIRE(run_program(turning + "b --view side", where, kNoFfmpeg).code == 0);
  CHECK(names_in(folder.file("a")).size() == 5);
  const auto frame = [&](const std::string& film, int number) {
    return read_file(folder.file(film + "/frame-000" + std::to_string(number) + ".png"));
  };
  for (int i = 1; i <= 3; ++i) CHECK(frame("a", i + 1) == frame("b", i));
  CHECK(frame("b", 4) == frame("a", 1));
  CHECK(frame("a", 1) != frame("a", 2));
}

TEST_CASE("film: a tree grows while the camera turns, beside one with fewer steps, and --json tells of it") {
  const Folder folder;
  const Outcome outcome = run_program(
      "render s4-fig6 s4-fig8 --steps 4 xm12-fig5 --frames out --size 32x48 --turn 90 --columns 2 --json",
      folder.path().string(), kNoFfmpeg);
  CHECK(outcome.code == 2);  // --steps 4 is more than the planned tree has levels
  const Outcome fewer =
      run_program("render s4-fig6 xm12-fig5 --frames out --size 32x48 --turn 90 --columns 1 --json",
                  folder.path().string(), kNoFfmpeg);
  INFO(fewer.err);
  REQUIRE(fewer.code == 0);
  const nlohmann::json told = nlohmann::json::parse(fewer.out);
  CHECK(told["frames"] == 5);
  CHECK(told["width"] == 32);
  CHECK(told["height"] == 96);
  CHECK(told["folder"] == "out");
  CHECK(told["mp4"].is_null());
}

TEST_CASE("film: it takes the place of a film, and of nothing else") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string film = "render s4-fig6 --size 32x32 --quiet --frames ";
  REQUIRE(run_program(film + "out", where, kNoFfmpeg).code == 0);
  REQUIRE(run_program(film + "out --steps 3", where, kNoFfmpeg).code == 0);
  CHECK(names_in(folder.file("out")).size() == 4);
  std::ofstream(folder.file("out/note.txt")) << "mine";
  check_failure(run_program(film + "out", where, kNoFfmpeg), 2,
                "out: is there already and holds files that `ramify render --frames` did not make");
  std::ofstream(folder.file("file")) << "mine";
  check_failure(run_program(film + "file", where, kNoFfmpeg), 2, "file: is there already and no folder");
  check_failure(run_program(film + "no/out", where, kNoFfmpeg), 1,
                "no/out: cannot write: there is no folder");
  CHECK(folder.count() == 2);
}

TEST_CASE("film: what has no film is one line and leaves nothing") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o a.glb -o a.swc --quiet", where).code == 0);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"s4-fig6", "render: wants one of -o PNG, for a picture, and --frames DIR, for a film"},
      {"s4-fig6 -o p.png --frames out", "render: wants one of -o PNG"},
      {"a.glb --frames out", "--frames: a.glb has no steps (--turntable N makes a film that turns about it)"},
      {"a.swc --frames out", "--frames: a.swc has no steps"},
      {"s4-fig6 --frames out --at-step 3",
       "--at-step: a film shows all steps (--steps K ends it sooner, --turntable N stays at one)"},
      {"s4-fig6 -o p.png --turntable 4", "--turntable, --turn, --fps: go with --frames DIR"},
      {"s4-fig6 -o p.png --turn 90", "--turntable, --turn, --fps: go with --frames DIR"},
      {"s4-fig6 -o p.png --fps 9", "--turntable, --turn, --fps: go with --frames DIR"},
      {"xm12-fig5 --frames out --turntable 4 --at-step 1", "--at-step: xm12-fig5 has no steps"},
  };
  for (const auto& [arguments, message] : cases) {
    INFO(arguments);
    check_failure(run_program("render " + arguments + " --size 32x32", where, kNoFfmpeg), 2, message);
    CHECK(folder.count() == 2);
  }
  const auto made = [&](const std::string& option) {
    return run_program("render s4-fig6 --frames out --size 32x32 " + option, where, kNoFfmpeg);
  };
  check_out_of_range(made("--turntable 1"), "--turntable", "1", "2", "9999");
  check_out_of_range(made("--turn round"), "--turn", "round", "-3600", "3600");
  check_out_of_range(made("--fps 0"), "--fps", "0", "1", "120");
  CHECK(folder.count() == 2);
}

TEST_CASE("film: where ffmpeg fails the frames are there and a line has its words") {
  const Folder folder;
  std::ofstream(folder.file("ffmpeg")) << "#!/bin/sh\necho 'Unknown encoder' >&2\nexit 1\n";
  std::filesystem::permissions(folder.file("ffmpeg"), std::filesystem::perms::owner_all);
  const Outcome outcome = run_program("render s4-fig6 --frames out --size 32x32", folder.path().string(),
                                      "PATH=.:/bin:/usr/bin ");
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("no MP4: ffmpeg failed: Unknown encoder\n") != std::string::npos);
  CHECK(names_in(folder.file("out")).size() == 6);
}

TEST_CASE("film: a transparent one has no MP4") {
  const Folder folder;
  const Outcome outcome = run_program(
      "render s4-fig6 --steps 2 --frames out --size 32x32 --background transparent", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("no MP4: it could not be transparent\n") != std::string::npos);
}

TEST_CASE("film: Ctrl-C leaves nothing") {
  const Folder folder;
  const Outcome outcome =
      run_shell("'" + program_path() +
                    "' render s4-fig6 --frames out --turntable 9999 --quiet & sleep 2; kill -INT $!; wait $!",
                folder.path().string());
  CHECK(outcome.code == 130);
  CHECK(outcome.err == "ramify: interrupted; nothing written\n");
  CHECK(folder.count() == 0);
}
