#pragma once

#include "oneac/geometry/affine_correspondence.h"

#include <cstddef>
#include <vector>

namespace oneac {

/// A borrowed run of affine correspondences, as C++20's std::span<const AffineCorrespondence>.
class AcSpan {
 public:
  AcSpan() = default;
  AcSpan(const AffineCorrespondence* data, std::size_t size) : data_(data), size_(size) {}
  AcSpan(const std::vector<AffineCorrespondence>& acs)
      : AcSpan(acs.data(), acs.size()) {}  // NOLINT

  [[nodiscard]] const AffineCorrespondence* begin() const { return data_; }
  [[nodiscard]] const AffineCorrespondence* end() const { return data_ + size_; }
  [[nodiscard]] const AffineCorrespondence& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }

 private:
  const AffineCorrespondence* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace oneac
