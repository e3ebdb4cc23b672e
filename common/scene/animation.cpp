#include "common/scene/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>

#include "common/error.h"
#include "common/scene/frame_pattern.h"
#include "common/scene/reader.h"
#include "common/spelling.h"

namespace airlight {

namespace {

// A whole number of decimal digits, or -1.
int whole_number(std::string_view text) {
  int v = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  return error == std::errc() && end == text.data() + text.size() && v >= 0 ? v : -1;
}

const json::Value* member(const json::Value& object, std::string_view key) {
  for (const json::Value& m : object.items) {
    if (object.kind == json::Kind::object && m.key == key) return &m;
  }
  return nullptr;
}

// Keys whose strings are names of files.
constexpr auto file_keys = keys("file", "mesh", "brdf", "gaussians_file");

using Fail = std::function<void(const std::string&)>;  // throws

void add_member(json::Value& v, const std::string& key, const std::string& walked, std::vector<json::Value*>& next,
                const Fail& fail) {
  const std::string where = walked.empty() ? "the scene" : json::quoted(walked);
  if (v.kind != json::Kind::object) fail(fmt::format("{} is no object, it has no key {}", where, json::quoted(key)));
  std::vector<std::string_view> known;
  for (json::Value& m : v.items) {
    if (walked.empty() && m.key == "animation") continue;
    if (m.key == key) return next.push_back(&m);
    if (known.size() < 20) known.emplace_back(m.key);
  }
  const std::string_view word = std::string_view(key).substr(0, 60);
  fail(fmt::format("{} has no key {}{}", where, json::quoted(key), suggestion(word, known)));
}

void add_elements(json::Value& v, const std::string& which, const std::string& walked, std::vector<json::Value*>& next,
                  const Fail& fail) {
  if (v.kind != json::Kind::array) fail(fmt::format("{} is no array", json::quoted(walked)));
  const int index = whole_number(which);
  const std::size_t before = next.size();
  for (std::size_t i = 0; i < v.items.size(); ++i) {
    const json::Value* name = member(v.items[i], "name");
    const bool named = name && name->kind == json::Kind::string && name->text == which;
    if (which == "*" || (index >= 0 ? i == static_cast<std::size_t>(index) : named)) next.push_back(&v.items[i]);
  }
  if (next.size() > before) return;
  fail(fmt::format("{} has no element {} (there are {})", json::quoted(walked), json::quoted(which), v.items.size()));
}

// The values that a path leads to, a step at a time: ".key", "[2]" (from 0), "[lamp]" (the element of that name), "[*]" (all).
std::vector<json::Value*> values_at(json::Value& document, const std::string& path, const Fail& fail) {
  std::vector<json::Value*> here{&document};
  std::string walked;
  for (std::size_t at = 0; at < path.size();) {
    std::vector<json::Value*> next;
    if (path[at] == '[') {
      const std::size_t end = path.find(']', at);
      if (end == path.npos) fail("expected ']'");
      const std::string which = path.substr(at + 1, end - at - 1);
      for (json::Value* v : here) add_elements(*v, which, walked, next, fail);
      at = end + 1;
    } else {
      if (path[at] == '.' && at > 0) ++at;
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      const std::string key = path.substr(at, end - at);
      for (json::Value* v : here) add_member(*v, key, walked, next, fail);
      at = end;
    }
    here = std::move(next);
    walked = path.substr(0, at);
  }
  return here;
}

}  // namespace

class Animation::Reader {
 public:
  Reader(json::Value& document, const std::string& file, Animation& animation)
      : document_(document), file_(file), animation_(animation) {}

  void read(const json::Value& value) {
    static constexpr auto known = keys("frames", "tracks");
    const Object o(Node(value, file_, "animation"), known);
    const auto frames = o.find("frames"), tracks = o.find("tracks");
    if (tracks) {
      if (tracks->value().kind != json::Kind::object) tracks->fail("expected an object of paths");
      for (const json::Value& track : tracks->value().items) add_track(track);
    }
    animation_.animated_ = true;
    if (frames) {
      const std::vector<Node> ends = frames->array();
      if (ends.size() != 2) frames->fail("expected an array of 2 whole numbers, the first frame and the last");
      animation_.frames_ = {ends[0].integer(0, last_frame), ends[1].integer(0, last_frame)};
      if (animation_.frames_.last < animation_.frames_.first) ends[1].fail("before the first frame, expected it or a later one");
    } else {
      const std::vector<int> keyed = animation_.keyed_frames();
      if (keyed.empty()) o.node().fail("missing key, expected \"frames\" or \"tracks\"");
      animation_.frames_ = {keyed.front(), keyed.back()};
    }
    find_files(document_);
  }

 private:
  [[noreturn]] void fail(json::Place place, const std::string& what) const {
    throw InputError(json::message(file_, place, what));
  }

  void add_track(const json::Value& value) {
    const Fail unknown = [&](const std::string& why) {
      fail(value.key_place, fmt::format("unknown path {}: {}", json::quoted(value.key), why));
    };
    if (value.key.empty()) unknown("expected one such as \"camera.position\"");
    Track track;
    track.moved = values_at(document_, value.key, unknown);
    for (const json::Value* moved : track.moved) check_moved(value, *moved);
    if (value.kind != json::Kind::object) fail(value.place, json::quoted(value.key) + ": expected an object of keyframes");
    for (const json::Value& m : value.items) {
      if (m.key == "interpolation") {
        static constexpr auto names = keys("linear", "smooth");
        const Node node(m, file_, json::quoted(value.key) + ".interpolation");
        track.interpolation = node.choice(names) == "smooth" ? Interpolation::smooth : Interpolation::linear;
        continue;
      }
      add_key(track, value, m);
    }
    if (track.frames.empty()) fail(value.place, json::quoted(value.key) + ": no keyframe, expected one at least");
    animation_.tracks_.push_back(std::move(track));
  }

  void add_key(Track& track, const json::Value& path, const json::Value& key) {
    const int frame = whole_number(key.key);
    if (frame < 0 || frame > last_frame) {
      fail(key.key_place, fmt::format("{}: unknown key {}, expected a frame from 0 to {}, or \"interpolation\"",
                                      json::quoted(path.key), json::quoted(key.key), last_frame));
    }
    if (!track.frames.empty() && frame <= track.frames.back()) {
      fail(key.key_place, fmt::format("{}: frame {} after frame {}, expected rising frames, each once", json::quoted(path.key),
                                      frame, track.frames.back()));
    }
    // The first keyframe has the shape of what is moved, the others that of the first.
    const std::vector<const json::Value*> numbers = numbers_of(key);
    for (const json::Value* v : track.moved) {
      if (numbers_of(*v).size() == numbers.size() && v->kind == key.kind) continue;
      fail(key.place,
           fmt::format("{}: {}, expected {} as in line {}", json::quoted(path.key), shape_of(key), shape_of(*v), v->place.line));
    }
    track.frames.push_back(frame);
    track.keys.push_back(&key);
    track.values.resize(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) track.values[k].push_back(numbers[k]->number);
  }

  // All numbers at the end of a path must be there, and be moved by one track only.
  void check_moved(const json::Value& path, const json::Value& moved) {
    const std::vector<const json::Value*> numbers = numbers_of(moved);
    if (numbers.empty()) {
      fail(path.key_place,
           fmt::format("{} leads to {}, expected a number or an array of numbers", json::quoted(path.key), shape_of(moved)));
    }
    for (const json::Value* number : numbers) {
      const auto [other, first] = movers_.try_emplace(number, path.key_place.line);
      if (first) continue;
      fail(path.key_place,
           fmt::format("{} moves what the track in line {} moves, expected one of them", json::quoted(path.key), other->second));
    }
  }

  // Of a number itself, of an array its elements; none where anything else is in it.
  static std::vector<const json::Value*> numbers_of(const json::Value& v) {
    if (v.kind == json::Kind::number) return {&v};
    std::vector<const json::Value*> all;
    if (v.kind != json::Kind::array) return all;
    for (const json::Value& item : v.items) {
      if (item.kind != json::Kind::number) return {};
      all.push_back(&item);
    }
    return all;
  }
  static std::string shape_of(const json::Value& v) {
    const std::size_t numbers = numbers_of(v).size();
    if (numbers == 0) return "something else than numbers";
    return v.kind == json::Kind::number ? "a number" : fmt::format("an array of {} numbers", numbers);
  }

  void find_files(json::Value& v) {
    for (json::Value& item : v.items) {
      if (&v == &document_ && item.key == "animation") continue;
      const bool names_file = std::find(file_keys.begin(), file_keys.end(), item.key) != file_keys.end();
      if (names_file && item.kind == json::Kind::string && has_frame_pattern(item.text)) {
        animation_.files_.push_back({&item, item.text});
      }
      find_files(item);
    }
  }

  json::Value& document_;
  const std::string& file_;
  Animation& animation_;
  std::map<const json::Value*, int> movers_;  // numbers that tracks move, with the line of the track
};

Animation::Animation(json::Value& document, const std::string& file) {
  if (const json::Value* value = member(document, "animation")) Reader(document, file, *this).read(*value);
}

std::vector<int> Animation::keyed_frames() const {
  std::vector<int> all;
  for (const Track& t : tracks_) all.insert(all.end(), t.frames.begin(), t.frames.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::string> Animation::numbered_files() const {
  std::vector<std::string> all;
  for (const NumberedFile& f : files_) all.push_back(f.pattern);
  return all;
}

void Animation::set(int frame) {
  for (const Track& track : tracks_) {
    const auto next = std::upper_bound(track.frames.begin(), track.frames.end(), frame);
    const auto key = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - track.frames.begin(), 1) - 1);
    for (json::Value* moved : track.moved) moved->place = track.keys[key]->place;
    for (std::size_t k = 0; k < track.values.size(); ++k) {
      const double v = interpolated(track.frames, track.values[k], track.interpolation, frame);
      for (json::Value* moved : track.moved) {
        const bool array = moved->kind == json::Kind::array;
        json::Value& number = array ? moved->items[k] : *moved;
        number.number = v;
        number.text = fmt::format("{}", v);
        number.place = (array ? track.keys[key]->items[k] : *track.keys[key]).place;
      }
    }
  }
  for (const NumberedFile& f : files_) f.name->text = with_frame(f.pattern, frame);
}

}  // namespace airlight
