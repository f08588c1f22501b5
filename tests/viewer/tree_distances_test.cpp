#include "viewer/tree_distances.h"

#include <chrono>
#include <thread>

#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;
using namespace std::chrono_literals;

namespace {

std::shared_ptr<const Numbers> numbers(const Skeleton& tree) {
  return std::make_shared<const Numbers>(numbers_of(tree));
}

}  // namespace

TEST_CASE("tree distances: they are those of the pair that was followed last") {
  const auto a = numbers(random_tree(1, 400));
  const auto b = numbers(random_tree(2, 400));
  TreeDistances distances;
  distances.follow(a, nullptr);
  CHECK_FALSE(distances.is_busy());
  distances.follow(a, a);
  distances.follow(a, b);  // comes after the first pair
  for (int i = 0; i < 2000 && (distances.is_busy() || distances.values() != distances_of(a->form, b->form));
       ++i) {
    std::this_thread::sleep_for(2ms);
    distances.follow(a, b);
  }
  REQUIRE(distances.values());
  CHECK(*distances.values() == distances_of(a->form, b->form));
  CHECK((*distances.values())[0] == scatter_distance(a->form, b->form));
  CHECK_FALSE(distances.is_busy());
}
