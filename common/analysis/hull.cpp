#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "common/analysis/measures.h"

// The header of the C library knows nothing of our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#pragma GCC diagnostic pop

namespace ramify {
namespace {

/// Qhull's state, given back whatever happens.
class Qhull {
 public:
  Qhull() { qh_zero(&state_, nullptr); }
  ~Qhull() {
    int left = 0;
    int bytes = 0;
    qh_freeqhull(&state_, !qh_ALL);
    qh_memfreeshort(&state_, &left, &bytes);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  qhT* get() { return &state_; }

 private:
  qhT state_;
};

}  // namespace

std::optional<double> hull_volume(const Anatomy& stem) {
  if (stem.tips().size() < 4) return std::nullopt;
  std::vector<double> coordinates;
  coordinates.reserve(3 * stem.tips().size());
  for (const std::uint32_t tip : stem.tips()) {
    const Vec3& p = stem.skeleton().position[tip];
    coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  }
  // Qhull tells of flat input on a stream it must be given.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> silence(std::fopen("/dev/null", "w"), &std::fclose);
  if (!silence) return std::nullopt;
  Qhull qhull;
  char command[] = "qhull FA Pp";  // compute the volume; no warnings about narrow hulls
  const int failed = qh_new_qhull(qhull.get(), 3, static_cast<int>(stem.tips().size()), coordinates.data(),
                                  False, command, nullptr, silence.get());
  if (failed != 0) return std::nullopt;
  return qhull.get()->totvol;
}

}  // namespace ramify
