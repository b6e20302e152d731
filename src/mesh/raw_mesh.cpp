#include "mesh/raw_mesh.h"

#include <stdexcept>

namespace pounding {
namespace {

constexpr std::uint64_t first_word = 0x31687365'6d776172;  // "rawmesh1"
constexpr std::uint64_t last_word = 0x31687365'6d646e65;   // "endmesh1"

/// The one description of the order of the bytes, for both directions.
template <typename Stream, typename Answer>
void pass(Stream& stream, Answer& answer) {
  stream(answer.error);
  stream(answer.denied);
  stream(answer.landlock);
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
  stream.list(mesh.files, [&](auto& file) { stream(file); });
  stream.list(mesh.changed, [&](auto& parameter) {
    stream(parameter.name);
    stream(parameter.value);
  });
}

}  // namespace

void write_answer(const RawAnswer& answer, const WriteBytes& write) {
  ByteWriter writer(write);
  writer(first_word);
  pass(writer, answer);
  writer(last_word);
}

RawAnswer read_answer(const ReadBytes& read, std::size_t most) {
  ByteReader reader(read, most);
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
