#pragma once

#include "oneac/geometry/camera.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oneac {

/// Names the place in a calibration file that an error is about.
class CalibrationPlace {
 public:
  /// @param place  "section [cam0]" or "line 4"
  CalibrationPlace(const std::filesystem::path& file, std::string place)
      : file_(file), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& fault, const std::string& cure) const;
  /// @throws InputError naming `key` for what is no finite number
  [[nodiscard]] std::vector<double> numbers(const std::string& key,
                                            const std::vector<std::string>& words) const;

 private:
  std::filesystem::path file_;
  std::string place_;
};

// Each sets a part of a camera. @throws InputError naming the place and key

/// [width height]; 0 0 where the file has none.
void set_size(const std::vector<double>& size, const std::string& key,
              const CalibrationPlace& place, PinholeCamera& camera);
/// fx fy cx cy.
void set_intrinsics(const std::vector<double>& four, const std::string& key,
                    const CalibrationPlace& place, PinholeCamera& camera);
/// A row-major 3×3 or 3×4 K or P, without skew.
void set_matrix(const std::vector<double>& entries, const std::string& key,
                const CalibrationPlace& place, PinholeCamera& camera);
/// The coefficients of a lens model under any of the names that tools give it: plumb_bob, radtan,
/// radial-tangential, rational_polynomial, PinHole; equidistant, fisheye, kannala_brandt,
/// KannalaBrandt8; none.
void set_lens(const std::string& model, const std::vector<double>& coefficients,
              const CalibrationPlace& place, PinholeCamera& camera);

}  // namespace oneac
