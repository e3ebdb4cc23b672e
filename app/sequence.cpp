#include "app/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "common/scene/frame_pattern.h"

namespace airlight {

namespace {

// Takes a whole number off the front of the text: -1 where there is none up to last_frame.
int take_number(std::string_view& text) {
  int v = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc() && v >= 0 && v <= last_frame ? v : -1;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::vector<int> frame_numbers(const std::string& asked, const std::optional<FrameRange>& all) {
  FrameRange range = all.value_or(FrameRange{});
  int step = 1;
  if (asked != "all" || !all) {
    std::string_view text = asked;
    range.first = range.last = take_number(text);
    if (take(text, '-')) {
      range.last = take_number(text);
      if (take(text, 'x')) step = take_number(text);
    }
    if (!text.empty() || range.first < 0 || range.last < range.first || step < 1) {
      throw InputError(fmt::format("--frames: expected 12, 0-47, 0-47x4 (every fourth){}, up to {}, found \"{}\"",
                                   all ? " or all" : "", last_frame, asked));
    }
  }
  std::vector<int> frames;
  for (int frame = range.first; frame <= range.last; frame += step) frames.push_back(frame);
  return frames;
}

std::vector<int> frames_of(const RenderCommand& c, SceneFile& file) {
  if (c.frames.empty()) return {file.frames().first};
  if (!file.animated()) throw InputError(c.scene + ": has no \"animation\", expected one for --frames");
  std::vector<int> frames = frame_numbers(c.frames, file.frames());
  for (const std::string& name : {c.output, c.stats_file}) {
    if (frames.size() == 1 || name.empty() || has_frame_pattern(name)) continue;
    throw InputError(fmt::format("{}: no place for the number of the frame, expected a name such as frame.####.exr", name));
  }
  for (const int frame : frames) file.check(frame);
  return frames;
}

std::string output_name(const RenderCommand& c, const std::string& name, int frame) {
  return c.frames.empty() ? name : with_frame(name, frame);
}

bool is_there(const std::string& output, const std::vector<std::string>& images, Extent extent, Rows rows,
              const ImageFileOptions& file, Terminal& terminal) {
  std::error_code error;
  if (!std::filesystem::exists(output, error)) return false;
  const std::string difference = difference_from_written(output, images, extent, rows, file);
  if (difference.empty()) {
    terminal.log(LogLevel::info, output + ": kept");
  } else {
    terminal.log(LogLevel::warning, difference + "; rendered anew");
  }
  return difference.empty();
}

void SequenceProgress::begin(int frame) {
  begin_ = std::chrono::steady_clock::now();
  if (frames_ == 1) return;
  title_ = fmt::format("frame {}, {} of {}", frame, done_ + 1, frames_);
  if (rendered_ == 0) return;
  const auto left = std::lround(seconds_ / static_cast<double>(rendered_) * static_cast<double>(frames_ - done_));
  title_ += fmt::format(", about {}:{:02}:{:02} left", left / 3600, left / 60 % 60, left % 60);
}

void SequenceProgress::end(bool rendered) {
  ++done_;
  if (!rendered) return;
  ++rendered_;
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void SequenceProgress::report(std::string_view what, double fraction) {
  below_.report(title_.empty() ? std::string(what) : fmt::format("{}: {}", title_, what), fraction);
}

}  // namespace airlight
