#include "writing_support.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>

namespace oneac::test {

namespace fs = std::filesystem;

std::vector<mrpt::obs::CObservation::Ptr> read_with_mrpt(const fs::path& log) {
  mrpt::io::CFileGZInputStream stream(log.string());
  auto archive = mrpt::serialization::archiveFrom(stream);
  std::vector<mrpt::obs::CObservation::Ptr> observations;
  try {
    for (;;) {
      const auto object = archive.ReadObject();
      observations.push_back(std::dynamic_pointer_cast<mrpt::obs::CObservation>(object));
      EXPECT_NE(observations.back(), nullptr);
    }
  } catch (const mrpt::serialization::CExceptionEOF&) {
    return observations;
  }
}

std::string rawlog_edit_info(const fs::path& log) {
  const std::string command = "rawlog-edit --info -i '" + log.string() + "' 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  std::array<char, 512> buffer{};
  while (pipe != nullptr && std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    output += buffer.data();
  }
  EXPECT_EQ(pipe == nullptr ? -1 : ::pclose(pipe), 0)
      << "rawlog-edit (Debian package mrpt-apps) failed: " << output;
  return output;
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream.good()) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

void write_image(const fs::path& file, int width, int height) {
  fs::create_directories(file.parent_path());
  cv::Mat image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      image.at<unsigned char>(v, u) = static_cast<unsigned char>(2 * u + v);
  }
  ASSERT_TRUE(cv::imwrite(file.string(), image)) << file;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace oneac::test
