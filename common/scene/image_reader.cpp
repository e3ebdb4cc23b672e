#include "common/scene/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/image_format.h"
#include "common/scene/pfm.h"

namespace airlight {

struct ImageReader::Input {
  std::unique_ptr<OIIO::ImageInput> file;
  HostImage whole;  // of PFM, which is read without OpenImageIO
};

ImageReader::ImageReader(const std::string& path) : path_(path), input_(std::make_unique<Input>()) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(path + ": no such file");
  if (status.type() == std::filesystem::file_type::directory) throw InputError(path + ": is a directory, expected an image file");
  if (lower_extension(path) == "pfm") {
    input_->whole = decoded_pfm(path, read_file(path, std::uint64_t{1} << 36U));
    extent_ = input_->whole.extent;
    rows_ = {0, extent_.height};
    channels_ = channel_names("", input_->whole.channels);
    return;
  }
  input_->file = OIIO::ImageInput::open(path);
  if (!input_->file) throw InputError(fmt::format("{}: not a readable image: {}", path, one_line(OIIO::geterror())));
  const OIIO::ImageSpec& spec = input_->file->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > 65535 || spec.height > 65535 || spec.nchannels < 1 ||
      spec.nchannels > 64) {
    throw InputError(fmt::format("{}: {} x {} pixels, {} channels; expected 1..65535 a side, 1..64 channels", path, spec.width,
                                 spec.height, spec.nchannels));
  }
  // Some rows of a larger image, or an image by itself, wherever it lies.
  const int top = spec.y - spec.full_y;
  const bool part = spec.x == spec.full_x && spec.width == spec.full_width && top >= 0 && spec.full_height <= 65535 &&
                    top + spec.height <= spec.full_height;
  extent_ = {spec.width, part ? spec.full_height : spec.height};
  rows_ = part ? Rows{top, top + spec.height} : Rows{0, spec.height};
  channels_ = spec.channelnames;
  for (const OIIO::ParamValue& p : spec.extra_attribs) {
    if (p.name().string().starts_with("airlight:")) metadata_[p.name().string()] = p.get_string();
  }
}

ImageReader::~ImageReader() = default;

HostImage ImageReader::read(Rows rows) const {
  if (rows.first < rows_.first || rows.end > rows_.end) throw std::logic_error(path_ + ": rows that are not in the file");
  const auto channels = static_cast<int>(channels_.size());
  HostImage image({extent_.width, rows.count()}, channels);
  if (!input_->file) {
    const HostImage& whole = input_->whole;
    std::copy_n(whole.values.data() + whole.index(0, rows.first), image.values.size(), image.values.data());
    return image;
  }
  const int down = input_->file->spec().y - rows_.first;
  if (!input_->file->read_scanlines(0, 0, rows.first + down, rows.end + down, 0, 0, channels, OIIO::TypeDesc::FLOAT,
                                    image.values.data())) {
    throw InputError(fmt::format("{}: reading failed: {}", path_, one_line(input_->file->geterror())));
  }
  return image;
}

std::vector<ImageLayer> layers_of(const std::vector<std::string>& channels) {
  struct Ranked {
    std::string name;
    std::vector<std::pair<std::size_t, std::size_t>> channels;  // rank, index
  };
  std::vector<Ranked> found;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::string& full = channels[c];
    const std::size_t dot = full.rfind('.');
    const std::string name = dot == std::string::npos ? "" : full.substr(0, dot);
    const std::string channel = dot == std::string::npos ? full : full.substr(dot + 1);
    const std::size_t rank = std::min(std::string_view("RGBAXYZ").find(channel), std::size_t{100} + c);
    auto layer = std::find_if(found.begin(), found.end(), [&](const Ranked& l) { return l.name == name; });
    if (layer == found.end()) layer = found.insert(name.empty() ? found.begin() : found.end(), {name, {}});
    layer->channels.emplace_back(rank, c);
  }
  std::vector<ImageLayer> layers;
  for (Ranked& layer : found) {
    std::sort(layer.channels.begin(), layer.channels.end());
    layers.push_back({layer.name, {}});
    for (const auto& [rank, index] : layer.channels) layers.back().channels.push_back(index);
  }
  return layers;
}

std::vector<NamedImage> images_of(const HostImage& all, const std::vector<ImageLayer>& layers) {
  std::vector<NamedImage> images;
  const auto channels = static_cast<std::size_t>(all.channels);
  for (const ImageLayer& layer : layers) {
    const std::size_t own = layer.channels.size();
    NamedImage named{layer.name, HostImage(all.extent, static_cast<int>(own))};
    for (std::size_t k = 0; k < named.image.values.size(); ++k)
      named.image.values[k] = all.values[k / own * channels + layer.channels[k % own]];
    images.push_back(std::move(named));
  }
  return images;
}

}  // namespace airlight
