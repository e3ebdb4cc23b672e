#include "app/view_session.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <variant>

namespace airlight {

namespace {

std::string edited_name(const std::string& path) {
  std::filesystem::path p(path);
  p.replace_filename(p.stem().string() + "_edited.json");
  return p.string();
}

bool same(const Camera& a, const Camera& b) {
  return a.position == b.position && a.look_at == b.look_at && a.up == b.up && a.vertical_fov == b.vertical_fov;
}

}  // namespace

ViewSession::ViewSession(const std::string& path, std::string output, std::string record, Progress& progress)
    : path_(path), output_(output.empty() ? edited_name(path) : std::move(output)), record_(std::move(record)) {
  try {
    document_.emplace(path);
    editor_.emplace(document_->scene());
  } catch (const InputError& e) {
    editor_.emplace(load_scene(path, progress));  // throws where nobody can read it
    not_saved_why_ = e.what();
  }
  first_camera_ = recorded_camera_ = scene().camera;
}

void ViewSession::begin_record() {
  if (record_.empty()) return;
  std::ofstream file(record_, std::ios::binary | std::ios::trunc);
  if (!file) throw InputError(record_ + ": cannot be written: " + std::strerror(errno));
}

void ViewSession::write(const std::string& lines) {
  if (record_.empty()) return;
  std::ofstream file(record_, std::ios::binary | std::ios::app);
  file << lines << std::flush;
  if (!file) throw MachineError(record_ + ": cannot be written");
}

void ViewSession::record_camera() {
  const Camera& c = scene().camera;
  if (same(c, recorded_camera_)) return;
  recorded_camera_ = c;
  write(line_of(CameraEdit{c.position, c.look_at, c.up, c.vertical_fov}));
}

// What is on the screen is told by the camera, so its place comes before.
void ViewSession::record(const Edit& edit) {
  if (!std::holds_alternative<CameraEdit>(edit)) record_camera();
  write(line_of(edit));
}

void ViewSession::apply(const Edit& edit) {
  commit();
  editor_->apply(edit);
  record(edit);
  ++revision_;
}

void ViewSession::attempt(const Edit& edit) {
  abandon();
  editor_->apply(edit);
  trial_ = edit;
  ++revision_;
}

void ViewSession::abandon() {
  if (!trial_) return;
  editor_->take_back();
  trial_.reset();
  ++revision_;
}

void ViewSession::commit() {
  if (!trial_) return;
  record(*std::exchange(trial_, std::nullopt));
}

void ViewSession::look(const Camera& c) {
  if (same(c, scene().camera)) return;
  // A stroke was drawn from where the camera was.
  if (trial_ && (std::holds_alternative<PaintEdit>(*trial_) || std::holds_alternative<EraseEdit>(*trial_))) commit();
  editor_->apply(CameraEdit{c.position, c.look_at, c.up, c.vertical_fov});
  ++revision_;
}

void ViewSession::look_from_start() { look(first_camera_); }

std::string ViewSession::save() {
  commit();
  if (!document_) throw InputError(not_saved_why_);
  document_->save(scene(), output_);
  record_camera();
  saved_ = output_;
  saved_revision_ = revision_;
  return output_;
}

void ViewSession::finish() {
  commit();
  record_camera();
}

}  // namespace airlight
