// What of a scene file changes from frame to frame: numbers by keyframes, names of files by the frame's number.
#pragma once

#include <string>
#include <vector>

#include "common/scene/json.h"
#include "common/scene/keyframes.h"

namespace airlight {

struct FrameRange {
  int first = 0, last = 0;  // both are in it
  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

// Works on the document, before any of it is understood: a track replaces the numbers that its path leads to, which are then read
// and checked as if they stood there, each in the place of its keyframe.
class Animation {
 public:
  // Reads the key "animation" of the document `file`. A document without one has no tracks, and its names of files stay as they
  // are. Throws InputError for unknown paths, for keyframes that are not of the shape of what they replace, out of order or there
  // twice, and for numbers that two tracks move. The document must outlive this, and nobody else may change it.
  Animation(json::Value& document, const std::string& file);

  bool animated() const { return animated_; }
  FrameRange frames() const { return frames_; }  // as the file says, else from the first keyframe to the last
  std::size_t tracks() const { return tracks_.size(); }
  std::vector<int> keyed_frames() const;            // of all tracks, rising, each once
  std::vector<std::string> numbered_files() const;  // names with a # in them

  // Makes the document that of a frame.
  void set(int frame);

 private:
  struct Track {
    std::vector<int> frames;               // of its keyframes, rising
    std::vector<const json::Value*> keys;  // what stands there, in the document: a number or an array of numbers
    Interpolation interpolation = Interpolation::linear;
    std::vector<std::vector<double>> values;  // of each number, one a keyframe
    std::vector<json::Value*> moved;          // of the same shape as the keys
  };
  struct NumberedFile {
    json::Value* name;
    std::string pattern;
  };
  class Reader;

  bool animated_ = false;
  FrameRange frames_;
  std::vector<Track> tracks_;
  std::vector<NumberedFile> files_;
};

}  // namespace airlight
