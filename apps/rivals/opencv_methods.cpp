#include "rivals.h"

#include <opencv2/calib3d.hpp>

IMPLEMENTS_MRPT_OBJECT(OpencvMagsac, oneac::rivals::Rival, oneac::rivals)
IMPLEMENTS_MRPT_OBJECT(OpencvRansac, oneac::rivals::Rival, oneac::rivals)

namespace oneac::rivals {
namespace {

constexpr std::size_t kFewest = 5;  // points of the minimal solver

Eigen::Matrix3d to_eigen(const cv::Mat& R) {
  Eigen::Matrix3d out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out(row, column) = R.at<double>(row, column);
  }
  return out;
}

struct Found {
  RelativePose pose;
  std::vector<bool> inliers;
};

Found find_pose(const InitialiserInput& input, int method) {
  Found found{{}, std::vector<bool>(input.acs.size(), false)};
  found.pose.t.setZero();
  if (input.acs.size() < kFewest) return found;
  std::vector<cv::Point2d> first, second;
  for (const AffineCorrespondence& ac : input.acs) {
    first.emplace_back(ac.x1.x(), ac.x1.y());
    second.emplace_back(ac.x2.x(), ac.x2.y());
  }
  const cv::Mat K = cv::Mat::eye(3, 3, CV_64F);  // the points are normalised
  cv::setRNGSeed(static_cast<int>(input.seed));
  cv::Mat mask, R, t;
  const cv::Mat E = cv::findEssentialMat(first, second, K, method, kConfidence,
                                         kThreshold_px / input.focal_px, kMostIterations, mask);
  if (E.rows < 3) return found;
  cv::recoverPose(E.rowRange(0, 3), first, second, K, R, t, mask);
  found.pose = {to_eigen(R), {t.at<double>(0), t.at<double>(1), t.at<double>(2)}};
  for (std::size_t i = 0; i < found.inliers.size(); ++i) {
    found.inliers[i] = mask.at<unsigned char>(static_cast<int>(i)) != 0;
  }
  return found;
}

}  // namespace

// OpenCV does not say how many iterations it took.
InitialiserResult OpencvMagsac::estimate(const InitialiserInput& input) const {
  Found found = find_pose(input, cv::USAC_MAGSAC);
  return answer(found.pose, std::move(found.inliers), 0);
}

InitialiserResult OpencvRansac::estimate(const InitialiserInput& input) const {
  Found found = find_pose(input, cv::RANSAC);
  return answer(found.pose, std::move(found.inliers), 0);
}

}  // namespace oneac::rivals
