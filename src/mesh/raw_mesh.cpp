#include "mesh/raw_mesh.h"

#include <stdexcept>

namespace pounding {
namespace {

constexpr std::uint64_t first_word = 0x31687365'6d776172;  // "rawmesh1"
constexpr std::uint64_t last_word = 0x31687365'6d646e65;   // "endmesh1"

}  // namespace

void write_answer(const RawAnswer& answer, const WriteBytes& write) {
  ByteWriter writer(write);
  writer(first_word, answer, last_word);
}

RawAnswer read_answer(const ReadBytes& read, std::size_t most) {
  ByteReader reader(read, most);
  std::uint64_t word = 0;
  reader(word);
  RawAnswer answer;
  if (word == first_word) {
    reader(answer, word);
  }
  if (word != last_word) throw std::runtime_error("the answer about a mesh is none");
  return answer;
}

}  // namespace pounding
