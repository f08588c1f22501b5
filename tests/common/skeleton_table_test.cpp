#include "common/format/skeleton_table.h"

#include <algorithm>
#include <sstream>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

std::string table_of(const Skeleton& skeleton) {
  std::ostringstream out;
  write_skeleton_table(skeleton, out);
  return out.str();
}

const std::string kHeader =
    "ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,length,branchID,branchOrder,birthStep,shedStep,"
    "level,"
    "light,vigour,kind\n";

std::string error_of(const std::string& rows, const std::string& header = kHeader) {
  try {
    read_skeleton_table(header + rows, "t.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("skeleton table: one row an internode, with the columns of the contract") {
  Skeleton s = pole(2);
  s.diameter = {0.5, 0.25, 0.125};
  s.level = {1, 1, 1};
  CHECK(table_of(s) ==
        kHeader + "0,-1,0,0,0,0,1,0,0.125,1,0,0,,,1,,,stem\n1,0,0,1,0,0,2,0,0.0625,1,0,0,,,1,,,stem\n");
}

TEST_CASE("skeleton table: any tree comes back byte for byte") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Skeleton tree = random_tree(seed, 300);
    const std::string text = table_of(tree);
    const Skeleton again = read_skeleton_table(text, "t.csv");
    CHECK(table_of(again) == text);
    CHECK(again.position == tree.position);
    CHECK(again.shed_step == tree.shed_step);
    // A root node has no row, so no light of its own.
    CHECK(std::equal(again.light.begin() + 1, again.light.end(), tree.light.begin() + 1));
  }
}

TEST_CASE("skeleton table: several roots, columns in another order and missing optional ones are read") {
  const Skeleton s = read_skeleton_table(
      "radius, endX,endY,endZ,startX,startY,startZ,parentID,ID,branchID,branchOrder\r\n"
      "0.5,0,1,0,0,0,0,-1,10,0,0\r\n"
      "0.25,5,1,0,5,0,0,-1,20,1,0\r\n"
      "0.25,0,2,0,0,1,0,10,30,0,0\r\n"
      "\r\n",
      "t.csv");
  CHECK(s.root_count() == 2);
  CHECK(s.internode_count() == 3);
  CHECK(s.position[1] == Vec3(5, 0, 0));
  CHECK(s.parent[4] == 2);
  CHECK(s.diameter[0] == 1.0);
  CHECK(s.birth_step.empty());
}

TEST_CASE("skeleton table: each broken row is one line with file, row and what is wrong") {
  const std::string good = "0,-1,0,0,0,0,1,0,0.1,1,0,0,,,,,,stem\n";
  CHECK(error_of("") == "t.csv: no internodes");
  CHECK(error_of("1,2,3\n") == "t.csv:2: 3 cells (the header has 18)");
  CHECK(error_of("0,-1,0,0,0,0,x,0,0.1,1,0,0,,,,,,stem\n") == "t.csv:2: endY: 'x' is no finite number");
  CHECK(error_of("0,-1,0,0,0,0,nan,0,0.1,1,0,0,,,,,,stem\n") == "t.csv:2: endY: 'nan' is no finite number");
  CHECK(error_of("0,-1,0,0,0,0,1e999,0,0.1,1,0,0,,,,,,stem\n") ==
        "t.csv:2: endY: '1e999' is no finite number");
  CHECK(error_of("0,-1,0,0,0,0,1,0,0,1,0,0,,,,,,stem\n") == "t.csv:2: radius: 0 (must be greater than 0)");
  CHECK(error_of("0,-1,0,0,0,0,1,0,0.1,1,0,70000,,,,,,stem\n") ==
        "t.csv:2: branchOrder: '70000' is no whole number in range");
  CHECK(error_of(good + good) == "t.csv:3: ID: 0 stands in line 2 too");
  CHECK(error_of(good + "1,7,0,0,0,0,1,0,0.1,1,0,0,,,,,,stem\n") ==
        "t.csv:3: parentID: 7 is no row's ID (-1 for none)");
  CHECK(error_of("1,1,0,0,0,0,1,0,0.1,1,0,0,,,,,,stem\n") ==
        "t.csv:2: parentID: 1 leads round to this row (a tree has no circle)");
  CHECK(error_of("0,-1,0,0,0,0,1,0,0.1,1,0,0,,,,,,twig\n") == "t.csv:2: kind: 'twig' (stem | root)");
  CHECK(error_of("", "a,b,c\n") ==
        "t.csv:1: no column 'ID' (a skeleton table begins ID,parentID,startX,...)");
  CHECK(error_of("", "") == "t.csv:1: no column 'ID' (a skeleton table begins ID,parentID,startX,...)");
  CHECK(error_of(good + "1,0,0,0,0,0,1,0,0.1,1,0,5,,,,,,stem\n") ==
        "t.csv: skeleton node 2: order 5 on an axis of order 0 (one order an axis)");
}
