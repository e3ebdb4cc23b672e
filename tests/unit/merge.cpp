// Tiles put together: the bytes of a picture written at once, in every format; and what is no picture is refused.
#include "common/scene/merge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/error.h"
#include "common/scene/image_writer.h"
#include "tests/parity/inputs.h"
#include "tests/unit/scene_folder.h"

namespace airlight {

namespace {

constexpr Extent extent{30, 200};
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Rows of a picture of that many images, of values that no predictor of a format tells.
std::vector<NamedImage> picture(Rows rows, Extent of = extent, int images = 2) {
  std::vector<NamedImage> all;
  for (int k = 0; k < images; ++k) {
    NamedImage one{k == 0 ? "beauty" : "airlight", HostImage({of.width, rows.count()}, 3)};
    for (std::size_t i = 0; i < one.image.values.size(); ++i) {
      const auto at = static_cast<std::uint32_t>(i + one.image.index(0, rows.first));
      one.image.values[i] = static_cast<float>(uniform(static_cast<std::uint32_t>(k), at) + 0.01 * (at % 7));
    }
    all.push_back(std::move(one));
  }
  return all;
}

class Merge : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder.file(name); }
  // Rows of a tile, five at a time.
  void tile(const std::string& name, Rows rows, Metadata told = {{"airlight:scene", "a"}}, Extent of = extent, int images = 2) {
    ImageFileOptions options;
    options.metadata = std::move(told);
    options.metadata.emplace_back(tile_key, name);
    std::vector<ImageWriter::Layer> layers{{"beauty", 3}, {"airlight", 3}};
    layers.resize(static_cast<std::size_t>(images));
    ImageWriter writer(path(name), layers, of, rows, options);
    for (int y = rows.first; y < rows.end; y += 5) writer.write(picture({y, std::min(y + 5, rows.end)}, of, images));
    writer.finish();
  }
  void refused(const std::vector<std::string>& names, const std::string& part) {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back(path(name));
    const std::size_t files = folder.entries();
    NoProgress progress;
    try {
      merge_tiles(paths, path("m.exr"), {}, progress);
      ADD_FAILURE() << "not refused: " << part;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what() << ", expected " << part;
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
    EXPECT_EQ(folder.entries(), files);
  }
  Folder folder;
};

TEST_F(Merge, GivesTheBytesOfAPictureWrittenAtOnce) {
  tile("a.exr", {0, 64});
  tile("b.exr", {64, 131});
  tile("c.exr", {131, 200});
  const std::vector<std::string> tiles{path("b.exr"), path("c.exr"), path("a.exr")};
  for (const std::string extension : {"exr", "png", "pfm", "tif", "hdr", "jpg", "bmp", "tga", "ppm"}) {
    ImageFileOptions options;
    options.exposure = 0.5;
    options.tonemap = "reinhard";
    NoProgress progress;
    const auto merged = merge_tiles(tiles, path("m." + extension), options, progress);
    options.metadata = {{"airlight:scene", "a"}};
    const auto expected = write_images(path("one." + extension), picture({0, 200}), options);
    ASSERT_EQ(merged.size(), expected.size());
    for (std::size_t i = 0; i < merged.size(); ++i) {
      EXPECT_GT(bytes_of(expected[i]).size(), 1000U);
      EXPECT_TRUE(bytes_of(merged[i]) == bytes_of(expected[i])) << merged[i];
    }
  }
}

TEST_F(Merge, RefusesWhatIsNotOnePicture) {
  tile("a.exr", {0, 128});
  tile("b.exr", {128, 200});
  tile("early.exr", {120, 200});
  tile("late.exr", {140, 200});
  tile("inside.exr", {10, 20});
  tile("scene.exr", {128, 200}, {{"airlight:scene", "b"}});
  tile("set.exr", {128, 200}, {{"airlight:scene", "a"}, {"airlight:set:samples", "3"}});
  tile("size.exr", {128, 201}, {{"airlight:scene", "a"}}, {30, 201});
  tile("images.exr", {128, 200}, {{"airlight:scene", "a"}}, extent, 1);
  write_images(path("whole.exr"), picture({0, 200}), {});
  refused({"a.exr"}, "rows 128 to 199 of 200 are in no tile");
  refused({"b.exr"}, "rows 0 to 127 of 200 are in no tile");
  refused({"a.exr", "late.exr"}, "rows 128 to 139 of 200 are in no tile");
  refused({"a.exr", "early.exr"}, "early.exr: rows 120 to 127 are in " + path("a.exr"));
  refused({"a.exr", "inside.exr", "b.exr"}, "inside.exr: rows 10 to 19 are in " + path("a.exr"));
  refused({"a.exr", "b.exr", "b.exr"}, "b.exr: rows 128 to 199 are in ");
  refused({"a.exr", "scene.exr"}, "scene.exr: of another scene than " + path("a.exr") + ": b, expected a");
  refused({"a.exr", "set.exr"}, "set.exr: of another samples than " + path("a.exr") + ": 3, expected none");
  refused({"a.exr", "size.exr"}, "size.exr: of another size than " + path("a.exr") + ": 30 x 201, expected 30 x 200");
  refused({"a.exr", "images.exr"}, "images.exr: has other images than " + path("a.exr"));
  refused({"a.exr", "whole.exr"}, "whole.exr: is not a tile");
  refused({"a.exr", "none.exr"}, "none.exr: no such file");
  refused({}, "no tiles");
  // Wherever it ends.
  const std::string bytes = bytes_of(path("b.exr"));
  for (const double share : {0.0, 0.01, 0.3, 0.6, 0.9, 0.999}) {
    folder.write("cut.exr", bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    refused({"a.exr", "cut.exr"}, "cut.exr: ");
  }
}

TEST_F(Merge, RowsAreOfEXRAlone) {
  const ImageWriter::Layer layer{"beauty", 3};
  EXPECT_THROW(ImageWriter(path("a.png"), std::span(&layer, 1), extent, {0, 10}, {}), InputError);
  EXPECT_EQ(folder.entries(), 0U);
}

}  // namespace

}  // namespace airlight
