#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace oneac {

/// Whether the numbers in the names of images rise as time does. Names that were sorted as text
/// (1, 10, 11, 2) and then stamped in this order do not.
class NameOrder {
 public:
  /// The file of the next image, in order of time.
  void add(const std::string& file);
  /// One line with the cure when numbers fall again and again; a counter that begins anew, or two
  /// recordings one after the other, fall once.
  [[nodiscard]] std::string fault() const;

 private:
  struct Numbered {
    std::string name;
    std::string digits;  ///< without zeros in front
  };
  std::optional<Numbered> last_;
  std::size_t numbered_ = 0, falls_ = 0;
  std::string first_fall_;
};

}  // namespace oneac
