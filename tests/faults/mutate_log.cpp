// oneac_mutate_log LOG COUNT [FIRST_SEED]: reads COUNT injured copies of a rawlog, half of them
// injured in the file as it is, half in its plain content, each in a process of its own; counts
// how they end. Exit code 1 when one crashes, hangs, takes over 1 GB, or throws what it may not.
#include "oneac/base/error.h"
#include "oneac/rawlog/log_summary.h"
#include "oneac/rawlog/rawlog_source.h"
#include "oneac/test_support/mutation.h"
#include "oneac/test_support/peak_memory.h"
#include "oneac/test_support/sanitized.h"
#include "oneac/test_support/temporary_folder.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace oneac {
namespace {

constexpr unsigned kLongest_s = 10;           // of work: a busy or suspended machine is no hang
constexpr unsigned kLongestWait_s = 10 * 60;  // without work
constexpr std::size_t kMostMemory_mb = kSanitized ? 4096 : 1024;
constexpr std::size_t kImages = 2;  // decoded per copy; the decoder has faults of its own

enum Ending { kWhole = 0, kFewer = 9, kLossStated = 10, kRefused = 11, kOtherException = 12 };

const char* name_of(int ending) {
  switch (ending) {
    case kWhole:
      return "as many images as the original: no trace, or a number changed";
    case kFewer:
      return "fewer images, as if whole records had been cut out";
    case kLossStated:
      return "the loss stated (exit 0 with a note, or 2)";
    case kRefused:
      return "refused in one line (exit 2)";
    case kOtherException:
      return "THREW WHAT IT MAY NOT";
    case 128 + SIGXCPU:
    case 128 + SIGALRM:
      return "HUNG";
    default:
      return "CRASHED";
  }
}

struct Reading {
  std::size_t frames = 0;
  std::size_t missing = 0;
  bool damaged = false;       ///< and says so
  bool out_of_order = false;  ///< and says so
};

Reading read_log(const SourceOptions& options) {
  SummaryOptions summary_options;
  summary_options.log = options.log;
  summary_options.images_dir = options.images_dir;
  const LogSummary summary = summarise_log(summary_options);
  static_cast<void>(to_text(summary));
  RawlogSource source(options);
  Reading reading;
  double last = -1.0;
  while (const auto ticket = source.next()) {
    if (reading.frames++ < kImages) static_cast<void>(source.load(*ticket));
    reading.out_of_order = reading.out_of_order || ticket->time_s <= last;
    last = std::max(last, ticket->time_s);
  }
  source.finish();
  reading.damaged = !source.report().damage.empty();
  reading.missing = source.report().images_missing;
  return reading;
}

int compared(const Reading& copy, const Reading& original) {
  if (copy.damaged || copy.out_of_order || copy.missing > original.missing) return kLossStated;
  return copy.frames == original.frames && copy.missing == original.missing ? kWhole : kFewer;
}

int ending_of(const SourceOptions& options, const Reading& original) {
  try {
    return compared(read_log(options), original);
  } catch (const InputError&) {
    return kRefused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kOtherException;
  }
}

/// The content of a gzip file, or of one that is not compressed.
std::string plain_content(const std::string& file) {
  gzFile in = gzopen(file.c_str(), "rb");
  if (in == nullptr) throw std::runtime_error(file + " cannot be opened");
  std::string content;
  std::array<char, 65536> piece{};
  int count = 0;
  while ((count = gzread(in, piece.data(), static_cast<unsigned>(piece.size()))) > 0) {
    content.append(piece.data(), static_cast<std::size_t>(count));
  }
  gzclose(in);
  if (count < 0) throw std::runtime_error(file + " cannot be read");
  return content;
}

/// The originals; images that a copy is to find are taken from a folder of the original.
struct Original {
  std::string as_it_is;
  std::string plain;
  SourceOptions options;
  Reading reading;
};

Original load_original(const std::string& log) {
  std::ifstream in(log, std::ios::binary);
  Original original{{std::istreambuf_iterator<char>(in), {}}, plain_content(log), {}, {}};
  const std::filesystem::path home = std::filesystem::absolute(log).parent_path();
  for (const char* folder : {"Images", "."}) {
    if (!std::filesystem::is_directory(home / folder)) continue;
    original.options.images_dir = home / folder;
    break;
  }
  original.options.log = log;
  original.reading = read_log(original.options);
  return original;
}

struct Outcome {
  int ending = 0;
  std::size_t peak_mb = 0;
};

void limit_time() {
  const rlimit limit{kLongest_s, kLongest_s + 1};
  ::setrlimit(RLIMIT_CPU, &limit);
  ::alarm(kLongestWait_s);
}

Outcome read_copy(const Original& original, std::uint64_t seed, const std::filesystem::path& copy) {
  const std::string& bytes = seed % 2 == 0 ? original.as_it_is : original.plain;
  std::ofstream(copy, std::ios::binary) << mutated(bytes, seed);
  const pid_t child = ::fork();
  if (child == 0) {
    limit_time();
    SourceOptions options = original.options;
    options.log = copy;
    ::_exit(ending_of(options, original.reading));
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), peak_mb(usage)};
}

bool is_sound(const Outcome& outcome) {
  return outcome.ending <= kRefused && outcome.peak_mb < kMostMemory_mb;
}

int run(const std::string& log, std::uint64_t count, std::uint64_t first) {
  const Original original = load_original(log);
  const TemporaryFolder folder;
  std::map<int, std::size_t> endings;
  std::pair<std::size_t, std::uint64_t> peak_mb{0, first};  // and the seed
  std::size_t unsound = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Outcome outcome = read_copy(original, seed, folder.path() / "copy.rawlog");
    ++endings[outcome.ending];
    peak_mb = std::max(peak_mb, {outcome.peak_mb, seed});
    if (is_sound(outcome)) continue;
    ++unsound;
    std::printf("seed %llu: ending %d, %zu MB\n", static_cast<unsigned long long>(seed),
                outcome.ending, outcome.peak_mb);
  }
  for (const auto& [ending, n] : endings) std::printf("%7zu  %s\n", n, name_of(ending));
  std::printf("%7zu  MB of memory at most, seed %llu\n", peak_mb.first,
              static_cast<unsigned long long>(peak_mb.second));
  return unsound == 0 ? 0 : 1;
}

}  // namespace
}  // namespace oneac

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "oneac_mutate_log LOG COUNT [FIRST_SEED]\n");
    return 2;
  }
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
  return oneac::run(argv[1], std::strtoull(argv[2], nullptr, 10), first);
}
