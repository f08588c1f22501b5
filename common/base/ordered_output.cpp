#include "common/base/ordered_output.h"

#include <algorithm>
#include <ostream>
#include <vector>

#include "common/base/parallel.h"

namespace ramify {
namespace {

// Of one chunk: large enough to be worth a task, small enough to stay in the cache until it is written.
constexpr std::size_t kChunkBytes = 1 << 18;

// Formatted at once, so that all threads have work between two writes.
constexpr std::size_t kChunks = 32;

}  // namespace

void write_rows(std::size_t count, std::size_t row_bytes, std::ostream& out,
                const std::function<void(std::size_t, std::size_t, std::string&)>& format) {
  const std::size_t rows = std::max<std::size_t>(kChunkBytes / row_bytes, 1);
  std::vector<std::string> texts(std::min(kChunks, (count + rows - 1) / rows));
  for (std::size_t begin = 0; begin < count; begin += rows * texts.size()) {
    parallel_for(texts.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t chunk = first; chunk < last; ++chunk) {
        texts[chunk].clear();
        texts[chunk].reserve(rows * row_bytes);
        const std::size_t low = std::min(begin + chunk * rows, count);
        const std::size_t high = std::min(low + rows, count);
        if (low < high) format(low, high, texts[chunk]);
      }
    });
    for (const std::string& text : texts) out.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
}

}  // namespace ramify
