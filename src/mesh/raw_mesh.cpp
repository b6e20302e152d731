#include "mesh/raw_mesh.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace pounding {
namespace {

constexpr std::uint64_t first_word = 0x31687365'6d776172;  // "rawmesh1"
constexpr std::uint64_t last_word = 0x31687365'6d646e65;   // "endmesh1"

class Writer {
 public:
  template <typename Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    append(&value, sizeof(Value));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }
  template <typename Value>
  void array(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    (*this)(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(Value));
  }
  template <typename Value, typename Visit>
  void list(const std::vector<Value>& values, const Visit& visit) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) visit(value);
  }
  std::vector<char> bytes;

 private:
  void append(const void* data, std::size_t count) {
    const char* first = static_cast<const char*>(data);
    bytes.insert(bytes.end(), first, first + count);
  }
};

class Reader {
 public:
  explicit Reader(std::span<const char> bytes) : bytes_(bytes) {}

  template <typename Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::memcpy(&value, take(1, sizeof(Value)), sizeof(Value));
  }
  void operator()(std::string& text) {
    const std::uint64_t size = count();
    text.assign(take(size, 1), size);
  }
  template <typename Value>
  void array(std::vector<Value>& values) {
    const std::uint64_t size = count();
    const char* first = take(size, sizeof(Value));
    values.resize(size);
    if (size > 0) std::memcpy(values.data(), first, size * sizeof(Value));
  }
  template <typename Value, typename Visit>
  void list(std::vector<Value>& values, const Visit& visit) {
    const std::uint64_t size = count();
    take(size, 0);
    for (std::uint64_t i = 0; i < size; ++i) visit(values.emplace_back());
  }

 private:
  std::uint64_t count() {
    std::uint64_t size = 0;
    (*this)(size);
    return size;
  }
  const char* take(std::uint64_t number, std::size_t size) {
    // Every item of a list takes a byte at least: no count is larger than what is left.
    if (number > bytes_.size() - at_ || number * size > bytes_.size() - at_) {
      throw std::runtime_error("the answer about a mesh is cut");
    }
    const char* first = bytes_.data() + at_;
    at_ += number * size;
    return first;
  }
  std::span<const char> bytes_;
  std::size_t at_ = 0;
};

/// The one description of the order of the bytes, for both directions.
template <typename Stream, typename Answer>
void pass(Stream& stream, Answer& answer) {
  stream(answer.error);
  auto& mesh = answer.mesh;
  stream.array(mesh.node_tags);
  stream.array(mesh.coordinates);
  stream.list(mesh.entities, [&](auto& entity) {
    stream(entity.dimension);
    stream(entity.tag);
    stream(entity.bounds_another);
    stream.list(entity.elements, [&](auto& elements) {
      stream(elements.type);
      stream.array(elements.tags);
      stream.array(elements.nodes);
    });
  });
  stream.list(mesh.groups, [&](auto& group) {
    stream(group.name);
    stream(group.dimension);
    stream.array(group.entities);
  });
  stream.list(mesh.types, [&](auto& type) {
    stream(type.type);
    stream(type.nodes);
    stream(type.name);
  });
}

}  // namespace

std::vector<char> to_bytes(const RawAnswer& answer) {
  Writer writer;
  writer(first_word);
  pass(writer, answer);
  writer(last_word);
  return std::move(writer.bytes);
}

RawAnswer from_bytes(std::span<const char> bytes) {
  Reader reader(bytes);
  std::uint64_t word = 0;
  reader(word);
  RawAnswer answer;
  if (word == first_word) {
    pass(reader, answer);
    reader(word);
  }
  if (word != last_word) throw std::runtime_error("the answer about a mesh is none");
  return answer;
}

}  // namespace pounding
