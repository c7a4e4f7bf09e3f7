#include "window_adjustment.h"
#include "window_costs.h"

#include "oneac/geometry/robust_loss.h"

#include <Eigen/Cholesky>

#include <memory>

namespace oneac {
namespace {

/// Normal equations of camera and poses, landmarks eliminated one after the other.
class Reduced {
 public:
  explicit Reduced(std::size_t views) : H_(Eigen::MatrixXd::Zero(size_of(views), size_of(views))) {}

  /// @param J  ∂r/∂(camera, pose, landmark), whitened and weighted
  void add(std::size_t view, const Eigen::Matrix<double, 2, 14>& J) {
    const auto camera = J.leftCols<kIntrinsics>();
    const auto pose = J.middleCols<6>(kIntrinsics);
    const auto point = J.rightCols<3>();
    H_.topLeftCorner<kIntrinsics, kIntrinsics>() += camera.transpose() * camera;
    point_ += point.transpose() * point;
    Cross cross{0, Eigen::MatrixXd(camera.transpose() * point)};
    if (crossings_.empty()) crossings_.push_back({0, Eigen::MatrixXd::Zero(kIntrinsics, 3)});
    crossings_.front().block += cross.block;
    if (view == 0) return;  // it holds the gauge
    const Eigen::Index at = kIntrinsics + 6 * static_cast<Eigen::Index>(view - 1);
    H_.block<6, 6>(at, at) += pose.transpose() * pose;
    const Eigen::Matrix<double, kIntrinsics, 6> mixed = camera.transpose() * pose;
    H_.block<kIntrinsics, 6>(0, at) += mixed;
    H_.block<6, kIntrinsics>(at, 0) += mixed.transpose();
    crossings_.push_back({at, Eigen::MatrixXd(pose.transpose() * point)});
  }
  /// No more sightings of this landmark.
  void eliminate() {
    constexpr double kDamping = 1e-12;  // a landmark at infinity has no depth
    point_.diagonal() *= 1.0 + kDamping;
    const Eigen::LDLT<Eigen::Matrix3d> inverse(point_);
    for (const Cross& a : crossings_) {
      for (const Cross& b : crossings_) {
        H_.block(a.at, b.at, a.block.rows(), b.block.rows()) -=
            a.block * inverse.solve(b.block.transpose());
      }
    }
    point_.setZero();
    crossings_.clear();
  }
  void add_gauge(const Eigen::Matrix<double, 6, 1>& gradient) {
    H_.bottomRightCorner<6, 6>() += gradient * gradient.transpose();
  }
  [[nodiscard]] IntrinsicsMatrix camera() const {
    const Eigen::Index poses = H_.rows() - kIntrinsics;
    const Eigen::MatrixXd mixed = H_.topRightCorner(kIntrinsics, poses);
    const Eigen::LDLT<Eigen::MatrixXd> inverse(H_.bottomRightCorner(poses, poses));
    const IntrinsicsMatrix all = H_.topLeftCorner<kIntrinsics, kIntrinsics>();
    const IntrinsicsMatrix result = all - mixed * inverse.solve(mixed.transpose());
    return 0.5 * (result + result.transpose());
  }

 private:
  struct Cross {
    Eigen::Index at;
    Eigen::MatrixXd block;
  };
  static Eigen::Index size_of(std::size_t views) {
    return kIntrinsics + 6 * static_cast<Eigen::Index>(views - 1);
  }

  Eigen::MatrixXd H_;
  Eigen::Matrix3d point_ = Eigen::Matrix3d::Zero();
  std::vector<Cross> crossings_;
};

// [-] times the loss: so far off a sighting is an outlier. Its Jacobian may be as large as its
// error, where a landmark lies beside a view, and no weight that falls with the error makes it
// harmless.
constexpr double kOutlier = 10.0;

template <int Columns>
using RowMajor = Eigen::Matrix<double, 2, Columns, Eigen::RowMajor>;

}  // namespace

IntrinsicsMatrix WindowAdjustment::information(double sigma_px) const {
  const double c2 = options_.loss_sigmas * options_.loss_sigmas;
  Reduced reduced(window_.views.size());
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Seen& s = seen_[i];
    const std::unique_ptr<ceres::CostFunction> cost(
        reprojection_cost(from_, window_.views[s.view].T_view_map,
                          window_.views[anchors_[s.landmark]].T_view_map, s.u, sigma_px));
    const double* blocks[] = {change_.data(), poses_[s.view].data(), landmarks_[s.landmark].data()};
    Eigen::Vector2d r;
    RowMajor<kIntrinsics> camera;
    RowMajor<6> pose;
    RowMajor<3> point;
    double* jacobians[] = {camera.data(), pose.data(), point.data()};
    const bool valid = cost->Evaluate(blocks, r.data(), jacobians);
    if (valid && r.squaredNorm() < kOutlier * kOutlier * c2) {
      Eigen::Matrix<double, 2, 14> J;
      J << camera, pose, point;
      reduced.add(s.view, std::sqrt(cauchy_weight(r.squaredNorm(), c2)) * J);
    }
    if (i + 1 == seen_.size() || seen_[i + 1].landmark != s.landmark) reduced.eliminate();
  }
  const std::unique_ptr<ceres::CostFunction> gauge(
      length_cost(window_.views.front().T_view_map, window_.views.back().T_view_map));
  const double* blocks[] = {poses_.back().data()};
  double r;
  Eigen::Matrix<double, 1, 6> gradient;
  double* jacobians[] = {gradient.data()};
  if (gauge->Evaluate(blocks, &r, jacobians)) reduced.add_gauge(gradient.transpose());
  return reduced.camera();
}

}  // namespace oneac
