#include <algorithm>
#include <fstream>
#include <numbers>
#include <sstream>

#include "common/base/errors.h"
#include "common/format/simpleforest.h"
#include "common/format/skeleton_files.h"
#include "tests/catch.h"
#include "tests/common/trees.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

SkeletonFile read_text(const std::string& text, const std::string& name = "t.csv",
                       const SkeletonReading& options = {}) {
  const Folder folder;
  std::ofstream(folder.file(name), std::ios::binary) << text;
  return read_skeleton(folder.file(name), options);
}

std::string error_of(const std::string& text) {
  const Folder folder;
  std::ofstream(folder.file("t.csv"), std::ios::binary) << text;
  try {
    read_skeleton(folder.file("t.csv"));
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(folder.file("").size());
  }
  return "no error";
}

// A trunk of two cylinders, a branch at the first's end, all on one table after another; +Z is up.
const std::string kSimpleForest =
    " ID, parentID, startX, startY, startZ, endX, endY, endZ, radius, length, growthLength, "
    "averagePointDistance,segmentID, parentSegmentID, branchOrder, reverseBranchOrder, branchID\n"
    "0,-1,2,3,10,2,3,11,0.10,1,3.5,0.01,0,-1,0,2,0\n"
    "1,0,2,3,11,2,3,12,0.08,1,1,0.01,1,0,0,1,0\n"
    "2,0,2,3,11,2.5,3,11,0.02,0.5,1.5,0.01,2,0,1,1,1\n"
    "3,2,2.5,3,11,2.5,4,11,0.02,1,1,0.01,2,0,1,1,1\n";

const std::string kTreegraph =
    "startX,startY,startZ,endX,endY,endZ,cyl_ID,parent_ID,extension_ID,radius_cyl,length,volume,axis_ID,"
    "segment_ID,node_ID,branching_order\n"
    "2,3,10,2,3,11,1,0,2,0.10,1,0.03,1,1,1,1\n"
    "2,3,11,2,3,12,2,1,0,0.08,1,0.02,1,2,2,1\n"
    "2,3,11,2.5,3,11,3,1,4,0.02,0.5,0.001,2,3,2,2\n"
    "2.5,3,11,2.5,4,11,4,3,0,0.02,1,0.001,2,3,3,2\n";

// The rows have 17 numbers, the header 13 names.
const std::string kTreeQsm =
    "radius (m)\tlength (m)\tstart_point\taxis_direction\tparent\textension\tbranch\tbranch_order\t"
    "position_in_branch\tmad\tSurfCov\tadded\tUnmodRadius (m)\n"
    "0.10\t1\t2\t3\t10\t0\t0\t1\t0\t2\t1\t0\t1\t0\t1\t0\t0.1\n"
    "0.08\t1\t2\t3\t11\t0\t0\t1\t1\t0\t1\t0\t2\t0\t1\t0\t0.1\n"
    "0.02\t0.5\t2\t3\t11\t1\t0\t0\t1\t4\t2\t1\t1\t0\t1\t0\t0.1\n"
    "0.02\t1\t2.5\t3\t11\t0\t1\t0\t3\t0\t2\t1\t2\t0\t1\t0\t0.1\n";

void check_small_tree(const Skeleton& s) {
  CHECK(s.root_count() == 1);
  CHECK(s.position == std::vector<Vec3>{{2, 10, -3}, {2, 11, -3}, {2, 12, -3}, {2.5, 11, -3}, {2.5, 11, -4}});
  CHECK(s.parent == std::vector<std::uint32_t>{kNoParent, 0, 1, 1, 3});
  CHECK(s.diameter == std::vector<double>{0.2, 0.2, 0.16, 0.04, 0.04});
  CHECK(s.axis == std::vector<std::uint32_t>{0, 0, 0, 1, 1});
  CHECK(s.order == std::vector<std::uint16_t>{0, 0, 0, 1, 1});
  CHECK(s.channels.at(kStartRadius) == std::vector<double>{0.1, 0.1, 0.08, 0.02, 0.02});
  CHECK(violations(s).empty());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("cylinder tables: three programs' tables of one tree are one skeleton, upright") {
  for (const std::string& text : {kSimpleForest, kTreegraph, kTreeQsm}) {
    const SkeletonFile file = read_text(text);
    check_small_tree(file.skeleton);
    CHECK(file.notes.empty());
  }
  check_small_tree(read_text(kTreeQsm, "cylinder_1.txt").skeleton);
  check_small_tree(read_text(kTreeQsm.substr(kTreeQsm.find('\n') + 1), "cylinder_1.txt").skeleton);
  CHECK(read_text(kTreegraph, "t.csv", {UpAxis::y}).skeleton.position[1] == Vec3(2, 3, 11));
}

TEST_CASE("cylinder tables: rows come in any order, with byte order mark and carriage returns") {
  std::istringstream lines(kTreegraph);
  std::string header;
  std::getline(lines, header);
  std::vector<std::string> rows;
  for (std::string row; std::getline(lines, row);) rows.push_back(row);
  std::sort(rows.begin(), rows.end());
  do {
    std::string text = "\xEF\xBB\xBF" + header + "\r\n";
    for (const std::string& row : rows) text += row + "\r\n";
    const Skeleton s = read_text(text).skeleton;
    CHECK(violations(s).empty());
    CHECK(s.internode_count() == 4);
    double length = 0.0;
    for (std::size_t node = 1; node < s.node_count(); ++node) length += s.length(node);
    CHECK(length == 3.5);
    CHECK(s.axis_count() == 2);
  } while (std::next_permutation(rows.begin(), rows.end()));
}

TEST_CASE("cylinder tables: where cylinders do not meet, their ends stay and the gap is told") {
  const SkeletonFile file = read_text(replaced(kSimpleForest, "2,0,2,3,11,2.5", "2,0,2.25,3,11,2.5"));
  check_small_tree(file.skeleton);
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].find("0.25 m apart in line 4, bridged") != std::string::npos);
}

TEST_CASE("cylinder tables: branchID of SimpleForest is no axis, columns may be missing") {
  // A branch of the branch: branchID stays, branchOrder rises.
  const std::string deeper = kSimpleForest + "4,2,2.5,3,11,3,3,11,0.01,0.5,0.5,0.01,3,2,2,1,1\n";
  CHECK(read_text(deeper).skeleton.axis_count() == 3);
  CHECK(read_text(deeper).skeleton.order.back() == 2);

  // Without orders the thicker of two goes on.
  const Skeleton s = read_text(
                         "ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,segmentID\n"
                         "0,-1,0,0,0,0,0,1,0.1,0\n1,0,0,0,1,1,0,1,0.01,1\n2,0,0,0,1,0,0,2,0.05,2\n")
                         .skeleton;
  CHECK(s.order == std::vector<std::uint16_t>{0, 0, 1, 0});
}

TEST_CASE("cylinder tables: each broken row is one line with file, row and what is wrong") {
  CHECK(error_of(replaced(kSimpleForest, "3,2,2.5", "3,9,2.5")) ==
        "t.csv:5: parentID: 9 is no row's ID (-1 for none)");
  CHECK(error_of(replaced(kSimpleForest, "2,0,2,3", "2,3,2,3")) ==
        "t.csv:4: parentID: 3 leads round to this row (a tree has no circle)");
  CHECK(error_of(replaced(kSimpleForest, "3,2,2.5", "1,2,2.5")) == "t.csv:5: ID: 1 stands in line 3 too");
  CHECK(error_of(replaced(kSimpleForest, "0.08", "-0.08")) ==
        "t.csv:3: radius: -0.08 (must be greater than 0)");
  CHECK(error_of(replaced(kSimpleForest, " radius,", " girth,")) ==
        "t.csv:1: no column 'radius' (a table of SimpleForest has ID, parentID, startX, ..., endZ, radius)");
  CHECK(error_of(replaced(kTreegraph, "radius_cyl", "girth")) ==
        "t.csv:1: no column 'radius_cyl' (a table of Treegraph or aRchi has startX, ..., endZ, cyl_ID, "
        "parent_ID, radius_cyl)");
  CHECK(error_of(replaced(kTreegraph, "4,3,0,0.02", "4,5,0,0.02")) ==
        "t.csv:5: parent_ID: 5 is no row's cyl_ID (0 for none)");
  CHECK(error_of(replaced(kTreegraph, "12,2,1", "inf,2,1")) == "t.csv:3: endZ: 'inf' is no finite number");
  CHECK(error_of(replaced(kTreeQsm, "\tparent", "\tmother")) ==
        "t.csv:1: no column 'parent' (TreeQSM's cylinders have radius, length, start_point, "
        "axis_direction, parent)");
  CHECK(error_of(replaced(kTreeQsm, "0.08\t1\t", "0.08\t")) == "t.csv:3: 16 cells (the header has 17)");
  CHECK(error_of(replaced(kTreeQsm, "\t3\t0\t2\t1\t2", "\t7\t0\t2\t1\t2")) ==
        "t.csv:5: parent: 7 is no row's row (0 for none)");
  CHECK(error_of(replaced(kTreeQsm, "0.08", "a\x01\xff")) == "t.csv:3: radius: 'a?\?' is no finite number");
  CHECK(error_of(std::string(100000, ',')) == "t.csv:1: more than 1000 columns: no table of a tree");
}

TEST_CASE("cylinder tables: what is written for SimpleForest reads back, segments and all") {
  const Skeleton tree = read_text(kSimpleForest).skeleton;
  std::ostringstream out;
  write_simpleforest(tree, out);
  CHECK(out.str() == kSimpleForest.substr(0, kSimpleForest.find('\n') + 1) +
                         "0,-1,2,3,10,2,3,11,0.1,1,3.5,,0,-1,0,2,0\n"
                         "1,0,2,3,11,2,3,12,0.08,1,1,,1,0,0,1,0\n"
                         "2,0,2,3,11,2.5,3,11,0.02,0.5,1.5,,2,0,1,1,1\n"
                         "3,2,2.5,3,11,2.5,4,11,0.02,1,1,,2,0,1,1,1\n");
  check_small_tree(read_text(out.str()).skeleton);
}

TEST_CASE("cylinder tables: a made tree keeps its volume, length and axes as cylinders") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Skeleton tree = random_tree(seed, 200);
    std::ostringstream out;
    write_simpleforest(tree, out);
    const Skeleton again = read_text(out.str()).skeleton;
    CHECK(again.position == tree.position);
    CHECK(again.parent == tree.parent);
    CHECK(again.order == tree.order);
    CHECK(again.axis == tree.axis);
    for (std::size_t node = 1; node < tree.node_count(); ++node) {
      const double a = tree.start_radius(node);
      const double b = 0.5 * tree.diameter[node];
      CHECK(again.channels.at(kStartRadius)[node] == 0.5 * again.diameter[node]);
      CHECK(0.25 * again.diameter[node] * again.diameter[node] == Approx((a * a + a * b + b * b) / 3.0));
    }
  }
}
