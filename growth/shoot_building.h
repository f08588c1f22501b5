// Shoots become part of the plant, and buds that waited too long leave it.
#pragma once

#include <span>
#include <vector>

#include "growth/plant.h"
#include "growth/shoots.h"

namespace ramify::growth {

/// Voxels in which something begins or ceases to cast shadow.
struct CasterChanges {
  std::vector<Coord> added;
  std::vector<Coord> removed;
};

/// Adds traced shoots to the plant. The buds they grew from are spent; one that was blocked at once dies, for
/// its light would draw resource for ever. Leaves the buds to be sorted when all shoots are built.
void build_shoots(Plant& plant, std::span<const Shoot> shoots, const Traces& traces, const Parameters& world,
                  const TreeParameters& tree, ShadowGrid& shadow, int step, CasterChanges& changes);

/// Puts the buds in the order of their nodes again: a tip with several axillary buds may have put some of
/// them behind buds of later nodes.
void sort_buds(Plant& plant);

/// Buds that have rested for bud_lifespan steps die.
void abort_buds(Plant& plant, const Parameters& world, const TreeParameters& tree, const ShadowGrid& shadow,
                int step, CasterChanges& changes);

}  // namespace ramify::growth
