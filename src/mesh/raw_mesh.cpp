#include "mesh/raw_mesh.h"

#include <stdexcept>
#include <type_traits>

namespace pounding {
namespace {

constexpr std::uint64_t first_word = 0x31687365'6d776172;  // "rawmesh1"
constexpr std::uint64_t last_word = 0x31687365'6d646e65;   // "endmesh1"

class Writer {
 public:
  explicit Writer(const WriteBytes& write) : write_(write) {}

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

class Reader {
 public:
  Reader(const ReadBytes& read, std::size_t most) : read_(read), left_(most) {}

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
    if (number > left_ / size) throw std::runtime_error("the answer about a mesh is cut");
    return number;
  }
  void take(void* data, std::size_t number, std::size_t size) {
    if (number > left_ / size) throw std::runtime_error("the answer about a mesh is cut");
    if (number > 0) read_({static_cast<char*>(data), number * size});
    left_ -= number * size;
  }
  const ReadBytes& read_;
  std::size_t left_;
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

void write_answer(const RawAnswer& answer, const WriteBytes& write) {
  Writer writer(write);
  writer(first_word);
  pass(writer, answer);
  writer(last_word);
}

RawAnswer read_answer(const ReadBytes& read, std::size_t most) {
  Reader reader(read, most);
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
