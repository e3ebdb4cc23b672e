#include "app/tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/sequence.h"
#include "common/plan/rows.h"

namespace airlight {

TileNumber tile_of(const std::string& text) {
  TileNumber tile;
  int used = 0;
  if (std::sscanf(text.c_str(), "%5d/%5d%n", &tile.number, &tile.count, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || tile.number < 1 || tile.count < tile.number) {
    throw InputError("--tile: expected NUMBER/COUNT, as 2/8 for the second of eight, found \"" + text + "\"");
  }
  return tile;
}

Rows rows_of(const std::optional<TileNumber>& tile, int height) {
  if (!tile) return {0, height};
  if (tile->count > height)
    throw InputError(
        fmt::format("--tile: expected at most {} tiles, as many as the image has rows, found {}", height, tile->count));
  return band_of(tile->number, tile->count, height);
}

std::string tile_name(const std::string& output, TileNumber tile) {
  const std::filesystem::path whole(output);
  return (whole.parent_path() / whole.stem()).string() + fmt::format(".tile-{}-of-{}.exr", tile.number, tile.count);
}

std::string shell_word(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_./=:,+%@-").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

int print_plan(const PlanCommand& c) {
  SceneFile file(c.render.scene);
  const std::vector<int> frames = frames_of(c.render, file);
  check_image_path(c.render.output, c.render.file);
  if (c.tiles < 1) throw InputError("--tiles: expected 1 or more");
  std::string all;
  const std::string program = shell_word(c.program);
  for (const int frame : frames) {
    const std::string output = output_name(c.render, c.render.output, frame);
    const auto name = [&](int tile) { return c.tiles == 1 ? output : tile_name(output, {tile, c.tiles}); };
    if (c.merge) {
      if (c.tiles == 1) throw InputError("--merge: there is nothing to merge of one tile, expected --tiles 2 or more");
      all += program + " merge";
      for (int tile = 1; tile <= c.tiles; ++tile) all += fmt::format(" {}", shell_word(name(tile)));
      all += " -o " + shell_word(output) + c.merge_options + "\n";
      continue;
    }
    for (int tile = 1; tile <= c.tiles; ++tile) {
      all += program + " render " + shell_word(c.render.scene);
      if (!c.render.frames.empty()) all += fmt::format(" --frames {}", frame);
      if (c.tiles > 1) all += fmt::format(" --tile {}/{}", tile, c.tiles);
      all += " -o " + shell_word(name(tile)) + " --resume" + (c.tiles == 1 ? c.merge_options : "") + c.options + "\n";
    }
  }
  fmt::print("{}", all);
  return 0;
}

}  // namespace airlight
