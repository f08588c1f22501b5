// What the machine gives in this hour: virtual machines of one kind differ by more than versions do.
#pragma once

namespace ramify::bench {

/// A line: how quick additions are, one after the other, and lines of memory at random places. It takes half
/// a second and 64 MB.
void print_machine();

}  // namespace ramify::bench
