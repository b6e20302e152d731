#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// Bytes that one process of a machine writes and another reads, from a file, a pipe or rank 0. One
/// function that takes either stream describes the order for both directions.
namespace pounding {

/// Takes bytes that come one after the other.
using WriteBytes = std::function<void(std::span<const char>)>;

/// Fills the whole span with the next bytes, or throws.
using ReadBytes = std::function<void(std::span<char>)>;

/// Writes plain values, text, arrays and lists one after the other, for the same machine to read.
class ByteWriter {
 public:
  explicit ByteWriter(const WriteBytes& write) : write_(write) {}

  template <typename Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    pass_on(&value, sizeof(Value));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    pass_on(text.data(), text.size());
  }
  template <typename Value>
  void array(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    (*this)(static_cast<std::uint64_t>(values.size()));
    pass_on(values.data(), values.size() * sizeof(Value));
  }
  template <typename Value, typename Visit>
  void list(const std::vector<Value>& values, const Visit& visit) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) visit(value);
  }

 private:
  void pass_on(const void* data, std::size_t count) {
    if (count > 0) write_({static_cast<const char*>(data), count});
  }
  const WriteBytes& write_;
};

/// Reads the values that a ByteWriter wrote, in the same order. Throws std::runtime_error where the
/// bytes end before, and the errors of `read`.
class ByteReader {
 public:
  /// `most`: bytes that there are.
  ByteReader(const ReadBytes& read, std::size_t most) : read_(read), left_(most) {}

  template <typename Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    take(&value, 1, sizeof(Value));
  }
  void operator()(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size(), 1);
  }
  template <typename Value>
  void array(std::vector<Value>& values) {
    values.resize(count(sizeof(Value)));
    take(values.data(), values.size(), sizeof(Value));
  }
  template <typename Value, typename Visit>
  void list(std::vector<Value>& values, const Visit& visit) {
    // Every item of a list takes a byte at least.
    const std::size_t size = count(1);
    for (std::size_t i = 0; i < size; ++i) visit(values.emplace_back());
  }

 private:
  /// A number of items of a size that the rest can hold.
  std::size_t count(std::size_t size) {
    std::uint64_t number = 0;
    (*this)(number);
    if (number > left_ / size) throw std::runtime_error("the content is cut short");
    return number;
  }
  void take(void* data, std::size_t number, std::size_t size) {
    if (number > left_ / size) throw std::runtime_error("the content is cut short");
    if (number > 0) read_({static_cast<char*>(data), number * size});
    left_ -= number * size;
  }
  const ReadBytes& read_;
  std::size_t left_;
};

}  // namespace pounding
