#include "oneac/comparison/overlay.h"

#include "oneac/base/error.h"
#include "oneac/comparison/pair_stream.h"
#include "oneac/comparison/summary.h"
#include "oneac/evaluation/pair_errors.h"
#include "oneac/initialisers/checked_answer.h"

#include <algorithm>
#include <filesystem>

namespace oneac {
namespace {

/// How bad a pair is for a method: above 1 is a failure.
double badness(const PairRecord& pair, std::size_t method) {
  double worst = 0.0;
  for (const MethodResult& result : pair.results) {
    if (result.method != method) continue;
    const ResultError error = error_of(pair, result);
    if (!result.has_pose) return 1e9;  // no pose at all: before any error
    if (!pair.truth) {
      const double share =
          pair.acs == 0 ? 0.0 : static_cast<double>(result.inliers) / static_cast<double>(pair.acs);
      worst = std::max(worst, 1.0 - share);
    }
    if (error.rotation) worst = std::max(worst, *error.rotation / kBadRotation);
    if (error.direction) worst = std::max(worst, *error.direction / kBadDirection);
  }
  return worst;
}

/// In pixels of the images.
Mark mark_of(const AffineCorrespondence& ac, const PinholeCamera& camera, bool inlier) {
  const Eigen::Vector2d f(camera.fx, camera.fy);
  return {camera.project(ac.x1), camera.project(ac.x2),
          f.asDiagonal() * ac.A * f.cwiseInverse().asDiagonal(), inlier ? 0.0 : 1.0};
}

Overlay overlay_of(const GreyImage& image, const PairAcs& pair, const std::vector<bool>& inliers) {
  Overlay overlay{image.width(), image.height(), jpeg_of(image.view()), {}};
  for (std::size_t i = 0; i < pair.acs.size(); ++i) {
    overlay.marks.push_back(mark_of(pair.acs[i], pair.camera, i < inliers.size() && inliers[i]));
  }
  return overlay;
}

/// Draws the chosen pairs of one log in one pass over it.
class LogDrawing {
 public:
  LogDrawing(const ComparisonData& data, const CompareSettings& settings, std::size_t method)
      : data_(data), settings_(settings), shown_(method), extractor_(settings.features) {
    method_ = make_method(settings.methods.at(method), settings.method_parameters);
  }

  void draw(const LogRecord& log, const std::vector<std::size_t>& pairs,
            std::vector<PairOverlay>& overlays) const {
    RawlogSource source(settings_.source_of(log.log));
    std::size_t left = pairs.size();
    std::optional<FrameTicket> before;
    while (auto ticket = left > 0 ? source.next() : std::nullopt) {
      for (const std::size_t pair : pairs) {
        const PairRecord& record = data_.pairs[pair];
        const bool here =
            before && before->index == record.index1 && ticket->index == record.index2;
        if (!here) continue;
        overlays.push_back({pair, shown_, picture(source, *before, *ticket, log)});
        --left;
      }
      before = std::move(ticket);
    }
  }

 private:
  [[nodiscard]] Overlay picture(const RawlogSource& source, const FrameTicket& first,
                                const FrameTicket& second, const LogRecord& log) const {
    const StreamPair pair{0, std::make_shared<StreamImage>(source, extractor_, first),
                          std::make_shared<StreamImage>(source, extractor_, second)};
    const PairAcs acs = pair.correspond(extractor_);
    InitialiserInput input;
    input.acs = acs.acs;
    input.R_level_cam = levelling_rotation(log.tilt);
    input.focal_px = acs.camera.focal_px();
    input.seed = settings_.seed;
    std::vector<bool> inliers = checked_answer(*method_, input).result.inliers;
    inliers.resize(acs.acs.size());  // none without an answer
    return overlay_of(source.load(second).image, acs, inliers);
  }

  const ComparisonData& data_;
  const CompareSettings& settings_;
  std::size_t shown_;
  RelativePoseInitialiser::Ptr method_;
  PairExtractor extractor_;
};

}  // namespace

std::size_t shown_method(const ComparisonData& data) {
  const auto found = std::find(data.methods.begin(), data.methods.end(), "1ac_pooled");
  return found == data.methods.end() ? 0 : static_cast<std::size_t>(found - data.methods.begin());
}

std::vector<std::size_t> worst_pairs(const ComparisonData& data, std::size_t method,
                                     std::size_t count) {
  std::vector<std::size_t> order(data.pairs.size());
  std::vector<double> badnesses(data.pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
    badnesses[i] = badness(data.pairs[i], method);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return badnesses[a] > badnesses[b]; });
  if (order.size() > count) order.resize(count);
  return order;
}

std::vector<PairOverlay> draw_worst_pairs(const ComparisonData& data,
                                          const CompareSettings& settings, std::size_t count) {
  std::vector<PairOverlay> overlays;
  if (data.pairs.empty()) return overlays;
  const std::size_t method = shown_method(data);
  const std::vector<std::size_t> worst = worst_pairs(data, method, count);
  for (const LogRecord& log : data.logs) {
    std::vector<std::size_t> here;
    std::copy_if(worst.begin(), worst.end(), std::back_inserter(here),
                 [&](std::size_t pair) { return data.pairs[pair].log == log.log; });
    // A merge may run where the logs are not.
    if (here.empty() || !std::filesystem::exists(settings.logs.at(log.log))) continue;
    try {
      const LogDrawing drawing(data, settings, method);  // a merge may lack its plugin
      drawing.draw(log, here, overlays);
    } catch (const InputError&) {
      // The picture is an extra: the numbers of the pair are in the report all the same.
    }
  }
  const auto rank = [&](const PairOverlay& overlay) {
    return std::find(worst.begin(), worst.end(), overlay.pair) - worst.begin();
  };
  std::stable_sort(overlays.begin(), overlays.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return overlays;
}

}  // namespace oneac
