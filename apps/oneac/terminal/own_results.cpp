#include "terminal/own_results.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <string>

namespace oneac::app {
namespace {

constexpr std::size_t kBeginning = 400;  // [byte]
constexpr const char* kAnother = "name another folder with -o";

}  // namespace

bool has_mark(const std::filesystem::path& file, std::string_view mark) {
  return beginning_of(file, kBeginning).find(mark) != std::string::npos;
}

void require_result_place(const std::filesystem::path& file) {
  const std::string fault = fault_of_place(file);
  if (fault.empty()) return;
  throw InputError(file.string(), fault + " and has the name of a result",
                   std::string("take it away, or ") + kAnother);
}

void require_own(const char* verb, const std::filesystem::path& folder,
                 const std::vector<ResultMark>& results) {
  for (const ResultMark& result : results) {
    const std::filesystem::path file = folder / result.name;
    require_result_place(file);
    // Nothing begins where there is nothing, or an empty file.
    if (beginning_of(file, 1).empty() || has_mark(file, result.mark)) continue;
    throw InputError(file.string(),
                     std::string("no ") + verb + " has written it, and this one would overwrite it",
                     kAnother);
  }
}

}  // namespace oneac::app
