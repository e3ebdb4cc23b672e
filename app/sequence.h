// The frames of an animation, one after the other.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/command.h"

namespace airlight {

// The frames that the command asks for, each checked as far as its files' names; with several, names of outputs must have a #.
std::vector<int> frames_of(const RenderCommand&, SceneFile&);

// The frames of "12", "0-47", "0-47x4" (every fourth) or, where there are any, "all".
std::vector<int> frame_numbers(const std::string& asked, const std::optional<FrameRange>& all);

// An output's name for one of them.
std::string output_name(const RenderCommand&, const std::string& name, int frame);

// For --resume: whether the files of a frame are as write_images() would leave them. Logs that they are kept, or what is wrong
// with those that are not.
bool is_there(const std::string& output, const std::vector<std::string>& images, Extent, Rows, const ImageFileOptions&,
              Terminal&);

// Tells beside what is being done which frame it is for, and about how long all of them will take.
class SequenceProgress final : public Progress {
 public:
  // One frame alone: says nothing of frames.
  SequenceProgress(Progress& below, std::size_t frames) : below_(below), frames_(frames) {}

  void begin(int frame);
  void end(bool rendered);
  void report(std::string_view what, double fraction) override;
  bool stop_requested() const override { return below_.stop_requested(); }

 private:
  Progress& below_;
  std::size_t frames_, done_ = 0, rendered_ = 0;
  std::chrono::steady_clock::time_point begin_{};
  double seconds_ = 0;  // of those rendered
  std::string title_;
};

}  // namespace airlight
