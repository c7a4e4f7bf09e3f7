#include "oneac/comparison/comparison.h"

#include "log_run.h"

#include "oneac/base/error.h"

namespace oneac {
namespace {

std::string about_repeated(const std::string& log, const LogScan& scan) {
  return log + ": " + std::to_string(scan.repeated.size()) +
         " images repeat the one before, pixel by pixel (first: " + scan.first_repeated +
         "), and were left out";
}

}  // namespace

std::vector<std::string> run_comparison(const CompareSettings& settings, const Shard& shard,
                                        Journal& journal, const CompareHooks& hooks) {
  internal::Methods methods;
  for (const CompareMethod& method : settings.methods) {
    methods.push_back(make_method(method, settings.method_parameters));
  }
  std::vector<std::string> damage;
  std::size_t done = journal.content().pairs.size();
  for (std::size_t log = 0; log < settings.logs.size() && hooks.keep_going(); ++log) {
    internal::LogRun run(settings, log, hooks);
    if (!run.scan().damage.empty()) damage.push_back(run.scan().damage);
    if (!run.scan().repeated.empty()) hooks.note(about_repeated(settings.logs[log], run.scan()));
    if (!run.begin(journal)) continue;
    try {
      run.run(methods, shard, journal, done);
    } catch (const InputError& error) {  // an image: what came before it is in the journal
      damage.emplace_back(error.what());
    }
  }
  return damage;
}

}  // namespace oneac
