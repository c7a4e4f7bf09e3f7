#include "oneac/evaluation/covariance_io.h"

#include "evaluation_test_tools.h"

#include "oneac/test_support/temporary_folder.h"

#include <limits>
#include <random>
#include <stdexcept>

namespace oneac {
namespace {

std::vector<CovarianceRow> random_rows(std::size_t count) {
  std::mt19937 draw(7);
  std::normal_distribution<double> normal(0.0, 1e-3);
  std::vector<CovarianceRow> rows;
  for (std::size_t k = 0; k < count; ++k) {
    CovarianceRow row;
    row.index1 = 2 * k;
    row.index2 = 2 * k + 2;
    Eigen::Matrix<double, 6, 6> root;
    for (double& entry : root.reshaped()) entry = normal(draw);
    const Eigen::Matrix<double, 6, 6> square = root * root.transpose();
    row.covariance = 0.5 * (square + square.transpose());
    if (k % 2 == 0) row.position_sigma = Eigen::Vector3d(0.1 * static_cast<double>(k), 0.02, 1.0);
    rows.push_back(row);
  }
  return rows;
}

class CovarianceFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    return write_text(folder_.path() / "covariance.csv", text);
  }
  std::string error(const std::string& text) {
    const auto path = file(text);
    return input_error_of([&] { (void)read_covariances(path); });
  }
  TemporaryFolder folder_;
};

TEST_F(CovarianceFile, RoundTripKeepsEveryNumber) {
  const auto written = random_rows(20);
  const auto read = read_covariances(file(format_covariances(written)));
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_EQ(read[k].index1, written[k].index1);
    EXPECT_EQ(read[k].index2, written[k].index2);
    EXPECT_EQ(read[k].covariance, written[k].covariance);
    EXPECT_EQ(read[k].position_sigma, written[k].position_sigma);
  }
}

TEST_F(CovarianceFile, SaysWhatIsWrongWithALine) {
  const std::string text = format_covariances(random_rows(2));
  const std::string head = text.substr(0, text.find('\n') + 1);
  EXPECT_NE(error("index1,index2\n0,1\n").find("is no covariance.csv"), std::string::npos);
  EXPECT_NE(error(head + "0,1,2\n").find("line 2: 3 fields, needs 26"), std::string::npos);
  std::string word = text;
  word.replace(head.size(), 1, "x");
  EXPECT_NE(error(word).find("'x' is not a whole number"), std::string::npos);
}

TEST(FormatCovariances, RefusesWhatIsNotFinite) {
  auto rows = random_rows(1);
  rows[0].covariance(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)format_covariances(rows), std::invalid_argument);
  rows = random_rows(1);
  rows[0].position_sigma = Eigen::Vector3d(0.0, std::numeric_limits<double>::infinity(), 0.0);
  EXPECT_THROW((void)format_covariances(rows), std::invalid_argument);
}

}  // namespace
}  // namespace oneac
