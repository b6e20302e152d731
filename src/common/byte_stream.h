#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Bytes that one process of a machine writes and another reads, from a file, a pipe or rank 0. One
/// list of members describes the order for both directions.
namespace pounding {

/// Takes bytes that come one after the other.
using WriteBytes = std::function<void(std::span<const char>)>;

/// Fills the whole span with the next bytes, or throws.
using ReadBytes = std::function<void(std::span<char>)>;

/// A struct that lists its members for streams: `members(self, stream)` calls
/// `stream(self.a, self.b, ...)`, in the one order of both directions.
template <typename Value, typename Stream>
concept ListsMembers = requires(Value& value, Stream& stream) {
  std::remove_const_t<Value>::members(value, stream);
};

/// Writes values one after the other, for the same machine to read: plain ones as bytes, texts,
/// vectors, maps and structs that list their members.
class ByteWriter {
 public:
  explicit ByteWriter(const WriteBytes& write) : write_(write) {}

  template <typename... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

 private:
  template <typename Value>
  void put(const Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      pass_on(&value, sizeof(Value));
    } else {
      static_assert(ListsMembers<const Value, ByteWriter>);
      Value::members(value, *this);
    }
  }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    pass_on(text.data(), text.size());
  }
  template <typename One, typename Other>
  void put(const std::pair<One, Other>& both) {
    (*this)(both.first, both.second);
  }
  template <typename Value>
  void put(const std::vector<Value>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    if constexpr (std::is_trivially_copyable_v<Value>) {
      pass_on(values.data(), values.size() * sizeof(Value));
    } else {
      for (const Value& value : values) put(value);
    }
  }
  template <typename Key, typename Value>
  void put(const std::map<Key, Value>& entries) {
    put(static_cast<std::uint64_t>(entries.size()));
    for (const auto& entry : entries) put(entry);
  }

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

  template <typename... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

 private:
  template <typename Value>
  void get(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      take(&value, 1, sizeof(Value));
    } else {
      static_assert(ListsMembers<Value, ByteReader>);
      Value::members(value, *this);
    }
  }
  void get(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size(), 1);
  }
  template <typename One, typename Other>
  void get(std::pair<One, Other>& both) {
    (*this)(both.first, both.second);
  }
  template <typename Value>
  void get(std::vector<Value>& values) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      values.resize(count(sizeof(Value)));
      take(values.data(), values.size(), sizeof(Value));
    } else {
      // Every item of a list takes a byte at least.
      values.clear();
      for (std::size_t left = count(1); left > 0; --left) get(values.emplace_back());
    }
  }
  template <typename Key, typename Value>
  void get(std::map<Key, Value>& entries) {
    std::vector<std::pair<Key, Value>> list;
    get(list);
    entries = {list.begin(), list.end()};
  }
  /// A number of items of a size that the rest can hold.
  std::size_t count(std::size_t size) {
    std::uint64_t number = 0;
    get(number);
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
