#include "oneac/base/parameter_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace oneac {
namespace {

struct Inner {
  double gain = 0.1;
  bool on = true;
};
template <class Visitor>
void describe(Visitor&& visit, Inner& o) {
  visit("gain", o.gain, "-", "how much");
  visit("on", o.on, "bool", "whether");
}

struct Outer {
  int count = 3;
  std::size_t first = 0;
  std::string name = "a \"b\"";
  Inner inner;
};
template <class Visitor>
void describe(Visitor&& visit, Outer& o) {
  visit("count", o.count, "count", "how many");
  visit("first", o.first, "index", "where");
  visit("name", o.name, "name", "who");
  visit.section("inner", o.inner);
}

std::string message_of_setting(const std::string& key, const std::string& text) {
  Outer options;
  ParameterTable table;
  table.add("top", options);
  try {
    table.set(key, text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ParameterTable, SetsNestedFieldsOfEveryType) {
  Outer options;
  ParameterTable table;
  table.add("top", options);
  table.set("top.count", "-7");
  table.set("top.first", "12");
  table.set("top.name", "new");
  table.set("top.inner.gain", "2.5e-3");
  table.set("top.inner.on", "false");
  EXPECT_EQ(options.count, -7);
  EXPECT_EQ(options.first, 12U);
  table.set("top.count", "+8");
  EXPECT_EQ(options.count, 8);
  EXPECT_EQ(options.name, "new");
  EXPECT_DOUBLE_EQ(options.inner.gain, 2.5e-3);
  EXPECT_FALSE(options.inner.on);
}

TEST(ParameterTable, SuggestsTheNearestKey) {
  EXPECT_EQ(message_of_setting("top.iner.gain", "1"),
            "unknown key 'top.iner.gain', did you mean 'top.inner.gain'?");
}

TEST(ParameterTable, RefusesTextOfTheWrongTypeAndKeepsTheOldValue) {
  EXPECT_EQ(message_of_setting("top.count", "1.5"),
            "key 'top.count' must be a whole number, not '1.5'");
  EXPECT_NE(message_of_setting("top.first", "-1"), "");
  EXPECT_NE(message_of_setting("top.count", "+-1"), "");
  EXPECT_NE(message_of_setting("top.inner.gain", "1 m"), "");
  EXPECT_NE(message_of_setting("top.inner.on", "yes"), "");
}

TEST(ParameterTable, WritesYamlWithSectionsAndUnits) {
  Outer options;
  ParameterTable table;
  table.add("top", options);
  EXPECT_EQ(table.to_yaml(false),
            "top:\n  count: 3\n  first: 0\n  name: \"a \\\"b\\\"\"\n  inner:\n    gain: 0.1\n"
            "    on: true\n");
  EXPECT_NE(table.to_yaml(true).find("# [-] how much"), std::string::npos);
}

}  // namespace
}  // namespace oneac
