#include "read/log_reader.h"

#include "log_maker.h"

#include "oneac/test_support/temporary_folder.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <vector>

namespace oneac {
namespace {

using test::Packing;
using test::rmc;

class Reader : public ::testing::TestWithParam<Packing> {
 protected:
  std::size_t count(LogReader& reader) {
    std::size_t n = 0;
    while (reader.next()) ++n;
    return n;
  }
  std::string open_fault() const {
    return test::input_error([&] { const LogReader reader(file_); });
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "drive.rawlog";
};

test::Objects many(int n) {
  test::Objects objects;
  for (int i = 0; i < n; ++i) objects.push_back(rmc(i, 1.0 + i, i % 360));
  return objects;
}

TEST_P(Reader, ReadsObservationsInOrder) {
  test::write_log(file_, many(50), GetParam());
  LogReader reader(file_);
  for (std::size_t i = 0; i < 50; ++i) {
    const auto record = reader.next();
    ASSERT_TRUE(record);
    EXPECT_EQ(record->number, i);
    EXPECT_EQ(record->observation->sensorLabel, "GPS");
  }
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.damage());
  EXPECT_EQ(reader.format(), "observations");
  const std::string names[] = {"plain", "gzip", "zstd"};
  EXPECT_EQ(reader.compression(), names[static_cast<std::size_t>(GetParam())]);
}

TEST_P(Reader, UsesWhatComesBeforeACutAndSaysWhereItIs) {
  const int n = 2000;
  std::string bytes = test::packed(many(n), GetParam());
  bytes.resize(bytes.size() * 3 / 4 - 3);
  test::write_bytes(file_, bytes);
  LogReader reader(file_);
  const std::size_t read = count(reader);
  EXPECT_GT(read, 1000U);
  EXPECT_LT(read, 2000U);
  ASSERT_TRUE(reader.damage());
  const std::string damage = reader.damage()->what();
  EXPECT_NE(damage.find("drive.rawlog: record " + std::to_string(read)), std::string::npos)
      << damage;
  EXPECT_NE(damage.find("copy the log again"), std::string::npos) << damage;
  EXPECT_EQ(damage.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Packings, Reader,
                         ::testing::Values(Packing::plain, Packing::gzip, Packing::zstd));

TEST_F(Reader, ReadsBothFormatsMixed) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(rmc(1, 1, 1));
  *frame += mrpt::obs::CObservation::Ptr(rmc(1, 2, 2));
  test::write_log(file_, {mrpt::obs::CObservationComment::Create(),
                          mrpt::obs::CActionCollection::Create(), frame, rmc(2, 3, 3)});
  LogReader reader(file_);
  EXPECT_EQ(reader.next()->number, 0U);
  EXPECT_EQ(reader.next()->number, 2U);
  EXPECT_EQ(reader.next()->number, 2U);
  EXPECT_EQ(reader.next()->number, 3U);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.format(), "mixed");
}

mrpt::obs::CActionCollection::Ptr driven(double ahead, double turn, double time_s) {
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({ahead, 0.0, turn}, {});
  movement.timestamp = time_s > 0.0 ? mrpt::Clock::fromDouble(time_s) : INVALID_TIMESTAMP;
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(movement);
  return actions;
}

TEST_F(Reader, AddsUpTheOdometryOfActions) {
  auto frame = mrpt::obs::CSensoryFrame::Create();
  *frame += mrpt::obs::CObservation::Ptr(rmc(12, 1, 1));
  test::write_log(file_, {driven(2.0, M_PI / 2, 1300000000.0), driven(NAN, 0.0, 1300000001.0),
                          driven(2.0, M_PI / 2, 1300000002.0), driven(1.0, 0.0, 0.0), frame});
  LogReader reader(file_);
  std::vector<mrpt::obs::CObservationOdometry::Ptr> told;
  mrpt::Clock::time_point of_frame;
  while (const auto record = reader.next()) {
    const auto wheels =
        std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(record->observation);
    if (wheels) told.push_back(wheels);
    if (!wheels) of_frame = record->observation->timestamp;
  }
  ASSERT_EQ(told.size(), 3U);
  EXPECT_NEAR(told[0]->odometry.x(), 2.0, 1e-9);
  EXPECT_NEAR(told[1]->odometry.x(), 2.0, 1e-9);  // begun anew
  EXPECT_NEAR(told[2]->odometry.x(), 2.0, 1e-9);
  EXPECT_NEAR(told[2]->odometry.y(), 1.0, 1e-9);
  EXPECT_EQ(told[0]->timestamp, mrpt::Clock::fromDouble(1300000000.0));
  EXPECT_EQ(told[2]->timestamp, of_frame);
}

TEST_F(Reader, StopsAtARecordThatIsGarbage) {
  test::write_bytes(file_, test::packed(many(3)) + std::string(200, 'x'));
  LogReader reader(file_);
  EXPECT_EQ(count(reader), 3U);
  ASSERT_TRUE(reader.damage());
  EXPECT_NE(std::string(reader.damage()->what()).find("record 3"), std::string::npos);
}

// As an old record of a class is whose form a newer MRPT has dropped.
TEST_F(Reader, NamesTheClassWhoseFormThisReleaseDoesNotRead) {
  const std::string name = "CObservationComment";
  const char length = static_cast<char>(0x80U | name.size());
  const std::string record = length + name + '\x7e' + std::string(40, '\0');
  test::write_bytes(file_, record);
  EXPECT_NE(open_fault().find("record 0: this release of MRPT cannot read its"), std::string::npos)
      << open_fault();
  EXPECT_NE(open_fault().find(name), std::string::npos) << open_fault();
  EXPECT_NE(open_fault().find("rawlog-edit"), std::string::npos) << open_fault();
  test::write_bytes(file_, test::packed(many(3)) + record);
  LogReader reader(file_);
  EXPECT_EQ(count(reader), 3U);
  ASSERT_TRUE(reader.damage());
  EXPECT_NE(std::string(reader.damage()->what()).find(name), std::string::npos)
      << reader.damage()->what();
}

TEST_F(Reader, RefusesWhatIsNoRawlog) {
  test::write_bytes(file_, "This is a text file.\nIt has two lines.\n");
  EXPECT_NE(open_fault().find("not a readable rawlog (this is not an MRPT object)"),
            std::string::npos)
      << open_fault();
  test::write_bytes(file_, std::string(1000, '\0'));
  EXPECT_NE(open_fault().find("not a readable rawlog"), std::string::npos) << open_fault();
  test::write_log(file_, {std::make_shared<mrpt::poses::CPose3D>()});
  EXPECT_NE(open_fault().find("CPose3D"), std::string::npos) << open_fault();
  test::write_bytes(file_, "");
  EXPECT_NE(open_fault().find("empty"), std::string::npos) << open_fault();
}

TEST_F(Reader, RefusesAnArchiveThatHoldsNothing) {
  for (const auto packing : {Packing::gzip, Packing::zstd}) {
    test::write_log(file_, {}, packing);
    EXPECT_NE(open_fault().find("holds no record"), std::string::npos) << open_fault();
  }
}

TEST_F(Reader, RefusesAZstdLogThatIsDamagedFromTheStart) {
  std::string bytes = test::packed(many(200), Packing::zstd);
  for (std::size_t i = 8; i < bytes.size(); ++i) bytes[i] = static_cast<char>(0xff);
  test::write_bytes(file_, bytes);
  EXPECT_NE(open_fault().find("zstd data is damaged"), std::string::npos) << open_fault();
  EXPECT_EQ(open_fault().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace oneac
