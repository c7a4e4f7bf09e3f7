#include "read/decompressing_stream.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oneac {
namespace {

using test::Packing;

// Larger than the stream's buffers, and does not compress to nothing.
std::string long_data() {
  std::string data;
  std::uint32_t state = 1;
  while (data.size() < 800000) {
    state = state * 1664525U + 1013904223U;
    data.push_back(static_cast<char>(state >> 24U));
  }
  return data;
}

std::string read_all(DecompressingStream& stream) {
  std::string all;
  std::string piece(7777, '\0');
  while (const std::size_t n = stream.Read(piece.data(), piece.size())) all.append(piece, 0, n);
  return all;
}

class PackedLog : public ::testing::TestWithParam<Packing> {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "log";
};

TEST_P(PackedLog, DeliversEveryByteAndEndsCleanly) {
  test::write_bytes(file_, test::packed_bytes(long_data(), GetParam()));
  DecompressingStream stream(file_);
  EXPECT_TRUE(read_all(stream) == long_data());
  EXPECT_TRUE(stream.at_end());
  EXPECT_EQ(stream.fault(), "");
  EXPECT_DOUBLE_EQ(stream.progress(), 1.0);
}

TEST_P(PackedLog, DeliversWhatComesBeforeACut) {
  std::string bytes = test::packed_bytes(long_data(), GetParam());
  bytes.resize(bytes.size() * 3 / 4);
  test::write_bytes(file_, bytes);
  DecompressingStream stream(file_);
  const std::string read = read_all(stream);
  const std::string whole = long_data();
  ASSERT_GT(read.size(), whole.size() / 2);
  EXPECT_TRUE(read == whole.substr(0, read.size()));
  if (GetParam() != Packing::plain) {
    EXPECT_NE(stream.fault().find("ends early"), std::string::npos) << stream.fault();
  }
}

INSTANTIATE_TEST_SUITE_P(Packings, PackedLog,
                         ::testing::Values(Packing::plain, Packing::gzip, Packing::zstd));

class CompressedStream : public PackedLog {};

TEST_P(CompressedStream, ReportsDamage) {
  std::string bytes = test::packed_bytes(long_data(), GetParam());
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2), bytes.end(), '\x5a');
  test::write_bytes(file_, bytes);
  DecompressingStream stream(file_);
  static_cast<void>(read_all(stream));
  EXPECT_NE(stream.fault(), "");
}

TEST_P(CompressedStream, ReadsConcatenatedFiles) {
  const std::string part = test::packed_bytes(long_data(), GetParam());
  test::write_bytes(file_, part + part);
  DecompressingStream stream(file_);
  EXPECT_TRUE(read_all(stream) == long_data() + long_data());
  EXPECT_EQ(stream.fault(), "");
}

INSTANTIATE_TEST_SUITE_P(Packings, CompressedStream,
                         ::testing::Values(Packing::gzip, Packing::zstd));

TEST_F(PackedLog, OfAFileThatWasPackedTwiceIsRead) {
  for (const Packing outer : {Packing::gzip, Packing::zstd}) {
    const std::string inner = test::packed_bytes(long_data(), Packing::gzip);
    std::string bytes = test::packed_bytes(inner, outer);
    test::write_bytes(file_, bytes);
    DecompressingStream stream(file_);
    EXPECT_TRUE(read_all(stream) == long_data());
    EXPECT_TRUE(stream.at_end());
    EXPECT_EQ(stream.fault(), "");
    bytes.resize(bytes.size() * 3 / 4);
    test::write_bytes(file_, bytes);
    DecompressingStream cut(file_);
    const std::string read = read_all(cut);
    EXPECT_GT(read.size(), long_data().size() / 2);
    EXPECT_TRUE(read == long_data().substr(0, read.size()));
    EXPECT_NE(cut.fault().find("ends early"), std::string::npos) << cut.fault();
  }
}

TEST_F(PackedLog, OfAFewBytesIsRead) {
  for (const std::string data : {"", "a", "abc"}) {
    test::write_bytes(file_, test::packed_bytes(data, Packing::gzip));
    DecompressingStream stream(file_);
    EXPECT_EQ(read_all(stream), data);
    EXPECT_EQ(stream.fault(), "");
  }
}

TEST_F(PackedLog, RefusesReadsOfAbsurdSize) {
  test::write_bytes(file_, long_data());
  DecompressingStream stream(file_);
  char one = 0;
  EXPECT_EQ(stream.Read(&one, std::size_t{1} << 40), 0U);
  EXPECT_NE(stream.fault().find("absurd size"), std::string::npos);
}

TEST_F(PackedLog, RefusesWhatIsNoFile) {
  const auto fault = [](const std::filesystem::path& path) {
    return test::input_error([&] { const DecompressingStream stream(path); });
  };
  EXPECT_NE(fault(folder_.path() / "none").find("no such file"), std::string::npos);
  EXPECT_NE(fault(folder_.path()).find("folder"), std::string::npos);
  test::write_bytes(file_, "");
  EXPECT_NE(fault(file_).find("empty"), std::string::npos);
}

}  // namespace
}  // namespace oneac
