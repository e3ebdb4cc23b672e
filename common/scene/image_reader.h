// Image files read a band of rows after the other.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/image.h"
#include "common/rows.h"

namespace airlight {

class ImageReader {
 public:
  // Throws InputError for a file that is missing or no image.
  explicit ImageReader(const std::string& path);
  ~ImageReader();
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;

  Extent extent() const { return extent_; }  // of the whole image
  Rows rows() const { return rows_; }        // of it that are in the file: fewer than all in EXR alone
  const std::vector<std::string>& channels() const { return channels_; }
  // What airlight has told of the image, by name: "airlight:scene" and others.
  const std::map<std::string, std::string>& metadata() const { return metadata_; }

  // All channels as 32-bit floats; the rows must be there. Throws InputError where the file ends before or is damaged.
  HostImage read(Rows) const;

 private:
  struct Input;
  std::string path_;
  std::unique_ptr<Input> input_;
  Extent extent_;
  Rows rows_;
  std::vector<std::string> channels_;
  std::map<std::string, std::string> metadata_;
};

// Which channels of a file belong to which of its images: "NAME.R" to NAME, those without a dot to "", which comes first.
// R G B X Y Z come in this order.
struct ImageLayer {
  std::string name;
  std::vector<std::size_t> channels;
};
std::vector<ImageLayer> layers_of(const std::vector<std::string>& channels);

// The images of rows of a file.
std::vector<NamedImage> images_of(const HostImage& all, const std::vector<ImageLayer>&);

}  // namespace airlight
