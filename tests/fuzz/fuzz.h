#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

// A fuzz target is ONEAC_FUZZ_TARGET(name) { ... } over `std::string_view data`. The preset `fuzz`
// makes a libFuzzer program of it; the tests run it on the files of corpus/<name>.
#ifdef ONEAC_LIBFUZZER
#define ONEAC_FUZZ_TARGET(name)                                                     \
  static void fuzz_##name(std::string_view data);                                   \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n) { \
    fuzz_##name({reinterpret_cast<const char*>(bytes), n});                         \
    return 0;                                                                       \
  }                                                                                 \
  static void fuzz_##name(std::string_view data)
#else
#define ONEAC_FUZZ_TARGET(name)                                                         \
  static void fuzz_##name(std::string_view data);                                       \
  static const bool name##_is_registered = oneac::fuzz::add_target(#name, fuzz_##name); \
  static void fuzz_##name(std::string_view data)
#endif

namespace oneac::fuzz {

using Target = void (*)(std::string_view data);
bool add_target(const char* name, Target target);

/// A finding: what holds for every input does not.
inline void check(bool holds, const char* what) {
  if (!holds) throw std::logic_error(std::string("does not hold: ") + what);
}

/// A file in memory with a name that readers can open; one per thread, reused.
[[nodiscard]] std::filesystem::path file_with(std::string_view content);

/// Takes numbers from the front of the data; zeros when it is used up.
class Numbers {
 public:
  explicit Numbers(std::string_view data) : data_(data) {}
  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] std::uint8_t byte();
  /// Any double: as the bits say, or (half of the time) one as images have them, −2 … 2.
  [[nodiscard]] double number();

 private:
  std::string_view data_;
};

}  // namespace oneac::fuzz
