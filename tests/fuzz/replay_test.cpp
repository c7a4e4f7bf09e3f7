// Every target on every file of its corpus, found cases included; and on injured copies of them.
#include "fuzz.h"

#include "oneac/test_support/mutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oneac::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kCopies = 100;

std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

std::vector<fs::path> corpus_of(const std::string& name) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(ONEAC_FUZZ_CORPUS) / name)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void replay(const std::string& name) {
  const Target target = targets().at(name);
  target("");
  const auto files = corpus_of(name);
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const std::string data = content_of(file);
    EXPECT_NO_THROW(target(data));
    for (std::uint64_t seed = 0; seed < kCopies; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const std::string copy = mutated(data, seed);
      EXPECT_NO_THROW(target(copy));
    }
  }
}

class Replay : public ::testing::Test {
 public:
  explicit Replay(std::string target) : target_(std::move(target)) {}
  void TestBody() override { replay(target_); }

 private:
  std::string target_;
};

}  // namespace

bool add_target(const char* name, Target target) {
  return targets().emplace(name, target).second;
}

// The targets register themselves before main, the tests are made of them here.
void register_tests() {
  for (const auto& entry : targets()) {
    const std::string name = entry.first;
    ::testing::RegisterTest("Fuzz", name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [name]() -> ::testing::Test* { return new Replay(name); });
  }
}

}  // namespace oneac::fuzz

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  oneac::fuzz::register_tests();
  return RUN_ALL_TESTS();
}
