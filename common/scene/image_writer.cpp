#include "common/scene/image_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "common/error.h"
#include "common/scene/image_format.h"
#include "common/scene/pfm.h"
#include "common/scene/temporary_file.h"
#include "common/scene/tonemap.h"

namespace airlight {

namespace {

// What OpenImageIO writes, into a temporary file: written by ourselves, so that what a full disk answers is known. It is called
// through C libraries, which no exception may cross.
class FileProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit FileProxy(TemporaryFile& file) : IOProxy("", Write), file_(file) {}
  const char* proxytype() const override { return "airlight"; }
  size_t write(const void* bytes, size_t size) override {
    if (static_cast<std::uint64_t>(m_pos) != begin_ + waiting_.size() || waiting_.size() > most_waiting) flush_waiting();
    if (waiting_.empty()) begin_ = static_cast<std::uint64_t>(m_pos);
    const auto* from = static_cast<const unsigned char*>(bytes);
    waiting_.insert(waiting_.end(), from, from + size);
    m_pos += static_cast<int64_t>(size);
    size_ = std::max(size_, m_pos);
    return failure_ ? 0 : size;
  }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    const int64_t at = m_pos;
    m_pos = offset;
    const size_t written = write(bytes, size);
    m_pos = at;
    return written;
  }
  size_t size() const override { return static_cast<size_t>(size_); }
  // Throws what could not be thrown before.
  void check() {
    flush_waiting();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static constexpr std::size_t most_waiting = std::size_t{1} << 20U;  // small writes are gathered
  void flush_waiting() {
    try {
      if (!failure_ && !waiting_.empty()) file_.write_at(begin_, waiting_.data(), waiting_.size());
    } catch (...) {
      failure_ = std::current_exception();
    }
    waiting_.clear();
  }

  TemporaryFile& file_;
  std::vector<unsigned char> waiting_;
  std::uint64_t begin_ = 0;
  int64_t size_ = 0;
  std::exception_ptr failure_;
};

OIIO::ImageSpec spec_for(const std::string& extension, Extent extent, Rows rows, const std::vector<std::string>& channels,
                         const ImageFileOptions& options) {
  const bool floats = holds_floats(extension);
  OIIO::ImageSpec spec(extent.width, rows.count(), static_cast<int>(channels.size()),
                       floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.y = rows.first;
  spec.full_height = extent.height;
  spec.channelnames = channels;
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

}  // namespace

// One file: its images' channels side by side. Rows wait until there are rows_at_once of them, so that bytes do not depend on how
// many come at a time.
class ImageWriter::File {
 public:
  File(std::string path, std::vector<std::size_t> layers, const std::vector<std::string>& channels, Extent extent, Rows rows,
       const ImageFileOptions& options)
      : images(std::move(layers)),
        path_(std::move(path)),
        extension_(lower_extension(path_)),
        extent_(extent),
        channels_(channels.size()),
        next_(rows.first),
        options_(options),
        file_(path_),
        proxy_(file_) {
    waiting_ = HostImage({extent.width, 0}, static_cast<int>(channels_));
    if (extension_ == "pfm") return;
    output_ = OIIO::ImageOutput::create("image." + extension_);
    if (!output_ || !output_->supports("ioproxy")) {
      throw MachineError(fmt::format("{}: the OpenImageIO of this machine cannot write {} files", path_, extension_));
    }
    output_->set_ioproxy(&proxy_);
    good(output_->open("image." + extension_, spec_for(extension_, extent, rows, channels, options)));
  }
  ~File() {
    if (output_) output_->close();  // while the proxy is there
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& path() const { return path_; }

  void write(std::span<const NamedImage> all) {
    const int rows = all[images[0]].image.extent.height;
    for (int y = 0; y < rows; ++y) {
      const std::size_t at = waiting_.values.size();
      waiting_.values.resize(at + static_cast<std::size_t>(extent_.width) * channels_);
      ++waiting_.extent.height;
      std::size_t first = 0;
      for (const std::size_t k : images) {
        const HostImage& image = all[k].image;
        const auto own = static_cast<std::size_t>(image.channels);
        const float* from = image.values.data() + image.index(0, y);
        for (std::size_t x = 0; x < static_cast<std::size_t>(extent_.width); ++x)
          for (std::size_t c = 0; c < own; ++c) waiting_.values[at + x * channels_ + first + c] = from[x * own + c];
        first += own;
      }
      if ((next_ + waiting_.extent.height) % rows_at_once == 0) write_waiting();
    }
  }

  void close() {
    write_waiting();
    if (output_) {
      const bool closed = output_->close();
      good(closed);
      output_.reset();
    }
    proxy_.check();
  }
  void rename() { file_.rename_to_target(); }

  const std::vector<std::size_t> images;  // positions among the layers

 private:
  void good(bool done) {
    proxy_.check();
    if (!done) throw MachineError(fmt::format("{}: encoding failed: {}", path_, one_line(output_->geterror())));
  }

  void write_waiting() {
    const int rows = waiting_.extent.height;
    if (rows == 0) return;
    if (!output_) {
      write_pfm_rows(file_, waiting_, next_, extent_);
    } else if (holds_floats(extension_)) {
      good(output_->write_scanlines(next_, next_ + rows, 0, OIIO::TypeDesc::FLOAT, waiting_.values.data()));
    } else {
      const std::vector<std::uint8_t> bytes = tone_mapped(waiting_, options_.exposure, options_.tonemap == "reinhard");
      good(output_->write_scanlines(next_, next_ + rows, 0, OIIO::TypeDesc::UINT8, bytes.data()));
    }
    next_ += rows;
    waiting_.extent.height = 0;
    waiting_.values.clear();
  }

  std::string path_, extension_;
  Extent extent_;
  std::size_t channels_;
  int next_;  // row that the first of those that wait is
  ImageFileOptions options_;
  TemporaryFile file_;
  FileProxy proxy_;
  std::unique_ptr<OIIO::ImageOutput> output_;  // none for PFM
  HostImage waiting_;
};

ImageWriter::ImageWriter(const std::string& path, std::span<const Layer> layers, Extent extent, Rows rows,
                         const ImageFileOptions& options)
    : layers_(layers.begin(), layers.end()), path_(path), left_(within(rows, extent.height)) {
  check_image_path(path, options);
  if (layers.empty()) throw InputError(path + ": no image to write");
  if (extent.width < 1 || extent.height < 1 || extent.width > 65535 || extent.height > 65535) {
    throw InputError(fmt::format("{}: an image of {} x {} pixels, expected 1..65535 a side", path, extent.width, extent.height));
  }
  const bool exr = lower_extension(path) == "exr";
  if (left_.count() < extent.height && !exr) throw InputError(path + ": rows of an image, expected an EXR file for them");
  std::vector<std::size_t> images;
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    if (layer.channels != 1 && layer.channels != 3)
      throw InputError(fmt::format("{}: {} channels, expected 1 or 3", path, layer.channels));
    images.push_back(i);
    const std::vector<std::string> names = channel_names(exr && i > 0 ? layer.name : "", layer.channels);
    channels.insert(channels.end(), names.begin(), names.end());
    if (exr && i + 1 < layers_.size()) continue;
    files_.push_back(
        std::make_unique<File>(exr || i == 0 ? path : file_of_image(path, layer.name), images, channels, extent, left_, options));
    images.clear(), channels.clear();
  }
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write(std::span<const NamedImage> images) {
  if (images.size() != layers_.size()) throw std::logic_error("image writer: not as many images as layers");
  const int rows = images[0].image.extent.height;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const HostImage& image = images[i].image;
    if (image.extent.height != rows || image.channels != layers_[i].channels || image.values.size() != image.index(0, rows))
      throw InputError(path_ + ": images of different sizes, or of others than were announced");
  }
  if (rows > left_.count()) throw std::logic_error("image writer: more rows than were announced");
  for (const std::unique_ptr<File>& file : files_) file->write(images);
  left_.first += rows;
}

std::vector<std::string> ImageWriter::finish() {
  if (left_.count() > 0) throw std::logic_error("image writer: rows are missing");
  std::vector<std::string> names;
  for (const std::unique_ptr<File>& file : files_) {
    file->close();
    names.push_back(file->path());
  }
  for (const std::unique_ptr<File>& file : files_) file->rename();
  return names;
}

}  // namespace airlight
