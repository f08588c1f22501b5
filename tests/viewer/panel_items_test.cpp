#include "viewer/panel_items.h"

#include <string_view>

#include "growth/parameters.h"
#include "pathplan/parameters.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

template <class P>
const FieldRow& row_of(std::string_view key) {
  for (const FieldRow& row : P::fields()) {
    if (row.key == key) return row;
  }
  FAIL("there is no row " << key);
  return P::fields().front();
}

}  // namespace

TEST_CASE("panel: the items of a list are counted from 1, and the right one is taken away") {
  pathplan::Parameters now;
  now.levels.resize(3);
  for (int level = 0; level < 3; ++level) now.levels[level].b = 10 + level;
  pathplan::Parameters opened;
  pathplan::Parameters by_default;
  const FieldRow& row = row_of<pathplan::Parameters>("levels");
  const Owners lists = members_of(row, {&now, &opened, &by_default});
  const std::vector<PanelItem> items = items_of(row, lists);
  REQUIRE(items.size() == 3);
  CHECK(items[1].name == "2");
  CHECK(items[0].owners.opened == &opened.levels[0]);
  CHECK(items[1].owners.opened == nullptr);
  CHECK(items[2].owners.by_default == &by_default.levels[2]);
  remove_item(row, lists.now, items[1]);
  REQUIRE(now.levels.size() == 2);
  CHECK(now.levels[0].b == 10);
  CHECK(now.levels[1].b == 12);
}

TEST_CASE("panel: a named item needs a name that keys can say and nobody has") {
  growth::Parameters now;
  now.tropism["up"];
  const FieldRow& row = row_of<growth::Parameters>("tropism");
  void* const map = row.member(&now);
  CHECK(is_free_name(row, map, "to-the-light_2"));
  CHECK_FALSE(is_free_name(row, map, "up"));
  CHECK_FALSE(is_free_name(row, map, ""));
  CHECK_FALSE(is_free_name(row, map, "to the light"));
  CHECK_FALSE(is_free_name(row, map, "a.b"));
  const std::vector<PanelItem> items = items_of(row, {map, nullptr, nullptr});
  REQUIRE(items.size() == 1);
  remove_item(row, map, items.front());
  CHECK(now.tropism.empty());
}
