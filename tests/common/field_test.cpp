// Tables, the TOML reader and the TOML writer, on a struct that has one of everything.

#include "common/config/field.h"

#include "common/base/errors.h"
#include "common/config/toml_reader.h"
#include "common/config/toml_writer.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

enum class Colour { red, green };

struct Leaf {
  double width = 1.0;

  static const Table& fields() {
    static const Table table =
        make_table<Leaf>({{"width", &Leaf::width, {.min = 0, .max = 10, .help = "across"}}});
    return table;
  }
};

struct Plant {
  double height = 2.0;
  int count = 3;
  std::uint64_t seed = 1;
  bool is_tall = false;
  Colour colour = Colour::red;
  Vec3 place{1, 2, 3};
  Schedule growth = 0.5;
  Sketch outline;
  std::filesystem::path picture;
  Leaf leaf;
  std::vector<Leaf> leaves;
  std::map<std::string, Leaf> named;

  static const Table& fields() {
    static const Table table = make_table<Plant>({
        {"height",
         &Plant::height,
         {.min = 0, .max = 10, .is_above_min = true, .unit = "metres", .help = "how tall"}},
        {"count", &Plant::count, {.min = 1, .max = 9}},
        {"seed", &Plant::seed, {}},
        {"is_tall", &Plant::is_tall, {}},
        {"colour", &Plant::colour, {.choices = {"red", "green"}}},
        {"place", &Plant::place, {.min = -5, .max = 5}},
        {"growth", &Plant::growth, {.min = 0, .max = 1}},
        {"outline", &Plant::outline, {.min = -5, .max = 5}},
        {"picture", &Plant::picture, {}},
        {"leaf", &Plant::leaf, {}},
        {"leaves", &Plant::leaves, {.inherits = true}},
        {"named", &Plant::named, {}},
    });
    return table;
  }
};

Plant read(std::string_view text) {
  Plant plant;
  Origins origins;
  TomlDocument(text, "oak.toml").read_into(Plant::fields(), &plant, {}, origins);
  return plant;
}

std::string error_of(std::string_view text) {
  try {
    read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string set_error(std::string_view key, std::string_view value) {
  Plant plant;
  plant.leaves = {Leaf{}, Leaf{}};
  Origins origins;
  try {
    assign(Plant::fields(), &plant, key, value, "--set", origins);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("toml: every kind of member is read") {
  const Plant plant = read(R"(
height = 3
count = 4
seed = 123456789012
is_tall = true
colour = "green"
place = [1, -2.5, 0]
growth = [[1, 0.25], [4, 1]]
outline = [[0, 0], [1.5, -2], [0, 4]]
picture = "oak/leaf.png"
leaf.width = 2.5
named.a.width = 7
[[leaves]]
width = 4
[[leaves]]
)");
  CHECK(plant.height == 3.0);
  CHECK(plant.count == 4);
  CHECK(plant.seed == 123456789012);
  CHECK(plant.is_tall);
  CHECK(plant.colour == Colour::green);
  CHECK(plant.place == Vec3(1, -2.5, 0));
  CHECK(plant.growth.at(2.5) == 0.625);
  CHECK(plant.outline == Sketch{{0, 0}, {1.5, -2}, {0, 4}});
  CHECK(plant.picture == "oak/leaf.png");
  CHECK(plant.leaf.width == 2.5);
  CHECK(plant.named.at("a").width == 7.0);
  REQUIRE(plant.leaves.size() == 2);
  CHECK(plant.leaves[1].width == 4.0);  // inherited from the item before
}

TEST_CASE("toml: what a text does not name keeps its value") {
  const Plant plant = read("count = 2\n");
  CHECK(plant.height == 2.0);
  CHECK(plant.place == Vec3(1, 2, 3));
}

TEST_CASE("toml: each mistake is one line with file, line, key and what is allowed") {
  CHECK(error_of("height = 0\n") == "oak.toml:1: height: 0 is out of range (a number, more than 0 to 10)");
  CHECK(error_of("\nheight = 10.5\n") ==
        "oak.toml:2: height: 10.5 is out of range (a number, more than 0 to 10)");
  CHECK(error_of("height = nan\n") ==
        "oak.toml:1: height: nan is out of range (a number, more than 0 to 10)");
  CHECK(error_of("height = 1e308\n") ==
        "oak.toml:1: height: 1e+308 is out of range (a number, more than 0 to 10)");
  CHECK(error_of("height = \"x\"\n") == "oak.toml:1: height: a string, 'x' (a number, more than 0 to 10)");
  CHECK(error_of("count = 2.5\n") == "oak.toml:1: count: 2.5 is no whole number (a whole number, 1 to 9)");
  CHECK(error_of("count = true\n") == "oak.toml:1: count: true or false (a whole number, 1 to 9)");
  CHECK(error_of("count = 9223372036854775807\n") ==
        "oak.toml:1: count: 9223372036854775807 is out of range (a whole number, 1 to 9)");
  CHECK(error_of("seed = -1\n") ==
        "oak.toml:1: seed: -1 is out of range (a whole number, 0 to 9223372036854775807)");
  CHECK(error_of("is_tall = 1\n") == "oak.toml:1: is_tall: a whole number (true or false)");
  CHECK(error_of("colour = \"blue\"\n") == "oak.toml:1: colour: 'blue' is not known (red | green)");
  CHECK(error_of("place = [1, 2]\n") ==
        "oak.toml:1: place: a list of 2 (three numbers [x, y, z], each -5 to 5)");
  CHECK(error_of("place = [1, 2, 9]\n") ==
        "oak.toml:1: place: 9 is out of range (three numbers [x, y, z], each -5 to 5)");
  CHECK(error_of("growth = [[3, 0], [3, 1]]\n") ==
        "oak.toml:1: growth: step 3 does not rise above 3 (a number, 0 to 1, or [[step, value], ...] with "
        "rising "
        "steps)");
  CHECK(error_of("growth = []\n") ==
        "oak.toml:1: growth: an empty list (a number, 0 to 1, or [[step, value], ...] with rising steps)");
  CHECK(error_of("growth = [1, 2]\n") ==
        "oak.toml:1: growth: a schedule's point is [step, value] (a number, 0 to 1, or [[step, value], ...] "
        "with "
        "rising steps)");
  CHECK(error_of("growth = [[inf, 1]]\n") ==
        "oak.toml:1: growth: a schedule's step is a number (a number, 0 to 1, or [[step, value], ...] with "
        "rising "
        "steps)");
  CHECK(error_of("outline = 3\n") ==
        "oak.toml:1: outline: a whole number (a list of points [[x, y], ...], each number -5 to 5)");
  CHECK(error_of("outline = [[0, 0], [1, 2, 3]]\n") ==
        "oak.toml:1: outline.2: a point is [x, y] (a list of points [[x, y], ...], each number -5 to 5)");
  CHECK(error_of("outline = [[0, 0],\n[1, 9]]\n") ==
        "oak.toml:2: outline.2: 9 is out of range (a list of points [[x, y], ...], each number -5 to 5)");
  CHECK(error_of("picture = 3\n") ==
        "oak.toml:1: picture: a whole number (a file's path in quotes, seen from the config's own folder)");
  CHECK(error_of("leaf = 3\n") == "oak.toml:1: leaf: a whole number (a table)");
  CHECK(error_of("leaves = 3\n") == "oak.toml:1: leaves: a whole number (a list of tables)");
  CHECK(error_of("leaves = [3]\n") == "oak.toml:1: leaves.1: a whole number (a table)");
  CHECK(error_of("named = { a = 1 }\n") == "oak.toml:1: named.a: a whole number (a table)");
  CHECK(error_of("[[leaves]]\nwidth = 11\n") ==
        "oak.toml:2: leaves.1.width: 11 is out of range (a number, 0 to 10)");
}

TEST_CASE("toml: an unknown key is an error that names the nearest known one") {
  CHECK(error_of("heigth = 1\n") == "oak.toml:1: heigth: unknown key; did you mean 'height'?");
  CHECK(error_of("leaf.widht = 1\n") == "oak.toml:1: leaf.widht: unknown key; did you mean 'leaf.width'?");
  CHECK(error_of("width = 1\n") == "oak.toml:1: width: unknown key; did you mean 'leaf.width'?");
  CHECK(error_of("[leaf]\nqqqqqqq = 1\n") == "oak.toml:2: leaf.qqqqqqq: unknown key (known: width)");
}

TEST_CASE("toml: of several mistakes the first in the file is reported") {
  CHECK(error_of("seed = 1\nzzzzzzzzzz = 1\nheight = 99\n").rfind("oak.toml:2: zzzzzzzzzz", 0) == 0);
}

TEST_CASE("toml: a text that is no TOML is an error with its line") {
  CHECK(error_of("height = \n").rfind("oak.toml:1: no TOML: ", 0) == 0);
  CHECK(error_of("height = 1\n[[[\n").rfind("oak.toml:2: no TOML: ", 0) == 0);
  CHECK(error_of("height = 1\nheight = 2\n").rfind("oak.toml:2: no TOML: ", 0) == 0);
  CHECK(error_of(std::string_view("\0\xff\x01", 3)).rfind("oak.toml:1: no TOML: ", 0) == 0);
}

TEST_CASE("set: dotted keys reach into groups, lists and maps, and bare words are strings") {
  Plant plant;
  plant.leaves = {Leaf{}, Leaf{}};
  Origins origins;
  assign(Plant::fields(), &plant, "height", "7.5", "--set", origins);
  assign(Plant::fields(), &plant, "colour", "green", "--set", origins);
  assign(Plant::fields(), &plant, "leaf.width", "2", "--set", origins);
  assign(Plant::fields(), &plant, "leaves.2.width", "3", "--set", origins);
  assign(Plant::fields(), &plant, "named.new.width", "4", "--set", origins);
  assign(Plant::fields(), &plant, "growth", "[[1, 0], [2, 1]]", "--set", origins);
  assign(Plant::fields(), &plant, "leaf", "{ width = 9 }", "--set", origins);
  CHECK(plant.height == 7.5);
  CHECK(plant.colour == Colour::green);
  CHECK(plant.leaf.width == 9.0);
  CHECK(plant.leaves[1].width == 3.0);
  CHECK(plant.leaves[0].width == 1.0);
  CHECK(plant.named.at("new").width == 4.0);
  CHECK_FALSE(plant.growth.is_constant());
  CHECK(origins.at("leaves.2.width") == "--set");
}

TEST_CASE("set: mistakes name the flag") {
  CHECK(set_error("heigth", "1") == "--set: heigth: unknown key; did you mean 'height'?");
  CHECK(set_error("height", "99") == "--set: height: 99 is out of range (a number, more than 0 to 10)");
  CHECK(set_error("height", "1 2") == "--set: height: '1 2' is no TOML value");
  CHECK(set_error("height", "") == "--set: height: '' is no TOML value");
  CHECK(set_error("height.x", "1") ==
        "--set: height.x: 'height' holds no keys (a number, more than 0 to 10)");
  CHECK(set_error("leaves.3.width", "1") == "--set: leaves.3: '3' is no item of leaves (1 to 2)");
  CHECK(set_error("leaves.0.width", "1") == "--set: leaves.0: '0' is no item of leaves (1 to 2)");
  CHECK(set_error("height", ".3") == "--set: height: '.3' is no TOML value");
  CHECK(set_error("leaves.x.width", "1") == "--set: leaves.x: 'x' is no item of leaves (1 to 2)");
  CHECK(set_error("leaf.", "1").rfind("--set: leaf", 0) == 0);
  CHECK(set_error("", "1").rfind("--set: ", 0) == 0);
}

TEST_CASE("toml: what is written reads back to the same text") {
  Plant plant = read(
      "height = 0.1\ngrowth = [[1, 0.3], [2, 0.7]]\nplace = [1e-3, 2, -0.1]\n"
      "[[leaves]]\nwidth = 0.3\n[named.\"odd name\"]\nwidth = 2\n");
  const std::string text = to_toml(Plant::fields(), &plant);
  Plant again = read(text);
  CHECK(to_toml(Plant::fields(), &again) == text);
  CHECK(again.height == plant.height);
  CHECK(again.named.count("odd name") == 1);
  const std::string commented = to_toml(Plant::fields(), &plant, {.with_comments = true});
  CHECK(commented.find("# how tall, in metres; a number, more than 0 to 10\nheight = 0.1\n") !=
        std::string::npos);
  again = read(commented);
  CHECK(to_toml(Plant::fields(), &again) == text);
}

TEST_CASE("toml: a path starts from the folder of the file that names it") {
  const auto picture = [](std::string_view text, const std::string& folder) {
    Plant plant;
    Origins origins;
    TomlDocument(text, "oak.toml", folder).read_into(Plant::fields(), &plant, {}, origins);
    return plant.picture.string();
  };
  CHECK(picture("picture = \"leaf.png\"\n", "") == "leaf.png");
  CHECK(picture("picture = \"leaf.png\"\n", "trees") == "trees/leaf.png");
  CHECK(picture("picture = \"../leaf.png\"\n", "trees/oak") == "trees/leaf.png");
  CHECK(picture("picture = \"/tmp/leaf.png\"\n", "trees") == "/tmp/leaf.png");
  CHECK(picture("picture = \"\"\n", "trees").empty());

  Plant plant;
  Origins origins;
  assign(Plant::fields(), &plant, "picture", "./trees/leaf-2.png", "--set", origins);
  CHECK(plant.picture == "trees/leaf-2.png");
  assign(Plant::fields(), &plant, "picture", "\"a leaf.png\"", "--set", origins);
  CHECK(plant.picture == "a leaf.png");
}

TEST_CASE("toml: a path is written so that it reads back, whatever is in it") {
  for (const std::string name :
       {"a \"leaf\".png", "back\\slash", "tab\tand\nline", "bl\u00e4tter/\u6a39.png"}) {
    Plant plant;
    plant.picture = name;
    CHECK(read(to_toml(Plant::fields(), &plant)).picture == name);
  }
}

TEST_CASE("names: the nearest is suggested only if it is near") {
  CHECK(nearest_name("lambdaa", {"lambda", "kappa"}) == "lambda");
  CHECK(nearest_name("kapa", {"lambda", "kappa"}) == "kappa");
  CHECK(nearest_name("zeppelin", {"lambda", "kappa"}).empty());
}
