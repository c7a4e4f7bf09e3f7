#include "terminal/own_results.h"

#include "oneac/base/error.h"
#include "oneac/base/input_file.h"

#include <string>

namespace oneac::app {

void require_own(const char* verb, const std::filesystem::path& folder,
                 const std::vector<ResultMark>& results) {
  constexpr std::size_t kBeginning = 400;  // [byte]
  const std::string another = "name another folder with -o";
  for (const ResultMark& result : results) {
    const std::filesystem::path file = folder / result.name;
    if (const std::string fault = fault_of_place(file); !fault.empty()) {
      throw InputError(file.string(), fault + " and has the name of a result",
                       "take it away, or " + another);
    }
    const std::string beginning = beginning_of(file, kBeginning);  // "" of none, or an empty one
    if (beginning.empty() || beginning.find(result.mark) != std::string::npos) continue;
    throw InputError(file.string(),
                     std::string("no ") + verb + " has written it, and this one would overwrite it",
                     another);
  }
}

}  // namespace oneac::app
