#include "oneac/comparison/method_faults.h"

#include "oneac/comparison/tables.h"

#include <cstddef>

namespace oneac {
namespace {

constexpr std::size_t kMostTold = 3;  // pairs by name; pairs.csv has them all

std::string pair_name(const ComparisonData& data, const PairRecord& pair) {
  return name_of_log(data, pair.log) + " " + std::to_string(pair.index1) + "-" +
         std::to_string(pair.index2);
}

std::string faults_of(const ComparisonData& data, std::size_t method) {
  std::size_t answers = 0, bad = 0;
  std::string told;
  for (const PairRecord& pair : data.pairs) {
    for (const MethodResult& result : pair.results) {
      if (result.method != method) continue;
      ++answers;
      if (result.status != kInvalidAnswer || ++bad > kMostTold) continue;
      told += (told.empty() ? "" : "; ") + pair_name(data, pair) + ": " + result.fault;
    }
  }
  if (bad == 0) return "";
  return "method " + data.methods[method] + ": " + std::to_string(bad) + " of " +
         std::to_string(answers) + " answers cannot be used and count as failures (" + told +
         (bad > kMostTold ? "; …)" : ")");
}

}  // namespace

std::vector<std::string> method_faults(const ComparisonData& data) {
  std::vector<std::string> lines;
  for (std::size_t method = 0; method < data.methods.size(); ++method) {
    const std::string line = faults_of(data, method);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace oneac
