#include "read/log_reader.h"

#include "read/decompressing_stream.h"
#include "read/guarded_stream.h"
#include "read/log_view.h"

#include "oneac/mrpt_compat/observations.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace oneac {
namespace {

constexpr const char* kCopyAgain =
    "what came before is used; copy the log again from where it came to have the rest";
constexpr const char* kUnparsed = "Exception while parsing";  // MRPT's words, without a reason
constexpr const char* kOtherRelease =
    "if it is damaged, copy the log again from where it came; if not, remove the observations of "
    "this class with rawlog-edit of the release of MRPT that wrote it";
constexpr const char* kNotARawlog = "give an MRPT .rawlog (plain, gzip or zstd)";

// Whether MRPT complains of "class 'CName' which is not registered", rather than of garbage.
bool is_unknown_class(const std::string& fault) {
  const auto begin = fault.find('\'');
  const auto end = fault.rfind('\'');
  if (begin == end || fault.find("not registered") == std::string::npos) return false;
  const auto first = fault.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
  const auto last = fault.begin() + static_cast<std::ptrdiff_t>(end);
  return first != last && std::all_of(first, last, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == ':';
         });
}

bool is_unparsed(const std::string& fault) {
  return fault.rfind(kUnparsed, 0) == 0;
}

// The class whose content MRPT gave up, as the first in quotes; nothing where that is garbage.
std::optional<std::string> unparsed_class(const std::string& fault) {
  if (!is_unparsed(fault)) return std::nullopt;
  const auto begin = fault.find('\'');
  const auto end = begin == std::string::npos ? begin : fault.find('\'', begin + 1);
  if (end == std::string::npos) return std::nullopt;
  std::string name = fault.substr(begin + 1, end - begin - 1);
  if (mrpt::rtti::findRegisteredClass(name) == nullptr) return std::nullopt;
  return name;
}

}  // namespace

struct LogReader::Archive {
  explicit Archive(const std::filesystem::path& log)
      : stream(log), guarded(stream), archive(guarded) {}
  DecompressingStream stream;
  GuardedStream guarded;
  mrpt::serialization::CArchiveStreamBase<mrpt::io::CStream> archive;
};

LogReader::LogReader(std::filesystem::path log)
    : log_(std::move(log)), archive_(std::make_unique<Archive>(log_)) {
  if (read_record()) return;
  if (damage_) throw InputError(*damage_);
  throw InputError(log_.string(), "holds no record", kNotARawlog);
}

LogReader::~LogReader() = default;

std::optional<RawlogRecord> LogReader::next() {
  while (ready_.empty()) {
    if (!read_record()) return std::nullopt;
  }
  RawlogRecord record = std::move(ready_.front());
  ready_.pop_front();
  return record;
}

// One top-level record into ready_; false at the end. MRPT reports faults by exceptions of several
// kinds, some with a call stack in their text: none of them leaves this function.
bool LogReader::read_record() {
  if (damage_) return false;
  auto& stream = archive_->stream;
  if (stream.at_end()) {
    if (!stream.fault().empty()) set_damage(stream.fault());
    return false;
  }
  std::string fault;
  try {
    archive_->guarded.begin_record();
    const auto object = archive_->archive.ReadObject();
    // MRPT takes the last field of a record without an end mark for whole.
    if (stream.ran_out()) throw std::runtime_error("cut");
    take(object);
    ++records_;
    return true;
  } catch (const std::bad_alloc&) {
    fault = "the record claims more memory than there is";
  } catch (const std::length_error&) {
    fault = "the record claims an absurd size";
  } catch (const std::exception& error) {
    fault = compat::message_of(error);
    if (stream.ran_out()) fault = "the file ends in the middle of a record";
  }
  set_damage(stream.fault().empty() ? fault : stream.fault());
  return false;
}

void LogReader::take(const mrpt::serialization::CSerializable::Ptr& object) {
  using mrpt::obs::CActionCollection;
  using mrpt::obs::CSensoryFrame;
  if (!object) return;
  const auto images = std::make_shared<const LogImages>(archive_->guarded.take_images());
  if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) {
    check_cameras(*observation);
    has_observations_ = true;
    ready_.push_back({records_, std::move(observation), images});
  } else if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object)) {
    take_frame(*frame, images);
  } else if (const auto actions = std::dynamic_pointer_cast<CActionCollection>(object)) {
    take_actions(*actions, images);
  } else if (records_ == 0) {
    throw std::runtime_error("it begins with a " + compat::class_name(*object));
  }  // other objects may be stored between observations: not ours
}

void LogReader::take_actions(mrpt::obs::CActionCollection& actions,
                             const std::shared_ptr<const LogImages>& images) {
  has_pairs_ = true;
  auto odometry = odometry_.take(actions);
  if (!odometry) return;
  if (odometry->timestamp == INVALID_TIMESTAMP) {
    without_time_ = std::move(odometry);
  } else {
    ready_.push_back({records_, std::move(odometry), images});
  }
}

void LogReader::take_frame(const mrpt::obs::CSensoryFrame& frame,
                           const std::shared_ptr<const LogImages>& images) {
  has_pairs_ = true;
  for (const auto& part : frame) {
    if (part) check_cameras(*part);
  }
  for (const auto& part : frame) {
    if (!part) continue;
    if (without_time_ && part->timestamp != INVALID_TIMESTAMP) {
      without_time_->timestamp = part->timestamp;
      ready_.push_back({records_, std::exchange(without_time_, nullptr), images});
    }
    ready_.push_back({records_, part, images});
  }
}

void LogReader::set_damage(const std::string& said) {
  const std::string where = log_.string() + ": record " + std::to_string(records_);
  if (is_unknown_class(said)) {
    damage_.emplace(where, said,
                    "remove the observations of this class from the log with rawlog-edit");
    return;
  }
  if (const auto name = unparsed_class(said)) {
    damage_.emplace(where, "this release of MRPT cannot read its " + *name, kOtherRelease);
    return;
  }
  const std::string fault = is_unparsed(said) ? "this is not an MRPT object" : said;
  if (records_ == 0) {
    const bool damaged = !archive_->stream.fault().empty();
    damage_.emplace(where, "not a readable rawlog (" + fault + ")",
                    damaged ? "copy the log again from where it came" : kNotARawlog);
    return;
  }
  damage_.emplace(where, fault, kCopyAgain);
}

const std::string& LogReader::compression() const {
  return archive_->stream.compression();
}

std::string LogReader::format() const {
  if (has_pairs_) return has_observations_ ? "mixed" : "action/sensory-frame pairs";
  return "observations";
}

double LogReader::progress() const {
  return archive_->stream.progress();
}

}  // namespace oneac
