#include "common/format/skeleton_files.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/rng.h"
#include "common/config/job.h"
#include "common/config/presets.h"
#include "common/skeleton/passes.h"
#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"
#include "tests/common/trees.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

const std::vector<std::pair<std::string, SkeletonForm>> kForms = {{"t.csv", SkeletonForm::table},
                                                                  {"t.skel.ply", SkeletonForm::ply},
                                                                  {"t.swc", SkeletonForm::swc},
                                                                  {"t.mtg", SkeletonForm::mtg},
                                                                  {"q.csv", SkeletonForm::simpleforest}};

std::string text_of(const Skeleton& skeleton, SkeletonForm form,
                    const std::optional<Provenance>& provenance = {}) {
  std::ostringstream out;
  write_skeleton(skeleton, form, provenance, out);
  return out.str();
}

SkeletonFile read_text(const std::string& name, const std::string& text,
                       const SkeletonReading& options = {}) {
  const Folder folder;
  std::ofstream(folder.file(name), std::ios::binary) << text;
  return read_skeleton(folder.file(name), options);
}

std::string error_of(const std::string& name, const std::string& text) {
  const Folder folder;
  std::ofstream(folder.file(name), std::ios::binary) << text;
  try {
    read_skeleton(folder.file(name));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(folder.file("").size());
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void check_same(const Skeleton& a, const Skeleton& b) {
  CHECK(a.position == b.position);
  CHECK(a.parent == b.parent);
  CHECK(a.diameter == b.diameter);
  CHECK(a.axis == b.axis);
  CHECK(a.order == b.order);
  CHECK(a.kind == b.kind);
  CHECK(a.birth_step == b.birth_step);
  CHECK(a.shed_step == b.shed_step);
  CHECK(a.level == b.level);
  CHECK(a.light == b.light);
  CHECK(a.vigour == b.vigour);
  CHECK(a.channels == b.channels);
  CHECK(a.pipe_model.has_value() == b.pipe_model.has_value());
  if (a.pipe_model && b.pipe_model) {
    CHECK(a.pipe_model->exponent == b.pipe_model->exponent);
    CHECK(a.pipe_model->tip_diameter == b.pipe_model->tip_diameter);
  }
}

/// True if both put the nodes into the same axes, whatever these are called.
bool has_same_axes(const Skeleton& a, const Skeleton& b) {
  for (std::size_t node = a.root_count(); node < a.node_count(); ++node) {
    const std::uint32_t parent = a.parent[node];
    if ((a.axis[node] == a.axis[parent]) != (b.axis[node] == b.axis[parent])) return false;
  }
  return true;
}

/// What an MTG keeps of each node, in an order that does not depend on the nodes' own.
std::vector<std::array<double, 6>> sorted_nodes(const Skeleton& s) {
  std::vector<std::array<double, 6>> nodes;
  for (std::size_t node = 0; node < s.node_count(); ++node) {
    const Vec3& p = s.position[node];
    const double before = s.is_root(node) ? 0.0 : s.diameter[s.parent[node]];
    nodes.push_back({p.x, p.y, p.z, s.diameter[node], before, static_cast<double>(s.order[node])});
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// True if a table of internodes alone tells all of the roots: each is a point of its own where a trunk
/// starts.
bool has_rows_of_its_roots(const Skeleton& s) {
  std::vector<bool> has_trunk(s.root_count(), false);
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    if (s.is_root(s.parent[node]) && s.order[node] == 0) has_trunk[s.parent[node]] = true;
  }
  for (std::size_t root = 0; root < s.root_count(); ++root) {
    for (std::size_t other = 0; other < root; ++other) {
      if (s.position[root] == s.position[other]) return false;
    }
  }
  return std::find(has_trunk.begin(), has_trunk.end(), false) == has_trunk.end();
}

/// The round trips of one tree through every form.
void check_round_trips(const Skeleton& tree) {
  check_same(read_text("t.skel.ply", text_of(tree, SkeletonForm::ply)).skeleton, tree);

  const std::string table = text_of(tree, SkeletonForm::table);
  CHECK(text_of(read_text("t.csv", table).skeleton, SkeletonForm::table) == table);

  const Skeleton alive = living(tree);
  const std::string samples = text_of(tree, SkeletonForm::swc);
  const Skeleton swc = read_text("t.swc", samples).skeleton;
  CHECK(text_of(swc, SkeletonForm::swc) == samples);
  CHECK(swc.position == alive.position);
  CHECK(swc.parent == alive.parent);
  CHECK(swc.diameter == alive.diameter);
  CHECK(swc.order == alive.order);
  CHECK(has_same_axes(swc, alive));

  const std::string graph = text_of(tree, SkeletonForm::mtg);
  const Skeleton mtg = read_text("t.mtg", graph).skeleton;
  // Each axis gets the number of its first row: written again, only these differ.
  CHECK(sorted_nodes(mtg) == sorted_nodes(alive));
  CHECK(mtg.axis_count() == alive.axis_count());
  CHECK(strahler_orders(mtg)[0] == strahler_orders(alive)[0]);
  CHECK(text_of(read_text("t.mtg", text_of(mtg, SkeletonForm::mtg)).skeleton, SkeletonForm::mtg) ==
        text_of(mtg, SkeletonForm::mtg));

  if (!has_rows_of_its_roots(alive)) return;
  const Skeleton qsm = read_text("q.csv", text_of(tree, SkeletonForm::simpleforest)).skeleton;
  CHECK(qsm.position == alive.position);
  CHECK(qsm.parent == alive.parent);
  CHECK(qsm.order == alive.order);
}

// The example of the format's description: a trunk of three, an axis on its second, one on that one's second.
const std::string kExample =
    "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n"
    "$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tCONNECTED\tFREE\tIMPLICIT\nA\t2\t<-LINEAR\tFREE\tEXPLICIT\n"
    "I\t3\tNONE\tFREE\tEXPLICIT\n\nDESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nA\tA\t+\t?\nI\tI\t<\t1\n"
    "I\tI\t+\t?\n\nFEATURES:\nNAME\tTYPE\nLength\tREAL\nTopDiameter\tREAL\nXX\tREAL\nYY\tREAL\nZZ\tREAL\n\n"
    "MTG:\nENTITY-CODE\t\t\tLength\tTopDiameter\tXX\tYY\tZZ\n"
    "/P1/A1/I1\t\t\t1.0\t0.20\t0\t0\t1.0\n"
    "^<I2\t\t\t1.0\t0.18\t0\t0\t2.0\n"
    "\t+A2/I1\t\t0.5\t0.05\t0.35\t0\t2.35\n"
    "\t^<I2\t\t0.5\t0.04\t0.70\t0\t2.70\n"
    "\t\t+A3/I1\t0.2\t0.02\t0.70\t0.2\t2.70\n"
    "^<I3\t\t\t1.0\t0.15\t0\t0\t3.0\n";

EngineRegistry registry() {
  EngineRegistry engines;
  growth::register_engine(engines);
  pathplan::register_engine(engines);
  return engines;
}

}  // namespace

TEST_CASE("skeleton files: random trees come back from every form, exactly in what it carries") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Skeleton tree = random_tree(seed, 200);
    tree.channels["bark, thickness %"] =
        std::vector<double>(tree.node_count(), 0.1 + 1e-17 * static_cast<double>(seed));
    if (seed % 2 == 0) tree.pipe_model = PipeModel{2.49, 0.0123456789};
    check_round_trips(tree);
  }
  check_round_trips(joined({random_tree(1, 50), random_tree(2, 50), pole(1)}));
  check_round_trips(binary_tree(6));
}

TEST_CASE("skeleton files: trees of both engines' presets come back from every form") {
  const EngineRegistry engines = registry();
  for (const Preset& preset : presets()) {
    // One level or a few steps of each are enough to see its shapes.
    const bool is_grown = load_job(engines, std::string(preset.name)).engine->name == "growth";
    const int steps = std::min(is_grown ? 4 : 1, load_job(engines, std::string(preset.name)).steps());
    const std::vector<Override> overrides = {{"--steps", "steps", std::to_string(steps)}};
    const Job job = load_job(engines, std::string(preset.name), overrides);
    RunContext context;
    context.wants_history = true;
    INFO(preset.name);
    check_round_trips(job.run(context).skeleton);
  }
}

TEST_CASE("skeleton files: a .skel.ply keeps where its tree comes from") {
  const Provenance provenance{"1.2.3", "growth", 18446744073709551615u, 7,
                              "engine = \"growth\"\n\nseed = 1\n"};
  const auto again = read_text("t.skel.ply", text_of(pole(2), SkeletonForm::ply, provenance)).provenance;
  REQUIRE(again);
  CHECK(again->version == provenance.version);
  CHECK(again->engine == provenance.engine);
  CHECK(again->seed == provenance.seed);
  CHECK(again->steps == provenance.steps);
  CHECK(again->config == provenance.config);
  CHECK_FALSE(read_text("t.skel.ply", text_of(pole(2), SkeletonForm::ply)).provenance);
}

TEST_CASE("swc: nodes by number, roots of type 1, the others 16 and their order") {
  Skeleton tree = binary_tree(1);
  const std::string text = text_of(tree, SkeletonForm::swc);
  CHECK(text ==
        "# metres, +Y up; types: 1 root, 16 + branchOrder\n# id type x y z radius parent\n"
        "1 1 0 0 0 0.5 -1\n2 16 0 1 0 0.5 1\n3 16 -0.5 2 0 0.355 2\n4 17 0.5 2 0 0.35 2\n");
  const Provenance provenance{"1.2.3", "growth", 5, 7, "engine = \"growth\"\n"};
  CHECK(text_of(tree, SkeletonForm::swc, provenance).find("\n#   engine = \"growth\"\n") !=
        std::string::npos);
}

TEST_CASE("swc: neurons are read, rows in any order, axes by width") {
  const Skeleton s = read_text("t.swc",
                               "\xEF\xBB\xBF# made elsewhere\r\n 3 3 1 1 0 0.1 2\r\n1\t1 0 0 0 1 -1\r\n"
                               "2 3 0 1 0 0.5 1 extra words\r\n7 3 0 2 0 0.2 2.000\r\n\r\n")
                         .skeleton;
  CHECK(s.parent == std::vector<std::uint32_t>{kNoParent, 0, 1, 1});
  CHECK(s.diameter == std::vector<double>{2, 1, 0.2, 0.4});
  CHECK(s.order == std::vector<std::uint16_t>{0, 0, 1, 0});
}

TEST_CASE("swc: each broken row is one line") {
  const std::string good = "1 1 0 0 0 1 -1\n";
  CHECK(error_of("t.swc", "") == "t.swc: no nodes");
  CHECK(error_of("t.swc", good + "2 16 0 1 0 1\n") == "t.swc:2: 6 numbers (id type x y z radius parent)");
  CHECK(error_of("t.swc", good + "2 16 0 nan 0 1 1\n") == "t.swc:2: y: 'nan' is no finite number");
  CHECK(error_of("t.swc", good + "2 16 0 1 0 -1 1\n") == "t.swc:2: radius: -1 (must be greater than 0)");
  CHECK(error_of("t.swc", good + "2 16 0 1 0 1 9\n") == "t.swc:2: parent: 9 is no row's id (-1 for none)");
  CHECK(error_of("t.swc", good + good) == "t.swc:2: id: 1 stands in line 1 too");
  CHECK(error_of("t.swc", good + "2 16 0 1 0 1 3\n3 16 0 1 0 1 2\n") ==
        "t.swc:2: parent: 3 leads round to this row (a tree has no circle)");
  CHECK(error_of("t.swc", good + "x 16 0 1 0 1 1\n") == "t.swc:2: id: 'x' is no whole number");
}

TEST_CASE("mtg: the example of its description reads as that tree") {
  for (const std::string& text : {kExample, replaced(kExample, "/P1/A1/I1\t", "/P1\n^/A1\n^/I1\t")}) {
    const Skeleton s = read_text("t.mtg", text).skeleton;
    CHECK(s.position ==
          std::vector<Vec3>{
              {0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0.35, 2.35, 0}, {0.7, 2.7, 0}, {0.7, 2.7, -0.2}, {0, 3, 0}});
    CHECK(s.parent == std::vector<std::uint32_t>{kNoParent, 0, 1, 2, 3, 4, 2});
    CHECK(s.order == std::vector<std::uint16_t>{0, 0, 0, 1, 1, 2, 0});
    CHECK(s.diameter == std::vector<double>{0.2, 0.2, 0.18, 0.05, 0.04, 0.02, 0.15});
  }
  CHECK(read_text("t.mtg", kExample, {UpAxis::y}).skeleton.position[0] == Vec3(0, -1, 1));
}

TEST_CASE("mtg: a tree is written in the form of that example") {
  Skeleton tree = pole(2);
  tree.position.push_back({1e-9, 1.5, -2e16});
  tree.parent.push_back(1);
  tree.diameter.push_back(0.01);
  tree.kind.push_back(Kind::stem);
  assign_axes(tree);
  const std::string text = text_of(tree, SkeletonForm::mtg);
  CHECK(text.substr(text.find("MTG:\n")) ==
        "MTG:\nENTITY-CODE\t\tLength\tTopDiameter\tXX\tYY\tZZ\n"
        "/P1/A1/I1\t\t0\t0.2\t0\t0\t0\n^<I2\t\t1\t0.15000000000000002\t0\t0\t1\n"
        "\t+A2/I1\t20000000000000000\t0.01\t0.000000001\t20000000000000000\t1.5\n"
        "^<I3\t\t1\t0.1\t0\t0\t2\n");
  CHECK(text.substr(0, text.find("MTG:\n")) == kExample.substr(0, kExample.find("MTG:\n")));
}

TEST_CASE("mtg: each broken row is one line") {
  const auto error_with = [](const std::string& from, const std::string& to) {
    return error_of("t.mtg", replaced(kExample, from, to));
  };
  CHECK(error_of("t.mtg", "") ==
        "t.mtg:0: no section 'MTG:' (CODE:, CLASSES:, DESCRIPTION:, FEATURES:, MTG:)");
  CHECK(error_with("ENTITY-CODE", "CODE") == "t.mtg:25: no header 'ENTITY-CODE'");
  CHECK(error_with("\tXX\tYY\tZZ\n/", "\tX\tYY\tZZ\n/") ==
        "t.mtg:25: no feature 'XX' (XX, YY, ZZ and TopDiameter make a skeleton)");
  CHECK(error_with("0.18\t0", "0.18\tinf") == "t.mtg:27: XX: 'inf' is no finite number");
  CHECK(error_with("0.18", "-0.18") == "t.mtg:27: TopDiameter: -0.18 (must be greater than 0)");
  CHECK(error_with("+A2/I1", "+B2/I1") == "t.mtg:28: 'B' is no class of CLASSES");
  CHECK(error_with("+A2/I1", "A2/I1") == "t.mtg:28: entity 'A2/I1': no relation before it (/ < +)");
  CHECK(error_with("+A2/I1", "+A2/I1<I2") ==
        "t.mtg:28: '+A2/I1<I2' in one row: each entity needs a row for its features");
  CHECK(error_with("\t\t+A3", "\t\t^+A3") == "t.mtg:30: '^+A3/I1': no entity before it in its column");
  CHECK(error_with("\t+A2/I1\t", "\t\t+A2/I1") == "t.mtg:28: '+A2/I1': no entity in the column before it");
  CHECK(error_with("/P1/A1/I1", "<I1") == "t.mtg:26: nothing before it to follow or branch from");
  CHECK(error_with("\t+A2/I1", "\t<A2/I1") ==
        "t.mtg:31: a second successor of one entity (others branch off with '+')");
  CHECK(error_with("^<I3", "^<I3\t\t\t\t\t\t\t\t\t") == "t.mtg:31: more cells than the header has (8)");
}

TEST_CASE("skel.ply: each broken file is one line") {
  const std::string good = text_of(pole(2), SkeletonForm::ply);
  const auto error_with = [&](const std::string& from, const std::string& to) {
    return error_of("t.skel.ply", replaced(good, from, to));
  };
  CHECK(error_of("t.skel.ply", "") == "t.skel.ply:1: no PLY file (it begins with 'ply')");
  CHECK(error_with("binary_little_endian", "ascii") == "t.skel.ply:2: not 'format binary_little_endian 1.0'");
  CHECK(error_of("t.skel.ply", good.substr(0, good.find("element edge"))).find("the header has no end") !=
        std::string::npos);
  CHECK(error_of("t.skel.ply", good.substr(0, good.size() - 1)).find("rows of element 'edge' do not fit") !=
        std::string::npos);
  CHECK(error_of("t.skel.ply", good + "x") == "t.skel.ply: 1 bytes after the last row");
  CHECK(error_with("vertex 3", "vertex 400000000000000000")
            .find("400000000000000000 rows of element 'vertex' do not fit in the file") != std::string::npos);
  CHECK(error_with("vertex 3", "vertex -3") == "t.skel.ply:4: element vertex: '-3' is no count");
  CHECK(error_with("uchar kind", "list uchar int kind").find("of type 'list': a skeleton has only numbers") !=
        std::string::npos);
  CHECK(error_with("double diameter", "double diametre") ==
        "t.skel.ply: element vertex: no property 'diameter'");
  CHECK(error_with("element edge", "element egde") ==
        "t.skel.ply: no element 'edge' (a skeleton has vertex and edge)");
  std::string circle = good;
  circle[good.size() - 8] = 2;  // vertex1 of the last edge: its own vertex2
  CHECK(error_of("t.skel.ply", circle) ==
        "t.skel.ply: skeleton node 2: parent 2 is not before it (nodes follow their parent)");
  std::string far = good;
  far[good.size() - 8] = 77;
  CHECK(error_of("t.skel.ply", far) == "t.skel.ply: edge 1: from vertex 77 to 2 (0 to 2)");
}

TEST_CASE("skeleton files: a file changed at random is an error of one line or a sound skeleton") {
  Rng random = Rng::stream(5, Stream::bud, 0);
  const Folder folder;
  for (const auto& [name, form] : kForms) {
    Skeleton tree = random_tree(9, 12);
    tree.channels["vessels"] = std::vector<double>(tree.node_count(), 2.0);
    const std::string text = text_of(tree, form);
    const std::string characters = "0123456789.,-+e\t\n /<^nanIDA#\"\xff";
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
      std::string changed = text;
      for (std::size_t edits = 1 + random.below(3); edits > 0 && !changed.empty(); --edits) {
        const std::size_t at = random.below(changed.size());
        const char c = random.below(4) == 0 ? static_cast<char>(random.below(256))
                                            : characters[random.below(characters.size())];
        switch (random.below(5)) {
          case 0:
            changed.erase(at, 1 + random.below(20));
            break;
          case 1:
            changed.insert(at, 1, c);
            break;
          case 2:
            changed.insert(at, changed.substr(random.below(changed.size()), random.below(40)));
            break;
          case 3:
            if (random.below(10) == 0) changed.resize(at);
            break;
          default:
            changed[at] = c;
        }
      }
      std::ofstream(folder.file(name), std::ios::binary) << changed;
      try {
        const Skeleton skeleton = read_skeleton(folder.file(name)).skeleton;
        if (!violations(skeleton).empty()) FAIL(name << " " << i << ": " << violations(skeleton).front());
        ++read;
      } catch (const InputError& error) {
        const std::string message = error.what();
        if (message.find('\n') != std::string::npos || message.size() > 400) FAIL(message);
        if (message.rfind(folder.file(name), 0) != 0) FAIL(message);
        ++refused;
      }
    }
    INFO(name);
    CHECK(read > 10);
    CHECK(refused > 100);
  }
}

TEST_CASE("skeleton files: endings decide, and what is lost is told") {
  CHECK(is_skeleton_file("a/B.CSV"));
  CHECK(is_skeleton_file("cylinder_1.txt"));
  CHECK_FALSE(is_skeleton_file("a.ply"));
  CHECK_FALSE(is_skeleton_file(".csv"));
  CHECK_FALSE(skeleton_form("a.txt"));
  CHECK(skeleton_form("a.skel.ply") == SkeletonForm::ply);

  const Skeleton tree = random_tree(1, 100);
  CHECK(left_out(tree, SkeletonForm::ply).empty());
  CHECK(left_out(tree, SkeletonForm::table) == std::vector<std::string>{"the root's width"});
  const std::vector<std::string> lost = {"shed internodes", "birthStep", "level", "light", "vigour"};
  CHECK(left_out(tree, SkeletonForm::swc) == lost);
  CHECK(left_out(tree, SkeletonForm::mtg) == lost);
  CHECK(left_out(pole(3), SkeletonForm::swc).empty());
}
