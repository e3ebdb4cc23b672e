// Image files written a band of rows after the other: no more of them is in memory than one band.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/image.h"
#include "common/rows.h"
#include "common/scene/image_file.h"

namespace airlight {

class ImageWriter {
 public:
  struct Layer {
    std::string name;  // of the image; that of the first is not told in the file
    int channels;      // 1 or 3
  };

  // What write_images() makes of images of that extent, of which `rows` will be written: fewer than all in EXR alone, as its data
  // window. The bytes do not depend on how rows are cut into bands. Throws as write_images() does.
  ImageWriter(const std::string& path, std::span<const Layer>, Extent, Rows rows, const ImageFileOptions&);
  ~ImageWriter();
  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;

  // The next rows from the top, of each image in the order of the layers. Throws MachineError when the disk is full.
  void write(std::span<const NamedImage>);

  // Gives the files their names, once all rows are there, and returns these. Without it nothing stays.
  std::vector<std::string> finish();

 private:
  class File;
  std::vector<std::unique_ptr<File>> files_;
  std::vector<Layer> layers_;
  std::string path_;
  Rows left_;
};

}  // namespace airlight
