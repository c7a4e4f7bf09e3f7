#pragma once

#include "oneac/base/spool.h"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace oneac {

/// The fields of a record to bytes, one after the other.
class FieldWriter {
 public:
  explicit FieldWriter(std::byte* to) : to_(to) {}
  template <class Value>
  void operator()(const Value& value) {
    array(&value, 1);
  }
  template <class Value>
  void array(const Value* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::memcpy(std::exchange(to_, to_ + count * sizeof(Value)), values, count * sizeof(Value));
  }

 private:
  std::byte* to_;
};

/// The same from bytes.
class FieldReader {
 public:
  explicit FieldReader(const std::byte* from) : from_(from) {}
  template <class Value>
  void operator()(Value& value) {
    array(&value, 1);
  }
  template <class Value>
  void array(Value* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::memcpy(values, std::exchange(from_, from_ + count * sizeof(Value)), count * sizeof(Value));
  }

 private:
  const std::byte* from_;
};

/// How many bytes there are.
class FieldCounter {
 public:
  template <class Value>
  void operator()(const Value&) {
    bytes_ += sizeof(Value);
  }
  template <class Value>
  void array(const Value*, std::size_t count) {
    bytes_ += count * sizeof(Value);
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_ = 0;
};

/// A vector that lies in a Spool. Elements come and go by value: bind none to a reference into a
/// temporary, as `*v[i].optional` is.
/// @tparam Fields  has `template <class Archive, class Value> static void visit(Archive&, Value&)`,
///                 which hands all that is kept of a T or const T, always as much, to the archive:
///                 archive(field), archive.array(pointer, count)
template <class T, class Fields>
class SpooledVector {
 public:
  /// By value, from anywhere to anywhere.
  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = T;

    Iterator(const SpooledVector& of, std::size_t at) : of_(&of), at_(at) {}
    [[nodiscard]] T operator*() const { return (*of_)[at_]; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator& operator+=(difference_type by) {
      at_ = static_cast<std::size_t>(static_cast<difference_type>(at_) + by);
      return *this;
    }
    [[nodiscard]] difference_type operator-(const Iterator& other) const {
      return static_cast<difference_type>(at_) - static_cast<difference_type>(other.at_);
    }
    [[nodiscard]] bool operator==(const Iterator& other) const { return at_ == other.at_; }
    [[nodiscard]] bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const SpooledVector* of_;
    std::size_t at_;
  };

  /// @param folder, memory  see Spool
  explicit SpooledVector(std::filesystem::path folder = {}, std::size_t memory = Spool::kMemory)
      : spool_(std::move(folder), record_bytes(), memory) {}

  [[nodiscard]] std::size_t size() const { return spool_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] bool uses_file() const { return spool_.uses_file(); }
  /// @throws std::out_of_range; OutputError where the file cannot be read
  [[nodiscard]] T operator[](std::size_t i) const {
    std::vector<std::byte> bytes(spool_.record_bytes());
    spool_.read(i, bytes.data());
    T value{};
    FieldReader reader(bytes.data());
    Fields::visit(reader, value);
    return value;
  }
  [[nodiscard]] T at(std::size_t i) const { return (*this)[i]; }
  /// @pre not empty
  [[nodiscard]] T front() const { return (*this)[0]; }
  [[nodiscard]] T back() const { return (*this)[size() - 1]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

  void push_back(const T& value) { spool_.push_back(bytes_of(value).data()); }
  /// Puts another in an element's place.
  void replace(std::size_t i, const T& value) { spool_.write(i, bytes_of(value).data()); }
  /// change(element) for each, in order.
  template <class Change>
  void change_all(Change&& change) {
    for (std::size_t i = 0; i < size(); ++i) {
      T value = (*this)[i];
      change(value);
      replace(i, value);
    }
  }

 private:
  static std::size_t record_bytes() {
    FieldCounter counter;
    const T value{};
    Fields::visit(counter, value);
    return counter.bytes();
  }
  [[nodiscard]] std::vector<std::byte> bytes_of(const T& value) const {
    std::vector<std::byte> bytes(spool_.record_bytes());
    FieldWriter writer(bytes.data());
    Fields::visit(writer, value);
    return bytes;
  }

  Spool spool_;
};

}  // namespace oneac
