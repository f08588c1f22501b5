// What stands out at the points of axes, looked for at four of them at a time. Along most twigs of a tree
// nothing does: they need no closer look.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/base/geometry.h"

namespace ramify {

struct Axes;

// Points nearer than this, in diameters, would make rings that cut into each other where thick wood bends in
// short internodes; nodes between stay well inside the wood.
constexpr float kLeastSpacing = 0.75f;

// From ring to ring a line turns by no more.
constexpr auto kTurnMax = static_cast<float>(radians(18.0));

// Cosine beyond which a turn is sharp: rings in it would lean too much to both sides, and arcs have seldom
// room.
constexpr float kSharp = -0.5f;

// How far a tip, round or a cone, reaches beyond its last node, in radii.
constexpr float kTipLength = 1.0f;

// In radii of a lateral: its first knot is so far outside its parent, so that its collar has room.
constexpr float kClear = 1.2f;

// In radii of a parent: what is farther from its node, and clear of it there, is not in its wood.
constexpr float kNear = 3.0f;

/// Bits. At an axis's first point only kIsLow is looked for, at its last nothing that is about a turn.
/// kIsCrowded, kBends and kIsNear may also mark what only just does not.
enum PointMark : std::uint8_t {
  kIsCrowded = 1,  // too near to the point before
  kBends = 2,      // by more than kTurnMax
  kTurnsBack = 4,  // sharply
  kIsLow = 8,      // reaches down to the ground
  kIsNear = 16     // of a lateral's first node: may be in its bearer's wood
};

// So many marks can be read behind that of the last point.
constexpr std::size_t kMarksBehind = 7;

/// Makes room for the marks of all points; those behind the last are none.
void resize_marks(Axes& axes);

/// Marks the points of axes.list[begin], ..., axes.list[end - 1]. O(points).
void mark_points(Axes& axes, std::size_t begin, std::size_t end);

}  // namespace ramify
