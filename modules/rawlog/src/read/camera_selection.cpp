#include "read/camera_selection.h"

#include "oneac/base/error.h"
#include "oneac/mrpt_compat/observations.h"

#include <algorithm>
#include <utility>

namespace oneac {
namespace {

using Side = CameraView::Side;

std::string joined(const std::set<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

bool is_present(const LogView& view, ExternalImages& images) {
  if (view.image->kind == LogImage::Kind::external) {
    return images.find(view.image->file).has_value();
  }
  return view.image->kind != LogImage::Kind::none;
}

CameraProbe::CameraProbe(std::string wanted, ExternalImages& images)
    : wanted_(std::move(wanted)), images_(images) {}

void CameraProbe::add(const RawlogRecord& record) {
  const auto& observation = *record.observation;
  sensors_.insert(observation.sensorLabel + " (" + compat::class_name(observation) + ")");
  const auto views = log_views(record);
  for (const auto& view : views) add_view(view, record);
  if (observation.timestamp == INVALID_TIMESTAMP) return;
  last_time_ = compat::unix_seconds(observation.timestamp);
  if (!views.empty() && !first_time_) first_time_ = last_time_;
}

void CameraProbe::add_view(const LogView& view, const RawlogRecord& record) {
  auto& candidate = candidates_[view.name()];
  if (candidate.images++ == 0) {
    static_cast<CameraDescription&>(candidate) = CameraDescription::of(view);
    candidate.matches = view.matches(wanted_);
    candidate.first_record = record.number;
  }
  if (candidate.matches && !candidate.present) candidate.present = is_present(view, images_);
}

std::vector<const CameraCandidate*> CameraProbe::meant() const {
  const auto exact = candidates_.find(wanted_);
  if (!wanted_.empty() && exact != candidates_.end()) return {&exact->second};
  std::vector<const CameraCandidate*> matching;
  std::set<std::string> labels;
  for (const auto& [name, candidate] : candidates_) {
    if (!candidate.matches) continue;
    matching.push_back(&candidate);
    labels.insert(candidate.label);
  }
  // Both halves of one stereo sensor: left, unless only images of the right one exist.
  const bool pair = wanted_.empty() && labels.size() == 1 && matching.size() == 2 &&
                    matching[0]->side == Side::left && matching[1]->side == Side::right;
  if (pair) return {!matching[0]->present && matching[1]->present ? matching[1] : matching[0]};
  return matching;
}

bool CameraProbe::decided() const {
  if (!first_time_ || last_time_ - *first_time_ < kProbeSeconds) return false;
  const auto cameras = meant();
  if (cameras.size() != 1) return cameras.size() > 1;
  const bool may_turn_left = wanted_.empty() && cameras.front()->side == Side::right;
  return cameras.front()->present && !may_turn_left;
}

const CameraCandidate& CameraProbe::choice(const std::filesystem::path& log) const {
  if (candidates_.empty()) {
    throw InputError(log.string(), "holds no camera images, only" + joined(sensors_),
                     "give a log with CObservationImage or CObservationStereoImages");
  }
  const auto cameras = meant();
  if (cameras.empty()) {
    throw InputError(log.string(), "has no camera '" + wanted_ + "'",
                     "the cameras that exist: " + names());
  }
  if (cameras.size() > 1) {
    throw InputError(log.string(), "has several cameras", "choose one with --camera: " + names());
  }
  const auto& camera = *cameras.front();
  if (!camera.present) {
    throw InputError(log.string(),
                     "none of the " + std::to_string(camera.images) + " images of camera '" +
                         camera.name + "' was found in " + images_.searched(),
                     "give the folder of the images with --images-dir");
  }
  return camera;
}

std::string CameraProbe::names() const {
  std::set<std::string> list;
  for (const auto& [name, candidate] : candidates_) list.insert("'" + name + "'");
  return joined(list);
}

CameraCandidate choose_camera(const std::filesystem::path& log, const std::string& wanted,
                              ExternalImages& images) {
  LogReader reader(log);
  CameraProbe probe(wanted, images);
  while (!probe.decided()) {
    const auto record = reader.next();
    if (!record) break;
    probe.add(*record);
  }
  if (!probe.has_images() && reader.damage()) throw InputError(*reader.damage());
  return probe.choice(log);
}

}  // namespace oneac
