// What it takes until smooth closest points can be asked for, from a file on the disk:
//   load_bench FILE.mimicry ...
// Each step on its own, the least and the median of nine, on one thread, the file in the page
// cache; beside it, in the same run, what the system takes to hand out as much memory as the
// projector holds, which no loader can do without.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/embedding_file.h>

#include "base/large_vector.h"
#include "files/file.h"

namespace {

using namespace mimicry;

class Timer {
 public:
  explicit Timer(std::vector<double>& ms) : ms_(ms) {}
  ~Timer() {
    ms_.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
            .count());
  }

 private:
  std::vector<double>& ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void print(const char* step, std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  std::printf("  %-34s least %7.1f  median %7.1f ms\n", step, ms.front(), ms[ms.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string file = argv[i];
    std::vector<double> parse, target, projector, all, memory_alone;
    std::size_t bytes = 0, memory = 0;
    for (int pass = 0; pass < 9; ++pass) {
      std::optional<Embedding> e;
      std::optional<Target> t;
      std::optional<SmoothProjector> p;
      {
        const Timer timer(parse);
        const MappedFile content(file);
        bytes = content.bytes().size();
        e = read_embedding(content.bytes(), file);
      }
      {
        const Timer timer(target);
        t.emplace(mesh_of(*e));
      }
      {
        const Timer timer(projector);
        p.emplace(std::move(*e), *t);
      }
      memory = p->memory_bytes();
      {
        const Timer timer(memory_alone);
        const LargeVector<char> fresh(memory);
      }
      all.push_back(parse.back() + projector.back());
    }
    std::printf("%s: %.1f MB, the projector holds %.1f MB\n", file.c_str(), 1e-6 * double(bytes),
                1e-6 * double(memory));
    print("map, checksum, check and copy", parse);
    print("projector", projector);
    print("the load: these two", all);
    print("memory alone: filled with zeros", memory_alone);
    print("target (the mesh's own)", target);
  }
  return 0;
}
