// What every class that MRPT knows does with counts that are not so, not only those in our logs.
#include "log_maker.h"
#include "read/decompressing_stream.h"
#include "read/guarded_stream.h"

#include "oneac/test_support/peak_memory.h"
#include "oneac/test_support/sanitized.h"
#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace oneac {
namespace {

constexpr std::size_t kReads = 40;                           // of an object, whose values are tried
constexpr std::size_t kMost_mb = kSanitized ? 4000U : 900U;  // a sanitizer keeps what was freed

/// Notes in what portions MRPT asks for the bytes of an object.
class Portions : public mrpt::io::CStream {
 public:
  explicit Portions(mrpt::io::CStream& stream) : stream_(stream) {}

  size_t Read(void* buffer, size_t count) override {
    if (sizes.size() == kReads) throw std::runtime_error("enough");
    sizes.push_back(count);
    return stream_.Read(buffer, count);
  }
  size_t Write(const void* /*buffer*/, size_t /*count*/) override { return 0; }
  uint64_t Seek(int64_t /*offset*/, TSeekOrigin /*origin*/) override { return 0; }
  [[nodiscard]] uint64_t getTotalBytesCount() const override { return 0; }
  [[nodiscard]] uint64_t getPosition() const override { return 0; }

  std::vector<std::size_t> sizes;  ///< [byte]

 private:
  mrpt::io::CStream& stream_;
};

std::string head_of(const std::string& class_name, int version) {
  return static_cast<char>(0x80U | class_name.size()) + class_name + static_cast<char>(version);
}

void read_object(mrpt::io::CStream& stream) {
  try {
    auto archive = mrpt::serialization::archiveFrom<mrpt::io::CStream>(stream);
    static_cast<void>(archive.ReadObject());
  } catch (const std::exception&) {
    // MRPT refuses it: fine
  }
}

template <typename T>
std::string bytes_of(T value) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  return bytes;
}

/// What a count, or the limits of a grid, of that many bytes may claim.
std::vector<std::string> claims(std::size_t portion) {
  if (portion == 4) {
    return {bytes_of(GuardedStream::kLargestCount), bytes_of(0xffffffffU), bytes_of(1e9F),
            bytes_of(4U) + "    ", bytes_of(0x0b00U) + bytes_of(0x0b00U)};
  }
  if (portion == 8) return {bytes_of(std::uint64_t{1} << 33), bytes_of(1e9), bytes_of(-1e9)};
  if (portion == 2) return {"\xff\xff\xff\xff"};
  return {};
}

class GuardedClasses : public ::testing::Test {
 protected:
  /// Each of the first numbers in turn claims too much; as many zeros follow as are believed.
  void try_claims(const std::string& head) const {
    std::string before;
    for (const std::size_t portion : portions_of(head)) {
      if (before.size() >= head.size()) {
        for (const std::string& claim : claims(portion)) portions_of(before + claim);
      }
      before += before.size() < head.size() ? head.substr(before.size(), portion)
                                            : std::string(portion, '\0');
    }
  }

 private:
  /// Reads an object that begins with these bytes.
  std::vector<std::size_t> portions_of(const std::string& bytes) const {
    test::write_bytes(file_, bytes);
    std::filesystem::resize_file(file_, bytes.size() + GuardedStream::kLargestCount + 1000U);
    DecompressingStream file(file_);
    GuardedStream guarded(file);
    guarded.begin_record();
    Portions portions(guarded);
    read_object(portions);
    return portions.sizes;
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "drive.rawlog";
};

// Each class in a process of its own, so that neither the peak nor what is left of one class (the
// heap after it, the tables of the libraries it loads) counts for another.
TEST_F(GuardedClasses, NoneTakesAGigabyteWhateverItsCountsClaim) {
  mrpt::obs::CObservationGPS registers_the_classes;
  std::size_t classes = 0;
  for (const auto* known : mrpt::rtti::getAllRegisteredClasses()) {
    if (!known->ptrCreateObject) continue;
    ++classes;
    const auto try_all_versions = [&] {
      for (int version = 0; version < 8; ++version) try_claims(head_of(known->className, version));
      std::fprintf(stderr, "%zu MB\n", peak_mb());
      std::_Exit(peak_mb() < kMost_mb ? 0 : 1);
    };
    EXPECT_EXIT(try_all_versions(), ::testing::ExitedWithCode(0), "") << known->className;
  }
  EXPECT_GT(classes, 50U);
}

TEST(GuardedClaims, TakeNoMemoryBeforeTheirBytesAreThere) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "drive.rawlog";
  test::write_bytes(file, std::string(std::size_t{1} << 20, '\0'));
  const auto look_ahead = [&] {
    const std::size_t before = peak_mb();
    const bool there = DecompressingStream(file).has_bytes(std::size_t{1} << 28);
    std::_Exit(!there && peak_mb() < before + 64U ? 0 : 1);
  };
  EXPECT_EXIT(look_ahead(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace oneac
