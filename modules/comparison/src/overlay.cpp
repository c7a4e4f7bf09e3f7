#include "oneac/comparison/overlay.h"

#include "text.h"

#include "oneac/base/error.h"
#include "oneac/comparison/pair_stream.h"
#include "oneac/comparison/summary.h"
#include "oneac/evaluation/pair_errors.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>

namespace oneac {
namespace {

// What keeps a report with a handful of pictures below a megabyte.
constexpr int kWidestPicture_px = 960;
constexpr int kJpegQuality = 75;
// BGR: blue and orange differ for every kind of colour vision, and from grey.
const cv::Scalar kInlier(255, 170, 40), kOutlier(0, 120, 255);

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

struct Picture {
  GreyImage image;
  PairAcs pair;
};

std::string drawn(const Picture& picture, const std::vector<bool>& inliers) {
  const ImageView view = picture.image.view();
  const cv::Mat grey(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data),
                     static_cast<std::size_t>(view.stride));
  cv::Mat canvas;
  cv::cvtColor(grey, canvas, cv::COLOR_GRAY2BGR);
  const auto pixel = [&](const Eigen::Vector2d& x) {
    const Eigen::Vector2d u = picture.pair.camera.project(x);
    return cv::Point(static_cast<int>(u.x()), static_cast<int>(u.y()));
  };
  for (const bool good : {false, true}) {  // inliers on top
    for (std::size_t i = 0; i < picture.pair.acs.size(); ++i) {
      if ((i < inliers.size() && inliers[i]) != good) continue;
      const AffineCorrespondence& ac = picture.pair.acs[i];
      const cv::Scalar& colour = good ? kInlier : kOutlier;
      cv::line(canvas, pixel(ac.x1), pixel(ac.x2), colour, 1, cv::LINE_AA);
      cv::circle(canvas, pixel(ac.x2), 2, colour, cv::FILLED, cv::LINE_AA);
    }
  }
  if (canvas.cols > kWidestPicture_px) {
    const double scale = static_cast<double>(kWidestPicture_px) / canvas.cols;
    cv::resize(canvas, canvas, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", canvas, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return internal::base64(jpeg);
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
  [[nodiscard]] std::string picture(const RawlogSource& source, const FrameTicket& first,
                                    const FrameTicket& second, const LogRecord& log) const {
    const StreamPair pair{0, std::make_shared<StreamImage>(source, extractor_, first),
                          std::make_shared<StreamImage>(source, extractor_, second)};
    Picture picture;
    picture.pair = pair.correspond(extractor_);
    picture.image = source.load(second).image;
    InitialiserInput input;
    input.acs = picture.pair.acs;
    input.R_level_cam = leveling_rotation(log.tilt);
    input.focal_px = picture.pair.camera.focal_px();
    input.seed = settings_.seed;
    return drawn(picture, method_->estimate(input).inliers);
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
  const LogDrawing drawing(data, settings, method);
  for (const LogRecord& log : data.logs) {
    std::vector<std::size_t> here;
    std::copy_if(worst.begin(), worst.end(), std::back_inserter(here),
                 [&](std::size_t pair) { return data.pairs[pair].log == log.log; });
    // A merge may run where the logs are not.
    if (here.empty() || !std::filesystem::exists(settings.logs.at(log.log))) continue;
    try {
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
