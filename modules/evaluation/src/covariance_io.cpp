#include "oneac/evaluation/covariance_io.h"

#include "text_io.h"

#include "oneac/base/error.h"
#include "oneac/base/number_text.h"
#include "oneac/geometry/relative_pose.h"

#include <array>
#include <stdexcept>
#include <string_view>

namespace oneac {
namespace {

constexpr int kSize = 6;
constexpr std::size_t kIndices = 2, kTriangle = 21, kAxes = 3;
constexpr std::size_t kFields = kIndices + kTriangle + kAxes;

/// ",c00,c01,…,c55".
std::string triangle_names() {
  std::string names;
  for (int row = 0; row < kSize; ++row) {
    for (int column = row; column < kSize; ++column) {
      names += ",c" + std::to_string(row) + std::to_string(column);
    }
  }
  return names;
}

std::string header() {
  return "index1,index2" + triangle_names() + ",sigma_x,sigma_y,sigma_z";
}

/// The fields of one line, in the order of the header.
class Fields {
 public:
  Fields(const TextLine& line, const std::string& file)
      : fields_(split_at_commas(line.text)), where_(where_in(file, line.number)) {
    if (fields_.size() != kFields) fail(std::to_string(fields_.size()) + " fields, needs 26");
  }
  [[nodiscard]] bool is_empty(std::size_t i) const { return fields_[i].empty(); }
  [[nodiscard]] std::size_t index(std::size_t i) const {
    const auto value = parse_integer<std::size_t>(fields_[i]);
    if (!value) fail("'" + std::string(fields_[i]) + "' is not a whole number");
    return *value;
  }
  [[nodiscard]] double real(std::size_t i) const {
    const auto value = parse_finite(fields_[i]);
    if (!value) fail("'" + std::string(fields_[i]) + "' is not a finite number below 1e15");
    return *value;
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(where_, fault, "write the file again, or remove the line when it was cut");
  }

  std::vector<std::string_view> fields_;
  std::string where_;
};

CovarianceRow parse_row(const Fields& fields) {
  CovarianceRow row;
  row.index1 = fields.index(0);
  row.index2 = fields.index(1);
  std::size_t field = kIndices;
  for (int r = 0; r < kSize; ++r) {
    for (int c = r; c < kSize; ++c) {
      row.covariance(r, c) = row.covariance(c, r) = fields.real(field++);
    }
  }
  if (fields.is_empty(field)) return row;
  row.position_sigma =
      Eigen::Vector3d(fields.real(field), fields.real(field + 1), fields.real(field + 2));
  return row;
}

}  // namespace

std::string covariances_header() {
  return header() + '\n';
}

std::string covariance_line(const CovarianceRow& row) {
  if (!row.covariance.allFinite() || (row.position_sigma && !row.position_sigma->allFinite())) {
    throw std::invalid_argument("CovarianceRow of images " + std::to_string(row.index1) + " and " +
                                std::to_string(row.index2) + ": numbers must be finite");
  }
  std::string line = std::to_string(row.index1) + ',' + std::to_string(row.index2);
  for (int r = 0; r < kSize; ++r) {
    for (int c = r; c < kSize; ++c) line += ',' + exact_text(row.covariance(r, c));
  }
  for (int axis = 0; axis < static_cast<int>(kAxes); ++axis) {
    line += row.position_sigma ? ',' + exact_text((*row.position_sigma)[axis]) : ",";
  }
  return line + '\n';
}

std::string format_covariances(const std::vector<CovarianceRow>& rows) {
  std::string text = covariances_header();
  for (const CovarianceRow& row : rows) text += covariance_line(row);
  return text;
}

std::vector<CovarianceRow> read_covariances(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const auto lines = data_lines(text);
  if (lines.empty()) throw InputError(path.string(), "is blank", "write or copy it again");
  if (lines.front().text != header()) {
    throw InputError(where_in(path.string(), lines.front().number), "is no covariance.csv",
                     "the first line must be " + header());
  }
  std::vector<CovarianceRow> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    rows.push_back(parse_row(Fields(lines[k], path.string())));
  }
  return rows;
}

std::string pose_covariances_header() {
  return "time,x,y,z,qw,qx,qy,qz,index,metric" + triangle_names() + '\n';
}

std::string pose_covariance_line(const PoseCovarianceRow& row) {
  const Eigen::Vector3d p = row.T_world_body.translation();
  Eigen::Quaterniond q(row.T_world_body.linear());
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  if (!row.covariance.allFinite() || !row.T_world_body.matrix().allFinite()) {
    throw std::invalid_argument("PoseCovarianceRow of image " + std::to_string(row.index) +
                                ": numbers must be finite");
  }
  std::string line = exact_fixed_text(row.time_s, kTimeDecimals);
  for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
    line += ',' + exact_text(number);
  }
  line += ',' + std::to_string(row.index) + (row.metric ? ",1" : ",0");
  for (int r = 0; r < kSize; ++r) {
    for (int c = r; c < kSize; ++c) {
      line += row.has_lengths || c < 3 ? ',' + exact_text(row.covariance(r, c)) : ",";
    }
  }
  return line + '\n';
}

std::string format_pose_covariances(const std::vector<PoseCovarianceRow>& rows) {
  std::string text = pose_covariances_header();
  for (const PoseCovarianceRow& row : rows) text += pose_covariance_line(row);
  return text;
}

// R' = F R Fᵀ and p' = F p + f − R' f of F, f: θ' = F θ, δp' = F δp + [R' f]× θ'.
PoseCovarianceRow carried_to(const Eigen::Isometry3d& T_fixed, const PoseCovarianceRow& row) {
  return carried_to(T_fixed, T_fixed, row);
}

PoseCovarianceRow carried_to(const Eigen::Isometry3d& T_world, const Eigen::Isometry3d& T_body,
                             const PoseCovarianceRow& row) {
  PoseCovarianceRow carried = row;
  carried.T_world_body = T_world * row.T_world_body * T_body.inverse();
  const Eigen::Matrix3d F = T_world.linear();
  const Eigen::Vector3d lever = carried.T_world_body.linear() * T_body.translation();
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Zero();
  J.topLeftCorner<3, 3>() = F;
  J.bottomRightCorner<3, 3>() = F;
  J.bottomLeftCorner<3, 3>() = cross_matrix(lever) * F;
  const Eigen::Matrix<double, 6, 6> all = J * row.covariance * J.transpose();
  carried.covariance = 0.5 * (all + all.transpose());
  return carried;
}

}  // namespace oneac
