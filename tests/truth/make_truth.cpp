// Renders the images of tests/data/truth: airlight-truth OUTPUT_FOLDER
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "common/reference/reference.h"
#include "common/scene/content_hash.h"
#include "common/scene/image_file.h"
#include "tests/truth/truth_scenes.h"

namespace {

using namespace airlight;

void write_truth(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  NoProgress progress;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  std::string hashes;
  for (const TruthScene& truth : stored_scenes()) {
    const auto start = std::chrono::steady_clock::now();
    const Scene scene = truth.make();
    const ReferenceFrame frame = reference_frame(scene, stored_extent, stored_settings, false, threads, progress);
    HostImage image(stored_extent, 3);
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        image.values[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(frame.pixels[i].beauty()[c]);
      }
    }
    const std::string name(truth.name);
    write_image((folder / (name + ".pfm")).string(), image, {});
    hashes += name + ' ' + content_hash(scene) + '\n';
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%s: %.1f s, estimated relative error %.1e\n", name.c_str(), seconds.count(), frame.error);
  }
  std::ofstream out(folder / "hashes.txt", std::ios::binary);
  out << hashes;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + (folder / "hashes.txt").string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fputs("usage: airlight-truth OUTPUT_FOLDER\n", stderr);
    return 2;
  }
  try {
    write_truth(argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "airlight-truth: %s\n", e.what());
    return 3;
  }
  return 0;
}
