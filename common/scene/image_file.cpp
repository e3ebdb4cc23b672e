#include "common/scene/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/pfm.h"
#include "common/scene/temporary_file.h"
#include "common/scene/tonemap.h"

namespace airlight {

namespace {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string lower_extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return e.empty() ? e : e.substr(1);
}

// Formats that hold 32-bit floats, and those of 8 bits that get a tone map. Others would need a decision of their own.
bool holds_floats(const std::string& extension) {
  static const std::set<std::string> known{"exr", "pfm", "tif", "tiff", "hdr"};
  return known.contains(extension);
}
bool holds_bytes(const std::string& extension) {
  static const std::set<std::string> known{"png", "jpg", "jpeg", "bmp", "tga", "ppm"};
  return known.contains(extension);
}

// An image with a name for each channel.
struct Channels {
  HostImage image;
  std::vector<std::string> names;
};

std::vector<std::string> channel_names(const std::string& layer, int channels) {
  const std::string before = layer.empty() ? "" : layer + ".";
  if (channels == 1) return {before + "Y"};
  return {before + "R", before + "G", before + "B"};
}

// All that tells what the pixels come from; tone-mapped ones of more than floats.
std::vector<std::pair<std::string, std::string>> metadata_of(const std::string& extension, const ImageFileOptions& options) {
  auto all = options.metadata;
  if (holds_floats(extension)) return all;
  all.emplace_back("airlight:exposure", fmt::format("{}", options.exposure));
  all.emplace_back("airlight:tonemap", options.tonemap);
  return all;
}

// Of an image that is not the first, in formats of one image a file.
std::string file_of_image(const std::string& path, const std::string& image) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / whole.stem()).string() + "." + image + whole.extension().string();
}

OIIO::ImageSpec spec_for(const Channels& content, const std::string& extension, const ImageFileOptions& options) {
  const bool floats = holds_floats(extension);
  const HostImage& image = content.image;
  OIIO::ImageSpec spec(image.extent.width, image.extent.height, image.channels,
                       floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.channelnames = content.names;
  spec.attribute("oiio:ColorSpace", floats ? "Linear" : "sRGB");
  // OpenImageIO stores the time of day (DateTime, EXR's capDate) unless there is one; Software would tell its version.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  spec.attribute("Software", "airlight");
  if (extension == "exr") spec.attribute("compression", "zip");
  if (extension == "png") spec.attribute("png:compressionLevel", 6);
  if (extension == "jpg" || extension == "jpeg") spec.attribute("Compression", "jpeg:95");
  for (const auto& [name, value] : metadata_of(extension, options)) spec.attribute(name, value);
  return spec;
}

void check(const std::string& path, const HostImage& image) {
  if (image.extent.width < 1 || image.extent.height < 1 || image.extent.width > 65535 || image.extent.height > 65535) {
    throw InputError(
        fmt::format("{}: an image of {} x {} pixels, expected 1..65535 a side", path, image.extent.width, image.extent.height));
  }
  if (image.channels != 1 && image.channels != 3)
    throw InputError(fmt::format("{}: {} channels, expected 1 or 3", path, image.channels));
  if (image.values.size() != image.index(0, image.extent.height))
    throw InputError(path + ": the image has not as many values as its size says");
}

// The whole file in memory: written by ourselves, so that what a full disk answers is known.
std::vector<unsigned char> encoded(const std::string& path, const Channels& content, const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  const HostImage& image = content.image;
  if (extension == "pfm") return encoded_pfm(image);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("image." + extension);
  if (!output || !output->supports("ioproxy")) {
    throw MachineError(fmt::format("{}: the OpenImageIO of this machine cannot write {} files", path, extension));
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  bool good = output->open("image." + extension, spec_for(content, extension, options));
  if (holds_floats(extension)) {
    good = good && output->write_image(OIIO::TypeDesc::FLOAT, image.values.data());
  } else {
    good = good &&
           output->write_image(OIIO::TypeDesc::UINT8, tone_mapped(image, options.exposure, options.tonemap == "reinhard").data());
  }
  good = output->close() && good;
  if (!good) throw MachineError(fmt::format("{}: encoding failed: {}", path, one_line(output->geterror())));
  return bytes;
}

}  // namespace

void check_image_path(const std::string& path, const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  if (!holds_floats(extension) && !holds_bytes(extension)) {
    throw InputError(
        fmt::format("{}: unknown image format \"{}\", expected exr, pfm, tif, hdr, png, jpg, bmp, tga or ppm", path, extension));
  }
  if (options.tonemap != "clip" && options.tonemap != "reinhard") {
    throw InputError(fmt::format("unknown tone map \"{}\", expected clip or reinhard", options.tonemap));
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path + ": is a directory, expected a file name");
  if (!std::filesystem::is_directory(folder_of(path), error)) throw InputError(path + ": there is no folder " + folder_of(path));
}

void write_image(const std::string& path, const HostImage& image, const ImageFileOptions& options) {
  const NamedImage only{"", image};
  write_images(path, std::span(&only, 1), options);
}

std::vector<std::string> write_images(const std::string& path, std::span<const NamedImage> images,
                                      const ImageFileOptions& options) {
  check_image_path(path, options);
  if (images.empty()) throw InputError(path + ": no image to write");
  for (const NamedImage& i : images) {
    check(path, i.image);
    if (!(i.image.extent == images[0].image.extent)) throw InputError(path + ": images of different sizes");
  }
  struct Output {
    std::string name;
    Channels content;
    std::unique_ptr<TemporaryFile> file;
  };
  std::vector<Output> outputs;
  if (lower_extension(path) == "exr") {
    Channels all;
    for (const NamedImage& i : images) {
      const std::vector<std::string> names = channel_names(all.names.empty() ? "" : i.name, i.image.channels);
      all.names.insert(all.names.end(), names.begin(), names.end());
    }
    const auto channels = all.names.size();
    all.image = HostImage(images[0].image.extent, static_cast<int>(channels));
    std::size_t first = 0;
    for (const NamedImage& i : images) {
      const auto own = static_cast<std::size_t>(i.image.channels);
      for (std::size_t k = 0; k < i.image.values.size(); ++k)
        all.image.values[k / own * channels + first + k % own] = i.image.values[k];
      first += own;
    }
    outputs.push_back({path, std::move(all), nullptr});
  } else {
    for (const NamedImage& i : images) {
      const std::string name = outputs.empty() ? path : file_of_image(path, i.name);
      outputs.push_back({name, {i.image, channel_names("", i.image.channels)}, nullptr});
    }
  }
  // First: a folder that cannot be written should not cost the encoding.
  for (Output& o : outputs) o.file = std::make_unique<TemporaryFile>(o.name);
  std::vector<std::string> names;
  for (const Output& o : outputs) {
    const std::vector<unsigned char> bytes = encoded(o.name, o.content, options);
    o.file->write(bytes.data(), bytes.size());
    names.push_back(o.name);
  }
  for (const Output& o : outputs) o.file->rename_to_target();
  return names;
}

namespace {

Channels read_channels(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw InputError(path + ": no such file");
  if (status.type() == std::filesystem::file_type::directory) throw InputError(path + ": is a directory, expected an image file");
  if (lower_extension(path) == "pfm") {
    HostImage image = decoded_pfm(path, read_file(path, std::uint64_t{1} << 36U));
    const int count = image.channels;
    return {std::move(image), channel_names("", count)};
  }
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input) throw InputError(fmt::format("{}: not a readable image: {}", path, one_line(OIIO::geterror())));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > 65535 || spec.height > 65535 || spec.nchannels < 1 ||
      spec.nchannels > 64) {
    throw InputError(fmt::format("{}: {} x {} pixels, {} channels; expected 1..65535 a side, 1..64 channels", path, spec.width,
                                 spec.height, spec.nchannels));
  }
  HostImage image({spec.width, spec.height}, spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.values.data())) {
    throw InputError(fmt::format("{}: reading failed: {}", path, one_line(input->geterror())));
  }
  return {std::move(image), spec.channelnames};
}

}  // namespace

HostImage read_image(const std::string& path) { return read_channels(path).image; }

std::vector<NamedImage> read_images(const std::string& path) {
  const Channels content = read_channels(path);
  struct Layer {
    std::string name;
    std::vector<std::pair<std::size_t, std::size_t>> channels;  // rank, index
  };
  std::vector<Layer> layers;
  for (std::size_t c = 0; c < content.names.size(); ++c) {
    const std::string& full = content.names[c];
    const std::size_t dot = full.rfind('.');
    const std::string name = dot == std::string::npos ? "" : full.substr(0, dot);
    const std::string channel = dot == std::string::npos ? full : full.substr(dot + 1);
    const std::size_t rank = std::min(std::string_view("RGBAXYZ").find(channel), std::size_t{100} + c);
    auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    if (layer == layers.end()) layer = layers.insert(name.empty() ? layers.begin() : layers.end(), {name, {}});
    layer->channels.emplace_back(rank, c);
  }
  std::vector<NamedImage> images;
  const auto all = static_cast<std::size_t>(content.image.channels);
  for (Layer& layer : layers) {
    std::sort(layer.channels.begin(), layer.channels.end());
    NamedImage named{layer.name, HostImage(content.image.extent, static_cast<int>(layer.channels.size()))};
    const std::size_t own = layer.channels.size();
    for (std::size_t k = 0; k < named.image.values.size(); ++k) {
      named.image.values[k] = content.image.values[k / own * all + layer.channels[k % own].second];
    }
    images.push_back(std::move(named));
  }
  return images;
}

namespace {

// What the file says of itself in keys of ours.
std::map<std::string, std::string> read_metadata(const std::string& path) {
  std::map<std::string, std::string> all;
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input) return all;  // PFM, which is read without OpenImageIO, has none
  for (const OIIO::ParamValue& p : input->spec().extra_attribs) {
    if (p.name().string().starts_with("airlight:")) all[p.name().string()] = p.get_string();
  }
  return all;
}

}  // namespace

std::string difference_from_written(const std::string& path, std::span<const std::string> images, Extent extent,
                                    const ImageFileOptions& options) {
  const std::string extension = lower_extension(path);
  const bool one_file = extension == "exr";
  const auto expected = metadata_of(extension, options);
  for (std::size_t k = 0; k < (one_file ? 1 : images.size()); ++k) {
    const std::string file = k == 0 ? path : file_of_image(path, images[k]);
    std::vector<NamedImage> there;
    try {
      there = read_images(file);
    } catch (const InputError& e) {
      return e.what();
    }
    const auto has = [&](const std::string& name) {
      return std::any_of(there.begin(), there.end(), [&](const NamedImage& i) { return i.name == name; });
    };
    if (!(there[0].image.extent == extent)) return file + ": of another size";
    if (one_file && (there.size() != images.size() || !std::all_of(images.begin() + 1, images.end(), has)))
      return file + ": of other images";
    const std::map<std::string, std::string> metadata = read_metadata(file);
    if (metadata.empty()) continue;
    for (const auto& [name, value] : expected) {
      const auto found = metadata.find(name);
      if (found == metadata.end() || found->second != value)
        return fmt::format("{}: of another {}", file, name.substr(name.rfind(':') + 1));
    }
  }
  return "";
}

}  // namespace airlight
