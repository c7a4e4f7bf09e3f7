#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oneac {

/// A borrowed 8-bit grey image. Pixel (u, v), u to the right, v downwards: data[v * stride + u].
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int stride = 0;  ///< bytes from one row to the next

  /// No pixels.
  [[nodiscard]] bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
};

/// An owned 8-bit grey image without row padding. A value: copies are deep, moves are cheap.
class GreyImage {
 public:
  GreyImage() = default;
  /// @throws std::invalid_argument when a side is negative
  GreyImage(int width, int height, std::uint8_t fill = 0);
  /// Deep copy of a view.
  explicit GreyImage(const ImageView& view);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// No pixels.
  [[nodiscard]] bool empty() const { return pixels_.empty(); }
  [[nodiscard]] ImageView view() const { return {pixels_.data(), width_, height_, width_}; }
  [[nodiscard]] std::uint8_t* row(int v) { return pixels_.data() + offset(v); }
  [[nodiscard]] const std::uint8_t* row(int v) const { return pixels_.data() + offset(v); }

 private:
  [[nodiscard]] std::size_t offset(int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace oneac
