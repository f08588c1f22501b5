// Both engines, as the program knows them.
#pragma once

#include "common/config/job.h"
#include "growth/engine.h"
#include "pathplan/engine.h"

namespace ramify::test {

inline const EngineRegistry& both_engines() {
  static const EngineRegistry all = [] {
    EngineRegistry engines;
    growth::register_engine(engines);
    pathplan::register_engine(engines);
    return engines;
  }();
  return all;
}

}  // namespace ramify::test
