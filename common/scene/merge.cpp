#include "common/scene/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common/error.h"
#include "common/scene/image_format.h"
#include "common/scene/image_reader.h"
#include "common/scene/image_writer.h"

namespace airlight {

namespace {

struct Tile {
  std::string path;
  Extent extent;
  Rows rows;
  std::vector<std::string> channels;
  std::map<std::string, std::string> metadata;  // without tile_key
};

Tile tile_of(const std::string& path) {
  const ImageReader file(path);
  Tile tile{path, file.extent(), file.rows(), file.channels(), file.metadata()};
  if (tile.metadata.erase(std::string(tile_key)) == 0)
    throw InputError(path + ": is not a tile, expected a file of airlight render --tile");
  return tile;
}

// Throws where they cannot be of one picture.
void compare(const Tile& a, const Tile& b) {
  const auto other = [&](std::string_view what, const std::string& of_b, const std::string& of_a) {
    throw InputError(fmt::format("{}: of another {} than {}: {}, expected {}", b.path, what, a.path, of_b, of_a));
  };
  const auto size = [](Extent e) { return fmt::format("{} x {}", e.width, e.height); };
  const auto value = [](const Tile& t, const std::string& key) {
    const auto found = t.metadata.find(key);
    return found == t.metadata.end() ? std::string("none") : found->second;
  };
  auto keys = a.metadata;
  keys.insert(b.metadata.begin(), b.metadata.end());
  for (const auto& [key, text] : keys) {
    if (value(a, key) != value(b, key)) other(key.substr(key.rfind(':') + 1), value(b, key), value(a, key));
  }
  if (!(a.extent == b.extent)) other("size", size(b.extent), size(a.extent));
  if (a.channels != b.channels) throw InputError(fmt::format("{}: has other images than {}", b.path, a.path));
}

// Sorts them from the top, and throws where they do not cover the picture once.
void sort_and_cover(std::vector<Tile>& tiles) {
  std::stable_sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) { return a.rows.first < b.rows.first; });
  const int height = tiles[0].extent.height;
  const auto missing = [&](int first, int end) {
    throw InputError(fmt::format("{}: rows {} to {} of {} are in no tile that was given", tiles[0].path, first, end - 1, height));
  };
  int at = 0;
  const Tile* before = nullptr;
  for (const Tile& tile : tiles) {
    if (tile.rows.first > at) missing(at, tile.rows.first);
    if (before && tile.rows.first < at) {
      throw InputError(fmt::format("{}: rows {} to {} are in {}, too", tile.path, tile.rows.first,
                                   std::min(at, tile.rows.end) - 1, before->path));
    }
    at = tile.rows.end;
    before = &tile;
  }
  if (at < height) missing(at, height);
}

}  // namespace

std::vector<std::string> merge_tiles(std::span<const std::string> paths, const std::string& output, const ImageFileOptions& asked,
                                     Progress& progress) {
  check_image_path(output, asked);
  std::vector<Tile> tiles;
  for (const std::string& path : paths) {
    tiles.push_back(tile_of(path));
    compare(tiles[0], tiles.back());
  }
  if (tiles.empty()) throw InputError(output + ": no tiles to merge");
  sort_and_cover(tiles);

  ImageFileOptions options = asked;
  options.metadata.assign(tiles[0].metadata.begin(), tiles[0].metadata.end());
  const Extent extent = tiles[0].extent;
  const std::vector<ImageLayer> layers = layers_of(tiles[0].channels);
  std::vector<ImageWriter::Layer> images;
  images.reserve(layers.size());
  for (const ImageLayer& layer : layers) images.push_back({layer.name, static_cast<int>(layer.channels.size())});
  ImageWriter writer(output, images, extent, {}, options);
  for (const Tile& tile : tiles) {
    const ImageReader file(tile.path);
    if (!(file.extent() == extent) || !(file.rows() == tile.rows) || file.channels() != tile.channels)
      throw InputError(tile.path + ": has changed meanwhile");
    for (int y = tile.rows.first; y < tile.rows.end; y += rows_at_once) {
      progress.check();
      progress.report("merging", static_cast<double>(y) / extent.height);
      writer.write(images_of(file.read({y, std::min(y + rows_at_once, tile.rows.end)}), layers));
    }
  }
  return writer.finish();
}

}  // namespace airlight
