// How often each stage allocates memory for a frame, once its buffers have their sizes, and how much the four
// hold at most: counted where everything passes, OpenCV's images and the C library's own included. What is
// left is bounded here, so that it can only become less.
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "processes/node_factory.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/allocated_bytes.hpp"

namespace {

std::atomic<int64_t> allocations{0};
std::atomic<int64_t> held{0}, most_held{0};  ///< bytes

}  // namespace

#ifndef REDBEE_SANITIZER_ALLOCATES
#include <malloc.h>

namespace {

void* counted(void* memory) {
  ++allocations;
  const int64_t now = held += static_cast<int64_t>(malloc_usable_size(memory));
  if (now > most_held) most_held = now;  // of one thread
  return memory;
}
void leave(void* memory) { held -= static_cast<int64_t>(malloc_usable_size(memory)); }

}  // namespace

// The functions of glibc, counted.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming,readability-inconsistent-declaration-parameter-name)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

void* malloc(size_t size) { return counted(__libc_malloc(size)); }
void* calloc(size_t count, size_t size) { return counted(__libc_calloc(count, size)); }
void* realloc(void* memory, size_t size) {
  leave(memory);
  return counted(__libc_realloc(memory, size));
}
void free(void* memory) {
  leave(memory);
  __libc_free(memory);
}
void* memalign(size_t alignment, size_t size) { return counted(__libc_memalign(alignment, size)); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming,readability-inconsistent-declaration-parameter-name)
#endif

namespace redbee::test {
namespace {

/// Between two passes of this object, by the name of what was done.
class Counter {
 public:
  template <typename Work>
  auto count(const std::string& what, const Work& work) {
    const int64_t before = allocations;
    const auto result = work();
    counts_[what] += allocations - before;
    return result;
  }
  void clear() { counts_.clear(); }
  double perFrame(const std::string& what, int frames) const {
    const auto found = counts_.find(what);
    return found == counts_.end() ? 0 : static_cast<double>(found->second) / frames;
  }

 private:
  std::map<std::string, int64_t> counts_;
};

/// Frames of the bundled flight: the first ones bring the buffers to their sizes.
constexpr int kSettled = 30, kCounted = 30;

struct Flight {
  Counter counter;
  double most_held_mb;  ///< by the four stages together, messages and log included
};

Flight countFlight() {
  const std::filesystem::path source = REDBEE_SOURCE_DIR;
  Configuration configuration = loadConfiguration(source / "config" / "park1.yaml");
  configuration.overlay_period_frames = 0;  // text and JPEG, which a ground station looks at
  const int64_t held_before = held;
  const auto bus = makeLcmBus("memq://");
  std::map<std::string, std::unique_ptr<Node>> nodes;
  for (const ProcessDescription* stage : kStages)
    nodes[programName(*stage)] = makeNode(*stage, *bus, configuration);
  LogReader log(source / "logs" / "park1.lcm");
  Counter counter;
  int frames = 0;
  most_held = 0;
  while (const auto event = log.next()) {
    if (event->channel == configuration.channels.camera && ++frames > kSettled + kCounted) break;
    if (frames == kSettled) counter.clear();
    bus->publish(event->channel, event->data);
    bool is_busy = true;
    while (is_busy) {
      for (const auto& [name, node] : nodes) {
        counter.count(name, [&, n = node.get()] { return n->process(), 0; });
      }
      is_busy = counter.count("messages", [&] { return bus->handle(std::chrono::milliseconds(0)); }) > 0;
    }
  }
  return {counter, static_cast<double>(most_held - held_before) / 1e6};
}

TEST(SteadyState, AllocationsOfAFrameAndMemoryAreBounded) {
#ifdef REDBEE_SANITIZER_ALLOCATES
  GTEST_SKIP() << "the sanitizer has its own allocator";
#endif
  // As measured, and a tenth more.
  const std::map<std::string, double> bounds{{programName(kImuIntegration), 51},
                                             {programName(kVisualHomography), 153},
                                             {programName(kHomographyFusion), 105},
                                             {programName(kMotionSegmentation), 945},
                                             {"messages", 175}};
  const auto [counter, most_held_mb] = countFlight();
  constexpr double kMostHeld_mb = 13.5;
  std::printf("%-20s %.1f MB at most\n", "memory", most_held_mb);
  EXPECT_GT(most_held_mb, 1);
  EXPECT_LE(most_held_mb, kMostHeld_mb);
  for (const auto& [what, bound] : bounds) {
    const double count = counter.perFrame(what, kCounted);
    std::printf("%-20s %.0f allocations a frame\n", what.c_str(), count);
    EXPECT_GT(count, 0) << what;
    EXPECT_LE(count, bound) << what;
  }
}

}  // namespace
}  // namespace redbee::test
