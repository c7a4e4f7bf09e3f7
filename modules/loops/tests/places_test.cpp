#include "place_index.h"
#include "vocabulary.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace oneac::internal {
namespace {

using Words = std::vector<std::vector<std::uint32_t>>;

TEST(PlaceIndex, FindsThePlaceThatSharesWords) {
  const Words words = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {4, 5, 10}};
  const auto places = PlaceIndex(words, 11).alike(3, 3, 3, 0);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].keyframe, 1U);
}

TEST(PlaceIndex, WordsOfEveryPlaceTellNothing) {
  const Words words = {{0, 1}, {0, 2}, {0, 3}, {0, 2}};
  const auto places = PlaceIndex(words, 4).alike(3, 3, 3, 0);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].keyframe, 1U);
}

TEST(PlaceIndex, LooksNoFurtherThanItsEndAndTakesOneOfEachPlace) {
  const Words words = {{9}, {1, 2, 3}, {1, 2, 3, 4}, {5}, {6}, {1, 2}, {1, 2, 3, 4}};
  const PlaceIndex index(words, 10);
  const auto places = index.alike(6, 5, 5, 1);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].keyframe, 2U);
  EXPECT_EQ(index.alike(6, 6, 5, 1).size(), 2U);
  EXPECT_TRUE(index.alike(6, 0, 5, 1).empty());
}

Descriptors8 random_descriptors(unsigned seed, int count) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> value(0, 60);
  Descriptors8 descriptors(count, 128);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 128; ++k) descriptors(i, k) = static_cast<std::uint8_t>(value(generator));
  }
  return descriptors;
}

TEST(Vocabulary, IsTheSameEveryTime) {
  const Descriptors8 a = random_descriptors(1, 900), b = random_descriptors(2, 900);
  const Vocabulary one = Vocabulary::learn({&a, &b}), two = Vocabulary::learn({&a, &b});
  EXPECT_GE(one.size(), 100U);
  EXPECT_EQ(one.size(), two.size());
  EXPECT_EQ(one.words_of(a), two.words_of(a));
}

TEST(Vocabulary, NamesAlikeDescriptorsAlike) {
  const Descriptors8 a = random_descriptors(1, 900);
  const Vocabulary vocabulary = Vocabulary::learn({&a});
  Descriptors8 near = a;
  near.col(5) = (near.col(5).array() + 1).matrix();
  const auto words = vocabulary.words_of(a), again = vocabulary.words_of(near);
  std::size_t same = 0;
  for (std::size_t i = 0; i < words.size(); ++i) same += words[i] == again[i] ? 1 : 0;
  EXPECT_GT(same, words.size() * 9 / 10);
}

TEST(Vocabulary, OfADriveWithoutFeaturesHasOneWord) {
  const Descriptors8 none(0, 128);
  const Vocabulary vocabulary = Vocabulary::learn({&none});
  EXPECT_EQ(vocabulary.size(), 1U);
  EXPECT_TRUE(vocabulary.words_of(none).empty());
}

}  // namespace
}  // namespace oneac::internal
